"""The installed wheel is all that derham needs: run by the Python of an environment that has nothing else.

    build/venv-wheel/bin/python -I tests/python/check_wheel.py

-I keeps the repository off the path. numpy and scipy are what the wheel depends on; pytest and its like are missing.
"""

from __future__ import annotations

import contextlib
import io
import json
import re
import subprocess
import sys
import tempfile
from importlib import metadata
from pathlib import Path

import derham

PAGE = Path(__file__).parents[2] / "docs" / "python.md"
ENVIRONMENT = {"derham", "numpy", "scipy", "pip", "setuptools"}
# What every Linux of the policy has: PEP 600 and the policies of auditwheel.
SYSTEM = {"ld-linux-x86-64", "libc", "libdl", "libgcc_s", "libm", "libpthread", "librt", "libstdc++", "libz", "linux-vdso"}


def nothing_else_is_installed() -> None:
    installed = {distribution.metadata["Name"] for distribution in metadata.distributions()}
    assert installed <= ENVIRONMENT, f"not an empty environment: {installed - ENVIRONMENT}"
    assert Path(derham.__file__).is_relative_to(sys.prefix), derham.__file__


def first_program_runs() -> None:
    found = re.search(r"```python\n(.*?)```\n```text\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert found
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(found[1], {"__name__": "page"})  # noqa: S102
    assert out.getvalue() == found[2], out.getvalue()


def command_line_runs() -> None:
    module = [sys.executable, "-I", "-m", "derham"]
    program = [str(Path(sys.prefix, "bin", "derham"))]

    def output(*command: str) -> str:
        return subprocess.run(command, check=True, capture_output=True, text=True, cwd=folder).stdout

    with tempfile.TemporaryDirectory() as folder:
        for command in (module, program):
            assert output(*command, "--version") == f"derham {metadata.version('derham')}\n"
        output(*program, "generate", "torus", "--out", "torus.ply")
        info = json.loads(output(*module, "info", "--json", "torus.ply"))
        assert (info["dimension"], info["euler_characteristic"]) == (2, 0), info
        assert derham.read(Path(folder, "torus.ply")).euler_characteristic == 0


def links_are_inside_or_of_the_system() -> None:
    package = Path(derham.__file__).parent
    inside = package.with_name("derham.libs").resolve()
    extension, = package.glob("_derham*.so")
    for binary in (extension, package / "bin" / "derham", *inside.glob("*")):
        links = subprocess.run(["ldd", str(binary)], check=True, capture_output=True, text=True).stdout
        for name, path in re.findall(r"^\s*(\S+)(?: => (.*?))?(?: \(0x\w+\))?$", links, re.MULTILINE):
            system = Path(name).name.partition(".so")[0] in SYSTEM
            assert system or (path and Path(path).resolve().is_relative_to(inside)), f"{binary.name} needs {name}: {path}"


if __name__ == "__main__":
    for check in (nothing_else_is_installed, first_program_runs, command_line_runs, links_are_inside_or_of_the_system):
        check()
        print(f"{sys.argv[0]}: {check.__name__.replace('_', ' ')}")
