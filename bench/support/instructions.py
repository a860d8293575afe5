#!/usr/bin/env python3
"""Counts the instructions of every kernel with callgrind and compares them with the counts that are kept.

usage: bench/support/instructions.py BUILD ROOM… [--keep] [--once=REGEX]

BUILD/bench/ROOM/bench_ROOM are run on about 20,000 simplices, one thread. Exit 1 when a kernel takes more than 2 % more
instructions than in bench/instructions.json; with --keep, that file is written.
"""
import json
import subprocess
import sys
from pathlib import Path

from report import load, markdown, number

KEPT = Path(__file__).resolve().parents[1] / "instructions.json"
TOLERANCE = 1.02
SIMPLICES = 20000
# Neither yardsticks nor Eigen, nor what small boxes do not have.
KERNELS = "^(?!set and map|radix sort|copy|gather|star_1 inverse|.*Eigen)"


def counts(build, room, regex):
    """{kernel/order: instructions per item}: callgrind collects inside derham_bench_measured and dumps at its end."""
    dumps = build / f"callgrind.{room}"
    for old in build.glob(dumps.name + "*"):
        old.unlink()
    command = ["valgrind", "--tool=callgrind", "--collect-atstart=no", "--toggle-collect=derham_bench_measured",
               "--dump-after=derham_bench_measured", f"--callgrind-out-file={dumps}",
               str(build / "bench" / room / f"bench_{room}"), f"--simplices={SIMPLICES}", f"--once={regex}"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        sys.exit(f"{' '.join(command)}\n{run.stderr}")
    result = {}
    for i, line in enumerate(run.stdout.splitlines(), 1):
        name, items = line.split("\t")
        for row in Path(f"{dumps}.{i}").read_text(encoding="utf-8").splitlines():
            if row.startswith("totals:"):
                result[name] = int(row.split()[1]) / int(items)
    return result


def compiler(build):
    for line in (build / "CMakeCache.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("CMAKE_CXX_COMPILER:"):
            path = line.partition("=")[2]
            return subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    return "unknown"


def main(arguments):
    options = [a for a in arguments if a.startswith("--")]
    build, *rooms = [a for a in arguments if not a.startswith("--")]
    regex = next((o.partition("=")[2] for o in options if o.startswith("--once=")), KERNELS)
    now = {f"{room}: {name}": count for room in rooms for name, count in counts(Path(build), room, regex).items()}
    kept = load(KEPT) if KEPT.exists() else {"compiler": "", "instructions per simplex": {}}
    before = kept["instructions per simplex"]
    ratios = {name: count / before[name] for name, count in now.items() if name in before}
    rows = [[name, number(count, 4), number(before.get(name), 4), f"{ratios[name]:.3f}" if name in ratios else "new"]
            for name, count in now.items()]
    print(f"instructions per simplex, {SIMPLICES} simplices, one thread; {compiler(Path(build))}\n")
    print(markdown(["kernel", "now", "kept", "ratio"], rows))
    if kept["compiler"] not in ("", compiler(Path(build))):
        print(f"\nkept are the counts of {kept['compiler']}")
    if "--keep" in options:
        kept = {"compiler": compiler(Path(build)), "simplices": SIMPLICES,
                "instructions per simplex": {**before, **{name: round(count, 1) for name, count in now.items()}}}
        KEPT.write_text(json.dumps(kept, indent=2) + "\n", encoding="utf-8")
        return 0
    more = [name for name, ratio in ratios.items() if ratio > TOLERANCE]
    for name in more:
        print(f"\n{name} takes more instructions than before; if that is meant, run with --keep")
    return 1 if more else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
