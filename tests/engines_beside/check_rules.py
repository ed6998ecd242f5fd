#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What tells of the scenes without another engine: which rules speak on them, and the page.

    check_rules.py ROOT TENON

On each scene `tenon check --for` the engine names the rule of its row and no other of the family
portability, on one without a difference none; each has its line in docs/beside-other-engines.md.
"""

import pathlib
import sys
import tempfile
import unittest

import beside
import table
from row import NEWTON, OVPHYSX

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
LEAST = {OVPHYSX: (60, 40), NEWTON: (30, 20)}  # scenes, and equal ones


class Scenes(unittest.TestCase):
    def test_names_are_there_once(self):
        names = [row.name for row in table.rows()]
        self.assertEqual(len(names), len(set(names)))

    def test_there_are_enough(self):
        for engine, (scenes, equal) in LEAST.items():
            rows = [row for row in table.rows() if engine in row.engines]
            self.assertGreaterEqual(len(rows), scenes)
            self.assertGreaterEqual(sum(engine not in row.differs for row in rows), equal)

    def test_rules_speak_where_a_row_says_so(self):
        for engine in LEAST:
            with tempfile.TemporaryDirectory() as folder:
                cases, plain = beside.all_cases(engine, folder, None)
                beside.rules_of(TENON, engine, cases + plain)
            for case in cases + plain:
                wanted = {case.difference.rule} if case.expects_difference() else set()
                with self.subTest(f"{engine} {case.name}"):
                    self.assertEqual(set(case.rules), wanted)

    def test_the_page_has_each(self):
        page = (ROOT / "docs/beside-other-engines.md").read_text(encoding="utf-8")
        for engine in LEAST:
            part = page.split(f"<!-- {engine}: ")[1].split(f"<!-- end of {engine} -->")[0]
            for row in table.rows():
                if engine in row.engines:
                    named = row.shows if engine in row.differs else row.name
                    self.assertIn(f"| {named} |", part)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
