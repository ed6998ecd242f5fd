#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""One fault gives the finding that names it and no other; fixes write nothing that is likely wrong.

    test_causes.py TENON
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TENON = sys.argv[1]
ROOT = pathlib.Path(__file__).resolve().parents[2]
UNITS = 'metersPerUnit = 1\n    kilogramsPerUnit = 1\n    upAxis = "Z"'
BOX = """    def Cube "{name}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"{more}]
    )
    {{
        double size = 0.2
        double3 xformOp:translate = {at}
        uniform token[] xformOpOrder = ["xformOp:translate"]
        {extra}
    }}
"""
FLOOR = """    def Cube "Floor" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        double size = 1
        float3 xformOp:scale = (20, 20, 1)
        double3 xformOp:translate = (0, 0, -0.5)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }
"""
MATERIAL = """    def Material "M" (prepend apiSchemas = ["PhysicsMaterialAPI"])
    {{
        float physics:restitution = {}
    }}
"""
MESH = """uniform token physics:approximation = "{}"
        point3f[] points = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2]"""


def standing(kind, text=""):
    """A collider without a body, around (0, 0, 1)."""
    apis = "PhysicsCollisionAPI" + ('", "PhysicsMeshCollisionAPI' if kind == "Mesh" else "")
    return f"""    def {kind} "Standing" (prepend apiSchemas = ["{apis}"])
    {{
        double3 xformOp:translate = (0, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        {text}
    }}
"""


def box(name, at, extra="", more=()):
    return BOX.format(name=name, at=at, extra=extra, more="".join(f', "{api}"' for api in more))


def hinge(name, apis, text):
    return f"""    def PhysicsRevoluteJoint "{name}" (prepend apiSchemas = [{apis}])
    {{
        rel physics:body0 = </World/A>
        rel physics:body1 = </World/B>
        point3f physics:localPos0 = (0.5, 0, 0)
        point3f physics:localPos1 = (-0.5, 0, 0)
        {text}
    }}
"""


class Causes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "scene.usda"

    def write(self, text, units=UNITS, scene="", apis=""):
        self.path.write_text(f"""#usda 1.0
(
    defaultPrim = "World"
    {units}
)
def Xform "World" {apis}
{{
    def PhysicsScene "Scene"
    {{
        {scene}
    }}
{text}}}
""")

    def check(self, *options):
        done = subprocess.run([TENON, "check", self.path, "--json", *options], check=False,
                              capture_output=True, text=True)
        return json.loads(done.stdout)["diagnostics"]

    def found(self, severities=("error", "warning")):
        return [d["rule"] for d in self.check() if d["severity"] in severities]

    def test_a_transform_that_is_no_number_gives_one_finding(self):
        drive = '"PhysicsDriveAPI:angular"', "float drive:angular:physics:damping = 1"
        self.write(box("A", "(0, 0, nan)") + box("B", "(1, 0, 1)") + hinge("J", *drive),
                   apis='(prepend apiSchemas = ["PhysicsArticulationRootAPI"])')
        self.assertEqual(self.found(), ["body.not-finite"])
        self.write("""    def Xform "A" (prepend apiSchemas = ["PhysicsRigidBodyAPI"])
    {
        double3 xformOp:translate = (nan, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Sphere "Ball" (prepend apiSchemas = ["PhysicsCollisionAPI"])
        {
        }
    }
""")
        self.assertEqual(self.found(), ["body.not-finite"])

    def test_a_body_whose_only_collider_is_off_is_told_so(self):
        self.write(box("A", "(0, 0, 1)", "bool physics:collisionEnabled = 0"))
        findings = self.check()
        self.assertEqual([d["rule"] for d in findings], ["mass.no-volume"])
        self.assertIn("the only collider of the body is disabled", findings[0]["message"])

    def test_a_mimic_of_itself_is_a_cycle(self):
        mimic = '"NewtonMimicAPI"', "rel newton:mimicJoint = </World/J>"
        self.write(box("A", "(0, 0, 1)") + box("B", "(1, 0, 1)") + hinge("J", *mimic))
        self.assertEqual(self.found(), ["mimic.cycle"])

    def test_a_property_of_another_type_is_told(self):
        self.write(box("A", "(0, 0, 1)", "float physics:coneAngle0Limit = 3"))
        findings = self.check()
        self.assertEqual([d["rule"] for d in findings], ["attribute.unknown"])
        self.assertIn("PhysicsSphericalJoint", findings[0]["message"])

    def test_a_finding_has_the_number_that_the_file_has(self):
        self.write(box("A", "(0, 0, 1)", "float3 physics:diagonalInertia = (-0.1, 1, 1)",
                       ["PhysicsMassAPI"]) + box("B", "(1, 0, 1)")
                   + """    def PhysicsDistanceJoint "Rope"
    {
        rel physics:body0 = </World/A>
        rel physics:body1 = </World/B>
        float physics:minDistance = 1.3
        float physics:maxDistance = 1.1
    }
""")
        said = " ".join(d["message"] for d in self.check())
        self.assertIn("has the component -0.1;", said)
        self.assertIn("minDistance 1.3 exceeds maxDistance 1.1;", said)

    def test_actuators_of_vendors_count_as_motors(self):
        two = box("A", "(0, 0, 1)") + box("B", "(1, 0, 1)") + hinge("J", '"NewtonJointAPI"', "")
        root = '(prepend apiSchemas = ["PhysicsArticulationRootAPI"])'
        self.write(two, apis=root)
        self.assertEqual([d["rule"] for d in self.check()], ["articulation.passive"])
        for kind, target, told in (("MjcActuator", "mjc:target", []),
                                   ("NewtonActuator", "newton:targets", ["actuator.not-read"])):
            self.write(two + f"""    def {kind} "Motor"
    {{
        rel {target} = </World/J>
    }}
""", apis=root)
            with self.subTest(kind):
                self.assertEqual([d["rule"] for d in self.check()], told)

    def test_a_kinematic_root_is_no_error(self):
        self.write(box("A", "(0, 0, 1)", "bool physics:kinematicEnabled = 1",
                       ["PhysicsArticulationRootAPI"]) + box("B", "(1, 0, 1)")
                   + hinge("J", '"NewtonJointAPI"', ""))
        self.assertEqual([(d["rule"], d["severity"]) for d in self.check()],
                         [("articulation.root-kinematic", "warning")])

    def test_the_body_of_a_draft_is_named(self):
        self.write(box("A", "(0, 0, 1)", "", ["PhysicsBodyAPI"]).replace(
            '"PhysicsRigidBodyAPI", ', ""))
        found = self.check()
        self.assertEqual({d["rule"] for d in found}, {"stage.unknown-api", "body.none"})
        self.assertIn('"PhysicsBodyAPI"', " ".join(d["message"] for d in found))

    def test_what_starts_in_a_plane_overlaps_it(self):
        floor = """    def Plane "Floor" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        uniform token axis = "Z"
    }
"""
        for height, told in ((0.1, []), (0.05, ["collider.overlap-at-start"]),
                             (-3, ["collider.overlap-at-start"])):
            self.write(box("A", f"(0, 0, {height})") + floor)
            with self.subTest(height):
                self.assertEqual(self.found(), told)

    def test_its_page_says_which_shapes_are_compared(self):
        page = (ROOT / "docs/rules/collider.overlap-at-start.md").read_text().replace("\n", " ")
        self.assertIn("Shapes, and meshes as their convex hulls, are compared", page)
        self.assertIn("exact triangle meshes are not", page)
        for kind in ("Sphere", "Capsule", "Cylinder", "Cone", "Cube"):
            self.write(box("A", "(0, 0, 1)") + standing(kind))
            with self.subTest(kind):
                self.assertEqual(self.found(), ["collider.overlap-at-start"])
        for approximation, told in (("convexHull", ["collider.overlap-at-start"]), ("none", [])):
            self.write(box("A", "(0, 0, 1)") + standing("Mesh", MESH.format(approximation)))
            with self.subTest(approximation):
                self.assertEqual(self.found(), told)

    def test_a_step_of_nothing_is_told(self):
        for step in ("0", "-0.01"):
            self.write(box("A", "(0, 0, 1)"), scene=f"uniform double mjc:option:timestep = {step}")
            self.path.write_text(self.path.read_text().replace(
                'def PhysicsScene "Scene"',
                'def PhysicsScene "Scene" (prepend apiSchemas = ["MjcSceneAPI"])'))
            self.assertEqual(self.found(), ["scene.time-step"])

    def portability(self, *options):
        return {(d["rule"], *d["engines"]) for d in self.check(*options) if d["engines"]}

    def test_what_engines_do_otherwise_is_told_for_those_that_are_asked_for(self):
        self.write(box("A", "(0, 0, 1)", "vector3f physics:angularVelocity = (0, 0, 573)")
                   + box("B", "(1, 0, 1)"))
        damping = "portability.angular-damping", "isaac", "physx"
        friction = "portability.unbound-friction", "mujoco", "newton"
        self.assertEqual(self.portability(), set())
        self.assertEqual(self.portability("--for", "physx"), {damping})
        self.assertEqual(self.portability("--for", "isaac"), {damping})
        self.assertEqual(self.portability("--for", "newton"), {friction})
        self.assertEqual(self.portability("--for", "mujoco,physx"), {damping, friction})
        self.assertEqual(self.portability("--for", "physx", "--skip", "portability"), set())
        done = subprocess.run([TENON, "check", self.path, "--for", "jolt"], check=False,
                              capture_output=True)
        self.assertEqual(done.returncode, 2)

    def test_the_size_of_the_effect_is_named(self):
        drive = ('"PhysicsDriveAPI:angular"', "uniform token drive:angular:physics:type = "
                 '"acceleration"\n        float drive:angular:physics:stiffness = 2')
        text = hinge("J", *drive).replace("rel physics:body0 = </World/A>", "")
        self.write(box("B", "(1, 0, 1)") + text.replace('(0.5, 0, 0)', "(0, 0, 1)")
                   .replace("(-0.5, 0, 0)", '(-1, 0, 0)\n        uniform token physics:axis = "Y"'))
        found = [d for d in self.check("--for", "physx") if d["engines"]]
        self.assertEqual([d["rule"] for d in found], ["portability.acceleration-drive"])
        # I = m a^2 / 6 of a cube, m d^2 beside it: (0.2^2 / 6 + 1) / (0.2^2 / 6) = 151.
        self.assertIn("151 times weaker", found[0]["message"])

    def heavy_on(self, supports, mass, scene=""):
        light = ["PhysicsMassAPI"]
        boxes = [box(f"L{i}", at, "float physics:mass = 1", light) for i, at in enumerate(supports)]
        top = box("Top", "(0, 0, 0.8)", f"float physics:mass = {mass}", light)
        self.write(FLOOR + "".join(boxes) + top.replace("size = 0.2", "size = 1.2"), scene=scene)
        return [d for d in self.check() if d["rule"] == "mass.contact-ratio"]

    def test_a_heavy_body_on_a_light_one_is_told_from_where_engines_fail(self):
        under, corners = ["(0, 0, 0.1)"], ["(0.5, 0.5, 0.1)", "(-0.5, 0.5, 0.1)",
                                           "(0.5, -0.5, 0.1)", "(-0.5, -0.5, 0.1)"]
        self.assertEqual(self.heavy_on(under, 39), [])
        self.assertIn("41 kg rest on </World/L0> of 1 kg, 41 to 1",
                      self.heavy_on(under, 41)[0]["message"])
        self.assertEqual(self.heavy_on(corners, 396), [])  # a quarter on each
        self.assertEqual(len(self.heavy_on(corners, 404)), 4)
        self.assertEqual(self.heavy_on(["(0, 0, 0.1)", "(0.71, 0, 0.8)"], 30), [])
        self.assertEqual(self.heavy_on(under, 1000, "float physics:gravityMagnitude = 0"), [])

    def test_a_light_body_beside_or_above_a_heavy_one_is_none(self):
        heavy = box("H", "(0, 0, 0.1)", "float physics:mass = 20", ["PhysicsMassAPI"])
        for at in ("(0.2, 0, 0.1)", "(0, 0, 0.3)"):
            self.write(FLOOR + heavy + box("L", at, "float physics:mass = 0.1", ["PhysicsMassAPI"]))
            self.assertEqual(self.found(), [])

    def row_of_balls(self, gap, restitution, more):
        ball = box("{}", "({}, 0, 1)", "rel material:binding:physics = </World/M>",
                   ["MaterialBindingAPI"]).replace("Cube", "Sphere").replace("size", "radius")
        places = [("A", 0), ("B", 0.4 + gap)] + more
        self.write(MATERIAL.format(restitution) + "".join(
            ball.replace("{}", name, 1).replace("{}", str(x)) for name, x in places),
            scene="float physics:gravityMagnitude = 0")
        return [d["rule"] for d in self.check() if d["severity"] == "warning"]

    def test_a_row_of_balls_is_told_where_something_can_hit_it(self):
        told, striker = ["material.simultaneous-impacts"], [("C", -1)]
        self.assertEqual(self.row_of_balls(0, 0.9, striker), told)
        self.assertEqual(self.row_of_balls(0.0004, 0.5, striker), told)
        self.assertEqual(self.row_of_balls(0, 0.49, striker), [])
        self.assertEqual(self.row_of_balls(0.02, 0.9, striker), [])
        self.assertEqual(self.row_of_balls(0, 0.9, []), [])

    def test_a_spring_that_no_step_weakens_is_no_undamped_drive(self):
        drive = '"PhysicsDriveAPI:angular"'
        for stiffness, wanted in ((0.05, []), (10, ["drive.undamped"])):
            self.write(box("A", "(0, 0, 1)") + box("B", "(1, 0, 1)") + hinge(
                "J", drive, f"float drive:angular:physics:stiffness = {stiffness}"))
            self.assertEqual(self.found(), wanted)

    def test_what_mujocos_reader_leaves_out_is_one_finding_that_names_all(self):
        drive = '"PhysicsDriveAPI:angular"', "float drive:angular:physics:damping = 1"
        self.write(box("A", "(0, 0, 1)") + box("B", "(1, 0, 1)") + hinge("J", *drive)
                   + hinge("K", *drive).replace("body0 = </World/A>", "body0 = </World/C>")
                   + box("C", "(2, 0, 1)"))
        found = [d for d in self.check("--for", "mujoco")
                 if d["rule"] == "portability.drive-ignored"]
        self.assertEqual([d["prim"] for d in found], ["/World/J"])
        self.assertIn("mujoco-usd, not --engine mujoco", found[0]["message"])
        self.assertIn("2 joints", found[0]["message"])
        self.assertEqual([row["path"] for row in found[0]["related"]], ["/World/K"])

    def fixes(self):
        return {d["rule"] for d in self.check() if d["autofix"]}

    def test_units_that_are_likely_wrong_are_not_written_down(self):
        mass = "float physics:mass = 8", ["PhysicsMassAPI"]
        self.write(box("A", "(0, 0, 1)", *mass), units="")
        self.assertEqual(self.fixes(), {"stage.up-axis-missing"})
        self.write(box("A", "(0, 0, 1)"), units="", scene="vector3f physics:gravityDirection = "
                                                          "(0, 0, -1)")
        self.assertEqual(self.fixes(), {"stage.kilograms-per-unit-missing"})
        large = box("A", "(0, 0, 1)").replace("size = 0.2", "size = 20")
        self.write(large, units="")
        self.assertEqual(len(self.fixes()), 3)
        self.write(large, units="", scene="float physics:gravityMagnitude = 9.81")
        self.assertNotIn("stage.meters-per-unit-missing", self.fixes())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
