# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""One asset in which every option of a run has something to act on."""

import math

from author import body, drive, floor, joint, material, prim, scene

CAMERA = prim("Camera", "Eye", lines=[
    "double3 xformOp:translate = (0, -6, 1)", "float3 xformOp:rotateXYZ = (90, 0, 0)",
    'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]'])

# A collider without a material slides: its friction is a choice of the reader.
SLIDER = body("Slider", (3, 0, 0.1), velocity=(1, 0, 0), mass=1.0, children=[
    prim("IsaacContactSensor", "touch"), prim("IsaacImuSensor", "imu"),
    prim("Xform", "tip", lines=['custom uniform token tenon:sensor = "frame"']),
    prim("IsaacRaycastSensor", "eye", lines=["float3[] rayDirections = [(0, 0, -1), (-1, 0, 0)]"])])

# Five boxes one on the other: what few iterations hold less well.
TOWER = [body(f"Box{i}", (0, 3, 0.1 + 0.2 * i), mass=1.0 + i) for i in range(5)]

# A driven arm, far from its target, with friction, damping and a spring in MuJoCo's words.
ARM = [
    body("Base", (0, 0, 1), collides=False, mass=5.0, inertia=(0.1, 0.1, 0.1)),
    body("Arm", (0, 0, 1), collides=False, mass=2.0, inertia=(0.01, 0.02, 0.03),
         com=(0.3, 0, 0), children=[
             prim("Xform", "wrist", lines=['custom uniform token tenon:sensor = "forceTorque"'])]),
    joint("fixed", "Weld", body1="/World/Base", pos0=(0, 0, 1),
          apis=["PhysicsArticulationRootAPI"]),
    joint("revolute", "Hinge", "/World/Base", "/World/Arm", axis="Y", limits=(-170, 170),
          parts=[drive("angular", stiffness=0.15, damping=0.02, target_position=40.0,
                       max_force=7.0)],
          apis=["PhysxJointAPI", "MjcJointAPI"],
          lines=['custom uniform token tenon:sensor = "joint"',
                 "float physxJoint:jointFriction = 0.02", "float physxJoint:armature = 0.01",
                 "double mjc:damping = 0.0003", "double mjc:armature = 0.01",
                 "double mjc:frictionloss = 0.02"]),
]

# A weight that slides down a rail.
RAIL = [
    body("Sled", (-3, 0, 3), collides=False, mass=1.0, inertia=(0.01, 0.01, 0.01)),
    joint("prismatic", "Rail", body1="/World/Sled", pos0=(-3, 0, 3), axis="Z"),
]

# A gyroscope on a ball joint, whose terms integrators treat differently.
TOP = [
    body("Top", (6, 0, 1), collides=False, mass=1.0, inertia=(0.01, 0.02, 0.03),
         com=(0, 0, 0), spin=(300, 40, 600)),
    joint("spherical", "Ball", body1="/World/Top", pos0=(6, 0, 1)),
]

ROUGH = material("Rough", 0.6)
# Slides with a friction that its asset says, and one that only drops.
SAID = body("Said", (3, 3, 0.1), velocity=(1, 0, 0), mass=1.0, material="/World/Rough")

PROTOTYPE = prim("", "Proto", children=[body("Part", (9, 0, 2), mass=1.0)]).replace(
    'def "Proto"', 'class "Proto"', 1)
INSTANCE = ('def "Instance" (\n    instanceable = true\n    references = </Proto>\n)\n{\n}\n')

MAIN = """#usda 1.0
(
    defaultPrim = "World"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = "Z"
    subLayers = [@./extra.usda@]
)
def Xform "World" (
    references = @./parts.usda@
    variants = {
        string Physics = "light"
    }
    prepend variantSets = "Physics"
)
{
    variantSet "Physics" = {
        "light" {
        }
        "heavy" {
            over "Arm"
            {
                float physics:mass = 20
                point3f physics:centerOfMass = (0.6, 0, 0)
            }
            over "Slider"
            {
                vector3f physics:velocity = (2, 0, 0)
            }
        }
    }
}
"""


def sphere_mesh(name, at, rings=24, sectors=24):
    """A round mesh that is seen and touched by nothing, with triangles to spare."""
    points, faces = [], []
    for ring in range(rings + 1):
        for sector in range(sectors):
            polar, around = math.pi * ring / rings, 2 * math.pi * sector / sectors
            points.append("(%.5f, %.5f, %.5f)" % (0.1 * math.sin(polar) * math.cos(around),
                                                  0.1 * math.sin(polar) * math.sin(around),
                                                  0.1 * math.cos(polar)))
    for ring in range(rings):
        for sector in range(sectors):
            after = (sector + 1) % sectors
            faces += [ring * sectors + sector, (ring + 1) * sectors + sector,
                      (ring + 1) * sectors + after, ring * sectors + after]
    return prim("Mesh", name, lines=[
        "int[] faceVertexCounts = [" + ", ".join(["4"] * (len(faces) // 4)) + "]",
        "int[] faceVertexIndices = [" + ", ".join(map(str, faces)) + "]",
        "point3f[] points = [" + ", ".join(points) + "]",
        "double3 xformOp:translate = (%g, %g, %g)" % at,
        'uniform token[] xformOpOrder = ["xformOp:translate"]'])


def falling(name, x):
    """A layer with one body that falls."""
    return scene(body(name, (x, -3, 5), mass=1.0)).replace('def PhysicsScene "PhysicsScene"',
                                                          'over "PhysicsScene"')


PAYLOAD = 'def "Loaded" (\n    payload = @./payload.usda@\n)\n{\n}\n'


def referring(layer):
    """The asset, and a body of another layer."""
    return ('#usda 1.0\n(\n    defaultPrim = "World"\n    metersPerUnit = 1\n    upAxis = "Z"\n'
            '    subLayers = [@./main.usda@]\n)\n'
            f'over "World"\n{{\n    def "More" (\n        references = @{layer}@\n    )\n'
            '    {\n    }\n}\n')


def write(folder):
    """Writes all of it below `folder`."""
    for name in ("asset", "library", "outside"):
        (folder / name).mkdir()
    text = scene(floor(), SLIDER, *TOWER, ROUGH, SAID, *ARM, *RAIL, *TOP, CAMERA,
                 sphere_mesh("Seen", (0, 0, 3)), PAYLOAD, INSTANCE)
    (folder / "asset/parts.usda").write_text(text + PROTOTYPE)
    (folder / "asset/main.usda").write_text(MAIN)
    (folder / "asset/payload.usda").write_text(falling("Paid", 12))
    (folder / "asset/extra.usda").write_text(
        scene(body("Extra", (15, 0, 5), mass=1.0)).replace('def Xform "World"', 'over "World"'))
    (folder / "library/found.usda").write_text(falling("Found", 18))
    (folder / "outside/part.usda").write_text(falling("Out", 21))
    (folder / "asset/search.usda").write_text(referring("found.usda"))
    (folder / "asset/noisy.usda").write_text(referring("none.usda").removesuffix("}\n") + "".join(
        f'    def "More{i}" (\n        references = @none.usda@\n    )\n    {{\n    }}\n'
        for i in range(20)) + "}\n")
    (folder / "asset/outside.usda").write_text(referring("../outside/part.usda"))
    (folder / "asset/resting.usda").write_text(scene(floor(), body("Box", (0, 0, 0.12), mass=1.0)))
    (folder / "commands.csv").write_text(
        "time,/World/Hinge.target,/World/Hinge.velocityTarget,/World/Hinge.effort\n"
        "0,-60,,\n0.02,-60,5,-1\n")
