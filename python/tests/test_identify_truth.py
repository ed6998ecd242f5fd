# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Known truth of `tenon identify`: joints that lead others by mimic laws, arms of several links,
and how often intervals of 95 % hold what made a log.

    test_identify_truth.py
"""

import math
import sys
import unittest

import numpy as np
import support

try:
    import scipy.signal

    import tenon_usd as tenon
    from tenon_usd.identify.identifiable import judge, sensitivity, weights_of
    from tenon_usd.identify.intervals import sum_deviation
    from tenon_usd.identify.log import Log
    from tenon_usd.identify.model import Model, Windows, largest_speed
    from tenon_usd.identify.overlay import make_overlay, write_overlay
    from tenon_usd.identify.parameters import Parameter, Row, select
    from tenon_usd.identify.selftest import (DEFAULT_FAMILIES, MOST_SPEED, commands, perturbed,
                                             self_test, simulated)
    from tenon_usd.identify.solve import _Fit, solve
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)

STEP = 0.002
HEAD = """#usda 1.0
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
"""
BODY = """
    def Xform "b{at}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {{
        float physics:mass = {mass}
        point3f physics:centerOfMass = ({half}, 0, 0)
        float3 physics:diagonalInertia = ({small}, {inertia}, {inertia})
        double3 xformOp:translate = ({x}, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
    def PhysicsRevoluteJoint "j{at}" (prepend apiSchemas = [{api}])
    {{
        uniform token physics:axis = "Y"
        rel physics:body1 = </World/b{at}>
        float physics:lowerLimit = -120
        float physics:upperLimit = 120
{more}    }}
"""


def link(at, mass, length, x, before=0.0, drive=None, follows=0.0, more=""):
    """A bar on a hinge; `drive` N m/rad, N m s/rad and N m; `follows` the joint before."""
    lines = [] if at == 0 else [f"rel physics:body0 = </World/b{at - 1}>",
                                f"point3f physics:localPos0 = ({before}, 0, 0)"]
    if drive:
        degree = math.pi / 180
        lines += [f"float drive:angular:physics:{name} = {value * unit}" for name, value, unit in
                  zip(("stiffness", "damping", "maxForce"), drive, (degree, degree, 1))]
    if follows:
        lines += [f"rel newton:mimicJoint = </World/j{at - 1}>",
                  f"float newton:mimicCoef1 = {follows}"]
    inertia = mass * length ** 2 / 12
    return BODY.format(
        at=at, mass=mass, half=length / 2, small=inertia / 20, inertia=inertia, x=x,
        api='"NewtonMimicAPI"' if follows else '"PhysicsDriveAPI:angular"',
        more="".join(f"        {line}\n" for line in lines) + more)


#: An arm of one link, one of two, and a finger: a driven link, a follower, and a follower of that.
HINGE = HEAD + link(0, 1, 0.4, 0, drive=(28.6, 1.15, 60)) + "}\n"
ARM = (HEAD + link(0, 1, 0.4, 0, drive=(40, 2, 60))
       + link(1, 0.5, 0.3, 0.4, 0.4, drive=(20, 0.8, 60)) + "}\n")
FINGER = (HEAD + link(0, 0.05, 0.05, 0, drive=(2, 0.05, 3)) + link(1, 0.03, 0.04, 0.05, 0.05,
          follows=1.1) + link(2, 0.02, 0.03, 0.09, 0.04, follows=0.75) + "}\n")
WITHOUT_FRICTION = [Row(family) for family in DEFAULT_FAMILIES if family != "friction"]


class Case(support.FilesTestCase):
    def asset(self, text):
        return str(self.written("asset.usda", text))

    def made(self, text, rows, duration=2.0):
        """The asset, parameters of single joints with other numbers, and a log of theirs."""
        asset = self.asset(text)
        commanded = commands(tenon.World(asset, time_step=STEP), 3, duration, 0.004)
        plain = simulated(asset, [], np.zeros(0), commanded, step=STEP)
        single = select(rows, Model(asset, plain, step=STEP).plant, plain, sums=False)
        truth = perturbed(single, 3, STEP, 4)
        return asset, single, truth, simulated(asset, single, truth, commanded, step=STEP / 4)


class Recovered(Case):
    def check(self, text, rows, count, within):
        done = self_test(self.asset(text), rows, duration=3.0, step=STEP)
        off = [(each.parameter.name, each.error) for each in done.scores if not each.passed]
        self.assertEqual(off, [])
        self.assertEqual((len(done.scores), done.refused, done.solution.settled),
                         (count, (), True))
        # Of 95 % of so many intervals some may miss.
        self.assertGreaterEqual(sum(each.low <= each.truth <= each.high for each in done.scores),
                                within)
        return done

    def test_an_arm_of_two_links(self):
        self.check(ARM, (), 11, 8)

    def test_no_more_is_simulated_than_needs_be(self):
        """Of five numbers: a handful of steps with six runs each, and what weighs and checks them;
        92 where every step tried four dampings and every round began anew."""
        rows = [Row(family) for family in DEFAULT_FAMILIES if family != "delay"]
        done = self_test(self.asset(HINGE), rows, duration=2.0, step=STEP)
        self.assertTrue(done.solution.settled)
        self.assertLessEqual(done.solution.simulations, 60)

    def test_a_finger_whose_links_follow_has_sums(self):
        done = self.check(FINGER, WITHOUT_FRICTION, 5, 3)
        self.assertEqual([each.parameter.name for each in done.scores][:2],
                         ["damping:/World/j0 + 1.21 j1 + 0.6806 j2",
                          "armature:/World/j0 + 1.21 j1 + 0.6806 j2"])


class Sums(Case):
    def test_what_a_finger_does_depends_on_the_sum_alone(self):
        asset, single, truth, log = self.made(FINGER, WITHOUT_FRICTION, 1.0)
        summed = select(WITHOUT_FRICTION, Model(asset, log, step=STEP).plant, log)
        self.assertEqual((len(single), len(summed)), (9, 5))
        known = {(each.family, each.paths[0]): value for each, value in zip(single, truth)}
        values = [sum(weight * known[each.family, path] for path, weight in
                      zip(each.paths, each.weights or (1.0,))) for each in summed]
        again = simulated(asset, summed, values, log, step=STEP / 4)
        self.assertLess(np.abs(again.position - log.position).max(), 1e-6)
        self.assertLess(np.nanmax(np.abs(again.effort - log.effort)), 1e-5)

    def test_a_sum_is_written_as_the_asset_shares_it_out(self):
        text = FINGER.replace("float newton:mimicCoef1 = 1.1",
                              "float newton:mimicCoef1 = -1.1\n        float newton:armature = 0.02"
                              ).replace('["NewtonMimicAPI"]',
                                        '["NewtonMimicAPI", "NewtonJointAPI"]')
        asset, _, _, log = self.made(text, [Row("armature")], 1.0)
        (whole,) = select([Row("armature")], Model(asset, log, step=STEP).plant, log)
        self.assertEqual(whole.paths, ("/World/j0", "/World/j1", "/World/j2"))
        np.testing.assert_allclose(whole.weights, (1, 1.21, 0.825 ** 2), rtol=1e-6)
        self.assertAlmostEqual(whole.nominal, 1.21 * 0.02, delta=1e-8)
        output = str(self.folder / "found.usda")
        write_overlay(make_overlay(asset, output, [whole], np.array([0.05])), output, asset)
        joints = {each.path: each.armature for each in tenon.open(output).physics().joints}
        self.assertAlmostEqual(joints["/World/j1"], 0.05 / 1.21, delta=1e-7)
        self.assertEqual((joints["/World/j0"], joints["/World/j2"]), (0, 0))

    def test_what_is_known_of_one_joint_stays_for_itself(self):
        asset, _, _, log = self.made(FINGER, [Row("damping")], 1.0)
        rows = [Row("damping"), Row("damping", "j1", prior=0.001, deviation=1e-4)]
        made = select(rows, Model(asset, log, step=STEP).plant, log)
        self.assertEqual([each.name for each in made],
                         ["damping:/World/j0 + 0.6806 j2", "damping:/World/j1"])


class Beside(Case):
    """The model with the numbers that made a log, beside that log."""

    def test_a_window_begins_without_an_error_that_counts(self):
        asset, single, truth, log = self.made(HINGE, [Row("stiffness"), Row("driveDamping")])
        model = Model(asset, log, step=STEP)
        apart = model.predict(single, truth[None])["position"][0] - model.measured["position"]
        self.assertLess(np.nanmax(np.abs(apart)), 1e-4)  # a count of an encoder of 16 bit
        self.assertGreater(np.isfinite(apart).mean(), 0.7)

    def test_efforts_have_the_slope_that_delays_give_them(self):
        asset, single, truth, log = self.made(HINGE, [Row("delay")])
        at = np.array([0.0105])  # between two samples, where no command changes
        model = Model(asset, log, step=STEP)
        weights = weights_of(model)
        _, slopes = sensitivity(model, single, at, weights)
        made = model.predict(single, at + np.array([[1e-4], [-1e-4]]))["effort"]
        known = np.isfinite(model.measured["effort"])
        real = ((made[0] - made[1])[known] / 2e-4) * weights["effort"][0]
        own = slopes[-known.sum():, 0]
        self.assertGreater(np.corrcoef(own, real)[0, 1], 0.99)
        self.assertAlmostEqual(np.linalg.norm(own) / np.linalg.norm(real), 1, delta=0.05)

    def test_a_limit_of_speed_leaves_efforts_below_it(self):
        limited = HINGE.replace('["PhysicsDriveAPI:angular"]',
                                '["PhysicsDriveAPI:angular", "PhysxJointAPI"]').replace(
            "float physics:lowerLimit", "float physxJoint:maxJointVelocity = 150\n"
            "        float physics:lowerLimit")
        asset, single, truth, log = self.made(limited, [Row("stiffness"), Row("driveDamping")])
        joint = tenon.physics(asset).joints[0]
        most = largest_speed(joint)
        self.assertAlmostEqual(most, math.radians(150), delta=1e-5)
        aimed = log.command_position[:, 0]
        self.assertLessEqual(np.abs(np.diff(aimed)).max(), 0.004 * MOST_SPEED * most * 1.0001)
        self.assertEqual(aimed[0], 0)
        model = Model(asset, log, step=STEP)
        apart = model.predict(single, truth[None])["effort"][0] - model.measured["effort"]
        self.assertLess(np.nanmax(np.abs(apart)), 0.01 * np.nanstd(log.effort))
        fast = Log(log.times, log.joints, position=log.position, effort=log.effort,
                   velocity=np.full_like(log.position, 0.95 * most),
                   command_position=log.command_position)
        self.assertNotIn("effort", Model(asset, fast, step=STEP).measured)


class Line:
    """A model in closed form: two channels of one joint, sums of two shapes."""

    engine, step = "line", 0.01

    def __init__(self, shapes, measured):
        self.shapes, count = shapes, measured.shape[1]
        self.log = Log(self.step * np.arange(count), ("/j",), position=measured[0],
                       velocity=measured[1])
        self.windows = Windows(np.array([0]), count)
        self.measured = {"position": measured[0][None], "velocity": measured[1][None]}

    def predict(self, parameters, sets, clock=None):
        made = np.einsum("sp,cptn->cstn", np.atleast_2d(sets), self.shapes)[:, :, None]
        return dict(zip(self.measured, made))

    def finer(self):
        return self


class Intervals(unittest.TestCase):
    SEEDS, SAMPLES, PERSISTENT = 200, 1000, 0.9
    TRUTH = np.array([2.0, 1.5])

    def test_the_deviation_of_a_sum(self):
        random = np.random.default_rng(0)
        for persistent in (0.0, 0.6, 0.9):
            white = random.standard_normal((50, 4000))
            rows = scipy.signal.lfilter([1], [1, -persistent], white, axis=1)
            told = np.mean([sum_deviation(row) for row in rows])
            self.assertAlmostEqual(told / (4000 ** 0.5 / (1 - persistent)), 1, delta=0.06)

    def test_as_many_hold_the_truth_as_they_say(self):
        """Noise of one channel lasts for about 10 samples, that of the other is white."""
        time = Line.step * np.arange(self.SAMPLES)
        shapes = np.zeros((2, 2, self.SAMPLES, 1))
        shapes[0, 0, :, 0] = np.sin(2 * np.pi * time / 2.5)
        shapes[0, 1, :, 0] = np.sign(np.sin(2 * np.pi * time / 1.1))
        shapes[1, 0, :, 0] = 0.1 * np.cos(2 * np.pi * time / 2.5)
        rows = [Parameter(family, ("/j",), 1.0, 1.0, 0.0, 9.0, 1.0)
                for family in ("damping", "stiffness")]
        held, alone = np.zeros(2), np.zeros(2)
        for seed in range(self.SEEDS):
            noise = 0.05 * np.random.default_rng(seed).standard_normal((2, self.SAMPLES + 200, 1))
            noise[0] = scipy.signal.lfilter([1], [1, -self.PERSISTENT], noise[0], axis=0)
            model = Line(shapes, np.einsum("p,cptn->ctn", self.TRUTH, shapes) + noise[:, 200:])
            found = solve(model, rows)
            held += (found.low <= self.TRUTH) & (self.TRUTH <= found.high)
            fit = _Fit(model, rows, lambda *_: None)
            fit.reweigh(found.values)
            each = judge(rows, fit.derivatives(found.values)[1], found.values).errors
            alone += np.abs(found.values - self.TRUTH) <= 1.96 * each
        for parameter in range(2):
            self.assertTrue(0.88 <= held[parameter] / self.SEEDS <= 0.99, held / self.SEEDS)
            # If samples were taken to be independent of each other:
            self.assertLess(alone[parameter] / self.SEEDS, 0.7)


if __name__ == "__main__":
    support.main()
