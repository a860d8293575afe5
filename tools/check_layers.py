#!/usr/bin/env python3
"""Holds the arrows between the folders of src/derham and reports every #include that goes against them.

The Python package (python/bindings) sees all folders and has one source for each.

usage: tools/check_layers.py [ROOT]     check ROOT/src/derham (default: this repository); exit 1 on a violation
       tools/check_layers.py --self-test
"""
import re
import sys
import tempfile
from pathlib import Path

# A folder may include itself and what is listed here. A folder that is not listed does not exist.
MAY_INCLUDE = {
    "core": [],
    "complex": ["core"],
    "boundary": ["core", "complex"],
    "forms": ["core", "complex", "boundary"],  # never geometry, dual
    "geometry": ["core", "complex"],  # never boundary, forms
    "dual": ["core", "complex", "boundary", "geometry"],
    "hodge": ["core", "complex", "boundary", "forms", "geometry", "dual"],
    "operators": ["core", "complex", "boundary", "forms", "geometry", "dual", "hodge"],
    "meshes": ["core", "complex", "geometry"],
    "io": ["core", "complex", "geometry", "forms", "dual"],
}

NEVER_SEES_EIGEN = {"core", "complex"}
APPLICATION_ONLY = ("fmt", "CLI", "nlohmann")
PYTHON_ONLY = ("nanobind", "Python.h")

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def violation(room, quote, target):
    """What is wrong with `#include target` in folder `room`; None if nothing is."""
    first, _, rest = target.partition("/")
    if first == "derham":
        other, slash, _ = rest.partition("/")
        if not slash or other not in MAY_INCLUDE:
            return f"<{target}> is in no folder of the table"
        if other != room and other not in MAY_INCLUDE[room]:
            allowed = ", ".join(MAY_INCLUDE[room]) or "nothing but itself"
            return f"{room} may not include {other} (it may include {allowed})"
        return None
    if quote == '"':
        return f'"{target}": write the whole path, "derham/{room}/…"'
    if first in ("Eigen", "unsupported") and room in NEVER_SEES_EIGEN:
        return f"Eigen begins at boundary; {room} does without"
    if first in APPLICATION_ONLY:
        return f"{first} belongs to apps/, not to the library"
    if first in PYTHON_ONLY:
        return f"{first} belongs to python/, not to the library"
    return None


def violations(root):
    """Every violation under root/src/derham as 'path:line: message'."""
    library = root / "src" / "derham"
    found = []
    for entry in sorted(library.iterdir()):
        if entry.is_dir() and entry.name not in MAY_INCLUDE:
            found.append(f"{entry.relative_to(root)}:1: unknown folder; add it to the table of tools/check_layers.py")
    for path in sorted(p for p in library.rglob("*") if p.suffix in (".hpp", ".cpp", ".h", ".inl", ".in")):
        room = path.relative_to(library).parts[0]
        if room not in MAY_INCLUDE:
            if path.parent == library:
                found.append(f"{path.relative_to(root)}:1: a source outside the folders")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if match and (message := violation(room, *match.groups())):
                found.append(f"{path.relative_to(root)}:{number}: {message}")
    bindings = root / "python" / "bindings"
    if bindings.is_dir():
        found += [f"python/bindings:1: no {room}.cpp for the folder {room}" for room in MAY_INCLUDE
                  if not (bindings / f"{room}.cpp").is_file()]
    return found


def self_test():
    """Each of these lines must be reported at its place, and the clean file must not."""
    bad = {
        "forms/a.hpp": '#include "derham/geometry/volumes.hpp"',
        "geometry/a.cpp": '  #  include <derham/boundary/chain.hpp>',
        "complex/a.hpp": "#include <Eigen/SparseCore>",
        "io/a.cpp": "#include <fmt/format.h>",
        "hodge/a.cpp": "#include <nlohmann/json.hpp>",
        "meshes/a.cpp": "#include <CLI/CLI.hpp>",
        "core/a.hpp": '#include "derham/nowhere/a.hpp"',
        "dual/a.cpp": '#include "b.hpp"',
        "boundary/a.hpp": "#include <nanobind/nanobind.h>",
        "attic/a.hpp": "",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        clean = root / "src/derham/boundary/clean.hpp"
        clean.parent.mkdir(parents=True)
        clean.write_text('#include <Eigen/SparseCore>\n#include <vector>\n#include "derham/core/types.hpp"\n'
                         '// #include "derham/geometry/volumes.hpp"\n')
        if violations(root):
            return ["a clean file was reported: " + violations(root)[0]]
        for name, line in bad.items():
            path = root / "src/derham" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"#pragma once\n{line}\n")
        (root / "python/bindings").mkdir(parents=True)
        for room in set(MAY_INCLUDE) - {"io"}:
            (root / f"python/bindings/{room}.cpp").touch()
        found = violations(root)
    places = ["src/derham/attic:1:", "python/bindings:1: no io.cpp"] + [f"src/derham/{name}:2:" for name in bad if not name.startswith("attic")]
    failures = [f"not reported: {place}" for place in places if not any(f.startswith(place) for f in found)]
    if len(found) != len(places):
        failures.append(f"{len(found)} violations reported, {len(places)} expected: {found}")
    return failures


def main(arguments):
    if arguments == ["--self-test"]:
        problems = self_test()
    else:
        root = Path(arguments[0]) if arguments else Path(__file__).resolve().parent.parent
        problems = violations(root)
    for problem in problems:
        print(problem)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
