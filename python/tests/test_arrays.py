# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What worlds and scenes give: nothing swallows a write, everything that can be asked for can be
read, sequences take numbers, slices and paths, and errors speak Python."""

import functools
import inspect
import itertools
import re
import subprocess

import numpy as np
import support
from test_package import PROGRAM

import tenon_usd as tenon
from tenon_usd import logs
from tenon_usd.world import OUTPUTS, WORK

CAN = "/World/can"

SLIDER = '''#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W"
{
    def PhysicsScene "scene"
    {
    }
    def Cube "base" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 1
        float3 physics:diagonalInertia = (0.1, 0.1, 0.1)
    }
    def Cube "slider" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 2
        float3 physics:diagonalInertia = (0.1, 0.1, 0.1)
    }
    def PhysicsFixedJoint "floor"
    {
        rel physics:body1 = </W/base>
    }
    def PhysicsPrismaticJoint "rail"
    {
        uniform token physics:axis = "X"
        rel physics:body0 = </W/base>
        rel physics:body1 = </W/slider>
    }
}
'''


class Writes(support.FilesTestCase):
    def test_nothing_that_a_property_gives_swallows_a_write(self):
        world = tenon.World(support.GRASP, envs=2)
        world.step(2)
        checked = []
        for name, member in inspect.getmembers(tenon.World, lambda one: isinstance(one, property)):
            value = None if name == "model" else getattr(world, name)
            if isinstance(value, np.ndarray):
                checked.append(name)
                before = value.copy()
                with self.assertRaises(ValueError, msg=name):
                    value[...] = 1
                np.testing.assert_array_equal(getattr(world, name), before)
                if member.fset:
                    setattr(world, name, before)
        self.assertGreaterEqual(len(checked), 9)

    def test_nothing_that_a_scene_gives_swallows_a_write(self):
        scene = tenon.physics(support.GRASP)
        count = 0
        for objects in (scene.bodies, scene.joints, scene.colliders, scene.materials):
            for one, name in itertools.product(objects, objects.columns):
                value = getattr(one, name)
                if isinstance(value, np.ndarray) and value.size:
                    count += 1
                    self.assertFalse(value.flags.writeable, name)
        self.assertGreater(count, 50)

    def test_what_a_method_gives_is_ones_own_and_goes_back(self):
        world = tenon.World(support.HAND, envs=2, physics="physics")
        positions, velocities = world.joints()
        positions[1, 0] += 0.1
        world.set_joints(positions)
        np.testing.assert_allclose(world.joint_positions, positions, atol=1e-12)
        self.assertTrue(velocities.flags.writeable)

    def test_other_libraries_take_the_memory(self):
        world = tenon.World(support.GRASP, envs=3)
        positions, _ = world.joints()
        for array in (positions, world._batch.body_poses()):
            taken = np.from_dlpack(array)
            self.assertTrue(np.shares_memory(taken, array))
            self.assertEqual(np.asarray(array).__array_interface__["data"],
                             array.__array_interface__["data"])
        try:
            import torch
        except ImportError:
            return
        self.assertEqual(torch.from_dlpack(positions).data_ptr(),
                         positions.__array_interface__["data"][0])


class Sequences(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.scene = tenon.physics(support.GRASP)
        self.bodies = self.scene.bodies

    def test_slices_are_parts_without_copies(self):
        paths = self.bodies.column("path")
        masses = self.bodies.column("mass")
        for part in (slice(0, 2), slice(None, None, 3), slice(None, None, -1), slice(-3, None),
                     slice(5, 1, -2), slice(4, 4), slice(100, 200), slice(-100, 3)):
            found = self.bodies[part]
            self.assertEqual(len(found), len(paths[part]))
            self.assertEqual([body.path for body in found], paths[part])
            self.assertEqual(found.column("path"), paths[part])
            np.testing.assert_array_equal(found.column("mass"), masses[part])
            self.assertEqual(found.column("center_of_mass").shape, (len(found), 3))
            for again in (slice(None, None, -1), slice(1, None, 2)):
                self.assertEqual(found[again].column("path"), paths[part][again])
                np.testing.assert_array_equal(found[again].column("mass"), masses[part][again])
        self.assertTrue(np.shares_memory(self.bodies[::2].column("mass"), masses))
        self.assertEqual(self.bodies[2:][0].path, paths[2])
        self.assertEqual(self.bodies[2:][-1].path, paths[-1])

    def test_paths_and_names(self):
        can = self.bodies[CAN]
        self.assertEqual(can.path, CAN)
        self.assertEqual(self.bodies["can"].path, CAN)
        self.assertEqual(self.bodies.index(CAN), self.bodies.column("path").index(CAN))
        self.assertIn(CAN, self.bodies)
        self.assertNotIn("/World/none", self.bodies)
        self.assertNotIn(7, self.bodies)
        with self.assertRaisesRegex(KeyError, "did you mean.*/World/can"):
            self.bodies["/World/cann"]
        with self.assertRaisesRegex(KeyError, "did you mean.*/World/can"):
            self.bodies["cna"]
        with self.assertRaises(KeyError):
            self.bodies[1:1]["can"]
        with self.assertRaisesRegex(IndexError, "there are"):
            self.bodies[99]
        nested = SLIDER.replace('Cube "slider"', 'Xform "b"\n{\ndef Cube "base"')
        path = self.written("two.usda", nested.replace("</W/slider>", "</W/b/base>")
                            .replace("    def PhysicsFixedJoint", "}\ndef PhysicsFixedJoint"))
        with self.assertRaisesRegex(KeyError, "several"):
            tenon.physics(path).bodies["base"]

    def test_they_print_what_they_are(self):
        self.assertEqual(repr(self.bodies[CAN]), "<Body /World/can>")
        self.assertRegex(repr(self.bodies), r"<List of \d+ Body: /World/.*, \.\.\.>")
        self.assertEqual(repr(self.bodies[:0]), "<List of 0>")
        self.assertRegex(repr(self.scene), r"<PhysicsScene: .*\d+ bodies, \d+ colliders")
        drive = next(joint for joint in self.scene.joints if len(joint.drives)).drives[0]
        self.assertRegex(repr(drive), r"<Drive .*dof='\w+' .*stiffness=")
        world = tenon.World(support.GRASP, envs=2)
        self.assertRegex(repr(world), r"2 environments on mujoco: \d+ bodies")
        for one in (self.scene, *self.scene.bodies, *self.scene.joints, self.scene.joints):
            self.assertNotRegex(repr(one), "0x[0-9a-f]{6}")

    def test_notebooks_show_tables_in_which_everything_is_text(self):
        stage = tenon.open(self.written("a<b>.usda", SLIDER.replace("rel physics:body1 = </W/base>",
                                                                    "rel physics:body1 = </W/no>")))
        world = tenon.World(support.GRASP, outputs=["work"])
        for one, words in ((stage, ["a&lt;b&gt;.usda", "W"]), (self.scene, ["bodies"]),
                           (self.bodies, [CAN, "mass [kg]"]), (world, ["mujoco", "work"])):
            html = one._repr_html_()
            self.assertTrue(html.startswith("<table>"))
            self.assertNotIn("<b>", html)
            self.assertEqual(html.count("<tr>"), html.count("</tr>"))
            for word in words:
                self.assertIn(word, html)
        try:
            tenon.open(self.folder / "<i>.usda")
        except tenon.Error as error:
            self.assertIn("&lt;i&gt;", error._repr_html_())


class Outputs(support.FilesTestCase):
    def slider(self, outputs):
        return tenon.World(self.written("slider.usda", SLIDER), envs=2, time_step=0.001,
                           outputs=outputs)

    def test_forces_accelerations_and_work_are_those_of_a_push_on_rails(self):
        # 3 N along the rail: 3 = 2 a (Newton), and the rail carries the weight of the slider.
        world = self.slider(["reactions", "accelerations", "work", "efforts"])
        self.assertEqual(world.outputs, ("reactions", "accelerations", "work", "efforts"))
        self.assertEqual(world.joint_paths, ["/W/floor", "/W/rail"])
        world.set_efforts([[3.0], [0.0]])
        world.step(100)
        slider = world.body_names.index("/W/slider")
        self.assertEqual(world.body_accelerations().shape, (2, 2, 6))
        np.testing.assert_allclose(world.body_accelerations()[:, slider, :3],
                                   [[1.5, 0, 0], [0, 0, 0]], atol=1e-6)
        np.testing.assert_allclose(world.joint_accelerations(), [[1.5], [0.0]], atol=1e-6)
        reactions = world.joint_reactions()
        self.assertEqual(reactions.shape, (2, 2, 6))
        np.testing.assert_allclose(reactions[:, 1, 2], 2 * 9.81, rtol=1e-3)
        np.testing.assert_allclose(reactions[:, 0, 2], 3 * 9.81, rtol=1e-3)
        work = world.work()
        self.assertEqual(tuple(work), WORK)
        travelled = world.joint_positions[0, 0]
        np.testing.assert_allclose(work["applied"], [3 * travelled, 0], rtol=0.02, atol=1e-9)
        np.testing.assert_allclose(work["applied"][0], world.energy[0, 0], rtol=0.02)

    def test_every_output_can_be_read_and_logged(self):
        reads = {"contacts": lambda w: w.contacts(), "efforts": lambda w: w.drive_efforts(),
                 "reactions": lambda w: w.joint_reactions(),
                 "accelerations": lambda w: (w.body_accelerations(), w.joint_accelerations()),
                 "work": lambda w: w.work(), "sensors": lambda w: w.sensors()}
        self.assertEqual(set(reads), set(OUTPUTS))
        columns = {"efforts": "driveEffort", "reactions": "reactionForce.x",
                   "accelerations": "linearAcceleration.z", "work": "work.drives"}
        for name, read in reads.items():
            world = tenon.World(support.GRASP, outputs=[name])
            read(world)
            bare = tenon.World(support.GRASP)
            with self.assertRaises(tenon.InvalidError, msg=name) as caught:
                read(bare)
            self.assertIn("World(", caught.exception.fix)
            self.assertNotIn("::", str(caught.exception))
            log = logs.record(world, 0.05, contacts=name == "contacts")
            if name in columns:
                found = [column for column in log.columns if column.endswith(columns[name])]
                self.assertTrue(found, name)
                for column in found:
                    self.assertEqual(log.columns[column].shape, log.time.shape)
                    self.assertTrue(np.isfinite(log.columns[column]).all(), column)
                    self.assertTrue(log.table().units[column], column)

    def test_a_log_of_a_world_has_what_sim_logs(self):
        world = self.slider(["reactions", "accelerations", "work", "efforts"])
        world.set_efforts(3.0)
        log = logs.record(world, 0.1, 0.01)
        np.testing.assert_allclose(log.columns["/W/rail.acceleration"][1:], 1.5, atol=1e-6)
        np.testing.assert_allclose(log.columns["/W/slider.linearAcceleration.x"][1:], 1.5,
                                   atol=1e-6)
        np.testing.assert_allclose(log.columns["/W/rail.reactionForce.z"][1:], 2 * 9.81, rtol=1e-3)
        for part in WORK:
            self.assertIn(f"work.{part}", log.columns)


    def test_the_names_are_those_of_logs_of_the_program(self):
        text = SLIDER.replace("""        float physics:mass = 2
""", """        float physics:mass = 2
        def IsaacImuSensor "imu"
        {
        }
        def IsaacContactSensor "touch"
        {
        }
""")
        text = text.replace(
            '"rail"', '"rail" (prepend apiSchemas = ["PhysicsDriveAPI:linear"])').replace(
            'axis = "X"', 'axis = "X"\n        float drive:linear:physics:stiffness = 10')
        path = self.written("sensors.usda", text)
        done = subprocess.run([PROGRAM, "sim", path, "--duration", "0.05", "-o",
                               self.folder / "run.csv", "--log",
                               "efforts,reactions,accelerations,energy,sensors"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        world = tenon.World(path, outputs=["efforts", "reactions", "accelerations", "work",
                                           "sensors"])
        log = logs.record(world, 0.05)
        wanted = logs.read(self.folder / "run.csv").columns
        self.assertEqual(sorted(set(wanted) - set(log.columns)), [])
        self.assertIn("/W/slider/imu.linearAcceleration.z", wanted)
        self.assertIn("/W/slider/touch.inContact", wanted)


class Words(support.FilesTestCase):
    def test_what_is_wrong_is_told_in_words_of_python(self):
        world = tenon.World(support.GRASP, envs=2)
        pose = [0, 0, 1, 1, 0, 0, 0]
        for call, kind in (
                (lambda: world.reset(1.7), TypeError),
                (lambda: world.reset(2), IndexError),
                (lambda: world.reset([0.0, 1.0]), TypeError),
                (lambda: world.step(-1), ValueError),
                (lambda: world.step(2.5), TypeError),
                (lambda: world.contacts(5), IndexError),
                (lambda: world.sensors(1.0), TypeError),
                (lambda: world.set_body(99, pose), IndexError),
                (lambda: world.set_body(1.5, pose), TypeError),
                (lambda: world.set_body(CAN, [0, 0, 1, 0, 0, 0, 0]), tenon.InvalidError),
                (lambda: world.set_body(CAN, [np.nan, 0, 1, 1, 0, 0, 0]), tenon.InvalidError),
                (lambda: world.set_body("/World/cann", pose), tenon.NotFoundError),
                (lambda: world.set_parameter("bodymass", CAN, 1), tenon.NotFoundError),
                (lambda: tenon.World(support.GRASP, envs=-1), ValueError),
                (lambda: tenon.World(support.GRASP, envs=2.5), TypeError),
                (lambda: tenon.World(support.GRASP, outputs="contacts"), TypeError),
                (lambda: tenon.World(support.GRASP, outputs=["contact"]), tenon.InvalidError),
                (lambda: tenon.World(support.GRASP, vary="gravity=1..2"), TypeError),
                (lambda: tenon.open(5), TypeError),
                (lambda: tenon.open(support.GRASP, overrides="/a.b=1"), TypeError),
                (lambda: tenon.open(support.GRASP, phsyics="mujoco"), TypeError),
                (lambda: tenon.convert(None, "a"), TypeError)):
            with self.assertRaises(kind) as caught:
                call()
            self.assertNotRegex(str(caught.exception), r"nanobind|incompatible function|::|std",
                                inspect.getsource(call))
        with self.assertRaisesRegex(tenon.NotFoundError, "did you mean.*/World/can"):
            world.set_body("/World/cann", pose)
        with self.assertRaisesRegex(tenon.NotFoundError, "did you mean.*bodyMass"):
            world.set_parameter("bodymass", CAN, 1)
        with self.assertRaisesRegex(tenon.InvalidError, "did you mean.*contacts"):
            tenon.World(support.GRASP, outputs=["contact"])
        with self.assertRaisesRegex(TypeError, "unexpected keyword argument 'phsyics'.*physics"):
            tenon.open(support.GRASP, phsyics="mujoco")

    def test_messages_name_the_argument_what_is_expected_and_what_came(self):
        world = tenon.World(support.GRASP, envs=2, threads=1)
        joints = len(world.joint_names)
        with self.assertRaises(AttributeError):
            world.drive_target = 1  # no new attribute for a property that is misspelt
        for name in ("joint_positions", "joint_velocities", "gravity", "drive_targets"):
            wide = getattr(world, name).shape[1]
            for value, kind, told in (
                    (np.zeros((2, 99)), ValueError, rf"\(2, 99\); expected \(2, {wide}\)"),
                    (None, TypeError, rf"of the shape \(2, {wide}\).*not NoneType"),
                    ("far", TypeError, "not numbers of <U3"), (1j, TypeError, "complex"),
                    ([[1], [1, 2]], ValueError, "rows of different lengths"),
                    ((n for n in (1, 2)), TypeError, "generator")):
                with self.assertRaisesRegex(kind, f"^{name} .*{told}"):
                    setattr(world, name, value)
        make = functools.partial(tenon.World, support.GRASP)
        for call, kind, told in (
                (lambda: world.set_joints(velocities=[1, 2, 3]), ValueError,
                 rf"velocities has the shape \(3,\); expected \(2, {joints}\)"),
                (lambda: world.set_efforts([1, 2, 3]), ValueError, "efforts has the shape"),
                (lambda: world.set_wrench(CAN, [1, 2]), ValueError, r"wrenches .*\(2, 6\)"),
                (lambda: world.set_wrench(None, [1, 2]), TypeError, "body is .*, not None"),
                (lambda: world.set_body(CAN, [1, 2]), ValueError, r"^poses .*\(2, 7\)"),
                (lambda: world.set_parameter("bodyMass", CAN, [1, 2, 3]), ValueError,
                 r"values has the shape \(3,\)"),
                (lambda: world.set_parameter("bodyMass", 0, 1), TypeError, "path is a path, not 0"),
                (lambda: world.set_parameter(0, CAN, 1), TypeError, "name is a str, not 0"),
                (lambda: world.step(1 << 64), ValueError, "count must be at most"),
                (lambda: world.restore("text"), TypeError, "states are bytes"),
                (lambda: world.restore([None, None]), TypeError, "states are bytes"),
                (lambda: make(envs=10**30), ValueError, "envs must be at most"),
                (lambda: make(envs="2"), TypeError, "envs is a whole number, not '2'"),
                (lambda: make(seed=-1), ValueError, "seed must be 0 or more, not -1"),
                (lambda: make(seed=1 << 64), ValueError, "seed must be at most"),
                (lambda: make(time_step=np.nan), tenon.InvalidError, "time_step .*, not nan"),
                (lambda: make(time_step=-1), tenon.InvalidError, "time_step .*, not -1"),
                (lambda: make(time_step="fast"), TypeError, "time_step .*, not 'fast'"),
                (lambda: make(engine=3), TypeError, "engine is a str, not 3"),
                (lambda: make(integrator=4), TypeError, "integrator is a str, not 4"),
                (lambda: make(outputs=None), TypeError, "outputs is a list of str, not None"),
                (lambda: make(vary=[1]), TypeError, "vary is a list of str; 1 in it"),
                (lambda: make(deactivate=[support.GRASP]), TypeError, "deactivate is a list of"),
                (lambda: make(physics=3), TypeError, "physics is a str, not 3"),
                (lambda: tenon.World("a\0b.usda"), ValueError, "null character"),
                (lambda: tenon.open("\ud800.usda"), UnicodeEncodeError, "surrogates"),
                (lambda: tenon.rule("joint.body-missin"), KeyError, "did you mean"),
                (lambda: logs.record(world, -1), tenon.InvalidError, "duration .*, not -1"),
                (lambda: logs.record(world, 1, np.nan), tenon.InvalidError, "every .*, not nan"),
                (lambda: tenon.convert("a.urdf", "b.usda", gains=(1, 2, 3)), TypeError,
                 r"two numbers \(K, D\).*not \(1, 2, 3\)")):
            with self.assertRaisesRegex(kind, told, msg=inspect.getsource(call)):
                call()
        self.assertEqual(make(integrator=None, seed=(1 << 64) - 1).envs, 1)

    def test_bodies_are_named_by_the_last_element_of_their_path(self):
        world = tenon.World(support.GRASP, threads=1)
        world.set_body("can", [0, 0, 3, 1, 0, 0, 0])
        np.testing.assert_allclose(world.body_poses[0, world.body_names.index(CAN), 2], 3)
        world.set_parameter("bodyMass", "can", 0.5)
        with self.assertRaisesRegex(tenon.NotFoundError, "body: there is no 'cann'"):
            world.set_body("cann", [0, 0, 3, 1, 0, 0, 0])

    def test_numbers_of_numpy_and_from_the_end_are_numbers(self):
        world = tenon.World(support.GRASP, envs=np.int64(2))
        can = np.int64(world.body_names.index(CAN))
        world.set_body(can, [0, 0, 3, 2, 0, 0, 0])  # a quaternion of any length
        np.testing.assert_allclose(world.body_poses[:, can], [[0, 0, 3, 1, 0, 0, 0]] * 2)
        world.step(np.int32(3))
        world.reset(np.int64(-1))
        self.assertEqual(world.time.tolist(), [3 * world.time_step, 0])

    def test_advice_names_arguments_and_not_options_of_the_command(self):
        path = self.written("slider.usda", SLIDER)
        tenon.structure(path, self.folder / "asset")
        for file in (self.folder / "asset").rglob("*.usda"):
            file.write_text(file.read_text() + "\n# mine\n")
        with self.assertRaises(tenon.Error) as caught:
            tenon.structure(path, self.folder / "asset")
        self.assertIn("force=True", str(caught.exception))
        self.assertFalse(re.search(r"--\w", str(caught.exception)))


if __name__ == "__main__":
    support.main()
