# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The files of a small robot of two links that meets the requirements of SimReady."""

import struct
import zlib

LABELLED = '"SemanticsLabelsAPI:material"'
FACTS = """        string author = "the tenon authors"
        string asset_name = "thing"
        string asset_type = "robot"
        string asset_license = "Apache-2.0"
        string category = "arm"
        string source_file = "thing.urdf"
        string usd_date_generated = "2026-11-29"
        string qcode = "Q42177"
        int rigid_body_count = 2
        float3 asset_extents = (1, 1, 2)
        double mass = 2
"""


def told(name):
    return f"""                dictionary {name} = {{
                    string prim = "/thing"
                    string variantSetName = "{name}"
                    string activateOption = "Enabled"
                }}
"""


ROOT = f"""#usda 1.0
(
    customLayerData = {{
        string asset_name = "thing"
        string asset_type = "robot"
        string source_file = "thing.urdf"
        string usd_date_generated = "2026-11-29"
        dictionary SimReady_Metadata = {{
{FACTS}        dictionary Variants = {{
            dictionary Physics = {{
{told("PhysX")}{told("Newton")}{told("MuJoCo")}            }}
        }}
        }}
    }}
    defaultPrim = "thing"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "thing" (
    prepend apiSchemas = ["IsaacRobotAPI", "SemanticsLabelsAPI:class",
                          "SemanticsLabelsAPI:wikidata_qcode"]
    kind = "component"
    prepend payload = @./payloads/physics.usda@
    prepend references = @./payloads/base.usda@
    prepend variantSets = ["PhysX", "Newton", "MuJoCo"]
    variants = {{
        string PhysX = "Disabled"
        string Newton = "Disabled"
        string MuJoCo = "Disabled"
    }}
)
{{
    token isaac:robotType = "Manipulator"
    prepend rel isaac:physics:robotJoints = [</thing/joints/hold>, </thing/joints/hinge>]
    prepend rel isaac:physics:robotLinks = [</thing/foot>, </thing/arm>]
    token[] semantics:labels:class = ["arm"]
    token[] semantics:labels:wikidata_qcode = ["Q42177"]
    variantSet "PhysX" = {{
        "Disabled" {{
        }}
        "Enabled" (
            prepend payload = @./runnables/physics/physx.usda@
        ) {{
        }}
    }}
    variantSet "Newton" = {{
        "Disabled" {{
        }}
        "Enabled" (
            prepend payload = @./runnables/physics/newton.usda@
        ) {{
        }}
    }}
    variantSet "MuJoCo" = {{
        "Disabled" {{
        }}
        "Enabled" (
            prepend payload = @./runnables/physics/mujoco.usda@
        ) {{
        }}
    }}
}}
"""

HEAD = """#usda 1.0
(
    defaultPrim = "thing"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = "Z"
)

"""


def mesh(name, size):
    return f"""        def Mesh "{name}" (
            prepend apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI",
                                  "MaterialBindingAPI"]
        )
        {{
            float3[] extent = [(0, 0, 0), ({size}, {size}, {size})]
            int[] faceVertexCounts = [3, 3, 3, 3]
            int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
            rel material:binding = </thing/Looks/grey>
            rel material:binding:physics = </thing/Looks/contact>
            point3f[] points = [(0, 0, 0), ({size}, 0, 0), (0, {size}, 0), (0, 0, {size})]
            color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)]
            float[] primvars:displayOpacity = [1]
            normal3f[] primvars:normals = [(0, 0, -1), (0, -1, 0), (-1, 0, 0),
                                           (0.57735, 0.57735, 0.57735)] (
                interpolation = "uniform"
            )
            uniform token subdivisionScheme = "none"
        }}
"""


BASE = HEAD + f"""def Xform "thing"
{{
    def Xform "foot" (
        prepend apiSchemas = ["IsaacLinkAPI"]
    )
    {{
{mesh("foot_shape", 1)}    }}
    def Xform "arm" (
        prepend apiSchemas = ["IsaacLinkAPI"]
    )
    {{
        double3 xformOp:translate = (0, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
{mesh("arm_shape", 0.5)}        def BasisCurves "grasp_identifier"
        {{
            int[] curveVertexCounts = [2]
            float3[] extent = [(0, 0, 0), (0.1, 0, 0)]
            point3f[] points = [(0, 0, 0), (0.1, 0, 0)]
            uniform token purpose = "guide"
            uniform token type = "linear"
        }}
    }}
    def Scope "Looks"
    {{
        def Material "grey" (
            prepend apiSchemas = [{LABELLED}]
        )
        {{
            token omni:simready:nonvisual:base = "steel"
            token omni:simready:nonvisual:coating = "none"
            token[] omni:simready:nonvisual:attributes = ["none"]
            token outputs:surface.connect = </thing/Looks/grey/surface.outputs:surface>
            token[] semantics:labels:material = ["steel"]
            def Shader "surface"
            {{
                uniform token info:id = "UsdPreviewSurface"
                color3f inputs:diffuseColor.connect = </thing/Looks/grey/paint.outputs:rgb>
                float inputs:roughness = 0.5
                token outputs:surface
            }}
            def Shader "paint"
            {{
                uniform token info:id = "UsdUVTexture"
                asset inputs:file = @../Textures/paint.png@
                token inputs:sourceColorSpace = "sRGB"
                float3 outputs:rgb
            }}
        }}
        def Material "contact" (
            prepend apiSchemas = [{LABELLED}]
        )
        {{
            token[] semantics:labels:material = ["steel"]
        }}
    }}
    def Scope "joints"
    {{
    }}
}}
"""


def body(mass):
    return f"""    over "{{name}}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {{{{
        float physics:mass = {mass}
    }}}}
"""


PHYSICS = HEAD + f"""over "thing" (
    prepend apiSchemas = ["PhysicsArticulationRootAPI"]
)
{{
{body(1).format(name="foot")}{body(1).format(name="arm")}    over "Looks"
    {{
        over "contact" (
            prepend apiSchemas = ["PhysicsMaterialAPI"]
        )
        {{
            float physics:dynamicFriction = 0.5
        }}
    }}
    over "joints"
    {{
        def PhysicsFixedJoint "hold" (
            prepend apiSchemas = ["IsaacJointAPI"]
        )
        {{
            rel physics:body1 = </thing/foot>
        }}
        def PhysicsRevoluteJoint "hinge" (
            prepend apiSchemas = ["IsaacJointAPI", "PhysicsDriveAPI:angular",
                                  "PhysicsJointStateAPI:angular"]
        )
        {{
            uniform token physics:axis = "Z"
            rel physics:body0 = </thing/foot>
            rel physics:body1 = </thing/arm>
            point3f physics:localPos0 = (0, 0, 1)
            float physics:lowerLimit = -90
            float physics:upperLimit = 90
            float drive:angular:physics:damping = 1
            float drive:angular:physics:maxForce = 10
            float drive:angular:physics:stiffness = 100
            float state:angular:physics:position = 0
            float state:angular:physics:velocity = 0
        }}
    }}
}}
"""

PHYSX = HEAD + """over "thing"
{
}
"""

NEWTON = HEAD + """over "thing" (
    prepend apiSchemas = ["NewtonArticulationRootAPI"]
)
{
    bool newton:selfCollisionEnabled = 0
    over "foot"
    {
        over "foot_shape" (
            prepend apiSchemas = ["NewtonCollisionAPI", "NewtonMeshCollisionAPI"]
        )
        {
        }
    }
    over "arm"
    {
        over "arm_shape" (
            prepend apiSchemas = ["NewtonCollisionAPI", "NewtonMeshCollisionAPI"]
        )
        {
        }
    }
}
"""

MUJOCO = HEAD + """over "thing"
{
    over "foot"
    {
        over "foot_shape" (
            prepend apiSchemas = ["MjcCollisionAPI"]
        )
        {
            uniform token physics:approximation = "convexHull"
        }
    }
    over "arm"
    {
        over "arm_shape" (
            prepend apiSchemas = ["MjcCollisionAPI"]
        )
        {
            uniform token physics:approximation = "convexHull"
        }
    }
    over "joints"
    {
        over "hinge" (
            prepend apiSchemas = ["MjcJointAPI"]
        )
        {
        }
        def MjcActuator "motor"
        {
            rel mjc:target = </thing/joints/hinge>
        }
    }
}
"""

EMPTY = '#usda 1.0\n'


def png(width):
    """A black image of three channels, one pixel high."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(
            ">I", zlib.crc32(kind + body))

    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, 1, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes(1 + 3 * width))) + chunk(b"IEND", b""))
