#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Assets for other programs: SDF, SRDF, ros2_control, Isaac Lab, mjlab and MJCF with mesh files.

    ways_out.py ROOT TENON [--installed] [ROBOT...]

The robots are those of tests/convert and examples, or the files named, or with --installed all
URDF robots of packages in the Python that runs this (requirements-sdf.txt). SDF is read again, and
bodies are where they were at random coordinates, within the rounding of USD's floats. The
configurations in Python are executed with stand-ins of their packages, which take no argument that
the packages do not have, and their numbers are those of `tenon physics`.
"""

import json
import math
import pathlib
import random
import re
import subprocess
import sys
import sysconfig
import tempfile
import types
import xml.etree.ElementTree as xml

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
PACKAGES = ("cmeel.prefix/share/example-robot-data", "airo_models", "upkie_description")
NEAR = 5e-7  # floats of USD, through degrees and a turned frame
ROBOTS = [ROOT / "examples/inspire_hand/inspire_hand.usda",
          ROOT / "tests/convert/urdf/every_joint.urdf", ROOT / "tests/convert/urdf/shapes.urdf",
          ROOT / "tests/convert/urdf/three_fingers.urdf", ROOT / "tests/convert/sdf/arm.sdf",
          ROOT / "tests/convert/sdf/joints.sdf", ROOT / "tests/convert/mjcf/arm.xml"]
# Arguments of the classes, of Isaac Lab 2.3 and 3.0 and mjlab 1.6.
LAB = {"joint_names_expr", "stiffness", "damping", "armature", "friction", "dynamic_friction",
       "viscous_friction"}
LIMITS = {2: {"effort_limit_sim", "velocity_limit_sim"},
          3: {"joint_effort_limit", "joint_velocity_limit"}}
ARTICULATION = {"spawn", "init_state", "actuators"}
STATE = {"pos", "rot", "joint_pos", "joint_vel"}

faults = []


def expect(what, good, said=""):
    if not good:
        faults.append(f"{what}: {said}" if said != "" else what)


def tenon(*arguments):
    done = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True, text=True,
                          check=False, timeout=300)
    try:
        return done.returncode, json.loads(done.stdout)
    except ValueError:
        return done.returncode, {"diagnostics": [{"rule": "", "message": done.stderr}]}


def near(found, wanted):
    if found is None or wanted is None:
        return found is wanted
    return abs(found - wanted) <= NEAR * max(1, abs(wanted))


# --- places -------------------------------------------------------------------------------------


def times(a, b):
    w, x, y, z = a
    v, p, q, r = b
    return (w * v - x * p - y * q - z * r, w * p + x * v + y * r - z * q,
            w * q - x * r + y * v + z * p, w * r + x * q - y * p + z * v)


def turned(q, v):
    w = times(times(q, (0, *v)), (q[0], -q[1], -q[2], -q[3]))
    return w[1:]


def joined(a, b):
    place = turned(a[1], b[0])
    return tuple(x + y for x, y in zip(a[0], place)), times(a[1], b[1])


def undone(a):
    back = (a[1][0], -a[1][1], -a[1][2], -a[1][3])
    return tuple(-x for x in turned(back, a[0])), back


def pose_of(data):
    q = data["orientation"]
    size = math.sqrt(sum(x * x for x in q))
    return tuple(data["position"]), tuple(x / size for x in q)


class Places:
    """Where bodies are, by the joints of `tenon physics`."""

    def __init__(self, asset):
        self.code, self.scene = tenon("physics", asset)
        self.joints = [j for j in self.scene["joints"] if not j["excludeFromArticulation"]]

    def names(self):
        return sorted(j["path"].rpartition("/")[2] for j in self.joints
                      if j["type"] in ("revolute", "prismatic"))

    def value(self, joint, coordinates):
        """Its coordinate: given, or that of what it follows, which may follow another itself."""
        for mimic in joint.get("mimics", []):
            [leader] = [j for j in self.joints if j["path"] == mimic["leader"]]
            return mimic["offset"] + mimic["multiplier"] * self.value(leader, coordinates)
        return coordinates.get(joint["path"].rpartition("/")[2], 0.0)

    def motion(self, joint, coordinates):
        value = self.value(joint, coordinates)
        axis = [float(c == (joint.get("axis") or "X").upper()) for c in "XYZ"]
        if joint["type"] == "prismatic":
            return tuple(x * value for x in axis), (1, 0, 0, 0)
        if joint["type"] == "revolute":
            half = math.sin(value / 2)
            return (0, 0, 0), (math.cos(value / 2), *(x * half for x in axis))
        return (0, 0, 0), (1, 0, 0, 0)

    def at(self, coordinates):
        placed = {None: ((0, 0, 0), (1, 0, 0, 0))}
        waiting = list(self.joints)
        children = {j["body1"] for j in waiting}
        for body in self.scene["bodies"]:
            if body["path"] not in children:
                placed[body["path"]] = pose_of(body)
        while waiting:
            ready = [j for j in waiting if j["body0"] in placed]
            if not ready:
                break
            for joint in ready:
                frame = joined(joined(placed[joint["body0"]], pose_of(joint["frame0"])),
                               self.motion(joint, coordinates))
                placed[joint["body1"]] = joined(frame, undone(pose_of(joint["frame1"])))
                waiting.remove(joint)
        return {path.rpartition("/")[2]: pose for path, pose in placed.items() if path}


def apart(a, b):
    size = max(1, math.sqrt(sum(x * x for x in a[0])))
    place = math.sqrt(sum((x - y) ** 2 for x, y in zip(a[0], b[0]))) / size
    turn = times((a[1][0], -a[1][1], -a[1][2], -a[1][3]), b[1])
    return max(place, 2 * math.asin(min(1, math.sqrt(sum(x * x for x in turn[1:])))))


# --- SDF ----------------------------------------------------------------------------------------


def check_sdf(name, asset, work, dice):
    file = work / "out.sdf"
    code, answer = tenon("convert", asset, file)
    if code != 0:
        expect(f"{name}: SDF", False, answer["diagnostics"][-1:])
        return 0.0
    model = xml.parse(file).getroot().find("model")
    for part in ("link", "joint"):
        expect(f"{name}: number of {part}s", answer[part + "s"] == len(model.findall(part)),
               (answer[part + "s"], len(model.findall(part))))
    for uri in model.iter("uri"):
        expect(f"{name}: the mesh {uri.text} is there", (work / uri.text).exists())
    before = Places(asset)
    driven = [j["path"] for j in before.scene["joints"]
              if any(d["stiffness"] or d["damping"] for d in j.get("drives", []))]
    told = [d["prim"] for d in answer["diagnostics"] if d["rule"] == "sdf.left-out"
            and "drive" in d["message"]]
    expect(f"{name}: drives that SDF lacks are told", set(driven) >= set(told) and
           bool(driven) == bool(told), (driven, told))
    again = work / "again.usda"
    code, back = tenon("convert", file, again)
    if code not in (0, 1):
        expect(f"{name}: SDF is read again", False, back["diagnostics"][-1:])
        return 0.0
    return compare_places(name, before, Places(again), dice)


def compare_places(name, before, after, dice):
    """A joint with the name of a link has another one in SDF, which says so (sdf.replaced)."""
    worst = 0.0
    there = set(after.names())
    shown = {joint: joint if joint in there else f"{joint}_joint" for joint in before.names()}
    masses = {b["path"].rpartition("/")[2]: b for b in after.scene["bodies"]}
    for _ in range(3):
        coordinates = {joint: dice.uniform(-1, 1) for joint in before.names()}
        found = after.at({shown[joint]: value for joint, value in coordinates.items()})
        for body, pose in before.at(coordinates).items():
            if body not in found:
                expect(f"{name}: the body {body} comes back", False, sorted(found))
                return worst
            worst = max(worst, apart(pose, found[body]))
    for body in before.scene["bodies"]:
        other = masses.get(body["path"].rpartition("/")[2], {"mass": None})
        expect(f"{name}: mass of {body['path']}", near(other["mass"], body["mass"]), other["mass"])
    expect(f"{name}: bodies come back where they were", worst <= NEAR, worst)
    limits = {j["path"].rpartition("/")[2]: j for j in after.joints}
    for joint in before.joints:
        own = joint["path"].rpartition("/")[2]
        other = limits.get(shown.get(own, own))
        for key in ("lower", "upper", "velocityLimit", "damping", "friction", "armature"):
            if other and joint["type"] in ("revolute", "prismatic"):
                expect(f"{name}: {key} of {joint['path']}",
                       near(other.get(key), joint.get(key)) or
                       (key == "damping" and joint.get("drives")),
                       (other.get(key), joint.get(key)))
    return worst


# --- configurations in Python -------------------------------------------------------------------


class Made(dict):
    """What a stand-in was called with."""
    __getattr__ = dict.__getitem__


def class_of(name, known, defaults=()):
    def make(*args, **given):
        expect(f"{name} takes {sorted(set(given) - known)}", not args and set(given) <= known)
        return Made(given)

    make.__dataclass_fields__ = {key: None for key in known}
    make.InitialStateCfg = None
    for key, value in dict(defaults).items():
        setattr(make, key, value)
    return make


def run_file(file, modules):
    kept = {name: sys.modules.get(name) for name in modules}
    sys.modules.update(modules)
    try:
        scope = {"__file__": str(file), "__name__": file.stem}
        exec(compile(file.read_text(encoding="utf-8"), str(file), "exec"), scope)
    finally:
        for name, module in kept.items():
            if module is None:
                del sys.modules[name]
            else:
                sys.modules[name] = module
    return scope


def module(name, **names):
    made = types.ModuleType(name)
    vars(made).update(names)
    return made


def lab_modules(version):
    articulation = class_of("ArticulationCfg", ARTICULATION, {
        "InitialStateCfg": class_of("InitialStateCfg", STATE)})
    sim = module("isaaclab.sim", UsdFileCfg=class_of("UsdFileCfg", {"usd_path", "variants"}))
    lab = module("isaaclab", sim=sim)
    return {"isaaclab": lab, "isaaclab.sim": sim,
            "isaaclab.assets": module("isaaclab.assets", ArticulationCfg=articulation),
            "isaaclab.actuators": module("isaaclab.actuators", ImplicitActuatorCfg=class_of(
                "ImplicitActuatorCfg", LAB | LIMITS[version]))}


def wanted_motors(places):
    """Gains and limits by the names of prims, from `tenon physics`."""
    motors = {}
    for joint in places.joints:
        lower, upper = (-math.inf if joint.get("lower") is None else joint["lower"],
                        math.inf if joint.get("upper") is None else joint["upper"])
        if joint["type"] not in ("revolute", "prismatic") or lower >= upper:
            continue  # locked
        drives = joint.get("drives", [])
        gains = [d for d in drives if d["stiffness"] or d["damping"]]
        row = {"stiffness": gains[0]["stiffness"] if gains else 0,
               "damping": gains[0]["damping"] if gains else 0,
               "effort": min([d["maxForce"] for d in drives if d.get("maxForce") is not None],
                             default=None),
               "velocity": joint.get("velocityLimit"),
               "armature": joint.get("armature", 0), "friction": joint.get("friction", 0),
               "passive": joint.get("damping", 0)}
        if not any(d.get("acceleration") for d in gains):
            motors[joint["path"].rpartition("/")[2]] = row
    return motors


def check_isaaclab(name, asset, work):
    file = work / "lab_cfg.py"
    code, answer = tenon("convert", asset, file, "--format", "isaaclab")
    expect(f"{name}: Isaac Lab", code == 0, answer["diagnostics"][-1:])
    wanted = wanted_motors(Places(asset))
    for version in (2, 3):
        scope = run_file(file, lab_modules(version))
        [cfg] = [value for key, value in scope.items() if key.endswith("_CFG")]
        expect(f"{name}: the USD file is there", pathlib.Path(cfg.spawn.usd_path).exists(),
               cfg.spawn.usd_path)
        found = {}
        for group in cfg.actuators.values():
            effort, velocity = sorted(LIMITS[version])
            for joint in group.joint_names_expr:
                expect(f"{name}: {joint} is in one group", joint not in found)
                found[joint] = {"stiffness": group.stiffness, "damping": group.damping,
                                "effort": group[effort], "velocity": group[velocity],
                                "armature": group.armature, "friction": group.friction,
                                "passive": group.viscous_friction}
        expect(f"{name}: joints of Isaac Lab", set(found) >= set(wanted),
               set(wanted) - set(found))
        expect(f"{name}: every joint starts somewhere",
               set(cfg.init_state.joint_pos) == set(found))
        for joint, row in wanted.items():
            for key, value in row.items():
                expect(f"{name}: Isaac Lab's {key} of {joint}",
                       near(found.get(joint, {}).get(key), value),
                       (found.get(joint, {}).get(key), value))
    return len(wanted)


def check_mjlab(name, asset, work):
    file = work / "mjlab_cfg.py"
    code, answer = tenon("convert", asset, file, "--format", "mjlab")
    expect(f"{name}: mjlab", code in (0, 1), answer["diagnostics"][-1:])
    model = xml.parse(work / "mjlab_cfg.xml").getroot()
    for mesh in model.iter("mesh"):
        path = mesh.get("file")
        expect(f"{name}: the mesh {path} of MJCF is there", path is None or
               (work / path).exists())
    entity = class_of("EntityCfg", {"spec_fn", "init_state", "articulation"}, {
        "InitialStateCfg": class_of("InitialStateCfg", STATE)})
    spec = types.SimpleNamespace(from_file=pathlib.Path)
    scope = run_file(file, {
        "mujoco": module("mujoco", MjSpec=spec), "mjlab": module("mjlab"),
        "mjlab.actuator": module("mjlab.actuator", XmlActuatorCfg=class_of(
            "XmlActuatorCfg", {"target_names_expr", "command_field"})),
        "mjlab.entity": module("mjlab.entity", EntityCfg=entity,
                               EntityArticulationInfoCfg=class_of("EntityArticulationInfoCfg",
                                                                  {"actuators"}))})
    [cfg] = [value for key, value in scope.items() if key.endswith("_CFG")]
    expect(f"{name}: the model of mjlab is there", cfg.spec_fn().exists())
    joints = {j.get("name") for j in model.iter("joint") if j.get("name")}
    acted = {a.get("joint"): a for a in model.find("actuator") or []}
    for group in cfg.articulation.actuators:
        for pattern in group.target_names_expr:
            hits = [joint for joint in joints if re.fullmatch(pattern, joint)]
            expect(f"{name}: {pattern} is one joint of the model", len(hits) == 1, hits)
            expect(f"{name}: {pattern} has an actuator", bool(hits) and hits[0] in acted)


# --- ROS ----------------------------------------------------------------------------------------


def check_ros(name, asset, work):
    file = work / "control.urdf"
    code, answer = tenon("convert", asset, file, "--format", "ros2_control")
    expect(f"{name}: ros2_control", code == 0, answer["diagnostics"][-1:])
    robot = xml.parse(file).getroot()
    described = {j.get("name"): j for j in robot.findall("joint")}
    block = robot.find("ros2_control")
    expect(f"{name}: a plugin is named", bool(block.findtext("hardware/plugin")))
    for joint in block.findall("joint"):
        other = described.get(joint.get("name"))
        expect(f"{name}: {joint.get('name')} is a joint of the URDF", other is not None)
        if other is None:
            continue
        follows = other.find("mimic") is not None
        expect(f"{name}: {joint.get('name')} follows", follows == (joint.get("mimic") == "true"))
        expect(f"{name}: {joint.get('name')} has a command", follows ==
               (joint.find("command_interface") is None))
        command = joint.find("command_interface")
        bounds = {} if command is None else {p.get("name"): float(p.text)
                                             for p in command.findall("param")}
        limit = other.find("limit")
        if command is not None and command.get("name") == "position" and limit is not None:
            for key, of_urdf in (("min", "lower"), ("max", "upper")):
                if key in bounds:
                    expect(f"{name}: {key} of {joint.get('name')}",
                           near(bounds[key], float(limit.get(of_urdf))), bounds)
    file = work / "out.srdf"
    code, answer = tenon("convert", asset, file)
    expect(f"{name}: SRDF", code == 0, answer["diagnostics"][-1:])
    srdf = xml.parse(file).getroot()
    links = {link.get("name") for link in robot.findall("link")}
    for pair in srdf.findall("disable_collisions"):
        expect(f"{name}: links of the URDF", {pair.get("link1"), pair.get("link2")} <= links,
               pair.attrib)
    for joint in srdf.iter("joint"):
        expect(f"{name}: joints of the URDF", joint.get("name") in described, joint.attrib)
    return len(srdf.findall("disable_collisions"))


# --- MJCF and the command -----------------------------------------------------------------------


def check_mesh_files(work):
    asset = ROBOTS[0]
    tenon("convert", asset, work / "inline.xml")
    code, _ = tenon("convert", asset, work / "files.xml", "--assets", "parts")
    expect("MJCF with files: exit code", code in (0, 1), code)
    text = (work / "files.xml").read_text(encoding="utf-8")
    files = set(re.findall(r'file="([^"]*)"', text))
    expect("meshes of MJCF are files", " vertex=" not in text and len(files) > 5, len(files))
    expect("their files are there", all((work / name).exists() for name in files))
    expect("the text is short", len(text) < 0.5 * len((work / "inline.xml").read_text()))
    scenes = []
    for name in ("inline", "files"):
        code, answer = tenon("convert", work / f"{name}.xml", work / f"{name}.usda")
        expect(f"{name}.xml is read again", code in (0, 1), answer["diagnostics"][-1:])
        scenes.append(Places(work / f"{name}.usda"))
    counts = [{k: len(s.scene[k]) for k in ("bodies", "joints", "colliders")} for s in scenes]
    expect("both are one robot", counts[0] == counts[1], counts)


def check_words(work):
    asset = ROBOTS[0]
    for words, rule in ((["x.py"], "convert.format"),
                        (["x.py", "--format", "sdf"], "convert.format"),
                        (["x.sdf", "--assets", "../up"], "convert.assets"),
                        (["x.srdf", "--assets", "meshes"], "convert.assets")):
        code, answer = tenon("convert", asset, work / words[0], *words[1:])
        expect(f"{words} is refused", code == 2 and answer["diagnostics"][-1]["rule"] == rule,
               (code, answer["diagnostics"][-1:]))
    code, _ = tenon("convert", ROBOTS[1], work / "x.usda", "--format", "sdf")
    expect("--format is about assets", code == 2, code)
    # The note in a Python file says that it is as it was written.
    file = work / "note_cfg.py"
    for _ in range(2):
        code, answer = tenon("convert", asset, file, "--format", "isaaclab")
        expect("a file that nobody edited is written over", code == 0, answer["diagnostics"][-1:])
    file.write_text(file.read_text(encoding="utf-8").replace("stiffness=", "stiffness=1+"))
    code, _ = tenon("convert", asset, file, "--format", "isaaclab")
    expect("an edited file stays", code == 2, code)


def main():
    dice = random.Random(7)
    names = sys.argv[3:]
    given = [pathlib.Path(name).resolve() for name in names if name != "--installed"]
    if "--installed" in names:
        site = pathlib.Path(sysconfig.get_paths()["purelib"])
        given += [file for folder in PACKAGES for file in sorted((site / folder).rglob("*.urdf"))]
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        for number, robot in enumerate(given or ROBOTS):
            work = pathlib.Path(folder) / f"{number}_{robot.stem}"
            work.mkdir()
            asset = robot
            if robot.suffix != ".usda":
                asset = work / "asset.usda"
                code, _ = tenon("convert", robot, asset, "--gains", "20,2", "--armature", "0.01")
                if code not in (0, 1) or not Places(asset).scene["bodies"]:
                    print(f"{robot.name}: no robot")
                    continue
            worst = check_sdf(robot.name, asset, work, dice)
            motors = check_isaaclab(robot.name, asset, work)
            check_mjlab(robot.name, asset, work)
            pairs = check_ros(robot.name, asset, work)
            count += 1
            print(f"{robot.name}: {motors} joints, {pairs} pairs, SDF {worst:.1e} apart",
                  flush=True)
        if not given:
            check_mesh_files(pathlib.Path(folder))
            check_words(pathlib.Path(folder))
    for fault in faults[:40]:
        print("FAULT", fault)
    print(f"{count} robots, {len(faults)} faults")
    return 1 if faults or ("--installed" in names and count < 50) else 0


if __name__ == "__main__":
    sys.exit(main())
