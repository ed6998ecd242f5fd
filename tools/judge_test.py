#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What judge.py calls good: an end with 0 alone; how a row takes the place of an older one; and how
parts of the run on mutants add up."""

import json
import os
import sys
import tempfile
import unittest

import judge
import mutant_parts

DOCUMENT = """# T
<!-- judgements: made by tools/judge.py -->
| judgement | commit | date | minutes | good | result |
|---|---|---|---|---|---|
| labelled | abc | 2020-01-01 | 1 | yes | old |
| gone | abc | 2020-01-01 | 1 | yes | a judgement of former times |
<!-- end of judgements -->
rest
"""


def ended_with(status):
    words = f"print('all is said'); import sys; sys.exit({status})"
    return judge.run(judge.Judgement("labelled", [sys.executable, "-c", words]), "python", 1)


class Judging(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        judge.LOGS = self.folder.name

    def test_only_an_end_with_0_is_good(self):
        self.assertEqual(ended_with(0)[:2], (True, "all is said"))
        self.assertEqual(ended_with(1)[:2], (False, "all is said"))

    def test_a_skip_is_a_failure(self):
        self.assertEqual(ended_with(77)[:2], (False, "skipped: all is said"))

    def test_a_skipped_test_is_a_failure(self):
        path = os.path.join(self.folder.name, "log.txt")
        for tests, wanted in (("", ("100% tests passed, 0 tests failed out of 2", False)),
                              ("\t894 - a.test (Skipped)\n",
                               ("100% tests passed, 0 tests failed out of 2, skipped a.test",
                                True))):
            with open(path, "w", encoding="utf-8") as file:
                file.write("100% tests passed, 0 tests failed out of 2\n\nTotal\n" + tests)
            self.assertEqual(judge.result_of_tests(path), wanted)

    def test_a_program_that_is_not_there_is_a_failure(self):
        missing = judge.Judgement("labelled", ["/nowhere/at/all"])
        self.assertFalse(judge.run(missing, "python", 1)[0])

    def test_every_name_is_there_once(self):
        names = [judgement.name for judgement in judge.judgements()]
        self.assertEqual(len(names), len(set(names)))
        self.assertIn("mutants_release", names)
        self.assertIn("fuzz_text", names)

    def test_a_row_takes_the_place_of_the_older_one(self):
        self.addCleanup(setattr, judge, "DOCUMENT", judge.DOCUMENT)
        judge.DOCUMENT = os.path.join(self.folder.name, "T.md")
        with open(judge.DOCUMENT, "w", encoding="utf-8") as file:
            file.write(DOCUMENT)
        judge.write_row(judge.Judgement("labelled", []), "abc1234", False, "new", 2.4)
        with open(judge.DOCUMENT, encoding="utf-8") as file:
            text = file.read()
        self.assertRegex(text, r"\| labelled \| abc1234 \| \S+ \| 2 \| NO \| new \|\n<!-- end")
        self.assertNotIn("old", text)
        self.assertNotIn("gone", text)
        self.assertTrue(text.endswith("rest\n"))


def part(build, start, count=25000, findings=0):
    return mutant_parts.Part("2020-01-02", "abc", build, "0" * 16, 15, start, count, findings)


class Parts(unittest.TestCase):
    def test_the_sums_are_those_of_the_table(self):
        with open(judge.DOCUMENT, encoding="utf-8") as file:
            text = file.read()
        parts = mutant_parts.read_parts()
        self.assertEqual(text, mutant_parts.with_sums(text, parts),
                         "make it again: python3 tools/mutant_parts.py write")
        for i, one in enumerate(parts):
            self.assertFalse([other for other in parts[:i] if mutant_parts.overlap(one, other)])

    def test_a_run_goes_on_behind_the_last_part(self):
        parts = [part("release", 0, 50000), part("sanitizers", 550000)]
        self.assertEqual(mutant_parts.next_of(parts, "release", 25000), (100000, 25000))
        self.assertEqual(mutant_parts.next_of(parts, "sanitizers", 100), (575000, 100))

    def test_a_part_with_findings_is_run_again_and_replaced(self):
        parts = [part("release", 100000, findings=2), part("release", 125000)]
        self.assertEqual(mutant_parts.next_of(parts, "release", 100), (100000, 25000))
        parts = mutant_parts.added(parts, part("release", 100000))
        self.assertEqual([each.findings for each in parts], [0, 0])

    def test_no_number_counts_twice(self):
        parts = [part("release", 100000)]
        self.assertEqual(len(mutant_parts.added(parts, part("sanitizers", 100000))), 2)
        with self.assertRaisesRegex(ValueError, "from 100000 to 124999 already, of abc"):
            mutant_parts.added(parts, part("release", 124999, 10))

    def test_a_part_comes_from_what_tenon_mutants_writes(self):
        said = {"seed": 15, "from": 100000, "wanted": 25000, "runs": 25000, "sanitized": True,
                "seeds": "237bfaeeb6db068", "findings": 3}
        with tempfile.TemporaryDirectory() as folder:
            whole, broken = os.path.join(folder, "a.json"), os.path.join(folder, "b.json")
            for path, runs in ((whole, 25000), (broken, 24999)):
                with open(path, "w", encoding="utf-8") as file:
                    json.dump({**said, "runs": runs}, file)
            self.assertEqual(mutant_parts.part_of(whole, "abc", "2020-01-02"),
                             part("sanitizers", 100000, findings=3)._replace(
                                 seeds="0237bfaeeb6db068"))
            with self.assertRaisesRegex(ValueError, "24999 of 25000 mutants were run"):
                mutant_parts.part_of(broken, "abc", "2020-01-02")


if __name__ == "__main__":
    unittest.main()
