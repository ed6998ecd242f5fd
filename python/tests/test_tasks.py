# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Tasks in files: what they say happens, and what they say wrong is told with its line."""

import math
import pickle
import sys

import numpy as np
import support

try:
    import gymnasium

    import tenon_usd as tenon
    from tenon_usd import tasks
    from tenon_usd.actuators import DCMotor, Delay, PD, Saturation
    from tenon_usd.draws import LogUniform, Normal, Uniform
    from tenon_usd.observations import Entry
except ImportError as reason:
    print(f"skipped: {reason}")
    sys.exit(77)

ENGINES = ("mujoco", "physx", "jolt")


class Files(support.FilesTestCase):
    def load(self, text):
        return tasks.load(self.written("task.toml", text))

    def faults(self, text, make=False):
        with self.assertRaises(tasks.TaskError) as caught:
            task = self.load(text)
            if make:
                tasks.TaskEnv(task)
        return [(fault.row, fault.line, fault.message) for fault in caught.exception.faults]


class Reading(Files):
    def test_a_task_is_what_its_file_says(self):
        task = tasks.load("reach")
        self.assertEqual((task.name, task.engine, task.step, task.frame, task.episode),
                         ("reach", "mujoco", 0.0025, 0.02, 2.0))
        self.assertTrue(task.asset_path.endswith("tasks/arm.usda"))
        (motors,) = task.actions
        self.assertEqual(motors.stages, (
            Delay(0.01), PD(LogUniform(6, 10), 0.5, 200), DCMotor(3, 20), Saturation(2)))
        self.assertEqual(task.draws, {"bodyMass@/Arm/fore": Uniform(0.8, 1.2)})
        self.assertEqual(task.observations[1].noise, Normal(0, 0.001))
        self.assertEqual(task.goals[0].values, (Uniform(0.15, 0.35), Uniform(-0.3, 0.3), 0.0))
        self.assertEqual([row.name for row in task.rewards], ["distance", "there", "restless"])
        self.assertEqual(tasks.load(tasks.EXAMPLES / "reach.toml"), task)

    def test_unknown_keys_are_refused_with_their_lines(self):
        faults = self.faults('asset = "a.usda"\nenginee = "jolt"\n\n[[reward]]\nterm = "constant"\n'
                             'wieght = 2\n[[reward]]\nname = "b"\nterm = "nearly"\n'
                             '[[observation]]\nof = "energy"\n'
                             'noise = {normal = [0, 1], nomal = [1, 1]}\n[[action]]\n'
                             'joints = "x"\nstages = [\n  {delay = 0.01},\n'
                             '  {pd = {stifness = 3, damping = 1}},\n]\n'
                             '[[tremination]]\nof = "x"\n')
        places = {(row, line) for row, line, _ in faults}
        self.assertLessEqual({("", 2), ("", 19), ("reward 1", 6), ("reward 2", 9),
                              ("observation 1", 12), ("action 1", 17)}, places)
        text = "\n".join(message for *_, message in faults)
        for meant in ("engine", "weight", "normal", "stiffness", "termination"):
            self.assertIn(f'did you mean "{meant}"?', text)
        self.assertIn("'nearly'; there are constant", text)

    def test_bad_values_are_faults(self):
        head = 'asset = "a.usda"\n'
        for text, told in (
                ("", "asset is missing"), ("asset = 5", "expected a text"), ("a =\n", "Invalid"),
                (head + "frame = -1\n", "expected a number"), (head + "reward = 1\n", "[[reward]]"),
                (head + "[[goal]]\nname = 'a'\n", "a name and values"),
                (head + "[[goal]]\nname = 'a'\nvalues = ['x']\n", "expected a number or a table"),
                (head + "[[draw]]\nof = 'bodyMass'\nuniform = [2, 1]\n", "finite range"),
                (head + "[[draw]]\nof = 'bodyMass'\nuniform = [1]\n", "uniform = [1]"),
                (head + "[[draw]]\nof = 'a'\nchoice = [1]\n[[draw]]\nof = 'a'\nchoice = [1]\n",
                 "drawn twice"),
                (head + "[[draw]]\nof = 'a'\n", "one of uniform"),
                (head + "[[reset]]\nof = 'bodyMass@x'\nvalue = 1\n", "jointVelocity@JOINT"),
                (head + "[[action]]\njoints = 'x'\ncommand = 'torque'\n", "effort"),
                (head + "[[action]]\njoints = 'x'\nstages = [{dc_motor = {stall_effort = 1, "
                 "no_load_speed = 2}}]\n", "PID stands before it"),
                (head + "[[action]]\njoints = 'x'\nstages = [{delay = -1}]\n", "0 or more"),
                (head + "[[action]]\njoints = 'x'\nstages = [{pd = {stiffness = 1}}]\n", "damping"),
                (head + "[[reward]]\nterm = 'near'\n", "`of` is missing"),
                (head + "[[action]]\njoints = ['x', 3]\n", "or a list of them"),
                (head + "[[reset]]\nof = 'position@x'\nvalue = 1\n", "position.x@BODY"),
                (head + "[[reset]]\nof = 'yaw'\nvalue = 1\n", "yaw@BODY"),
                (head + "[[reward]]\nterm = 'constant'\n[[reward]]\nterm = 'constant'\n",
                 "two are called"),
                (head + "[[termination]]\nof = 'energy'\n", "above, below, beyond, within")):
            with self.subTest(text):
                self.assertIn(told, "\n".join(message for *_, message in self.faults(text)))
        self.assertTrue(self.faults("#" * (1 << 20) + "\n"))
        with self.assertRaises(FileNotFoundError):
            tasks.load("nothing.toml")

    def test_joints_are_commanded_in_the_order_of_a_list(self):
        head = f'asset = "{tasks.EXAMPLES / "cart_pole.usda"}"\n[[action]]\ncommand = "effort"\n'
        head += 'low = -1\nhigh = 1\n'
        for joints in (["hinge", "slide"], ["slide", "hinge"]):
            envs = tasks.TaskEnv(self.load(f"{head}joints = {joints}\n"))
            self.assertEqual([entry.name for entry in envs.action_spec],
                             [f"command@/CartPole/{joint}" for joint in joints])

    def test_a_task_that_the_package_has_not(self):
        with self.assertRaisesRegex(tenon.MissingFileError, "did you mean 'balance'.*toml"):
            tasks.load("balanc")

    def test_errors_travel(self):
        with self.assertRaises(tasks.TaskError) as caught:
            self.load("x = 1\n")
        again = pickle.loads(pickle.dumps(caught.exception))
        self.assertEqual((str(again), again.faults), (str(caught.exception),
                                                      caught.exception.faults))
        self.assertRegex(str(again), r'task.toml:1: there is no "x" here')

    def test_names_that_the_asset_has_not_are_told_with_their_rows(self):
        head = f'asset = "{tasks.EXAMPLES / "cart_pole.usda"}"\n'
        faults = self.faults(head + '[[observation]]\nof = "position@/CartPole/pol"\n[[reward]]\n'
                             'term = "near"\nof = "jointPosition"\nto = "goal.there"\n[[reset]]\n'
                             'of = "jointPosition@hinges"\nvalue = 0\n', make=True)
        self.assertEqual([(row, line) for row, line, _ in faults],
                         [("observation 1", 2), ("reward 1", 4), ("reset 1", 8)])
        self.assertIn("did you mean '/CartPole/pole'", faults[0][2])
        faults = self.faults(head + '[[reward]]\nterm = "near"\nof = "jointPosition"\n'
                             'to = [1, 2, 3]\n', make=True)
        self.assertIn("`of` has 2 numbers, `to` has 3", faults[0][2])


class Balance(Files):
    def test_a_push_accelerates_the_cart_as_it_should(self):
        # From rest, upright: x'' = F / (M + m - 3 m / 4), for the pole is a rod of inertia
        # m L^2 / 12 about its middle.
        for engine in ENGINES:
            with self.subTest(engine):
                envs = tasks.TaskEnv("balance", 1, engine=engine, frame_time=0.004)
                envs.reset(seed=0)
                envs.world.set_joints([[0.0, 0.0]], [[0.0, 0.0]])
                envs.step(np.array([[0.5]]))
                speed = envs.values("jointVelocity")[0]
                names = [entry.name for entry in envs.observation_spec[2:]]
                along = speed[names.index("jointVelocity@/CartPole/slide")]
                self.assertAlmostEqual(along, 0.004 * 5 / (1 + 0.1 / 4), delta=2e-5)

    def test_a_pole_that_is_left_alone_falls(self):
        envs = tasks.TaskEnv("balance", 8)
        observations, _ = envs.reset(seed=1)
        self.assertTrue((np.abs(observations) <= 0.05).all())
        self.assertEqual(len(np.unique(observations)), observations.size)
        over = np.zeros(8, dtype=bool)
        steps = np.zeros(8)
        while not over.all():
            _, rewards, terminated, truncated, infos = envs.step(np.zeros((8, 1)))
            np.testing.assert_array_equal(infos["reward.up"], 1)
            over |= terminated
            steps += ~over
            self.assertFalse(truncated.any())
            np.testing.assert_array_equal(infos["over.fallen"] | infos["over.away"], terminated
                                          | infos["over.fallen"])
            self.assertLess(steps.max(), 200)

    def test_a_linear_law_keeps_it_up(self):
        envs = tasks.TaskEnv("balance", 4)
        observations, _ = envs.reset(seed=2)
        total = np.zeros(4)
        truncated = np.zeros(4, dtype=bool)
        while not truncated.any():
            angle, x, turning, speed = observations.T
            push = 5 * angle + 1.2 * turning + 0.15 * x + 0.3 * speed
            observations, rewards, terminated, truncated, _ = envs.step(push[:, None])
            self.assertFalse(terminated.any())
            total += rewards
        np.testing.assert_array_equal(total, 500)


class Placed(Files):
    """Bodies and joints where rows [[reset]] put them, and what is observed of a place."""

    TEXT = """asset = "box.usda"
[[observation]]
of = "position@Box"
to = "goal.place"

[[observation]]
of = "position.z@Box"
to = 1
scale = 2

[[goal]]
name = "place"
values = [{uniform = [1, 2]}, 0, 1]

[[reset]]
of = "position.x@Box"
uniform = [-0.3, 0.3]

[[reset]]
of = "position.z@/World/Box"
value = 3

[[reset]]
of = "yaw@Box"
choice = [0.5]
"""

    def setUp(self):
        super().setUp()
        stage = tenon.new(self.folder / "box.usda")
        stage.add("/World/Box", "cube", "body", "collider", size=0.2, at=(0, 5, 1))
        stage.save()

    def test_bodies_begin_where_they_are_drawn(self):
        for engine in ENGINES:
            with self.subTest(engine):
                envs = tasks.TaskEnv(self.load(self.TEXT), 4, engine=engine)
                observations, _ = envs.reset(seed=3)
                poses = envs.world.body_poses[:, 0]
                x = poses[:, 0].copy()
                self.assertEqual(len(np.unique(x)), 4)
                self.assertTrue((np.abs(x) <= 0.3).all())
                turned = [np.cos(0.25), 0, 0, np.sin(0.25)]
                np.testing.assert_allclose(poses[:, 1:], [[5, 3, *turned]] * 4, atol=1e-6)
                np.testing.assert_allclose(observations[:, :3],
                                           poses[:, :3] - envs.goals["place"], atol=1e-12)
                np.testing.assert_allclose(observations[:, 3], 4, atol=1e-6)
                envs.step(np.zeros((4, 0)))
                again, _ = envs.reset(options={"reset_mask": np.array([True, False, True, False])})
                moved = envs.world.body_poses[:, 0, 0] != x
                self.assertEqual(moved.tolist(), [True, False, True, False])
                np.testing.assert_allclose(again[:, 3] > 3.999, moved)  # the others fall on

    def test_observations_say_what_they_are_seen_from(self):
        envs = tasks.TaskEnv(self.load(self.TEXT))
        names = [entry.name for entry in envs.observation_spec]
        self.assertEqual(names, [
            *(f"position.{axis}@/World/Box - goal.place" for axis in "xyz"),
            "position.z@/World/Box - 1"])
        faults = self.faults(self.TEXT.replace("to = 1", "to = [1, 2]"), make=True)
        self.assertEqual([(row, line) for row, line, _ in faults], [("observation 2", 6)])

    def test_bodies_that_there_are_not(self):
        faults = self.faults(self.TEXT.replace("yaw@Box", "yaw@Bax"), make=True)
        self.assertEqual([(row, line) for row, line, _ in faults], [("reset 3", 23)])
        self.assertIn("did you mean '/World/Box'", faults[0][2])


class Ported(Files):
    def test_a_model_of_mujoco_moves_as_it_does_there(self):
        import mujoco  # of the environment that has Gymnasium, too

        examples = support.ROOT / "python/examples"
        tenon.convert(examples / "reacher.xml", self.folder / "reacher.usda", scene=True)
        envs = tasks.TaskEnv(examples / "reacher.toml", 3, asset=self.folder / "reacher.usda")
        observations, _ = envs.reset(seed=2)
        model = mujoco.MjModel.from_xml_path(str(examples / "reacher.xml"))
        others = [mujoco.MjData(model) for _ in range(3)]
        for data, row in zip(others, observations):
            data.qpos[:] = row[:2]
        random = np.random.default_rng(4)
        for _ in range(60):
            actions = random.uniform(-1, 1, (3, 2))
            observations = envs.step(actions)[0]
            for data, action in zip(others, actions):
                data.ctrl[:] = action
                mujoco.mj_step(model, data, 2)
        for name in ("qpos", "qvel"):
            there = dict(zip(("shoulder", "elbow"), np.array([getattr(data, name)
                                                              for data in others]).T))
            kind = {"qpos": "jointPosition", "qvel": "jointVelocity"}[name]
            for joint, numbers in there.items():
                np.testing.assert_allclose(envs.values(f"{kind}@{joint}")[:, 0], numbers,
                                           atol=1e-4)


class Pushed(Files):
    TEXT = """asset = "ASSET"
step = 0.004
[[action]]
joints = "slide"
command = "effort"
low = -1
high = 1
[[push]]
body = "cart"
force = FORCE
every = EVERY
lasts = 0.04
"""

    def envs(self, force, every, num_envs=1, **options):
        text = self.TEXT.replace("ASSET", str(tasks.EXAMPLES / "cart_pole.usda"))
        return tasks.TaskEnv(self.load(text.replace("FORCE", force).replace("EVERY", every)),
                             num_envs, **options)

    def test_a_push_gives_its_momentum(self):
        # As in Balance: from rest, upright, F t / (M + m / 4), nearly, for 0.04 s.
        for engine in ENGINES:
            with self.subTest(engine):
                envs = self.envs("[5, 0, 0]", "0.1", engine=engine)
                envs.reset(seed=0)
                column = envs.world.joint_names.index("/CartPole/slide")
                speeds = []
                for _ in range(8):
                    envs.step(np.zeros((1, 1)))
                    speeds.append(envs.world.joint_velocities[0, column])
                np.testing.assert_array_equal(speeds[:5], 0)
                self.assertAlmostEqual(speeds[6], 5 * 0.04 / 1.025, delta=0.003)
                self.assertAlmostEqual(speeds[7], speeds[6], delta=0.006)

    def test_each_environment_is_pushed_at_its_own_times(self):
        force, every = "[{normal = [0, 3]}, 0, 0]", "{uniform = [0.02, 0.2]}"
        three, one = self.envs(force, every, 3), self.envs(force, every)
        three.reset(seed=4)
        one.reset(seed=5)
        seen = []
        for _ in range(40):
            three.step(np.zeros((3, 1)))
            one.step(np.zeros((1, 1)))
            np.testing.assert_array_equal(three.pushes.forces[:, 1:2], one.pushes.forces)
            seen.append(three.pushes.forces[0, :, 0].copy())
        acting = np.array(seen) != 0
        self.assertTrue((acting.sum(axis=0) > 4).all())
        self.assertTrue((acting[:, 0] != acting[:, 1]).any())
        self.assertGreater(len(np.unique(seen)), 8)
        three.reset()
        np.testing.assert_array_equal(three.pushes.forces, 0)

    def test_a_body_that_there_is_not(self):
        with self.assertRaisesRegex(tasks.TaskError, r"task.toml:8: push: .*/CartPole/cart"):
            text = self.TEXT.replace("ASSET", str(tasks.EXAMPLES / "cart_pole.usda"))
            tasks.TaskEnv(self.load(text.replace('"cart"', '"card"').replace("FORCE", "[1, 0, 0]")
                                    .replace("EVERY", "1")))
        faults = self.faults('asset = "a"\n[[push]]\nbody = "b"\nforce = [1]\nevery = 1\n')
        self.assertIn("a force and every", faults[0][2])


class Reach(Files):
    def test_episodes_draw_goals_starts_and_motors(self):
        envs = tasks.TaskEnv("reach", 3)
        first, _ = envs.reset(seed=5)
        goals = envs.goals["target"].copy()
        self.assertTrue(((goals[:, 0] >= 0.15) & (goals[:, 0] <= 0.35)).all())
        self.assertEqual(len(np.unique(goals[:, :2])), 6)
        stiffness = envs.actuators.numbers["/Arm/elbow.PD.stiffness"]
        self.assertTrue(((stiffness >= 6) & (stiffness <= 10)).all())
        mass = envs.world.drawn
        envs.reset()
        self.assertTrue((envs.goals["target"][:, :2] != goals[:, :2]).all())
        again, _ = envs.reset(seed=5)
        np.testing.assert_array_equal(again, first)
        self.assertEqual(envs.world.drawn, mass)
        one = tasks.TaskEnv("reach", 1)
        alone, _ = one.reset(seed=6)
        np.testing.assert_array_equal(alone[0], first[1])
        for _ in range(5):
            alone = one.step(np.full((1, 2), 0.3))[0]
            first = envs.step(np.full((3, 2), 0.3))[0]
        np.testing.assert_allclose(alone[0], first[1], rtol=1e-9)

    def test_an_arm_that_aims_gets_there(self):
        # Two links of 0.2 m: elbow by the law of cosines, shoulder behind it.
        envs = tasks.TaskEnv("reach", 6, noise=None)
        envs.reset(seed=0)
        goals = envs.goals["target"]
        reach = np.minimum(np.hypot(goals[:, 0], goals[:, 1]), 0.399)
        elbow = np.arccos(np.clip((reach**2 - 0.08) / 0.08, -1, 1))
        shoulder = np.arctan2(goals[:, 1], goals[:, 0]) - elbow / 2
        wanted = np.stack([elbow, shoulder], axis=1)
        action = 2 * (wanted - envs._low) / (envs._high - envs._low) - 1
        for _ in range(90):
            observations, rewards, *_, infos = envs.step(action)
        inside = np.hypot(goals[:, 0], goals[:, 1]) < 0.4
        distance = -infos["reward.distance"]
        self.assertTrue((distance[inside] < 0.01).all(), distance)
        np.testing.assert_allclose(infos["reward.there"], np.exp(-(distance / 0.05) ** 2))
        np.testing.assert_array_equal(infos["reward.restless"], 0)
        np.testing.assert_allclose(rewards, sum(value for name, value in infos.items()
                                                if name.startswith("reward.")))

    def test_it_is_the_same_task_on_each_engine(self):
        moved = []
        for engine in ENGINES:
            envs = tasks.TaskEnv("reach", 2, engine=engine)
            envs.reset(seed=3)
            for _ in range(25):
                observations = envs.step(np.full((2, 2), 0.2))[0]
            moved.append(envs.world.joint_positions)
        np.testing.assert_allclose(moved[1], moved[0], atol=2e-3)
        np.testing.assert_allclose(moved[2], moved[0], atol=2e-3)


class Bonus(tasks.TaskEnv):
    """What a file cannot say."""

    def reward(self):
        return super().reward() + 10.0 * (self.values("jointPosition")[:, 1] > 0)

    def is_over(self):
        return super().is_over() | (self.world.time > 0.11)


class Watched(tasks.TaskEnv):
    """Observes more than its file says."""

    @property
    def observation_spec(self):
        return (*super().observation_spec, Entry("energy", "J"))

    def observe(self):
        return np.concatenate([super().observe(), self.values("energy")], axis=1)


class Classes(Files):
    def test_a_subclass_adds_what_a_file_cannot_say(self):
        envs = Bonus(tasks.load("balance"), num_envs=2)
        envs.reset(seed=0)
        for _ in range(6):
            _, rewards, terminated, *_ = envs.step(np.array([[1.0], [-1.0]]))
        np.testing.assert_array_equal(rewards, [11, 1])
        self.assertEqual(terminated.tolist(), [True, True])
        with self.assertRaisesRegex(tenon.NotFoundError, "did you mean 'energy'"):
            envs.values("enery")

    def test_a_subclass_measures_what_the_file_does_not_name(self):
        envs = tasks.TaskEnv("balance", 2)
        envs.reset(seed=0)
        envs.step(np.zeros((2, 1)))
        np.testing.assert_array_equal(envs.values("energy")[:, 0], envs.world.energy.sum(axis=1))
        pole = envs.world.body_names.index("/CartPole/pole")
        np.testing.assert_array_equal(envs.values("position@pole"),
                                      envs.world.body_poses[:, pole, :3])
        with self.assertRaisesRegex(tenon.InvalidError, "outputs"):
            envs.values("contactForce@pole")

    def test_a_subclass_observes_more(self):
        envs = Watched("balance", 3, autoreset_mode="SameStep")
        self.assertEqual(envs.single_observation_space.shape, (5,))
        first, _ = envs.reset(seed=0)
        np.testing.assert_array_equal(first[:, 4], envs.values("energy")[:, 0])
        observations = envs.step(np.zeros((3, 1)))[0]
        self.assertTrue(envs.observation_space.contains(observations))

    def test_what_a_subclass_gives_has_its_shape(self):
        for name, value, told in (
                ("observe", np.zeros((2, 3)), r"observe\(\).*\(2, 3\).*4 numbers for each of 2"),
                ("reward", np.zeros((2, 1)), r"reward\(\).*\(2, 1\); expected \(2,\)"),
                ("is_over", np.zeros(3, dtype=bool), r"is_over\(\).*\(3,\); expected \(2,\)")):
            envs = tasks.TaskEnv("balance", 2)
            envs.reset(seed=0)
            setattr(envs, name, lambda value=value: value)
            with self.assertRaisesRegex(ValueError, told):
                envs.step(np.zeros((2, 1)))

    def test_terms_are_their_formulas(self):
        text = f'asset = "{tasks.EXAMPLES / "cart_pole.usda"}"\n[[action]]\njoints = "slide"\n'
        text += 'command = "effort"\nlow = -2\nhigh = 2\n[[goal]]\nname = "g"\nvalues = [0.5]\n'
        for term in ("value", "distance", "square", "near", "within"):
            text += f'[[reward]]\nterm = "{term}"\nof = "jointPosition"\nto = "goal.g"\n'
            text += "width = 0.6\n"
            text += "weight = 2\n" if term == "value" else ""
        text += '[[reward]]\nterm = "action"\n[[reward]]\nterm = "action_change"\n'
        text += '[[termination]]\nof = "jointPosition@slide"\nabove = 0.4\nreward = -7\n'
        envs = tasks.TaskEnv(self.load(text), 2)
        envs.reset(seed=0)
        envs.step(np.array([[0.5], [-0.5]]))
        envs.world.set_joints([[0.1, 0.3], [0.2, 0.45]])
        *_, infos = envs.step(np.array([[0.25], [-0.5]]))
        off = envs.world.joint_positions - 0.5
        square = (off**2).sum(axis=1)
        for term, value in (("value", 2 * off.sum(axis=1)), ("distance", np.sqrt(square)),
                            ("square", square), ("near", np.exp(-square / 0.36)),
                            ("within", np.sqrt(square) < 0.6), ("action", [0.0625, 0.25]),
                            ("action_change", [0.0625, 0])):
            np.testing.assert_allclose(infos[f"reward.{term}"], value, err_msg=term, atol=1e-15)
        self.assertEqual(infos["over.jointPosition@slide"].tolist(), [False, True])
        total = sum(value for name, value in infos.items() if name.startswith("reward."))
        np.testing.assert_allclose(envs.reward(), total + [0, -7])

    def test_gymnasium_makes_them_by_name(self):
        envs = gymnasium.make_vec("tenon_usd.gym:tenon/Balance-v0", num_envs=3)
        self.assertEqual(envs.unwrapped.task, tasks.load("balance"))
        env = gymnasium.make("tenon_usd.gym:tenon/Task-v0", task=tasks.EXAMPLES / "reach.toml")
        self.assertTrue(math.isfinite(env.reset(seed=0)[0].sum()))


if __name__ == "__main__":
    support.main()
