# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes and mesh files for the tests of the verbs that make scenes."""

import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))

PART = '#usda 1.0\n(\n    defaultPrim = "Part"\n)\ndef Xform "Part"\n{\n    def Cube "inner"\n' \
       '    {\n    }\n}\n'
MESH = '''    def Mesh "m"   # odd layout stays
    {
        int[] faceVertexCounts = [3,3,
            3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    }
'''
BODY = '''
    # body %(name)s
    def Cube "%(name)s" (prepend apiSchemas = ["PhysicsRigidBodyAPI",
                                         "PhysicsCollisionAPI"])
    {
        double size = 0.4 # metres
      double3 xformOp:translate = (%(x)s, 0, 0)
        uniform token[] xformOpOrder = [ "xformOp:translate" ]
    }
'''
JOINTS = '''
    def PhysicsJoint "j"
    {
        rel physics:body0 = </World/a>
        rel physics:body1 = </World/b>
        bool physics:collisionEnabled = 1
        point3f physics:localPos0 = (1, 0, 0)
    }
    def PhysicsRevoluteJoint "h"
    {
        rel physics:body1 = </World/a>
    }


    def PhysicsRevoluteJoint "h2"
    {
        rel physics:body1 = </World/b>
        point3f physics:localPos0 = (2, 0, 0)
    }
    def Material "L"
    {
    }
    def Material "M" (
      apiSchemas = ["PhysicsMaterialAPI"] )
    {
        float physics:staticFriction = 0.25; }
'''
# One tetrahedron in each format of meshes.
CORNERS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 2))
FACES = ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3))


def stl():
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join(
        "vertex {} {} {}\n".format(*CORNERS[i]) for i in face) + "endloop\nendfacet\n"
        for face in FACES)
    return f"solid part\n{facets}endsolid part\n".encode()


def obj():
    points = "".join("v {} {} {}\n".format(*corner) for corner in CORNERS)
    return (points + "".join("f {} {} {}\n".format(*(i + 1 for i in face))
                             for face in FACES)).encode()


def ply():
    points = "".join("{} {} {}\n".format(*corner) for corner in CORNERS)
    faces = "".join("3 {} {} {}\n".format(*face) for face in FACES)
    return ("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            "property float z\nelement face 4\nproperty list uchar int vertex_indices\n"
            f"end_header\n{points}{faces}").encode()


def glb():
    points = struct.pack("<12f", *(number for corner in CORNERS for number in corner))
    corners = struct.pack("<12H", *(i for face in FACES for i in face))
    views = [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                  "min": [0, 0, 0], "max": [1, 1, 2]},
                 {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}]
    text = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "buffers": [{"byteLength": 72}], "bufferViews": views,
        "accessors": accessors, "materials": [
            {"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.25, 1]}}],
        "meshes": [{"primitives": [
            {"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}]}).encode()
    text += b" " * (-len(text) % 4)
    chunks = (struct.pack("<II", len(text), 0x4E4F534A) + text
              + struct.pack("<II", 72, 0x004E4942) + points + corners)
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


MESHES = {"stl": stl, "obj": obj, "ply": ply, "glb": glb}
LAID_OUT = '#usda 1.0\n# a comment\n(\n  defaultPrim="World"\n  upAxis = "Y"\n' \
           '  metersPerUnit = 0.01 # cm\n)\n\n\ndef Xform "World"\n{\n' \
           + MESH + BODY % {"name": "a", "x": 0} + BODY % {"name": "b", "x": 2} + JOINTS + \
           '    # the end\n}\n# after all\n'


def tenon(*arguments, cwd=None):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False, cwd=cwd)


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.scene = self.folder / "s.usda"
        (self.folder / "part.usda").write_text(PART, encoding="utf-8")
        for ending, contents in MESHES.items():
            (self.folder / f"part.{ending}").write_bytes(contents())

    def laid_out(self):
        self.scene.write_text(LAID_OUT, encoding="utf-8")
        return self.scene

    def do(self, *arguments, code=0):
        process = tenon(*arguments, cwd=self.folder)
        self.assertEqual(process.returncode, code, (arguments, process.stdout, process.stderr))
        return process

    def refused(self, rule, *arguments):
        before = self.files()
        process = self.do(*arguments, code=2)
        self.assertIn(f"[{rule}]", process.stderr)
        self.assertEqual(self.files(), before)
        return process.stderr

    def files(self):
        return {str(path.relative_to(self.folder)): path.read_bytes()
                for path in sorted(self.folder.rglob("*")) if path.is_file()}
