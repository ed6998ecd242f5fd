#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of what the suites share: lists of misses, records, and the table made from them."""

import contextlib
import io
import os
import tempfile
import unittest

import make_table
import suite

DOCUMENT = """# Title
<!-- figures: made by x -->
| what | equal | of | suite |
|---|---|---|---|
| a layer | 1 | 2 | one |
| kept | 5 | 5 | other |
<!-- end of figures -->
between
<!-- misses: made by x -->
| case | reason | suite |
|---|---|---|
| b | old | one |
<!-- end of misses -->
"""


class Suite(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        os.environ["TENON_MEASURED_DIR"] = self.folder
        self.addCleanup(os.environ.pop, "TENON_MEASURED_DIR")

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def finish(self, results):
        with contextlib.redirect_stdout(io.StringIO()) as out:
            code = results.finish()
        return code, out.getvalue()

    def test_reasons_stand_behind_or_above(self):
        path = self.write("misses.txt", "# head\n\n# why\n# so\na b\nc | own\n\nd # too\ne\n")
        self.assertEqual(suite.read_misses(path),
                         {"a b": "why so", "c": "own", "d": "too", "e": ""})

    def test_a_new_difference_fails(self):
        results = suite.Results("one", self.write("misses.txt", "b | known\n"))
        results.add("row", "a", "differs")
        results.add("row", "b", "differs")
        code, out = self.finish(results)
        self.assertEqual(code, 1)
        self.assertIn("MISS a: differs", out)
        self.assertNotIn("MISS b", out)

    def test_a_listed_miss_that_is_equal_fails(self):
        results = suite.Results("one", self.write("misses.txt", "b | known\nnot run | known\n"))
        results.add("row", "b", None)
        code, out = self.finish(results)
        self.assertEqual(code, 1)
        self.assertIn("FIXED b", out)
        self.assertNotIn("not run", out)

    def test_records_become_rows(self):
        results = suite.Results("one", self.write("misses.txt", "b | known\n"))
        for name, difference in (("a", None), ("b", "differs"), ("c", None)):
            results.add("a layer", name, difference)
        self.assertEqual(self.finish(results)[0], 0)
        text = make_table.with_measured(DOCUMENT, make_table.read_records(self.folder))
        self.assertIn("| a layer | 2 | 3 | one |\n| kept | 5 | 5 | other |\n", text)
        self.assertIn("| b | known | one |\n", text)
        self.assertNotIn("old", text)
        self.assertEqual(make_table.with_measured(text, {}), text)

    def test_a_suite_that_starts_forgets_its_record(self):
        suite.record("one", [("row", 1, 1)])
        suite.Results("one")
        self.assertEqual(make_table.read_records(self.folder), {})


if __name__ == "__main__":
    unittest.main()
