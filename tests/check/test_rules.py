#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every rule on a scene that breaks it and on the same scene without the breach.

    test_rules.py ROOT TENON

tests/check/scenes/RULE.usda gives findings of RULE alone, RULE.clean.usda none, each checked with
the options that a line `# tenon check OPTIONS` in it names. Rules without
scenes stand in tests/check/rules_without_scenes.txt, each with its reason.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from planted import PLANTED, ROOT, RULES, SCENES, check, findings, options_of, run

WITHOUT = ROOT / "tests/check/rules_without_scenes.txt"


def rules_without_scenes():
    rows = [line.split(":", 1) for line in WITHOUT.read_text().splitlines()
            if line.strip() and not line.startswith("#")]
    return {rule.strip(): reason.strip() for rule, reason in rows}


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
        for severity, plain, strict in (("error", 1, 1), ("warning", 0, 1), ("info", 0, 0)):
            scenes = [SCENES / f"{rule}.usda" for rule in PLANTED
                      if RULES[rule]["severity"] == severity]
            scenes = [scene for scene in scenes if not options_of(scene)]
            for chosen in ([scenes[0]], [scenes[-1]], scenes):
                self.assertEqual(run("check", *chosen).returncode, plain, severity)
                self.assertEqual(run("check", "--strict", *chosen).returncode, strict, severity)


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

    def scenes(self):
        """-> the scenes of rules with a fix, by rule, in a folder that may be written to."""
        return {rule: self.folder / "scenes" / f"{rule}.usda" for rule in self.fixable()}

    def test_a_fix_removes_the_finding_and_a_second_one_changes_nothing(self):
        scenes = self.scenes()
        before = {rule: scene.read_text() for rule, scene in scenes.items()}
        answer = check(*scenes.values(), "--fix")
        self.assertEqual([(d["file"], d["message"]) for d in answer["diagnostics"]], [])
        after = {rule: scene.read_text() for rule, scene in scenes.items()}
        for rule, text in after.items():
            with self.subTest(rule):
                self.assertNotEqual(before[rule], text)
                self.assertIn("# A comment that fixes keep.", text)
        self.assertEqual(check(*scenes.values(), "--fix")["corrected"], [])
        self.assertEqual({rule: scene.read_text() for rule, scene in scenes.items()}, after)

    def test_a_fix_changes_few_lines_and_not_the_physics(self):
        scenes = self.scenes()
        before = {rule: (scene.read_text().splitlines(), self.meaning(scene))
                  for rule, scene in scenes.items()}
        check(*scenes.values(), "--fix")
        for rule, scene in scenes.items():
            with self.subTest(rule):
                old, meaning = before[rule]
                new = scene.read_text().splitlines()
                self.assertLessEqual(len(set(new) - set(old)) + len(set(old) - set(new)), 6)
                if rule != "variant.physics-unselected":  # that one switches physics on
                    self.assertEqual(self.meaning(scene), meaning)

    def suggested(self):
        """-> scenes of rules that suggest a name or type, by rule."""
        rules = [rule for rule in PLANTED if RULES[rule]["suggestedFix"]]
        self.assertGreaterEqual(len(rules), 3)
        return {rule: self.folder / "scenes" / f"{rule}.usda" for rule in rules}

    def test_suggestions_are_made_where_they_are_asked_for_and_remove_the_finding(self):
        for rule, scene in self.suggested().items():
            with self.subTest(rule):
                before = scene.read_text()
                found = [d for d in check(scene)["diagnostics"] if d["rule"] == rule]
                self.assertTrue(found and all(d["suggestedFix"] for d in found), found)
                self.assertEqual(check(scene)["summary"]["suggested"], len(found))
                check(scene, "--fix")
                self.assertEqual(scene.read_text(), before)
                answer = check(scene, "--fix", "--suggested")
                self.assertNotIn(rule, [d["rule"] for d in answer["diagnostics"]])
                text = scene.read_text()
                self.assertIn("# A comment that fixes keep.", text)
                self.assertEqual(len(set(text.splitlines()) - set(before.splitlines())),
                                 len(found))
                again = check(scene, "--fix", "--suggested")
                self.assertEqual(again["corrected"], [])

    def test_a_suggested_name_comes_with_the_type_of_the_schema(self):
        scene = self.folder / "named.usda"
        scene.write_text('''#usda 1.0
(
    defaultPrim = "m"
)

def Material "m" (
    prepend apiSchemas = ["PhysicsMaterialAPI"]
)
{
    double density = 10.5
    int restitution = 1
    double dynamicFriction.timeSamples = {
        0: 0.5,
    }
}
''')
        rule = "attribute.unprefixed"
        found = [d for d in check(scene)["diagnostics"] if d["rule"] == rule]
        self.assertEqual([d["suggestedFix"] for d in found],
                         ["rename density to physics:density of type float",
                          "rename restitution to physics:restitution of type float", None])
        answer = check(scene, "--fix", "--suggested")
        self.assertEqual([d["rule"] for d in answer["diagnostics"]], [rule])
        text = scene.read_text()
        self.assertIn("    float physics:density = 10.5\n", text)
        self.assertIn("    float physics:restitution = 1\n", text)
        self.assertIn("    double dynamicFriction.timeSamples", text)

    def test_a_suggested_name_keeps_a_type_that_differs_by_its_role_alone(self):
        scene = self.folder / "light.usda"
        scene.write_text('''#usda 1.0
def SphereLight "l"
{
    float3 color = (1, 0.5, 0)
}
''')
        found = [d["suggestedFix"] for d in check(scene)["diagnostics"]
                 if d["rule"] == "attribute.moved-input"]
        self.assertEqual(found, ["rename color to inputs:color"])
        check(scene, "--fix", "--suggested")
        self.assertIn("    float3 inputs:color = (1, 0.5, 0)\n", scene.read_text())

    def test_suggestions_need_fix(self):
        scene = next(iter(self.suggested().values()))
        done = run("check", scene, "--suggested")
        self.assertEqual(done.returncode, 2)
        self.assertIn("add --fix", done.stderr)

    def test_a_dry_run_prints_the_difference_and_writes_nothing(self):
        scenes = self.scenes()
        before = {rule: scene.read_text() for rule, scene in scenes.items()}
        printed = run("check", next(iter(scenes.values())), "--fix", "--dry-run").stdout
        self.assertTrue(printed.startswith("--- a/"), printed)
        answer = check(*scenes.values(), "--fix", "--dry-run")
        diffs = {pathlib.Path(row["file"]).stem: row["diff"] for row in answer["wouldCorrect"]}
        self.assertEqual({rule: scene.read_text() for rule, scene in scenes.items()}, before)
        self.assertEqual(sorted(diffs), sorted(scenes))
        check(*scenes.values(), "--fix")
        patched = self.folder / "patched.usda"
        for rule, diff in diffs.items():
            with self.subTest(rule):
                patched.write_text(before[rule])
                subprocess.run(["patch", "--silent", patched], input=diff, text=True, check=True)
                self.assertEqual(patched.read_text(), scenes[rule].read_text())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
