# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Small scenes with one fault each, and the rules of the warnings and errors that name it.

An arm of two hinges that is welded to the world above a floor; each row of SCENES replaces a part
of it or adds one. What stands behind the first rule follows from the same fault.
"""

HEAD = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = {length}
    {mass}
    upAxis = "{up}"
)
def Xform "World" (prepend apiSchemas = ["PhysicsArticulationRootAPI", "MaterialBindingAPI"])
{{
    rel material:binding:physics = </World/Rubber>
"""
SCENE = """    def PhysicsScene "Scene"
    {{
        vector3f physics:gravityDirection = {direction}
        float physics:gravityMagnitude = {gravity}
    }}
"""
FLOOR = """    def Cube "Floor" (prepend apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"])
    {{
        rel material:binding:{purpose} = {material}
        double size = 1
        double3 xformOp:translate = (0, 0, -0.05)
        double3 xformOp:scale = (10, 10, 0.1)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }}
    def Material "Rubber" {apis}
    {{
        float physics:staticFriction = 0.8
        float physics:dynamicFriction = 0.7
        float physics:restitution = 0.1
    }}
    def Material "Paint"
    {{
    }}
"""
WELD = """    def PhysicsFixedJoint "Weld"
    {
        rel physics:body1 = </World/Base>
        point3f physics:localPos0 = (0, 0, 1)
    }
"""
DRIVE = """float drive:angular:physics:stiffness = 50
        float drive:angular:physics:damping = 5
        float drive:angular:physics:maxForce = 100
"""
SPAN = "float physics:lowerLimit = {}\n        float physics:upperLimit = {}"
ANGULAR = '"PhysicsDriveAPI:angular"'
MIMIC = '"NewtonMimicAPI"'
ELBOW, ARM, HAND = "</World/Elbow>", "</World/Arm>", "</World/Hand>"


def scene(direction="(0, 0, -1)", gravity="9.81"):
    return SCENE.format(direction=direction, gravity=gravity)


def floor(purpose="physics", material="</World/Rubber>", api=True):
    apis = '(prepend apiSchemas = ["PhysicsMaterialAPI"])' if api else ""
    return FLOOR.format(purpose=purpose, material=material, apis=apis)


def body(name, x, more="", apis="", shape='def Cube "Shape"', size="double size = 0.2",
         rigid="PhysicsRigidBodyAPI", mass="2", order='["xformOp:translate"]', inside=""):
    return f"""    def Xform "{name}" (prepend apiSchemas = ["{rigid}", "PhysicsMassAPI"{apis}])
    {{
        float physics:mass = {mass}
        double3 xformOp:translate = ({x}, 0, 1)
        uniform token[] xformOpOrder = {order}
        {more}
        {shape} (prepend apiSchemas = ["PhysicsCollisionAPI"])
        {{
            {size}
        }}
        {inside}
    }}
"""


def hinge(name="Elbow", first=ARM, second=HAND, more="", apis=ANGULAR, drive=DRIVE,
          span=SPAN.format(-60, 60), kind="PhysicsRevoluteJoint", axis='"Y"', at="(0.3, 0, 0)"):
    applied = f"(prepend apiSchemas = [{apis}])" if apis else ""
    sides = "".join(f"rel physics:body{i} = {path}\n        "
                    for i, path in enumerate((first, second)) if path)
    return f"""    def {kind} "{name}" {applied}
    {{
        {sides}point3f physics:localPos0 = {at}
        point3f physics:localPos1 = (-0.3, 0, 0)
        uniform token physics:axis = {axis}
        {span}
        {drive}
        {more}
    }}
"""


def group(name, includes, filtered):
    return f"""    def PhysicsCollisionGroup "{name}"
    {{
        rel collection:colliders:includes = {includes}
        rel physics:filteredGroups = {filtered}
    }}
"""


def text_of(length="1", mass="kilogramsPerUnit = 1", up="Z", more="", **parts):
    """The scene with parts of it replaced."""
    whole = {"scene": scene(), "floor": floor(), "base": body("Base", 0), "arm": body("Arm", 0.6),
             "hand": body("Hand", 1.2), "weld": WELD,
             "shoulder": hinge("Shoulder", "</World/Base>", ARM), "elbow": hinge(), **parts}
    return (HEAD.format(length=length, mass=mass, up=up) + "".join(whole.values()) + more + "}\n")


def follows(leader, **other):
    return hinge(apis=MIMIC, drive="", more=f"rel newton:mimicJoint = {leader}", **other)


def hand(**parts):
    return {"hand": body("Hand", 1.2, **parts)}


def elbow(*arguments, **parts):
    return {"elbow": hinge(*arguments, **parts)}


def filtered(target):
    return hand(apis=', "PhysicsFilteredPairsAPI"', more=f"rel physics:filteredPairs = {target}")


def closing(first, at, more=""):
    return {"more": hinge("Closing", first, HAND, apis="", drive="", at=at, more=more).replace(
        "(-0.3, 0, 0)", "(0, 0, 0)")}


MIMICS = [
    ("a mimic of itself", {"elbow": follows(ELBOW)}, "mimic.cycle"),
    ("two mimics of each other", {
        "shoulder": hinge("Shoulder", "</World/Base>", ARM, apis=MIMIC, drive="",
                          more=f"rel newton:mimicJoint = {ELBOW}"),
        "elbow": follows("</World/Shoulder>")}, "mimic.cycle"),
    ("a mimic of a fixed joint", {"elbow": follows("</World/Weld>")}, "mimic.leader-missing"),
    ("a mimic of nothing", {"elbow": follows("</World/None>")}, "mimic.leader-missing"),
    ("a mimic of a disabled joint", {
        "shoulder": hinge("Shoulder", "</World/Base>", ARM, more="bool physics:jointEnabled = 0"),
        "elbow": follows("</World/Shoulder>")}, "mimic.leader-disabled"),
    ("a mimic with a drive", elbow(apis=f"{ANGULAR}, {MIMIC}",
                                   more="rel newton:mimicJoint = </World/Shoulder>"),
     "drive.on-mimic"),
]
JOINTS = [
    ("a closed loop", closing("</World/Base>", "(1.2, 0, 0)"), "articulation.loop"),
    ("a loop through the world", closing("", "(1.2, 0, 1)"), "articulation.loop"),
    ("an excluded loop", closing("</World/Base>", "(1.2, 0, 0)",
                                 "bool physics:excludeFromArticulation = 1"), ""),
    ("crossed limits", elbow(span=SPAN.format(60, -60)),
     "joint.limits-crossed, drive.locked-axis"),
    ("crossed limits of a slide", elbow(
        kind="PhysicsPrismaticJoint", apis="", drive="", span=SPAN.format(0.1, -0.1)),
     "joint.limits-crossed"),
    ("limits in radians", elbow(span=SPAN.format(-1.5708, 1.5708)), "joint.limits-in-radians"),
    ("limits in degrees, converted twice", elbow(span=SPAN.format(-5156.6203, 5156.6203)),
     "joint.limits-in-degrees"),
    ("one body on both sides", {**elbow("Elbow", HAND, HAND), "more": hinge(
        "Wrist", ARM, HAND)}, "joint.same-body"),
    ("a body and its own shape", {"more": hinge("Odd", HAND, "</World/Hand/Shape>", apis="",
                                                drive="")}, "joint.same-body"),
    ("a side that does not exist", elbow("Elbow", "</World/None>"), "joint.body-missing"),
    ("a side that is an attribute", elbow("Elbow", "</World/Arm.physics:mass>"),
     "joint.target-not-prim"),
    ("a side that is a material", elbow("Elbow", "</World/Rubber>", at="(0.9, 0, 1)"),
     "joint.side-without-body"),
    ("a link whose body is disabled", {
        "arm": body("Arm", 0.6, more="bool physics:rigidBodyEnabled = 0")},
     "joint.side-without-body, articulation.loop"),
    ("a side with two targets", elbow("Elbow", "[</World/Arm>, </World/Base>]"),
     "joint.several-targets"),
    ("a side that is written as a string", elbow(
        "Elbow", "", at="(0.9, 0, 1)", more='string physics:body0 = "/World/Arm"'),
     "attribute.wrong-type"),
    ("a joint of nothing", {"more": hinge("Odd", "", "", apis="", drive="")}, "joint.no-body"),
    ("a small letter for an axis", elbow(axis='"y"'), "joint.axis-unknown"),
    ("a rotation of length 0.5", elbow(more="quatf physics:localRot0 = (0.5, 0, 0, 0)"),
     "joint.rotation-length"),
    ("anchors in the world's frame", elbow(at="(0.9, 0, 1)"), "joint.frames-apart"),
    ("a joint that breaks at once", elbow(more="float physics:breakForce = 0"),
     "joint.break-at-once"),
    ("a negative break force", elbow(more="float physics:breakForce = -5"), "joint.negative-break"),
    ("two joints to the world that are to share a load", {
        "more": WELD.replace("Weld", "Second").replace(
            "point3f", "float physics:breakForce = 1000\n        uniform bool "
            "physics:excludeFromArticulation = 1\n        point3f")}, "joint.parallel"),
    ("a type that does not exist", elbow(kind="PhysicsRevoluteJoints"), "stage.unknown-type"),
]
DRIVES = [
    ("a drive without its API", elbow(apis=""), "attribute.api-missing"),
    ("a linear drive of a hinge", elbow(apis='"PhysicsDriveAPI:linear"',
                                        drive=DRIVE.replace("angular", "linear")),
     "drive.no-such-axis"),
    ("a drive of another letter", elbow(apis='"PhysicsDriveAPI:Angular"',
                                        drive=DRIVE.replace("angular", "Angular")),
     "drive.no-such-axis"),
    ("a target in radians", elbow(
        more="float drive:angular:physics:targetPosition = 0.7853982"), "drive.target-in-radians"),
    ("a velocity without damping", elbow(
        drive=DRIVE.replace("damping = 5", "damping = 0"),
        more="float drive:angular:physics:targetVelocity = 20"), "drive.target-without-gain"),
    ("a position without stiffness", elbow(
        drive=DRIVE.replace("stiffness = 50", "stiffness = 0"),
        more="float drive:angular:physics:targetPosition = 20"), "drive.target-without-gain"),
    ("a negative gain", elbow(drive=DRIVE.replace("= 5\n", "= -5\n")), "drive.negative-gain"),
]
BODIES = [
    ("a mass of zero with inertia", hand(
        mass="0", more="float3 physics:diagonalInertia = (0.02, 0.02, 0.02)"), "mass.zero"),
    ("a negative mass", hand(mass="-2"), "mass.negative"),
    ("a mass that is no number", hand(mass="nan"), "attribute.not-a-number"),
    ("a mass in grams", hand(mass="2000"), "mass.density, drive.too-weak"),
    ("a mass without its API", {"hand": body("Hand", 1.2).replace(', "PhysicsMassAPI"', "")},
     "attribute.api-missing"),
    ("a mass on what is no body", {
        "more": '    def Xform "Place" (prepend apiSchemas = ["PhysicsMassAPI"])\n    {\n'
                "        float physics:mass = 4\n    }\n"}, "mass.outside-body"),
    ("an inertia below zero", hand(more="float3 physics:diagonalInertia = (-0.1, 0.1, 0.1)"),
     "mass.inertia-negative"),
    ("a centre of mass in centimetres", hand(more="point3f physics:centerOfMass = (0, 0, 30)"),
     "mass.center-far"),
    ("a body in a body", hand(inside='def Sphere "Inner" (prepend apiSchemas = '
                              '["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])\n        {\n'
                              "            double radius = 0.05\n            double3 "
                              "xformOp:translate = (0, 2, 0)\n            uniform token[] "
                              'xformOpOrder = ["xformOp:translate"]\n        }'), "body.nested"),
    ("a kinematic link", {"arm": body("Arm", 0.6, more="bool physics:kinematicEnabled = 1")},
     "articulation.kinematic-link"),
    ("a body of uneven scale", hand(order='["xformOp:translate", "xformOp:scale"]',
                                    more="double3 xformOp:scale = (1, 2, 1)"),
     "body.non-uniform-scale"),
    ("a scale that no order names", hand(more="double3 xformOp:scale = (1, 1.5, 1)"),
     "xform.op-not-in-order"),
    ("a turn by nothing that no order names", hand(more="float xformOp:rotateX = 0"), ""),
    ("an operation that is not authored", hand(order='["xformOp:translate", "xformOp:orient"]'),
     "xform.op"),
    ("an API that does not exist", hand(apis=', "PhysxRigidBodysAPI"'), "stage.unknown-api"),
    ("a velocity without its prefix", hand(more="vector3f velocity = (0, 0, 0)"),
     "attribute.unprefixed"),
    ("an attribute that does not exist", hand(more="bool physics:startAsleep = 1"),
     "attribute.unknown"),
]
SHAPES = [
    ("a size below zero", hand(size="double size = -0.2"), "collider.size"),
    ("a size of zero", hand(size="double size = 0"), "collider.size, mass.no-volume"),
    ("a radius below zero", hand(shape='def Sphere "Shape"', size="double radius = -0.1"),
     "collider.size"),
    ("a mirrored cube", hand(size="double size = 0.2\n            double3 xformOp:scale = "
                             '(-1, 1, 1)\n            uniform token[] xformOpOrder = '
                             '["xformOp:scale"]'), ""),
    ("a tilted cylinder under an uneven scale", hand(
        shape='def Xform "Wide"\n        {\n            double3 xformOp:scale = (1, 3, 1)\n'
              '            uniform token[] xformOpOrder = ["xformOp:scale"]\n'
              '        def Cylinder "Tube"', inside="}",
        size="double radius = 0.05\n            double height = 0.1\n            "
             "double xformOp:rotateX = 30\n            uniform token[] xformOpOrder = "
             '["xformOp:rotateX"]'), "collider.sheared"),
    ("a collider that is no shape", {
        "more": '    def Xform "Thing" (prepend apiSchemas = ["PhysicsCollisionAPI"])\n'
                "    {\n    }\n"}, "collider.not-a-shape"),
]
CONTACTS = [
    ("a purpose with a slip of the pen", {"floor": floor("physic")}, "material.binding-purpose"),
    ("a purpose of renderers", {"floor": floor("full")}, "material.binding-purpose"),
    ("a material that is paint", {"floor": floor(material="</World/Paint>")},
     "material.without-physics"),
    ("a material without its API", {"floor": floor(api=False)}, "attribute.api-missing"),
    ("a material that does not exist", {"floor": floor(material="</World/Ruber>")},
     "stage.target-missing"),
    ("a material that is a body", {"floor": floor(material=ARM)}, "material.target-unusable"),
    ("a pair with nothing", filtered("</World/None>"), "filter.target-missing"),
    ("a pair with a material", filtered("</World/Rubber>"), "filter.no-collider"),
    ("a pair with itself", filtered(HAND), "filter.self"),
    ("a pair without its API", hand(more=f"rel physics:filteredPairs = {ARM}"),
     "attribute.api-missing"),
    ("a group of nothing", {"more": group("G", "</World/Rubber>", "</World/G>")},
     "group.no-members"),
    ("a group that filters a body", {"more": group("G", HAND, ARM)}, "group.unknown-target"),
    ("groups that include each other", {
        "more": group("G", "[</World/Hand>, </World/K.collection:colliders>]", "</World/K>")
                + group("K", "[</World/Arm>, </World/G.collection:colliders>]", "</World/G>")},
     "group.cycle"),
]
UNITS = [
    ("no fault", {}, ""),
    ("metres called centimetres", {"length": "0.01"}, "scene.gravity-unit, mass.density"),
    ("metres called kilometres", {"length": "1000", "scene": scene(gravity="-inf")},
     "mass.density"),
    ("a unit below zero", {"length": "-1"},
     "units.meters-per-unit, scene.gravity-unit, mass.density"),
    ("gravity in centimetres", {"scene": scene(gravity="981")},
     "scene.gravity-unit, drive.too-weak"),
    ("gravity to the side", {"scene": scene("(0, -1, 0)")}, "scene.gravity-direction"),
    ("gravity upward", {"scene": scene("(0, 0, 1)")}, "scene.gravity-direction"),
    ("gravity down a slope", {"scene": scene("(0.5, 0, -0.866)")}, ""),
    ("another axis that is up", {"up": "Y"}, "scene.gravity-direction"),
    ("an axis that does not exist", {"up": "z"}, "units.up-axis"),
]
SCENES = MIMICS + JOINTS + DRIVES + BODIES + SHAPES + CONTACTS + UNITS
