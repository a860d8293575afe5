#!/usr/bin/env python3
"""The complex of a tetrahedral mesh from arrays: Python beside C++, time and peak memory, each in a new process, in turn.

    cmake --build build/release --target bench_python_build
    python bench/python_build.py [--simplices N] [--rounds R] [--program FILE]

A box in natural order and shuffled (vertices and simplices), on one thread and on two. Both sides have the arrays in memory and
keep them: `derham.Complex(simplices, points)`, and SimplicialComplex, Geometry and orient_by_volume from a MeshData. Medians;
the ratios are medians of those of neighbours. The peak of Python has the interpreter, numpy and scipy in it: "imports" is what
they take before anything is read.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import derham

PROGRAM = Path(__file__).parents[1] / "build/release/bench/bench_python_build"


def memory(key: str) -> int:
    status = Path("/proc/self/status").read_text()
    return 1024 * int(status.partition(f"{key}:")[2].split()[0])


def build(folder: Path, threads: int) -> dict[str, float]:
    """What the C++ program does."""
    imports = memory("VmHWM")
    derham.set_thread_count(threads)
    simplices = np.fromfile(folder / "simplices", np.int32).reshape(-1, 4)
    points = np.fromfile(folder / "points").reshape(-1, 3)
    start = time.perf_counter()
    K = derham.Complex(simplices, points)
    seconds = time.perf_counter() - start
    assert K.size(3) == len(simplices)
    return {"seconds": seconds, "peak": memory("VmHWM"), "imports": imports}


def save(folder: Path, simplices: np.ndarray, points: np.ndarray) -> Path:
    folder.mkdir()
    simplices.astype(np.int32).tofile(folder / "simplices")
    points.tofile(folder / "points")
    return folder


def meshes(folder: Path, count: int) -> list[Path]:
    K = derham.generate.box(3, round((count / 6) ** (1 / 3)))
    simplices, points = K.oriented_simplices(), K.points
    random = np.random.default_rng(1)
    new = random.permutation(len(points))  # vertex v becomes new[v]
    places = np.empty_like(points)
    places[new] = points
    return [save(folder / "natural", simplices, points), save(folder / "shuffled", random.permutation(new[simplices]), places)]


def measured(*command: str | Path) -> dict[str, float]:
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def compare(program: Path, mesh: Path, threads: int, rounds: int) -> str:
    """A row of the table."""
    cpp, python = [], []
    for number in range(rounds):
        sides = [(cpp, [program]), (python, [sys.executable, __file__, "--build"])]
        for results, command in sides if number % 2 == 0 else reversed(sides):
            results.append(measured(*command, mesh, str(threads)))

    def median(results: list[dict[str, float]], key: str, unit: float) -> str:
        return f"{statistics.median(result[key] for result in results) / unit:.0f}"

    def ratio(key: str) -> str:
        return f"{statistics.median(b[key] / a[key] for a, b in zip(cpp, python)):.3f}"

    return " | ".join([f"| {mesh.name}, {threads}", median(cpp, "seconds", 1e-3), median(python, "seconds", 1e-3), ratio("seconds"),
                       median(cpp, "peak", 1e6), median(python, "peak", 1e6), ratio("peak"), median(python, "imports", 1e6)]) + " |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--simplices", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--program", type=Path, default=PROGRAM)
    parser.add_argument("--build", nargs=2, help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.build:
        print(json.dumps(build(Path(options.build[0]), int(options.build[1]))))
        return
    print("| order, threads | C++ ms | Python ms | ratio | C++ MB | Python MB | ratio | imports MB |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for mesh in meshes(Path(folder), options.simplices):
            for threads in (1, 2):
                print(compare(options.program, mesh, threads, options.rounds), flush=True)


if __name__ == "__main__":
    main()
