#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Which outcomes of random scenes are good: those that differ are listed, those listed differ."""

import contextlib
import io
import os
import tempfile
import unittest

import scene_outcomes


class Holding(unittest.TestCase):
    def hold(self, outcomes, misses):
        """-> (listed, is good), what was printed"""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "misses.txt")
            with open(path, "w", encoding="utf-8") as file:
                file.write("# Scenes\n" + misses)
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                result = scene_outcomes.hold_to_misses(outcomes, path)
        return result, printed.getvalue()

    def test_what_differs_and_is_listed_is_good(self):
        held = self.hold({1: "equal", 2: "differs"}, "scene 2 | a reason\n")
        self.assertEqual(held, ((1, True), ""))

    def test_what_differs_and_is_not_listed_is_bad(self):
        held = self.hold({1: "differs", 2: "differs"}, "scene 2 | a reason\n")
        self.assertEqual(held, ((1, False), "MISS scene 1\n"))

    def test_what_is_listed_and_equal_is_bad(self):
        held = self.hold({1: "equal"}, "scene 1 | a reason\n")
        self.assertEqual(held, ((0, False), "FIXED scene 1: remove it from misses.txt\n"))

    def test_what_was_not_judged_says_nothing(self):
        held = self.hold({1: "slow", 2: "died", 3: "equal"},
                         "scene 1 | a reason\nscene 2 | a reason\nscene 9000 | a reason\n")
        self.assertEqual(held, ((0, True), ""))

    def test_without_a_list_nothing_may_differ(self):
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(scene_outcomes.hold_to_misses({1: "equal"}, None), (0, True))
            self.assertEqual(scene_outcomes.hold_to_misses({1: "differs"}, None), (0, False))


if __name__ == "__main__":
    unittest.main()
