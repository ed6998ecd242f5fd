# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The neutral description: classes, views, and the same numbers as the program prints."""

import gc
import json
import math
import unittest

import numpy as np
import support

import tenon_usd as tenon
from tenon_usd import _tenon


class Scene(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.scene = tenon.physics(support.HAND)

    def test_objects_and_columns_agree(self):
        bodies = self.scene.bodies
        masses = bodies.column("mass")
        self.assertEqual(masses.shape, (len(bodies),))
        self.assertEqual([body.mass for body in bodies], masses.tolist())
        self.assertEqual(bodies.column("position").shape, (len(bodies), 3))
        self.assertEqual(bodies.column("inertia").shape, (len(bodies), 3, 3))
        self.assertEqual(bodies.column("path"), [body.path for body in bodies])
        np.testing.assert_array_equal(bodies[-1].inertia, bodies.column("inertia")[-1])
        with self.assertRaises(IndexError):
            bodies[len(bodies)]
        with self.assertRaises(KeyError):
            bodies.column("nothing")

    def test_every_field_of_every_object_reads_as_json_has_it(self):
        answer = json.loads(self.scene.json())
        for name in ("scenes", "bodies", "colliders", "materials", "joints", "articulations"):
            objects, rows = getattr(self.scene, name), answer[name]
            self.assertEqual(len(objects), len(rows), name)
            for one, row in zip(objects, rows):
                for field in type(one).FIELDS:
                    getattr(one, field)
                self.assertEqual(one.path, row["path"] or "")
        body, row = self.scene.bodies[0], answer["bodies"][0]
        self.assertEqual(body.mass, row["mass"])
        self.assertEqual(body.position.tolist(), row["position"])
        self.assertEqual(body.orientation.tolist(), row["orientation"])
        self.assertEqual(body.inertia.reshape(9).tolist(), row["inertia"])
        driven = [i for i, joint in enumerate(self.scene.joints) if len(joint.drives)]
        self.assertTrue(driven)
        for i in driven:
            joint, row = self.scene.joints[i], answer["joints"][i]
            self.assertEqual((joint.type, joint.upper), (row["type"], row["upper"]))
            self.assertEqual(joint.drives[0].stiffness, row["drives"][0]["stiffness"])

    def test_views_copy_nothing_and_keep_the_scene(self):
        masses = self.scene.bodies.column("mass")
        body = self.scene.bodies[0]
        points = self.scene.meshes[0].points
        path, total, first = body.path, masses.sum(), points[0].copy()
        self.scene = None
        gc.collect()
        self.assertFalse(masses.flags.owndata or masses.flags.writeable)
        self.assertFalse(points.flags.owndata or points.flags.writeable)
        self.assertEqual((body.path, masses.sum()), (path, total))
        np.testing.assert_array_equal(points[0], first)
        with self.assertRaises(ValueError):
            masses[0] = 1

    def test_json_goes_both_ways(self):
        text = self.scene.json(geometry=True)
        self.assertEqual(_tenon.PhysicsScene.from_json(text).json(geometry=True), text)
        with self.assertRaises(tenon.ParseError):
            _tenon.PhysicsScene.from_json("{")

    def test_a_property_refuses_other_objects(self):
        with self.assertRaises(TypeError):
            _tenon.Body.mass.__get__(self.scene.joints[0], _tenon.Joint)
        with self.assertRaises(TypeError):
            _tenon.Body()

    def test_what_is_unlimited_is_infinite(self):
        scene = tenon.physics(support.SCENES / "box_on_box.usda")
        self.assertTrue(all(math.isinf(joint.break_force) for joint in scene.joints))
        self.assertIsInstance(scene.may_collide(0, 0), bool)
        with self.assertRaises(IndexError):
            scene.may_collide(0, 10**6)


if __name__ == "__main__":
    support.main()
