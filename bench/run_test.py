#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The arithmetic of run.py: medians, counts that must agree, and what makes a run fail."""

import argparse
import sys
import unittest

import machine
import run


def lap(phase, *wall):
    return {"workload": "w", "phase": phase, "wall": list(wall), "cpu": [0.5 * w for w in wall]}


def bench():
    arguments = argparse.Namespace(build="/nowhere", smoke=False, rounds=1, clock="wall")
    return run.Bench(arguments)


class Medians(unittest.TestCase):
    def test_median_over_rounds_of_the_median_of_a_round(self):
        figures = run.Figures()
        figures.add([lap("parse", 9, 1, 2)])   # 2
        figures.add([lap("parse", 5, 5, 90)])  # 5
        figures.add([lap("parse", 3)])         # 3
        self.assertEqual(figures.median("parse", "wall"), 3)
        self.assertEqual(figures.median("parse", "cpu"), 1.5)
        self.assertIsNone(figures.median("compose", "wall"))

    def test_peak_memory_is_the_largest(self):
        figures = run.Figures()
        figures.add([{"workload": "w", "peak_rss_mb": 80}])
        figures.add([{"workload": "w", "peak_rss_mb": 70}])
        self.assertEqual(figures.peak, 80)


class Failures(unittest.TestCase):
    def test_counts_must_agree_where_both_count(self):
        subject = bench()
        subject.compare_counts("w", {"prims": 3, "own": 1}, {"prims": 3})
        self.assertEqual(subject.failures, [])
        subject.compare_counts("w", {"prims": 3}, {"prims": 4})
        self.assertEqual(subject.failures, ["w: prims: tenon 3, usd-core 4"])

    def test_a_program_that_fails_is_a_failure_with_its_words(self):
        words = "import sys; print('why'); sys.exit(3)"
        with self.assertRaisesRegex(run.Failure, "exit 3\nwhy"):
            run.run_lines([sys.executable, "-c", words])

    def test_talk_between_the_json_lines_is_ignored(self):
        words = "print('hello'); print('{\"count\": \"prims\", \"value\": 3}')"
        lines = run.run_lines([sys.executable, "-c", words])
        self.assertEqual(lines, [{"count": "prims", "value": 3}])


class Machine(unittest.TestCase):
    def test_the_processor_has_a_name(self):
        self.assertTrue(machine.cpu_model().strip())


if __name__ == "__main__":
    unittest.main()
