#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What judge.py calls good: an end with 0 alone; and how a row takes the place of an older one."""

import os
import sys
import tempfile
import unittest

import judge

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


if __name__ == "__main__":
    unittest.main()
