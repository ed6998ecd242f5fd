#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What makes instructions.py fail, and that it counts the same twice."""

import contextlib
import io
import shutil
import sys
import tempfile
import unittest

import command_rows
import instructions


def grown(recorded, counts):
    with contextlib.redirect_stdout(io.StringIO()):
        return instructions.compare(recorded, counts)


class Growth(unittest.TestCase):
    def test_six_percent_more_fails_and_four_do_not(self):
        self.assertEqual(grown({"a": 100, "b": 100}, {"a": 106, "b": 104}), ["a"])

    def test_fewer_do_not_fail(self):
        self.assertEqual(grown({"a": 100}, {"a": 50}), [])

    def test_a_row_that_is_not_recorded_fails(self):
        self.assertEqual(grown({}, {"a": 1}), ["a"])


class Counts(unittest.TestCase):
    @unittest.skipIf(shutil.which("valgrind") is None, "no valgrind here")
    def test_two_runs_count_the_same(self):
        before = ["setarch", "-R"] if command_rows.has_setarch() else []
        with tempfile.TemporaryDirectory() as work:
            command_rows.ROWS["words"] = "one two three"
            found = [command_rows.count_instructions("words", "/bin/echo", work, before)
                     for _ in range(2)]
        self.assertEqual(found[0], found[1])


if __name__ == "__main__":
    sys.exit(unittest.main())
