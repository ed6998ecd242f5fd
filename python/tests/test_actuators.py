# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Actuators against closed forms, on each engine.

A cart of mass m slides without gravity or friction. Under an effort F that is held for a step h
each engine gives v += F h / m, then x += v h, so that after n steps of a constant force
v = n F h / m and x = n (n + 1) / 2 F h^2 / m.
"""

import re
import unittest

import numpy as np
import support

import tenon_usd as tenon
from tenon_usd._patterns import compile_pattern
from tenon_usd.actuators import Actuator, Actuators, DCMotor, Delay, PD, PID, Saturation
from tenon_usd.draws import Choice, Uniform

MASS, STEP = 2.0, 0.002
SLIDE = "/World/slide"
CART = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "scene"
    {
        float physics:gravityMagnitude = 0
    }
    def Xform "cart" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 2
        point3f physics:centerOfMass = (0, 0, 0)
        float3 physics:diagonalInertia = (1, 1, 1)
    }
    def PhysicsPrismaticJoint "slide" (
        prepend apiSchemas = ["PhysicsDriveAPI:linear"]
    )
    {
        rel physics:body1 = </World/cart>
        uniform token physics:axis = "X"
        float physics:lowerLimit = -100
        float physics:upperLimit = 100
        float drive:linear:physics:stiffness = 50
        float drive:linear:physics:damping = 5
    }
}
"""


class Actuated(support.FilesTestCase):
    def world(self, engine="mujoco", envs=2):
        return tenon.World(self.written("cart.usda", CART), engine, envs=envs, time_step=STEP)

    def each_engine(self):
        for row in tenon.engines():
            if row["available"]:
                with self.subTest(row["name"]):
                    yield row["name"]

    def motors(self, engine, *stages, envs=2, **options):
        world = self.world(engine, envs)
        return world, Actuators(world, [Actuator("slide", *stages, **options)])


class ClosedForms(Actuated):
    def test_there_are_three_engines(self):
        self.assertEqual({row["name"] for row in tenon.engines() if row["available"]},
                         {"jolt", "mujoco", "physx"})

    def test_an_effort_is_bounded_and_the_own_drive_is_off(self):
        for engine in self.each_engine():
            world, motors = self.motors(engine, Saturation(3.0), command="effort")
            motors.set_commands([[2.0], [50.0]])
            motors.step(100)
            np.testing.assert_allclose(world.joint_velocities[:, 0],
                                       100 * STEP / MASS * np.array([2, 3]), rtol=1e-5)
            np.testing.assert_array_equal(motors.efforts, [[2], [3]])

    def test_a_delayed_command_acts_that_much_later(self):
        for engine in self.each_engine():
            world, motors = self.motors(engine, Delay(0.0208), command="effort", low=-9, high=9)
            motors.set_commands([[1.0], [4.0]])
            motors.step(10)  # 0.0208 s are 10 steps
            np.testing.assert_array_equal(world.joint_velocities, 0)
            motors.set_commands(0.0)
            motors.step(30)
            np.testing.assert_allclose(world.joint_velocities[:, 0],
                                       10 * STEP / MASS * np.array([1, 4]), rtol=1e-5)

    def test_a_motor_reaches_its_speed_without_load(self):
        # dv = h T (1 - v / v0) / m: v = v0 (1 - (1 - h T / (m v0))^n). It brakes with the current
        # that is allowed, then along the envelope.
        stall, free = 8.0, 1.5
        for engine in self.each_engine():
            world, motors = self.motors(engine, DCMotor(stall, free, 6.0), command="effort")
            self.assertEqual((motors.low[0], motors.high[0]), (-6, 6))
            motors.set_commands(100.0)
            n = 0  # as long as the current bounds the effort
            speed = 0.0
            while stall * (1 - speed / free) > 6.0:
                speed += STEP * 6.0 / MASS
                n += 1
            motors.step(n)
            np.testing.assert_allclose(world.joint_velocities, n * STEP * 6 / MASS, rtol=1e-5)
            motors.step(200)
            shrinks = 1 - STEP * stall / (MASS * free)
            np.testing.assert_allclose(world.joint_velocities,
                                       free - (free - speed) * shrinks**200, rtol=1e-5)
            before = world.joint_velocities[0, 0]
            motors.set_commands(-100.0)
            motors.step(10)
            np.testing.assert_allclose(world.joint_velocities, before - 10 * STEP * 6 / MASS,
                                       rtol=1e-4)

    def test_a_pd_at_another_rate_holds_its_effort(self):
        # Over N steps of a held effort F: x += N h v + N (N + 1) / 2 h^2 F / m, v += N h F / m.
        k, d, held = 30.0, 4.0, 10
        for engine in self.each_engine():
            world, motors = self.motors(engine, PD(k, d, rate=1 / (held * STEP)))
            motors.set_commands([[0.5], [-0.2]])
            x, v = np.zeros(2), np.zeros(2)
            for _ in range(25):
                force = k * (np.array([0.5, -0.2]) - x) - d * v
                x = x + held * STEP * v + held * (held + 1) / 2 * STEP**2 * force / MASS
                v = v + held * STEP * force / MASS
                motors.step(held)
            np.testing.assert_allclose(world.joint_positions[:, 0], x, rtol=2e-4)
            np.testing.assert_allclose(world.joint_velocities[:, 0], v, rtol=2e-3, atol=1e-5)

    def test_a_pid_ends_where_it_is_commanded_under_a_load(self):
        # Held at rest by the integral alone: its efforts make up for the bias.
        k, d, i, bias = 400.0, 60.0, 800.0, -30.0
        for engine in self.each_engine():
            world, motors = self.motors(engine, PID(k, d, i, bias=bias))
            motors.set_commands([[0.5], [-0.2]])
            x, v, total = np.zeros(2), np.zeros(2), np.zeros(2)
            for _ in range(1500):
                error = np.array([0.5, -0.2]) - x
                total = total + error * STEP
                v = v + STEP / MASS * (k * error - d * v + i * total + bias)
                x = x + STEP * v
            motors.step(1500)
            np.testing.assert_allclose(world.joint_positions[:, 0], x, rtol=2e-3)
            np.testing.assert_allclose(world.joint_positions[:, 0], [0.5, -0.2], atol=2e-2)
            np.testing.assert_allclose(motors.efforts[:, 0], 0, atol=0.5)
            motors.reset()
            motors.set_commands(motors.world.joint_positions)
            motors.step(1)
            np.testing.assert_allclose(motors.efforts, bias)

    def test_the_integral_of_a_pid_is_bounded(self):
        world, motors = self.motors("mujoco", PID(0.0, 0.0, 10.0, integral_limit=0.3))
        motors.set_commands(50.0)
        motors.step(100)
        np.testing.assert_allclose(motors.efforts, 10.0 * 0.3)

    def test_a_pd_in_each_step_swings_as_it_should(self):
        # Undamped: m x'' = k (c - x), so that x = c (1 - cos(w t)) with w^2 = k / m; half a period.
        k = MASS * (2 * np.pi) ** 2
        for engine in self.each_engine():
            world, motors = self.motors(engine, PD(k, 0.0), envs=1)
            motors.set_commands(0.1)
            motors.step(round(0.5 / STEP))
            np.testing.assert_allclose(world.joint_positions, 0.2, rtol=1e-3)

    def test_a_velocity_is_reached_exponentially(self):
        d = 6.0
        for engine in self.each_engine():
            world, motors = self.motors(engine, PD(0.0, d), command="velocity", low=-2, high=2)
            motors.set_commands(1.2)
            motors.step(150)
            np.testing.assert_allclose(world.joint_velocities,
                                       1.2 * (1 - (1 - STEP * d / MASS) ** 150), rtol=1e-5)

    def test_the_asset_s_own_drive_is_delayed_and_bounded(self):
        for engine in self.each_engine():
            plain, (world, motors) = self.world(engine), self.motors(engine, Delay(0.02))
            motors.set_commands(0.5)
            motors.step(60)
            plain.set_drive_targets(0.5)
            plain.step(50)
            np.testing.assert_allclose(world.joints(), plain.joints(), rtol=1e-6)
            world, motors = self.motors(engine, Saturation(1.0))
            motors.set_commands(50.0)
            motors.step(100)
            np.testing.assert_allclose(world.joint_velocities, 100 * STEP / MASS, rtol=1e-4)


class Episodes(Actuated):
    def test_each_environment_draws_its_own(self):
        stages = Delay(Choice([0.0, 0.004, 0.01])), PD(Uniform(10, 40), Uniform(1, 2))
        world, motors = self.motors("mujoco", *stages, envs=8)
        other = Actuators(self.world(envs=1), [Actuator("slide", *stages)])
        for env in range(8):
            motors.draw(env, np.random.default_rng(env))
        motors.reset()
        numbers = motors.numbers
        self.assertEqual(sorted(numbers), [f"{SLIDE}.{name}" for name in (
            "Delay.time", "PD.damping", "PD.rate", "PD.stiffness")])
        stiffness = numbers[f"{SLIDE}.PD.stiffness"]
        self.assertEqual(len(set(stiffness)), 8)
        self.assertTrue(((stiffness >= 10) & (stiffness <= 40)).all())
        motors.set_commands(0.3)
        motors.step(50)
        for env in (2, 5):
            other.draw(0, np.random.default_rng(env))
            other.reset()
            other.set_commands(0.3)
            other.step(50)
            np.testing.assert_allclose(other.world.joints(), [a[env:env + 1] for a in
                                                              world.joints()], rtol=1e-9)

    def test_one_environment_begins_again_alone(self):
        world, motors = self.motors("mujoco", Delay(0.02), command="effort", low=-9, high=9)
        motors.set_commands(4.0)
        motors.step(30)
        motors.reset([0])
        motors.set_commands(4.0)
        motors.step(15)
        np.testing.assert_allclose(world.joint_velocities[:, 0],
                                   STEP / MASS * 4 * np.array([5, 35]), rtol=1e-9)

    def test_a_longer_delay_keeps_what_others_wait_for(self):
        world, motors = self.motors("mujoco", Delay(Choice([0.01])), command="effort",
                                    low=-9, high=9)
        motors.set_commands(4.0)
        motors.step(3)
        motors._rows[0].numbers[0].drawn["time"] = Choice([0.05])
        motors.draw(0, np.random.default_rng(0))
        motors.reset([0])
        motors.set_commands(0.0)
        motors.step(60)
        np.testing.assert_allclose(world.joint_velocities[:, 0], [0, STEP / MASS * 4 * 3],
                                   rtol=1e-9)

    def test_what_cannot_be_is_refused(self):
        world = self.world()
        for wrong, told in (
                (lambda: Delay(-1), "Delay.time"), (lambda: DCMotor(1, 0), "above 0"),
                (lambda: PD(float("nan"), 1), "PD.stiffness"),
                (lambda: PID(1, 1, -1), "PID.integral"),
                (lambda: PID(1, 1, 1, bias=float("inf")), "PID.bias must be finite, "),
                (lambda: Actuator("x", DCMotor(1, 1)), "PD or PID"),
                (lambda: Actuator("x", PD(1, 1), PD(1, 1)), "efforts"),
                (lambda: Actuator("x", command="postion"), "position"),
                (lambda: Actuator("x", low=1, high=0), "range"),
                (lambda: Actuators(world, [Actuator("(")]), "regular"),
                (lambda: Actuators(world, [Actuator("slide"), Actuator("sl.*")]), "several"),
                (lambda: Actuators(world, [Actuator("slide", command="effort")]), "low and"),
                (lambda: Actuators(world, [Actuator("slide", Delay(21.0))]), "10000 time steps")):
            with self.assertRaisesRegex(ValueError, told):
                wrong()
        with self.assertRaisesRegex(tenon.NotFoundError, "did you mean"):
            Actuators(world, [Actuator("slid")])
        with self.assertRaisesRegex(tenon.InvalidError, "in more ways than can be tried"):
            Actuators(world, [Actuator("(a+)+$")])
        with self.assertRaises(TypeError):
            Delay("soon")
        motors = Actuators(world, [Actuator("slide", PD(1, 1))])
        with self.assertRaises(tenon.InvalidError):
            motors.set_commands([[np.nan], [0]])
        self.assertEqual(motors.units, ["m"])


class Patterns(unittest.TestCase):
    def test_searches_without_an_end_are_refused(self):
        names = ["/robot/Physics/left_hand_index_finger_2_joint", "x" * 100]
        for usual in (".*", "left_.*_(thumb|index)_.*", ".*_finger_[0-9]+_joint", "(a|b)+.*c?",
                      "j[0-9]{1,2}", "(left_)?arm.*", "(?i).*HAND.*", ".*a.*b.*c.*d"):
            compile_pattern(usual, names)
        for slow in ("(a+)+$", "(a|a)*b", "(a?){40}a{40}", "(.*)*", "(|a)+b", "(?=(a+)+$)",
                     "((a{0,9}){0,9}){0,9}b", "(){1000000000}", ".*" * 6 + "x",
                     "(" * 5000 + ")" * 5000, "a{99999999999999999}"):
            with self.subTest(slow[:30]), self.assertRaises(re.error):
                compile_pattern(slow, names)


if __name__ == "__main__":
    support.main()
