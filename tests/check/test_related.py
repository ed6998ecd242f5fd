#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a finding is about is in fields: each prim that a message or a fix names is the finding's
own or in `related`, for every rule with a planted scene, in JSON and SARIF.

    test_related.py ROOT TENON
"""

import json
import pathlib
import re
import sys
import tempfile
import unittest

import sarif_rules
from planted import PLANTED, ROOT, SCENES, findings, options_of, run

NAMED = re.compile(r"(?:@([^@]*)@)?<(/[^>]*)>")
ROLES = {"prim", "body", "collider", "joint", "articulation", "material", "scene",
         "collisionGroup", "property", "target"}
KEYS = {"path", "role", "file", "line", "column"}


def named_in(finding):
    """-> (file or "", path) of all that the texts of a finding name."""
    return {found for text in (finding["message"], finding["fix"] or "")
            for found in NAMED.findall(text)}


def missing_in(finding):
    """-> what the texts name and no field holds."""
    own = {finding["prim"], f'{finding["prim"]}.{finding["property"]}'}
    related = {row["path"] for row in finding["related"]}
    return {path for _, path in named_in(finding)} - own - related


class Related(unittest.TestCase):
    def test_each_prim_in_a_text_is_a_field(self):
        rules_with_some = 0
        for rule in PLANTED:
            rules_with_some += any(finding["related"] for finding in findings(rule))
            for finding in findings(rule):
                with self.subTest(rule, message=finding["message"]):
                    self.assertEqual(missing_in(finding), set())
        self.assertGreaterEqual(rules_with_some, 40)  # the test would notice if none had any

    def test_so_for_verbs_that_read_the_physics(self):
        for verb in ("physics", "info"):
            for rule in PLANTED:
                answer = json.loads(run(verb, SCENES / f"{rule}.usda", "--json").stdout)
                for finding in answer["diagnostics"]:
                    with self.subTest(verb, rule=rule, message=finding["message"]):
                        self.assertEqual(missing_in(finding), set())

    def test_a_row_has_its_keys_and_its_place(self):
        placed = 0
        for rule in PLANTED:
            for row in (row for finding in findings(rule) for row in finding["related"]):
                with self.subTest(rule, row=row):
                    self.assertEqual(set(row), KEYS)
                    self.assertIn(row["role"], ROLES)
                    self.assertTrue(row["path"].startswith("/"))
                    if row["line"]:
                        placed += 1
                        name = re.split(r"[/.]", row["path"])[-1]
                        line = pathlib.Path(row["file"]).read_text().splitlines()[row["line"] - 1]
                        self.assertIn(name, line)
        self.assertGreater(placed, 40)

    def test_colliders_that_overlap_are_named_with_their_bodies(self):
        for finding in findings("collider.overlap-at-start"):
            roles = [row["role"] for row in finding["related"]]
            self.assertEqual(roles[0], "collider")
            self.assertIn(roles[1:], (["body"], ["body", "body"]))
            self.assertNotEqual(finding["related"][0]["path"], finding["prim"])

    def test_a_target_in_another_layer_names_the_layer(self):
        rows = [row for finding in findings("compose.unresolved-prim-path")
                for row in finding["related"]]
        self.assertTrue(rows)
        for row in rows:
            self.assertTrue(pathlib.Path(row["file"]).is_file(), row)

    def test_sarif_has_the_same_as_related_locations(self):
        compared = 0
        for rule in PLANTED:
            if not any(finding["related"] for finding in findings(rule)):
                continue
            scene = SCENES / f"{rule}.usda"
            log = json.loads(run("check", scene, *options_of(scene), "--sarif", "-").stdout)
            self.assertEqual(sarif_rules.faults(log), [], rule)
            results = log["runs"][0]["results"]
            self.assertEqual(len(results), len(findings(rule)), rule)
            for finding, result in zip(findings(rule), results):
                places = [(place["logicalLocations"][0]["fullyQualifiedName"],
                           place["message"]["text"]) for place in
                          result.get("relatedLocations", [])]
                compared += len(places)
                self.assertEqual(places, [(r["path"], r["role"]) for r in finding["related"]])
        self.assertGreater(compared, 40)


class OtherVerbs(unittest.TestCase):
    def test_an_edit_that_is_refused_names_the_other_prim(self):
        with tempfile.TemporaryDirectory() as folder:
            asset = pathlib.Path(folder) / "a.usda"
            asset.write_text('#usda 1.0\ndef "A" (references = </B>)\n{\n}\ndef "B"\n{\n}\n')
            for words in (("rename", "/B", "A"), ("remove", "/B")):
                process = run(words[0], asset, *words[1:], "--json")
                self.assertEqual(process.returncode, 2, process.stdout)
                finding = json.loads(process.stdout)["diagnostics"][0]
                self.assertEqual(missing_in(finding), set())
                self.assertEqual([row["path"] for row in finding["related"]], ["/A"])

    def test_findings_of_conversion_have_the_field(self):
        robots = sorted((ROOT / "tests/convert/urdf").glob("**/*.urdf"))[:20]
        self.assertTrue(robots)
        for robot in robots:
            with tempfile.TemporaryDirectory() as folder:
                answer = json.loads(run("convert", robot, f"{folder}/out", "--json").stdout)
            for finding in answer["diagnostics"]:
                self.assertEqual(missing_in(finding), set(), robot)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
