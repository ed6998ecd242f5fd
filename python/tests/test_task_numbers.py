# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of tasks: names of what is observed, and terms of the reward beside their formulas.

    test_task_numbers.py
"""

import math
import sys
import warnings

import numpy as np
import support

try:
    from tenon_usd import tasks
    from test_tasks import Files
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)


class Observations(Files):
    CART = 'asset = "{}"\n[[reward]]\nterm = "constant"\n'.format(
        tasks.EXAMPLES / "cart_pole.usda")

    def test_names_in_a_list_are_one_after_the_other(self):
        envs = tasks.TaskEnv(self.load(
            self.CART + '[[observation]]\nof = ["jointVelocity@slide", "jointPosition.sin@hinge", '
            '"orientation.w@pole"]\nscale = 2\n'), 2)
        self.assertEqual([entry.name for entry in envs.observation_spec],
                         ["jointVelocity@/CartPole/slide", "jointPosition.sin@/CartPole/hinge",
                          "orientation.w@/CartPole/pole"])
        positions = np.zeros((2, 2))
        hinge = envs.world.joint_names.index("/CartPole/hinge")
        positions[:, hinge] = (0.3, -2)
        envs.world.set_joints(positions)
        np.testing.assert_allclose(envs.observe()[:, 1], 2 * np.sin([0.3, -2]))
        np.testing.assert_allclose(envs.observe()[:, 2], 2 * np.cos([0.15, 1]))

    def test_what_entries_are_called_are_names(self):
        source = (tasks.EXAMPLES / "cart_pole.usda").read_text(encoding="utf-8")
        at = source.index("{", source.index('"pole"')) + 1
        self.written("cart.usda", source[:at] + """
        def Xform "tip" { custom token tenon:sensor = "frame"
            double3 xformOp:translate = (0, 0, 1)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }""" + source[at:])
        head = 'asset = "cart.usda"\n[[reward]]\nterm = "constant"\n'
        names = ["sensor@tip", "orientation@pole", "jointPosition.cos@hinge", "position@pole"]
        whole = tasks.TaskEnv(self.load(head + f"[[observation]]\nof = {names}\n"))
        again = [entry.name for entry in whole.observation_spec]
        each = tasks.TaskEnv(self.load(head + f"[[observation]]\nof = {again}\n"))
        self.assertEqual(each.observation_spec, whole.observation_spec)
        for envs in (whole, each):
            envs.reset(seed=1)
        np.testing.assert_array_equal(whole.observe(), each.observe())
        part = self.load(head + '[[observation]]\nof = "sensor.position@tip"\n')
        self.assertEqual(len(tasks.TaskEnv(part).observation_spec), 3)
        for name, told in (("sensor.place@tip", "there are position"),
                           ("orientation.v@pole", "w, x, y"),
                           ("jointPosition.cos@slide", "slides"),
                           ("jointPosition.tan@hinge", "did you mean")):
            (fault,) = self.faults(head + f'[[observation]]\nof = "{name}"\n', make=True)
            self.assertIn(told, fault[2])

    def test_an_episode_begins_with_what_sensors_read_there(self):
        self.test_what_entries_are_called_are_names()
        envs = tasks.TaskEnv(self.load(
            'asset = "cart.usda"\nepisode = 0.1\n[[reward]]\nterm = "constant"\n[[observation]]\n'
            'of = ["sensor.position@tip", "position@pole", "jointPosition@hinge"]\n[[reset]]\n'
            'of = "jointPosition"\nvalue = {uniform = [-1, 1]}\n'), 3, autoreset_mode="SameStep")
        seen = envs.reset(seed=5)[0]
        for _ in range(12):
            angle = seen[:, 6]
            wanted = seen[:, 3:6] + np.stack([np.sin(angle), 0 * angle, np.cos(angle)], axis=1)
            np.testing.assert_allclose(seen[:, :3], wanted, atol=1e-6)
            seen = envs.step(np.zeros((3, envs.actions.shape[1])))[0]


class Rewards(Files):
    def test_a_tolerance_is_one_within_its_bounds_and_falls_beyond(self):
        """By shape: half a margin beyond the bounds and two, where it is 0.2 at one."""
        shapes = {"gaussian": (0.2 ** 0.25, 0.2 ** 4), "linear": (0.6, 0), "quadratic": (0.8, 0),
                  "cosine": (0.5 + 0.5 * math.cos(math.acos(-0.6) / 2), 0),
                  "hyperbolic": (1 / math.cosh(math.acosh(5) / 2),
                                 1 / math.cosh(math.acosh(5) * 2)),
                  "long_tail": (0.5, 1 / 17), "reciprocal": (1 / 3, 1 / 9),
                  "tanh_squared": (1 - math.tanh(math.atanh(0.8 ** 0.5) / 2) ** 2,
                                   1 - math.tanh(math.atanh(0.8 ** 0.5) * 2) ** 2)}
        self.assertEqual(set(shapes), set(tasks.task.SHAPES))
        text = f'asset = "{tasks.EXAMPLES / "cart_pole.usda"}"\n'
        for shape in shapes:
            text += (f'[[reward]]\nname = "{shape}"\nterm = "tolerance"\nlow = -0.1\nhigh = 0.2\n'
                     f'of = "jointPosition@slide"\nmargin = 0.4\nat_margin = 0.2\n'
                     f'shape = "{shape}"\n')
        text += '[[reward]]\nname = "none"\nterm = "tolerance"\nof = "jointPosition@slide"\n'
        envs = tasks.TaskEnv(self.load(text), 6)
        slide = envs.world.joint_names.index("/CartPole/slide")
        for places in ([-0.1, 0.2, -0.3, 0.4, 0.6, 1.0],):
            positions = np.zeros((6, 2))
            positions[:, slide] = places
            envs.world.set_joints(positions)
            envs._look()
            for shape, (half, double) in shapes.items():
                one = dict(zip(places, envs._terms[shape]))
                for place, wanted in ((-0.1, 1), (0.2, 1), (-0.3, half), (0.4, half), (0.6, 0.2),
                                      (1.0, double)):
                    self.assertAlmostEqual(one[place], wanted, delta=1e-12, msg=(shape, place))
            self.assertEqual(envs._terms["none"].tolist(), [0] * 6)

    def test_terms_of_a_product_are_multiplied(self):
        text = f'asset = "{tasks.EXAMPLES / "cart_pole.usda"}"\n[[reward]]\nterm = "constant"\n'
        text += ('[[reward]]\nname = "up"\nterm = "value"\nof = "jointPosition.cos@hinge"\n'
                 'offset = 0.5\nweight = 0.5\nproduct = "swing"\n[[reward]]\nname = "slow"\n'
                 'term = "tolerance"\nof = "jointVelocity@hinge"\nmargin = 5\nproduct = "swing"\n')
        envs = tasks.TaskEnv(self.load(text), 1)
        envs.world.set_joints([[1.2, 0.1]], [[3.0, 0]])
        envs._look()
        hinge = envs.world.joint_names.index("/CartPole/hinge")
        angle, speed = envs.world.joint_positions[0, hinge], envs.world.joint_velocities[0, hinge]
        wanted = 1 + (0.5 + 0.5 * math.cos(angle)) * 0.1 ** (speed ** 2 / 25)
        self.assertAlmostEqual(envs.reward()[0], wanted, delta=1e-12)

    def test_what_is_no_tolerance_is_refused(self):
        row = '[[reward]]\nterm = "tolerance"\nof = "energy"\n'
        for more, told in (("low = 2\nhigh = 1\n", "low is 2 and high 1"),
                           ('shape = "round"\n', "shape is 'round'; there are gaussian, linear"),
                           ("at_margin = 0\n", "at_margin"), ("margin = -1\n", "margin")):
            (fault,) = self.faults('asset = "a.usda"\n' + row + more)
            self.assertIn(told, fault[2])
        (fault,) = self.faults('asset = "a.usda"\n[[reward]]\nterm = "value"\nof = "energy"\n'
                               "margin = 1\n")
        self.assertIn("margin belongs to the term tolerance", fault[2])

    def test_no_reward_is_told(self):
        text = f'asset = "{tasks.EXAMPLES / "cart_pole.usda"}"\n'
        with self.assertWarnsRegex(UserWarning, r"has no \[\[reward\]\]: every step gives 0"):
            tasks.TaskEnv(self.load(text))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            tasks.TaskEnv(self.load(text + '[[reward]]\nterm = "constant"\n'))


if __name__ == "__main__":
    support.main()
