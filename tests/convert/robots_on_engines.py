#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Converted robots that engines threw: links in several trees that were to be apart and pushed each
other, and the drives of light links in a chain, for which PhysX iterated too little.

    robots_on_engines.py TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TENON = str(pathlib.Path(sys.argv[1]).resolve())



def inertial(mass, xx, yy, zz, xy=0, xz=0, yz=0):
    return (f'<inertial><mass value="{mass}"/><inertia ixx="{xx}" iyy="{yy}" izz="{zz}" '
            f'ixy="{xy}" ixz="{xz}" iyz="{yz}"/></inertial>')


HEAVY = inertial(1, 0.01, 0.01, 0.01)
BALL = '<collision><geometry><sphere radius="0.2"/></geometry></collision>'


def link(name, *parts):
    return f'<link name="{name}">{"".join(parts)}</link>'


def joint(name, kind, parent, child, height, axis="0 0 1"):
    return (f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
            f'<origin xyz="0 0 {height}"/><axis xyz="{axis}"/>'
            '<limit lower="-1.5" upper="1.5" effort="15" velocity="7"/>'
            '<dynamics damping="3" friction="5"/></joint>')


def robot(*parts):
    return '<robot name="r">' + "".join(parts) + "</robot>"


# A root without mass holds two trees, whose balls are one in the other; as Baxter's head does.
TWO_TREES = (link("base"), link("shield", HEAVY, BALL), link("neck", HEAVY),
             link("head", HEAVY, BALL), joint("s", "fixed", "base", "shield", 1),
             joint("n", "fixed", "base", "neck", 0.9),
             joint("pan", "revolute", "neck", "head", 0.12))
# One tree, and a root that stands still with a ball of its own.
STATIC_BALL = (link("base", BALL), link("neck", HEAVY), link("head", HEAVY, BALL),
               joint("n", "fixed", "base", "neck", 0.02),
               joint("pan", "revolute", "neck", "head", 0.05))
# Masses and inertias of a finger of the Allegro hand.
FINGER = (
    link("palm", inertial(0.4154, 1e-4, 1e-4, 1e-4)),
    link("a", inertial(0.0119, 1.0167e-6, 6.4768e-7, 1.0167e-6)),
    link("b", inertial(0.065, 8.0873e-5, 2.857e-5, 7.9665e-5, 1.4839e-5, 4.234e-6, 2.1435e-5)),
    link("c", inertial(0.0355, 2.7109e-5, 1.4972e-5, 2.6629e-5, 5.412e-6, 2.851e-6, 7.937e-6)),
    link("d", inertial(0.0096, 4.7012e-6, 3.6493e-6, 4.7012e-6, 1.256e-6, 1.294e-6, 1.762e-6)),
    link("tip", inertial(0.0168, 1e-6, 1e-6, 1e-6)),
    joint("j0", "revolute", "palm", "a", 0.04),
    joint("j1", "revolute", "a", "b", 0.0164, "0 1 0"),
    joint("j2", "revolute", "b", "c", 0.054, "0 1 0"),
    joint("j3", "revolute", "c", "d", 0.0384, "0 1 0"),
    joint("t", "fixed", "d", "tip", 0.0267))


class Robots(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.asset = self.folder / "r.usda"

    def run_tenon(self, *words):
        done = subprocess.run([TENON, *map(str, words), "--json"], capture_output=True, text=True,
                              check=False)
        return done.returncode, json.loads(done.stdout)

    def convert(self, parts, *options):
        (self.folder / "r.urdf").write_text(robot(*parts), encoding="utf-8")
        code, answer = self.run_tenon("convert", self.folder / "r.urdf", self.asset, "--force",
                                      *options)
        self.assertEqual(code, 0, answer)

    def engines(self):
        return [engine["name"] for engine in self.run_tenon("doctor")[1]["engines"]
                if engine["available"]]

    def group_is_there(self):
        return "self_collision_off" in self.asset.read_text(encoding="utf-8")

    def test_links_of_several_trees_do_not_touch_where_self_collision_is_off(self):
        for parts in (TWO_TREES, STATIC_BALL):
            for options in ((), ("--flat",)):
                self.convert(parts, *options)
                self.assertTrue(self.group_is_there())
                for engine in self.engines():
                    with self.subTest((engine, len(parts), options)):
                        code, end = self.run_tenon("sim", self.asset, "--engine", engine,
                                                   "--duration", "0.2")
                        self.assertEqual((code, end["contacts"]), (0, 0), end["diagnostics"])
                        [pan] = end["joints"]["/r/Physics/pan"]["position"]
                        self.assertLess(abs(pan), 1e-3)

    def test_they_touch_where_it_is_on(self):
        self.convert(TWO_TREES, "--self-collision", "on")
        self.assertFalse(self.group_is_there())
        code, end = self.run_tenon("sim", self.asset, "--engine", "mujoco", "--duration", "0.01")
        self.assertEqual(code, 0, end)
        self.assertGreater(end["contacts"], 0)

    def test_one_tree_needs_no_group(self):
        self.convert(FINGER)
        self.assertFalse(self.group_is_there())

    def test_drives_of_light_links_in_a_chain_hold(self):
        for gains in ("300,20", "10,1"):
            self.convert(FINGER, "--fix-base", "--gains", gains)
            for engine in self.engines():
                with self.subTest((engine, gains)):
                    code, end = self.run_tenon("sim", self.asset, "--engine", engine,
                                               "--duration", "1")
                    self.assertEqual(code, 0, end["diagnostics"])
                    for name in ("j0", "j1", "j2", "j3"):
                        [angle] = end["joints"][f"/r/Physics/{name}"]["position"]
                        self.assertLess(abs(angle), 1, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
