# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The asset's layers, one function each; every function returns the layer's text."""

import math

from . import algebra as la
from . import hand
from . import usda

ROBOT = "inspire_hand"
VARIANTS = ("mujoco", "none", "physics", "physx")
PADDED = ("r_base_link", "right_thumb_4") + tuple(f"right_{finger}_2" for finger in hand.FINGERS)


def physics_path(name):
    return usda.path(f"/{ROBOT}/Physics/{name}")


def selection(variant):
    """Metadata that selects a variant of the set Physics."""
    return f'variants = {{\n    string Physics = "{variant}"\n}}'


def interface():
    """inspire_hand.usda."""
    layer = usda.Layer(
        "Interface of the hand: the base scene, and one variant of physics on top of it.", ROBOT
    )
    with layer.prim(
        f'def Xform "{ROBOT}"',
        "prepend references = @./payloads/base.usda@",
        selection("physics"),
        'append variantSets = "Physics"',
    ):
        with layer.block('variantSet "Physics" ='):
            for variant in VARIANTS:
                if variant == "none":
                    layer.line('"none" {')
                else:
                    layer.line(f'"{variant}" (')
                    layer.line(f"    prepend payload = @./payloads/Physics/{variant}.usda@")
                    layer.line(") {")
                layer.line("}")
    return layer.text()


def _mesh(layer, name, surface):
    low, high = surface.bounds()
    with layer.prim(f'def Mesh "{name}"'):
        layer.attribute("float3[] extent", usda.array((low, high), _point))
        layer.attribute("int[] faceVertexCounts", usda.array([len(face) for face in surface.faces]))
        layer.attribute(
            "int[] faceVertexIndices", usda.array([i for face in surface.faces for i in face])
        )
        layer.line(f"normal3f[] normals = {usda.array(surface.normals, _direction)} (")
        layer.line('    interpolation = "vertex"')
        layer.line(")")
        layer.attribute("point3f[] points", usda.array(surface.points, _point))
        layer.attribute("uniform token subdivisionScheme", '"none"')


def _point(p):
    """Points are kept to a tenth of a micrometre."""
    return usda.group(p, lambda v: usda.length(round(v, 7)))


def _direction(n):
    return usda.group(n, lambda v: usda.length(round(v, 5)))


def geometry(surfaces):
    """payloads/geometry.usdc, as text."""
    layer = usda.Layer(
        "Surfaces of the links, each in its link's frame. Geometry only.", "Geometries"
    )
    with layer.prim('def Scope "Geometries"'):
        for name, surface in surfaces.items():
            with layer.prim(f'def Xform "{name}"'):
                _mesh(layer, name, surface)
    return layer.text()


def _look(layer, name, color, roughness):
    with layer.prim(f'def Material "{name}"'):
        layer.attribute(
            "token outputs:surface.connect", usda.path(f"/Materials/{name}/Shader.outputs:surface")
        )
        with layer.prim('def Shader "Shader"'):
            layer.attribute("uniform token info:id", '"UsdPreviewSurface"')
            layer.attribute("color3f inputs:diffuseColor", usda.group(color))
            layer.attribute("float inputs:metallic", "0")
            layer.attribute("float inputs:roughness", usda.number(roughness))
            layer.line("token outputs:surface")


def _contact(layer, name, friction):
    """Static and dynamic friction are equal, so that every engine can mean the same."""
    with layer.prim(f'def Material "{name}"', apis=("PhysicsMaterialAPI",)):
        layer.attribute("float physics:dynamicFriction", usda.number(friction))
        layer.attribute("float physics:restitution", "0")
        layer.attribute("float physics:staticFriction", usda.number(friction))


def material():
    """payloads/material.usda."""
    layer = usda.Layer(
        "Materials of the hand. Visuals use the looks, colliders the contacts; palm and fingertips "
        "have soft pads that hold things.",
        "Materials",
    )
    with layer.prim('def Scope "Materials"'):
        _look(layer, "Plastic_ABS", (0.13, 0.14, 0.16), 0.45)
        _look(layer, "Rubber_Smooth", (0.30, 0.31, 0.33), 0.8)
        _contact(layer, "Plastic_Contact", 0.4)
        _contact(layer, "Rubber_Contact", 1.0)
    return layer.text()


def _instance(layer, name, surface, look, apis, attributes):
    """One shape ready to be placed: the surface, what is applied to it, and its material inside
    the instance."""
    with layer.prim(
        f'def Xform "{name}"', f"prepend references = @./geometry.usdc@</Geometries/{surface}>"
    ):
        with layer.prim(f'over "{surface}"', apis=apis + ("MaterialBindingAPI",)):
            for declaration, value in attributes:
                layer.attribute(declaration, value)
        with layer.prim('def Scope "Materials"'):
            with layer.prim(
                f'def Material "{look}"',
                f"prepend references = @./material.usda@</Materials/{look}>",
            ):
                pass


def instances(links):
    """payloads/instances.usda."""
    layer = usda.Layer(
        "Surface + material: a visual and a collider (name_1) of every link; both share one "
        "surface.",
        "Instances",
    )
    with layer.prim('def Scope "Instances"'):
        for link in links:
            kind = "Rubber" if link.name in PADDED else "Plastic"
            look = {"Rubber": "Rubber_Smooth", "Plastic": "Plastic_ABS"}[kind]
            bound = usda.path(f"/Instances/{link.name}/Materials/{look}")
            _instance(layer, link.name, link.name, look, (), [("rel material:binding", bound)])
            collider, contact = link.name + "_1", kind + "_Contact"
            bound = usda.path(f"/Instances/{collider}/Materials/{contact}")
            _instance(
                layer,
                collider,
                link.name,
                contact,
                ("PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"),
                [
                    ("rel material:binding:physics", bound),
                    ("uniform token physics:approximation", '"convexHull"'),
                    ("uniform token purpose", '"guide"'),
                ],
            )
    return layer.text()


def base(links):
    """payloads/base.usda."""
    layer = usda.Layer(
        "Animation-ready scene: a flat list of links, posed with all joints at zero.\n"
        "A link's collider rests (active = false) until a physics layer wakes it, so that the "
        "hand without physics has nothing that a simulator could collide with.",
        ROBOT,
        ["subLayers = [\n    @./robot.usda@\n]"],
    )
    with layer.prim(
        f'def Xform "{ROBOT}"',
        f'assetInfo = {{\n    string name = "{ROBOT}"\n}}',
        'kind = "component"',
    ):
        for link in links:
            with layer.prim(f'def Xform "{link.name}"'):
                layer.attribute("quatf xformOp:orient", usda.group(la.quaternion(link.rotation)))
                layer.attribute("float3 xformOp:scale", "(1, 1, 1)")
                layer.attribute("double3 xformOp:translate", usda.group(link.place))
                layer.attribute(
                    "uniform token[] xformOpOrder",
                    usda.tokens(("xformOp:translate", "xformOp:orient", "xformOp:scale")),
                )
                with layer.prim(
                    f'def Xform "{link.name}"',
                    "instanceable = true",
                    f"prepend references = @./instances.usda@</Instances/{link.name}>",
                ):
                    pass
                with layer.prim(
                    f'def Xform "{link.name}_1"',
                    "active = false",
                    "instanceable = true",
                    f"prepend references = @./instances.usda@</Instances/{link.name}_1>",
                ):
                    pass
    return layer.text()


def robot(links):
    """payloads/robot.usda."""
    layer = usda.Layer(
        "What the asset is as a robot. The list of joints is filled where joints exist: "
        "physics.usda.",
        ROBOT,
    )
    with layer.prim(f'over "{ROBOT}"', apis=("IsaacRobotAPI",)):
        layer.attribute("string[] isaac:changelog", '["1.0: first version"]')
        layer.attribute(
            "string isaac:description",
            '"RH56DFX dexterous right hand: 6 actuated degrees of freedom, 12 joints, 540 g"',
        )
        layer.attribute("token isaac:license", '"Apache-2.0"')
        layer.attribute("string isaac:namespace", f'"{ROBOT}"')
        layer.line("rel isaac:physics:robotJoints")
        layer.line("prepend rel isaac:physics:robotLinks = [")
        for link in links:
            layer.line(f"    {usda.path(f'/{ROBOT}/{link.name}')},")
        layer.line("]")
        layer.attribute("token isaac:robotType", '"End Effector"')
        layer.attribute("string isaac:version", '"1.0"')
    return layer.text()


def _body(layer, link):
    apis = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    pairs = hand.FILTERED.get(link.name, ())
    if pairs:
        apis.append("PhysicsFilteredPairsAPI")
    with layer.prim(f'over "{link.name}"', apis=apis):
        layer.attribute(
            "point3f physics:centerOfMass",
            usda.group(link.center, lambda v: usda.length(round(v, 7))),
        )
        layer.attribute(
            "float3 physics:diagonalInertia", usda.group(link.moments, lambda v: f"{v:.6g}")
        )
        if pairs:
            targets = ", ".join(usda.path(f"/{ROBOT}/{other}") for other in pairs)
            layer.attribute("rel physics:filteredPairs", targets)
        layer.attribute("float physics:mass", usda.number(link.mass))
        layer.attribute("quatf physics:principalAxes", usda.group(link.axes))
        with layer.prim(f'over "{link.name}_1"', "active = true"):
            pass


def _anchor(layer):
    layer.comment(
        "Holds the base where the asset is placed, and so is the root of the articulation. Its",
        "contacts stay on: the other side is the prim of the whole hand, and switching them off",
        "would switch off those between palm and fingers.",
    )
    with layer.prim(
        f'def PhysicsFixedJoint "{hand.BASE}_joint"',
        apis=("PhysicsArticulationRootAPI",),
    ):
        layer.attribute("rel physics:body0", usda.path(f"/{ROBOT}"))
        layer.attribute("rel physics:body1", usda.path(f"/{ROBOT}/{hand.BASE}"))
        layer.attribute("bool physics:collisionEnabled", "true")
        for side in (0, 1):
            layer.attribute(f"point3f physics:localPos{side}", "(0, 0, 0)")
        for side in (0, 1):
            layer.attribute(f"quatf physics:localRot{side}", "(1, 0, 0, 0)")


def _joint(layer, joint, link, parent):
    apis = ["NewtonJointAPI", "PhysicsJointStateAPI:angular"]
    apis += ["PhysicsDriveAPI:angular"] if joint.gains else []
    apis += ["NewtonMimicAPI"] if joint.law else []
    frames = hand.joint_frames(link, parent)
    with layer.prim(f'def PhysicsRevoluteJoint "{joint.name}"', apis=apis):
        if joint.gains:
            layer.attribute("float drive:angular:physics:damping", usda.number(joint.gains[1]))
            layer.attribute("float drive:angular:physics:maxForce", usda.number(joint.effort))
            layer.attribute("float drive:angular:physics:stiffness", usda.number(joint.gains[0]))
            layer.attribute("float drive:angular:physics:targetPosition", "0")
            layer.attribute("uniform token drive:angular:physics:type", '"force"')
        layer.attribute("float newton:armature", usda.number(hand.ARMATURE))
        layer.attribute("float newton:friction", usda.number(hand.FRICTION))
        if joint.law:
            leader, factor, offset = joint.law
            layer.attribute("float newton:mimicCoef0", usda.number(offset))
            layer.attribute("float newton:mimicCoef1", usda.number(factor))
            layer.attribute("rel newton:mimicJoint", physics_path(leader + "_joint"))
        layer.attribute("float newton:velocityLimit", usda.number(joint.speed))
        layer.attribute("uniform token physics:axis", '"Z"')
        layer.attribute("rel physics:body0", usda.path(f"/{ROBOT}/{parent.name}"))
        layer.attribute("rel physics:body1", usda.path(f"/{ROBOT}/{link.name}"))
        for side, (place, _) in enumerate(frames):
            layer.attribute(f"point3f physics:localPos{side}", usda.group(place))
        for side, (_, turn) in enumerate(frames):
            layer.attribute(f"quatf physics:localRot{side}", usda.group(turn))
        layer.attribute("float physics:lowerLimit", usda.number(joint.lower))
        layer.attribute("float physics:upperLimit", usda.number(joint.upper))
        layer.attribute("float state:angular:physics:position", "0")
        layer.attribute("float state:angular:physics:velocity", "0")
        layer.attribute("custom float urdf:limit:effort", usda.number(joint.effort))
        layer.attribute("custom float urdf:limit:velocity", usda.number(joint.speed / hand.DEGREES))


def physics(links):
    """payloads/Physics/physics.usda."""
    layer = usda.Layer(
        "Physics for any engine: bodies, masses, joints, drives, mimic laws.\n"
        "Angles are degrees, drive gains are per degree, lengths metres, masses kilograms.\n"
        "Masses and inertias are those of the published URDF times "
        f"{hand.mass_factor():.4f}, so that they sum to 0.540 kg.\n"
        "Mimic law: q = newton:mimicCoef0 + newton:mimicCoef1 * q(newton:mimicJoint).",
        ROBOT,
    )
    by_name = {link.name: link for link in links}
    with layer.prim(f'over "{ROBOT}"'):
        layer.line("prepend rel isaac:physics:robotJoints = [")
        for name in [f"{hand.BASE}_joint"] + [joint.name for joint in hand.JOINTS]:
            layer.line(f"    {physics_path(name)},")
        layer.line("]")
        for link in links:
            _body(layer, link)
        with layer.prim('def Scope "Physics"'):
            _anchor(layer)
            for joint in hand.JOINTS:
                link = by_name[joint.link]
                _joint(layer, joint, link, by_name[link.parent])
    return layer.text()


def physx():
    """payloads/Physics/physx.usda."""
    layer = usda.Layer(
        "PhysX only. Mimic law there: q + gearing * q(referenceJoint) + offset = 0, so gearing "
        "and offset are the negated factor and offset (degrees) of physics.usda.",
        ROBOT,
        ["subLayers = [\n    @./physics.usda@\n]"],
    )
    with layer.prim(f'over "{ROBOT}"'):
        with layer.prim('over "Physics"'):
            with layer.prim(f'over "{hand.BASE}_joint"', apis=("PhysxArticulationAPI",)):
                layer.attribute("int physxArticulation:solverPositionIterationCount", "32")
                layer.attribute("int physxArticulation:solverVelocityIterationCount", "1")
            for joint in hand.JOINTS:
                apis = ["PhysxJointAPI"] + (["PhysxMimicJointAPI:rotX"] if joint.law else [])
                with layer.prim(f'over "{joint.name}"', apis=apis):
                    layer.attribute("float physxJoint:armature", usda.number(hand.ARMATURE))
                    layer.attribute("float physxJoint:maxJointVelocity", usda.number(joint.speed))
                    if joint.law:
                        _physx_mimic(layer, *joint.law)
    return layer.text()


def _physx_mimic(layer, leader, factor, offset):
    mimic = "physxMimicJoint:rotX"
    layer.attribute(f"float {mimic}:dampingRatio", usda.number(hand.MIMIC_RATIO))
    layer.attribute(f"float {mimic}:gearing", usda.number(-factor))
    layer.attribute(f"float {mimic}:naturalFrequency", usda.number(hand.MIMIC_FREQUENCY))
    layer.attribute(f"float {mimic}:offset", usda.number(-offset if offset else 0.0))
    layer.attribute(f"rel {mimic}:referenceJoint", physics_path(leader + "_joint"))
    layer.attribute(f"uniform token {mimic}:referenceJointAxis", '"rotZ"')


def _parameters(*leading):
    return usda.array(leading + (0.0,) * (10 - len(leading)), usda.number)


def mujoco():
    """payloads/Physics/mujoco.usda."""
    layer = usda.Layer(
        "MuJoCo only. Actuators repeat the drives of physics.usda in newton metres and radians "
        "(gains are 180 / pi times those per degree); a reader takes either actuators or "
        "drives, never both.\n"
        "MjcEqualityJointAPI contains the mimic law of physics.usda; only its stiffness is added "
        "here.",
        ROBOT,
        ["subLayers = [\n    @./physics.usda@\n]"],
    )
    with layer.prim(f'over "{ROBOT}"'):
        layer.comment(
            "MuJoCo's own USD reader takes an articulation root for a body, so here it stands on one.",
        )
        with layer.prim(f'over "{hand.BASE}"', apis=("PhysicsArticulationRootAPI",)):
            pass
        with layer.prim('over "Physics"'):
            root = 'delete apiSchemas = ["PhysicsArticulationRootAPI"]'
            with layer.prim(f'over "{hand.BASE}_joint"', root):
                pass
            for joint in hand.JOINTS:
                if joint.law:
                    with layer.prim(f'over "{joint.name}"', apis=("MjcEqualityJointAPI",)):
                        time_constant = 1 / (hand.MIMIC_FREQUENCY * hand.MIMIC_RATIO)
                        layer.attribute(
                            "uniform double[] mjc:solref",
                            usda.array((time_constant, hand.MIMIC_RATIO), usda.number),
                        )
            for joint in hand.JOINTS:
                if joint.gains:
                    _actuator(layer, joint)
    return layer.text()


def _actuator(layer, joint):
    stiffness, damping = (gain * hand.DEGREES for gain in joint.gains)
    with layer.prim(f'def MjcActuator "{joint.link}_actuator"'):
        layer.attribute("uniform double[] mjc:biasPrm", _parameters(0.0, -stiffness, -damping))
        layer.attribute("uniform token mjc:biasType", '"affine"')
        layer.attribute("uniform double mjc:ctrlRange:max", usda.number(math.radians(joint.upper)))
        layer.attribute("uniform double mjc:ctrlRange:min", usda.number(math.radians(joint.lower)))
        layer.attribute("uniform double mjc:forceRange:max", usda.number(joint.effort))
        layer.attribute("uniform double mjc:forceRange:min", usda.number(-joint.effort))
        layer.attribute("uniform double[] mjc:gainPrm", _parameters(stiffness))
        layer.attribute("uniform token mjc:gainType", '"fixed"')
        layer.attribute("rel mjc:target", physics_path(joint.name))
