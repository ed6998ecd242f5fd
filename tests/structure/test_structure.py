#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon structure` on the example hand, on a vendor's hand in this structure, on flattened copies
and on its own output. Each of ten defects known of another tool has a test that it is absent.

    test_structure.py ROOT TENON [CLASS]...

Tests of the vendor's hand skip, with the reason, where ../shared is absent.
"""

import functools
import json
import math
import pathlib
import re
import sys
import tempfile
import unittest

from program import (EXAMPLE, INCUMBENT, ROOT, SHARED, breaches, files_of, run, structure,
                     tenon)

FOLDER = tempfile.TemporaryDirectory()
VARIANTS = ("none", "physics", "physx", "mujoco")


@functools.cache
def made(asset, *options):
    """-> interface of the asset in this structure, made once."""
    name = f"{asset.parent.name}{len(list(pathlib.Path(FOLDER.name).iterdir()))}"
    return structure(asset, pathlib.Path(FOLDER.name) / name, *options)


def file_of(interface, name):
    return (interface.parent / "payloads" / name).read_text(encoding="utf-8")


def physics_of(asset, variant):
    found = tenon("physics", asset, "--physics", variant)
    for key in ("diagnostics", "asset", "verb"):
        found.pop(key, None)
    return found


def write(name, text):
    path = pathlib.Path(FOLDER.name) / "sources" / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(text.replace("}", "\n}\n"), encoding="utf-8")  # short sources on few lines
    return path


HEAD = '#usda 1.0\n(defaultPrim = "r"\n metersPerUnit = 1\n upAxis = "Z")\n'


def box_mesh(name, half, apis=""):
    points = [(x * half, y * half, z * half) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    return f'''
    def Mesh "{name}" ({f'prepend apiSchemas = [{apis}]' if apis else ''}) {{
        int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
        int[] faceVertexIndices = [0,1,3,2, 4,6,7,5, 0,4,5,1, 2,3,7,6, 0,2,6,4, 1,5,7,3]
        point3f[] points = {points}
    }}
'''


class Hands:
    """What holds for each hand; subclasses name it."""

    asset = EXAMPLE

    def setUp(self):
        if not self.asset.exists():
            self.skipTest(f"{self.asset} is absent")

    def test_its_own_output_gives_the_same_bytes(self):
        first = made(self.asset)
        again = structure(first, pathlib.Path(FOLDER.name) / f"again_{self.asset.parent.name}")
        self.assertEqual(files_of(again.parent), files_of(first.parent))

    def test_a_flattened_copy_gives_the_same_physics_and_then_the_same_bytes(self):
        folder = pathlib.Path(FOLDER.name)
        flat = folder / f"flat_{self.asset.parent.name}.usda"
        self.assertEqual(run("cat", self.asset, "--flatten", "-o", flat).returncode, 0)
        first = structure(flat, folder / f"of_flat_{self.asset.parent.name}")
        again = structure(first, folder / f"of_flat_again_{self.asset.parent.name}")
        self.assertEqual(files_of(again.parent), files_of(first.parent))
        selection = tenon("structure", first, "--dry-run")["selection"]
        bodies = [body["path"] for body in physics_of(first, selection)["bodies"]]
        self.assertEqual(bodies, [b["path"] for b in physics_of(self.asset, "physics")["bodies"]])

    def test_the_input_stays_as_it_is(self):
        before = files_of(self.asset.parent)
        made(self.asset)
        self.assertEqual(files_of(self.asset.parent), before)

    def test_bodies_joints_and_colliders_are_those_of_the_input(self):
        for variant in VARIANTS[1:]:
            with self.subTest(variant):
                self.assertEqual(physics_of(made(self.asset), variant)["bodies"],
                                 physics_of(self.asset, variant)["bodies"])
                self.assertEqual(physics_of(made(self.asset), variant)["joints"],
                                 physics_of(self.asset, variant)["joints"])

    def test_it_keeps_to_the_structure(self):
        found = [d for d in breaches(made(self.asset)) if d["severity"] != "info"]
        self.assertEqual(found, [])

    def test_names_of_the_tutorial(self):
        files = tenon("structure", self.asset, "--dry-run", "--names", "tutorial")["files"]
        names = {file["file"] for file in files}
        self.assertLessEqual({"payloads/geometry.usdc", "payloads/material.usda"}, names)


class Example(Hands, unittest.TestCase):
    def test_the_order_of_files_in_the_folder_is_nothing(self):
        """Folders list their files in the order in which they came, or by hashes of names."""
        source = self.asset.parent
        names = sorted(path.relative_to(source) for path in source.rglob("*") if path.is_file())
        copies = []
        for order in (names, names[::-1]):
            home = pathlib.Path(tempfile.mkdtemp(dir=FOLDER.name)) / source.name
            for name in order:
                (home / name).parent.mkdir(parents=True, exist_ok=True)
                (home / name).write_bytes((source / name).read_bytes())
            interface = structure(home / self.asset.name, home.parent / "made")
            copies.append(files_of(interface.parent))
        self.assertEqual(copies[0], copies[1])


class VendorsHand(Hands, unittest.TestCase):
    asset = INCUMBENT

    def test_nothing_that_it_has_is_lost(self):
        for variant in VARIANTS[1:]:
            physics = tenon("info", made(self.asset), "--physics", variant)["physics"]
            self.assertEqual((physics["bodies"], physics["joints"]["revolute"],
                              physics["joints"]["fixed"], physics["mimics"],
                              physics["colliders"]), (13, 12, 1, 6, 13))

    def test_none_has_no_colliders(self):  # 6
        self.assertEqual(len(physics_of(self.asset, "none")["colliders"]), 13)
        self.assertEqual(physics_of(made(self.asset), "none")["colliders"], [])

    def test_properties_are_declared_as_their_schemas_do(self):  # quirks of spec copying
        text = file_of(made(self.asset), "Physics/physics.usda")
        text += file_of(made(self.asset), "instances.usda")
        self.assertNotIn("custom rel", text)
        self.assertIn('uniform token purpose = "guide"', text)

    def test_no_joint_list_dangles_without_physics(self):
        self.assertNotIn("joint", file_of(made(self.asset), "robot.usda"))


class Defects(unittest.TestCase):
    """Of the ten defects those that small sources show; the rest are above."""

    def test_assets_that_are_not_there_are_told(self):  # 1
        pointer = write("pointer.usda", "version https://git-lfs.github.com/spec/v1\noid x\n")
        process = run("structure", pointer, "--dry-run", "--json")
        self.assertIn("file.lfs-pointer", process.stdout)
        self.assertNotEqual(process.returncode, 0)

    def test_angles_and_gains_reach_engines_in_radians(self):  # 3
        joint = """def PhysicsRevoluteJoint "%s" (prepend apiSchemas = [%s]) {
            rel physics:body0 = </r/%s>
            rel physics:body1 = </r/%s>
            %s
        }
"""
        path = write("gains.usda", HEAD + 'def Xform "r" {' + "".join(
            f'def Sphere "{name}" (prepend apiSchemas = ["PhysicsRigidBodyAPI", '
            '"PhysicsCollisionAPI"]) { double radius = 0.1 }\n' for name in "abc") +
            joint % ("lead", '"PhysicsDriveAPI:angular"', "a", "b",
                     "float drive:angular:physics:stiffness = 2") +
            joint % ("follow", '"NewtonMimicAPI"', "b", "c",
                     "float newton:mimicCoef0 = 90\n rel newton:mimicJoint = </r/lead>") + "}\n")
        model = path.with_suffix(".xml")
        self.assertEqual(run("convert", path, model).returncode, 0)
        text = model.read_text(encoding="utf-8")
        gain = -float(re.search(r'biasprm="\S+ ([^ "]+)', text)[1])
        offset = float(re.search(r'polycoef="([^ "]+)', text)[1])
        self.assertAlmostEqual(gain, 2 * 180 / math.pi, places=2)
        self.assertAlmostEqual(offset, math.pi / 2, places=4)

    def test_geometry_of_small_parts_stays_apart(self):  # 4
        path = write("boxes.usda", HEAD + 'def Xform "r" {' + "".join(
            box_mesh(f"b{i}", half) for i, half in enumerate((5e-3, 5.2e-3, 8e-4, 3e-4))) + "}\n")
        geometries = run("cat", made(path).parent / "payloads/geometries.usd").stdout
        self.assertEqual(geometries.count("def Mesh"), 4)

    def test_engines_tune_colliders(self):  # 5
        apis = '"PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "PhysxCollisionAPI"'
        mesh = box_mesh("hull", 0.1, apis).replace(
            "point3f", 'uniform token purpose = "guide"\n'
            "        float physxCollision:contactOffset = 0.25\n        point3f")
        path = write("tuned.usda", HEAD + 'def Xform "r" {' + mesh + "}\n")
        interface = made(path)
        self.assertIn("physxCollision:contactOffset", file_of(interface, "Physics/physx.usda"))
        self.assertEqual(physics_of(interface, "physx")["colliders"][0]["contactOffset"], 0.25)
        self.assertNotIn(0.25, physics_of(interface, "physics")["colliders"][0].values())
        self.assertEqual(breaches(interface), [])

    def test_no_selection_dangles(self):  # 7
        path = write("still.usda", HEAD + 'def Xform "r" { def Cube "c" { } }\n')
        self.assertEqual(tenon("structure", path, "--dry-run")["selection"], "none")

    def test_no_orphan_engine_file(self):  # 8
        path = write("plain.usda", HEAD + 'def Xform "r" { def Cube "c" '
                     '(prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { } }\n')
        made_of = tenon("structure", path, "--dry-run")
        self.assertEqual(made_of["variants"], ["none", "physics"])
        self.assertEqual([f["file"] for f in made_of["files"] if "Physics/" in f["file"]],
                         ["payloads/Physics/physics.usda"])

    def test_the_scene_is_composed(self):  # 9
        path = write("scene.usda", HEAD + '''
def PhysicsScene "Scene" { float physics:gravityMagnitude = 3.5 }
def Xform "r" { def Cube "c" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { } }
''')
        self.assertEqual([s["path"] for s in physics_of(made(path), "physics")["scenes"]],
                         ["/r/Scene"])
        self.assertEqual(tenon("structure", path, "--dry-run")["moved"],
                         [{"from": "/Scene", "to": "/r/Scene"}])

    def test_schemas_that_nobody_knows_go_to_their_vendor(self):  # 10
        path = write("vendor.usda", HEAD + '''
def Xform "r" { def Cube "c" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysxOfTomorrowAPI"]) {
    float physxOfTomorrow:x = 1
} }
''')
        physx = file_of(made(path), "Physics/physx.usda")
        self.assertIn("PhysxOfTomorrowAPI", physx)
        self.assertIn("physxOfTomorrow:x", physx)
        self.assertNotIn("Physx", file_of(made(path), "Physics/physics.usda"))


LEGACY = HEAD + """
def Xform "r" {
    def Xform "a" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { }
    def Xform "b" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { }
    def Xform "c" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { }
    def PhysicsRevoluteJoint "lead" (prepend apiSchemas = ["PhysxJointAPI"]) {
        rel physics:body0 = </r/a>
        rel physics:body1 = </r/b>
        float physxJoint:armature = 0.25
        float physxJoint:maxJointVelocity = 90
    }
    def PhysicsRevoluteJoint "follow" (
        prepend apiSchemas = ["PhysxJointAPI", "PhysxMimicJointAPI:rotX"]
    ) {
        rel physics:body0 = </r/b>
        rel physics:body1 = </r/c>
        float physxJoint:jointFriction = 0.5
        float physxMimicJoint:rotX:gearing = -0.75
        float physxMimicJoint:rotX:offset = 6
        rel physxMimicJoint:rotX:referenceJoint = </r/lead>
    }
}
"""


def joints_of(asset, variant):
    """-> joints by name, without the schema that their mimic stands in."""
    joints = {joint["path"].rsplit("/", 1)[1]: joint
              for joint in physics_of(asset, variant)["joints"]}
    for joint in joints.values():
        for mimic in [joint["mimic"] or {}, *joint["mimics"]]:
            mimic.pop("schema", None)
    return joints


class Generations(unittest.TestCase):  # 2
    def test_current(self):
        path = write("legacy.usda", LEGACY)
        interface = made(path, "--schema", "current")
        physx, physics = (file_of(interface, f"Physics/{name}.usda") for name in
                          ("physx", "physics"))
        self.assertIn("PhysxJointAxisAPI:angular", physx)
        self.assertIn("physxJointAxis:angular:armature = 0.25", physx)
        self.assertNotIn("PhysxMimicJointAPI", physx)
        self.assertIn("newton:mimicCoef0 = -6", physics)
        self.assertIn("newton:mimicCoef1 = 0.75", physics)
        self.assertNotIn("physxJoint:armature", physx)
        self.assertIn("physxJoint:jointFriction = 0.5", physx)  # has no counterpart
        self.assertEqual(joints_of(interface, "physx"), joints_of(made(path), "physx"))
        self.assertAlmostEqual(joints_of(interface, "physics")["follow"]["mimic"]["multiplier"],
                               0.75)
        kept = tenon("structure", path, "--dry-run", "--schema", "current")["diagnostics"]
        self.assertEqual({(d["rule"], d["prim"]) for d in kept},
                         {("structure.schema-kept", "/r/follow")})

    def test_there_and_back(self):
        path = write("legacy.usda", LEGACY)
        current = made(path, "--schema", "current")
        legacy = made(current, "--schema", "legacy")
        physx = file_of(legacy, "Physics/physx.usda")
        self.assertIn("physxMimicJoint:rotX:gearing = -0.75", physx)
        self.assertIn("physxMimicJoint:rotX:offset = 6", physx)
        self.assertIn("physxJoint:armature = 0.25", physx)
        self.assertNotIn("PhysxJointAxisAPI", physx)
        self.assertEqual(joints_of(legacy, "physx"), joints_of(made(path), "physx"))

    def test_both(self):
        interface = made(write("legacy.usda", LEGACY), "--schema", "both")
        physx = file_of(interface, "Physics/physx.usda")
        for name in ("PhysxJointAPI", "PhysxJointAxisAPI:angular", "PhysxMimicJointAPI:rotX"):
            self.assertIn(name, physx)
        self.assertIn("NewtonMimicAPI", file_of(interface, "Physics/physics.usda"))

    def test_an_axis_that_there_is_not_is_x(self):
        for axis in ("Y Z", "1/2", "", "X:Y"):
            with self.subTest(axis):
                path = write("axis.usda", LEGACY.replace(
                    "float physxMimicJoint:rotX:gearing",
                    f'uniform token physics:axis = "{axis}"\n'
                    "        float physxMimicJoint:rotX:gearing"))
                physx = file_of(made(made(path, "--schema", "current"), "--schema", "legacy"),
                                "Physics/physx.usda")
                self.assertIn("physxMimicJoint:rotX:gearing = -0.75", physx)

    def test_a_hand_stays_what_it_is(self):
        for generation in ("current", "legacy", "both"):
            with self.subTest(generation):
                interface = made(EXAMPLE, "--schema", generation)
                again = made(interface, "--schema", generation)
                self.assertEqual(files_of(again.parent), files_of(interface.parent))
                for variant in VARIANTS[1:]:
                    self.assertEqual(joints_of(interface, variant), joints_of(EXAMPLE, variant))


def plain_arm(inner="", outer=""):
    """Two links, the second one below the first; `inner` and `outer` are properties of theirs."""
    return HEAD + f'''
def Xform "r" {{
    def Xform "base" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {{
        {outer}
        double3 xformOp:translate = (1, 2, 3)
        float xformOp:rotateX = 30
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
        def Cube "c" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {{ }}
        def Xform "tip" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {{
            {inner}
            double3 xformOp:translate = (5, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
            def Cube "c" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {{ }}
            def Mesh "m" {{
                int[] faceVertexCounts = [3]
                int[] faceVertexIndices = [0, 1, 2]
                point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 2, 0)]
            }}
        }}
    }}
    def PhysicsRevoluteJoint "j" {{
        rel physics:body0 = </r/base>
        rel physics:body1 = </r/base/tip>
        point3f physics:localPos0 = (5, 0, 0)
        quatf physics:localRot0 = (1, 0, 0, 0)
        quatf physics:localRot1 = (1, 0, 0, 0)
    }}
}}
'''


class Links(unittest.TestCase):
    """Links side by side, and each below the one that carries it."""

    @staticmethod
    @functools.cache
    def scene(interface):
        return physics_of(interface, "physics")

    def by_name(self, interface):
        """-> bodies and joints by their own names, numbers rounded."""
        scene = self.scene(interface)
        rounded = json.loads(json.dumps([scene["bodies"], scene["joints"]]),
                             parse_float=lambda text: round(float(text), 9) + 0.0)
        for row in rounded[0] + rounded[1]:
            for key, value in row.items():
                if isinstance(value, str) and value.startswith("/"):
                    row[key] = value.rsplit("/", 1)[1]
        return sorted(map(str, rounded[0])), sorted(map(str, rounded[1]))

    def body_paths(self, interface):
        return [body["path"] for body in self.scene(interface)["bodies"]]

    def test_there_and_back(self):
        for asset in (EXAMPLE, INCUMBENT):
            if not asset.exists():
                continue
            with self.subTest(asset.parent.name):
                flat = made(asset, "--links", "flat")
                nested = made(flat, "--links", "nested")
                for interface, option in ((flat, "flat"), (nested, "nested")):
                    again = made(interface, "--links", option)
                    self.assertEqual(files_of(again.parent), files_of(interface.parent))
                    self.assertEqual(self.by_name(interface), self.by_name(asset))
                    found = [d for d in breaches(interface) if d["severity"] != "info"]
                    self.assertEqual(found, [])
                side_by_side = self.body_paths(flat)
                self.assertEqual(len({path.rsplit("/", 1)[0] for path in side_by_side}), 1)
                below = self.body_paths(nested)
                self.assertEqual(len([p for p in below
                                      if not any(p.startswith(q + "/") for q in below)]), 1)

    def test_places_and_targets_follow(self):
        arm = write("arm.usda", plain_arm())
        flat = made(arm, "--links", "flat")
        self.assertEqual(self.body_paths(flat), ["/r/base", "/r/tip"])
        base, tip = self.scene(flat)["bodies"]
        self.assertEqual(base["position"], [1, 2, 3])
        for found, wanted in zip(tip["position"], (6, 2, 3)):
            self.assertAlmostEqual(found, wanted, places=12)
        joint, = self.scene(flat)["joints"]
        self.assertEqual((joint["body0"], joint["body1"]), ("/r/base", "/r/tip"))
        moved = tenon("structure", arm, "--dry-run", "--links", "flat")["moved"]
        self.assertEqual(moved, [{"from": "/r/base/tip", "to": "/r/tip"},
                                 {"from": "/r/base/tip/m", "to": "/r/tip/m/m"}])
        nested = made(flat, "--links", "nested")
        self.assertEqual(self.body_paths(nested), ["/r/base", "/r/base/tip"])
        self.assertEqual(self.scene(nested)["bodies"][0]["position"], [1, 2, 3])

    def test_links_stay_where_moving_them_would_change_them(self):
        cases = {"physics:velocity": plain_arm(inner="vector3f physics:velocity = (1, 0, 0)"),
                 "visibility": plain_arm(outer='token visibility = "invisible"'),
                 "is animated": plain_arm().replace("xformOp:rotateX = 30",
                                                    "xformOp:rotateX.timeSamples = { 0: 30 }")}
        for reason, text in cases.items():
            with self.subTest(reason):
                arm = write("kept.usda", text)
                answer = tenon("structure", arm, "--dry-run", "--links", "flat")
                finding, = [d for d in answer["diagnostics"]
                            if d["rule"] == "structure.links-kept"]
                self.assertIn(reason, finding["message"])
                self.assertNotIn("/r/base/tip", [m["from"] for m in answer["moved"]])

    def test_links_behind_other_children_give_the_same_bytes_again(self):
        first = made(write("order.usda", plain_arm()))
        self.assertEqual(files_of(made(first).parent), files_of(first.parent))


ODD = HEAD.replace('"r"', '"m"') + '''
def Mesh "m" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 2, 0)]
}
def TetMesh "soft" {
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    int[] tetVertexIndices = [0, 1, 2, 3]
}
def PhysicsCollisionGroup "group" {
    rel collection:colliders:includes = [</m>, </gone>]
    rel physics:filteredGroups = </elsewhere>
}
'''


# Keeps to the structure though its names alone would not: an asset that is a shape itself, parts of
# points, what stands on a group and in a material, types by old names, overs as prototypes.
UNUSUAL = HEAD + '''
def Cone "r" {
    def Points "sand" {
        point3f[] points = [(0, 0, 0), (1, 0, 0)]
        Vec3f[] extent = [(0, 0, 0), (1, 0, 0)]
        def GeomSubset "packed" {
            uniform token elementType = "point"
            int[] indices = [0]
        }
    }
    def PointInstancer "grains" {
        int[] protoIndices = [0]
        point3f[] positions = [(0, 0, 0)]
        rel prototypes = </r/grains/Kinds/grain>
        over "Kinds" {
            def Xform "grain" { def Sphere "s" { } }
            over "unused" { }
        }
    }
    def PhysicsCollisionGroup "group" (prepend apiSchemas = ["CollectionAPI:colliders"]) {
        rel collection:colliders:includes = </r>
    }
    def Material "mat" (prepend apiSchemas = ["NewtonMPMMaterialAPI"]) {
        float newton:mpm:poissonsRatio = 0.25
        asset missing = @./there/is/none.png@
        def Backdrop "note" {
            uniform token ui:description = "sand"
        }
    }
}
'''


class AnyScene(unittest.TestCase):
    """Assets that are no robots."""

    def test_unusual_ones_keep_to_the_structure(self):
        first = made(write("unusual.usda", UNUSUAL))
        self.assertEqual(files_of(made(first).parent), files_of(first.parent))
        self.assertEqual([d["rule"] for d in breaches(first) if d["severity"] != "info"],
                         ["structure.missing-file"])  # not in the source either
        self.assertIn("@../Textures/none.png@", file_of(first, "materials.usda"))
        base = file_of(first, "base.usda")
        self.assertIn("float3[] extent", base)
        self.assertIn('over "Kinds"', base)
        self.assertNotIn("unused", base)

    def test_scenes_give_the_same_bytes_again(self):
        scenes = sorted((ROOT / "tests/physics/scenes").glob("*.usda"))
        scenes += sorted((SHARED / "scenes").glob("*.usda"))
        tried = 0
        for scene in scenes:
            with self.subTest(scene.name):
                if run("structure", scene, "--dry-run").returncode != 0:
                    continue  # broken, or without a default prim
                tried += 1
                first = made(scene)
                self.assertEqual(files_of(made(first).parent), files_of(first.parent))
        self.assertGreater(tried, 4)

    def test_odd_ones_too(self):
        path = write("odd.usda", ODD)
        answer = tenon("structure", path, "--dry-run")
        outside = [d["property"] for d in answer["diagnostics"]
                   if d["rule"] == "structure.target-outside"]
        self.assertEqual(sorted(outside), ["collection:colliders:includes",
                                           "physics:filteredGroups"])
        first = made(path)
        self.assertEqual(files_of(made(first).parent), files_of(first.parent))
        # Of another type than the schema's, and still there.
        self.assertIn("int[] tetVertexIndices = [0, 1, 2, 3]", file_of(first, "base.usda"))
        # An asset is no instance of its own.
        self.assertNotIn("instanceable", first.read_text(encoding="utf-8"))
        self.assertEqual([b["path"] for b in physics_of(first, "physics")["bodies"]], ["/m"])


class Writing(unittest.TestCase):
    def test_dry_run_writes_nothing(self):
        before = set(pathlib.Path(FOLDER.name).iterdir())
        done = run("structure", EXAMPLE, "--dry-run")
        self.assertEqual(done.returncode, 0)
        self.assertIn("payloads/base.usda", done.stdout)
        self.assertEqual(set(pathlib.Path(FOLDER.name).iterdir()), before)

    def test_a_folder_with_other_files_is_left_alone(self):
        folder = pathlib.Path(FOLDER.name) / "mine"
        folder.mkdir()
        (folder / "notes.txt").write_text("mine", encoding="utf-8")
        done = run("structure", EXAMPLE, "-o", folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("notes.txt", done.stderr)
        self.assertEqual(files_of(folder), {"notes.txt": b"mine"})

    def test_a_place_is_asked_for(self):
        self.assertEqual(run("structure", EXAMPLE).returncode, 2)

    def test_what_is_missing_in_any_variant_is_told_once(self):
        path = write("gaps.usda", HEAD + """def Xform "r" (
    variants = { string tool = "none" }
    prepend variantSets = "tool"
) {
    def Xform "always" (references = @./gone.usda@</X>) { }
    variantSet "tool" = {
        "none" { }
        "grip" {
            def Xform "grip" (payload = @./lost.usda@</X>) { }
        }
    }
}
""")
        process = run("structure", path, "-o", path.parent / "gaps")
        self.assertEqual(process.returncode, 1)
        said = [process.stderr.count(f"@./{name}.usda@ cannot") for name in ("gone", "lost")]
        self.assertEqual(said, [1, 1], process.stderr)

    def test_variants_that_go_are_told(self):
        path = write("inner.usda", HEAD + '''
def Xform "r" { def Xform "tool" (
    variants = { string Size = "big" }
    prepend variantSets = "Size") {
    variantSet "Size" = {
        "big" {
            def Cube "c" { }
        }
        "small" {
            def Sphere "s" { }
        }
    }
} }
''')
        found = tenon("structure", path, "--dry-run")["diagnostics"]
        self.assertEqual([d["rule"] for d in found], ["structure.variants-flattened"])


if __name__ == "__main__":
    try:
        unittest.main(argv=sys.argv[:1] + sys.argv[3:])
    finally:
        FOLDER.cleanup()
