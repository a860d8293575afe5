#!/usr/bin/env python3
"""Tests of the scripts that read reports: what is computed, not how fast anything is."""
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import growth  # noqa: E402
import guard  # noqa: E402
import table  # noqa: E402
from report import markdown, measurements, number, plain  # noqa: E402

CONTEXT = {"processor": "P", "num_cpus": 2, "load_avg": [0, 0, 0], "date": "2000-01-01T00:00:00", "compiler": "C",
           "flags": "-O3", "simplices": "10"}


def run(name, family, **counters):
    return {"run_name": f"{name}/min_time:0.050/manual_time", "run_type": "iteration", "family_index": family, **counters}


def report(*runs):
    return {"context": CONTEXT, "benchmarks": list(runs)}


class Reports(unittest.TestCase):
    def test_names_lose_how_google_benchmark_measured(self):
        self.assertEqual(plain("a b/natural/threads:2/iterations:1/repeats:1/manual_time"), "a b/natural/threads:2")

    def test_repetitions_are_gathered_in_the_order_of_registration(self):
        found = measurements(report(run("b/-/threads:1", 2, x=1), run("a/natural/threads:2", 1, x=5),
                                    run("b/-/threads:1", 2, x=9), run("b/-/threads:1", 2, x=2)))
        self.assertEqual([(b.name, b.order, b.threads) for b in found], [("a", "natural", 2), ("b", "-", 1)])
        self.assertEqual(found[1].median("x"), 2)
        self.assertIsNone(found[1].median("y"))

    def test_numbers_keep_three_digits(self):
        self.assertEqual([number(x) for x in (1234.5, 99.94, 0.12345, None)], ["1234", "99.9", "0.123", ""])

    def test_tables_are_aligned(self):
        lines = markdown(["a", "value"], [["long name", "1"], ["b", "20"]]).splitlines()
        self.assertEqual(len({len(line) for line in lines}), 1)


class Tables(unittest.TestCase):
    def test_ratios_are_to_the_yardstick_of_the_same_order_and_threads(self):
        text = table.show(report(run("k/natural/threads:1", 0, **{"ns/item": 10, "GB/s": 2}),
                                 run("k/natural/threads:2", 1, **{"ns/item": 5, "GB/s": 4}),
                                 run("set and map/natural/threads:1", 2, **{"ns/item": 700}),
                                 run("set and map/shuffled/threads:1", 3, **{"ns/item": 9999}),
                                 run("copy/-/threads:1", 4, **{"ns/item": 1, "GB/s": 8}),
                                 run("copy/-/threads:2", 5, **{"ns/item": 1, "GB/s": 5})))
        lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines() if line.startswith("| ")]
        row = dict(zip(lines[0], lines[1]))
        self.assertEqual(lines[1][0], "k, natural")
        self.assertEqual((row["speed-up"], row["x set and map"]), ("2", "70"))
        self.assertEqual((row["of copy"], row["of copy, 2 threads"]), ("25 %", "80 %"))

    def test_operators_are_compared_with_the_product_of_eigen(self):
        text = table.show(report(run("d/natural/threads:1", 0, **{"ns/item": 2}),
                                 run("d assembled/natural/threads:1", 1, **{"ns/item": 8}),
                                 run("d by Eigen/natural/threads:1", 2, **{"ns/item": 6}),
                                 run("d by Eigen/shuffled/threads:1", 3, **{"ns/item": 99}),
                                 run("e/natural/threads:1", 4, **{"ns/item": 5})))
        lines = [[cell.strip() for cell in line.split("|")[1:-1]] for line in text.splitlines() if line.startswith("| ")]
        column = {line[0]: line[lines[0].index("x Eigen")] for line in lines[1:]}
        self.assertEqual(column, {"d, natural": "3", "d assembled, natural": "0.75", "d by Eigen, natural": "",
                                  "d by Eigen, shuffled": "", "e, natural": ""})

    def test_an_empty_report_says_so(self):
        self.assertEqual(table.show({"benchmarks": []}), "nothing was measured")


class Guard(unittest.TestCase):
    def test_slower_in_most_rounds_is_slower(self):
        row, slower = guard.verdict([(10, 11), (10, 10.8), (10, 11.2), (10, 9.9), (10, 11)], 5)
        self.assertTrue(slower)
        self.assertEqual(row[2], "1.100")

    def test_one_burst_of_noise_or_little_is_not(self):
        self.assertFalse(guard.verdict([(10, 10), (10, 30), (10, 9.9), (10, 10.1), (10, 10)], 5)[1])
        self.assertFalse(guard.verdict([(10, 10.4)] * 5, 5)[1])
        self.assertFalse(guard.verdict([], 5)[1])


class Growth(unittest.TestCase):
    def test_the_exponent_of_a_power(self):
        self.assertAlmostEqual(growth.slope([(10**d, 3 * 10**(1.5 * d)) for d in range(3, 8)]), 1.5)
        self.assertIsNone(growth.slope([(1e6, 1)]))

    def test_sizes_end_at_the_largest(self):
        self.assertEqual(growth.sizes(50000), [10000, 20000, 50000])
        self.assertEqual(growth.sizes(20000000)[-1], 20000000)

    def test_the_picture_has_a_curve_for_every_series(self):
        text = growth.picture({"one": [(1e4, 1), (1e5, 10)], "two": [(1e4, 2), (1e5, 25)]}, "ms")
        self.assertEqual(text.count("<circle"), 4)
        self.assertIn(">two</text>", text)


if __name__ == "__main__":
    unittest.main()
