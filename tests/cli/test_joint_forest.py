#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A four-bar linkage is cut at one joint, whoever shows, exports or simulates it.

    test_joint_forest.py TENON
"""

import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

TENON = os.path.abspath(sys.argv[1])
BARS = {"A": (0, 0, 0), "B": (1, 0, 0), "C": (1, 1, 0), "D": (0, 1, 0)}
RING = {"j1": ("A", "B"), "j2": ("B", "C"), "j3": ("C", "D"), "j4": ("D", "A")}

BAR = """
    def Cube "{name}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {{
        double size = 0.1
        float physics:mass = 1
        double3 xformOp:translate = {place}
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
"""
JOINT = """
    def Physics{kind}Joint "{name}"
    {{
        {side0}
        rel physics:body1 = </Bar/{body1}>
        point3f physics:localPos1 = {anchor}
        uniform token physics:axis = "Z"
        {more}
    }}
"""


def joint(name, excluded, driven):
    body0, body1 = RING[name]
    anchor = tuple(a - b for a, b in zip(BARS[body0], BARS[body1]))
    more = "bool physics:excludeFromArticulation = 1" if name == excluded else ""
    if name in driven:
        more += "\n        float physics:lowerLimit = -80\n        float physics:upperLimit = 80"
    return JOINT.format(kind="Revolute", name=name, side0=f"rel physics:body0 = </Bar/{body0}>",
                        body1=body1, anchor=anchor, more=more)


def four_bar(order, excluded=None, articulated=True, fixed=True, driven=()):
    """The bars, then the joints in the order in which the stage is to come to them."""
    root = 'prepend apiSchemas = ["PhysicsArticulationRootAPI"]' if articulated else ""
    base = JOINT.format(kind="Fixed", name="j0", side0="", body1="A", anchor=(0, 0, 0), more="")
    return ('#usda 1.0\n(\n    defaultPrim = "Bar"\n    metersPerUnit = 1\n'
            '    kilogramsPerUnit = 1\n    upAxis = "Z"\n)\n\n'
            f'def Xform "Bar" (\n    {root}\n)\n{{\n'
            '    def PhysicsScene "Scene"\n    {\n    }\n' +
            "".join(BAR.format(name=name, place=place) for name, place in BARS.items()) +
            (base if fixed else "") + "".join(joint(name, excluded, driven) for name in order) +
            "}\n")


class FourBar(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.asset = self.folder / "bar.usda"

    def tenon(self, *arguments):
        process = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                                 check=False)
        self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
        return process.stdout

    def convert(self, name):
        target = self.folder / name
        self.tenon("convert", self.asset, target, "--force", "-q")
        return target.read_text(encoding="utf-8")

    def by_tree(self):
        answer = json.loads(self.tenon("tree", "--show", "physics", "--json", self.asset))
        tree = answer["kinematicTree"]
        held = {link["joint"].rsplit("/")[-1] for link in tree["links"] if link["joint"]}
        loops = {path.rsplit("/")[-1] for path in tree["loopJoints"]}
        self.assertEqual(loops, set(RING) - held)
        text = self.tenon("tree", "--show", "physics", self.asset)
        self.assertEqual(set(re.findall(r"loop +(\w+):", text)), loops)
        return loops

    def by_physics(self):
        answer = json.loads(self.tenon("physics", "--json", self.asset))
        return {path.rsplit("/")[-1] for path in answer["articulations"][0]["loopJoints"]}

    def by_explain(self):
        answers = {name: json.loads(self.tenon("explain", "--json", self.asset, f"/Bar/{name}"))
                   for name in RING}
        return {name for name, answer in answers.items() if '"loop": true' in json.dumps(answer)}

    def by_urdf(self):
        robot = xml.etree.ElementTree.fromstring(self.convert("bar.urdf"))
        return set(RING) - {joint.get("name") for joint in robot.iter("joint")}

    def by_mjcf(self):
        model = xml.etree.ElementTree.fromstring(self.convert("bar.xml"))
        closed = {part.get("name").split("_")[0] for part in model.find("equality") or []}
        carried = {part.get("name").split("_")[0] for part in model.iter("joint")
                   if not part.get("name").endswith("_free")}
        self.assertEqual(closed | carried, set(RING))
        return closed

    def by_structure(self):
        """Links that are nested in one another: the tree without the joint that closes the loop."""
        package = self.folder / "package"
        self.tenon("structure", self.asset, "-o", package, "--links", "nested", "-q")
        root = next(package.glob("*.usda"))
        answer = json.loads(self.tenon("tree", "--show", "physics", "--json", root))
        shutil.rmtree(package)
        bodies = [link["body"] for link in answer["kinematicTree"]["links"]]
        pairs = {frozenset(body.split("/")[-2:]) for body in bodies}
        return {name for name, ends in RING.items() if frozenset(ends) not in pairs}

    def check(self, loop, articulated=True):
        users = [self.by_tree, self.by_explain, self.by_urdf, self.by_mjcf, self.by_structure]
        for user in users + [self.by_physics] * articulated:
            self.assertEqual(user(), {loop}, user.__name__)

    def write(self, *arguments, **options):
        self.asset.write_text(four_bar(*arguments, **options), encoding="utf-8")

    def test_of_an_articulation_is_cut_at_the_last_joint_that_the_stage_comes_to(self):
        for last in RING:
            order = [name for name in RING if name != last] + [last]
            for fixed in (True, False):
                with self.subTest(last=last, fixed=fixed):
                    self.write(order, fixed=fixed)
                    self.check(last)

    def test_is_cut_at_the_joint_that_is_excluded(self):
        for excluded, articulated in itertools.product(RING, (True, False)):
            with self.subTest(excluded=excluded, articulated=articulated):
                self.write(list(RING), excluded=excluded, articulated=articulated)
                self.check(excluded, articulated)

    def test_without_articulation_is_cut_at_the_last_joint_without_bounds(self):
        for driven in ((), ("j4",), ("j2", "j4", "j1")):
            with self.subTest(driven=driven):
                self.write(list(RING), articulated=False, driven=driven)
                self.check(max(set(RING) - set(driven)), articulated=False)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
