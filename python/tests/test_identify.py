# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon identify`: known truth is found, what a log cannot tell is refused with its reason, a log
of another robot is told, and the layer that is written says to each engine what was found.

    test_identify.py [--write]
"""

import contextlib
import dataclasses
import io
import itertools
import json
import os
import re
import shlex
import subprocess
import sys
import sysconfig
import unittest
import zipfile
from unittest import mock

import numpy as np
import support

try:
    import scipy  # noqa: F401

    import tenon_usd as tenon
    from tenon_usd.errors import InvalidError, NotFoundError
    from tenon_usd.identify.channels import Reading
    from tenon_usd.identify.excite_command import main as excite_main
    from tenon_usd.identify.identifiable import judge
    from tenon_usd.identify.identify_command import _parser, main
    from tenon_usd.identify.joints import AssetJoint
    from tenon_usd.identify.linear import linear_start
    from tenon_usd.identify.log import Log, LogError
    from tenon_usd.identify.log_files import read_log
    from tenon_usd.identify.model import Held, Model, joined_logs, windows_of
    from tenon_usd.identify.overlay import make_overlay, write_overlay
    from tenon_usd.identify.parameters import (FAMILIES, GROUPS, Parameter, ParametersError,
                                               Row, prior_from_text, rows_from_file, rows_from_text,
                                               select)
    from tenon_usd.identify.run import RefusedError, check_mapping, identify
    from tenon_usd.identify.selftest import Sensors, commands, measured, self_test, simulated
    from tenon_usd.identify.solve import look, solve
    from tenon_usd.sweep.cases import ExtraMissing
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)

PROGRAM = os.path.join(sysconfig.get_path("scripts"), "tenon")
if not os.path.exists(PROGRAM):
    PROGRAM = os.path.join(os.path.dirname(tenon.__file__), "bin", "tenon")
STEP = 0.004
#: Puts what commands print into docs/identify.md.
WRITE = "--write" in sys.argv[1:]
HINGE = "/World/hinge"
#: A bar of 1 kg with its centre 0.2 m from the hinge, driven, in gravity.
PENDULUM = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def PhysicsScene "scene"
    {
        vector3f physics:gravityDirection = (0, 0, -1)
        float physics:gravityMagnitude = 9.81
    }
    def Xform "bar" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 1
        point3f physics:centerOfMass = (0.2, 0, 0)
        float3 physics:diagonalInertia = (0.001, 0.01, 0.01)
    }
    def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
    {
        uniform token physics:axis = "Y"
        rel physics:body1 = </World/bar>
        float physics:lowerLimit = -120
        float physics:upperLimit = 120
        float drive:angular:physics:stiffness = 0.5
        float drive:angular:physics:damping = 0.02
        float drive:angular:physics:maxForce = 60
    }
}
"""
ROWS = [Row("friction"), Row("damping"), Row("armature"), Row("stiffness"), Row("driveDamping"),
        Row("delay")]
#: friction, damping, armature, stiffness, driveDamping, delay of the robot.
TRUTH = np.array([0.2, 0.3, 0.02, 24.0, 1.3, 2 * STEP])


class Robot(support.FilesTestCase):
    """A pendulum as an asset, and logs of one with other numbers."""

    def setUp(self):
        super().setUp()
        self.asset = str(self.written("pendulum.usda", PENDULUM))

    def log(self, truth=TRUTH, asset=None, duration=4.0, **sensors):
        asset = asset or self.asset
        commanded = commands(tenon.World(asset), 5, duration, 0.004)
        plain = dataclasses.replace(commanded, effort=np.ones_like(commanded.position))
        parameters = select(ROWS, Model(self.asset, plain, step=STEP).plant, plain)
        made = simulated(asset, parameters, truth, commanded, step=STEP / 4)
        return measured(made, Sensors(**sensors), 5)

    def model(self, log, **options):
        return Model(self.asset, log, step=STEP, **options)


class Rows(support.FilesTestCase):
    def test_texts_name_families_patterns_and_bounds(self):
        self.assertEqual(rows_from_text("friction:.*finger.*=0..2"),
                         [Row("friction", ".*finger.*", 0.0, 2.0)])
        self.assertEqual(rows_from_text("gains"), [Row("stiffness"), Row("driveDamping")])
        self.assertEqual(prior_from_text("armature:elbow=0.01,0.002"),
                         [Row("armature", "elbow", prior=0.01, deviation=0.002)])
        with self.assertRaisesRegex(NotFoundError, "did you mean 'friction'"):
            rows_from_text("fricton")
        self.assertEqual(rows_from_text("inertia:arm"),
                         [Row(f"secondMoment{axis}", "arm") for axis in "XYZ"])
        for text in ("friction=1", "friction=2..1", "friction=a..b", "friction=1..inf"):
            self.assertRaises(InvalidError, rows_from_text, text)
        for text in ("friction", "friction=1", "friction=1,-2"):
            self.assertRaises(InvalidError, prior_from_text, text)

    def test_the_help_names_all_families(self):
        answer = subprocess.run([PROGRAM, "identify", "--help"], capture_output=True, text=True,
                                check=True).stdout
        told = re.search(r"Families: ([^.]*)\.", " ".join(answer.split()))[1]
        named = re.sub(r" \([^)]*\)", "", told).split(", ")
        whole = [family for name in named for family in GROUPS.get(name, (name,))]
        self.assertEqual(set(whole), set(FAMILIES))
        self.assertEqual(set(GROUPS) - set(named), set())

    def test_a_file_has_the_same_rows_and_its_faults_have_lines(self):
        path = self.written("p.toml", '[[parameter]]\nfamily = "damping"\njoints = "elbow"\n'
                            "low = 0\nhigh = 2\ntied = true\n")
        self.assertEqual([dataclasses.replace(row, line=0) for row in rows_from_file(str(path))],
                         [Row("damping", "elbow", 0.0, 2.0, tied=True)])
        path = self.written("q.toml", '[[parameter]]\nfamily = "dampin"\n\n[[parameter]]\n'
                            'family = "mass"\nlow = 3\nhigh = 2\nprior = 1\nlower = 2\n')
        with self.assertRaises(ParametersError) as caught:
            rows_from_file(str(path))
        self.assertEqual([fault.line for fault in caught.exception.faults], [2, 9, 6, 8])
        self.assertRaises(ParametersError, rows_from_file, str(self.written("none.toml", "# no\n")))
        row, = rows_from_file(str(self.written("r.toml", '\n[[parameter]]\nfamily = "delay"\n')))
        self.assertEqual(row.place, f"{self.folder / 'r.toml'}:2: ")


class Parts(unittest.TestCase):
    def test_a_command_holds_and_its_mean_is_that_of_its_parts(self):
        held = Held(np.array([0.0, 1.0, 2.0]), np.array([1.0, 3.0, -1.0]))
        self.assertEqual(held.at(np.array([-1, 0, 0.99, 1, 5])).tolist(), [1, 1, 1, 3, -1])
        means = held.means(np.array([-0.5, 0.5, 1.5, 2.5]))
        np.testing.assert_allclose(means, [1.0, 2.0, 1.0])

    def test_windows_stay_within_the_logs_that_are_joined(self):
        logs = [Log(np.arange(count) * 0.1, ("/j",), position=np.zeros((count, 1)))
                for count in (31, 21)]
        whole, parts = joined_logs(logs)
        self.assertEqual(parts, (0, 31))
        windows = windows_of(whole, 1.0, parts)
        self.assertEqual((windows.first.tolist(), windows.samples), ([0, 10, 20, 31, 41], 11))
        other = dataclasses.replace(logs[1], joints=("/k",))
        self.assertRaises(InvalidError, joined_logs, [logs[0], other])

    def test_what_only_appears_together_is_refused_and_named(self):
        """Columns a, a and b: the sum of the first two is told, neither alone is."""
        random = np.random.default_rng(1)
        a, b = random.standard_normal((2, 500))
        rows = [Parameter("damping", (f"/j{i}",), 1.0, 1.0, 0.0, 9.0, 1.0) for i in range(3)]
        told = judge(rows, 10 * np.stack([a, a, b], axis=1), np.ones(3))
        self.assertEqual((told.refused, told.groups), ((0, 1), ((0, 1),)))
        # Of b alone the standard error is 1 over the length of its column.
        self.assertAlmostEqual(told.errors[2], 0.1 / np.linalg.norm(b), delta=2e-4)
        known = [dataclasses.replace(rows[0], prior=1.0, deviation=0.01), *rows[1:]]
        told = judge(known, 10 * np.stack([a, a, b], axis=1), np.ones(3))
        self.assertEqual(told.refused, ())
        self.assertAlmostEqual(told.errors[0], 0.01, delta=1e-4)


class Truth(Robot):
    def test_known_numbers_are_found_and_proven_on_held_out_motion(self):
        log = self.log(duration=3.0)
        found = identify(self.asset, [log], ROWS, step=STEP)
        for value, truth, part in zip(found.solution.values, TRUTH,
                                      (0.05, 0.05, 0.05, 0.02, 0.02, 0.25)):
            self.assertLess(abs(value - truth), part * truth)
        self.assertTrue(found.improved)
        self.assertEqual((found.foreign, found.at_bounds, found.held), ((), (), ()))
        place = found.held_out[0]
        self.assertLess(place.after[0], 0.02 * place.before[0])
        by_engine = {each.engine: each for each in found.replays}
        for name in ("mujoco", "jolt", "physx"):
            if name in by_engine:
                self.assertLess(by_engine[name].after, 0.3 * by_engine[name].before, name)
        # Written, it is what every schema says, and the asset is as it was.
        source = self.folder / "pendulum.usda"
        before = source.read_bytes()
        output = str(self.folder / "found.usda")
        overlay = make_overlay(self.asset, output, found.parameters, found.solution.values)
        write_overlay(overlay, output, self.asset)
        self.assertEqual([each.family for each, _ in overlay.left], ["delay"])
        self.assertEqual(source.read_bytes(), before)
        joint = tenon.open(output).physics().joints[0]
        values = found.solution.values
        for real, value in zip((joint.friction, joint.damping, joint.armature,
                                joint.drives[0].stiffness, joint.drives[0].damping), values):
            self.assertAlmostEqual(real, value, delta=2e-6 * value)
        prim = tenon.open(output)[HINGE]
        degree = np.pi / 180
        for name, value in (("newton:friction", values[0]), ("mjc:frictionloss", values[0]),
                            ("physxJointAxis:angular:dynamicFrictionEffort", values[0]),
                            ("newton:damping", values[1] * degree), ("mjc:damping", values[1]),
                            ("newton:armature", values[2]), ("mjc:armature", values[2]),
                            ("drive:angular:physics:stiffness", values[3] * degree)):
            self.assertAlmostEqual(float(prim[name]), value, delta=2e-6 * value, msg=name)
        with self.assertRaisesRegex(tenon.Error, "is there"):
            write_overlay(overlay, output, self.asset)
        with self.assertRaisesRegex(tenon.Error, "the asset itself"):
            write_overlay(overlay, self.asset, self.asset, replace=True)

    def test_the_self_test_scores_against_what_made_the_log(self):
        done = self_test(self.asset, [Row("stiffness"), Row("damping")], seed=2, duration=2.0,
                         step=STEP)
        self.assertTrue(done.passed, [(each.parameter.name, each.error) for each in done.scores])
        self.assertEqual([each.parameter.family for each in done.scores], ["stiffness", "damping"])
        self.assertGreater(abs(done.scores[0].truth / done.scores[0].parameter.nominal - 1), 0.02)


class OtherEngines(Robot):
    def test_jolt_finds_what_the_asset_does_not_have(self):
        """Jolt changes friction only where there is some: a layer of the run gives it that."""
        if not any(each["name"] == "jolt" and each["available"] for each in tenon.engines()):
            self.skipTest("no Jolt")
        truth = np.array([0.2, 0.0, 0.0, 0.5 * 180 / np.pi, 0.02 * 180 / np.pi, 0.0])
        found = identify(self.asset, [self.log(truth, duration=1.5)], [Row("friction")],
                         step=0.001, engine="jolt", replay=False)
        self.assertAlmostEqual(found.solution.values[0], 0.2, delta=0.03)
        self.assertTrue(found.improved and np.isfinite(found.score[0]))


class Refused(Robot):
    def test_what_efforts_would_tell_is_refused_without_them(self):
        """Damping of the joint and of its drive are one number to motion alone."""
        log = dataclasses.replace(self.log(duration=2.0), effort=None)
        with self.assertRaises(RefusedError) as caught:
            identify(self.asset, [log], [Row("damping"), Row("driveDamping")], step=STEP)
        first, second = caught.exception.lines
        self.assertIn(f"damping:{HINGE} is not told by the log: it only appears together with "
                      f"driveDamping:{HINGE}", first)
        self.assertIn("constant speeds", first)
        self.assertIn("or give a prior", second)
        model = self.model(log)
        rows = [Row("damping", prior=0.3, deviation=0.01), Row("driveDamping")]
        self.assertEqual(look(model, select(rows, model.plant, log)).refused, ())

    def test_a_load_that_hangs_on_nothing_is_not_told(self):
        path = self.written("load.usda", PENDULUM.rstrip()[:-1] + """
    def Xform "box" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 2
        double3 xformOp:translate = (5, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
""")
        model = Model(str(path), self.log(duration=1.0), step=STEP)
        parameters = select([Row("mass")], model.plant, model.log)
        told = look(model, parameters)
        self.assertEqual([parameters[i].name for i in told.refused], ["mass:/World/box"])

    def test_joints_that_are_mixed_up_are_told(self):
        times = np.arange(0, 4, 0.01)
        made = np.stack([np.sin(3 * times), np.sin(7 * times + 1)], axis=1)
        log = Log(times, ("/a", "/b"), position=made[:, ::-1], command_position=made)
        with self.assertRaisesRegex(RefusedError, "/a follows the command of /b .*--map"):
            check_mapping(log)
        check_mapping(dataclasses.replace(log, position=made))

    def test_a_log_of_another_robot_is_no_success(self):
        other = str(self.written("other.usda", PENDULUM.replace(
            "(0.2, 0, 0)", "(-0.1, 0, 0.25)").replace("physics:mass = 1", "physics:mass = 4")))
        log = self.log(asset=other, duration=2.0)
        found = identify(self.asset, [log], [Row("friction"), Row("damping")], step=STEP,
                         replay=False)
        self.assertEqual(found.foreign, (HINGE,))

    def test_commands_without_a_drive_say_what_is_missing(self):
        path = self.written("bare.usda", PENDULUM.replace(
            ' (prepend apiSchemas = ["PhysicsDriveAPI:angular"])', ""))
        with self.assertRaisesRegex(InvalidError, "no drive there .*tenon drives"):
            Model(str(path), self.log(duration=1.0))


class Solving(Robot):
    rows = (Row("stiffness"),)

    def test_interrupted_it_keeps_the_best_and_goes_on_from_there(self):
        log = self.log(duration=1.0)
        model = self.model(log)
        parameters = select(self.rows, model.plant, log)
        state = str(self.folder / "state.json")
        with open(state, "w", encoding="utf-8") as file:
            file.write("a log of an hour")
        self.assertRaises(InvalidError, solve, model, parameters, state=state)
        with open(state, encoding="utf-8") as file:
            self.assertEqual(file.read(), "a log of an hour")
        os.unlink(state)

        def interrupt(what, simulations, cost):
            if simulations > 5:
                raise KeyboardInterrupt

        done = solve(model, parameters, state=state, shown=interrupt)
        self.assertFalse(done.finished)
        with open(state, encoding="utf-8") as file:
            note = json.load(file)
        self.assertEqual(note["values"], done.values.tolist())
        again = solve(model, parameters, state=state)
        whole = solve(model, parameters)
        self.assertTrue(again.finished)
        self.assertFalse(os.path.exists(state))
        self.assertLess(abs(again.values[0] - whole.values[0]), 1e-3 * whole.values[0])
        # The same again is the same to the last bit; threads change nothing.
        other = solve(self.model(log, threads=2), parameters)
        self.assertEqual(other.values.tobytes(), whole.values.tobytes())

    def test_without_cma_it_says_what_to_install(self):
        log = self.log(duration=1.0)
        model = self.model(log)
        with mock.patch.dict(sys.modules, {"cma": None}), self.assertRaisesRegex(
                ExtraMissing, r"tenon-usd\[identify\]"):
            solve(model, select(self.rows, model.plant, log), solver="cma")


class Command(Robot):
    def run_main(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = main([*map(str, words)])
        return code, out.getvalue(), err.getvalue()

    def csv(self, log, name="run.csv"):
        lines = ["time,hinge_position,hinge_effort,command_hinge_position"]
        lines += [",".join(repr(float(value)) for value in row) for row in zip(
            log.times, log.position[:, 0], log.effort[:, 0], log.command_position[:, 0])]
        return self.written(name, "\n".join(lines) + "\n")

    def test_a_csv_becomes_a_layer_and_a_page(self):
        numbers = np.array([0.0, 0.0, 0.0, 24.0, 0.02 * 180 / np.pi, 0.0])
        path = self.csv(self.log(numbers, duration=2.0))
        common = (self.asset, path, "--dt", STEP, "--identify", "stiffness")
        layer, page = self.folder / "found.usda", self.folder / "found.html"
        code, out, err = self.run_main(*common, "--write", layer, "--report", page)
        self.assertEqual(code, 0, err)
        self.assertIn("stiffness:/World/hinge", out)
        text = page.read_text(encoding="utf-8")
        for words in ("Held-out motion", "<polyline", "Singular values", "jolt"):
            self.assertIn(words, text)
        for absent in ("<script", "http:", "https:", "src="):
            self.assertNotIn(absent, text)
        code, out, err = self.run_main(*common, "--json", "--training", 0.5)
        answer = json.loads(out)
        (parameter,) = answer["parameters"]
        self.assertAlmostEqual(parameter["value"], 24, delta=0.5)
        self.assertLess(parameter["low"], parameter["high"])
        self.assertTrue(answer["ok"] and answer["improved"])
        self.assertNotIn("layer", answer)
        other = self.folder / "other.usda"
        code, out, err = self.run_main(*common, "--json", "--write", other, "--dry-run",
                                       "--progress")
        answer = json.loads(out)
        self.assertEqual((answer["written"], other.exists()), ([], False))
        self.assertEqual(answer["layer"], layer.read_text(encoding="utf-8"))
        self.assertRegex(err, r"(?m)^progress: round 1 of 4: \d+ simulations, [\d.e+]+ left$")

    def test_commands_of_speed_tell_gains_too(self):
        """Where a fit begins: the law of a drive aims at a speed, as tables of excite do."""
        log = self.log(np.array([0.0, 0.0, 0.0, 24.0, 1.2, 0.0]), duration=2.0, noise=0.0,
                       counts=1 << 30, effort_noise=0.0)
        speed = np.gradient(log.command_position[:, 0], log.times)
        drawn = speed[:, None] * 1.3
        log = dataclasses.replace(log, command_velocity=drawn, effort=log.effort + 1.2 * drawn)
        model = Model(str(self.asset), log, step=STEP)
        rows = [Row("stiffness"), Row("driveDamping"), Row("delay")]
        found = linear_start(model, select(rows, model.plant, log))
        self.assertAlmostEqual(found[0], 24, delta=2.0)
        self.assertAlmostEqual(found[1], 1.2, delta=0.1)
        self.assertAlmostEqual(found[2], 0, delta=STEP)

    def test_what_is_no_better_is_not_written(self):
        """The log of the asset itself, as it is, without noise."""
        numbers = np.array([0.0, 0.0, 0.0, 0.5 * 180 / np.pi, 0.02 * 180 / np.pi, 0.0])
        path = self.csv(self.log(numbers, duration=1.0, noise=0.0, counts=1 << 30,
                                 effort_noise=0.0))
        layer = self.folder / "found.usda"
        common = (self.asset, path, "--dt", STEP / 4, "--identify", "stiffness=28.9..40")
        code, _, err = self.run_main(*common, "--write", layer)
        self.assertEqual(code, 1)
        self.assertIn("no better than by the asset as it is", err)
        self.assertIn("--force", err)
        self.assertFalse(layer.exists())
        code, _, _ = self.run_main(*common, "--write", layer, "--force")
        self.assertEqual((code, layer.exists()), (1, True))

    def test_the_self_test_of_the_command(self):
        common = (self.asset, "--self-test", "--dt", STEP, "--duration", 1.5, "--seed", 2)
        code, out, err = self.run_main(*common, "--identify", "stiffness", "--json")
        answer = json.loads(out)
        self.assertEqual((code, answer["ok"]), (0, True), err)
        (score,) = answer["scores"]
        self.assertLess(abs(score["found"] / score["truth"] - 1), 0.02)

    def test_the_check_alone_fits_nothing(self):
        log = dataclasses.replace(self.log(duration=1.0), command_velocity=None)
        path = self.csv(log)
        code, out, _ = self.run_main(self.asset, path, "--dt", STEP, "--check", "--json",
                                     "--identify", "stiffness", "--identify", "mass")
        answer = json.loads(out)
        self.assertEqual(code, 0 if answer["ok"] else 1)
        self.assertEqual(len(answer["check"]["singularValues"]), 2)
        self.assertEqual({row["family"] for row in answer["check"]["parameters"]},
                         {"stiffness", "mass"})

    def test_what_is_wrong_is_told_before_anything_runs(self):
        path = self.csv(self.log(duration=1.0))
        for words, said in (
                ((self.asset,), "give a LOG"), ((self.asset, path, "--self-test"), "leave LOG out"),
                ((self.asset, path, "--identify", "x"), "there is no 'x'"),
                ((self.asset, path, "--write", "a.usdc"), ".usda"),
                ((self.asset, path, "--report", "/no/such/a.html"), "no folder"),
                ((self.asset, path, "--dry-run"), "--dry-run is about --write"),
                ((self.asset, path, "--training", "2"), "expected 0.05 to 0.95"),
                ((self.asset, path, "--prior", "mass=1,1"), "--prior is about"),
                ((self.asset, path, "--starts", "0"), "expected 1 to"),
                ((self.asset, path, "--on", "slurm"), "expected ray or ray=ADDRESS"),
                ((self.asset, path, "--starts", "2", "--state", "s"), "--state is of a single"),
                ((self.asset, self.folder / "gone.csv"), "gone.csv"),
                ((self.asset, path, "--identify", "friction:elbow"), "there is no 'elbow'")):
            code, _, err = self.run_main(*words)
            self.assertEqual(code, 2, (words, err))
            self.assertIn(said, err)
        nothing = {name: None for name in ("scipy.optimize", "scipy.signal")}
        for words in ((), ("--check",)):
            with self.subTest(words), mock.patch.dict(sys.modules, nothing):
                code, _, err = self.run_main(self.asset, path, *words)
                self.assertEqual(code, 4)
                self.assertIn("pip install 'tenon-usd[identify]'", err)
        with mock.patch.dict(sys.modules, {"ray": None}):
            code, _, err = self.run_main(self.asset, path, "--starts", 2, "--on", "ray")
        self.assertEqual(code, 4)
        self.assertIn("--on ray needs Ray: pip install 'tenon-usd[ray]'", err)

    def test_options_are_those_of_the_program(self):
        done = subprocess.run([PROGRAM, "help", "--json"], capture_output=True, text=True,
                              check=True)
        (verb,) = [verb for verb in json.loads(done.stdout)["verbs"]
                   if verb["name"] == "identify"]
        own = {name for option in verb["options"] for name in option["names"]
               if not option["positional"]} - {"-h", "--help"}
        listed = {name for action in _parser()._actions for name in action.option_strings}
        self.assertEqual(listed - {"-h", "--help", "--json", "-q", "--quiet"}, own)


class CostlyLogs(support.FilesTestCase):
    """Files that took gigabytes, never ended, or ended with a traceback."""

    JOINTS = tuple(AssetJoint(f"/arm/{name}", f"/arm/{name}", "rotZ", True, -4.0, 4.0, 60.0, 10.0)
                   for name in ("shoulder", "elbow"))
    TIMES = np.arange(0, 1, 0.01)

    def refused(self, name, rule, line=0):
        with self.assertRaises(LogError) as caught:
            read_log(self.folder / name, self.JOINTS)
        self.assertEqual((caught.exception.rule, caught.exception.line), (rule, line),
                         str(caught.exception))
        return str(caught.exception)

    def put(self, text, name="log.csv"):
        (self.folder / name).write_text(text, encoding="utf-8")
        return self.folder / name

    def test_archives(self):
        path, place = self.folder / "log.npz", np.sin(np.stack([self.TIMES, self.TIMES], 1))
        names = ["shoulder", "elbow"]
        for rule, arrays in (("log.number", {"position": place.astype(str)}),
                             ("log.number", {"position": place[:, :, None]}),
                             ("log.columns", {"position": place, "q": place})):
            np.savez(path, time=self.TIMES, joints=names, **arrays)
            self.refused("log.npz", rule)
        for times in (place, self.TIMES.astype(str)):
            np.savez(path, time=times, columns=names, values=place)
            self.refused("log.npz", "log.time")
        np.savez(path, time=self.TIMES, joints=names, position=place)
        with zipfile.ZipFile(path, "a") as archive:
            archive.writestr("readme.txt", "beside the arrays")
        self.assertEqual(len(read_log(path, self.JOINTS)[0]), len(self.TIMES))
        np.savez(path, time=self.TIMES, joints=names, position=np.full_like(place, np.nan))
        self.refused("log.npz", "log.not-finite")
        np.savez_compressed(path, time=np.zeros(10_000_000))
        self.refused("log.npz", "log.too-large")

    def test_what_is_no_file_and_times(self):
        os.mkfifo(self.folder / "pipe.csv")
        os.symlink("/dev/zero", self.folder / "zero.csv")
        for name in ("pipe.csv", "zero.csv"):
            self.assertRaises(OSError, read_log, self.folder / name, self.JOINTS)
        self.put("time,shoulder\n" + "".join(f"{at}e-12,0\n" for at in range(50)))
        self.refused("log.csv", "log.time", 3)
        start = 1_700_000_000_000_000_000
        rows = [f"{start + at * 10_000_000},0" for at in range(50)]
        self.put("time,shoulder\n" + "\n".join([*rows[:9], ",0", *rows[10:]]))
        self.refused("log.csv", "log.time", 11)
        path = self.put("time,shoulder\n" + "\n".join([*rows[:9], " ", *rows[9:]]))
        log, _ = read_log(path, self.JOINTS, Reading(check=False))
        np.testing.assert_allclose(log.times, np.arange(50) / 100)

    def test_lines_of_json(self):
        whole = '{"time": 0, "joints": {"/arm/shoulder": {"position": [1]}}}\n'
        for line in ("[" * 100000, '{"time": 1' + "0" * 400 + "}", '{"time": 1, "a": {"b": "x',
                     "[1]", "{}", '{"time": 1, "force": [1, 2, 3, 4, 5]}'):
            self.put(whole + line + "\n", "log.jsonl")
            self.assertIn("line 2", self.refused("log.jsonl", "log.damaged"))
        many = ", ".join(f'"k{at}": 1' for at in range(20000))
        self.put('{"time": 0, ' + many + "}\n" + '{"time": 1}\n' * 5000, "log.jsonl")
        self.refused("log.jsonl", "log.damaged")


class Page(support.FilesTestCase):
    def test_every_family_is_in_the_page_of_the_docs(self):
        text = (support.ROOT / "docs/identify.md").read_text(encoding="utf-8")
        for family in [*FAMILIES, *GROUPS]:
            self.assertRegex(text, re.escape(f"`{family}`"))

    def run_line(self, words):
        """What a command prints; the verbs of the package run in this process."""
        if words[1] not in ("identify", "excite"):
            done = subprocess.run([PROGRAM, *words[1:]], capture_output=True, text=True,
                                  check=False, cwd=self.folder)
            self.assertEqual(done.returncode, 1 if words[1] == "diff" else 0, done.stderr)
            return done.stdout
        out = io.StringIO()
        call = main if words[1] == "identify" else excite_main
        with contextlib.redirect_stdout(out), contextlib.chdir(self.folder):
            self.assertEqual(call(words[2:]), 0, words)
        return out.getvalue()

    def test_every_command_prints_what_the_page_says(self):
        """With --write, puts what they print into the page."""
        (self.folder / "examples").symlink_to(support.ROOT / "examples")
        path = support.ROOT / "docs/identify.md"
        text = path.read_text(encoding="utf-8")
        blocks = re.findall(r"```console\n(.*?)```", text, re.S)
        self.assertGreater(len(blocks), 5)
        for block in blocks:
            lines, said = block.splitlines(), []
            for at, line in enumerate(lines):
                if not line.startswith("$ "):
                    continue
                told = itertools.takewhile(lambda each: not each.startswith("$ "), lines[at + 1:])
                command, _, to = line[2:].partition(" >")
                out = self.run_line(shlex.split(command))
                said += [line, *([] if to else out.strip().splitlines())]
                if not to and not WRITE:
                    self.same(out, "\n".join(told), command)
            text = text.replace(block, "\n".join(said) + "\n")
        if WRITE:
            path.write_text(text, encoding="utf-8")
        page = tenon.open(self.folder / "arm.identified.usda").physics().joints[-1]
        self.assertAlmostEqual(page.friction, 0.3, delta=0.015)
        self.assertAlmostEqual(page.drives[0].stiffness, 33, delta=0.66)

    def same(self, out, told, command):
        """Numbers may differ by a tenth: those of fits are not the same on every machine."""
        (words, numbers), (wanted, known) = parts(out), parts(told)
        self.assertEqual(words, wanted, command)
        for own, page in zip(numbers, known):
            self.assertTrue(abs(own - page) <= 0.1 * abs(page) + 2e-6, (own, page, command))


def parts(text):
    """Words, without the width of columns, and numbers; without engines that may not be here."""
    lines = [line for line in text.strip().splitlines() if not re.match(r"(jolt|physx): ", line)]
    number = r"[-+]?\b\d+(?:\.\d*)?(?:e[-+]?\d+)?"
    return ([" ".join(re.sub(number, "0", line).split()) for line in lines],
            [float(each) for line in lines for each in re.findall(number, line)])


if __name__ == "__main__":
    if WRITE:
        sys.argv[1:] = ["Page"]
    support.main()
