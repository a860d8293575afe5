#!/usr/bin/env python3
"""Prints the report of a benchmark program (JSON of Google Benchmark) as a table of medians over the repetitions.

usage: bench/support/table.py REPORT.json…
"""
import json
import statistics
import sys


def median(runs, counter):
    return statistics.median(run.get(counter, 0) for run in runs)


def rows(report):
    """Name and median of every counter, benchmark by benchmark in the order of the report."""
    runs = {}
    for run in report["benchmarks"]:
        if run["run_type"] == "iteration":
            runs.setdefault(run["run_name"].split("/iterations:")[0], []).append(run)
    return [(name, repetitions) for name, repetitions in runs.items()]


def line(name, runs):
    failed = [run["error_message"] for run in runs if run.get("error_occurred")]
    if failed:
        return f"{name:<36} {failed[0]}"
    memory = median(runs, "memory")
    return (f"{name:<36} {median(runs, 'MB'):>6.1f} {median(runs, 'MB/s'):>7.0f} {median(runs, 'fread MB/s'):>12.0f} "
            f"{median(runs, 'fread'):>7.2f} {f'{memory:.2f}' if memory > 0 else '-':>8}")


def show(report):
    context = report["context"]
    load = " ".join(f"{value:.2f}" for value in context["load_avg"])
    print(f"{context['processor']}, {context['num_cpus']} cores, load {load}; {context['compiler']}")
    print(f"{context['flags']}")
    table = rows(report)
    print(f"{context['simplices']} simplices; medians of {len(table[0][1])}\n" if table else "nothing was measured")
    print(f"{'file':<36} {'MB':>6} {'MB/s':>7} {'fread MB/s':>12} {'x fread':>7} {'x memory':>8}")
    for name, runs in table:
        print(line(name, runs))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            show(json.load(file))
