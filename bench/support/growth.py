#!/usr/bin/env python3
"""Time and memory of the construction as meshes grow, as a table and a log-log plot.

usage: bench/support/growth.py BUILD PICTURE.svg [LARGEST]

BUILD/bench/complex/bench_complex is run at 10^4, 2·10^4, 5·10^4, … up to LARGEST (20000000) tetrahedra. The exponent is the
slope of the logarithm of time (or memory) over that of the number of tetrahedra, by least squares from 10^5 up, below which
the mesh fits into caches. Reports stay in BUILD/growth-N.json.
"""
import math
import subprocess
import sys
from pathlib import Path

from report import heading, load, markdown, measurements, number

ORDERS = ("natural", "shuffled")
FILTER = "--benchmark_filter=^construction/(natural|shuffled)/"
FITTED_FROM = 1e5


def sizes(largest):
    steps = [digit * 10**power for power in range(4, 9) for digit in (1, 2, 5)]
    return [size for size in steps if size <= largest]


def measured(build, size):
    report = build / f"growth-{size}.json"
    command = [str(build / "bench/complex/bench_complex"), f"--simplices={size}", FILTER, "--benchmark_repetitions=5",
               f"--benchmark_out={report}", "--benchmark_out_format=json"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{run.stderr}")
    return load(report)


def slope(points):
    """The exponent b of y = a x^b by least squares of the logarithms."""
    logs = [(math.log(x), math.log(y)) for x, y in points if x >= FITTED_FROM and y > 0]
    if len(logs) < 2:
        return None
    mean_x, mean_y = (sum(column) / len(logs) for column in zip(*logs))
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x)**2 for x, _ in logs)


def picture(series, unit):
    """An SVG of log-log curves: {name: [(x, y)]}; grey lines have slope 1."""
    width, height, left, bottom = 640, 420, 70, 50
    points = [p for curve in series.values() for p in curve]
    decades = [(math.floor(math.log10(min(p[i] for p in points)) - 0.05), math.ceil(math.log10(max(p[i] for p in points))))
               for i in (0, 1)]

    def place(x, y):
        (x0, x1), (y0, y1) = decades
        return (left + (math.log10(x) - x0) / (x1 - x0) * (width - left - 20),
                height - bottom - (math.log10(y) - y0) / (y1 - y0) * (height - bottom - 20))

    def line(points, style):
        return f'<polyline fill="none" {style} points="' + " ".join(f"{x:.1f},{y:.1f}" for x, y in points) + '"/>'

    (x0, x1), (y0, y1) = decades
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
             f'<rect width="{width}" height="{height}" fill="white"/>',
             f'<clipPath id="frame"><rect x="{left}" y="20" width="{width - left - 20}" height="{height - bottom - 20}"/></clipPath>']
    for d in range(x0, x1 + 1):
        x, y = place(10**d, 10**y0)
        parts.append(line([(x, y), place(10**d, 10**y1)], 'stroke="#ddd"'))
        parts.append(f'<text x="{x}" y="{y + 18}" text-anchor="middle">10<tspan dy="-5" font-size="9">{d}</tspan></text>')
    for d in range(y0, y1 + 1):
        x, y = place(10**x0, 10**d)
        parts.append(line([(x, y), place(10**x1, 10**d)], 'stroke="#ddd"'))
        parts.append(f'<text x="{x - 8}" y="{y + 4}" text-anchor="end">10<tspan dy="-5" font-size="9">{d}</tspan></text>')
    for shift in range(y0 - x1, y1 - x0 + 1):
        parts.append(line([place(10**x0, 10.0**(x0 + shift)), place(10**x1, 10.0**(x1 + shift))],
                          'stroke="#bbb" stroke-dasharray="3 4" clip-path="url(#frame)"'))
    colors = ("#1b6ca8", "#c8553d", "#3a7d44", "#8a5a9e")
    for (name, curve), color in zip(series.items(), colors):
        parts.append(line([place(x, y) for x, y in curve], f'stroke="{color}" stroke-width="2"'))
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>' for x, y in (place(*p) for p in curve)]
        at = 36 + 16 * list(series).index(name)
        parts.append(f'<text x="{left + 12}" y="{at}" fill="{color}">{name}</text>')
    parts.append(f'<text x="{(width + left) / 2}" y="{height - 10}" text-anchor="middle">tetrahedra</text>')
    parts.append(f'<text x="16" y="{height / 2}" text-anchor="middle" transform="rotate(-90 16 {height / 2})">{unit}</text>')
    return "\n".join(parts + ["</svg>"]) + "\n"


def main(build, target, largest="20000000"):
    curves, memory, rows, report = {}, {}, [], None
    for size in sizes(int(largest)):
        report = measured(Path(build), size)
        row = {}
        for b in measurements(report):
            tets, seconds = b.median("items"), b.median("ns/item") * b.median("items") / 1e9
            name = f"{b.order}, {b.threads} thread{'s' if b.threads > 1 else ''}"
            curves.setdefault(name, []).append((tets, 1e3 * seconds))
            row[name] = number(b.median("ns/item"))
            if b.threads == 1:
                memory.setdefault(b.order, []).append((tets, b.median("peak B/item") * tets))
                row[f"peak MB, {b.order}"] = number(b.median("peak B/item") * tets / 1e6)
                row[f"peak B, {b.order}"] = number(b.median("peak B/item"))
            row["tetrahedra"] = f"{tets:.0f}"
        rows.append(row)
        print(f"{size}: {row}", file=sys.stderr)
    head = ["tetrahedra", *[column for column in rows[-1] if column != "tetrahedra"]]
    print(f"construction, ns per tetrahedron and memory above the input; medians of 5\n{heading(report)}\n")
    print(markdown(head, [[row.get(column, "") for column in head] for row in rows]))
    for kind, found in (("time", curves), ("memory", memory)):
        for name, points in found.items():
            print(f"{kind} grows as N^{number(slope(points))} ({name})")
    Path(target).write_text(picture(curves, "milliseconds"), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
