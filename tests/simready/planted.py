# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A small robot that meets the requirements of SimReady, and a defect for each of them.

assets() yields (code, kind, good, {path: text}): for each code an asset that meets it and one that
does not. Texts are made by replacing parts of the robot's files; a part that is not there is an
error, so that no defect is planted in vain.
"""

from robot_files import (BASE, EMPTY, LABELLED, MUJOCO, NEWTON, PHYSICS, PHYSX, ROOT, mesh, png,
                         told)

R, B, P = "thing/any/thing.usda", "thing/any/payloads/base.usda", "thing/any/payloads/physics.usda"
X = "thing/any/runnables/physics/physx.usda"
N = "thing/any/runnables/physics/newton.usda"
M = "thing/any/runnables/physics/mujoco.usda"
THUMB = "thing/any/.thumbs/256x256/thing.usda.png"
FILES = {R: ROOT, B: BASE, P: PHYSICS, X: PHYSX, N: NEWTON, M: MUJOCO, THUMB: png(1),
         "thing/any/Textures/paint.png": png(1),
         **{f"thing/any/payloads/{name}": EMPTY
            for name in ("geometries.usd", "instances.usda", "materials.usda")}}
HINGE = 'def PhysicsRevoluteJoint "hinge"'
MIMIC = """        def PhysicsRevoluteJoint "follower" (
            prepend apiSchemas = ["IsaacJointAPI", "PhysxMimicJointAPI:rotZ",
                                  "PhysicsJointStateAPI:angular"%s]
        )
        {
            rel physics:body0 = </thing/foot>
            rel physics:body1 = </thing/arm>
            point3f physics:localPos0 = (0, 0, 1)
            float physics:lowerLimit = -90
            float physics:upperLimit = 90
            float physxMimicJoint:rotZ:gearing = 1
            float physxMimicJoint:rotZ:naturalFrequency = 25
            float physxMimicJoint:rotZ:dampingRatio = 1
            float state:angular:physics:position = 0
            float state:angular:physics:velocity = 0
            rel physxMimicJoint:rotZ:referenceJoint = </thing/joints/hinge>
%s        }
"""
GAINS = """            float drive:angular:physics:maxForce = %s
            float drive:angular:physics:stiffness = %s
"""


def add(file, before, text):
    """Puts text in front of what is there."""
    return (file, before, text + before)


def cut(file, text):
    return (file, text, "")


def in_hinge(file, text):
    """A value in the hinge: of physics.usda as it is, of others by an over."""
    if file == P:
        return add(P, "            uniform token physics:axis", f"            {text}\n")
    if file == M:
        return (M, '            prepend apiSchemas = ["MjcJointAPI"]\n        )\n        {\n',
                '            prepend apiSchemas = ["MjcJointAPI"]\n        )\n        {\n'
                f"            {text}\n")
    return (file, 'over "thing"%s' % (" (" if file == N else "\n{\n"), "")


def over_joint(apis="", values=""):
    return f"""    over "joints"
    {{
        over "hinge" (
            prepend apiSchemas = [{apis}]
        )
        {{
            {values}
        }}
    }}
"""


def newton(text):
    return (N, '    over "foot"\n', text + '    over "foot"\n')


def physx(text):
    return (X, 'over "thing"\n{\n', 'over "thing"\n{\n' + text)


CUBE = ('        def Cube "cube" (\n            prepend apiSchemas = [%s]\n        )\n'
        "        {\n%s        }\n")
AT_FOOT = '        def Mesh "foot_shape"'
OPENPBR = """            token outputs:mtlx:surface.connect = </thing/Looks/grey/pbr.outputs:out>
            def Shader "pbr"
            {
                uniform token info:id = "ND_open_pbr_surface_surfaceshader"
                float inputs:base_weight = 1
%s                token outputs:out
            }
"""
MDL = """            token outputs:mdl:surface.connect = </thing/Looks/grey/mdl.outputs:out>
            def Shader "mdl"
            {
                uniform token info:implementationSource = "%s"
                uniform asset info:mdl:sourceAsset = @%s@
                uniform token info:mdl:sourceAsset:subIdentifier = "OmniPBR"
%s                token outputs:out
            }
"""
AT_SHADER = '            def Shader "surface"'
SPHERE = """        def Sphere "ball" (
            prepend apiSchemas = ["PhysicsCollisionAPI"]
        )
        {
            double radius = 0.1
            rel material:binding = </thing/Looks/grey>
            %s
            uniform token[] xformOpOrder = ["xformOp:scale"]
        }
"""
EVEN, UNEVEN = "float3 xformOp:scale = (2, 2, 2)", "float3 xformOp:scale = (2, 1, 1)"
SECOND = """        def PhysicsRevoluteJoint "second"
        {
            rel physics:body0 = </thing/foot>
            rel physics:body1 = </thing/arm>
            bool physics:excludeFromArticulation = %d
        }
"""

# code: (edits of the good asset, edits of the bad one)
ROBOT = {
    "BA.001": ([], [cut(P, '    prepend apiSchemas = ["PhysicsArticulationRootAPI"]\n')]),
    "DISP.001": ([], [cut(B, "            color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)]\n")]),
    "DISP.002": ([], [(B, "[(0.5, 0.5, 0.5)]", "[(2, 0.5, 0.5)]")]),
    "DISP.003": ([], [(B, "primvars:displayOpacity = [1]", "primvars:displayOpacity = [1, 1]")]),
    "DJ.001": ([add(P, f"        {HINGE}", MIMIC % (', "PhysicsDriveAPI:angular"',
                                                     GAINS % (10, 5)))],
               [add(P, f"        {HINGE}", MIMIC % (', "PhysicsDriveAPI:angular"',
                                                     GAINS % (0, 5)))]),
    "DJ.002": ([], [(P, ',\n                                  '
                        '"PhysicsJointStateAPI:angular"', "")]),
    "DJ.003": ([], [(P, "localPos0 = (0, 0, 1)", "localPos0 = (0, 0, 1.1)")]),
    "DJ.004": ([], [(P, '"PhysicsDriveAPI:angular",\n', "\n")]),
    "DJ.005": ([physx(over_joint('"PhysxJointAPI"', "float physxJoint:maxJointVelocity = 10"))],
               [physx(over_joint('"PhysxJointAPI"', "float physxJoint:maxJointVelocity = 0"))]),
    "DJ.006": ([], [(P, "stiffness = 100", "stiffness = 2e6")]),
    "DJ.007": ([add(P, f"        {HINGE}", MIMIC % ("", ""))],
               [add(P, f"        {HINGE}",
                    (MIMIC % ("", "")).replace("gearing = 1", "gearing = 0"))]),
    "DJ.008": ([], [(P, '"IsaacJointAPI"', '"IsaacOtherAPI"')]),
    "DJ.009": ([], [(B, '"IsaacLinkAPI"', '"IsaacOtherAPI"')]),
    "DJ.010": ([], [(R, "    prepend rel isaac:physics:robotLinks",
                     "    rel isaac:physics:robotLinks")]),
    "DJ.011": ([add(P, f"        {HINGE}", SECOND % 1)],
               [add(P, f"        {HINGE}", SECOND % 0)]),
    "HI.010": ([], [add(B, '    def Scope "joints"', '    over "nothing"\n    {\n    }\n')]),
    "ISA.001": ([], [(R, 'kind = "component"', 'kind = "group"')]),
    "JT.001": ([], [(P, "rel physics:body1 = </thing/foot>", "rel physics:body1")]),
    "JT.002": ([], [(P, "rel physics:body1 = </thing/arm>", "rel physics:body1 = </thing/leg>")]),
    "JT.003": ([], [(P, "rel physics:body1 = </thing/arm>",
                     "rel physics:body1 = [</thing/arm>, </thing/foot>]")]),
    "JT.ART.002": ([], [(P, '["PhysicsRigidBodyAPI", "PhysicsMassAPI"]',
                         '["PhysicsRigidBodyAPI", "PhysicsMassAPI", '
                         '"PhysicsArticulationRootAPI"]')]),
    "JT.ART.003": ([], [(P, '["PhysicsArticulationRootAPI"]\n)\n{\n',
                         '["PhysicsArticulationRootAPI", "PhysicsRigidBodyAPI"]\n)\n{\n'
                         "    bool physics:kinematicEnabled = 1\n")]),
    "JT.ART.004": ([], [(P, '["PhysicsArticulationRootAPI"]\n)\n{\n',
                         '["PhysicsArticulationRootAPI", "PhysicsRigidBodyAPI"]\n)\n{\n'
                         "    bool physics:rigidBodyEnabled = 0\n")]),
    "MUJOCO.BA.001": ([], [(M, 'over "thing"\n', 'over "thing" (\n    prepend apiSchemas = '
                            '["MjcArticulationRootAPI"]\n)\n')]),
    "MUJOCO.COL.001": ([], [(M, 'over "arm_shape" (\n            prepend apiSchemas = '
                             '["MjcCollisionAPI"]\n        )', 'over "arm_shape"')]),
    "MUJOCO.COL.002": ([], [(M, '"convexHull"', '"meshSimplification"')]),
    "MUJOCO.DJ.001": ([], [(M, 'over "hinge" (\n            prepend apiSchemas = ["MjcJointAPI"]\n'
                            "        )", 'over "hinge"')]),
    "MUJOCO.DJ.002": ([], [(M, "rel mjc:target = </thing/joints/hinge>",
                            "rel mjc:target = </thing/joints/hold>")]),
    "NEWTON.BA.001": ([], [cut(N, "    bool newton:selfCollisionEnabled = 0\n")]),
    "NEWTON.COL.001": ([], [(N, ', "NewtonMeshCollisionAPI"', "")]),
    "NEWTON.COL.002": ([(N, '"NewtonMeshCollisionAPI"]\n        )\n        {\n',
                         '"NewtonSDFCollisionAPI"]\n        )\n        {\n'
                         "            int newton:sdfMaxResolution = 64\n")],
                       [(N, '"NewtonMeshCollisionAPI"]\n        )\n        {\n',
                         '"NewtonSDFCollisionAPI"]\n        )\n        {\n'
                         "            int newton:sdfMaxResolution = 63\n")]),
    "NEWTON.DJ.001": ([], [cut(P, "            float drive:angular:physics:maxForce = 10\n")]),
    "NEWTON.DJ.002": ([newton(over_joint('"NewtonJointAPI"', "float newton:armature = 0.1"))],
                      [newton(over_joint('"NewtonJointAPI"', "float newton:armature = -1"))]),
    "NEWTON.DJ.003": ([newton(over_joint('"NewtonMimicAPI"',
                                         "rel newton:mimicJoint = </thing/joints/hold>"))],
                      [newton(over_joint('"NewtonMimicAPI"',
                                         "rel newton:mimicJoint = </thing/joints/hinge>"))]),
    "NEWTON.MAS.001": ([(N, '    over "foot"\n    {\n', '    over "foot" (\n        prepend '
                         'apiSchemas = ["NewtonMassAPI"]\n    )\n    {\n'
                         '        token newton:massModel = "solid"\n')],
                       [(N, '    over "foot"\n    {\n', '    over "foot" (\n        prepend '
                         'apiSchemas = ["NewtonMassAPI"]\n    )\n    {\n'
                         '        token newton:massModel = "hollow"\n')]),
    "NEWTON.MAT.001": ([], [(N, '    over "foot"\n    {\n', '    over "foot" (\n        prepend '
                             'apiSchemas = ["NewtonMaterialAPI"]\n    )\n    {\n')]),
    "PHYSX.COL.001": ([], [(B, 'def Xform "foot" (\n        prepend apiSchemas = ["IsaacLinkAPI"]',
                            'def Xform "foot" (\n        prepend apiSchemas = ["IsaacLinkAPI", '
                            '"PhysicsCollisionAPI"]')]),
    "PHYSX.COL.002": ([], [add(B, AT_FOOT, CUBE % ('"PhysicsCollisionAPI", '
                                                   '"PhysicsMeshCollisionAPI"', ""))]),
    "RB.001": ([], [(P, '"PhysicsRigidBodyAPI", ', "")]),
    "RB.003": ([], [add(P, '    over '
                           '"Looks"', '    def Scope "stuff" (\n        prepend apiSchemas '
                        '= ["PhysicsRigidBodyAPI"]\n    )\n    {\n    }\n')]),
    "RB.005": ([], [add(B, '    def Scope "joints"',
                        '    def Xform "shared" (\n        instanceable = true\n        references '
                        '= @./part.usda@\n    )\n    {\n    }\n'),
                    ("thing/any/payloads/part.usda", None,
                     '#usda 1.0\n(\n    defaultPrim = "part"\n)\ndef Xform "part"\n{\n    def '
                     'Xform '
                     '"body" (\n        prepend apiSchemas = ["PhysicsRigidBodyAPI"]\n    )\n    '
                     '{\n'
                     '    }\n}\n')]),
    "RB.007": ([], [(P, '"PhysicsRigidBodyAPI", "PhysicsMassAPI"', '"PhysicsRigidBodyAPI"')]),
    "RB.009": ([], [(B, 'def Xform "foot" (\n        prepend apiSchemas = ["IsaacLinkAPI"]\n    )\n'
                     "    "
                     "{\n", 'def Xform "foot" (\n        prepend apiSchemas = ["IsaacLinkAPI"]\n'
                     "    )\n    {\n        matrix4d xformOp:transform = ((1, 1, 0, 0), (0, 1, 0, "
                     "0), (0, 0, 1, 0), (0, 0, 0, 1))\n        uniform token[] xformOpOrder = "
                     '["xformOp:transform"]\n')]),
    "RB.011": ([], [(P, "float physics:mass = 1", "float physics:mass = 0")]),
    "RB.012": ([], [add(B, AT_FOOT, '        def Xform "inner"\n        {\n        }\n'),
                    (P, '    over "foot" (\n        prepend apiSchemas = ["PhysicsRigidBodyAPI", '
                     '"PhysicsMassAPI"]\n    )\n    {\n', '    over "foot" (\n        prepend '
                     'apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]\n    )\n    {\n     '
                     '   '
                     'over "inner" (\n            prepend apiSchemas = ["PhysicsRigidBodyAPI"]\n'
                     "        )\n        {\n        }\n")]),
    "RB.COL.001": ([], [(B, 'def Xform "foot" (\n        prepend apiSchemas = ["IsaacLinkAPI"]',
                         'def Xform "foot" (\n        prepend apiSchemas = ["IsaacLinkAPI", '
                         '"PhysicsCollisionAPI"]')]),
    "RB.COL.002": ([], [add(B, AT_FOOT, CUBE % ('"PhysicsCollisionAPI", '
                                                '"PhysicsMeshCollisionAPI"', ""))]),
    "RB.COL.003": ([add(B, AT_FOOT, SPHERE % EVEN)], [add(B, AT_FOOT, SPHERE % UNEVEN)]),
    "RB.COL.004": ([add(B, AT_FOOT, SPHERE % EVEN)], [add(B, AT_FOOT, SPHERE % UNEVEN)]),
    "RB.MB.001": ([], [(P, '    over "arm" (\n        prepend apiSchemas = '
                           '["PhysicsRigidBodyAPI", ',
                        '    over "arm" (\n        prepend apiSchemas = [')]),
    "RC.001": ([], [("thing/any/notes.txt", None, "a stray file\n")]),
    "RC.003": ([], [("move", "thing/any/", "thong/any/")]),
    "RC.004": ([], [(THUMB, None, None)]),
    "RC.005": ([], [add(B, '    def Scope "joints"', '    def Xform "mass"\n    {\n        float '
                        "physics:mass = 1\n    }\n")]),
    "RC.006": ([], [(R, '["IsaacRobotAPI", ', '["IsaacRobotAPI", "PhysxArticulationAPI", ')]),
    "RC.007": ([], [(R, '["IsaacRobotAPI", ', "[")]),
    "RC.008": ([], [(R, '"Manipulator"', '"Default"')]),
    "RC.009": ([], [(R, '"Manipulator"', '"Humanoid"')]),
    "RM.001": ([], [add(B, AT_SHADER, '            def Material "inner"\n            {\n'
                        "            }\n")]),
    "RM.002": ([], [add(B, '    def Scope "joints"', '    def Material "astray"\n    {\n    }\n')]),
    "ROS.001": ([add(B, '    def Scope "joints"', '    def OmniGraphNode "node"\n    {\n        '
                     'token node:type = "isaacsim.ros2.bridge.ROS2PublishClock"\n    }\n')], []),
    "RV.001": ([], [(R, 'string PhysX = "Disabled"', 'string PhysX = "Enabled"')]),
    "RV.002": ([], [(R, "physics/physx.usda", "other/physx.usda"),
                    ("thing/any/runnables/other/physx.usda", None, PHYSX)]),
    "RV.003": ([], [cut(R, told("PhysX"))]),
    "RV.004": ([], [(R, 'string Newton = "Disabled"', 'string Newton = "Enabled"')]),
    "RV.005": ([], [(R, "physics/newton.usda", "other/newton.usda"),
                    ("thing/any/runnables/other/newton.usda", None, NEWTON)]),
    "RV.006": ([], [cut(R, told("Newton"))]),
    "RV.007": ([], [(R, 'string MuJoCo = "Disabled"', 'string MuJoCo = "Enabled"')]),
    "RV.008": ([], [(R, "physics/mujoco.usda", "other/mujoco.usda"),
                    ("thing/any/runnables/other/mujoco.usda", None, MUJOCO)]),
    "RV.009": ([], [cut(R, told("MuJoCo"))]),
    "RV.010": ([], [(R, '"Disabled" {\n        }', '"Disabled" {\n            int stray = 1\n'
                     "        }")]),
    "RV.011": ([], [(R, '["IsaacRobotAPI", ', '["IsaacRobotAPI", "NewtonArticulationRootAPI", ')]),
    "AA.001": ([], [(B, "@../Textures/paint.png@", "@../Textures/paint.png@\n                asset "
                     "inputs:other = @Textures/paint.png@")]),
    "AA.002": ([], [(B, "@../Textures/paint.png@", "@../Textures/paint.obj@"),
                    ("thing/any/Textures/paint.obj", None, "v 0 0 0\n")]),
    "HI.001": ([], [(R, '\ndef Xform "thing"', '\ndef Xform "other"\n{\n}\n\ndef Xform "thing"')]),
    "HI.003": ([], [(R, 'def Xform "thing"', 'def Scope "thing"')]),
    "HI.004": ([], [cut(R, '    defaultPrim = "thing"\n')]),
    "UN.006": ([], [(R, 'upAxis = "Z"', 'upAxis = "Y"')]),
    "UN.007": ([], [(R, "metersPerUnit = 1", "metersPerUnit = 0.01")]),
    "SR.001": ([], [(R, '        string usd_date_generated = "2026-11-29"\n        dictionary',
                     "        dictionary")]),
    "SR.002": ([], [(THUMB, None, None)]),
    "SR.004": ([], [(R, '"Q42177"\n        int', '"42177"\n        int')]),
    "NP.002": ([], [("move", "thing/any/thing.usda", "thing/any/thing!.usda")]),
    "NP.003": ([], [("move", "thing/any/", "thing/any one/")]),
    "NP.005": ([], [("move", "thing/any/", "thong/any/")]),
    "NP.006": ([], [(R, "dictionary SimReady_Metadata", "dictionary Other_Metadata")]),
    "NP.007": ([], [(R, "        string asset_type", '        string place = "/tmp/thing"\n        '
                     "string asset_type")]),
    "NP.008": ([], [(B, "paint.png", "pint.png")]),
    "VG.002": ([], [(B, "[(0, 0, 0), (1, 1, 1)]", "[(0, 0, 0), (1, 1, 2)]")]),
    "VG.008": ([], [add(B, AT_FOOT, mesh("twin", 1))]),
    "VG.014": ([], [(B, "[3, 3, 3, 3]", "[3, 3, 3, 4]")]),
    "VG.025": ([], [add(R, "    token "
                           "isaac:robotType", "    double3 xformOp:translate = (1, 0, 0)\n"
                        '    uniform token[] xformOpOrder = ["xformOp:translate"]\n')]),
    "VG.027": ([], [(B, '            uniform token subdivisionScheme = "none"\n', "")]),
    "VG.028": ([], [(B, 'interpolation = "uniform"', 'interpolation = "faceVarying"')]),
    "VG.029": ([], [(B, "[0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]",
                     "[0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2]")]),
    "VG.MESH.001": ([], [(B, "def Mesh", "def Cube")]),
    "VM.BIND.001": ([], [(B, "rel material:binding = </thing/Looks/grey>",
                          "rel material:binding = </elsewhere/grey>")]),
    "VM.BIND.002": ([], [(B, "float inputs:roughness", "color3f inputs:roughness"),
                         (B, "inputs:roughness = 0.5", "inputs:roughness = (0, 0, 0)")]),
    "VM.MAT.001": ([], [cut(B, "            rel material:binding = </thing/Looks/grey>\n")]),
    "VM.MDL.001": ([add(B, AT_SHADER, MDL % ("sourceAsset", "OmniPBR.mdl", ""))],
                   [add(B, AT_SHADER, MDL % ("sourceAsset", "./nowhere.mdl", ""))]),
    "VM.MDL.002": ([add(B, AT_SHADER, MDL % ("sourceAsset", "OmniPBR.mdl", ""))],
                   [add(B, AT_SHADER, MDL % ("mdlMaterial", "OmniPBR.mdl", ""))]),
    "VM.MDL.003": ([add(B, AT_SHADER, MDL % ("sourceAsset", "OmniPBR.mdl", ""))], []),
    "VM.PBR.001": ([add(B, AT_SHADER, OPENPBR % "")], []),
    "VM.PBR.002": ([add(B, AT_SHADER, OPENPBR % "")],
                   [add(B, AT_SHADER, (OPENPBR % "").replace("base_weight = "
                                        "1", "base_weight = 2"))]),
    "VM.PBR.003": ([], [(B, "paint.outputs:rgb", "pint.outputs:rgb")]),
    "VM.PS.001": ([], [(B, '"sRGB"', '"linear"')]),
    "VM.PS.002": ([], [cut(B, "            token outputs:surface.connect = "
                           "</thing/Looks/grey/surface.outputs:surface>\n")]),
    "VM.TEX.001": ([], [("thing/any/Textures/paint.png", None,
                         png(20000))]),
    "VM.TEX.003": ([], [(B, '"sRGB"', '"raw"')]),
    "VM.TEX.004": ([add(B, AT_SHADER, OPENPBR % "")], [add(B, AT_SHADER, OPENPBR % (
        "                color3f inputs:base_color.connect = </thing/Looks/grey/paint.outputs:rgb>"
        "\n"))]),
    "VM.TEX.005": ([add(B, AT_SHADER, MDL % ("sourceAsset", "OmniPBR.mdl", ""))],
                   [add(B, AT_SHADER, MDL % ("sourceAsset", "OmniPBR.mdl",
                                             "                asset inputs:diffuse_texture = "
                                             "@../Textures/paint.png@ (\n                    "
                                             'colorSpace = "raw"\n                )\n'))]),
}
PROP = {
    "GSP.001": ([], [(B, '"grasp_identifier"', '"line"')]),
    "NVM.001": ([], [(B, '["none"]', '["shiny"]')]),
    "NVM.002": ([], [(B, '"steel"\n            token omni', '"cheese"\n            token omni')]),
    "NVM.003": ([], [(B, 'coating = "none"', 'coating = "sugar"')]),
    "NVM.004": ([], [add(B, "            token[] semantics:labels:material = [\"steel\"]\n       "
                            " }",
                         "            token omni:simready:nonvisual:base = \"steel\"\n")]),
    "NVM.006": ([], [(B, 'nonvisual:base = "steel"',
                      'nonvisual:base.timeSamples = {\n                0: "steel",\n            '
                      '}')]),
    "PMT.001": ([], [cut(B, "            rel material:binding:physics = "
                            "</thing/Looks/contact>\n")]),
    "SL.001": ([], [(R, ' "SemanticsLabelsAPI:class",\n                          '
                     '"SemanticsLabelsAPI:wikidata_qcode"', ""),
                    (B, f"            prepend apiSchemas = [{LABELLED}]\n", "")]),
    "SL.002": ([], [(R, "    token isaac:robotType", '    string semantic:a:params:semanticType = '
                     '"class"\n    string semantic:a:params:semanticData = "leg"\n    token '
                     "isaac:robotType"),
                    (R, '"SemanticsLabelsAPI:class"', '"SemanticsLabelsAPI:class", '
                                        '"SemanticsAPI:a"')]),
    "SL.003": ([], [cut(R, '    token[] semantics:labels:class = ["arm"]\n')]),
    "SL.MAT.001": ([], [(B, f"            prepend apiSchemas = [{LABELLED}]\n", "")]),
    "SL.QCODE.001": ([], [(R, '["Q42177"]', '["42177"]')]),
    "SL.TIME.001": ([], [(R, 'semantics:labels:class = ["arm"]',
                          'semantics:labels:class.timeSamples = {\n        0: ["arm"],\n    }')]),
}


def made(edits):
    files = dict(FILES)
    for file, old, new in edits:
        if file == "move":
            if not any(name.startswith(old) for name in files):
                raise ValueError(f"nothing is at {old}")
            files = {name.replace(old, new) if name.startswith(old) else name: text
                     for name, text in files.items()}
        elif old is None and new is None:
            del files[file]
        elif old is None:
            files[file] = new
        else:
            if old not in files[file]:
                raise ValueError(f"{file} has no {old!r}")
            files[file] = files[file].replace(old, new)
    return files


def assets():
    for kind, table in (("robot", ROBOT), ("prop", PROP)):
        for code, (good, bad) in sorted(table.items()):
            yield code, kind, True, made(good)
            yield code, kind, False, made(bad)


def main_file(files):
    """The asset of a set of files."""
    return next(name for name in files if name.count("/") == 2 and name.endswith(".usda"))
