#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every rule on a scene that breaks it and on the same scene without the breach.

    test_rules.py ROOT TENON

tests/check/scenes/RULE.usda gives findings of RULE alone, RULE.clean.usda none. Rules without
scenes stand in tests/check/rules_without_scenes.txt, each with its reason.
"""

import functools
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
SCENES = ROOT / "tests/check/scenes"
WITHOUT = ROOT / "tests/check/rules_without_scenes.txt"


def run(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


def check(path, *options):
    process = run("check", path, "--json", *options)
    if process.returncode not in (0, 1):
        raise AssertionError(f"{path}: exit {process.returncode}: {process.stdout[-2000:]}")
    return json.loads(process.stdout)


@functools.cache
def checked_scene(name):
    """-> exit code and findings of a scene, asked for once."""
    process = run("check", SCENES / f"{name}.usda", "--json")
    return process.returncode, json.loads(process.stdout)["diagnostics"]


def findings(name):
    return checked_scene(name)[1]


def rules_without_scenes():
    rows = [line.split(":", 1) for line in WITHOUT.read_text().splitlines()
            if line.strip() and not line.startswith("#")]
    return {rule.strip(): reason.strip() for rule, reason in rows}


LISTED = json.loads(run("check", "--list-rules", "--json").stdout)["rules"]
RULES = {row["rule"]: row for row in LISTED}
PLANTED = sorted(p.stem for p in SCENES.glob("*.usda") if not p.stem.endswith(".clean"))


class Rules(unittest.TestCase):
    def test_every_rule_has_a_scene_or_a_reason(self):
        without = rules_without_scenes()
        self.assertEqual(sorted(without.keys() & set(PLANTED)), [])
        self.assertEqual(sorted(without.keys() | set(PLANTED)), sorted(RULES))
        self.assertTrue(all(without.values()))

    def test_a_breach_gives_its_finding_alone(self):
        for rule in PLANTED:
            with self.subTest(rule):
                found = findings(rule)
                self.assertEqual({d["rule"] for d in found}, {rule},
                                 [(d["rule"], d["message"]) for d in found])
                self.assertEqual({d["severity"] for d in found}, {RULES[rule]["severity"]})

    def test_without_the_breach_nothing_is_found(self):
        for rule in PLANTED:
            with self.subTest(rule):
                found = findings(f"{rule}.clean")
                self.assertEqual([(d["rule"], d["message"]) for d in found], [])

    def test_a_finding_names_its_place_and_what_to_do(self):
        for rule in PLANTED:
            for finding in findings(rule):
                with self.subTest(rule):
                    self.assertTrue(finding["fix"], finding)
                    self.assertTrue(finding["line"], finding)
                    self.assertTrue((pathlib.Path.cwd() / finding["file"]).is_file(), finding)

    def test_the_exit_code_follows_the_severity(self):
        for rule in PLANTED:
            severity = RULES[rule]["severity"]
            self.assertEqual(checked_scene(rule)[0], int(severity == "error"), rule)
            strict = run("check", SCENES / f"{rule}.usda", "--strict").returncode
            self.assertEqual(strict, int(severity != "info"), rule)


class Fixes(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copytree(SCENES, self.folder / "scenes")

    def meaning(self, path):
        answer = json.loads(run("physics", path, "--json").stdout)
        for collider in answer["colliders"]:
            collider.pop("approximation", None)  # what was asked for; `shape` is what collides
        return {key: value for key, value in answer.items() if key not in ("diagnostics", "asset")}

    def fixable(self):
        rules = [rule for rule in PLANTED if RULES[rule]["autofix"]]
        self.assertGreater(len(rules), 15)
        return rules

    def test_a_fix_removes_the_finding_and_a_second_one_changes_nothing(self):
        for rule in self.fixable():
            with self.subTest(rule):
                scene = self.folder / "scenes" / f"{rule}.usda"
                before = scene.read_text()
                answer = check(scene, "--fix")
                self.assertEqual([d["message"] for d in answer["diagnostics"]], [])
                after = scene.read_text()
                self.assertNotEqual(before, after)
                self.assertIn("# A comment that fixes keep.", after)
                self.assertEqual(check(scene, "--fix")["corrected"], [])
                self.assertEqual(scene.read_text(), after)

    def test_a_fix_changes_few_lines_and_not_the_physics(self):
        for rule in self.fixable():
            with self.subTest(rule):
                scene = self.folder / "scenes" / f"{rule}.usda"
                old, meaning = scene.read_text().splitlines(), self.meaning(scene)
                check(scene, "--fix")
                new = scene.read_text().splitlines()
                self.assertLessEqual(len(set(new) - set(old)) + len(set(old) - set(new)), 6)
                if rule != "variant.physics-unselected":  # that one switches physics on
                    self.assertEqual(self.meaning(scene), meaning)

    def test_a_dry_run_prints_the_difference_and_writes_nothing(self):
        for rule in self.fixable():
            with self.subTest(rule):
                scene = self.folder / "scenes" / f"{rule}.usda"
                before = scene.read_text()
                diff = run("check", scene, "--fix", "--dry-run").stdout
                self.assertEqual(scene.read_text(), before)
                self.assertTrue(diff.startswith("--- a/"), diff)
                patched = self.folder / "patched.usda"
                patched.write_text(before)
                subprocess.run(["patch", "--silent", patched], input=diff, text=True, check=True)
                check(scene, "--fix")
                self.assertEqual(patched.read_text(), scene.read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
