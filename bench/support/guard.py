#!/usr/bin/env python3
"""Compares two builds of the benchmarks by running them in turn, and says what became slower.

usage: bench/support/guard.py OLD NEW ROOM… [--rounds=9] [--threshold=5] [OPTION of the programs…]

OLD and NEW are build directories. In every round each runs once, in alternate order: A B, B A, … A kernel is slower when
the median over the rounds of new time / old time exceeds 1 + threshold %, and the lower quartile exceeds 1. Exit 1 if one
is.
"""
import statistics
import subprocess
import sys
from pathlib import Path

from report import load, markdown, measurements, number

NOT_YARDSTICKS = "--benchmark_filter=-(set and map|radix sort|copy|gather)"  # a leading minus: what does not match


def measured(build, room, options):
    """{kernel/order/threads: ns/item}, the median of three repetitions that take turns."""
    report = Path(build) / f"guard-{room}.json"
    command = [str(Path(build) / "bench" / room / f"bench_{room}"), "--simplices=200000", NOT_YARDSTICKS,
               "--benchmark_repetitions=3", "--benchmark_enable_random_interleaving=true",
               f"--benchmark_out={report}", "--benchmark_out_format=json", *options]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{run.stderr}")
    return {b.key: b.median("ns/item") for b in measurements(load(report)) if b.median("ns/item") is not None}


def rounds_of(old, new, rooms, rounds, options):
    """{room: kernel: [(old, new) of every round]}, of the kernels that both have."""
    pairs = {}
    for i in range(rounds):
        for room in rooms:
            order = (old, new) if i % 2 == 0 else (new, old)
            times = {build: measured(build, room, options) for build in order}
            for key in times[new].keys() & times[old].keys():
                pairs.setdefault(f"{room}: {key}", []).append((times[old][key], times[new][key]))
            for key in times[new].keys() ^ times[old].keys():
                pairs.setdefault(f"{room}: {key}", [])
    return pairs


def verdict(pairs, threshold):
    """(row of the table, whether it is slower) of one kernel."""
    if not pairs:
        return ["", "", "only in one", ""], False
    ratios = [after / before for before, after in pairs]
    ratio = statistics.median(ratios)
    low, _, high = statistics.quantiles(ratios, n=4) if len(ratios) > 1 else (ratio, ratio, ratio)
    slower = ratio > 1 + threshold / 100 and low > 1
    return [number(statistics.median(before for before, _ in pairs)), number(statistics.median(after for _, after in pairs)),
            f"{ratio:.3f}", f"{low:.3f} to {high:.3f}"], slower


def option(options, name, default):
    return float(next((o.partition("=")[2] for o in options if o.startswith(f"--{name}=")), default))


def main(arguments):
    options = [a for a in arguments if a.startswith("--")]
    old, new, *rooms = [a for a in arguments if not a.startswith("--")]
    threshold = option(options, "threshold", 5)
    rounds = int(option(options, "rounds", 9))
    passed_on = [o for o in options if not o.startswith(("--threshold=", "--rounds="))]
    pairs = rounds_of(old, new, rooms, rounds, passed_on)
    if not pairs:
        sys.exit("nothing was measured")
    results = {name: verdict(pairs[name], threshold) for name in sorted(pairs)}
    print(f"\nnew over old, median of {rounds} rounds and its quartiles\n")
    print(markdown(["kernel", "old ns/item", "new ns/item", "ratio", "half of the rounds"],
                   [[name, *row] for name, (row, _) in results.items()]))
    slower = [name for name, (_, is_slower) in results.items() if is_slower]
    print("\n" + (f"slower by more than {threshold:g} %: {', '.join(slower)}" if slower else
                  f"nothing is slower by more than {threshold:g} %"))
    return 1 if slower else 0


if __name__ == "__main__":
    if len([a for a in sys.argv[1:] if not a.startswith("--")]) < 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
