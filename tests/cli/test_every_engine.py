#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What `tenon sim` promises of every engine, on every engine that is here and every example.

    test_every_engine.py SOURCES TENON
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv[1])
TENON = str(pathlib.Path(sys.argv[2]).absolute())


def run(*words, cwd=None):
    return subprocess.run([TENON, *map(str, words)], capture_output=True, text=True, cwd=cwd,
                          check=False)


def engines():
    return [engine["name"] for engine in json.loads(run("doctor", "--json").stdout)["engines"]
            if engine["available"]]


def series():
    """What --log can add, as the help lists it."""
    text = re.sub(r"\s+", " ", run("help", "sim").stdout)
    return re.search(r"--log WHAT .*?\((\w+(?:, \w+)+)\)", text)[1].split(", ")


def examples():
    """Layers of the examples that hold bodies."""
    for path in sorted((SOURCES / "examples").rglob("*.usda")):
        found = run("physics", path, "--json")
        if found.returncode < 2 and json.loads(found.stdout).get("bodies"):
            yield path


ENGINES, SERIES, EXAMPLES = engines(), series(), list(examples())


def numbers(value):
    """All numbers below a value of JSON."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for each in value:
            yield from numbers(each)
    elif isinstance(value, (int, float)):
        yield value


class EveryLog(unittest.TestCase):
    """Each series on each engine and example, from the frame at the start on."""

    def test_is_finite_from_the_start_on(self):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder, "run.jsonl")
            for engine in ENGINES:
                for example in EXAMPLES:
                    with self.subTest(engine=engine, example=example.name):
                        done = run("sim", example, "--engine", engine, "--duration", "0.01", "-o",
                                   log, "--log", ",".join(SERIES))
                        self.assertEqual(done.returncode, 0, done.stderr)
                        lines = [json.loads(line) for line in log.read_text().splitlines()]
                        frames = [line for line in lines if "time" in line]
                        self.assertEqual(frames[0]["time"], 0)
                        for number in numbers(lines):
                            self.assertTrue(math.isfinite(number))


# Cubes on hinges without a drive, of which the last lies in the first by 80 mm: what pushes them
# apart gives energy in every step.
OVERLAP = """#usda 1.0
(
    defaultPrim = "Robot"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Robot" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def PhysicsScene "Scene" {}
%s
    def PhysicsFixedJoint "base" { rel physics:body1 = </Robot/base_link>
    }
    def PhysicsRevoluteJoint "first"
    {
        rel physics:body0 = </Robot/base_link>
        rel physics:body1 = </Robot/upper>
        uniform token physics:axis = "X"
        point3f physics:localPos0 = (0, 0, 0.05)
        point3f physics:localPos1 = (0, 0, -0.05)
    }
    def PhysicsRevoluteJoint "second"
    {
        rel physics:body0 = </Robot/upper>
        rel physics:body1 = </Robot/inside>
        uniform token physics:axis = "X"
        point3f physics:localPos0 = (0, 0, -0.04)
        point3f physics:localPos1 = (-0.01, 0, 0.04)
    }
}
""" % "".join("""    def Cube "%s" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        double size = 0.1
        float physics:mass = %s
        double3 xformOp:translate = %s
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
""" % part for part in (("base_link", 1, "(0, 0, 0)"), ("upper", 0.01, "(0, 0, 0.1)"),
                        ("inside", 0.01, "(0.01, 0, 0.02)")))


class EnergyFromNowhere(unittest.TestCase):
    """No engine says that a run went well whose bodies move with energy that nothing gave."""

    def test_ends_the_run_with_the_body_and_the_time(self):
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "overlap.usda")
            scene.write_text(OVERLAP)
            for engine in ENGINES:
                with self.subTest(engine=engine):
                    done = run("sim", scene, "--engine", engine, "--duration", "1", "--json")
                    answer = json.loads(done.stdout)
                    if done.returncode == 0:  # this engine holds it, and then no energy came
                        self.assertLess(answer["energy"]["final"], 1)
                        continue
                    self.assertEqual(done.returncode, 3)
                    self.assertTrue(answer["unstable"])
                    [found] = [d for d in answer["diagnostics"]
                               if d["rule"] == engine + ".unstable"]
                    self.assertTrue(found["prim"].startswith("/Robot/"), found)
                    self.assertRegex(found["message"], r"unstable at [\d.e-]+ s")


class ManyAtOnePlace(unittest.TestCase):
    """Half a million pairs that touch would take gigabytes: refused before an engine starts."""

    def test_is_refused_with_the_limit_and_a_collider(self):
        apis = 'prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]'
        spheres = "".join(f'    def Sphere "b{i}" ({apis}) {{}}\n' for i in range(1000))
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder, "heap.usda")
            scene.write_text('#usda 1.0\ndef Xform "W"\n{\n' + spheres + "}\n")
            for engine in ENGINES:
                with self.subTest(engine=engine):
                    done = run("sim", scene, "--engine", engine, "--duration", "0.01")
                    self.assertEqual(done.returncode, 2)
                    self.assertIn("(kStartPairs)", done.stderr)
                    self.assertRegex(done.stderr, r"</W/b\d+>.*\[engine\.start-pairs\]")


# A finger of 20 g on a drive that is stiff, strong and far from its target: for steps of 2 ms only
# an integrator that takes positions implicitly holds it. The tip starts outside of its limit.
FINGER = """#usda 1.0
(
    defaultPrim = "Robot"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Robot" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def PhysicsScene "Scene" {}
    def Xform "hand" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 5
        float3 physics:diagonalInertia = (0.01, 0.01, 0.01)
    }
    def Xform "finger" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 0.02
        point3f physics:centerOfMass = (0.02, 0, 0)
        float3 physics:diagonalInertia = (1e-6, 3e-6, 3e-6)
    }
    def PhysicsFixedJoint "base" { rel physics:body1 = </Robot/hand>
    }
    def PhysicsRevoluteJoint "knuckle" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
    {
        rel physics:body0 = </Robot/hand>
        rel physics:body1 = </Robot/finger>
        uniform token physics:axis = "Y"
        %s
        float drive:angular:physics:stiffness = %s
        float drive:angular:physics:damping = %s
        float drive:angular:physics:maxForce = 1.4
        float drive:angular:physics:targetPosition = %s
    }
}
"""


class Joints(unittest.TestCase):
    """A joint that shakes, or ends outside of its limits, is told on every engine."""

    def simulate(self, scene, engine, *words):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "finger.usda")
            path.write_text(scene)
            if "--duration" not in words:
                words += ("--duration", "1")
            return json.loads(run("sim", path, "--engine", engine, "--json", *words).stdout)

    def told(self, answer):
        return {d["rule"]: d["prim"] for d in answer["diagnostics"]}

    def test_a_drive_that_holds_is_silent(self):
        for engine in ENGINES:
            with self.subTest(engine=engine):
                answer = self.simulate(FINGER % ("", 5.24, 0.17, 0), engine)
                [position] = answer["joints"]["/Robot/knuckle"]["position"]
                self.assertAlmostEqual(position, 0, delta=0.5)
                self.assertFalse({"sim.joint-shakes", "sim.beyond-limit"} & set(self.told(answer)))

    def test_a_shaking_joint_is_told_and_so_is_the_integrator(self):
        scene = FINGER % ("", 5.24, 0.17, 20)
        told = self.told(self.simulate(scene, "mujoco"))
        self.assertEqual(told["mujoco.coupled-drive"], "/Robot/knuckle")
        answer = self.simulate(scene, "mujoco", "--integrator", "implicitfast")
        told = self.told(answer)
        self.assertNotIn("mujoco.coupled-drive", told)  # the user's choice wins
        asset = scene.replace('PhysicsScene "Scene" {', 'PhysicsScene "Scene" '
                              '(prepend apiSchemas = ["MjcSceneAPI"])\n    {\n        '
                              'uniform token mjc:option:integrator = "implicitfast"\n    ')
        self.assertNotEqual(asset, scene)
        self.assertNotIn("mujoco.coupled-drive", self.told(self.simulate(asset, "mujoco")))
        if not answer["unstable"]:
            self.assertEqual(told["sim.joint-shakes"], "/Robot/knuckle")

    def test_a_joint_outside_of_its_limits_is_told(self):
        limits = ("float physics:lowerLimit = -10\n        float physics:upperLimit = 10\n"
                  "        float state:angular:physics:position = 60")
        drive = '"PhysicsDriveAPI:angular"'
        scene = (FINGER % (limits, 5.24, 0.17, 60)).replace(
            drive, drive + ', "PhysicsJointStateAPI:angular"')
        outside = 0
        for engine in ENGINES:
            for duration in ("0.004", "1"):
                with self.subTest(engine=engine, duration=duration):
                    answer = self.simulate(scene, engine, "--duration", duration)
                    if answer["unstable"]:
                        continue
                    [position] = answer["joints"]["/Robot/knuckle"]["position"]
                    is_outside = abs(position) > 10 + 2 + 0.02 * 20
                    outside += is_outside
                    self.assertEqual("sim.beyond-limit" in self.told(answer), is_outside)
        self.assertGreater(outside, 0)


# An arm of 2 kg with its centre 0.2 m from the hinge: 3.92 N m where it is level.
ARM = """#usda 1.0
(
    defaultPrim = "Robot"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Robot" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def PhysicsScene "Scene" {}
    def Xform "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 5
        float3 physics:diagonalInertia = (0.1, 0.1, 0.1)
    }
    def Xform "arm" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 2
        point3f physics:centerOfMass = (0.2, 0, 0)
        float3 physics:diagonalInertia = (0.01, 0.02, 0.02)
        def Cube "Shape" (prepend apiSchemas = ["PhysicsCollisionAPI"])
        {
            double size = 0.1
            double3 xformOp:translate = (0.3, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
    }
    def PhysicsFixedJoint "root" { rel physics:body1 = </Robot/base>
    }
    def Physics%sJoint "elbow" (prepend apiSchemas = ["PhysicsDriveAPI:%s"])
    {
        rel physics:body0 = </Robot/base>
        rel physics:body1 = </Robot/arm>
        uniform token physics:axis = "%s"
        float drive:%s:physics:stiffness = %s
        float drive:%s:physics:damping = %s
        float drive:%s:physics:maxForce = %s
        uniform token drive:%s:physics:type = "%s"
    }
%s}
"""

TABLE = """    def Cube "Table" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        double size = 0.2
        double3 xformOp:translate = (0.3, 0, -0.152)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
"""


def arm(kind, stiffness, damping, most="inf", how="force", more=""):
    turns = kind == "Revolute"
    of = "angular" if turns else "linear"
    return ARM % (kind, of, "Y" if turns else "Z", of, stiffness, of, damping, of, most, of, how,
                  more)


def ending_at(limit, text):
    axis = 'axis = "Y"'
    return text.replace(axis, f"{axis}\n        float physics:upperLimit = {limit}")


def aiming_at(target, text):
    drive = "float drive:linear:physics:damping"
    aim = f"float drive:linear:physics:targetPosition = {target}\n        "
    return text.replace(drive, aim + drive)


class DrivesThatSag(unittest.TestCase):
    """A drive that weight keeps away from its target is told with the weight on every engine, and
    one that holds, rests on something or is commanded is not."""

    # name, scene, severity (none: silent), words of the message
    SCENES = (
        ("weak", arm("Revolute", 0.3, 0.05), "info", ("takes 3.8", "stiffness")),
        ("a little weak", arm("Revolute", 1.5, 0.3), "info", ("takes 3.9", "stiffness")),
        ("strong", arm("Revolute", 30, 3), None, ()),
        ("limited", ending_at(40, arm("Revolute", 30, 3, most="1")), "warning",
         ("maxForce is 1 N m",)),
        ("by acceleration", arm("Revolute", 3, 0.5, how="acceleration"), "info",
         ("stiffness",)),
        ("weak lift", arm("Prismatic", 500, 100), "info", ("takes 19.6 N", "0.0392 m")),
        ("weak, at a limit", ending_at(20, arm("Revolute", 0.06, 0.05)), "info",
         ("takes 3.6", "20 degrees")),
        ("strong lift", arm("Prismatic", 50000, 1000), None, ()),
        ("presses down on a table", aiming_at(-0.05, arm("Prismatic", 5000, 300, more=TABLE)), None,
         ()),
        ("presses up against a table", aiming_at(0.05, arm(
            "Prismatic", 5000, 300, more=TABLE.replace("-0.152", "0.152"))), None, ()),
    )

    def told(self, text, engine, *words):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "arm.usda")
            path.write_text(text)
            pathlib.Path(folder, "commands.csv").write_text("time,/Robot/elbow.target\n0,0\n")
            done = run("sim", path, "--engine", engine, "--json", "--duration", "4",
                       *(word.replace("FOLDER", folder) for word in words))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            return {d["rule"]: d for d in json.loads(done.stdout)["diagnostics"]}

    def test_each_on_every_engine(self):
        for name, text, severity, words in self.SCENES:
            for engine in ENGINES:
                with self.subTest(scene=name, engine=engine):
                    found = self.told(text, engine).get("sim.drive-sags")
                    self.assertEqual(found and found["severity"], severity)
                    if found:
                        self.assertEqual(found["prim"], "/Robot/elbow")
                        for word in words:
                            self.assertIn(word, found["message"] + found["fix"])

    def test_the_advice_holds_the_arm(self):
        for engine in ENGINES:
            with self.subTest(engine=engine):
                found = self.told(arm("Revolute", 0.3, 0.05), engine)["sim.drive-sags"]
                factor = float(re.search(r"stiffness ([\d.]+) times", found["fix"])[1])
                held = self.told(arm("Revolute", 0.3 * factor * 1.05, 2), engine)
                self.assertNotIn("sim.drive-sags", held)

    def test_a_limit_may_bring_the_joint_back_against_its_drive(self):
        """That stretches the drive, and is no energy from nowhere."""
        bounds = ('axis = "Y"\n        float physics:lowerLimit = 47\n'
                  "        float physics:upperLimit = 120")
        text = arm("Revolute", 15, 1).replace('axis = "Y"', bounds)
        for engine in ENGINES:
            with self.subTest(engine=engine):
                self.assertIn("joint.outside-limit", self.told(text, engine))

    def test_what_is_commanded_is_not_asked(self):
        for engine in ENGINES:
            with self.subTest(engine=engine):
                told = self.told(arm("Revolute", 0.3, 0.05), engine, "--commands",
                                 "FOLDER/commands.csv")
                self.assertNotIn("sim.drive-sags", told)


def scene(gravity, parts):
    return """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "Scene" { float physics:gravityMagnitude = %s
    }
%s}
""" % (gravity, "".join(parts))


def cube(name, at, size, apis, lines=()):
    return """    def Cube "%s" (prepend apiSchemas = [%s])
    {
        double size = %s
        double3 xformOp:translate = %s
        uniform token[] xformOpOrder = ["xformOp:translate"]
%s    }
""" % (name, ", ".join(f'"{api}"' for api in apis), size, at,
       "".join(f"        {line}\n" for line in lines))


BODY = ("PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysicsCollisionAPI")


class EachEngine(unittest.TestCase):
    """Scenes whose answer is known, on each engine."""

    def simulate(self, layer, engine, duration, *words):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "scene.usda")
            path.write_text(layer)
            done = run("sim", path, "--engine", engine, "--duration", duration, "--json", *words)
            return json.loads(done.stdout)

    def rules(self, answer):
        return {d["rule"] for d in answer["diagnostics"]}

    def test_a_joint_breaks_above_its_limit_alone(self):
        """A lever of 1 m with 1 kg at its end, and one of 10 kg that hangs: 1 % on either side."""
        for engine in ENGINES:
            for kind, mass, limit, load in (("Torque", 1, "breakTorque", 9.81),
                                            ("Force", 10, "breakForce", 98.1)):
                for share in (0.99, 1.01):
                    with self.subTest(engine=engine, kind=kind, share=share):
                        layer = scene(9.81, [
                            cube("load", "(1, 0, 0)", 0.1, BODY,
                                 [f"float physics:mass = {mass}"]),
                            '    def PhysicsFixedJoint "holds"\n    {\n'
                            "        rel physics:body1 = </World/load>\n"
                            "        point3f physics:localPos1 = (-1, 0, 0)\n"
                            f"        float physics:{limit} = {load * share}\n    }}\n"])
                        answer = self.simulate(layer, engine, "0.5")
                        broke = [e for e in answer["events"] if "broke" in e["what"]]
                        self.assertEqual(len(broke), 1 if share < 1 else 0, answer["events"])

    def test_what_passes_through_a_wall_is_told(self):
        for engine in ENGINES:
            for speed in (1, 50):
                with self.subTest(engine=engine, speed=speed):
                    layer = scene(0, [
                        cube("wall", "(1, 0, 0)", 0.01, ["PhysicsCollisionAPI"],
                             ["float3 xformOp:scale = (1, 100, 100)"]).replace(
                                 '["xformOp:translate"]',
                                 '["xformOp:translate", "xformOp:scale"]'),
                        cube("ball", "(0, 0, 0)", 0.02, BODY,
                             [f"vector3f physics:velocity = ({speed}, 0, 0)"])])
                    answer = self.simulate(layer, engine, str(1.5 / speed))
                    passed = answer["bodies"]["/World/ball"]["position"][0] > 1.01
                    told = [d["prim"] for d in answer["diagnostics"]
                            if d["rule"] == "sim.passed-through"]
                    self.assertEqual(told, ["/World/ball"] if passed else [])

    def test_a_body_that_tumbles_too_fast_is_told(self):
        inertia = "float3 physics:diagonalInertia = (0.01, 0.02, 0.03)"
        bodies = {speed: scene(0, [cube("body", "(0, 0, 0)", 0.1, BODY, [
            "float physics:mass = 1", inertia,
            f"vector3f physics:angularVelocity = ({20 * speed}, {speed}, {60 * speed})"])])
            for speed in (1, 57.3)}
        for engine in ENGINES:
            for speed, layer in bodies.items():
                with self.subTest(engine=engine, speed=speed):
                    answer = self.simulate(layer, engine, "1")
                    self.assertEqual("sim.fast-spin" in self.rules(answer), speed > 1)
        answer = self.simulate(bodies[57.3], "mujoco", "1", "--integrator", "rk4")
        self.assertFalse({"sim.fast-spin", "sim.energy-drift"} & self.rules(answer))

    def test_what_starts_asleep_stays_there(self):
        layer = scene(9.81, [cube("box", "(0, 0, 2)", 0.1, BODY, [
            "bool physics:startsAsleep = 1", "vector3f physics:velocity = (0.5, 0, 0)"])])
        for engine in ENGINES:
            with self.subTest(engine=engine):
                answer = self.simulate(layer, engine, "0.5")
                self.assertEqual(answer["bodies"]["/World/box"]["position"], [0, 0, 2])
                self.assertAlmostEqual(answer["energy"]["initial"], answer["energy"]["final"])

    def test_a_locked_axis_is_held_against_gravity(self):
        layer = scene(9.81, [cube("box", "(0, 0, 2)", 0.1, (*BODY, "PhysxRigidBodyAPI"), [
            "int physxRigidBody:lockedPosAxis = 4", "vector3f physics:velocity = (1, 0, 0)"])])
        for engine in ENGINES:
            with self.subTest(engine=engine):
                answer = self.simulate(layer, engine, "0.5")
                for found, wanted in zip(answer["bodies"]["/World/box"]["position"], (0.5, 0, 2)):
                    self.assertAlmostEqual(found, wanted, delta=1e-3)

    def test_a_lock_of_a_link_that_physx_ignores_takes_no_gravity(self):
        """A hanging lever whose link asks for a locked axis: PhysX has locks of free bodies alone,
        and what it ignores must not change how the lever swings."""
        layer = scene(9.81, [
            cube("load", "(1, 0, 0)", 0.1, (*BODY, "PhysxRigidBodyAPI"),
                 ["float physics:mass = 1", "%s"]),
            '    def PhysicsRevoluteJoint "swings" (prepend apiSchemas = '
            '["PhysicsArticulationRootAPI"])\n    {\n'
            "        rel physics:body1 = </World/load>\n"
            '        uniform token physics:axis = "Y"\n'
            "        point3f physics:localPos1 = (-1, 0, 0)\n    }\n"])
        places = [self.simulate(layer % lock, "physx", "0.3")["bodies"]["/World/load"]["position"]
                  for lock in ("", "int physxRigidBody:lockedPosAxis = 4")
                  if "physx" in ENGINES]
        self.assertEqual(places[:1], places[1:])

    def test_a_force_of_the_asset_is_no_energy_from_nowhere(self):
        layer = scene(0, [cube("box", "(0, 0, 2)", 0.1, (*BODY, "PhysxForceAPI"), [
            "float physics:mass = 1", "vector3f physxForce:force = (1000, 0, 0)",
            'uniform token physxForce:mode = "force"'])])
        for engine in ENGINES:
            with self.subTest(engine=engine):
                answer = self.simulate(layer, engine, "0.5")
                self.assertFalse(answer["unstable"], answer["diagnostics"])
                [speed, _, _] = answer["bodies"]["/World/box"]["linearVelocity"]
                self.assertAlmostEqual(speed, 500, delta=1)


class Settings(unittest.TestCase):
    """Each run says what it was made with."""

    def test_of_each_engine_and_as_asked_for(self):
        example = EXAMPLES[0]
        for engine in ENGINES:
            with self.subTest(engine=engine):
                words = ("sim", example, "--engine", engine, "--duration", "0.01")
                settings = json.loads(run(*words, "--json").stdout)["engineSettings"]
                for name in ("integrator", "solver"):
                    self.assertIsInstance(settings[name], str)
                self.assertTrue(any(name.lower().endswith("iterations") for name in settings))
                self.assertIsInstance(settings["selfCollision"], dict)
                shown = run(*words, "-v").stdout
                for name in settings:
                    if name != "selfCollision" or settings[name]:
                        self.assertIn("  " + name, shown)
        settings = json.loads(run("sim", example, "--engine", "mujoco", "--duration", "0.01",
                                  "--integrator", "rk4", "--solver", "cg", "--iterations", "7",
                                  "--json").stdout)["engineSettings"]
        self.assertEqual([settings[name] for name in ("integrator", "solver", "iterations")],
                         ["rk4", "cg", 7])


ROBOT = """<robot name="pair">
  %s
  <joint name="a" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="b" type="fixed"><parent link="upper"/><child link="lower"/>
    <origin xyz="0.02 0 0"/></joint>
</robot>
""" % "".join(f"""<link name="{name}">
    <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    </inertial>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  """ for name in ("base", "upper", "lower"))


class SelfCollision(unittest.TestCase):
    """Converted robots say whether their links touch each other, and engines do as they say."""

    def test_is_off_for_urdf_unless_it_is_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            urdf = pathlib.Path(folder, "pair.urdf")
            urdf.write_text(ROBOT)
            for words, on in (((), False), (("--self-collision", "off"), False),
                              (("--self-collision", "on"), True)):
                for output in ("flat.usda", "layers"):
                    path = pathlib.Path(folder, f"{on}{len(words)}{output}")
                    done = run("convert", urdf, path, "--fix-base", *words, "-v")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual("convert.self-collision" in done.stderr, not words)
                    asset = path / "pair.usda" if output == "layers" else path
                    for engine in ENGINES:
                        with self.subTest(words=words, output=output, engine=engine):
                            answer = json.loads(run("sim", asset, "--engine", engine, "--duration",
                                                    "0.01", "--json").stdout)
                            said = answer["engineSettings"]["selfCollision"]
                            self.assertEqual(list(said.values()), [on])
                            self.assertEqual(answer["contacts"] > 0, on)



if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
