#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon convert` on the robots in tests/convert/urdf and mjcf and on the shared hand.

    convert_robots.py ROOT TENON

The hand, where ../shared has it, is held to the numbers of its URDF as Python reads them.
"""

import base64
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import picture

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
URDF = ROOT / "tests/convert/urdf"
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
HAND = SHARED / "assets/inspire_hand_urdf/inspire_hand.urdf"
FLOAT = 2e-7  # relative rounding of floats, turned into radians

faults = []


def expect(what, found, wanted):
    if found != wanted:
        faults.append(f"{what}: {found!r}, expected {wanted!r}")


def near(what, found, wanted, tolerance):
    if not abs(found - wanted) <= tolerance:
        faults.append(f"{what}: {found!r}, expected {wanted!r}")


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                             check=False)
    return process.returncode, process.stdout, process.stderr


def convert(source, target, *options):
    """-> exit code, rules of the findings, the answer."""
    code, out, _ = tenon("convert", source, target, "--json", *options)
    answer = json.loads(out)
    rules = sorted(finding["rule"] for finding in answer["diagnostics"]
                   if finding["rule"] != "convert.self-collision")  # said of each URDF
    return code, rules, answer


def physics(asset):
    code, out, err = tenon("physics", asset, "--json")
    if code != 0:
        faults.append(f"{asset}: {err}")
        return {"bodies": [], "joints": [], "colliders": []}
    return json.loads(out)


def by_name(items):
    return {item["path"].rsplit("/", 1)[1]: item for item in items}


def check_every_joint(work):
    for schema in ("current", "legacy", "both"):
        for flat in ((), ("--flat",)):
            target = work / f"every_{schema}{len(flat)}.usda"
            code, _, _ = convert(URDF / "every_joint.urdf", target, "--schema", schema, *flat)
            expect(f"{target.name}: exit code", code, 0)
            scene = physics(target)
            joints = by_name(scene["joints"])
            expect("kinds", {name: joint["type"] for name, joint in joints.items()},
                   {"bolt": "fixed", "glide": "d6", "push": "prismatic", "roll": "revolute",
                    "shoulder": "spherical", "turn": "revolute"})
            near("turn upper", joints["turn"]["upper"], 2, FLOAT)
            near("push follows", joints["push"]["mimic"]["multiplier"], 0.1, FLOAT)
            near("push offset", joints["push"]["mimic"]["offset"], 0.05, FLOAT)
            bodies = by_name(scene["bodies"])
            expect("bodies", len(bodies), 8)
            near("loose", bodies["loose"]["position"][2], 3, 0)


def check_shapes(work):
    for ending in ("usda", "usdc", "usdz"):
        target = work / f"shapes.{ending}"
        code, rules, answer = convert(URDF / "shapes.urdf", target)
        # A package takes the texture in, from its place beside the description.
        expect(f"{target.name}: exit code", (code, rules),
               (0, ["convert.free-root"] + ["package.outside"] * (ending == "usdz")))
        expect("mesh files", answer["meshes"], 2)
        scene = physics(target)
        expect("colliders", len(scene["colliders"]), 5)  # the mesh has two materials
        code, text, _ = tenon("cat", target) if ending != "usdz" else (0, "", "")
        if ending == "usda":
            expect("texture is beside it", "@./shapes_images/stripes.png@" in text, True)
            expect("texture comes along", (work / "shapes_images/stripes.png").read_bytes(),
                   (URDF / "stripes.png").read_bytes())


def check_gazebo(work):
    """What Gazebo says of links: colours, friction, gravity, sensors; the rest is named."""
    target = work / "watcher.usda"
    code, rules, answer = convert(URDF / "gazebo.urdf", target)
    expect("gazebo: findings", (code, rules), (0, ["convert.free-root"] + ["urdf.extension"] * 3))
    said = " ".join(finding["message"] for finding in answer["diagnostics"])
    for left in ("skipped: maxVel", "skipped: provideFeedback", 'sensor "ping" (sonar)',
                 'sensor "scan" (gpu_ray) without its resolution, noise, update_rate, plugin'):
        expect(f"gazebo: {left}", left in said, True)
    scene = physics(target)
    expect("gazebo: gravity", {name: body["gravityScale"]
                               for name, body in by_name(scene["bodies"]).items()},
           {"base": 1, "head": 0})
    expect("gazebo: sensors", sorted(sensor["kind"] for sensor in scene["sensors"]),
           ["contact", "forceTorque", "imu", "rays"])
    near("gazebo: friction", max(m["dynamicFriction"] for m in scene["materials"]), 0.8, 1e-6)
    soft = max((m["compliance"] for m in scene["materials"]), key=lambda law: law["stiffness"])
    expect("gazebo: springs", (soft["stiffness"], soft["damping"]), (1e6, 100))
    text = target.read_text()
    for wanted in ('def Material "Orange"', 'def Camera "eye"', "clippingRange = (0.05, 20)",
                   "sensorPeriod = 0.005", "newton:contactStiffness = 1000000",
                   'def IsaacRaycastSensor "scan"', "maxRange = 30", "uint numRays = 3",
                   "rayDirections = [(0, -1, 0), (1, 0, 0), (0, 1, 0)]"):
        expect(f"gazebo: {wanted}", wanted in text, True)


def check_weightless(work):
    """MuJoCo's compensation of gravity there and back, kept and made anew."""
    source, target, back = work / "light.xml", work / "light.usda", work / "light_back.xml"
    source.write_text('<mujoco><worldbody><body name="b" pos="0 0 2" gravcomp="0.25"><freejoint/>'
                      '<geom name="g" size="0.1"/></body></worldbody></mujoco>')
    expect("weightless: exit code", convert(source, target)[0], 0)
    expect("weightless: scale", physics(target)["bodies"][0]["gravityScale"], 0.75)
    path = physics(target)["bodies"][0]["path"]
    for edit, wanted in (("tenon:gravityScale=0.5", 'gravcomp="0.5"'),
                         ("xformOp:translate=(0,0,1)", 'gravcomp="0.5"')):
        expect(edit, tenon("set", target, f"{path}.{edit}")[0], 0)
        expect("weightless: back", convert(target, back, "--force")[0], 0)
        expect(f"weightless: {edit}", wanted in back.read_text(), True)


def check_ellipsoid(work):
    """One that collides is a mesh that this program knows as an ellipsoid, there and back."""
    source, target, back = work / "egg.xml", work / "egg.usda", work / "egg_back.xml"
    source.write_text('<mujoco><worldbody><body name="b" pos="0 0 2"><freejoint/><geom name="e" '
                      'type="ellipsoid" size="0.1 0.2 0.3"/></body></worldbody></mujoco>')
    expect("egg: exit code", convert(source, target)[0], 0)
    rules = [finding["rule"] for finding in json.loads(tenon("check", target, "--json")[1])
             ["diagnostics"] if finding["severity"] != "info"]
    expect("egg: check", rules, [])
    scene = physics(target)
    collider = scene["colliders"][0]
    expect("egg: shape", (collider["shape"], collider["halfExtents"]),
           ("ellipsoid", [0.1, 0.2, 0.3]))
    text = target.read_text()
    expect("egg: normals of points", 'interpolation = "vertex"' in text, True)
    axes, (points, normals) = (0.1, 0.2, 0.3), (
        [[float(x) for x in row.split(",")] for row in re.findall(
            r"\(([^()]*)\)", re.search(rf" {name} = \[(.*?)\]", text)[1])]
        for name in ("points", "normals"))
    across = [[x / a ** 2 for x, a in zip(point, axes)] for point in points]
    near("egg: drawn round", max(abs(x / math.hypot(*row) - n) for row, normal in
                                 zip(across, normals, strict=True)
                                 for x, n in zip(row, normal)), 0, 1e-6)
    expect("egg: hull", 'physics:approximation = "convexHull"' in text, True)
    package = work / "egg"
    expect("egg: structure", tenon("structure", target, "-o", package)[0], 0)
    expect("egg: in the structure",
           physics(package / "egg.usda")["colliders"][0]["shape"], "ellipsoid")
    path = scene["bodies"][0]["path"]
    expect("egg: edit", tenon("set", target, f"{path}.xformOp:translate=(0,0,1)")[0], 0)
    expect("egg: back", convert(target, back)[0], 0)
    expect("egg: an ellipsoid again", back.read_text().count('type="ellipsoid"'), 1)


def check_physx_edits(work):
    """What is edited for PhysX alone is no part of a model for MuJoCo, which is said."""
    target, back = work / "for_physx.usda", work / "for_physx.xml"
    expect("physx: exit code", convert(ROOT / "tests/convert/mjcf/arm.xml", target)[0], 0)
    expect("physx: nothing is said", convert(target, back)[1].count("mjcf.left-out"), 0)
    path = by_name(physics(target)["joints"])["shoulder"]["path"]
    expect("physx: edit", tenon("set", target,
                                f"{path}.physxJointAxis:angular:armature=0.5")[0], 0)
    rules = convert(target, back, "--force")[1]
    expect("physx: said", (rules.count("mjcf.left-out"), rules.count("mjcf.written-anew")), (1, 0))


def check_large_arena(work):
    """Room that simulations are to have is no reason to refuse a model, and stays in it."""
    source, target, back = work / "room.xml", work / "room.usda", work / "room_back.xml"
    source.write_text('<mujoco><size memory="3G"/><worldbody><body name="b">'
                      '<freejoint/><geom size="0.1"/></body></worldbody></mujoco>')
    expect("room: exit code", convert(source, target)[0], 0)
    expect("room: back", convert(target, back)[0], 0)
    expect("room: stays", 'memory="3221225472"' in back.read_text(), True)


def check_bad_input(work):
    target = work / "bad.usda"
    for name, code, rule in (("cycle", 2, "robot.cycle"), ("missing_mesh", 1, "urdf.mesh-missing"),
                             ("not_a_number", 1, "robot.not-finite"),
                             ("no_inertial", 1, "convert.massless")):
        found, out, err = tenon("convert", URDF / f"{name}.urdf", target)
        expect(f"{name}: exit code", found, code)
        expect(f"{name}: says {rule}", f"[{rule}]" in err, True)
        expect(f"{name}: names the line", f"{name}.urdf:" in err, True)
    expect("no output folder", tenon("convert", URDF / "shapes.urdf", "/nowhere/x.usda")[0], 2)
    expect("bad gains", tenon("convert", URDF / "shapes.urdf", target, "--gains", "stiff")[0], 2)


def check_mjcf(work):
    """MJCF to an asset, back to MJCF, and again: bodies, masses, limits stay."""
    first, model, second = work / "arm.usda", work / "arm.xml", work / "again.usda"
    code, rules, _ = convert(ROOT / "tests/convert/mjcf/arm.xml", first)
    expect("arm: findings", (code, rules), (0, ["convert.floating", "mjcf.several-joints"]))
    scene = physics(first)
    bodies, joints = by_name(scene["bodies"]), by_name(scene["joints"])
    expect("arm: bodies", sorted(bodies), ["finger", "loose", "lower", "lower_elbow_y", "upper"])
    expect("arm: joints", sorted(joints), ["elbow_x", "elbow_y", "shoulder", "slide"])
    near("arm: upper limit", joints["shoulder"]["upper"], math.pi / 2, FLOAT * 2)
    near("arm: damping", joints["shoulder"]["damping"], 0.5, FLOAT)
    near("arm: stiffness", joints["shoulder"]["drives"][0]["stiffness"], 50, 1e-5)
    near("arm: law", joints["slide"]["mimic"]["multiplier"], 0.02, FLOAT)
    # 1000 kg/m^3 in 0.2 x 0.04 x 0.04 m
    near("arm: mass", bodies["lower"]["mass"], 0.32, 1e-6)
    expect("arm: back", convert(first, model)[0], 0)
    expect("arm: again", convert(model, second)[0], 0)
    again = physics(second)
    masses = sorted(round(body["mass"], 4) for body in scene["bodies"])
    expect("arm: masses again", sorted(round(body["mass"], 4) for body in again["bodies"]), masses)
    limits = sorted(round(joint["upper"], 4) for joint in joints.values()
                    if isinstance(joint["upper"], float))
    expect("arm: limits again",
           sorted(round(joint["upper"], 4) for joint in again["joints"]
                  if isinstance(joint["upper"], float)), limits)


def check_mujoco_parts(work):
    """Loops are joints beside the tree; motors, tendons and keyframes prims of MuJoCo's schemas."""
    target, package = work / "loop.usda", work / "loop"
    code, rules, _ = convert(ROOT / "tests/convert/mjcf/loop.xml", target)
    expect("loop: findings", (code, rules), (0, ["convert.floating", "mjcf.reference"]))
    scene = physics(target)
    joints, bodies = by_name(scene["joints"]), {b["path"]: b for b in scene["bodies"]}
    expect("loop: excluded", sorted(n for n, j in joints.items() if j["excludeFromArticulation"]),
           ["glue", "pin"])
    for x, end in zip((0.2, 0), ("0", "1")):
        near("loop: anchor", joints["pin"]["frame" + end]["position"][0], x, FLOAT)
    near("loop: weld", bodies[joints["glue"]["body1"]]["position"][2] -
         bodies[joints["glue"]["body0"]]["position"][2],
         joints["glue"]["frame0"]["position"][2] - joints["glue"]["frame1"]["position"][2], FLOAT)
    expect("loop: structure", tenon("structure", target, "-o", package)[0], 0)
    text = (package / "payloads/Physics/mujoco.usda").read_text()
    for wanted in ('def MjcTendon "rope"', "mjc:path:coef = [2, -1]", 'def MjcActuator "push"',
                   "mjc:gear = [4, 0, 0, 0, 0, 0]", "mjc:ctrl = [0, 0.5, 0]",
                   "mjc:qpos = [0.25, 0.1, 0, 0.4, 0, 1.5, 1, 0, 0, 0]", "mjc:torqueScale = 2",
                   "mjc:solref = [0.01, 1]"):
        expect(f"loop: {wanted}", wanted in text, True)


def check_mjcf_images(work):
    """Images of materials come along into the package; it is the same after `structure`."""
    source, package, again = work / "images", work / "images_package", work / "images_again"
    (source / "pictures").mkdir(parents=True)
    shutil.copy(ROOT / "tests/convert/mjcf/textured.xml", source)
    for name in ("paint", "rough", "wrapped"):
        picture.png(source / "pictures" / f"{name}.png", 4)
    code, rules, answer = convert(source / "textured.xml", f"{package}/")
    expect("images: findings", (code, rules), (0, ["mjcf.left-out"] * 3))
    expect("images: lines", [finding["line"] for finding in answer["diagnostics"]], [12, 13, 20])
    expect("images: files", sorted(path.name for path in (package / "Textures").iterdir()),
           ["paint.png", "rough.png", "wrapped.png"])
    text = (package / "payloads/materials.usda").read_text()
    for wanted in ("inputs:file = @../Textures/paint.png@", "inputs:scale = (2, 3)",
                   "ColorTexture.outputs:rgb>", "RoughnessTexture.outputs:r>",
                   "inputs:metallic = 0.25", 'def Material "painted"'):
        expect(f"images: {wanted}", wanted in text, True)
    interface = package / "textured.usda"
    expect("images: profile", tenon("check", interface, "--profile", "isaac-3.0")[0], 0)
    expect("images: structure", tenon("structure", interface, "-o", again)[0], 0)
    expect("images: same bytes", tree(again), tree(package))


def check_mjcf_world(work):
    """A model's world comes along when asked for; tendons go through, around and over pulleys."""
    source, package, again = ROOT / "tests/convert/mjcf/world.xml", work / "world", work / "world2"
    code, rules, answer = convert(source, f"{package}/")
    expect("world: findings", (code, rules), (0, ["convert.floating", "convert.scene",
                                                   "mjcf.reference"]))
    expect("world: listed", any("gravity, timestep, energy, warmstart" in finding["message"]
                                for finding in answer["diagnostics"]), True)
    expect("world: no scene", "PhysicsScene" in str(tree(package)), False)
    code, rules, _ = convert(source, f"{package}/", "--scene")
    expect("world: findings with it", (code, rules), (0, ["convert.floating", "mjcf.reference"]))
    interface = package / "world.usda"
    scene = json.loads(tenon("physics", interface, "--physics", "mujoco", "--json")[1])
    world = scene["scenes"][0]
    both, rope = sorted(scene["tendons"], key=lambda tendon: tendon["path"])
    near("world: step", world["timeStep"], 0.005, 0)
    for found, wanted in zip(world["gravity"], (0, 1.5, -3.7)):
        near("world: gravity", found, wanted, 1e-6)
    expect("world: solver", (world["mujoco"]["option:solver"], world["mujoco"]["flag:warmstart"],
                             world["mujoco"]["option:wind"]), ("cg", [0], [1, 0, 0.5]))
    expect("world: path", [wrap["kind"] for wrap in rope["wraps"]],
           ["site", "cylinder", "site", "sphere", "site", "pulley", "site", "site", "pulley",
            "site", "site"])
    expect("world: peg", (rope["wraps"][1]["attachment"]["body"], rope["wraps"][1]["radius"]),
           (None, 0.05))
    expect("world: side", rope["wraps"][3]["side"]["path"].endswith("/upper/beside"), True)
    expect("world: sum", (both["coefficients"], [j.rsplit("/")[-1] for j in both["joints"]]),
           ([0.5, -2], ["shoulder", "elbow"]))
    neutral = json.loads(tenon("physics", interface, "--physics", "physics", "--json")[1])
    expect("world: neutral", (len(neutral["tendons"]), neutral["scenes"][0].get("mujoco"),
                              neutral["scenes"][0]["timeStep"]), (0, None, 0.005))
    expect("world: profile", tenon("check", interface, "--profile", "isaac-3.0")[0], 0)
    expect("world: structure", tenon("structure", interface, "-o", again)[0], 0)
    expect("world: same bytes", tree(again), tree(package))


def check_gltf_images(work):
    """Images inside of a mesh file become files of the asset; those beside it come along."""
    source, package, flat = work / "gltf", work / "gltf_package", work / "gltf_flat.usda"
    source.mkdir()
    picture.png(source / "rough.png", 2)
    picture.png(source / "inner.png", 4)
    inner = base64.b64encode((source / "inner.png").read_bytes()).decode()
    points = struct.pack("<15f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1)
    (source / "part.gltf").write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1},
                                    "material": 0}]}],
        "materials": [{"name": "paint", "pbrMetallicRoughness": {
            "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}}}],
        "textures": [{"source": 0}, {"source": 1}],
        "images": [{"uri": f"data:image/png;base64,{inner}"}, {"uri": "rough.png"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36},
                        {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
        "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(points).decode()}]}))
    (source / "robot.urdf").write_text(
        '<robot name="r"><link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" '
        'ixz="0" iyy="1" iyz="0" izz="1"/></inertial><visual><geometry><mesh '
        'filename="part.gltf"/></geometry></visual></link></robot>')
    code, rules, _ = convert(source / "robot.urdf", f"{package}/")
    if "convert.mesh-unreadable" in rules:
        print("without assimp")
        return
    expect("gltf: findings", (code, rules), (0, ["convert.free-root"]))
    files = tree(package)
    expect("gltf: inner", files.get("Textures/part_0.png"), (source / "inner.png").read_bytes())
    expect("gltf: beside", files.get("Textures/rough.png"), (source / "rough.png").read_bytes())
    text = files["payloads/materials.usda"].decode()
    for wanted in ("inputs:file = @../Textures/part_0.png@", "outputs:g>", "outputs:b>"):
        expect(f"gltf: {wanted}", wanted in text, True)
    expect("gltf: as a layer", convert(source / "robot.urdf", flat)[0], 0)
    expect("gltf: its image", (work / "gltf_flat_images/part_0.png").read_bytes(),
           (source / "inner.png").read_bytes())
    expect("gltf: its path", "@./gltf_flat_images/part_0.png@" in flat.read_text(), True)
    packed = work / "gltf_packed"
    packed.mkdir()
    expect("gltf: as a package", convert(source / "robot.urdf", packed / "robot.usdz")[0], 0)
    expect("gltf: and nothing beside it", list(tree(packed)), ["robot.usdz"])
    expect("gltf: unpacked", tenon("zip", packed / "robot.usdz", "--extract", work / "un")[0], 0)
    expect("gltf: in the package", tree(work / "un").get("robot_images/part_0.png"),
           (source / "inner.png").read_bytes())
    expect("gltf: structure", tenon("structure", flat, "-o", work / "gltf_again")[0], 0)


def tree(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes()
            for path in folder.rglob("*") if path.is_file()}


def numbers(element, attribute, count=3):
    text = element.get(attribute) if element is not None else None
    return [float(word) for word in text.split()] if text else [0.0] * count


def check_hand(work):
    if not HAND.exists():
        print(f"without the hand: {HAND} is not there")
        return
    target = work / "hand.usda"
    code, rules, _ = convert(HAND, target)
    expect("hand: findings", (code, rules), (0, ["convert.static-root", "urdf.extension"]))
    scene = physics(target)
    bodies, joints = by_name(scene["bodies"]), by_name(scene["joints"])
    robot = xml.etree.ElementTree.parse(HAND).getroot()
    expect("hand: bodies, joints, colliders",
           (len(bodies), len(joints), len(scene["colliders"])), (13, 13, 13))
    for link in robot.findall("link"):
        inertial = link.find("inertial")
        if inertial is None:
            continue
        body, name = bodies[link.get("name")], link.get("name")
        mass = float(inertial.find("mass").get("value"))
        near(f"{name}: mass", body["mass"], mass, FLOAT * mass)
        inertia = inertial.find("inertia")
        for row, a in enumerate("xyz"):
            for column, b in enumerate("xyz"):
                wanted = float(inertia.get("i" + "".join(sorted(a + b))))
                expect(f"{name}: i{a}{b}", body["inertia"][3 * row + column], wanted)
        for found, wanted in zip(body["centerOfMass"], numbers(inertial.find("origin"), "xyz")):
            near(f"{name}: centre", found, wanted, 1e-8)
    mimics = 0
    for source in robot.findall("joint"):
        name, found = source.get("name"), joints[source.get("name")]
        limit, mimic = source.find("limit"), source.find("mimic")
        if limit is None:
            expect(f"{name}: kind", found["type"], "fixed")
            continue
        for end in ("lower", "upper"):
            wanted = float(limit.get(end))
            near(f"{name}: {end}", found[end], wanted, FLOAT * max(1, abs(wanted)))
        near(f"{name}: velocity", found["velocityLimit"], 0.5, FLOAT)
        if mimic is not None:
            mimics += 1
            law = found["mimic"]
            expect(f"{name}: leader", law["leader"].rsplit("/", 1)[1], mimic.get("joint"))
            near(f"{name}: multiplier", law["multiplier"], float(mimic.get("multiplier")), FLOAT)
            expect(f"{name}: offset", law["offset"], 0.0)
    expect("hand: mimics", mimics, 6)
    check_in_openusd(target)


def check_in_openusd(target):
    """What OpenUSD's own physics parser finds in the hand."""
    try:
        from pxr import Usd, UsdPhysics
    except ImportError:
        print("without usd-core")
        return
    stage = Usd.Stage.Open(str(target))
    found = UsdPhysics.LoadUsdPhysicsFromRange(stage, [stage.GetPseudoRoot().GetPath()])
    kinds = {str(kind).rsplit(".", 1)[-1]: len(paths) for kind, (paths, _) in found.items()}
    expect("OpenUSD finds", kinds, {"RigidBody": 13, "MeshShape": 13, "RevoluteJoint": 12,
                                    "FixedJoint": 1, "Articulation": 1})
    expect("OpenUSD composes", stage.GetCompositionErrors(), [])


def main():
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        check_every_joint(work)
        check_shapes(work)
        check_gazebo(work)
        check_weightless(work)
        check_large_arena(work)
        check_ellipsoid(work)
        check_physx_edits(work)
        check_bad_input(work)
        check_mjcf(work)
        check_mjcf_images(work)
        check_gltf_images(work)
        check_mjcf_world(work)
        check_mujoco_parts(work)
        check_hand(work)
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
