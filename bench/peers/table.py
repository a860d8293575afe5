#!/usr/bin/env python3
"""Prints the reports of bench_peers and peers.py as one table per task: every library beside derham.

usage: bench/peers/table.py REPORT.json…
"""
import subprocess
import sys
from importlib import metadata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from report import heading, load, markdown, measurements, number  # noqa: E402

PACKAGES = ("numpy", "scipy", "scikit-fem", "libigl", "mfem", "ngsolve")
DEBIAN = ("libeigen3-dev", "libgudhi-dev", "libopenmesh-dev")


def versions():
    """Of the libraries that were measured."""
    found = []
    for name in PACKAGES:
        try:
            found.append(f"{name} {metadata.version(name)}")
        except metadata.PackageNotFoundError:
            pass
    query = subprocess.run(["dpkg-query", "-W", "-f", "${Package} ${Version}\n", *DEBIAN], capture_output=True, text=True,
                           check=False)
    return ", ".join(found + query.stdout.splitlines())


def times(one, ours):
    """Nanoseconds per simplex, and how many times those of derham."""
    if one is None:
        return ["", ""]
    value, base = one.median("ns/item"), ours.median("ns/item") if ours else None
    return [number(value), f"{value / base:.2f}" if base else ""]


def task_table(benchmarks, kind):
    """`kind` is "" for tetrahedra, " triangles" for triangles. One thread each."""
    orders = ("natural" + kind, "shuffled" + kind)
    found = {(b.name, b.order): b for b in benchmarks if b.threads == 1 and b.order in orders}
    names = sorted(dict.fromkeys(name for name, _ in found), key=lambda name: not name.endswith(": derham"))
    tasks = dict.fromkeys(name.partition(": ")[0] for name in names)
    rows = []
    for task in tasks:
        ours = {order: found.get((f"{task}: derham", order)) for order in orders}
        for name in (name for name in names if name.startswith(task + ": ")):
            columns = [cell for order in orders for cell in times(found.get((name, order)), ours[order])]
            memory = next((b.median("peak B/item") for (n, o), b in found.items() if n == name and o == orders[1]), None)
            rows.append([name, *columns, number(memory)])
    if not rows:
        return ""
    return markdown(["ns per simplex, one thread", "natural", "x derham", "shuffled", "x derham", "peak B"], rows)


def main(paths):
    reports = [load(path) for path in paths]
    benchmarks = [b for report in reports for b in measurements(report)]
    print(f"{heading(reports[0])}; medians\n{versions()}\n")
    for kind, name in (("", "Tetrahedra"), (" triangles", "Triangles")):
        print(f"{name}\n\n{task_table(benchmarks, kind)}\n")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
