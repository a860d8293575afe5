#!/usr/bin/env python3
"""Prints the reports of benchmark programs as tables of medians over the repetitions.

usage: bench/support/table.py REPORT.json…
"""
import sys

from report import heading, load, markdown, measurements, number

RATIOS = ("set and map", "radix sort")  # in time, of the same mesh on one thread
RATES = ("copy", "gather")  # in bytes per second, on as many threads
YARDSTICKS = RATIOS + RATES


def percent(value):
    return "" if value is None else f"{100 * value:.0f} %"


def over(a, b):
    return None if a is None or b is None or b == 0 else a / b


def by_eigen(name):
    """What Eigen's product with the matrix of an operator is called."""
    return name.removesuffix(" assembled") + " by Eigen"


def file_table(benchmarks):
    head = ["file", "MB", "MB/s", "fread MB/s", "x fread", "x memory"]
    rows = []
    for b in benchmarks:
        if b.error:
            rows.append([f"{b.name}: {b.error}"] + [""] * 5)
            continue
        memory = b.median("memory")
        rows.append([b.name, f"{b.median('MB'):.1f}", f"{b.median('MB/s'):.0f}", f"{b.median('fread MB/s'):.0f}",
                     f"{b.median('fread'):.2f}", f"{memory:.2f}" if memory > 0 else "-"])
    return markdown(head, rows)


def kernel_table(benchmarks):
    """One row per kernel and order of the mesh; columns that would be empty are left out."""
    found = {(b.name, b.order, b.threads): b for b in benchmarks}
    most = max(b.threads for b in benchmarks)

    def yardstick(name, order, threads, counter):
        b = found.get((name, order, threads)) or found.get((name, "-", threads))
        return b.median(counter) if b else None

    rows = []
    for (name, order, threads), one in found.items():
        if threads != 1:
            continue
        many = found.get((name, order, most)) if most > 1 else None
        time, rate = one.median("ns/item"), one.median("GB/s")
        times = many.median("ns/item") if many else None
        rates = many.median("GB/s") if many else None
        row = {"": f"{name}, {order}" if order != "-" else name, "ns/item": number(time), "±": percent(one.spread("ns/item")),
               f"{most} threads": number(times), "speed-up": number(over(time, times))}
        for other in RATIOS:
            row[f"x {other}"] = "" if name in YARDSTICKS else number(over(yardstick(other, order, 1, "ns/item"), time))
        row["x Eigen"] = number(over(yardstick(by_eigen(name), order, 1, "ns/item"), time))
        row["GB/s"] = number(rate)
        row[f"GB/s, {most} threads"] = number(rates)
        for other in RATES:
            if name == other:
                continue
            row[f"of {other}"] = percent(over(rate, yardstick(other, order, 1, "GB/s")))
            row[f"of {other}, {most} threads"] = percent(over(rates, yardstick(other, order, most, "GB/s")))
        row["peak B"], row["kept B"] = number(one.median("peak B/item")), number(one.median("kept B/item"))
        rows.append(row)
    head = [column for column in dict.fromkeys(key for row in rows for key in row) if any(row.get(column) for row in rows)]
    head = [""] + [column for column in head if column]
    return markdown(head, [[row.get(column, "") for column in head] for row in rows])


def show(report):
    benchmarks = [b for b in measurements(report) if b.error is None or not b.order]
    if not benchmarks:
        return "nothing was measured"
    repetitions = max(len(b.runs) for b in benchmarks)
    table = kernel_table if benchmarks[0].order else file_table
    return f"{heading(report)}; medians of {repetitions}\n\n{table(benchmarks)}"


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("\n\n".join(show(load(path)) for path in sys.argv[1:]))
