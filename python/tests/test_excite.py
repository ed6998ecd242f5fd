# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon excite`: motions keep the limits of the asset, in the algebra and on each engine; what
they take follows closed forms; nothing touches on the way; files are what others read.

    test_excite.py
"""

import json
import math
import os
import re
import subprocess
import sys
import sysconfig
import unittest

import numpy as np
import support

import tenon_usd as tenon
from tenon_usd.errors import MissingError
from tenon_usd.identify import trajectory_files
from tenon_usd.identify.channels import Reading
from tenon_usd.identify.curves import KINDS
from tenon_usd.identify.excite import ExciteError, excite
from tenon_usd.identify.excite_command import _parser, main
from tenon_usd.identify.joints import asset_joints
from tenon_usd.identify.log_files import read_log
from tenon_usd.identify.moving import Mover
from tenon_usd.identify.quality import assess

PROGRAM = os.path.join(sysconfig.get_path("scripts"), "tenon")
if not os.path.exists(PROGRAM):
    PROGRAM = os.path.join(os.path.dirname(tenon.__file__), "bin", "tenon")
G = 9.81
HEAD = '#usda 1.0\n(\n    defaultPrim = "W"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'


def joint(name, body0, body1, at0, limits=(-90, 90), effort=20.0, speed=180.0, gains=(1.0, 0.05),
          kind="Revolute", axis="Y"):
    """A joint with a drive; gains per degree, or per metre."""
    drive = "angular" if kind == "Revolute" else "linear"
    parents = f"    rel physics:body0 = </W/{body0}>\n" if body0 else ""
    return f'''    def Physics{kind}Joint "{name}" (
        prepend apiSchemas = ["PhysicsDriveAPI:{drive}", "PhysxJointAPI"]
    )
    {{
    {parents}        rel physics:body1 = </W/{body1}>
        uniform token physics:axis = "{axis}"
        point3f physics:localPos0 = {at0}
        float physics:lowerLimit = {limits[0]}
        float physics:upperLimit = {limits[1]}
        float physxJoint:maxJointVelocity = {speed}
        float drive:{drive}:physics:stiffness = {gains[0]}
        float drive:{drive}:physics:damping = {gains[1]}
        float drive:{drive}:physics:maxForce = {effort}
    }}
'''


def body(name, place, mass=1.0, center=(0.25, 0, 0), size=0.05):
    return f'''    def Xform "{name}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {{
        double3 xformOp:translate = {place}
        uniform token[] xformOpOrder = ["xformOp:translate"]
        float physics:mass = {mass}
        point3f physics:centerOfMass = {center}
        float3 physics:diagonalInertia = (0.01, 0.02, 0.03)
        def Cube "shape" (
            prepend apiSchemas = ["PhysicsCollisionAPI"]
        )
        {{
            double size = {size}
            double3 xformOp:translate = {center}
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }}
    }}
'''


def arm(more="", **of_shoulder):
    """Two links that turn about y, the first on the world."""
    return (HEAD + 'def Xform "W" (\n    prepend apiSchemas = ["PhysicsArticulationRootAPI"]\n)\n'
            + '{\n    def PhysicsScene "Scene"\n    {\n    }\n'
            + body("upper", (0, 0, 1)) + body("lower", (0.5, 0, 1))
            + joint("shoulder", "", "upper", (0, 0, 1), **of_shoulder)
            + joint("elbow", "upper", "lower", (0.5, 0, 0)) + more + "}\n")


class Excite(support.FilesTestCase):
    def scene(self, text):
        return tenon.physics(self.written("arm.usda", text))

    # ---- algebra

    def test_efforts_are_those_of_a_pendulum(self):
        scene = self.scene(arm())
        chosen = [each for each in asset_joints(scene) if each.short == "shoulder"]
        mover = Mover(scene, chosen)
        for angle, speed, turn in ((0.0, 0.0, 0.0), (0.5, 0.0, 3.0), (-1.0, 2.0, -4.0)):
            found = mover.effort(np.array([angle]), np.array([speed]), np.array([turn]))[0]
            # The elbow is held: one pendulum of two masses, which turns its x axis down.
            inertia = 2 * 0.02 + 0.25**2 + 0.75**2
            weight = -G * (0.25 + 0.75) * math.cos(angle)
            self.assertAlmostEqual(found, inertia * turn + weight, places=5)

    def test_the_regressor_times_the_numbers_of_the_asset_is_the_effort(self):
        scene = self.scene(arm())
        mover = Mover(scene, asset_joints(scene))
        random = np.random.default_rng(1)
        position, velocity, acceleration = random.normal(size=(3, 5, 2))
        numbers = [0.0] * 6
        for index in mover.bodies:
            link = scene.bodies[index]
            center = np.asarray(link.center_of_mass)
            inertia = np.asarray(link.inertia) + link.mass * (
                center @ center * np.eye(3) - np.outer(center, center))
            numbers += [link.mass, *(link.mass * center), *np.diag(inertia), inertia[0, 1],
                        inertia[0, 2], inertia[1, 2]]
        found = mover.regressors(position, velocity, acceleration) @ np.array(numbers)
        for k in range(5):
            np.testing.assert_allclose(found[k], mover.effort(
                position[k], velocity[k], acceleration[k]), atol=1e-5)

    # ---- limits

    def kept(self, motion, part=1.0):
        """Limits of position, speed and effort hold in every row."""
        for k, each in enumerate(motion.joints):
            position, speed = motion.position[:, k], motion.velocity[:, k]
            self.assertGreaterEqual(position.min(), each.lower - 1e-9, each.name)
            self.assertLessEqual(position.max(), each.upper + 1e-9, each.name)
            self.assertLessEqual(abs(speed).max(), part * each.velocity_limit, each.name)
            self.assertLessEqual(motion.effort[k], part * each.effort_limit, each.name)

    def test_each_kind_keeps_the_limits(self):
        scene = self.scene(arm())
        for kind in KINDS:
            motion = excite(scene, kind=kind, duration=16.0, search=5)
            self.kept(motion, 0.85)
            np.testing.assert_allclose(motion.position[[0, -1]], 0, atol=1e-9)
            self.assertTrue(np.all(np.ptp(motion.position, axis=0) > 0.05), kind)
            self.assertEqual(motion.times[0], 0.0)

    def test_little_effort_makes_it_smaller(self):
        strong = excite(self.scene(arm()), duration=6.0, search=5)
        weak = excite(self.scene(arm(effort=14.0)), duration=6.0, search=5)
        self.kept(weak, 0.81)
        self.assertLess(np.ptp(weak.position[:, 0]), 0.7 * np.ptp(strong.position[:, 0]))
        with self.assertRaises(ExciteError) as caught:  # it cannot even hold the arm
            excite(self.scene(arm(effort=2.0)), duration=6.0, search=5)
        self.assertEqual(caught.exception.rule, "excite.weight")
        self.assertIn("shoulder", str(caught.exception))

    def test_a_wall_makes_it_smaller(self):
        wall = '''    def Cube "wall" (
        prepend apiSchemas = ["PhysicsCollisionAPI"]
    )
    {
        double size = 0.2
        double3 xformOp:translate = (0.75, 0, 1.3)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
'''
        scene = self.scene(arm(wall))
        free = excite(scene, duration=6.0, search=5, collisions=False)
        mover = Mover(scene, free.joints)
        self.assertTrue(mover.touching(free.position[::5]))
        motion = excite(scene, duration=6.0, search=5)
        self.assertEqual(mover.touching(motion.position[::3]), [])
        self.assertIn("touch", [note for note in motion.notes
                                if note.rule == "excite.shrunk"][0].message)
        self.assertTrue(np.all(motion.shrunk < 1))

    def test_what_cannot_be_excited_is_told(self):
        follower = joint("slide", "lower", "tip", (0.5, 0, 0), (0, 0.1), kind="Prismatic",
                         gains=(0.0, 0.0), axis="X") + body("tip", (1, 0, 1), 0.1, (0, 0, 0))
        scene = self.scene(arm(follower))
        motion = excite(scene, duration=2.0, search=2)
        self.assertEqual([each.short for each in motion.joints], ["shoulder", "elbow"])
        self.assertIn("slide: has no drive", motion.notes[0].message)
        for options, rule in (({"joints": "slide"}, "excite.joints"),
                              ({"joints": "wrist"}, "excite.joints"),
                              ({"joints": "("}, "excite.joints"),
                              ({"joints": "(a+)+$"}, "excite.joints"),
                              ({"kind": "walk"}, "excite.options"),
                              ({"step": 0.0}, "excite.options"),
                              ({"duration": math.nan}, "excite.options"),
                              ({"effort": 2.0}, "excite.options"),
                              ({"search": 0}, "excite.options"),
                              ({"duration": 36000.0, "step": 1e-4}, "excite.options")):
            with self.assertRaises(ExciteError) as caught:
                excite(scene, **options)
            self.assertEqual(caught.exception.rule, rule)
            self.assertTrue(caught.exception.fix)

    # ---- information

    def test_a_search_finds_more_and_the_seed_decides(self):
        scene = self.scene(arm())
        few, many = (excite(scene, duration=6.0, search=count, seed=3) for count in (1, 40))
        self.assertGreater(many.log_det, few.log_det + 0.5)
        self.assertLess(many.condition, 20)
        self.assertTrue(np.all(many.crest < 3.5), many.crest)
        again = excite(scene, duration=6.0, search=40, seed=3)
        np.testing.assert_array_equal(many.position, again.position)
        other = excite(scene, duration=6.0, search=1, seed=4)
        self.assertGreater(np.abs(other.position - few.position).max(), 0.01)

    # ---- files

    def test_files_are_tables_and_messages(self):
        motion = excite(self.scene(arm()), duration=2.0, search=2)
        for ending in ("csv", "npz", "yaml"):
            trajectory_files.write(motion, self.folder / f"m.{ending}")
        head, *rows = (self.folder / "m.csv").read_text().splitlines()
        self.assertEqual(head, "time,/W/shoulder.target,/W/shoulder.velocityTarget,/W/elbow.target,"
                         "/W/elbow.velocityTarget")
        table = np.array([[float(cell) for cell in row.split(",")] for row in rows])
        np.testing.assert_allclose(np.radians(table[:, 1]), motion.position[:, 0], atol=1e-8)
        with np.load(self.folder / "m.npz") as archive:
            np.testing.assert_allclose(archive["values"], table[:, 1:], atol=1e-6)
        text = (self.folder / "m.yaml").read_text()
        self.assertIn("joint_names: ['shoulder', 'elbow']", text)
        self.assertEqual(text.count("time_from_start"), len(motion.times))
        last = re.findall(r"positions: \[(.*)\]", text)[-1]
        np.testing.assert_allclose([float(each) for each in last.split(",")], motion.position[-1],
                                   atol=1e-8)
        for bad in ("m.txt", "gone/m.csv"):
            with self.assertRaises(ExciteError):
                trajectory_files.write(motion, self.folder / bad)

    # ---- engines

    def driven(self, asset, name, duration, engine):
        """The log of a run that follows a command table, read with its commands."""
        log = self.folder / f"{engine}.csv"
        subprocess.run([PROGRAM, "sim", asset, "--engine", engine, "--commands", name, "--duration",
                        f"{duration:g}", "--log", "efforts", "--fps", "100", "-q", "-o", log],
                       check=True, capture_output=True)
        return read_log(log, tenon.physics(asset), Reading(commands=name))

    def held(self, log, joints, kind):
        by_name = {each.name: each for each in joints}
        for k, name in enumerate(log.joints):
            each = by_name[name]
            position, speed = log.position[:, k], log.velocity[:, k]
            slack = 2e-3 * each.span + 1e-3  # of soft limits
            told = f"{kind} {name}"
            self.assertGreaterEqual(position.min(), each.lower - slack, told)
            self.assertLessEqual(position.max(), each.upper + slack, told)
            self.assertLessEqual(abs(speed).max(), 1.01 * each.velocity_limit, told)
            effort = log.effort[:, k] if log.effort is not None else np.zeros(1)
            if np.all(np.isfinite(effort)):
                self.assertLessEqual(abs(effort).max(), each.effort_limit * 1.01, told)

    def test_engines_follow_within_the_limits(self):
        there = [row["name"] for row in tenon.engines() if row["available"]]
        for asset, kinds, joints in ((self.written("arm.usda", arm()), KINDS, ""),
                                     (support.HAND, ("multisine",), "index|thumb")):
            scene = tenon.physics(asset)
            for kind in kinds:
                motion = excite(scene, kind=kind, joints=joints, duration=4.0, search=3)
                name = self.folder / "motion.csv"
                trajectory_files.write(motion, name)
                engines = [each for each in ("mujoco", "physx", "jolt") if each in there]
                self.assertTrue(engines)
                for engine in engines:
                    log, _ = self.driven(asset, name, motion.times[-1], engine)
                    self.held(log, asset_joints(scene), f"{engine} {kind}")
                    if kind == "multisine":
                        self.followed(log, motion, assess(log, asset_joints(scene)), engine)

    def test_logs_of_runs_say_the_same_in_each_format(self):
        asset = self.written("arm.usda", arm())
        logs = []
        for ending in ("csv", "npz", "jsonl"):
            name = self.folder / f"run.{ending}"
            subprocess.run([PROGRAM, "sim", asset, "--duration", "0.5", "--log", "efforts,contacts",
                            "--fps", "100", "-q", "-o", name], check=True, capture_output=True)
            logs.append(read_log(name, tenon.physics(asset))[0])
        self.assertEqual(logs[0].signals, ("position", "velocity", "effort"))
        for other in logs[1:]:
            for signal in logs[0].signals:
                np.testing.assert_allclose(getattr(other, signal), getattr(logs[0], signal),
                                           atol=1e-9)

    def followed(self, log, motion, quality, engine):
        """What was asked for is what was done, nearly."""
        names = [each.name for each in motion.joints]
        for row in quality.joints:
            if row.joint not in names:
                continue
            asked = float(np.ptp(motion.position[:, names.index(row.joint)]))
            self.assertAlmostEqual(row.moved / asked, 1, delta=0.2, msg=f"{engine} {row}")
            self.assertLess(abs(row.delay), 0.1, f"{engine} {row}")

    # ---- the command

    def run_main(self, *words):
        done = subprocess.run(
            [sys.executable, "-m", "tenon_usd.identify.excite_command", *map(str, words)],
            capture_output=True, text=True, cwd=self.folder, check=False)
        return done.returncode, done.stdout, done.stderr

    def test_the_command(self):
        self.written("arm.usda", arm())
        quick = ("--duration", "2", "--search", "2")
        code, out, err = self.run_main("arm.usda", "-o", "a.csv", "-o", "a.yaml", *quick)
        self.assertEqual((code, err), (0, ""))
        self.assertIn("shoulder", out)
        code, out, err = self.run_main("arm.usda", "-o", "b.csv", "--json", *quick)
        answer = json.loads(out)
        self.assertTrue(answer["ok"])
        self.assertEqual([each["joint"] for each in answer["joints"]],
                         ["/W/shoulder", "/W/elbow"])
        self.assertEqual((self.folder / "a.csv").read_bytes(),
                         (self.folder / "b.csv").read_bytes())
        for words, expected in ((("gone.usda",), 2), (("arm.usda", "--joints", "x"), 2),
                                (("arm.usda", "-o", "a.txt"), 2), (("arm.usda", "--kind", "x"), 2),
                                (("arm.usda", "-o", "arm.usda"), 2)):
            code, out, err = self.run_main(*words)
            self.assertEqual(code, expected, err)
            self.assertIn("error", err)
        code, out, _ = self.run_main("arm.usda", "--joints", "x", "--json")
        self.assertEqual((json.loads(out)["ok"], json.loads(out)["rule"]),
                         (False, "excite.joints"))

    def test_a_missing_engine_is_exit_code_4(self):
        path = self.written("arm.usda", arm())

        def nothing(*_):
            raise MissingError("no MuJoCo")
        kept, tenon._tenon.overlaps = tenon._tenon.overlaps, nothing
        try:
            self.assertEqual(main([str(path), "-q", "--search", "1", "--duration", "2"]), 4)
        finally:
            tenon._tenon.overlaps = kept

    def test_the_program_hands_over(self):
        self.written("arm.usda", arm())
        environment = {**os.environ, "TENON_PYTHON": sys.executable}
        done = subprocess.run([PROGRAM, "excite", "arm.usda", "-o", "a.csv", "--duration", "2",
                               "--search", "1", "--json"], cwd=self.folder, env=environment,
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["outputs"], ["a.csv"])
        done = subprocess.run([PROGRAM, "excite", "arm.usda"], cwd=self.folder,
                              env={**environment, "TENON_PYTHON": "/no/such/python3"},
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 4)
        self.assertIn("pip install", done.stderr)
        done = subprocess.run([PROGRAM, "help", "--json"], capture_output=True, text=True,
                              check=True)
        (verb,) = [each for each in json.loads(done.stdout)["verbs"] if each["name"] == "excite"]
        own = {name for option in verb["options"] for name in option["names"]
               if not option["positional"]}
        package = {name for action in _parser()._actions for name in action.option_strings}
        self.assertEqual(own | {"--json", "-q", "--quiet", "-h", "--help"},
                         package | {"-h", "--help"})

    def test_each_command_of_the_page_runs(self):
        page = support.ROOT / "docs/identify-logs.md"
        commands = [line.strip() for line in page.read_text().splitlines()
                    if line.startswith("    tenon ")]
        self.assertGreaterEqual(len(commands), 3)
        self.written("arm.usda", arm())
        environment = {**os.environ, "TENON_PYTHON": sys.executable,
                       "PATH": f"{os.path.dirname(PROGRAM)}:{os.environ['PATH']}"}
        for command in commands:
            done = subprocess.run(["sh", "-c", command], cwd=self.folder, env=environment,
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, f"{command}: {done.stderr}")


if __name__ == "__main__":
    unittest.main(verbosity=1)
