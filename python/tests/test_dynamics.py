# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Multibody algebra of scenes: closed forms, the program's numbers, what is refused, threads."""

import gc
import json
import os
import subprocess
import sys
import sysconfig
import threading

import numpy as np
import support

import tenon_usd as tenon

PROGRAM = os.path.join(sysconfig.get_path("scripts"), "tenon")
G = 9.81
HEAD = '#usda 1.0\n(\n    defaultPrim = "W"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
KINDS = {"revolute": "PhysicsRevoluteJoint", "prismatic": "PhysicsPrismaticJoint",
         "spherical": "PhysicsSphericalJoint"}


def body(name, mass, inertia, place=(0, 0, 0), center=(0, 0, 0), parent=""):
    """Text of a body; numbers that float32 has as they are."""
    text = f'''    def Xform "{name}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {{
        double3 xformOp:translate = {place}
        uniform token[] xformOpOrder = ["xformOp:translate"]
        float physics:mass = {mass}
        point3f physics:centerOfMass = {center}
        float3 physics:diagonalInertia = {inertia}
    }}
'''
    return f'    def Scope "{parent}"\n    {{\n{text}    }}\n' if parent else text


def joint(name, kind, axis, body1, body0=None, place0=(0, 0, 0), place1=(0, 0, 0), more="",
          schemas=()):
    """Text of a joint; `place0` is in body0, or in the world."""
    return f'''    def {KINDS[kind]} "{name}" (
        apiSchemas = {json.dumps(list(schemas))}
    )
    {{
        rel physics:body1 = </W/{body1}>
        {f"rel physics:body0 = </W/{body0}>" if body0 else ""}
        point3f physics:localPos0 = {place0}
        point3f physics:localPos1 = {place1}
        uniform token physics:axis = "{axis}"
        {more}
    }}
'''


def scene_of(*parts):
    text = HEAD + 'def Xform "W"\n{\n' + "".join(parts) + "}\n"
    return tenon.physics("scene.usda", contents={"scene.usda": text})


M1, M2, L1, L2, I1, I2 = 1.5, 0.75, 0.5, 0.25, 0.125, 0.0625


def double_pendulum():
    """Two rods along x that turn about y, the first at the origin of the world; the centre of the
    first is where the second begins."""
    return scene_of(body("arm", M1, (I1, I1, I1), center=(L1, 0, 0)),
                    body("fore", M2, (I2, I2, I2), (L1, 0, 0), (L2, 0, 0)),
                    joint("first", "revolute", "Y", "arm"),
                    joint("second", "revolute", "Y", "fore", "arm", (L1, 0, 0)))


class ClosedForms(support.FilesTestCase):
    def test_a_double_pendulum_has_the_textbook_numbers(self):
        pendulum = tenon.Dynamics(double_pendulum())
        self.assertEqual([(c.joint, c.body, c.dof, c.part) for c in pendulum.coordinates],
                         [("/W/first", "/W/arm", "rotY", 0),
                          ("/W/second", "/W/fore", "rotY", 0)])
        speeds = np.array([1.25, -0.5])
        for q1, q2 in ((0.0, 0.0), (0.3, 0.8), (-1.2, -2.1)):
            at = pendulum.moved({"first": q1, "/W/second": q2})
            m22 = I2 + M2 * L2 ** 2
            m12 = m22 + M2 * L1 * L2 * np.cos(q2)
            m11 = I1 + (M1 + M2) * L1 ** 2 + m22 + 2 * M2 * L1 * L2 * np.cos(q2)
            np.testing.assert_allclose(at.mass_matrix(), [[m11, m12], [m12, m22]], atol=1e-14)
            held, free = at.effective_inertia()
            np.testing.assert_allclose(held, [m11, m22], atol=1e-13)
            np.testing.assert_allclose(free, [m11 - m12 ** 2 / m22, m22 - m12 ** 2 / m11],
                                       atol=1e-13)
            # Y turns from z to x: at angle q a rod points to (cos q, -sin q) in x and z.
            outer = M2 * G * L2 * np.cos(q1 + q2)
            gravity = at.gravity_forces()
            np.testing.assert_allclose(
                gravity, [outer + (M1 + M2) * G * L1 * np.cos(q1), outer], atol=1e-13)
            np.testing.assert_allclose(at.along_held(gravity), gravity, atol=1e-13)
            h = M2 * L1 * L2 * np.sin(q2)
            np.testing.assert_allclose(
                at.bias_forces(speeds),
                [-h * (2 * speeds[0] * speeds[1] + speeds[1] ** 2), h * speeds[0] ** 2], atol=1e-13)
            tip = at.body_positions[1]
            np.testing.assert_allclose(tip, [L1 * np.cos(q1), 0, -L1 * np.sin(q1)], atol=1e-14)
            half = (q1 + q2) / 2
            turned = at.body_orientations[1]
            np.testing.assert_allclose(turned * np.sign(turned[0]),
                                       np.array([np.cos(half), 0, np.sin(half), 0])
                                       * np.sign(np.cos(half)), atol=1e-14)
            np.testing.assert_allclose(at.positions, [q1, q2], atol=0)
            outermost = tip + L2 * np.array([np.cos(q1 + q2), 0, -np.sin(q1 + q2)])
            # omega = y, so that omega x (outermost) = (z, 0, -x).
            wanted = np.array([[outermost[2], 0, -outermost[0], 0, 1, 0],
                               [outermost[2] - tip[2], 0, tip[0] - outermost[0], 0, 1, 0]]).T
            np.testing.assert_allclose(at.jacobian("fore"), wanted, atol=1e-14)
            np.testing.assert_allclose(at.jacobian("/W/fore", outermost), wanted, atol=1e-14)
            np.testing.assert_allclose(at.jacobian(np.int64(1), list(outermost)), wanted,
                                       atol=1e-14)
            np.testing.assert_array_equal(at.jacobian(0)[:, 1], 0)
            np.testing.assert_allclose(
                at.center_of_mass, (M1 * tip + M2 * outermost) / (M1 + M2), atol=1e-14)
        self.assertEqual((pendulum.mass, pendulum.loop_gap), (M1 + M2, 0.0))

    def test_gravity_and_bias_are_slopes_of_energies(self):
        scene = double_pendulum()
        q, v, h = np.array([0.4, -0.9]), np.array([0.7, 1.1]), 1e-5

        def at(joints):
            return tenon.Dynamics(scene, dict(zip(("first", "second"), joints)))

        def height(joints):
            return (M1 + M2) * G * at(joints).center_of_mass[2]

        def slope(function, k):
            step = h * np.eye(2)[k]
            return (function(q + step) - function(q - step)) / (2 * h)

        now = at(q)
        np.testing.assert_allclose(now.gravity_forces(), [-slope(height, k) for k in (0, 1)],
                                   atol=1e-8)
        slopes = np.array([slope(lambda joints: at(joints).mass_matrix(), k) for k in (0, 1)])
        lagrange = np.einsum("kij,j,k->i", slopes, v, v) - np.einsum("ijk,j,k->i", slopes, v, v) / 2
        np.testing.assert_allclose(now.bias_forces(v), lagrange, atol=1e-8)

    def test_two_floating_bodies_share_the_inertia(self):
        a, b = body("a", 2, (0.125, 0.25, 0.375)), body("b", 3, (0.5, 0.625, 0.75))
        turning = tenon.Dynamics(scene_of(a, b, joint("j", "revolute", "Z", "b", "a")))
        held, free = turning.effective_inertia()
        at = turning.coordinate("j")
        self.assertEqual((held.shape, turning.coordinates[at].dof), ((7,), "rotZ"))
        self.assertAlmostEqual(held[at], 0.375 * 0.75 / 1.125, delta=1e-14)
        self.assertAlmostEqual(free[at], 0.375 * 0.75 / 1.125, delta=1e-14)
        floating = [i for i, c in enumerate(turning.coordinates) if c.joint is None]
        self.assertEqual([turning.coordinates[i].dof for i in floating],
                         ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"])
        self.assertEqual([turning.coordinates[i].part for i in floating], list(range(6)))
        np.testing.assert_array_equal(np.isnan(turning.positions), np.isin(range(7), floating))
        slide = tenon.Dynamics(scene_of(a, b, joint("j", "prismatic", "Z", "b", "a")))
        at = slide.coordinate("/W/j")
        self.assertAlmostEqual(slide.effective_inertia()[0][at], 2 * 3 / 5, delta=1e-14)
        weight = slide.along_held(slide.gravity_forces())
        self.assertAlmostEqual(abs(weight[at]), 3 * G, delta=1e-12)
        np.testing.assert_allclose(slide.gravity_forces()[floating], [0, 0, -5 * G, 0, 0, 0],
                                   atol=1e-12)

    def test_followers_move_along(self):
        follows = "rel newton:mimicJoint = </W/lead>\n        float newton:mimicCoef1 = -2"
        scene = scene_of(body("a", 1, (0.25, 0.25, 0.25)), body("b", 1, (0.5, 0.5, 0.5), (1, 0, 0)),
                         joint("lead", "revolute", "Z", "a"),
                         joint("follow", "revolute", "Z", "b", place0=(1, 0, 0), more=follows,
                               schemas=["NewtonMimicAPI"]))
        pair = tenon.Dynamics(scene, {"lead": 0.3})
        lead, follow = pair.coordinate("lead"), pair.coordinate("follow")
        self.assertAlmostEqual(pair.positions[follow], -0.6, delta=1e-15)
        held, _ = pair.effective_inertia()
        self.assertAlmostEqual(held[lead], 0.25 + 4 * 0.5, delta=1e-13)
        self.assertAlmostEqual(held[follow], 0.25 / 4 + 0.5, delta=1e-13)
        forces = np.zeros(2)
        forces[[lead, follow]] = 1.5, 0.25
        self.assertAlmostEqual(pair.along_held(forces)[lead], 1.5 - 2 * 0.25, delta=1e-13)
        self.assertEqual(np.count_nonzero(pair.mass_matrix()), 2)  # of the trees alone
        with self.assertRaises(tenon.InvalidError) as caught:
            tenon.Dynamics(scene, {"follow": 1})
        self.assertEqual(caught.exception.rule, "pose.bad-value")
        self.assertIn("/W/lead", caught.exception.fix)

    def test_a_loop_closes_at_every_pose(self):
        loop = scene_of(
            body("left", 1, (0.02, 0.03125, 0.02), center=(0, 0, 0.125)),
            body("right", 1, (0.02, 0.03125, 0.02), (1, 0, 0), (0, 0, 0.125)),
            body("coupler", 3, (0.5, 0.5, 0.5), (0, 0, 0.25), (0.5, 0, 0)),
            joint("drive", "revolute", "Y", "left", schemas=["PhysicsDriveAPI:angular"],
                  more="float drive:angular:physics:stiffness = 1"),
            joint("other", "revolute", "Y", "right", place0=(1, 0, 0)),
            joint("top", "revolute", "Y", "coupler", "left", (0, 0, 0.25)),
            joint("closing", "revolute", "Y", "coupler", "right", (0, 0, 0.25), (1, 0, 0)))
        moved = tenon.Dynamics(loop).moved("drive=0.5rad")
        self.assertEqual(len(moved.coordinates), 3)
        self.assertLess(moved.loop_gap, 1e-12)
        at = moved.coordinate("drive")
        self.assertAlmostEqual(moved.positions[at], 0.5, delta=1e-6)
        self.assertAlmostEqual(moved.positions[moved.coordinate("other")], 0.5, delta=1e-6)
        # The coupler does not turn: it counts as a point at the end of the cranks.
        wanted = 2 * (0.03125 + 0.125 ** 2) + 3 * 0.25 ** 2
        self.assertAlmostEqual(moved.effective_inertia()[0][at], wanted, delta=1e-9)
        (closing,) = {one.path for one in loop.joints} - {c.joint for c in moved.coordinates}
        with self.assertRaises(tenon.NotFoundError) as caught:
            moved.coordinate(closing)
        self.assertIn("closes a loop", str(caught.exception))
        self.assertEqual(caught.exception.prim, closing)

    def test_a_ball_has_three_coordinates(self):
        ball = tenon.Dynamics(scene_of(body("a", 1, (0.25, 0.5, 0.75)),
                                       joint("b", "spherical", "X", "a")))
        self.assertEqual([c.dof for c in ball.coordinates], ["rotX", "rotY", "rotZ"])
        self.assertEqual(ball.coordinate("b", "rotY"), 1)
        self.assertEqual(ball.coordinate("/W/b:rotZ"), 2)
        np.testing.assert_allclose(ball.mass_matrix(), np.diag([0.25, 0.5, 0.75]), atol=1e-14)
        np.testing.assert_array_equal(ball.positions, 0)
        for pose in ({"b": 1}, {"b:rotX": 1}):
            with self.assertRaises(tenon.InvalidError):
                tenon.Dynamics(ball.scene, pose)


class Hand(support.FilesTestCase):
    def test_it_agrees_with_the_program(self):
        for pose in ("", "right_thumb_1_joint=20deg,right_index_.*=0.25rad"):
            words = [PROGRAM, "inertia", support.HAND, "--json", "--matrix"]
            words += ["--pose", pose] if pose else []
            own = {name: value for name, value in os.environ.items()
                   if name not in ("LD_PRELOAD", "PYTHONPATH")}  # of python/tests/sanitized.sh
            done = subprocess.run(words, capture_output=True, text=True, env=own)
            self.assertEqual(done.returncode, 0, done.stderr)
            answer = json.loads(done.stdout)
            hand = tenon.Dynamics(tenon.physics(support.HAND), pose or None)
            held, free = hand.effective_inertia()
            columns = {"position": hand.positions, "held": held, "free": free,
                       "gravity": hand.gravity_forces()}
            rows = answer["coordinates"]
            self.assertEqual([(row["joint"], row["body"], row["dof"]) for row in rows],
                             [(c.joint, c.body, c.dof) for c in hand.coordinates])
            self.assertEqual(len(rows), 12)
            for name, values in columns.items():
                wanted = [np.nan if row[name] is None else row[name] for row in rows]
                np.testing.assert_allclose(values, wanted, 1e-12, 1e-18, err_msg=name)
            np.testing.assert_allclose(hand.mass_matrix(), answer["massMatrix"], 1e-12, 1e-18)
            np.testing.assert_allclose(hand.center_of_mass, answer["centerOfMass"], 1e-12)
            self.assertEqual((hand.mass, hand.loop_gap), (answer["mass"], answer["loopGap"]))
        self.assertGreater(np.abs(hand.positions).max(), 0.3)

    def test_shapes_and_types(self):
        hand = tenon.Dynamics(tenon.open(support.HAND).physics())
        n, bodies = len(hand.coordinates), len(hand.scene.bodies)
        self.assertEqual((n, bodies), (12, 13))
        arrays = {
            (n,): [hand.positions, hand.gravity_forces(), hand.bias_forces(1),
                   *hand.effective_inertia(), hand.along_held(np.zeros(n, dtype=np.int32))],
            (n, n): [hand.mass_matrix()], (6, n): [hand.jacobian(0), hand.jacobian(-1, (0, 0, 0))],
            (3,): [hand.center_of_mass], (bodies, 3): [hand.body_positions],
            (bodies, 4): [hand.body_orientations]}
        for shape, found in arrays.items():
            for array in found:
                self.assertEqual((array.shape, array.dtype), (shape, np.float64))
                self.assertTrue(array.flags.writeable and array.flags.c_contiguous)
        np.testing.assert_array_equal(hand.jacobian(-1), hand.jacobian(bodies - 1))
        # Where joints, of float32, hold the bodies.
        np.testing.assert_allclose(hand.body_positions, hand.scene.bodies.column("position"),
                                   rtol=0, atol=1e-6)
        hand.positions[:] = 7  # a copy
        self.assertLess(np.abs(hand.positions).max(), 7)
        self.assertEqual((type(hand.mass), type(hand.loop_gap)), (float, float))
        self.assertIn("12 coordinates", repr(hand))

    def test_the_scene_of_a_world(self):
        world = tenon.World(support.HAND)
        np.testing.assert_array_equal(tenon.Dynamics(world.scene).mass_matrix(),
                                      tenon.Dynamics(tenon.physics(support.HAND)).mass_matrix())

    def test_poses_count_from_the_start(self):
        start = tenon.Dynamics(tenon.physics(support.HAND))
        name = "right_thumb_1_joint"
        at = start.coordinate(name)
        moved = start.moved({name: np.float32(0.25)})
        self.assertEqual(moved.positions[at], 0.25)
        self.assertGreater(abs(moved.mass_matrix() - start.mass_matrix()).max(), 0)
        self.assertNotEqual(start.positions[at], 0.25)
        for pose in (None, {}):
            np.testing.assert_array_equal(moved.moved(pose).positions, start.positions)
        np.testing.assert_array_equal(moved.moved(f"{name}=0.25rad").positions, moved.positions)

    def test_a_scene_in_which_nothing_moves(self):
        still = tenon.Dynamics(scene_of())
        self.assertEqual((still.coordinates, still.mass), ([], 0.0))
        self.assertEqual(still.mass_matrix().shape, (0, 0))
        self.assertEqual(still.bias_forces([]).shape, (0,))
        self.assertEqual(still.body_orientations.shape, (0, 4))
        with self.assertRaises(IndexError):
            still.jacobian(0)

    def test_a_matrix_has_a_limit_that_inertias_have_not(self):
        many = tenon.Dynamics(scene_of(*(body(f"b{i}", 2, (1, 1, 1), (i, 0, 0))
                                         for i in range(167))))
        held, free = many.effective_inertia()
        np.testing.assert_allclose(held.reshape(167, 6), np.tile([2, 2, 2, 1, 1, 1], (167, 1)))
        np.testing.assert_array_equal(held, free)
        with self.assertRaises(tenon.LimitError) as caught:
            many.mass_matrix()
        self.assertEqual(caught.exception.rule, "limit.dense-coordinates")


class Refused(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.scene = double_pendulum()
        self.dynamics = tenon.Dynamics(self.scene)

    def test_names(self):
        for call in (lambda: self.dynamics.coordinate("secnd"),
                     lambda: tenon.Dynamics(self.scene, {"secnd": 1}),
                     lambda: tenon.Dynamics(self.scene, "secnd=1")):
            with self.assertRaises(tenon.NotFoundError) as caught:
                call()
            self.assertIsInstance(caught.exception, LookupError)
            self.assertEqual(caught.exception.fix, "did you mean second?")
            self.assertEqual(len(caught.exception.diagnostics), 1)
        with self.assertRaises(tenon.NotFoundError) as caught:
            self.dynamics.jacobian("/W/fire")
        self.assertEqual((caught.exception.rule, caught.exception.fix),
                         ("dynamics.no-body", "did you mean /W/fore?"))
        with self.assertRaises(tenon.NotFoundError) as caught:
            self.dynamics.coordinate("first", "rotX")
        self.assertEqual((caught.exception.prim, caught.exception.fix), ("/W/first", "it has rotY"))
        with self.assertRaises(IndexError):
            self.dynamics.jacobian(2)
        with self.assertRaises(IndexError):
            self.dynamics.jacobian(-3)

    def test_names_of_several(self):
        scene = scene_of(body("a", 1, (1, 1, 1), parent="one"), body("a", 1, (1, 1, 1),
                                                                      parent="two"),
                         joint("b", "spherical", "X", "one/a"))
        several = tenon.Dynamics(scene)
        with self.assertRaises(tenon.InvalidError) as caught:
            several.jacobian("a")
        self.assertIn("/W/one/a, /W/two/a, or its index", caught.exception.fix)
        np.testing.assert_array_equal(several.jacobian("/W/two/a"), several.jacobian(1))
        with self.assertRaises(tenon.InvalidError) as caught:
            several.coordinate("b")
        self.assertIn("rotX, rotY, rotZ", str(caught.exception))

    def test_numbers(self):
        for wrong in (np.nan, np.inf, -np.inf):
            calls = {"velocities": lambda: self.dynamics.bias_forces([0, wrong]),
                     "forces": lambda: self.dynamics.along_held(wrong),
                     "point": lambda: self.dynamics.jacobian(0, (0, wrong, 0)),
                     "/W/first": lambda: self.dynamics.moved({"first": wrong}),
                     "number": lambda: tenon.Dynamics(self.scene, f"first={wrong}rad")}
            for word, call in calls.items():
                with self.assertRaises(tenon.InvalidError) as caught:
                    call()
                self.assertIn(word, str(caught.exception))
                self.assertTrue(caught.exception.rule)
        with self.assertRaises(ValueError):
            self.dynamics.bias_forces([1, 2, 3])
        with self.assertRaises(ValueError):
            self.dynamics.jacobian(0, (1, 2))
        slide = scene_of(body("a", 1, (1, 1, 1)), body("b", 1, (1, 1, 1)),
                         joint("s", "prismatic", "X", "a"), joint("t", "prismatic", "X", "b", "a"))
        with self.assertRaises(tenon.InvalidError) as caught:
            tenon.Dynamics(slide, {"s": 1.5e308, "t": 1.5e308})
        self.assertEqual((caught.exception.rule, caught.exception.prim), ("pose.bad-value", "/W/b"))

    def test_messages_name_the_argument_and_its_shape(self):
        for call, kind, told in (
                (lambda: self.dynamics.bias_forces([1, 2, 3]), ValueError,
                 r"velocities has the shape \(3,\); expected \(2,\)"),
                (lambda: self.dynamics.along_held("far"), TypeError, "forces is an array"),
                (lambda: self.dynamics.jacobian(0, [1, 2]), ValueError,
                 r"point has the shape \(2,\)"),
                (lambda: self.dynamics.jacobian(1.5), TypeError, "body is .*, not 1.5")):
            with self.assertRaisesRegex(kind, told):
                call()

    def test_types(self):
        for arguments in ((support.HAND,), (None,), (tenon.open(support.HAND),),
                          (self.scene, 1), (self.scene, ["first=1"]), (self.scene, {1: 2}),
                          (self.scene, {"first": "20deg"}), (self.scene, {"first": None})):
            with self.assertRaises(TypeError):
                tenon.Dynamics(*arguments)
        with self.assertRaises(TypeError):
            tenon.Dynamics(self.scene, poses=None)
        with self.assertRaises(TypeError):
            self.dynamics.jacobian(1.5)
        with self.assertRaises(TypeError):
            self.dynamics.coordinate(0)
        with self.assertRaises(AttributeError):
            self.dynamics.mass = 1


class Sharing(support.FilesTestCase):
    def test_the_scene_is_kept_and_let_go(self):
        scene = tenon.physics(support.HAND)
        before = sys.getrefcount(scene)
        hand = tenon.Dynamics(scene, {"right_thumb_1_joint": 0.2})
        matrix = hand.mass_matrix()
        moved = hand.moved(None)
        self.assertIs(moved.scene, scene)
        self.assertGreater(sys.getrefcount(scene), before)
        del hand, moved
        gc.collect()
        self.assertEqual(sys.getrefcount(scene), before)
        moved = tenon.Dynamics(scene).moved({"right_thumb_1_joint": 0.2})
        del scene
        gc.collect()
        filler = [np.ones(1000) for _ in range(1000)]  # over what would have been freed
        np.testing.assert_array_equal(moved.mass_matrix(), matrix)
        np.testing.assert_array_equal(moved.moved({"right_thumb_1_joint": 0.2}).mass_matrix(),
                                      matrix)
        self.assertEqual((len(moved.scene.bodies), len(filler)), (13, 1000))

    def test_threads_share_one(self):
        hand = tenon.Dynamics(tenon.physics(support.HAND))
        forces, speeds = np.arange(12.0), np.linspace(-1, 1, 12)

        def numbers():
            return [*hand.effective_inertia(), hand.along_held(forces), hand.bias_forces(speeds),
                    hand.mass_matrix(), hand.jacobian(7),
                    hand.moved("right_thumb_1_joint=10deg").gravity_forces()]

        wanted, failures = numbers(), []

        def ask():
            try:
                for _ in range(40):
                    for found, one in zip(numbers(), wanted, strict=True):
                        np.testing.assert_array_equal(found, one)
            except BaseException as failure:
                failures.append(failure)

        threads = [threading.Thread(target=ask) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])


if __name__ == "__main__":
    support.main()
