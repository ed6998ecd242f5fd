#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs that are driven, saved, continued, ended at rest and logged by `tenon sim`.

    test_sim.py ROOT TENON
"""

import csv
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    numpy = None

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
JOINT = "/inspire_hand/Physics/right_index_1_joint"
OUTPUTS = "contacts,efforts,reactions,accelerations,energy"
GRAVITY = 9.81

# A box above the ground, in centimetres: forces are in N whatever the unit of length.
BOX = """#usda 1.0
(
    metersPerUnit = 0.01
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "Scene"
{
    vector3f physics:gravityDirection = (0, 0, -1)
    float physics:gravityMagnitude = 981
}
def Cube "ground" (prepend apiSchemas = ["PhysicsCollisionAPI"])
{
    double size = 1
    double3 xformOp:translate = (0, 0, -50)
    double3 xformOp:scale = (1000, 1000, 100)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
}
def Cube "box" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
)
{
    float physics:mass = 2
    double size = 20
    double3 xformOp:translate = (0, 0, %g)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
# Two axes of one joint have drives, the others are locked.
GIMBAL = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "Scene"
{
    float physics:gravityMagnitude = 0
}
def Cube "box" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
)
{
    float physics:mass = 1
    double size = 0.2
}
def PhysicsJoint "joint" (
    prepend apiSchemas = ["PhysicsDriveAPI:transX", "PhysicsDriveAPI:rotX", %s]
)
{
    rel physics:body1 = </box>
    float drive:transX:physics:stiffness = 400
    float drive:transX:physics:damping = 40
    float drive:rotX:physics:stiffness = 0.1
    float drive:rotX:physics:damping = 0.01
%s}
""" % (", ".join(f'"PhysicsLimitAPI:{axis}"' for axis in ("transY", "transZ", "rotY", "rotZ")),
       "".join(f"    float limit:{axis}:physics:low = 1\n    float limit:{axis}:physics:high = -1\n"
               for axis in ("transY", "transZ", "rotY", "rotZ")))

# A ball that flies at a thin wall, 0.4 m a step.
BULLET = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "Scene"
{
    float physics:gravityMagnitude = 0
}
def Cube "wall" (prepend apiSchemas = ["PhysicsCollisionAPI"])
{
    double size = 1
    double3 xformOp:translate = (1, 0, 0)
    double3 xformOp:scale = (0.01, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
}
def Sphere "ball" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
{
    double radius = 0.02
    vector3f physics:velocity = (200, 0, 0)
}
"""

# A weight on a vertical drive; its mass triples within a second.
SCALE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
    timeCodesPerSecond = 24
)
def PhysicsScene "Scene"
{
    vector3f physics:gravityDirection = (0, 0, -1)
    float physics:gravityMagnitude = 10
}
def Cube "weight" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    float physics:mass.timeSamples = { 0: 1, 24: 3 }
}
def PhysicsPrismaticJoint "rail" (prepend apiSchemas = ["PhysicsDriveAPI:linear"])
{
    uniform token physics:axis = "Z"
    rel physics:body1 = </weight>
    float drive:linear:physics:stiffness = 1000
    float drive:linear:physics:damping = 100
    float physics:breakForce.timeSamples = { 0: 1000, 24: 2000 }
}
"""


def chain(links):
    """Free hinges across each other, in line and pulled sideways."""
    text = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "Scene"
{
    vector3f physics:gravityDirection = (4, 3, -8)
    float physics:gravityMagnitude = 9.4
}
"""
    for i in range(links):
        before = f"    rel physics:body0 = </link{i - 1}>\n" if i else ""
        text += f"""def Cube "link{i}" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
)
{{
    float physics:mass = 1
    float3 physics:diagonalInertia = (0.004, 0.004, 0.001)
    double3 xformOp:translate = (0, 0, {0.1 + 0.2 * i})
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def PhysicsRevoluteJoint "hinge{i}"
{{
    uniform token physics:axis = "{"YX"[i % 2]}"
{before}    rel physics:body1 = </link{i}>
    point3f physics:localPos0 = (0, 0, {0.1 if i else 0})
    point3f physics:localPos1 = (0, 0, -0.1)
}}
"""
    return text


class Sim(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.box = self.write("box.usda", BOX % 10)
        self.high = self.write("high.usda", BOX % 60)
        self.gimbal = self.write("gimbal.usda", GIMBAL)

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def sim(self, *arguments):
        return subprocess.run([TENON, "sim", *map(str, arguments)], capture_output=True, text=True,
                              check=False, timeout=120, cwd=self.folder)

    def ok(self, *arguments):
        process = self.sim(*arguments)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process

    def json(self, *arguments):
        return json.loads(self.ok(*arguments, "--json").stdout)

    def refused(self, expected, *arguments):
        """Exit 2, and all texts of `expected` in what is said; nothing is written."""
        process = self.sim(*arguments)
        self.assertEqual(process.returncode, 2, process.stderr)
        for text in expected:
            self.assertIn(text, process.stderr)
        self.assertIn("error", process.stderr)

    def rows(self, name):
        with open(self.folder / name, newline="", encoding="utf-8") as file:
            return [{key: value if "/" in value else float(value or "nan")
                     for key, value in row.items()} for row in csv.DictReader(file)]

    def lines(self, name):
        return [json.loads(line) for line in (self.folder / name).read_text().splitlines()]


class Commands(Sim):
    def test_move_a_joint_of_the_hand_to_its_target(self):
        path = self.write("c.csv", f"time,{JOINT}.target\n0.5,30\n")
        answer = self.json(HAND, "--commands", path, "--duration", 2, "-o", "run.csv")
        self.assertAlmostEqual(answer["joints"][JOINT]["position"][0], 30, delta=1)
        self.assertEqual(answer["commands"], {"file": str(path), "rows": 1, "columns": 1})
        plain = self.json(HAND, "--duration", 2, "-o", "plain.csv")
        self.assertLess(plain["joints"][JOINT]["position"][0], 20)
        self.assertNotIn("commands", plain)
        driven, free = self.rows("run.csv"), self.rows("plain.csv")
        before = [i for i, row in enumerate(free) if row["time"] <= 0.5]
        self.assertEqual([driven[i] for i in before], [free[i] for i in before])
        self.assertIn("1 row of 1 column", self.ok(HAND, "--commands", path,
                                                     "--duration", 0.1).stdout)

    def test_the_target_that_an_asset_has_and_one_that_is_commanded_are_the_same(self):
        path = self.write("c.csv", f"time,{JOINT}.target\n0,30\n")
        self.ok(HAND, "--commands", path, "--duration", 0.5, "-o", "a.csv")
        self.ok(HAND, "--set", f"{JOINT}.drive:angular:physics:targetPosition=30",
                "--duration", 0.5, "-o", "b.csv")
        for a, b in zip(self.rows("a.csv"), self.rows("b.csv")):
            self.assertAlmostEqual(a[f"{JOINT}.position"], b[f"{JOINT}.position"], places=4)

    def test_a_row_holds_until_the_next_and_an_empty_cell_goes_on(self):
        """Efforts of 2 N for 0.1 s and then none: v = F t / m, and x grows on evenly."""
        free = self.write("free.usda", GIMBAL.replace("400", "0").replace("40\n", "0\n"))
        path = self.write("c.csv", "time,/joint.effort.0,/joint.effort.1\r\n"
                          "0,2,\r\n0.05,,0\r\n0.1,0,\r\n\r\n")
        joint = self.json(free, "--commands", path, "--duration", 0.3, "--dt", 1e-3)["joints"]
        self.assertAlmostEqual(joint["/joint"]["velocity"][0], 0.2, places=9)
        self.assertAlmostEqual(joint["/joint"]["position"][0], 0.01 + 0.04, delta=2e-4)

    def test_name_the_axes_of_a_joint(self):
        path = self.write("c.csv", "time,/joint.target.transX,/joint.target.rotX,"
                          "/joint.velocityTarget.rotX\n0,0.25,40,0\n")
        joint = self.json(self.gimbal, "--commands", path, "--duration", 4)["joints"]["/joint"]
        self.assertAlmostEqual(joint["position"][0], 0.25, places=4)
        self.assertAlmostEqual(joint["position"][1], 40, places=2)

    def test_that_cannot_be_are_refused_with_their_place(self):
        column = f"{JOINT}.target"
        for text, expected in (
                ("", ["there is no header"]), ("seconds,a\n", [":1:1:", 'not "time"']),
                (f"time,{column}x\n0,1\n", [":1:6:", f"did you mean {column}?"]),
                (f"time,{JOINT}.angle\n0,1\n", [":1:6:", "this joint has", ".velocityTarget"]),
                ("time,/no.target\n", [":1:6:", "/no.target", ".effort, such as /"]), (
                    f"time,{column.rpartition('/')[2]}\n", [":1:6:", f"mean {column}?"]),
                (f"time,{column}\n", ["nothing"]), ("time\n0\n1\n", ["commands nothing"]),
                (f"time,{column},{column}\n", ["is there twice"]),
                (f"time,{column}\n0,1\n0,2\n", [":3:1:", "does not come after", "sort"]),
                (f"time,{column}\n1,1\n0.5,2\n", [":3:1:", "not come"]),
                (f"time,{column}\n0,nan\n", [":2:3:", "not a finite number"]),
                (f"time,{column}\ninf,1\n", [":2:1:", "not a finite number"]),
                (f"time,{column}\n0,1e999\n", [":2:3:", "not a finite number"]),
                (f"time,{column}\n0,fast\n", [":2:3:", '"fast"']),
                (f"time,{column}\n0\n", ["fewer cells"]), (f"time,{column}\n0,1,2\n", ["more"]),
                (f"time,{column}\n,1\n", [":2:1:", "not a finite number"]),
                ("time," + "x" * 100000, [":1:6:", "..."]),
                (b"time,\xff\xfe\x00\n", [":1:6:"])):
            with self.subTest(text[:60]):
                path = self.write("c.csv", text)
                self.refused(["c.csv", *expected, "sim.commands"], HAND, "--commands", path)
        self.refused(["none.csv"], HAND, "--commands", "none.csv")
        self.refused(["usage"], HAND, "--commands", "-")

    def test_of_numpy_are_those_of_a_table(self):
        if numpy is None:
            self.skipTest("numpy is not installed: make oracle")
        rows = "0,30,\n0.2,,0.01\n0.4,10,0\n"
        table = self.write("c.csv", f"time,{JOINT}.target,{JOINT}.effort\n{rows}")
        arrays = {"time": numpy.array([0, 0.2, 0.4]),
                  "columns": numpy.array([f"{JOINT}.target", f"{JOINT}.effort"]),
                  "values": numpy.array([[30, math.nan], [math.nan, 0.01], [10, 0]])}
        numpy.savez(self.folder / "c.npz", **arrays)
        numpy.savez_compressed(self.folder / "packed.npz", **arrays)
        self.ok(HAND, "--commands", table, "--duration", 0.6, "-o", "a.csv")
        self.ok(HAND, "--commands", "c.npz", "--duration", 0.6, "-o", "b.csv")
        self.assertEqual(self.rows("a.csv"), self.rows("b.csv"))
        self.refused(["packed.npz", "compressed", "savez"], HAND, "--commands", "packed.npz")
        damaged = (self.folder / "c.npz").read_bytes()[:-30]
        (self.folder / "short.npz").write_bytes(damaged)
        self.refused(["short.npz"], HAND, "--commands", "short.npz")

    def test_files_that_are_too_long_are_refused(self):
        with open(self.folder / "long.csv", "wb") as file:
            file.truncate(2**28 + 1)
        self.refused(["long.csv", "file.too-large"], HAND, "--commands", "long.csv")


class Gains(Sim):
    def test_below_zero_are_refused(self):
        drive = f"{JOINT}.drive:angular:physics"
        for gain in ("stiffness", "damping"):
            self.refused(["drive.negative-gain", f"{gain} is -1", "feeds energy in"],
                         HAND, "--set", f"{drive}:{gain}=-1", "--duration", 0.1)


class States(Sim):
    def test_a_run_that_is_continued_in_another_process_is_the_same_to_the_byte(self):
        path = self.write("c.csv", f"time,{JOINT}.target\n0,0\n0.4,30\n0.75,10\n")
        for more in ((), ("--log", OUTPUTS)):
            with self.subTest(more):
                run = (HAND, "--commands", path, *more)
                self.ok(*run, "--duration", 1, "-o", "whole.csv", "--state-out", "whole.state")
                self.ok(*run, "--duration", 0.5, "--state-out", "half.state", "-o", "first.csv")
                answer = self.json(*run, "--duration", 0.5, "--state-in", "half.state", "-o",
                                   "second.csv", "--state-out", "second.state")
                self.assertAlmostEqual(answer["begin"], 0.5)
                self.assertEqual(answer["steps"], 250)
                whole = (self.folder / "whole.csv").read_bytes().splitlines()
                second = (self.folder / "second.csv").read_bytes().splitlines()
                self.assertEqual(len(second), 1 + 31)
                if more:  # outputs of the first row are of no step
                    whole, second = whole[:1] + whole[-30:], second[:1] + second[-30:]
                else:
                    whole = whole[:1] + whole[-31:]
                self.assertEqual(whole, second)
                self.assertEqual((self.folder / "whole.state").read_bytes(),
                                 (self.folder / "second.state").read_bytes())

    def test_a_state_of_another_asset_is_refused(self):
        self.ok(self.box, "--duration", 0.1, "--state-out", "box.state")
        for arguments, expected in (
                ((HAND,), "another scene"), ((self.high,), "another scene"),
                ((self.box, "--dt", 0.001), "time steps"),
                ((self.box, "--set", "/box.physics:mass=3"), "another scene")):
            self.refused([expected, "box.state", "simulation.state"], *arguments,
                         "--state-in", "box.state", "--duration", 0.1)

    def test_bytes_that_are_no_state_are_refused(self):
        self.ok(self.box, "--duration", 0.1, "--state-out", "box.state")
        good = (self.folder / "box.state").read_bytes()
        damaged = [b"", b"\n", good[:13], good[:-1], good + b"x", b"x" * 1000,
                   good[:14] + b"\xff" * (len(good) - 14)]
        damaged += [good[:at] + bytes([good[at] ^ 0x41]) + good[at + 1:]
                    for at in range(0, len(good), 97)]
        for content in damaged:
            with self.subTest(content[:20]):
                self.write("bad.state", content)
                self.refused(["bad.state", "simulation.state"], self.box, "--state-in",
                             "bad.state", "--duration", 0.1, "-o", "out.csv")
                self.assertFalse((self.folder / "out.csv").exists())
        self.refused(["none.state"], self.box, "--state-in", "none.state")
        with open(self.folder / "long.state", "wb") as file:
            file.truncate(2**30 + 1)
        self.refused(["file.too-large"], self.box, "--state-in", "long.state")

    def test_a_state_that_is_read_is_not_written_over(self):
        self.ok(self.box, "--duration", 0.1, "--state-out", "box.state")
        before = (self.folder / "box.state").read_bytes()
        self.refused(["box.state"], self.box, "--duration", 0.1, "--state-in", "box.state",
                     "--state-out", "box.state")
        self.assertEqual((self.folder / "box.state").read_bytes(), before)
        self.refused(["output.kind"], self.box, "--state-out", "box.usda")

    def test_the_state_goes_to_standard_output_where_it_is_asked_for(self):
        self.ok(self.box, "--duration", 0.1, "--state-out", "box.state")
        process = subprocess.run([TENON, "sim", str(self.box), "--duration", "0.1", "--state-out",
                                  "-"], capture_output=True, check=True, timeout=120)
        self.assertEqual(process.stdout, (self.folder / "box.state").read_bytes())
        self.refused(["standard output"], self.box, "--state-out", "-", "-o", "-")


class Rest(Sim):
    def test_of_a_dropped_box_comes_soon_after_its_fall(self):
        """0.5 m of free fall take sqrt(2 h / g); rest lasts 0.2 s before it counts."""
        answer = self.json(self.high, "--until", "rest", "--duration", 10)
        fall = math.sqrt(2 * 0.5 / GRAVITY)
        self.assertTrue(answer["rest"]["reached"])
        since = answer["rest"]["since"]
        self.assertGreater(since, fall)
        self.assertLess(since, 5 * fall)
        self.assertAlmostEqual(answer["time"], since + 0.2, places=6)
        self.assertAlmostEqual(answer["bodies"]["/box"]["position"][2], 10, delta=0.1)
        self.assertIn("at rest since", self.ok(self.high, "--until", "rest").stdout)

    def test_that_never_comes_is_said(self):
        process = self.sim(self.high, "--until", "rest", "--duration", 0.2, "-o", "run.csv")
        self.assertEqual(process.returncode, 1)
        self.assertIn("sim.not-at-rest", process.stderr)
        self.assertTrue((self.folder / "run.csv").exists())
        process = self.sim(self.high, "--until", "rest", "--duration", 0.2, "--json")
        self.assertEqual(json.loads(process.stdout)["rest"], {"reached": False})

    def test_waits_for_the_last_command(self):
        path = self.write("c.csv", "time,/joint.target.transX\n1,0.1\n")
        answer = self.json(self.gimbal, "--commands", path, "--until", "rest", "--duration", 20)
        self.assertGreater(answer["rest"]["since"], 1)
        self.assertAlmostEqual(answer["joints"]["/joint"]["position"][0], 0.1, places=3)
        self.assertLess(self.json(self.gimbal, "--until", "rest")["time"], 0.3)


class Logs(Sim):
    def test_contact_forces_of_a_resting_box_are_its_weight(self):
        self.ok(self.box, "--duration", 3, "-o", "run.csv", "--log", "contacts")
        self.ok(self.box, "--duration", 3, "-o", "run.jsonl", "--log", "contacts")
        rows = self.rows("run.contacts.csv")
        last = [row for row in rows if row["time"] == rows[-1]["time"]]
        self.assertAlmostEqual(rows[-1]["time"], 3, places=6)
        self.assertEqual({(row["collider0"], row["collider1"]) for row in last},
                         {("/box", "/ground")})
        self.assertEqual(last[0]["body0"], "/box")
        # On collider 1, the ground: the weight points down.
        self.assertAlmostEqual(sum(row["normal.z"] * row["normalForce"] + row["frictionForce.z"]
                                   for row in last), -2 * GRAVITY, delta=1e-6)
        for row in last:
            self.assertAlmostEqual(row["point.z"], 0, delta=0.1)  # in cm, like the stage
        line = self.lines("run.jsonl")[-1]
        self.assertEqual(len(line["contacts"]), len(last))
        self.assertEqual([c["normalForce"] for c in line["contacts"]],
                         [row["normalForce"] for row in last])
        self.assertEqual(line["contacts"][0]["bodies"], ["/box", None])

    def test_accelerations_and_energy_of_a_fall(self):
        """In free fall a = -g, in units of the stage, and work and energy balance."""
        self.ok(self.high, "--duration", 0.2, "-o", "run.csv", "--log", "accelerations,energy",
                "--dt", 1e-4)
        rows = self.rows("run.csv")
        for row in rows[1:]:
            self.assertAlmostEqual(row["/box.linearAcceleration.z"], -981, places=3)
            total = row["energy.kinetic"] + row["energy.potential"]
            work = sum(row[key] for key in row if key.startswith("work."))
            start = rows[0]["energy.kinetic"] + rows[0]["energy.potential"]
            # A step of free fall loses m g^2 dt^2 / 2.
            self.assertAlmostEqual(total - start - work, -GRAVITY**2 * 1e-4 * row["time"],
                                   delta=2e-5)
        self.assertNotIn("/box.reactionForce.x", rows[0])

    def test_efforts_and_reactions_hold_a_driven_box(self):
        """A constant effort against the drive: at rest the drive exerts its opposite."""
        path = self.write("c.csv", "time,/joint.effort.0\n0,4\n")
        log = ("--commands", path, "--duration", 5, "--log", "efforts,reactions", "-o")
        self.ok(self.gimbal, *log, "run.csv")
        row = self.rows("run.csv")[-1]
        self.assertAlmostEqual(row["/joint.driveEffort.transX"], -4, places=6)
        self.assertAlmostEqual(row["/joint.driveEffort.rotX"], 0, places=6)
        self.assertIn("/joint.reactionTorque.z", row)
        self.ok(self.gimbal, *log, "run.jsonl")
        joint = self.lines("run.jsonl")[-1]["joints"]["/joint"]
        self.assertEqual(joint["driveEffort"], [row["/joint.driveEffort.transX"],
                                                row["/joint.driveEffort.rotX"]])
        self.assertEqual(len(joint["reactionForce"]), 3)

    def test_archives_have_the_same_numbers(self):
        try:
            import numpy
        except ImportError:
            self.skipTest("no numpy")
        for name in ("run.npz", "run.jsonl"):
            self.ok(self.box, "--duration", 0.2, "-o", name, "--log", OUTPUTS)
        archive, lines = numpy.load(self.folder / "run.npz"), self.lines("run.jsonl")
        frames = len(lines)
        self.assertEqual(archive["linear_acceleration"].shape, (frames, 1, 3))
        self.assertEqual(archive["contact_offsets"].shape, (frames + 1,))
        self.assertEqual(list(archive["linear_acceleration"][-1, 0]),
                         lines[-1]["bodies"]["/box"]["linearAcceleration"])
        names = [name.decode() for name in archive["work_names"]]
        self.assertEqual(dict(zip(names, archive["work"][-1])), lines[-1]["work"])
        first, end = archive["contact_offsets"][-2:]
        self.assertEqual(list(archive["contact_normal_force"][first:end]),
                         [c["normalForce"] for c in lines[-1]["contacts"]])

    def test_outputs_change_no_motion_and_the_same_input_gives_the_same_bytes(self):
        self.ok(self.high, "--duration", 0.6, "-o", "plain.csv")
        for name in ("a", "b"):
            self.ok(self.high, "--duration", 0.6, "-o", f"{name}.csv", "--log", OUTPUTS)
        for end in (".csv", ".contacts.csv"):
            self.assertEqual((self.folder / f"a{end}").read_bytes(),
                             (self.folder / f"b{end}").read_bytes())
        for plain, full in zip(self.rows("plain.csv"), self.rows("a.csv")):
            self.assertEqual(plain, {key: full[key] for key in plain})
        answer = self.json(self.high, "--duration", 0.1, "-o", "c.npz", "--log", "energy",
                           "--log", "contacts")
        self.assertEqual(answer["log"], ["contacts", "energy"])

    def test_that_cannot_be_written_are_refused_before_the_run(self):
        self.refused(["-o names none"], self.box, "--log", "energy")
        self.refused(["did you mean"], self.box, "-o", "run.csv", "--log", "contact")
        self.refused(["second table"], self.box, "-o", "-", "--log", "contacts")
        self.refused(["second table"], self.box, "-o", "/dev/null", "--format", "csv", "--log",
                     "contacts")
        (self.folder / "run.contacts.csv").mkdir()
        self.refused(["run.contacts.csv"], self.box, "-o", "run.csv", "--log", "contacts")
        process = self.ok(self.box, "--duration", 0.1, "-o", "-", "--format", "jsonl", "--log",
                          "contacts")
        self.assertIn('"contacts":[', process.stdout)


class Watch(Sim):
    def test_energy_from_nothing_is_unstable_with_body_and_time(self):
        process = self.sim(self.write("chain.usda", chain(6)), "--dt", 0.5, "--json")
        self.assertEqual(process.returncode, 3, process.stderr)
        answer = json.loads(process.stdout)
        self.assertTrue(answer["unstable"])
        self.assertAlmostEqual(answer["time"], answer["steps"] * answer["dt"])
        found = [d for d in answer["diagnostics"] if d["rule"] == "mujoco.unstable"]
        self.assertEqual(len(found), 1, answer["diagnostics"])
        self.assertTrue(found[0]["prim"].startswith("/link"), found)
        self.assertRegex(found[0]["message"], r"unstable at [0-9.]+ s")

    def test_what_leaves_the_finite_numbers_is_exit_3_on_every_engine_with_the_log_until_then(self):
        lost = self.write("lost.usda", BULLET.replace("(200, 0, 0)", "(1e12, 0, 0)"))
        for engine in ("mujoco", "physx", "jolt"):
            log = self.folder / f"{engine}.csv"
            process = self.sim(lost, "--engine", engine, "--duration", 1, "-o", log, "--json")
            self.assertEqual(process.returncode, 3, process.stderr)
            answer = json.loads(process.stdout)
            self.assertTrue(answer["unstable"])
            found = [d for d in answer["diagnostics"] if d["rule"] == f"{engine}.unstable"]
            self.assertEqual([d["prim"] for d in found], ["/ball"])
            self.assertRegex(found[0]["message"], r"unstable at [0-9.]+ s")
            self.assertEqual(len(self.rows(log.name)), answer["steps"] + 1)

    def test_a_ball_that_passes_a_wall_is_told(self):
        answer = self.json(self.write("bullet.usda", BULLET), "--duration", 0.1)
        found = [d for d in answer["diagnostics"] if d["rule"] == "sim.passed-through"]
        self.assertEqual([d["prim"] for d in found], ["/ball"])
        self.assertEqual(found[0]["related"][0]["path"], "/wall")
        self.assertEqual([event["prim"] for event in answer["events"]], ["/ball"])
        slow = self.json(self.write("bullet.usda", BULLET), "--duration", 0.1, "--dt", 5e-5)
        self.assertNotIn("sim.passed-through", [d["rule"] for d in slow["diagnostics"]])


class Samples(Sim):
    def test_a_mass_that_grows_sags_more(self):
        scale = self.write("scale.usda", SCALE)
        # m g / k
        for end, mass in ((0.6, None), (3, 3)):
            answer = self.json(scale, "--duration", end)
            sag = -answer["joints"]["/rail"]["position"][0]
            if mass:
                self.assertAlmostEqual(sag, mass * 10 / 1000, delta=1e-4)
            else:
                self.assertTrue(0.012 < sag < 0.025, sag)
            self.assertEqual(answer["notMapped"], [])
            self.assertEqual(answer["events"], [])

    def test_a_joint_that_grows_weaker_breaks(self):
        scale = self.write("weaker.usda", SCALE.replace("24: 2000", "24: 15"))
        answer = self.json(scale, "--duration", 2)
        self.assertEqual([event["prim"] for event in answer["events"]], ["/rail"])
        # 10 (1 + 2 t) N against 1000 - 985 t
        self.assertAlmostEqual(answer["events"][0]["time"], 990 / 1005, delta=0.05)

    def test_what_is_not_followed_is_said(self):
        step = SCALE.replace('"Scene"\n{', '"Scene" (prepend apiSchemas = ["PhysxSceneAPI"])\n{\n'
                             "    uint physxScene:timeStepsPerSecond.timeSamples = "
                             "{ 0: 500, 24: 600 }")
        answer = self.json(self.write("step.usda", step), "--duration", 0.1)
        self.assertEqual([(item["prim"], item["property"]) for item in answer["notMapped"]],
                         [("/Scene", "physxScene:timeStepsPerSecond")])


class Methods(Sim):
    def test_that_are_none_are_refused_with_the_list(self):
        self.refused(["euler, implicitfast, implicit, rk4"], self.box, "--integrator", "verlet")
        self.refused(["newton, cg, pgs"], self.box, "--solver", "jacobi")
        self.refused(["--iterations"], self.box, "--iterations", 0)

    def test_each_makes_another_motion_of_the_same_fall(self):
        ends = set()
        for name in ("euler", "implicitfast", "implicit", "rk4"):
            answer = self.json(self.high, "--duration", 0.2, "--integrator", name)
            ends.add(answer["bodies"]["/box"]["position"][2])
            # z = 60 - g t^2 / 2 cm; semi-implicit steps add g t dt / 2.
            self.assertAlmostEqual(answer["bodies"]["/box"]["position"][2], 60 - 981 * 0.02,
                                   delta=0.25)
        self.assertEqual(len(ends), 2)  # rk4 is exact, the others agree in a fall

    def test_fewer_iterations_leave_a_resting_box_less_well_held(self):
        wanted = ("--duration", 0.3, "--solver", "pgs", "--iterations")
        one = self.json(self.box, *wanted, 1)["bodies"]["/box"]["position"]
        many = self.json(self.box, *wanted, 100)["bodies"]["/box"]["position"]
        self.assertNotEqual(one, many)

    def test_a_state_of_other_methods_is_refused(self):
        self.ok(self.box, "--duration", 0.1, "--state-out", "s.state")
        self.refused(["methods"], self.box, "--duration", 0.1, "--state-in", "s.state",
                     "--integrator", "rk4")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
