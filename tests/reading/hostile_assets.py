# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Assets that name a file, in every place that can name one, and ways to write its path."""

import base64
import struct
import zlib

MARK = "CANARY-7391463"
NUMBER = 0.7391463  # as a coordinate of meshes and a colour


def png():
    """A picture of one pixel that says the mark in a comment."""
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
            + chunk(b"tEXt", b"Comment\0" + MARK.encode())
            + chunk(b"IDAT", zlib.compress(b"\0\1\2\3")) + chunk(b"IEND", b""))


OBJ = (f"v {NUMBER} 0 0\nv 0 {NUMBER} 0\nv 0 0 {NUMBER}\nv 0 0 0\n"
       "f 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n")
LAYER = ('#usda 1.0\n(\n    defaultPrim = "S"\n)\ndef Xform "S" (\n    prepend apiSchemas = '
         f'["PhysicsRigidBodyAPI"]\n)\n{{\n    string told = "{MARK}"\n'
         f'    double x.timeSamples = {{ 1: {NUMBER}, 2: {NUMBER} }}\n}}\n')
DAE = """<?xml version="1.0"?><COLLADA version="1.4.1"><asset><up_axis>Z_UP
</up_axis></asset><library_images><image
id="i"><init_from>%s</init_from></image></library_images><library_effects><effect
id="e"><profile_COMMON><newparam sid="s"><surface
type="2D"><init_from>i</init_from></surface></newparam><newparam sid="t">
<sampler2D><source>s</source></sampler2D></newparam><technique sid="c"><phong><diffuse> <texture
texture="t"
texcoord="U"/></diffuse></phong></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="12">0 0 0 1
0 0 0 1 0 0 0 1</float_array><technique_common><accessor source="#a" count="4" stride="3"><param
name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4" material="mm"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1
3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>
<visual_scene id="w"><node id="n"><instance_geometry url="#g"><bind_material><technique_common>
<instance_material symbol="mm"
target="#m"/></technique_common></bind_material></instance_geometry></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene
url="#w"/></scene></COLLADA>
"""
CORNERS = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
INDICES = struct.pack("<12H", 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3)
GLTF = """{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
 "material": 0}]}], "buffers": [{"%(key)s": "%(buffer)s", "byteLength": 72}],
 "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
 {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
 "min": [0, 0, 0], "max": [1, 1, 1]},
 {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
 "images": [{"uri": "%(image)s"}], "textures": [{"source": 0}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]}"""
INLINE = "data:application/octet-stream;base64," + base64.b64encode(CORNERS + INDICES).decode()


def gltf(buffer=INLINE, image="none.png", key="uri"):
    return GLTF % {"buffer": buffer, "image": image, "key": key}


def glb(text):
    data = text.encode() + b" " * (-len(text) % 4)
    return (b"glTF" + struct.pack("<II", 2, 20 + len(data)) + struct.pack("<I", len(data))
            + b"JSON" + data)


def secrets():
    """Name -> contents of what lies outside: each is valid as what it is called."""
    lines = OBJ.splitlines()
    stl = "solid s\n" + "".join(
        "facet normal 0 0 1\nouter loop\n" + "".join(f"vertex{line[1:]}\n" for line in lines[:3])
        + "endloop\nendfacet\n" for _ in range(4)) + "endsolid\n"
    return {
        "s.txt": MARK + "\n", "s.png": png(), "s.1001.png": png(), "s.obj": OBJ, "s.stl": stl,
        "s.mtl": f"newmtl m\nKd {NUMBER} 0 0\nmap_Kd s.png\n", "s.usda": LAYER,
        "s.001.usda": LAYER, "s.mdl": f"mdl 1.0;\n// {MARK}\n", "s.dae": DAE % "s.png",
        "s.gltf": gltf(image="s.png"),
        "s.bin": struct.pack("<12f", *[NUMBER] * 3, 1, 0, 0, 0, 1, 0, 0, 0, 1) + INDICES,
        "s.xml": f'<mujocoinclude><worldbody><body name="{MARK}"><geom size="{NUMBER}"/></body>'
                 "</worldbody></mujocoinclude>",
        "m.xml": f'<mujoco><worldbody><body name="{MARK}"><geom size="{NUMBER}"/></body>'
                 "</worldbody></mujoco>",
        "h.bin": struct.pack("<ii4f", 2, 2, NUMBER, 0, 0, 1),
        "k.skn": struct.pack("<4i", 0, 0, 0, 0) + MARK.encode(),
    }


# How a path is written: its name -> (folder of the asset, name of the secret) -> path.
def link_to(folder, name):
    place = folder / f"link_{name}"
    if not place.is_symlink():
        place.symlink_to(folder.parent / "secret" / name)
    return f"./{place.name}"


def through_folder(folder, name):
    place = folder / "others"
    if not place.is_symlink():
        place.symlink_to(folder.parent / "secret")
    return f"./others/{name}"


KINDS = {
    "relative": lambda folder, name: f"../secret/{name}",
    "absolute": lambda folder, name: f"{folder.parent}/secret/{name}",
    "file URI": lambda folder, name: f"file://{folder.parent}/secret/{name}",
    "file URI of a host":
        lambda folder, name: "file:" + f"//localhost{folder.parent}/secret/{name}",
    "percent signs": lambda folder, name: f"file://{folder.parent}/%73ecret/{name}",
    "down and up": lambda folder, name: f"./sub/../../secret/{name}",
    "link": link_to,
    "linked folder": through_folder,
}

# Places in assets: what stands where the path is -> the text; {} is the path.
SHADER = ('    def Material "M"\n    {\n        token outputs:surface.connect = '
          '</A/M/T.outputs:rgb>\n        def Shader "T"\n        {\n%s\n        }\n    }\n')
MESH = """    def Mesh "Box" (prepend apiSchemas = ["MaterialBindingAPI", "PhysicsCollisionAPI"])
    {
        rel material:binding = </A/M>
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (0, 1), (0, 0), (1, 0), (0, 1), (0, 0), (1, 0),
            (0, 1), (0, 0), (1, 0), (0, 1)] (
            interpolation = "faceVarying"
        )
    }
"""


def usd(inside="", arcs="", head="", more=""):
    return ('#usda 1.0\n(\n    defaultPrim = "A"\n    metersPerUnit = 1\n    upAxis = "Z"\n'
            f'{head})\ndef Xform "A" (\n    prepend apiSchemas = ["PhysicsRigidBodyAPI"]\n'
            f'{arcs})\n{{\n'
            f"{MESH}{inside}}}\n{more}")


def texture(path):
    return usd(SHADER % ('            uniform token info:id = "UsdUVTexture"\n'
                         f"            asset inputs:file = @{path}@\n"
                         "            float3 outputs:rgb"))


def preview(path):
    """A texture that exports to MuJoCo's format take along."""
    return usd(f"""    def Material "M"
    {{
        token outputs:surface.connect = </A/M/P.outputs:surface>
        def Shader "P"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor.connect = </A/M/T.outputs:rgb>
            token outputs:surface
        }}
        def Shader "T"
        {{
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @{path}@
            float3 outputs:rgb
        }}
    }}
""")


def clips(**fields):
    text = "".join(f"                {line}\n" for line in fields["lines"])
    return usd(arcs="    clips = {\n            dictionary default = {\n" + text
               + '                string primPath = "/S"\n'
               "                double2[] active = [(0, 0)]"
               "\n                double2[] times = [(0, 0), (1, 1)]\n            }\n    }\n")


VALUES = {  # place: (the secret that fits, text of the asset)
    "texture": ("s.png", texture),
    "text as a texture": ("s.txt", texture),
    "texture of a surface": ("s.png", preview),
    "module": ("s.mdl", lambda path: usd(SHADER % (
        '            uniform token info:implementationSource = "sourceAsset"\n'
        f"            uniform asset info:mdl:sourceAsset = @{path}@"))),
    "list": ("s.png", lambda path: usd(f"    asset[] many = [@{path}@, @none.png@]\n")),
    "samples": ("s.png", lambda path: usd(f"    asset a.timeSamples = {{ 1: @{path}@ }}\n")),
    "metadata": ("s.png", lambda path: usd(arcs=f"    customData = {{\n        asset a = @{path}@\n"
                                                "    }\n")),
    "asset info": ("s.usda", lambda path: usd(
        arcs=f"    assetInfo = {{\n        asset identifier = @{path}@\n    }}\n")),
    "tiles": ("s.<UDIM>.png", texture),
    "light": ("s.png", lambda path: usd(
        f'    def DomeLight "L"\n    {{\n        asset inputs:texture:file = @{path}@\n    }}\n')),
    "file in a package": ("p.usdz[s.png]", texture),
}
ARCS = {
    "sublayer": lambda path: usd(head=f"    subLayers = [@{path}@]\n"),
    "reference": lambda path: usd(f'    def "R" (references = @{path}@)\n    {{\n    }}\n'),
    "payload": lambda path: usd(f'    def "R" (payload = @{path}@)\n    {{\n    }}\n'),
    "clips": lambda path: clips(lines=[f"asset[] assetPaths = [@{path}@]"]),
    "manifest of clips": lambda path: clips(
        lines=["asset[] assetPaths = [@./own.usda@]", f"asset manifestAssetPath = @{path}@"]),
    "expression": lambda path: usd(
        f'    def "R" (references = @`"${{WHERE}}"`@)\n    {{\n    }}\n',
        head=f'    expressionVariables = {{\n        string WHERE = "{path}"\n    }}\n'),
    "variant": lambda path: usd(
        arcs='    variantSets = "v"\n    variants = {\n        string v = "x"\n    }\n',
        inside=f'    variantSet "v" = {{\n        "x" (payload = @{path}@) {{\n        }}\n'
               "    }\n"),
}


def template(folder_path):
    return clips(lines=[f'string templateAssetPath = "{folder_path}/s.###.usda"',
                        "double templateStartTime = 1", "double templateEndTime = 1",
                        "double templateStride = 1"]).replace(
        "                double2[] active = [(0, 0)]\n", "").replace(
        "                double2[] times = [(0, 0), (1, 1)]\n", "")


# Robots: what the description or a file that it names says.
LINK = ('<robot name="r"><link name="l"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"'
        ' ixy="0" ixz="0" iyz="0"/></inertial><visual><geometry>{}</geometry>{}</visual>'
        '<collision><geometry><box size="1 1 1"/></geometry></collision></link></robot>')
OWN_OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nusemtl m\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\n"


def shown(mesh, material=""):
    return LINK.format(f'<mesh filename="{mesh}"/>', material)


def painted(path):
    return LINK.format('<mesh filename="own.obj"/>',
                       f'<material name="m"><texture filename="{path}"/></material>')


def model(assets="", body='<geom size="0.1"/>', compiler="", more=""):
    return (f"<mujoco>{compiler}{more}<asset>{assets}</asset><worldbody><body>{body}</body>"
            "</worldbody></mujoco>")


def escaped(path):
    return "".join(f"&#{ord(c)};" for c in path)


ROBOTS = {  # place: (secret, {file: its text}); the first file is the description
    "URDF mesh": ("s.obj", lambda p: {"r.urdf": shown(p)}),
    "URDF mesh of triangles": ("s.stl", lambda p: {"r.urdf": shown(p)}),
    "URDF scene": ("s.dae", lambda p: {"r.urdf": shown(p)}),
    "URDF texture": ("s.png", lambda p: {"r.urdf": painted(p), "own.obj": OWN_OBJ}),
    "URDF text as a texture": ("s.txt", lambda p: {"r.urdf": painted(p), "own.obj": OWN_OBJ}),
    "OBJ library": ("s.mtl", lambda p: {"r.urdf": shown("o.obj"),
                                        "o.obj": f"mtllib {p}\n{OWN_OBJ}"}),
    "OBJ image": ("s.png", lambda p: {"r.urdf": shown("o.obj"), "o.obj": f"mtllib o.mtl\n{OWN_OBJ}",
                                      "o.mtl": f"newmtl m\nmap_Kd {p}\n"}),
    "OBJ text as an image": ("s.txt", lambda p: {
        "r.urdf": shown("o.obj"), "o.obj": f"mtllib o.mtl\n{OWN_OBJ}",
        "o.mtl": f"newmtl m\nmap_Kd {p}\n"}),
    "DAE image": ("s.png", lambda p: {"r.urdf": shown("d.dae"), "d.dae": DAE % p}),
    "glTF image": ("s.png", lambda p: {"r.urdf": shown("g.gltf"), "g.gltf": gltf(image=p)}),
    "glTF buffer": ("s.bin", lambda p: {"r.urdf": shown("g.gltf"), "g.gltf": gltf(buffer=p)}),
    "glTF buffer, escaped": ("s.bin", lambda p: {
        "r.urdf": shown("g.gltf"), "g.gltf": gltf(buffer=p.replace("/", "\\/"), key="\\u0075ri")}),
    "GLB buffer": ("s.bin", lambda p: {"r.urdf": shown("g.glb"), "g.glb": glb(gltf(buffer=p))}),
}
MODELS = {
    "MJCF include": ("s.xml", lambda p: {"r.xml": model(more=f'<include file="{p}"/>')}),
    "MJCF include, escaped": ("s.xml", lambda p: {"r.xml": model(
        more=f'<include file="{escaped(p)}"/>')}),
    "MJCF include of an include": ("s.xml", lambda p: {
        "r.xml": model(more='<include file="own.xml"/>'),
        "own.xml": f'<mujocoinclude><include file="{p}"/></mujocoinclude>'}),
    "MJCF mesh": ("s.obj", lambda p: {"r.xml": model(
        f'<mesh name="m" file="{p}"/>', '<geom type="mesh" mesh="m"/>')}),
    "MJCF texture": ("s.png", lambda p: {"r.xml": model(
        f'<mesh name="m" file="own.obj"/><texture name="t" type="2d" file="{p}"/>'
        '<material name="m" texture="t"/>', '<geom type="mesh" mesh="m" material="m"/>'),
        "own.obj": OWN_OBJ}),
    "MJCF side of a cube": ("s.png", lambda p: {"r.xml": model(
        f'<texture name="t" type="cube" fileup="{p}"/><material name="m" texture="t"/>',
        '<geom size="0.1" material="m"/>')}),
    "MJCF height field": ("h.bin", lambda p: {"r.xml": model(
        f'<hfield name="h" file="{p}" size="1 1 1 1"/>', '<geom type="hfield" hfield="h"/>')}),
    "MJCF skin": ("k.skn", lambda p: {"r.xml": model(more="", body='<geom size="0.1"/>').replace(
        "</asset>", f'<skin name="k" file="{p}"/></asset>')}),
    "MJCF model": ("m.xml", lambda p: {"r.xml": model(
        f'<model name="m" file="{p}"/>', '<geom size="0.1"/><attach model="m" prefix="x"/>')}),
}
MODEL_KINDS = ("relative", "absolute", "link")


def folders(tree):
    """A model whose <compiler> says where its files are."""
    return {
        "MJCF meshdir": model('<mesh name="m" file="s.obj"/>', '<geom type="mesh" mesh="m"/>',
                              f'<compiler meshdir="{tree}"/>'),
        "MJCF texturedir": model('<texture name="t" type="cube" file="s.png"/>'
                                 '<material name="m" texture="t"/>',
                                 '<geom size="0.1" material="m"/>',
                                 f'<compiler texturedir="{tree}"/>'),
        "MJCF assetdir": model('<mesh name="m" file="s.obj"/>', '<geom type="mesh" mesh="m"/>',
                               f'<compiler assetdir="{tree}"/>'),
        "MJCF plugin": model(more='<extension><plugin plugin="mujoco.sdf.x"><instance name="i">'
                             f'<config key="file" value="{tree}/s.obj"/></instance></plugin>'
                             "</extension>"),
    }
