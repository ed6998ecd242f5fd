#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon tree --as`: links and joints as a tree, as tables, and as MuJoCo's bodies.

    test_tree_forms.py ROOT TENON

Numbers are held to those of `tenon physics --json`, the bodies to the model that `tenon convert`
writes for MuJoCo.
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(sys.argv[1]).resolve()
TENON = os.path.abspath(sys.argv[2])
sys.path[:0] = [str(ROOT / "tests/engines_beside")]

# pylint: disable=wrong-import-position
from author import body, joint, limit, scene

HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"


def link(name, at):
    return body(name, at, collides=False, mass=1.0, inertia=(0.1, 0.1, 0.1))


# A loop of four, a ball, a joint that slides and turns, a free body and one that stands.
MIXED = scene(
    link("A", (0, 0, 1)), link("B", (1, 0, 1)), link("C", (1, 1, 1)), link("D", (0, 1, 1)),
    link("Ball", (2, 0, 1)), link("Screw", (3, 0, 1)), link("Free", (9, 0, 1)),
    body("Given", (12, 0, 1), mass=1.0, lines=["bool physics:kinematicEnabled = 1"]),
    joint("fixed", "j0", None, "/World/A", pos0=(0, 0, 1)),
    joint("revolute", "j1", "/World/A", "/World/B", pos0=(1, 0, 0), axis="Z", limits=(-30, 60)),
    joint("revolute", "j2", "/World/B", "/World/C", pos0=(0, 1, 0), axis="Z"),
    joint("revolute", "j3", "/World/C", "/World/D", pos0=(-1, 0, 0), axis="Z"),
    joint("revolute", "j4", "/World/D", "/World/A", pos0=(0, -1, 0), axis="Z"),
    joint("spherical", "j5", "/World/B", "/World/Ball", pos0=(1, 0, 0)),
    joint("d6", "j6", "/World/Ball", "/World/Screw", pos0=(1, 0, 0),
          parts=[limit("transX", -0.1, 0.2), limit("transY", 1, -1), limit("transZ", 1, -1),
                 limit("rotX", -90, 90), limit("rotY", 1, -1), limit("rotZ", 1, -1)]),
    articulated=True)


class Forms(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.mixed = self.folder / "mixed.usda"
        self.mixed.write_text(MIXED)

    def tenon(self, *words, code=0):
        done = subprocess.run([TENON, *map(str, words)], capture_output=True, text=True,
                              check=False, timeout=60)
        self.assertEqual(done.returncode, code, done.stdout[-1000:] + done.stderr[-1000:])
        return done.stdout

    def tree(self, asset, form):
        answer = json.loads(self.tenon("tree", asset, "--as", form, "--json"))
        self.assertEqual(answer["as"], form)
        return answer

    def physics(self, asset):
        return json.loads(self.tenon("physics", asset, "--json"))

    def test_flat_has_all(self):
        for asset in (HAND, self.mixed):
            flat, physics = self.tree(asset, "flat"), self.physics(asset)
            self.assertEqual([row["link"] for row in flat["links"]],
                             [row["path"] for row in physics["bodies"]])
            self.assertEqual([row["mass_kg"] for row in flat["links"]],
                             [row["mass"] for row in physics["bodies"]])
            self.assertEqual([(row["joint"], row["type"]) for row in flat["joints"]],
                             [(row["path"], row["type"]) for row in physics["joints"]])

    def test_articulation_is_a_tree_of_all_links(self):
        for asset in (HAND, self.mixed):
            rows = self.tree(asset, "articulation")["rows"]
            flat = {row["link"]: row["parent"] for row in self.tree(asset, "flat")["links"]}
            self.assertEqual(sorted(flat), sorted(row["link"] for row in rows))
            way = []
            for row in rows:
                del way[row["depth"]:]
                self.assertEqual(flat[row["link"]], way[-1] if way else None)
                way.append(row["link"])
                if row["joint"]:
                    self.assertIn(row["link"], (row["joint"]["body0"], row["joint"]["body1"]))

    def test_loops_bounds_and_mimics(self):
        answer = self.tree(self.mixed, "articulation")
        [loop] = answer["loops"]
        self.assertEqual((loop["role"], loop["type"]), ("loop", "revolute"))
        joints = {row["joint"].rsplit("/", 1)[1]: row
                  for row in self.tree(self.mixed, "flat")["joints"]}
        [turn] = joints["j1"]["dofs"]
        self.assertEqual((round(turn["lower"], 4), round(turn["upper"], 4), turn["unit"]),
                         (-30, 60, "deg"))
        slide, twist = joints["j6"]["dofs"]
        self.assertEqual((slide["dof"], slide["unit"], twist["dof"]), ("transX", "m", "rotX"))
        self.assertTrue(math.isclose(slide["upper"], 0.2, rel_tol=1e-6))
        self.assertEqual(len(joints["j5"]["dofs"]), 3)
        hand = {row["joint"]: row for row in self.tree(HAND, "flat")["joints"]}
        physics = self.physics(HAND)
        for joint_row in physics["joints"]:
            told = hand[joint_row["path"]]["follows"]
            self.assertEqual([(one["leader"], one["multiplier"]) for one in joint_row["mimics"]],
                             [(one["leader"], one["multiplier"]) for one in told])
        self.assertTrue(any(row["follows"] for row in hand.values()))
        [whole] = answer["articulations"]
        self.assertTrue(whole["fixedBase"])

    def written(self, asset):
        """Bodies of the model for MuJoCo: (name, parent) -> types of joints."""
        model = self.folder / "model.xml"
        self.tenon("convert", asset, model, "--force")
        found = {}

        def walk(element, parent):
            for child in element.findall("body"):
                kinds = [one.get("type", "hinge") for one in child.findall("joint")]
                kinds += ["freejoint"] * len(child.findall("freejoint"))
                found[child.get("name"), parent] = sorted(
                    "freejoint" if kind == "free" else kind for kind in kinds)
                walk(child, child.get("name"))
        walk(xml.etree.ElementTree.parse(model).getroot().find("worldbody"), None)
        return found

    def test_bodies_are_those_of_the_model(self):
        for asset in (HAND, self.mixed):
            way, bodies = [], {}
            for row in self.tree(asset, "mujoco")["bodies"]:
                name = row["body"].rsplit("/", 1)[1]
                del way[row["depth"]:]
                kinds = [one["type"] for one in row["joints"]]
                bodies[name, way[-1] if way else None] = sorted(
                    kinds or (["freejoint"] if row["base"] == "free" else []))
                way.append(name)
            self.assertEqual(bodies, self.written(asset))

    def test_text(self):
        for form in ("articulation", "flat", "mujoco"):
            text = self.tenon("tree", self.mixed, "--as", form)
            for name in ("Screw", "Free", "Given", "j1", "j6"):
                self.assertIn(name, text, form)
        text = self.tenon("tree", self.mixed, "--as", "articulation")
        self.assertIn("`-- (j1: revolute, -30..60 deg) B  1 kg", text.replace("|-- (j1", "`-- (j1"))
        self.assertIn("loop  (", text)
        self.assertIn("Free  1 kg  (free)", text)
        self.assertIn("Given  1 kg  (kinematic)", text)

    def test_not_with_others(self):
        for words in (("--show", "physics"), ("-a",), ("-m",)):
            self.tenon("tree", self.mixed, "--as", "flat", *words, code=2)

    def test_long_chain(self):
        """A chain of 2,000 links is printed and written as JSON."""
        count = 2000
        links = [body(f"L{i}", (i, 0, 1), collides=False, mass=1.0, inertia=(0.1, 0.1, 0.1))
                 for i in range(count)]
        joints = [joint("revolute", f"j{i}", f"/World/L{i}", f"/World/L{i + 1}", pos0=(1, 0, 0),
                        axis="Z") for i in range(count - 1)]
        path = self.folder / "chain.usda"
        path.write_text(scene(*links, *joints, articulated=True))
        rows = self.tree(path, "articulation")["rows"]
        self.assertEqual(len(rows), count)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
