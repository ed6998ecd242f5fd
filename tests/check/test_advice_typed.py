#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The advice of each rule, typed on its planted scene: the finding is gone.

    test_advice_typed.py ROOT TENON

A rule is corrected by `tenon check --fix` (test_rules.py does so), by the commands of
advice_typed.txt, or by hand: advice_by_hand.txt names these with the reason, and may only shrink.
"""

import pathlib
import re
import shlex
import shutil
import sys
import tempfile
import unittest

from planted import PLANTED, ROOT, RULES, SCENES, check, options_of, run

TYPED = ROOT / "tests/check/advice_typed.txt"
BY_HAND = ROOT / "tests/check/advice_by_hand.txt"
BY_HAND_AT_MOST = 57
ROUNDS = 4  # of advice, where a scene gives several findings


def rows(path, columns):
    """-> by rule, what a table says behind it."""
    found = {}
    for line in path.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            rule, *rest = (part.strip() for part in line.split("|", columns - 1))
            assert len(rest) == columns - 1 and rule not in found, line
            found[rule] = rest
    return found


def filled(command, finding):
    """-> the command with the fields of a finding in it."""
    def field(match):
        name = match.group(1)
        if name in ("prim", "property"):
            return finding[name]
        if name == "last":
            return finding["fix"].split()[-1]
        return next(row["path"] for row in finding["related"] if row["role"] == name)
    return re.sub(r"\{(\w+)\}", field, command)


class Typed(unittest.TestCase):
    def setUp(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        self.scenes = folder / "scenes"
        shutil.copytree(SCENES, self.scenes)

    def findings(self, rule, options):
        return [finding for finding in check(self.scenes / f"{rule}.usda", *options)["diagnostics"]
                if finding["rule"] == rule or finding["severity"] == "error"]

    def follow(self, rule, words, commands, options):
        scene = self.scenes / f"{rule}.usda"
        found = self.findings(rule, options)
        self.assertTrue(found)
        for _ in range(ROUNDS):
            self.assertIn(words, found[0]["fix"])
            for command in commands.split(";"):
                typed = [str(scene) if word == "S" else word
                         for word in shlex.split(filled(command, found[0]))]
                process = run(*typed)
                self.assertEqual(process.returncode, 0, f"{command}: {process.stderr}")
            found = self.findings(rule, options)
            if not found:
                return
        self.fail([finding["message"] for finding in found])

    def test_each_rule_is_in_one_table(self):
        typed, by_hand = rows(TYPED, 3), rows(BY_HAND, 2)
        fixed = {rule for rule in PLANTED if RULES[rule]["autofix"]}
        self.assertEqual(sorted(typed.keys() & by_hand.keys()), [])
        self.assertEqual(sorted(fixed & by_hand.keys()), [])
        self.assertEqual(sorted(typed.keys() | by_hand.keys() | fixed), PLANTED)
        self.assertLessEqual(len(by_hand), BY_HAND_AT_MOST)
        self.assertTrue(all(reason for (reason,) in by_hand.values()))

    def test_typed_advice_removes_the_finding(self):
        for rule, (words, commands) in rows(TYPED, 3).items():
            before = (self.scenes / f"{rule}.usda").read_text()
            for engine in RULES[rule]["engines"] or [None]:
                with self.subTest(rule, engine=engine):
                    (self.scenes / f"{rule}.usda").write_text(before)
                    options = options_of(SCENES / f"{rule}.usda")
                    if engine:
                        options[options.index("--for") + 1] = engine
                    self.follow(rule, words, commands, options)


class Pages(unittest.TestCase):
    """What the page of a rule shows to type is typed, on the planted scene of the rule."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.scenes = self.folder / "scenes"  # copies: `tenon set` and `tenon add` write in place
        shutil.copytree(SCENES, self.scenes)

    def typed(self, code, scene):
        """-> the words of a command of a page on a scene; none where it shows a word alone."""
        if re.match(r"--(reading|skip) ", code):
            return ["check", scene, *code.split()]
        words = code.split()[1:] if code.startswith("tenon ") else []
        names = {"FILE": scene, "A": scene, "A.usdz": self.folder / "a.usdz"}
        return [names.get(word, word) for word in words] if len(words) > 1 else []

    def test_each_command_of_a_page_runs(self):
        ran = 0
        for page in sorted((ROOT / "docs/rules").glob("*.md")):
            scene = self.scenes / f"{page.stem}.usda"
            scene = scene if scene.is_file() else self.scenes / "mass.zero.usda"
            for code in re.findall(r"`([^`\n]+)`", page.read_text()):
                words = self.typed(code, scene) if page.stem != "README" else []
                if words:
                    ran += 1
                    with self.subTest(page.name, code=code):
                        process = run(*words)
                        self.assertIn(process.returncode, (0, 1), process.stderr)
        self.assertGreaterEqual(ran, 5)

    def test_what_a_page_says_to_skip_is_skipped(self):
        found = check(SCENES / "scene.missing.usda", "--skip", "scene.missing")["diagnostics"]
        self.assertEqual(found, [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
