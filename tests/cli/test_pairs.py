#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon pairs`: which bodies touch in a planted mechanism whose shares are known, filters that are
written and removed, SRDF and JSON files of pairs, and the example hand.

    test_pairs.py ROOT TENON
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
HAND = ROOT / "examples/inspire_hand"
RADIUS, REACH, POST_DEG = 0.05, 0.5, 60.0

HEAD = """#usda 1.0
(
    defaultPrim = "rig"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "rig"
{
"""


def body(name, at, shape="Sphere", size=None, more=""):
    numbers = f"double radius = {RADIUS}" if shape == "Sphere" else f"double size = {size}"
    return f"""    def Xform "{name}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI"{more and ', "PhysicsFilteredPairsAPI"'}]
    )
    {{
        double3 xformOp:translate = ({at[0]}, {at[1]}, {at[2]})
        uniform token[] xformOpOrder = ["xformOp:translate"]
{more}        def {shape} "shape" (
            prepend apiSchemas = ["PhysicsCollisionAPI"]
        )
        {{
            {numbers}
        }}
    }}
"""


def fixed(name, body0, body1, place=(0, 0, 0)):
    first = f"        rel physics:body0 = </rig/{body0}>\n" if body0 else ""
    return f"""    def PhysicsFixedJoint "{name}"
    {{
{first}        rel physics:body1 = </rig/{body1}>
        point3f physics:localPos0 = ({place[0]}, {place[1]}, {place[2]})
    }}
"""


def on_circle(degrees):
    angle = math.radians(degrees)
    return (round(REACH * math.cos(angle), 9), round(REACH * math.sin(angle), 9), 0)


def rig(more="", post=""):
    """A ball on an arm that turns by +-90 degrees about the origin, a post in its reach and one
    that is not, and two balls on the base that always overlap, with a mount between them."""
    near, far = on_circle(POST_DEG), on_circle(180)
    text = HEAD + body("base", (0, 0, 1), "Cube", 0.2)
    text += body("arm", (REACH, 0, 0)) + body("post", near, more=post) + body("far", far)
    text += body("mount", (0, 0, 3)) + body("shell", (0, 0, 1.12))
    text += fixed("ground", None, "base", (0, 0, 1)) + fixed("f0", "base", "post",
                                                            (near[0], near[1], -1))
    text += fixed("f1", "base", "far", (far[0], far[1], -1))
    text += fixed("f2", "base", "mount", (0, 0, 2)) + fixed("f3", "mount", "shell", (0, 0, -1.88))
    text += f"""    def PhysicsRevoluteJoint "turn"
    {{
        rel physics:body0 = </rig/base>
        rel physics:body1 = </rig/arm>
        point3f physics:localPos0 = (0, 0, -1)
        point3f physics:localPos1 = ({-REACH}, 0, 0)
        uniform token physics:axis = "Z"
        float physics:lowerLimit = -90
        float physics:upperLimit = 90
    }}
"""
    return text + more + "}\n"


def drawn(seed, number, lower, upper):
    """The first coordinate of a posture: SplitMix64 from the seed, then from the posture."""
    mask = (1 << 64) - 1

    def step(state):
        state = (state + 0x9e3779b97f4a7c15) & mask
        mixed = ((state ^ (state >> 30)) * 0xbf58476d1ce4e5b9) & mask
        mixed = ((mixed ^ (mixed >> 27)) * 0x94d049bb133111eb) & mask
        return mixed ^ (mixed >> 31)

    bits = step(step(step(seed) ^ number))
    return lower + (upper - lower) * (bits >> 11) * 2.0 ** -53


def names(pair):
    return frozenset(pair[side].rsplit("/", 1)[1] for side in ("bodyA", "bodyB"))


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.state = {**os.environ, "XDG_STATE_HOME": str(self.folder / "state")}

    def run_tenon(self, *arguments, before=()):
        return subprocess.run([*before, TENON, *map(str, arguments)], capture_output=True,
                              text=True, cwd=self.folder, env=self.state, timeout=300)

    def json(self, *arguments, code=0):
        done = self.run_tenon(*arguments, "--json")
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def pairs(self, *arguments):
        """-> by the two names, the pairs that are listed."""
        return {names(pair): pair for pair in self.json("pairs", *arguments)["pairs"]}

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")
        return name

    def fails(self, *arguments):
        """-> what an error says."""
        done = self.run_tenon("pairs", *arguments)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        return done.stderr

    def apart(self, asset, *arguments):
        """-> names of bodies of colliders that the physics has as apart."""
        scene = self.json("physics", asset, *arguments)
        return {frozenset(path.split("/")[2] for path in pair)
                for pair in scene["disabledPairs"]}


class Classes(Case):
    def test_shares_are_those_of_the_planted_mechanism(self):
        asset = self.write("rig.usda", rig())
        found = self.json("pairs", asset, "--sample", 4000)
        pairs = {names(pair): pair for pair in found["pairs"]}
        self.assertEqual(set(pairs), {frozenset(("base", "shell")), frozenset(("arm", "post"))})
        always, reach = pairs[frozenset(("base", "shell"))], pairs[frozenset(("arm", "post"))]
        self.assertEqual((always["class"], always["share"], always["touching"]),
                         ("always", 1, 4000))
        # The shell's centre is 0.02 above the base, whose top is at 0.1.
        self.assertAlmostEqual(always["startDepth"], RADIUS - 0.02, places=6)
        self.assertAlmostEqual(always["depth"], RADIUS - 0.02, places=6)
        self.assertIsNone(always["posture"]["number"])
        # Two balls on a circle touch where the chord is shorter than both radii.
        half = 2 * math.asin(RADIUS / REACH)
        share = (min(half, math.radians(90 - POST_DEG)) + half) / math.pi
        self.assertEqual(reach["class"], "sometimes")
        self.assertAlmostEqual(reach["share"], share, delta=4 * math.sqrt(share / 4000))
        self.assertIsNone(reach["startDepth"])
        # How deep is told by the posture itself.
        angle = {joint["joint"]: joint["values"] for joint in reach["posture"]["joints"]}
        turned = angle["/rig/turn"][0]
        chord = 2 * REACH * math.sin(abs(turned - math.radians(POST_DEG)) / 2)
        self.assertAlmostEqual(reach["depth"], 2 * RADIUS - chord, places=6)
        self.assertGreater(reach["depth"], 2 * RADIUS - 0.002)
        self.assertEqual((found["bodies"], found["pairCount"], found["never"],
                          found["coordinates"]), (6, 15, 13, 1))

    def test_pairs_that_never_touch_are_counted_and_listed_on_demand(self):
        asset = self.write("rig.usda", rig())
        everything = self.pairs(asset, "--all")
        self.assertEqual(len(everything), 15)
        far = everything[frozenset(("arm", "far"))]
        self.assertEqual((far["class"], far["touching"], far["depth"]), ("never", 0, None))
        self.assertTrue(everything[frozenset(("arm", "base"))]["adjacent"])
        self.assertFalse(everything[frozenset(("base", "shell"))]["adjacent"])
        text = self.run_tenon("pairs", asset).stdout
        self.assertNotIn("far ", text)
        self.assertIn("2 of 15 pairs of 6 bodies touch", text)
        self.assertIn("13 never do", text)
        self.assertIn("far ", self.run_tenon("pairs", asset, "-v").stdout)

    def test_the_start_alone(self):
        asset = self.write("rig.usda", rig())
        found = self.json("pairs", asset, "--sample", 0)
        self.assertEqual([names(pair) for pair in found["pairs"]],
                         [frozenset(("base", "shell"))])
        self.assertEqual((found["postures"], found["pairs"][0]["class"],
                          found["pairs"][0]["share"]), (0, None, None))
        self.assertIn("no posture was looked at",
                      self.fails(asset, "--sample", 0, "--filter", "always"))

    def test_what_nothing_can_move_is_looked_at_once(self):
        text = HEAD + body("a", (0, 0, 0)) + body("b", (0, 0, 0.08)) + "}\n"
        found = self.json("pairs", self.write("rigid.usda", text))
        self.assertEqual((found["postures"], found["coordinates"]), (1, 0))
        self.assertEqual(found["pairs"][0]["class"], "always")
        self.assertAlmostEqual(found["pairs"][0]["depth"], 0.02, places=9)

    def test_often(self):
        text = rig().replace("lowerLimit = -90", f"lowerLimit = {POST_DEG - 15}")
        text = text.replace("upperLimit = 90", f"upperLimit = {POST_DEG + 15}")
        pair = self.pairs(self.write("rig.usda", text))[frozenset(("arm", "post"))]
        share = math.degrees(2 * math.asin(RADIUS / REACH)) / 15
        self.assertEqual(pair["class"], "often")
        self.assertAlmostEqual(pair["share"], share, delta=0.05)

    def test_static_colliders_count_with_environment(self):
        wall = """    def Cube "wall" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
        double size = 0.2
        double3 xformOp:translate = (0, -0.5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
"""
        asset = self.write("rig.usda", rig(wall))
        key = frozenset(("arm", "wall"))
        self.assertNotIn(key, self.pairs(asset))
        self.assertEqual(self.pairs(asset, "--environment")[key]["class"], "sometimes")

    def test_same_seed_same_bytes_whatever_the_threads(self):
        asset = self.write("rig.usda", rig())
        one = self.run_tenon("pairs", asset, "--json", before=("taskset", "-c", "0")).stdout
        self.assertEqual(one, self.run_tenon("pairs", asset, "--json").stdout)
        self.assertIn('"seed": 0', one)
        other = json.loads(self.run_tenon("pairs", asset, "--json", "--seed", 1).stdout)
        self.assertNotEqual(json.loads(one)["pairs"], other["pairs"])

    def test_postures_are_those_of_the_seed(self):
        asset = self.write("rig.usda", rig())
        pair = self.pairs(asset, "--sample", 100, "--seed", 7)[frozenset(("arm", "post"))]
        gaps = [abs(drawn(7, i, -math.pi / 2, math.pi / 2) - math.radians(POST_DEG))
                for i in range(100)]
        touching = [gap for gap in gaps if 2 * REACH * math.sin(gap / 2) < 2 * RADIUS - 1e-6]
        self.assertEqual(pair["touching"], len(touching))
        self.assertEqual(pair["posture"]["number"], gaps.index(min(gaps)))


class Filters(Case):
    def test_reasons_are_told(self):
        pairs = self.pairs(self.write("rig.usda", rig()), "--all")
        joint = pairs[frozenset(("arm", "base"))]
        self.assertEqual((joint["filtered"], joint["filters"][0]["rule"],
                          joint["filters"][0]["prim"]), ("yes", "S-92", "/rig/turn"))
        self.assertEqual(pairs[frozenset(("base", "shell"))]["filtered"], "no")
        apart = rig().replace("def Xform \"rig\"", 'def Xform "rig" (prepend apiSchemas = '
                              '["PhysicsArticulationRootAPI", "PhysxArticulationAPI"])')
        apart = apart.replace("    def Xform \"base\"",
                              "    bool physxArticulation:enabledSelfCollisions = 0\n"
                              "    def Xform \"base\"", 1)
        pairs = self.pairs(self.write("apart.usda", apart))
        reach = pairs[frozenset(("arm", "post"))]  # looked at all the same
        self.assertEqual((reach["class"], reach["filtered"]), ("sometimes", "yes"))
        self.assertIn("S-115", [why["rule"] for why in reach["filters"]])
        self.assertFalse(reach["overFiltered"])

    def test_groups_are_told(self):
        group = """    def PhysicsCollisionGroup "group" (
        prepend apiSchemas = ["CollectionAPI:colliders"]
    )
    {
        rel physics:filteredGroups = </rig/group>
        rel collection:colliders:includes = [</rig/arm>, </rig/post>]
    }
"""
        reach = self.pairs(self.write("rig.usda", rig(group)))[frozenset(("arm", "post"))]
        self.assertEqual((reach["filtered"], reach["filters"][0]["rule"]), ("yes", "S-77"))

    def test_filtered_pairs_that_hardly_touch_are_over_filtered(self):
        listed = "        rel physics:filteredPairs = [</rig/arm>, </rig/far>]\n"
        asset = self.write("rig.usda", rig(post=listed))
        pairs = self.pairs(asset)
        self.assertTrue(pairs[frozenset(("arm", "post"))]["overFiltered"])
        self.assertTrue(pairs[frozenset(("far", "post"))]["overFiltered"])  # listed for that
        self.assertIn("over-filtered", self.run_tenon("pairs", asset).stdout)

    def test_always_is_filtered_once_and_taken_back(self):
        text = rig()
        asset = self.write("rig.usda", text)
        self.assertIn("--filter always", self.run_tenon("pairs", asset).stdout)
        dry = self.run_tenon("pairs", asset, "--filter", "always", "--dry-run")
        self.assertIn("+        prepend rel physics:filteredPairs = </rig/shell>", dry.stdout)
        self.assertEqual((self.folder / asset).read_text(), text)
        self.assertNotIn(frozenset(("base", "shell")), self.apart(asset))
        made = self.json("pairs", asset, "--filter", "always")
        self.assertTrue(made["written"])
        self.assertIn(frozenset(("base", "shell")), self.apart(asset))
        pair = self.pairs(asset)[frozenset(("base", "shell"))]
        self.assertEqual((pair["filtered"], pair["overFiltered"]), ("yes", False))
        edited = (self.folder / asset).read_text()
        again = self.run_tenon("pairs", asset, "--filter", "always")
        self.assertEqual((again.returncode, again.stdout), (0, ""))
        self.assertIn("nothing to filter", again.stderr)
        self.assertEqual((self.folder / asset).read_text(), edited)
        self.assertEqual(self.run_tenon("undo", asset).returncode, 0)
        self.assertEqual((self.folder / asset).read_text(), text)

    def test_self_collision_that_is_off(self):
        apis = '"PhysicsArticulationRootAPI", "NewtonArticulationRootAPI", "PhysxArticulationAPI"'
        flags = ("newton:selfCollisionEnabled", "physxArticulation:enabledSelfCollisions")
        lines = "".join(f"    bool {flag} = 0\n" for flag in flags)
        asset = self.write("rig.usda", rig().replace(
            'def Xform "rig"\n{\n',
            f'def Xform "rig" (\n    prepend apiSchemas = [{apis}]\n)\n{{\n{lines}', 1))
        self.assertIn("self-collision of rig is off", self.run_tenon("pairs", asset).stdout)
        self.assertTrue(self.json("pairs", asset, "--filter", "always")["written"])
        made = self.json("pairs", asset, "--self-collision", "on")
        self.assertEqual({edit["object"] for edit in made["edits"]},
                         {f"/rig.{flag}" for flag in flags})
        text = (self.folder / asset).read_text()
        for flag in flags:
            self.assertIn(f"bool {flag} = 1", text)
        self.assertNotIn("self-collision", self.run_tenon("pairs", asset).stdout)
        pair = self.pairs(asset)[frozenset(("base", "shell"))]
        self.assertEqual([why["rule"] for why in pair["filters"]], ["S-81"])
        again = self.run_tenon("pairs", asset, "--self-collision", "on")
        self.assertEqual(again.returncode, 0)
        self.assertIn("self-collision is on already", again.stderr)
        self.assertEqual((self.folder / asset).read_text(), text)
        self.json("pairs", asset, "--self-collision", "off")
        text = (self.folder / asset).read_text()
        for flag in flags:
            self.assertIn(f"bool {flag} = 0", text)
        bare = self.write("bare.usda", rig())
        self.assertIn("no articulation", self.fails(bare, "--self-collision", "on"))

    def test_default_and_adjacent(self):
        text = rig().replace('def PhysicsRevoluteJoint "turn"\n    {', 'def PhysicsRevoluteJoint '
                             '"turn"\n    {\n        bool physics:collisionEnabled = 1')
        asset = self.write("rig.usda", text)
        made = self.json("pairs", asset, "--filter", "default,adjacent", "--dry-run")
        objects = {(edit["object"], edit["after"]) for edit in made["edits"] if not edit["api"]}
        self.assertEqual({name for name, _ in objects}, {"/rig/arm.physics:filteredPairs",
                                                         "/rig/base.physics:filteredPairs"})

    def test_two_bodies_and_back(self):
        text = rig()
        asset = self.write("rig.usda", text)
        key = frozenset(("arm", "post"))
        for two in ("/rig/post,/rig/arm", "arm,post", "/rig/arm/shape,/rig/post"):
            with self.subTest(two):
                self.assertEqual(self.json("pairs", asset, "--filter", two)["written"], True)
                self.assertIn(key, self.apart(asset))
                removed = self.json("pairs", asset, "--unfilter", two)
                self.assertTrue(removed["written"])
                self.assertNotIn(key, self.apart(asset))
                self.assertNotIn("filteredPairs", (self.folder / asset).read_text())

    def test_one_of_many_is_removed_from_whichever_lists_it(self):
        listed = "        rel physics:filteredPairs = [</rig/arm>, </rig/far>]\n"
        asset = self.write("rig.usda", rig(post=listed))
        self.json("pairs", asset, "--unfilter", "arm,post")
        apart = self.apart(asset)
        self.assertNotIn(frozenset(("arm", "post")), apart)
        self.assertIn(frozenset(("far", "post")), apart)
        # Both at once, and a filter with it, are one edit.
        self.json("pairs", asset, "--unfilter", "far,post", "--filter", "arm,shell")
        apart = self.apart(asset)
        self.assertNotIn(frozenset(("far", "post")), apart)
        self.assertIn(frozenset(("arm", "shell")), apart)
        self.assertEqual(self.run_tenon("undo", asset).returncode, 0)
        self.assertIn(frozenset(("far", "post")), self.apart(asset))
        said = self.fails(asset, "--unfilter", "arm,base")
        self.assertIn("neither of", said)
        self.assertIn("/rig/turn", said)  # the joint does it

    def test_bad_words_and_names(self):
        asset = self.write("rig.usda", rig())
        said = self.fails(asset, "--filter", "allways")
        self.assertIn('did you mean "always"?', said)
        for word in ("always", "often", "adjacent", "default", ".srdf"):
            self.assertIn(word, said)
        self.assertIn('"never"', self.fails(asset, "--filter", "always,never"))
        said = self.fails(asset, "--filter", "/rig/arm,/rig/pots")
        self.assertIn("did you mean /rig/post?", said)
        self.assertIn("did you mean post?", self.fails(asset, "--filter", "arm,pots"))
        self.assertIn("two bodies", self.fails(asset, "--unfilter", "/rig/arm"))
        self.assertIn("both are", self.fails(asset, "--filter", "/rig/arm,/rig/arm"))
        self.assertIn("neither a body nor a collider", self.fails(asset, "--filter",
                                                                  "/rig/arm,/rig/turn"))
        self.assertIn("--sample", self.fails(asset, "--sample", 1000001))
        self.assertIn(".srdf", self.fails(asset, "--srdf", "out.txt"))
        said = self.fails(asset, "--srdf", "o.srdf", "--filter", "always")
        self.assertIn("one of them first", said)
        empty = self.run_tenon("pairs", self.write("empty.usda", HEAD + "}\n"))
        self.assertEqual(empty.returncode, 0)
        self.assertIn("no bodies", empty.stderr)


class Files(Case):
    def test_srdf_there_and_back(self):
        asset = self.write("rig.usda", rig())
        done = self.run_tenon("pairs", asset, "--srdf", "rig.srdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        root = ElementTree.parse(self.folder / "rig.srdf").getroot()
        self.assertEqual((root.tag, root.get("name")), ("robot", "rig"))
        reasons = {frozenset((pair.get("link1"), pair.get("link2"))): pair.get("reason")
                   for pair in root}
        self.assertEqual(len(reasons), 14)
        self.assertEqual(reasons[frozenset(("arm", "base"))], "Adjacent")
        self.assertEqual(reasons[frozenset(("base", "shell"))], "Default")
        self.assertEqual(reasons[frozenset(("arm", "far"))], "Never")
        self.assertNotIn(frozenset(("arm", "post")), reasons)  # they do collide
        self.json("pairs", asset, "--filter", "rig.srdf")
        self.assertEqual(self.apart(asset), set(reasons))
        again = self.run_tenon("pairs", asset, "--filter", "rig.srdf")
        self.assertIn("nothing to filter", again.stderr)

    def test_json_there_and_back(self):
        asset = self.write("rig.usda", rig())
        listed = self.json("pairs", asset)
        self.write("pairs.json", json.dumps(listed))
        self.json("pairs", asset, "--filter", "pairs.json")
        self.assertLessEqual({names(pair) for pair in listed["pairs"]}, self.apart(asset))

    def test_bad_files(self):
        asset = self.write("rig.usda", rig())
        one = '<disable_collisions link1="arm" link2="%s" reason="User"/>'
        for name, text, words in (
                ("a.srdf", "<robot>\n" + one % "pots", ("a.srdf:2", 'did you mean "post"?')),
                ("b.srdf", "<robot>\n" + one % "post", ("b.srdf:2", "not valid XML")),
                ("c.srdf", "<sdf/>", ("c.srdf:1", "not <robot>")),
                ("d.srdf", '<robot>\n\n<disable_collisions link1="arm"/></robot>',
                 ("d.srdf:3", "link2")),
                ("e.json", "[" * 100000, ("e.json:1:100001", "ends too early")),
                ("e.json", '{"pairs": [],\n "pairs": []}', ("e.json", '"pairs" is there twice')),
                ("e.json", '{\n"pairs": NaN}', ("e.json:2:10", "no JSON here")),
                # Keys that are looked for one by one take minutes.
                ("i.json", "{" + ",".join(f'"{at}":1' for at in range(300000)) + "}",
                 ("i.json", "no list")),
                ("f.json", '{"pairs": [{"bodyA": 3}]}', ("f.json", "bodyA")),
                ("g.json", '{"pairs": [{"bodyA": "/rig/arm", "bodyB": "/rig/x"}]}',
                 ("g.json", "neither a body")),
                ("h.srdf", None, ("h.srdf",))):
            with self.subTest(name):
                if text is not None:
                    if name == "a.srdf":
                        text += "</robot>"
                    self.write(name, text)
                said = self.fails(asset, "--filter", name)
                for word in words:
                    self.assertIn(word, said)

    def test_two_bodies_of_one_name_have_no_srdf(self):
        text = rig('    def Scope "more"\n    {\n' + body("arm", (9, 9, 9)) + "    }\n")
        asset = self.write("rig.usda", text)
        said = self.fails(asset, "--srdf", "o.srdf")
        self.assertIn('the name "arm"', said)
        self.assertIn("tenon rename", said)
        self.assertFalse((self.folder / "o.srdf").exists())
        self.assertIn("more than one body", self.fails(asset, "--filter", "arm,post"))
        self.assertIn("/rig/more/arm", self.run_tenon("pairs", asset, "--all").stdout)


class Hand(Case):
    def setUp(self):
        super().setUp()
        shutil.copytree(HAND / "payloads", self.folder / "payloads")
        shutil.copy(HAND / "inspire_hand.usda", self.folder / "hand.usda")

    def test_pairs_go_to_the_file_that_owns_them(self):
        before = {path: path.read_bytes() for path in self.folder.rglob("*.usd*")}
        pairs = self.pairs("hand.usda", "--all")
        self.assertEqual(len(pairs), 13 * 12 // 2)
        self.assertTrue(all(pairs[frozenset((f"right_{finger}_1", f"right_{finger}_2"))]["adjacent"]
                            for finger in ("index", "middle", "ring", "little")))
        made = self.json("pairs", "hand.usda", "--filter", "right_thumb_1,right_index_2")
        self.assertEqual({pathlib.Path(edit["file"]).name for edit in made["edits"]},
                         {"physics.usda"})
        self.assertIn(frozenset(("right_thumb_1", "right_index_2")), self.apart("hand.usda"))
        self.assertEqual(self.run_tenon("undo", "hand.usda").returncode, 0)
        self.assertEqual({path: path.read_bytes() for path in before}, before)

    def test_ten_thousand_postures_do_not_take_long(self):
        start = os.times()
        found = self.json("pairs", "hand.usda", "--sample", 10000)
        end = os.times()
        self.assertEqual(found["postures"], 10000)
        took = end.children_user + end.children_system - start.children_user - start.children_system
        self.assertLess(took, 10, "2 s of processor time on a machine of 2025")


if __name__ == "__main__":
    unittest.main(argv=["test_pairs.py"])
