#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Physics that cannot be: each gets its diagnostic, and reading and simulating go on or end in an
error, never in a crash.

    test_bad_physics.py TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TENON = sys.argv[1]
HEAD = '#usda 1.0\n(\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
SCENE = 'def PhysicsScene "Scene"\n{\n}\n'
BODY = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
DEPTH = 1_000_000

# name: (type, APIs, properties, rules that must be found)
SHAPES = {
    "mass NaN": ("Cube", BODY, "float physics:mass = nan", ["attribute.not-a-number"]),
    "mass infinite": ("Cube", BODY, "float physics:mass = inf", ["mass.infinite"]),
    "mass of another type": ("Cube", BODY, "double physics:mass = 3", ["attribute.wrong-type"]),
    "mass a string": ("Cube", BODY, 'string physics:mass = "3"', ["attribute.wrong-type"]),
    "density infinite": ("Cube", BODY, "float physics:density = inf", ["mass.infinite"]),
    "inertia negative": ("Cube", BODY, "float3 physics:diagonalInertia = (1, -1, 1)",
                         ["mass.inertia-negative"]),
    "inertia NaN": ("Cube", BODY, "float3 physics:diagonalInertia = (1, nan, 1)",
                    ["attribute.not-a-number"]),
    "velocity NaN": ("Cube", BODY, "vector3f physics:velocity = (nan, 0, 0)",
                     ["attribute.not-a-number"]),
    "size NaN": ("Cube", BODY, "double size = nan", ["attribute.not-a-number"]),
    "radius infinite": ("Sphere", BODY, "double radius = inf", ["collider.not-finite"]),
    "place NaN": ("Cube", BODY, "double3 xformOp:translate = (nan, 0, 0)\n"
                  'uniform token[] xformOpOrder = ["xformOp:translate"]', ["body.not-finite"]),
    "scale zero": ("Cube", BODY, "float3 xformOp:scale = (1, 0, 1)\n"
                   'uniform token[] xformOpOrder = ["xformOp:scale"]', ["collider.zero-scale"]),
    "mesh empty": ("Mesh", BODY, "", ["collider.mesh-invalid"]),
    "mesh without faces": ("Mesh", BODY, "point3f[] points = [(0,0,0),(1,0,0),(0,1,0)]",
                           ["collider.mesh-invalid"]),
    "mesh index out of range": (
        "Mesh", BODY, "point3f[] points = [(0,0,0),(1,0,0),(0,1,0)]\n"
        "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 7]",
        ["collider.mesh-invalid"]),
    "mesh index negative": (
        "Mesh", BODY, "point3f[] points = [(0,0,0),(1,0,0),(0,1,0)]\n"
        "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, -2]",
        ["collider.mesh-invalid"]),
    "mesh counts too large": (
        "Mesh", BODY, "point3f[] points = [(0,0,0),(1,0,0),(0,1,0)]\n"
        "int[] faceVertexCounts = [2000000000]\nint[] faceVertexIndices = [0, 1, 2]",
        ["collider.mesh-invalid"]),
    "mesh points NaN": (
        "Mesh", BODY, "point3f[] points = [(0,0,nan),(1,0,0),(0,1,0)]\n"
        "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]",
        ["collider.not-finite"]),
    **{f"mesh points NaN, {kind}": (
        "Mesh", BODY + ["PhysicsMeshCollisionAPI"],
        "point3f[] points = [(0,0,nan),(1,0,0),(0,1,0),(0,0,1),(1,inf,1)]\n"
        "int[] faceVertexCounts = [3,3,3]\nint[] faceVertexIndices = [0,1,2,0,2,3,1,2,4]\n"
        f'uniform token physics:approximation = "{kind}"', ["collider.not-finite"])
       for kind in ("none", "convexHull", "convexDecomposition", "meshSimplification",
                    "boundingSphere", "boundingCube")},
    "points without widths": ("Points", BODY, "point3f[] points = [(0,0,0)]",
                              ["collider.points-invalid"]),
    "owner nowhere": ("Cube", BODY, "rel physics:simulationOwner = </Nowhere>",
                      ["scene.owner-missing"]),
    "pair with nothing": ("Cube", BODY + ["PhysicsFilteredPairsAPI"],
                          "rel physics:filteredPairs = </Nowhere>", ["filter.target-missing"]),
    "subset of faces that are not there": (
        "Mesh", ["PhysicsCollisionAPI"], "point3f[] points = [(0,0,0),(1,0,0),(0,1,0)]\n"
        "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n"
        'def GeomSubset "S" (\n prepend apiSchemas = ["MaterialBindingAPI"]\n)\n{\n'
        "int[] indices = [-1, 0, 2000000000]\nrel material:binding = </Nowhere>\n}", []),
    "shape that moves to NaN": (
        "Xform", ["PhysicsRigidBodyAPI"],
        'def Cube "C" (\n prepend apiSchemas = ["PhysicsCollisionAPI"]\n)\n{\n'
        "double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 1e9: (nan, 0, 0) }\n"
        "float3 xformOp:scale.timeSamples = { 0: (1, 1, 1), 5: (0, inf, 1) }\n"
        'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]\n}', []),
    "pair with itself": ("Cube", BODY + ["PhysicsFilteredPairsAPI"],
                         "rel physics:filteredPairs = </Bad>", ["filter.self"]),
}
JOINTS = {
    "joint to nothing": ("rel physics:body1 = </Nowhere>", ["joint.body-missing"]),
    "joint to itself": ("rel physics:body1 = </Joint>", ["joint.no-body"]),
    "joint between one body": ("rel physics:body0 = </Bad>\nrel physics:body1 = </Bad>",
                               ["joint.same-body"]),
    "limits NaN": ("rel physics:body1 = </Bad>\nfloat physics:lowerLimit = nan",
                   ["attribute.not-a-number"]),
    "break force negative": ("rel physics:body1 = </Bad>\nfloat physics:breakForce = -1",
                             ["joint.negative-break"]),
    "anchor NaN": ("rel physics:body1 = </Bad>\npoint3f physics:localPos0 = (nan, 0, 0)",
                   ["attribute.not-a-number"]),
}


class BadPhysics(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, text):
        path = self.folder / "bad.usda"
        path.write_text(HEAD + text)
        return path

    def run_verb(self, *arguments):
        done = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                              check=False)
        self.assertIn(done.returncode, (0, 1, 2, 3), done.stderr[-2000:])
        return done

    def rules(self, path):
        found = json.loads(self.run_verb("physics", path, "--json").stdout)
        self.run_verb("sim", path, "--duration", "0.02")
        return {d["rule"] for d in found["diagnostics"]}

    def expect(self, name, text, wanted):
        with self.subTest(name):
            self.assertLessEqual(set(wanted), self.rules(self.write(text)), name)

    @staticmethod
    def prim(kind, apis, properties):
        listed = ", ".join(f'"{api}"' for api in apis)
        return (f'{SCENE}def {kind} "Bad" (\n    prepend apiSchemas = [{listed}]\n)\n'
                f"{{\n{properties}\n}}\n")

    def test_bodies_and_shapes(self):
        for name, (kind, apis, properties, wanted) in SHAPES.items():
            self.expect(name, self.prim(kind, apis, properties), wanted)

    def test_joints(self):
        for name, (properties, wanted) in JOINTS.items():
            text = self.prim("Cube", BODY, "")
            text += f'def PhysicsRevoluteJoint "Joint"\n{{\n{properties}\n}}\n'
            self.expect(name, text, wanted)

    def test_scenes(self):
        for name, text, wanted in (
                ("gravity NaN", "vector3f physics:gravityDirection = (0, nan, 0)",
                 ["attribute.not-a-number"]),
                ("gravity of another type", "double physics:gravityMagnitude = 5",
                 ["attribute.wrong-type"])):
            self.expect(name, f'def PhysicsScene "Scene"\n{{\n{text}\n}}\n', wanted)

    def test_point_instancers(self):
        proto = ('def Cube "C" (\n prepend apiSchemas = ["PhysicsRigidBodyAPI", '
                 '"PhysicsCollisionAPI"]\n)\n{\n}\n')
        for name, rel, arrays, wanted in (
                ("no such prototype", "</P/C>", "int[] protoIndices = [0, 4]\n"
                 "point3f[] positions = [(0,0,0), (1,0,0)]", ["point-instancer.invalid"]),
                ("negative prototype", "</P/C>", "int[] protoIndices = [-1]\n"
                 "point3f[] positions = [(0,0,0)]", ["point-instancer.invalid"]),
                ("too few positions", "</P/C>", "int[] protoIndices = [0, 0]\n"
                 "point3f[] positions = [(0,0,0)]", ["point-instancer.invalid"]),
                ("place NaN", "</P/C>", "int[] protoIndices = [0]\n"
                 "point3f[] positions = [(0,nan,0)]", ["body.not-finite"]),
                ("scale zero", "</P/C>", "int[] protoIndices = [0]\n"
                 "point3f[] positions = [(0,0,0)]\nfloat3[] scales = [(0,0,0)]",
                 ["body.zero-scale"]),
                ("missing prototype", "</Nowhere>", "int[] protoIndices = [0]\n"
                 "point3f[] positions = [(0,0,0)]", []),
                ("in itself", "</P>", "int[] protoIndices = [0, 0, 0]\n"
                 "point3f[] positions = [(0,0,0), (1,0,0), (2,0,0)]", [])):
            self.expect(name, f'{SCENE}def PointInstancer "P"\n{{\nrel prototypes = {rel}\n'
                        f"{arrays}\n{proto}}}\n", wanted)

    def test_relations_in_circles(self):
        text = self.prim("Cube", BODY + ["PhysicsFilteredPairsAPI"],
                         "rel physics:filteredPairs = </Bad.physics:filteredPairs>\n"
                         "rel physics:simulationOwner = </Bad.physics:simulationOwner>")
        text += ('def PhysicsCollisionGroup "A" (\n'
                 '    prepend apiSchemas = ["CollectionAPI:colliders"]\n)\n{\n'
                 "    rel collection:colliders:includes = </A.collection:colliders>\n"
                 "    rel physics:filteredGroups = [</A>, </B>]\n}\n"
                 'def PhysicsCollisionGroup "B"\n{\n    rel physics:filteredGroups = </A>\n}\n')
        self.assertIn("scene.owner-missing", self.rules(self.write(text)))

    def test_bodies_in_a_deep_hierarchy(self):
        deep = "".join(f'def Xform "D{i % 9}"\n{{\n' for i in range(400)) + "}\n" * 400
        self.assertEqual(self.run_verb("physics", self.write(SCENE + deep)).returncode, 0)
        done = self.run_verb("physics", self.write('def Xform "D"\n{\n' * DEPTH + "}\n" * DEPTH))
        self.assertEqual(done.returncode, 2)
        self.assertIn("error", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
