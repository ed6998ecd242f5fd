#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon pose`: named poses that are saved, renamed and removed in the file that owns them, files
of poses, inverse kinematics beside the closed form of an arm with two links, and every verb that
has --pose at a named one.

    test_pose.py ROOT TENON
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
HAND = "hand/inspire_hand.usda"
JOINTS = "/inspire_hand/Physics/right_"
UPPER, FORE = 0.3, 0.2

LINK = """
    def Xform "{name}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {{
        float physics:mass = 1
        float3 physics:diagonalInertia = (0.01, 0.01, 0.01)
        double3 xformOp:translate = ({at}, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
{more}    }}
"""
JOINT = """
    def PhysicsRevoluteJoint "{name}"
    {{
{body0}        rel physics:body1 = </arm/{body1}>
        uniform token physics:axis = "Z"
        point3f physics:localPos0 = ({at}, 0, 0)
        float physics:lowerLimit = {lower}
        float physics:upperLimit = {upper}
    }}
"""


def arm(elbow=(-150, 150)):
    """Two hinges about z, links of 0.3 m and 0.2 m along x, a tip at the end of the second."""
    tip = f"""        def Xform "tip"
        {{
            double3 xformOp:translate = ({FORE}, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }}
"""
    return ('#usda 1.0\n(\n    defaultPrim = "arm"\n    metersPerUnit = 1\n'
            '    kilogramsPerUnit = 1\n    upAxis = "Z"\n)\ndef Xform "arm"\n{'
            + LINK.format(name="upper", at=0, more="")
            + LINK.format(name="fore", at=UPPER, more=tip)
            + JOINT.format(name="shoulder", body0="", body1="upper", at=0, lower=-170, upper=170)
            + JOINT.format(name="elbow", body0="        rel physics:body0 = </arm/upper>\n",
                           body1="fore", at=UPPER, lower=elbow[0], upper=elbow[1]) + "}\n")


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.environment = {**os.environ, "XDG_STATE_HOME": str(self.folder / "state"),
                            "TENON_CHROMIUM": "/bin/true"}  # nothing is drawn with it

    def tenon(self, *arguments, code=0):
        done = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                              cwd=self.folder, check=False, env=self.environment)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def json(self, *arguments, code=0):
        return json.loads(self.tenon(*arguments, "--json", code=code).stdout)

    def hand(self):
        shutil.copytree(ROOT / "examples/inspire_hand", self.folder / "hand")
        return HAND

    def arm(self, **limits):
        (self.folder / "arm.usda").write_text(arm(**limits), encoding="utf-8")
        return "arm.usda"

    def files(self):
        return {path: path.read_bytes() for path in sorted(self.folder.rglob("*.usd*"))}

    def refused(self, rule, *arguments, says="", code=2):
        before = self.files()
        done = self.tenon("pose", *arguments, code=code)
        self.assertIn(f"[{rule}]", done.stderr)
        self.assertIn(says, done.stderr)
        self.assertEqual(self.files(), before)
        return done


def values(answer):
    return {row["joint"].rsplit("/", 1)[-1]: row["value"] for row in answer["joints"]}


class Kept(Case):
    def test_pose_is_kept_in_the_form_of_isaac_in_the_file_of_the_robot(self):
        self.hand()
        before = self.files()
        self.tenon("pose", HAND, "--save", "point", "--pose", "right_middle_1_joint=45")
        changed = [path.name for path, text in self.files().items() if before.get(path) != text]
        self.assertEqual(changed, ["robot.usda"])
        dump = json.loads(self.tenon("dump", HAND).stdout)
        text = json.dumps(dump)
        self.assertIn("/inspire_hand/Named_Poses/point", text)
        where = self.json("where", HAND, "/inspire_hand/Named_Poses/point")
        self.assertIn("IsaacNamedPose", json.dumps(where))
        shown = self.json("pose", HAND, "--show", "point")["pose"]
        found = values(shown)
        self.assertAlmostEqual(found["right_middle_1_joint"], math.pi / 4, 6)
        self.assertEqual(found["right_index_1_joint"], 0)
        # A follower has the value that its mimic law gives, so that robot tools find it.
        follower = next(row for row in shown["joints"]
                        if row["joint"].endswith("right_middle_2_joint"))
        self.assertTrue(follower["follows"].endswith("right_middle_1_joint"))
        self.assertGreater(follower["value"], 0.1)
        self.assertTrue(shown["valid"])
        self.assertEqual(shown["robot"], "/inspire_hand")
        self.assertEqual(shown["startLink"], "/inspire_hand/r_base_link")

    def test_listed_poses(self):
        self.hand()
        self.assertEqual(self.json("pose", HAND)["poses"], [])
        self.assertIn("keeps no named poses", self.tenon("pose", HAND).stdout)
        self.tenon("pose", HAND, "--save", "b")
        self.tenon("pose", HAND, "--save", "a", "--pose", "right_index_1_joint=10")
        listed = self.json("pose", HAND, "--list")["poses"]
        self.assertEqual([pose["name"] for pose in listed], ["b", "a"])
        self.assertEqual(len(listed[0]["joints"]), 12)

    def test_saved_twice_the_same_bytes(self):
        self.hand()
        words = ("pose", HAND, "--save", "point", "--pose", "right_middle_1_joint=33.3")
        self.tenon(*words)
        once = self.files()
        told = self.tenon(*words)
        self.assertEqual(self.files(), once)
        self.assertIn("nothing to write", told.stderr)
        # Through its own values, which are single precision.
        self.tenon("pose", HAND, "--save", "point", "--pose", "point")
        self.assertEqual(self.files(), once)
        other = json.loads(self.tenon(*words[:-1], "right_middle_1_joint=10", "--json").stdout)
        self.assertTrue(other["written"])
        self.assertNotEqual(self.files(), once)

    def test_every_edit_is_undone(self):
        self.hand()
        states = [self.files()]
        for words in (("--save", "a", "--pose", "right_index_1_joint=10"), ("--save", "b"),
                      ("--rename", "a=first"), ("--remove", "b"), ("--remove", "first")):
            self.tenon("pose", HAND, *words)
            self.assertNotEqual(self.files(), states[-1], words)
            states.append(self.files())
        self.assertEqual(self.json("pose", HAND)["poses"], [])
        self.assertNotIn("Named_Poses", (self.folder / "hand/payloads/robot.usda").read_text())
        for before in reversed(states[:-1]):
            self.tenon("undo", HAND)
            self.assertEqual(self.files(), before)

    def test_rename_and_remove(self):
        self.hand()
        self.tenon("pose", HAND, "--save", "a", "--pose", "right_index_1_joint=10")
        self.tenon("pose", HAND, "--save", "b")
        self.tenon("pose", HAND, "--rename", "a=c")
        names = [pose["name"] for pose in self.json("pose", HAND)["poses"]]
        self.assertEqual(sorted(names), ["b", "c"])
        self.assertTrue(all(pose["robot"] for pose in self.json("pose", HAND)["poses"]))
        self.tenon("pose", HAND, "--remove", "b", "--remove", "c")
        self.assertEqual(self.json("pose", HAND)["poses"], [])

    def test_dry_run_prints_the_difference_alone(self):
        self.hand()
        before = self.files()
        done = self.tenon("pose", HAND, "--save", "a", "--dry-run")
        self.assertIn('+        def IsaacNamedPose "a"', done.stdout)
        self.assertEqual(self.files(), before)

    def test_asset_that_is_no_robot_becomes_one(self):
        asset = self.arm()
        self.tenon("pose", asset, "--save", "bent", "--pose", "elbow=40")
        text = (self.folder / asset).read_text()
        self.assertIn('"IsaacRobotAPI"', text)
        for line in ("isaac:physics:robotLinks", "isaac:physics:robotJoints",
                     "isaac:robot:namedPoses"):
            self.assertIn(line, text)
        self.assertAlmostEqual(values(self.json("pose", asset, "--show", "bent")["pose"])["elbow"],
                               math.radians(40), 6)
        self.tenon("check", asset, "--only", "pose")

    def test_structured_asset_has_no_finding_about_its_poses(self):
        self.hand()
        before = self.json("check", HAND, "--profile", "isaac-3.0", code=None or 0)
        self.tenon("pose", HAND, "--save", "a", "--ik", "right_index_2=30mm,10mm,140mm",
                   "--tolerance", "0.05")
        after = self.json("check", HAND, "--profile", "isaac-3.0")
        self.assertEqual(after["summary"], before["summary"])

    def test_structured_again_poses_stay(self):
        asset = self.arm()
        self.tenon("pose", asset, "--save", "bent", "--pose", "elbow=40")
        self.tenon("structure", asset, "-o", "made")
        made = next((self.folder / "made").glob("*.usda"))
        kept = self.json("pose", made.relative_to(self.folder), "--show", "bent")["pose"]
        self.assertAlmostEqual(values(kept)["elbow"], math.radians(40), 6)

    def test_posture_of_a_state(self):
        asset = self.arm()
        path = self.folder / asset
        path.write_text(path.read_text().replace('def Xform "arm"\n{', """def PhysicsScene "down"
{
    vector3f physics:gravityDirection = (0, -1, 0)
}
def Xform "arm"
{"""))
        run = self.json("sim", asset, "--engine", "mujoco", "--duration", "0.2", "--state-out",
                        "there.state")["joints"]
        self.tenon("pose", asset, "--save", "there", "--state-in", "there.state", "--engine",
                   "mujoco")
        found = values(self.json("pose", asset, "--show", "there")["pose"])
        for joint in ("shoulder", "elbow"):
            [position] = run[f"/arm/{joint}"]["position"]
            self.assertGreater(abs(position), 1)
            self.assertAlmostEqual(found[joint], math.radians(position), 5)


class Files(Case):
    def test_there_and_back(self):
        asset = self.arm()
        self.tenon("pose", asset, "--save", "bent", "--pose", "elbow=40,shoulder=-10")
        self.tenon("pose", asset, "--save", "touch", "--ik", "/arm/fore/tip=0.25,0.2,0")
        before = self.files()
        self.tenon("pose", asset, "--export", "poses.json")
        kept = json.loads((self.folder / "poses.json").read_text())
        self.assertEqual(kept["_meta"]["units"], "radians")
        self.assertAlmostEqual(kept["poses"]["bent"]["joints"]["/arm/elbow"], math.radians(40), 6)
        self.assertEqual(kept["poses"]["touch"]["end_link"], "/arm/fore/tip")
        self.assertEqual(len(kept["poses"]["touch"]["target_orientation"]), 4)
        self.tenon("pose", asset, "--remove", "bent", "--remove", "touch")
        self.tenon("pose", asset, "--import", "poses.json")
        self.assertEqual(self.files(), before)

    def test_form_of_isaac_with_degrees_and_without_a_head(self):
        asset = self.arm()
        row = {"joints": {"/arm/elbow": 40.0}, "joint_fixed": {"/arm/elbow": True}}
        for name, contents in (("a", {"_meta": {"units": "degrees"}, "poses": {"a": row}}),
                               ("b", {"b": {"joints": {"/arm/elbow": math.radians(40)}}})):
            (self.folder / "in.json").write_text(json.dumps(contents))
            self.tenon("pose", asset, "--import", "in.json")
            shown = self.json("pose", asset, "--show", name)["pose"]["joints"]
            self.assertAlmostEqual(shown[0]["value"], math.radians(40), 6)
            self.assertEqual(shown[0]["fixed"], name == "a")

    def test_refusals(self):
        asset = self.arm()
        for contents, rule in (
                ("no", "pose.file"), ("{}", "pose.file"), ('{"a": 1}', "pose.file"),
                ('{"a": {"joints": {}}}', "pose.file"),
                ('{"a": {"joints": {"/arm/elbow": "x"}}}', "pose.file"),
                ('{"_meta": {"units": "turns"}, "poses": {"a": {"joints": {"/arm/elbow": 1}}}}',
                 "pose.file"),
                ('{"a": {"joints": {"/arm/no": 1}}}', "pose.joint-missing"),
                ('{"1 a": {"joints": {"/arm/elbow": 1}}}', "edit.bad-name")):
            (self.folder / "in.json").write_text(contents)
            self.refused(rule, asset, "--import", "in.json")
        many = ",".join(f'"p{at}": {{}}' for at in range(2001))
        for contents, says in (('{\n"a": NaN}', "in.json:2:6"), ("", "it is empty"),
                               ('{"poses": {}}', 'only one of "_meta" and "poses"'),
                               ('{"a": {}, "a": {}}', '"a" is there twice'),
                               ("{" + many + "}", "more than 2000 poses")):
            (self.folder / "in.json").write_text(contents)
            self.refused("pose.file", asset, "--import", "in.json", says=says)
        self.refused("output.kind", asset, "--export", "poses.txt")


class Reaching(Case):
    def test_two_links_have_the_angles_of_the_closed_form(self):
        asset = self.arm()
        for x, y in ((0.25, 0.2), (0.05, 0.3), (0.3, -0.25)):
            answer = self.json("pose", asset, "--ik", f"/arm/fore/tip={x},{y},0", "--tolerance",
                               "1e-9")
            self.assertTrue(answer["reach"]["reached"])
            found = values(answer)
            # Law of cosines.
            elbow = math.acos((x * x + y * y - UPPER**2 - FORE**2) / (2 * UPPER * FORE))
            self.assertAlmostEqual(abs(found["elbow"]), elbow, 6)
            q = found["elbow"]
            shoulder = math.atan2(y, x) - math.atan2(FORE * math.sin(q), UPPER + FORE * math.cos(q))
            self.assertAlmostEqual(math.remainder(found["shoulder"] - shoulder, math.tau), 0, 6)

    def test_out_of_reach_is_told_and_not_saved(self):
        asset = self.arm()
        before = self.files()
        done = self.tenon("pose", asset, "--ik", "/arm/fore/tip=0.6,0,0", "--save", "far", code=1)
        self.assertIn("not reached: out of reach", done.stdout)
        self.assertIn("100 mm", done.stdout)
        self.assertIn("nothing is saved", done.stderr)
        self.assertEqual(self.files(), before)
        answer = self.json("pose", asset, "--ik", "/arm/fore/tip=0.6,0,0", code=1)
        self.assertEqual(answer["reach"]["obstacle"], "distance")
        self.assertAlmostEqual(answer["reach"]["targets"][0]["distance"], 0.1, 4)

    def test_limits_in_the_way_are_named(self):
        asset = self.arm(elbow=(0, 30))
        done = self.tenon("pose", asset, "--ik", "/arm/fore/tip=0.1,0.2,0", code=1)
        self.assertIn("limits of joints are in the way; at a limit: elbow", done.stdout)
        answer = self.json("pose", asset, "--ik", "/arm/fore/tip=0.1,0.2,0", code=1)
        self.assertEqual(answer["reach"]["obstacle"], "limits")
        self.assertLessEqual(values(answer)["elbow"], math.radians(30) + 1e-6)

    def test_rotation(self):
        asset = self.arm()
        words = ("pose", asset, "--ik", "fore=0,0.3,0", "--rotation")
        found = values(self.json(*words, "0,0,120"))
        self.assertAlmostEqual(found["shoulder"] + found["elbow"], math.radians(120), 4)
        half = math.radians(60)
        same = values(self.json(*words, f"{math.cos(half)},0,0,{math.sin(half)}"))
        self.assertAlmostEqual(same["elbow"], found["elbow"], 4)
        done = self.tenon(*words, "90,0,0", code=1)
        self.assertIn("the place is reached, but not with that rotation", done.stdout)

    def test_units_start_held_and_seed(self):
        asset = self.arm()
        words = ("pose", asset, "--ik")
        meters = values(self.json(*words, "/arm/fore/tip=0.25,0.2,0"))
        self.assertEqual(values(self.json(*words, "/arm/fore/tip=250mm,20cm,0m")), meters)
        # The elbow goes to the side where the search begins.
        for elbow in (60, -60):
            found = values(self.json(*words, "/arm/fore/tip=0.25,0.2,0", "--pose",
                                     f"elbow={elbow}"))
            self.assertGreater(found["elbow"] * elbow, 0)
        place = (UPPER * math.cos(0.5) + FORE, UPPER * math.sin(0.5))
        answer = self.json(*words, f"/arm/fore/tip={place[0]},{place[1]},0", "--pose",
                           "shoulder=0.5rad", "--hold", "shoulder")
        self.assertAlmostEqual(values(answer)["shoulder"], 0.5, 9)
        self.assertAlmostEqual(values(answer)["elbow"], -0.5, 4)
        first = self.tenon(*words, "/arm/fore/tip=-0.1,0.3,0", "--seed", "3", "--json").stdout
        self.assertEqual(self.tenon(*words, "/arm/fore/tip=-0.1,0.3,0", "--seed", "3",
                                    "--json").stdout, first)

    def test_hand_keeps_limits_and_mimics_and_moves_one_finger_alone(self):
        self.hand()
        start = values(self.json("pose", HAND, "--pose", "right_index_1_joint=0"))
        there = self.json("inertia", HAND, "--pose", "right_index_1_joint=40")
        bent = {row["joint"].rsplit("/", 1)[-1]: row["position"] for row in there["coordinates"]}
        self.tenon("add", HAND, "/inspire_hand/right_index_2/tip=xform", "--at", "0,0,0.04")
        self.tenon("sim", HAND, "--engine", "mujoco", "--duration", "0", "--pose",
                   "right_index_1_joint=40", "-o", "log.jsonl")
        frame = json.loads([line for line in (self.folder / "log.jsonl").read_text().splitlines()
                            if '"time"' in line][0])
        body = frame["bodies"]["/inspire_hand/right_index_2"]
        x, y, z = body["position"]
        answer = self.json("pose", HAND, "--ik", f"right_index_2={x},{y},{z}")
        found = values(answer)
        self.assertTrue(answer["reach"]["reached"])
        self.assertAlmostEqual(found["right_index_1_joint"], math.radians(40), 3)
        self.assertAlmostEqual(found["right_index_2_joint"], bent["right_index_2_joint"], 3)
        moved = {name for name in found if abs(found[name] - start[name]) > 1e-9}
        self.assertEqual(moved, {"right_index_1_joint", "right_index_2_joint"})
        for row in answer["joints"]:
            self.assertIsNone(row["problem"], row)


class Taken(Case):
    """A named pose in every verb that has --pose is what its joints are, written out."""

    def test_every_verb(self):
        self.hand()
        self.tenon("pose", HAND, "--save", "point", "--pose", "right_middle_1_joint=45,"
                   "right_thumb_1_joint=20")
        written = "right_middle_1_joint=45,right_thumb_1_joint=20"
        table = json.loads(self.tenon("help", "--json").stdout)["verbs"]
        verbs = {verb["name"] for verb in table
                 if any("--pose" in option["names"] for option in verb["options"])}
        run = ("--engine", "mujoco", "--duration", "0.02")
        known = {
            "bake": (*run, "-o", "-"), "bench": None, "compare":
                ("--engines", "mujoco,mujoco", "--duration", "0.02", "--no-reasons"),
            "inertia": (), "pose": (), "sim": (*run, "-o", "-"),
            "tune": None, "record": None, "report": None, "view": None,
        }
        self.assertLessEqual(verbs, known.keys())
        for verb in sorted(verbs):
            if known[verb] is None:
                continue
            named = self.tenon(verb, HAND, *known[verb], "--pose", "point").stdout
            self.assertEqual(named, self.tenon(verb, HAND, *known[verb], "--pose", written).stdout,
                             verb)
            self.assertNotEqual(named, self.tenon(verb, HAND, *known[verb], "--pose",
                                                  "right_index_1_joint=1").stdout, verb)
        for verb in sorted(verbs - {"pose"}):
            words = {"record": ("-o", "out.png"), "report": ("-o", "out.html"),
                     "bake": ("-o", "out.usda")}.get(verb, ())
            done = self.tenon(verb, HAND, *words, "--pose", "pont", code=2)
            self.assertIn("did you mean point?", done.stderr, verb)

    def test_later_joints_count(self):
        self.hand()
        self.tenon("pose", HAND, "--save", "point", "--pose", "right_middle_1_joint=45")
        both = values(self.json("pose", HAND, "--pose", "point,right_middle_1_joint=5",
                                "--pose", "right_index_1_joint=7"))
        self.assertAlmostEqual(both["right_middle_1_joint"], math.radians(5), 9)
        self.assertAlmostEqual(both["right_index_1_joint"], math.radians(7), 9)


class Refusals(Case):
    def test_names(self):
        asset = self.arm()
        self.tenon("pose", asset, "--save", "bent", "--pose", "elbow=40")
        self.refused("pose.unknown", asset, "--show", "bend", says="did you mean bent?")
        self.refused("pose.unknown", asset, "--remove", "other")
        self.refused("pose.unknown", asset, "--rename", "other=more")
        self.refused("pose.has-it-already", asset, "--rename", "bent=bent")
        self.refused("edit.bad-argument", asset, "--rename", "bent")
        self.refused("edit.bad-name", asset, "--rename", "bent=1 x")
        self.refused("edit.bad-name", asset, "--save", "a b")
        self.refused("pose.bad-text", asset, "--save", "a", "--pose", "no=3")
        self.refused("usage.conflict", asset, "--save", "a", "--remove", "bent")
        self.refused("usage.conflict", asset, "--remove", "bent", "--pose", "elbow=3")
        self.refused("usage.conflict", asset, "--dry-run")

    def test_robots(self):
        asset = self.arm()
        self.refused("pose.no-robot", asset, "--save", "a", "--robot", "/no")
        (self.folder / "two.usda").write_text(
            '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n    kilogramsPerUnit = 1\n)\n'
            'def Xform "one" (\n    references = @arm.usda@</arm>\n'
            '    prepend apiSchemas = ["IsaacRobotAPI"]\n)\n{\n}\n'
            'def Xform "two" (\n    references = @arm.usda@</arm>\n'
            '    prepend apiSchemas = ["IsaacRobotAPI"]\n)\n{\n}\n')
        self.refused("pose.no-robot", "two.usda", "--save", "a", says="--robot /one")
        for robot, angle in (("/one", 10), ("/two", 30)):
            self.tenon("pose", "two.usda", "--save", "a", "--robot", robot, "--pose",
                       f"{robot}/elbow={angle}")
        self.refused("pose.same-name", "two.usda", "--show", "a", says="/one/Named_Poses/a")
        shown = self.json("pose", "two.usda", "--show", "/two/Named_Poses/a")["pose"]
        self.assertEqual({row["joint"] for row in shown["joints"]},
                         {"/two/shoulder", "/two/elbow"})
        (self.folder / "empty.usda").write_text('#usda 1.0\n(\n    defaultPrim = "a"\n)\n'
                                                'def Xform "a"\n{\n}\n')
        self.refused("pose.no-joints", "empty.usda", "--save", "a")

    def test_other_prim_of_the_name(self):
        asset = self.arm()
        self.tenon("add", asset, "/arm/Named_Poses=scope")
        self.tenon("add", asset, "/arm/Named_Poses/a=xform")
        self.refused("pose.no-pose", asset, "--save", "a")

    def test_targets(self):
        asset = self.arm()
        for text in ("/arm/fore/tip", "/arm/fore/tip=1,2", "/arm/fore/tip=1,2,x", "=1,2,3",
                     "/arm/fore/tip=1,2,inf"):
            self.refused("pose.bad-target", asset, "--ik", text)
        self.refused("pose.no-frame", asset, "--ik", "/arm/no=1,2,3")
        self.refused("pose.no-frame", asset, "--ik", "/arm=1,2,3", says="on no body")
        self.refused("pose.no-frame", asset, "--ik", "fort=1,2,3", says="did you mean fore?")
        place = ("--ik", "/arm/fore/tip=0.2,0.2,0")
        self.refused("pose.bad-target", asset, *place, "--rotation", "1,2")
        self.refused("pose.bad-target", asset, *place, "--rotation", "0,0,0,0")
        self.refused("pose.bad-target", asset, *place, "--rotation", "/arm/upper=0,0,1")
        self.refused("pose.no-joint", asset, *place, "--hold", "no")
        self.refused("pose.no-reach", asset, *place, "--hold", ".*")

    def test_pose_that_cannot_be_taken(self):
        asset = self.arm()
        self.tenon("pose", asset, "--save", "bent", "--pose", "elbow=40")
        text = (self.folder / asset).read_text()
        (self.folder / asset).write_text(text.replace("[</arm/shoulder>, </arm/elbow>]\n"
                                                      "            float[]", "X"))
        self.tenon("rename", asset, "/arm/elbow", "knee")
        self.tenon("sim", asset, "--duration", "0", "--pose", "bent")
        (self.folder / asset).write_text(text.replace("</arm/elbow>,", "</arm/fore>,")
                                         .replace("</arm/elbow>]", "</arm/fore>]"))
        self.refused("pose.joint-missing", asset, "--pose", "bent")
        listed = self.tenon("pose", asset).stdout
        self.assertIn("1 joint missing or beyond limits", listed)
        found = self.json("check", asset, "--only", "pose")["diagnostics"]
        self.assertEqual([row["rule"] for row in found], ["pose.joint-missing"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
