# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of `tenon identify` that engines do not change while they run: where masses are, their
inertia, ratios of mimics, limits of velocity.

    test_identify_description.py
"""

import math
import sys
import unittest

import numpy as np

try:
    import tenon_usd as tenon
    from tenon_usd.identify.model import Model
    from tenon_usd.identify.moments import axes_of, inertia_of_moments
    from tenon_usd.identify.overlay import _quaternion, make_overlay, write_overlay
    from tenon_usd.identify.parameters import FAMILIES, Row, rows_from_text, select
    from tenon_usd.identify.run import identify
    from tenon_usd.identify.selftest import Sensors, commands, measured, simulated
    from test_identify_truth import ARM, FINGER, HINGE, STEP, Case
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)

LIMITED = HINGE.replace('["PhysicsDriveAPI:angular"]',
                        '["PhysicsDriveAPI:angular", "PhysxJointAPI"]').replace(
    "float physics:lowerLimit", "float physxJoint:maxJointVelocity = 150\n"
    "        float physics:lowerLimit")
#: As URDF is converted.
NEWTON = ARM.replace('"PhysicsMassAPI"', '"PhysicsMassAPI", "NewtonMassAPI"').replace(
    "float physics:mass", "double[] newton:inertia = [0.001, 0.004, 0.004, 0, 0.0002, 0]\n"
    "        float physics:mass")
DESCRIBED = [name for name, each in FAMILIES.items() if "." in each.sets]
#: Assets and what of theirs takes other numbers together.
TOGETHER = {
    "arm": (ARM, ["mass:.*", "centerOfMass:.*", "inertia:.*", "stiffness"]),
    "converted": (NEWTON, ["mass:.*b0", "inertia:.*b1"]),
    "finger": (FINGER, ["mimicRatio", "centerOfMass:.*b2", "friction:.*j0"]),
    "limited": (LIMITED, ["velocityLimit", "inertia"]),
}


def rows(texts):
    return [row for text in texts for row in rows_from_text(text)]


class Moments(unittest.TestCase):
    def test_they_are_those_of_a_box(self):
        mass, size = 3.0, np.array([0.1, 0.2, 0.4])
        own = mass * size ** 2 / 12
        axes, moments = axes_of(np.diag(own.sum() - own))
        np.testing.assert_allclose(moments, own, rtol=1e-12)
        np.testing.assert_array_equal(axes, np.eye(3))

    def test_an_inertia_comes_back(self):
        random = np.random.default_rng(1)
        for at in range(300):
            turn = np.linalg.qr(random.standard_normal((3, 3)))[0]
            own = random.uniform(0, 1, 3) if at % 3 else np.array([0.2, 0.2, 0.5])
            inertia = turn @ np.diag(own.sum() - own) @ turn.T
            axes, moments = axes_of(inertia)
            self.assertAlmostEqual(np.linalg.det(axes), 1)
            np.testing.assert_allclose(np.sort(moments), np.sort(own), atol=1e-12)
            np.testing.assert_allclose(inertia_of_moments(axes, moments), inertia, atol=1e-12)
            w, *v = _quaternion(axes)
            x, y, z = v
            cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            np.testing.assert_allclose(
                (w * w - np.dot(v, v)) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * cross, axes,
                atol=1e-9)


class Described(Case):
    def other(self, name):
        """An asset, parameters of TOGETHER, and other numbers for them."""
        text, texts = TOGETHER[name]
        asset = self.asset(text)
        commanded = commands(tenon.World(asset, time_step=STEP), 3, 1.0, 0.004)
        log = simulated(asset, [], np.zeros(0), commanded, step=STEP)
        single = select(rows(texts), Model(asset, log, step=STEP).plant, log, sums=False)
        random = np.random.default_rng(5)
        values = np.array([each.nominal * random.uniform(0.6, 1.4) + (
            random.uniform(-0.2, 0.2) * each.scale if each.family.startswith("centerOfMass")
            else random.uniform(0.1, 0.3) * each.scale if each.nominal == 0 else 0)
            for each in single])
        return asset, log, single, values

    def test_every_such_family_is_tried(self):
        told = {row.family for _, texts in TOGETHER.values() for row in rows(texts)}
        self.assertEqual(set(DESCRIBED) - told, set())

    def test_a_world_moves_as_the_layer_with_the_same_numbers_on_every_engine(self):
        engines = [each["name"] for each in tenon.engines() if each["available"]]
        self.assertIn("mujoco", engines)
        for name in TOGETHER:
            asset, log, single, values = self.other(name)
            layer = str(self.folder / f"{name}.usda")
            for engine in engines:
                with self.subTest(asset=name, engine=engine):
                    own = [each for each in single if engine == "mujoco" or "." in
                           FAMILIES[each.family].sets]
                    at = [single.index(each) for each in own]
                    write_overlay(make_overlay(asset, layer, own, values[at]), layer, asset,
                                  replace=True)
                    model = Model(asset, log, engine=engine, step=STEP)
                    nominal = np.array([each.nominal for each in own])
                    made = model.predict(own, np.stack([nominal, values[at], nominal]))["position"]
                    plain = model.predict([], np.zeros((1, 0)))["position"]
                    real = Model(layer, log, engine=engine, step=STEP).predict(
                        [], np.zeros((1, 0)))["position"]
                    for one, other in ((made[0], plain[0]), (made[1], real[0]),
                                       (made[2], plain[0])):
                        self.assertLess(np.nanmax(np.abs(one - other)), 2e-5)
                    self.assertGreater(np.nanmax(np.abs(made[1] - made[0])), 2e-3)

    def test_numbers_of_an_earlier_run_are_forgotten(self):
        asset, log, single, values = self.other("arm")
        own = [at for at, each in enumerate(single) if each.family.startswith("secondMoment")]
        others = [at for at, each in enumerate(single) if each.family.startswith("centerOfMass")]
        model = Model(asset, log, step=STEP)
        for at in (others, own):
            made = model.predict([single[i] for i in at], values[None, at])["position"]
        real = Model(asset, log, step=STEP).predict([single[i] for i in own],
                                                    values[None, own])["position"]
        np.testing.assert_array_equal(made, real)

    def test_inertia_does_not_change_with_a_mass_that_is_identified_beside_it(self):
        asset = self.asset(ARM)
        world = tenon.World(asset)
        log = simulated(asset, [], np.zeros(0), commands(world, 3, 0.5, 0.004), step=STEP)
        single = select(rows(["mass:.*b1", "inertia:.*b1"]), Model(asset, log, step=STEP).plant,
                        log, sums=False)
        layer = str(self.folder / "layer.usda")
        values = np.array([2.0, *(each.nominal for each in single[1:])])
        write_overlay(make_overlay(asset, layer, single, values), layer, asset)
        before, after = (tenon.physics(path).bodies[1] for path in (asset, layer))
        self.assertEqual(after.mass, 2)
        np.testing.assert_allclose(after.inertia, before.inertia, rtol=1e-6)


class Identified(Case):
    def found(self, text, texts, truth, families=("stiffness",), duration=3.0):
        """What comes out of a log with other numbers, by name."""
        asset = self.asset(text)
        commanded = commands(tenon.World(asset, time_step=STEP), 3, duration, 0.004)
        plain = simulated(asset, [], np.zeros(0), commanded, step=STEP)
        single = select(rows(texts), Model(asset, plain, step=STEP).plant, plain, sums=False)
        self.assertEqual([each.name for each in single], list(truth))
        log = measured(simulated(asset, single, np.array(list(truth.values())), commanded,
                                 step=STEP / 4), Sensors(), 1)
        done = identify(asset, [log], [*rows(texts), *map(Row, families)], step=STEP)
        return {each.name: (value, low, high) for each, value, low, high in
                zip(done.parameters, done.solution.values, done.solution.low, done.solution.high)}

    def compare(self, found, truth, within):
        for name, real in truth.items():
            value, low, high = found[name]
            self.assertLess(abs(value - real), within * max(abs(real), 1e-9), (name, found[name]))
            self.assertTrue(low <= real <= high, (name, real, low, high))

    def test_where_the_mass_of_a_link_is_and_how_far_it_spreads(self):
        truth = {"centerOfMassX:/World/b1": 0.19, "centerOfMassZ:/World/b1": 0.03,
                 "secondMomentX:/World/b1": 0.0065}
        self.compare(self.found(ARM, ["centerOfMassX:.*b1", "centerOfMassZ:.*b1",
                                      "secondMomentX:.*b1"], truth), truth, 0.05)

    def test_how_far_a_joint_follows(self):
        truth = {"mimicRatio:/World/j1": 1.02, "mimicRatio:/World/j2": 0.8}
        self.compare(self.found(FINGER, ["mimicRatio"], truth), truth, 0.01)

    def test_how_fast_a_joint_may_be(self):
        asset = self.asset(LIMITED)
        commanded = commands(tenon.World(asset, time_step=STEP), 3, 3.0, 0.004)
        truth = {"velocityLimit:/World/j0": math.radians(60)}
        self.compare(self.found(LIMITED, ["velocityLimit"], truth), truth, 0.01)


if __name__ == "__main__":
    unittest.main()
