# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon_usd.newton: what needs no Newton; beside Newton, where one is found, its own importer's
models, the arguments, what is refused, many environments, and docs/newton.md.

Newton is the one of this Python, else that of an environment of the judge (tools/judge.py
beside_newton), in which the script is then run; where there is none, its tests are skipped.
"""

import importlib.util
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest
import warnings
from pathlib import Path

import support

import tenon_usd
from tenon_usd.errors import InvalidError, MissingError, UnsupportedError

PAGE = support.ROOT / "docs/newton.md"
SNIPPET = re.compile(r"^```python\n(.*?)^```$", re.M | re.S)
CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
FOUND = "TENON_NEWTON_FOUND"  # set where the script runs in the judge's environment
HAS_NEWTON = importlib.util.find_spec("newton") is not None
WITHOUT = "no newton (tools/judge.py beside_newton makes an environment that has it)"

ARM = """#usda 1.0
(
    defaultPrim = "arm"
    metersPerUnit = 1
    upAxis = "Z"
)
def PhysicsScene "scene"
{
    float physics:gravityMagnitude = 5
    vector3f physics:gravityDirection = (0, 0, -1)
}
def Xform "arm" (prepend apiSchemas = ["PhysicsArticulationRootAPI"])
{
    def Xform "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 2
        float3 physics:diagonalInertia = (0.1, 0.2, 0.3)
        point3f physics:centerOfMass = (0, 0, 0.1)
        def Cube "box" (prepend apiSchemas = ["PhysicsCollisionAPI"])
        {
            double size = 0.2
        }
    }
    def Xform "link" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {
        double3 xformOp:translate = (1, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Sphere "ball" (prepend apiSchemas = ["PhysicsCollisionAPI"])
        {
            double radius = 0.1
        }
    }
    def PhysicsFixedJoint "root"
    {
        rel physics:body1 = </arm/base>
    }
    def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
    {
        rel physics:body0 = </arm/base>
        rel physics:body1 = </arm/link>
        point3f physics:localPos0 = (1, 0, 0)
        uniform token physics:axis = "Y"
        float physics:lowerLimit = -90
        float physics:upperLimit = 45
        float drive:angular:physics:stiffness = 10
        float drive:angular:physics:damping = 1
        float drive:angular:physics:maxForce = 7
        float newton:armature = 0.25
        EXTRA
    }
    MORE
}
"""


def arm(extra: str = "", more: str = "") -> str:
    return ARM.replace("EXTRA", extra).replace("MORE", more)


class WithoutNewton(unittest.TestCase):
    def test_poses_are_taken_apart(self):
        import numpy as np

        from tenon_usd.newton import poses

        turn = (0.5, -0.5, 0.5, 0.5)
        whole = np.diag([2.0, 3.0, 4.0, 1.0]) @ poses.matrix_of(((1.0, 2.0, 3.0), turn))
        (position, found), scale = poses.decompose(whole)
        self.assertTrue(np.allclose(position, (1, 2, 3)))
        self.assertAlmostEqual(abs(sum(a * b for a, b in zip(found, turn, strict=True))), 1.0)
        self.assertTrue(np.allclose(scale, (2, 3, 4)))
        pose = ((1.0, 2.0, 3.0), turn)
        self.assertTrue(poses.is_identity(poses.compose(pose, poses.inverse(pose))))

    def test_steps_of_places(self):
        import numpy as np

        from tenon_usd.newton.poses import step_matrix

        quarter = step_matrix("rotateXYZ", (90.0, 0.0, 90.0))
        self.assertTrue(np.allclose(np.array([0.0, 1.0, 0.0, 1.0]) @ quarter, (0, 0, 1, 1)))
        self.assertTrue(np.allclose(np.array([1.0, 0.0, 0.0, 1.0]) @ quarter, (0, 1, 0, 1)))
        self.assertTrue(np.allclose(step_matrix("translateY", 2.0)[3], (0, 2, 0, 1)))

    def test_faces_become_fans(self):
        import numpy as np

        from tenon_usd.newton.meshes import fan

        made = fan(np.array([4, 3], np.int32), np.array([5, 6, 7, 8, 1, 2, 3], np.int32))
        self.assertEqual(made.tolist(), [[5, 6, 7], [5, 7, 8], [1, 2, 3]])

    def test_arguments_are_those_of_newton(self):
        from tenon_usd.newton.options import options_of, stage_of

        with self.assertRaisesRegex(TypeError, "cloned_env"):
            options_of({"cloned_env": "/World"})
        with self.assertRaisesRegex(InvalidError, "joint_ordering"):
            options_of({"joint_ordering": "random"})
        with self.assertRaisesRegex(InvalidError, "override_root_xform"):
            options_of({"override_root_xform": True})
        with self.assertRaisesRegex(TypeError, "not int"):
            stage_of(3, "")
        with self.assertRaisesRegex(InvalidError, "addresses"):
            stage_of("https://evil.example/a.usda", "")

    def actuators(self, apis: str, properties: str, target: str = "/arm/hinge") -> list[object]:
        from tenon_usd.newton.actuators import read_actuators

        named = ", ".join(f'"Newton{api}"' for api in apis.split())
        applied = f"(prepend apiSchemas = [{named}])" if named else ""
        text = arm(more=f"""def NewtonActuator "motor" {applied}
    {{
        rel newton:targets = [{target and f"<{target}>"}]
        {properties}
    }}""")
        return read_actuators(tenon_usd.open("a.usda", contents={"a.usda": text}), 0.002)

    def test_actuators_become_models_of_the_package(self):
        from tenon_usd.actuators import PD, PID, Actuator, DCMotor, Delay, Saturation

        wide = {"command": "velocity", "low": -math.inf, "high": math.inf}
        for apis, properties, stages, options in (
                ("PDControlAPI MaxEffortClampingAPI",
                 "float newton:kp = 20\nfloat newton:kd = 1.5\nfloat newton:maxEffort = 5",
                 (PD(20, 1.5), Saturation(5)), {}),
                ("PDControlAPI ActuatorDelayAPI", "float newton:kp = 3\nint newton:delaySteps = 4",
                 (Delay(0.008), PD(3, 0)), {}),
                ("PDControlAPI", "float newton:kd = 2\nfloat newton:constEffort = -1",
                 (PID(0, 2, 0, bias=-1),), wide),
                ("PIDControlAPI DCMotorClampingAPI",
                 "float newton:kp = 9\nfloat newton:ki = 4\nfloat newton:integralMax = 0.5\n"
                 "float newton:saturationEffort = 8\nfloat newton:velocityLimit = 16",
                 (PID(9, 0, 4, 0.5), DCMotor(8, 16)), {}),
                ("PDControlAPI DCMotorClampingAPI",
                 "float newton:kp = 1\nfloat newton:saturationEffort = 8\n"
                 "float newton:maxMotorEffort = 6", (PD(1, 0), Saturation(6)), {}),
                ("PDControlAPI DCMotorClampingAPI MaxEffortClampingAPI", "float newton:kp = 1",
                 (PD(1, 0),), {})):
            with self.subTest(apis):
                self.assertEqual(self.actuators(apis, properties),
                                 [Actuator("/arm/hinge", *stages, **options)])

    def test_actuators_move_a_world(self):
        import numpy as np

        from tenon_usd.actuators import Actuators
        from tenon_usd.newton.actuators import read_actuators

        text = arm(more="""def NewtonActuator "motor" (
        prepend apiSchemas = ["NewtonPIDControlAPI", "NewtonMaxEffortClampingAPI"])
    {
        rel newton:targets = </arm/hinge>
        float newton:kp = 20
        float newton:kd = 1
        float newton:ki = 40
        float newton:constEffort = 3
        float newton:maxEffort = 9
    }""")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "arm.usda"
            path.write_text(text)
            world = tenon_usd.World(str(path), "mujoco", time_step=0.002)
            motors = Actuators(world, read_actuators(path, world.time_step))
        motors.set_commands(-0.4)
        motors.step(1)
        np.testing.assert_allclose(motors.efforts, 20 * -0.4 + 40 * -0.4 * 0.002 + 3, rtol=1e-6)
        motors.step(2000)
        np.testing.assert_allclose(world.joint_positions, -0.4, atol=0.01)
        np.testing.assert_allclose(motors.efforts, 0, atol=0.2)  # nothing else acts on the link

    def test_actuators_that_are_not_simulated_are_named(self):
        for apis, target, kind, told in (
                ("NeuralControlAPI", "/arm/hinge", UnsupportedError,
                 "/arm/motor: NewtonNeuralControlAPI, a neural network"),
                ("PDControlAPI PositionBasedClampingAPI", "/arm/hinge", UnsupportedError,
                 "/arm/motor: NewtonPositionBasedClampingAPI, a table"),
                ("", "/arm/hinge", InvalidError, "/arm/motor: it has no control law"),
                ("PDControlAPI PIDControlAPI", "/arm/hinge", InvalidError,
                 "/arm/motor: it has several control laws"),
                ("PDControlAPI", "", InvalidError, "newton:targets names no joint"),
                ("PDControlAPI", "/arm/root", InvalidError, "a PhysicsFixedJoint"),
                ("PDControlAPI", "/arm/none", InvalidError, "which is no prim")):
            with self.subTest(apis + target), self.assertRaisesRegex(kind, told):
                self.actuators(apis, "", target)
        with self.assertRaisesRegex(InvalidError, "/arm/motor: PD.stiffness must be finite and 0"):
            self.actuators("PDControlAPI", "float newton:kp = -1")
        with self.assertWarnsRegex(UserWarning, "names 2 joints; /arm/hinge"):
            self.actuators("PDControlAPI", "", "/arm/hinge>, </arm/root")

    def test_prims_are_read_as_by_pxr(self):
        from tenon_usd.newton.prims import Prims

        stage = tenon_usd.open("a.usda", contents={"a.usda": arm()})
        prims = Prims(stage, "/", ())
        hinge = prims["/arm/hinge"]
        self.assertEqual(hinge.GetTypeName(), "PhysicsRevoluteJoint")
        self.assertEqual(hinge.GetAttribute("newton:armature").Get(), 0.25)
        self.assertFalse(hinge.GetAttribute("newton:friction"))
        self.assertEqual(hinge.GetRelationship("physics:body1").GetTargets(), ["/arm/link"])
        self.assertTrue(hinge.HasAPI("PhysicsDriveAPI:angular"))
        self.assertEqual(hinge.GetPath().GetParentPath(), "/arm")
        self.assertEqual(prims.world("/arm/link/ball")[3].tolist(), [1, 0, 0, 1])

    def test_newton_is_asked_for(self):
        from tenon_usd.newton.options import libraries

        kept = sys.modules.get("newton")
        sys.modules["newton"] = None
        try:
            with self.assertRaisesRegex(MissingError, "pip install"):
                libraries()
        finally:
            if kept is None:
                del sys.modules["newton"]
            else:
                sys.modules["newton"] = kept


@unittest.skipUnless(HAS_NEWTON, WITHOUT)
class BesideNewton(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        warnings.simplefilter("ignore")
        import newton
        import warp

        warp.config.quiet = True
        self.newton = newton

    def both(self, path, **arguments):
        """Differences between the two importers' builders and answers."""
        sys.path.insert(0, str(support.ROOT / "tests/newton"))
        import both_importers

        from tenon_usd.newton import add_usd

        builders = self.newton.ModelBuilder(), self.newton.ModelBuilder()
        answers = (builders[0].add_usd(str(path), **arguments),
                   add_usd(builders[1], str(path), **arguments))
        found = both_importers.builders_differ(*builders)
        found.update(both_importers.answers_differ(*answers))
        return found, builders[1], answers[1]

    def test_an_arm_number_by_number(self):
        found, builder, answer = self.both(self.written("arm.usda", arm()))
        self.assertEqual(found, {})
        link, hinge = answer["path_body_map"]["/arm/link"], answer["path_joint_map"]["/arm/hinge"]
        dof = builder.joint_qd_start[hinge]
        self.assertAlmostEqual(builder.body_mass[link], 1000 * 4 / 3 * 3.141592653589793e-3, 4)
        self.assertAlmostEqual(builder.joint_target_ke[dof], 10 * 180 / 3.141592653589793, 4)
        self.assertAlmostEqual(builder.joint_limit_upper[dof], 3.141592653589793 / 4, 6)
        self.assertEqual(builder.joint_armature[dof], 0.25)
        self.assertEqual(builder.joint_effort_limit[dof], 7.0)
        self.assertAlmostEqual(float(builder.gravity[2]), -5.0)
        self.assertEqual(answer["physics_scene_path"], "/scene")
        self.assertEqual(answer["advice"], "")

    def test_arguments_do_what_they_do_there(self):
        path = self.written("arm.usda", arm())
        place = ((1.0, 2.0, 3.0), (0.0, 0.6, 0.0, 0.8))
        for arguments in (
            {"xform": place}, {"floating": True}, {"override_root_xform": True, "xform": place},
            {"collapse_fixed_joints": True}, {"bodies_follow_joint_ordering": False},
            {"ignore_paths": [".*/ball"]}, {"root_path": "/arm"}, {"joint_ordering": "bfs"},
            {"enable_self_collisions": False}, {"joint_drive_gains_scaling": 3.0},
        ):
            with self.subTest(arguments):
                self.assertEqual(self.both(path, **arguments)[0], {})

    def test_what_is_not_imported_is_named(self):
        from tenon_usd.newton import add_usd

        for more, words in (
            ('def TetMesh "soft" {\n}', "/arm/soft: a soft body"),
            ('def NewtonActuator "motor" {\n}', "/arm/motor: an actuator"),
            ('def Mesh "cloth" (prepend apiSchemas = ["PhysicsSurfaceDeformableSimAPI"]) {\n}',
             "/arm/cloth: a cloth"),
            ('def Points "balls" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {\n'
             "    point3f[] points = [(0, 0, 0)]\n    float[] widths = [1]\n}",
             "/arm/balls: a collider that is Points"),
        ):
            with self.subTest(words), self.assertRaisesRegex(UnsupportedError, words):
                add_usd(self.newton.ModelBuilder(), str(self.written("more.usda", arm("", more))))

    def test_what_newton_cannot_hold_is_told(self):
        from tenon_usd.newton import ImportedWarning, add_usd

        path = self.written("breaks.usda", arm("float physics:breakForce = 10"))
        with self.assertWarnsRegex(ImportedWarning, "/arm/hinge: physics:breakForce"):
            add_usd(self.newton.ModelBuilder(), str(path))
        path = self.written("fast.usda", arm(
            'uniform token drive:angular:physics:type = "acceleration"'))
        with self.assertWarnsRegex(ImportedWarning, "/arm/hinge: an acceleration drive"):
            add_usd(self.newton.ModelBuilder(), str(path))

    def test_units_are_those_of_the_stage_or_none(self):
        from tenon_usd.newton import ImportedWarning, add_usd

        path = self.written("inches.usda", arm().replace("metersPerUnit = 1", ""))
        lengths = []
        with self.assertWarnsRegex(ImportedWarning, 'units="newton"'):
            for units in ("stage", "newton"):
                builder = self.newton.ModelBuilder()
                answer = add_usd(builder, str(path), units=units)
                lengths.append(float(builder.body_q[answer["path_body_map"]["/arm/link"]][0]))
        self.assertAlmostEqual(lengths[0], 0.01)
        self.assertEqual(lengths[1], 1.0)

    def test_findings_on_what_is_imported_are_told(self):
        from tenon_usd.newton import ImportedWarning, add_usd

        text = arm().replace("float physics:mass = 2", "float physics:mass = inf")
        with self.assertWarnsRegex(ImportedWarning, "/arm/base: .*mass"):
            add_usd(self.newton.ModelBuilder(), str(self.written("light.usda", text)))

    def test_a_shell_gives_no_part_of_a_mass(self):
        from tenon_usd.newton import add_usd

        text = arm().replace("double size = 0.2",
                             'double size = 0.2\n            token newton:massModel = "shell"')
        add_usd(self.newton.ModelBuilder(), str(self.written("whole.usda", text)))
        text = text.replace("float3 physics:diagonalInertia = (0.1, 0.2, 0.3)", "")
        with self.assertRaisesRegex(UnsupportedError, "/arm/base/box: a shell"):
            add_usd(self.newton.ModelBuilder(), str(self.written("part.usda", text)))

    def test_a_density_that_is_not_of_usd_physics(self):
        from tenon_usd.newton import add_usd

        text = arm().replace("float3 physics:diagonalInertia = (0.1, 0.2, 0.3)", "")
        text = text.replace("float physics:mass = 2", "")
        builder = self.newton.ModelBuilder()
        builder.default_shape_cfg.density = 500.0
        with self.assertRaisesRegex(UnsupportedError, "/arm/base: its mass needs a density"):
            add_usd(builder, str(self.written("dense.usda", text)))

    def test_the_hand_in_many_environments(self):
        from tenon_usd.newton import add_usd

        hand = self.newton.ModelBuilder()
        answer = add_usd(hand, str(support.HAND))
        self.assertEqual(answer["physics_variants"], {"/inspire_hand": "physics"})
        scene = self.newton.ModelBuilder()
        scene.replicate(hand, 64)
        model = scene.finalize(device="cpu")
        self.assertEqual(model.world_count, 64)
        self.assertEqual(model.body_count, 64 * hand.body_count)
        leaders = [leader for leader in hand.joint_mimic_joint if leader >= 0]
        self.assertEqual(len(leaders), 6)
        self.assertTrue(all(hand.joint_mimic_joint[leader] < 0 for leader in leaders))

    def test_a_stage_of_this_package_and_one_of_pxr(self):
        from tenon_usd.newton import add_usd

        path = str(self.written("arm.usda", arm()))
        masses = []
        stages = [tenon_usd.open(path)]
        if importlib.util.find_spec("pxr") is not None:
            from pxr import Usd

            stages.append(Usd.Stage.Open(path))
        for stage in stages:
            builder = self.newton.ModelBuilder()
            add_usd(builder, stage)
            masses.append(list(builder.body_mass))
        self.assertTrue(all(each == masses[0] for each in masses))

    def test_without_pxr(self):
        path = self.written("arm.usda", arm())
        done = subprocess.run(
            [sys.executable, "-B", "-W", "ignore", "-c",
             "import sys; sys.modules['pxr'] = None\nimport newton\n"
             "from tenon_usd.newton import add_usd\nbuilder = newton.ModelBuilder()\n"
             f"add_usd(builder, {str(path)!r})\n"
             "assert builder.finalize(device='cpu').body_count == 2\n"
             "assert sys.modules['pxr'] is None"],
            capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr[-2000:])

    def test_the_page(self):
        self.copied_hand()
        text = PAGE.read_text(encoding="utf-8")
        snippets = SNIPPET.findall(text)
        self.assertGreaterEqual(len(snippets), 3)
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            names: dict[str, object] = {}
            for snippet in snippets:
                exec(compile(snippet, str(PAGE), "exec"), names)  # the page's own
        finally:
            os.chdir(before)


def found_python():
    """Python of an environment of the judge that has Newton, or None."""
    for made in sorted(CACHE.glob("tenon-judge/beside_newton-*/made")):
        python = made.parent / "bin/python"
        done = subprocess.run([python, "-c", "import sys; print(*sys.version_info[:2])"],
                              capture_output=True, text=True, check=False)
        if done.stdout.split() == [str(number) for number in sys.version_info[:2]]:
            return python
    return None


def run_there(python):
    """The script in another Python, with this package alone of what is installed here."""
    package = Path(tenon_usd.__file__).parent
    with tempfile.TemporaryDirectory(prefix="tenon-newton-") as folder:
        for each in package.parent.glob("tenon_usd*"):
            if each.is_dir():
                (Path(folder) / each.name).symlink_to(each)
        environment = {**os.environ, "PYTHONPATH": folder, FOUND: "1",
                       "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME") or str(CACHE)}
        return subprocess.run([python, "-B", __file__], env=environment, check=False).returncode


if __name__ == "__main__":
    there = None if HAS_NEWTON or os.environ.get(FOUND) else found_python()
    if there is not None:
        sys.exit(run_there(there))
    if not HAS_NEWTON:
        print(f"skipped beside Newton: {WITHOUT}")
    support.main()
