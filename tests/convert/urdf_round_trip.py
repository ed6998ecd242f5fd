#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Assets back into URDF: the numbers of the URDF that they are made of, and as MuJoCo reads them.

    urdf_round_trip.py ROOT TENON own|hand|isaac|example

What MuJoCo reads is compared where build/robots has it (ten_robots.py fetches it), the shared hands
where ../shared is.
"""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
URDF = ROOT / "tests/convert/urdf"
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
HAND = SHARED / "assets/inspire_hand_urdf/inspire_hand.urdf"
OWN_HAND = ROOT / "tests/convert/urdf/three_fingers.urdf"
ISAAC_HAND = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"
EXAMPLE = ROOT / "examples/inspire_hand/inspire_hand.usda"
NO_LIMIT = [1e9]  # of effort or speed, as the program writes it; 0 means none where it reads
FLOAT = 4e-7  # rounding of floats, through degrees and a turned frame

sys.path[:0] = [str(ROOT / "build/robots"), str(pathlib.Path(__file__).parent)]

faults = []


def expect(what, found, wanted):
    if found != wanted:
        faults.append(f"{what}: {found!r}, expected {wanted!r}")


def near(what, found, wanted, tolerance=FLOAT):
    found, wanted = list(found), list(wanted)
    good = len(found) == len(wanted) and all(
        a == b or abs(a - b) <= tolerance * max(1, abs(b)) for a, b in zip(found, wanted))
    if not good:
        faults.append(f"{what}: {found!r}, expected {wanted!r}")


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False)
    return process.returncode, json.loads(process.stdout)


def convert(source, target):
    code, answer = tenon("convert", source, target)
    expect(f"{source.name} to {target.name}: exit code", code, 0)
    return answer


def numbers(element, attribute, default):
    text = element.get(attribute) if element is not None else None
    return [float(word) for word in text.split()] if text else default


def turn_of(rpy):
    """Of a URDF orientation, as a matrix by rows."""
    (sr, cr), (sp, cp), (sy, cy) = ((math.sin(a), math.cos(a)) for a in rpy)
    return [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,
            sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr, -sp, cp * sr, cp * cr]


def origin(element):
    at = element.find("origin")
    return numbers(at, "xyz", [0.0] * 3), turn_of(numbers(at, "rpy", [0.0] * 3))


def inertia_in_link(inertial):
    tensor = [[float(inertial.find("inertia").get("i" + "".join(sorted(a + b)), 0)) for b in "xyz"]
              for a in "xyz"]
    r = [origin(inertial)[1][3 * i:3 * i + 3] for i in range(3)]
    return [sum(r[i][k] * tensor[k][m] * r[j][m] for k in range(3) for m in range(3))
            for i in range(3) for j in range(3)]


class Meshes:
    """Points of the meshes that descriptions name, each read once."""

    def __init__(self):
        self.known = {}

    def points(self, path):
        if path not in self.known:
            self.known[path] = set(self.read(path))
        return self.known[path]

    @staticmethod
    def read(path):
        data = path.read_bytes()
        if path.suffix.lower() == ".obj":
            for line in data.decode().splitlines():
                if line.startswith("v "):
                    yield tuple(float(x) for x in line.split()[1:4])
            return
        import struct  # pylint: disable=import-outside-toplevel
        count = struct.unpack_from("<I", data, 80)[0]
        for i in range(count):
            values = struct.unpack_from("<12f", data, 84 + 50 * i)
            for corner in range(1, 4):
                yield tuple(values[3 * corner:3 * corner + 3])


MESHES = Meshes()


def bounds(path, scale):
    points = MESHES.points(path)
    return [pick(p[i] * scale[i] for p in points) for pick in (min, max) for i in range(3)]


def compare_shapes(what, found, wanted, folders):
    """Colliders and visuals of a link, in the order in which they stand."""
    expect(f"{what}: number", len(found), len(wanted))
    for number, (a, b) in enumerate(zip(found, wanted)):
        where = f"{what} {number}"
        shape, other = a.find("geometry")[0], b.find("geometry")[0]
        expect(f"{where}: shape", shape.tag, other.tag)
        for (x, y), part in zip(zip(origin(a), origin(b)), ("position", "orientation")):
            near(f"{where}: {part}", x, y)
        for word in ("size", "radius", "length"):
            near(f"{where}: {word}", numbers(shape, word, []), numbers(other, word, []))
        if shape.tag == "mesh":
            one = [1.0] * 3
            near(f"{where}: bounds",
                 bounds(folders[0] / shape.get("filename"), numbers(shape, "scale", one)),
                 bounds(folders[1] / other.get("filename"), numbers(other, "scale", one)))


def compare_link(name, found, wanted, folders):
    inertial, other = found.find("inertial"), wanted.find("inertial")
    expect(f"{name}: has a mass", inertial is not None, other is not None)
    if inertial is not None and other is not None:
        near(f"{name}: mass", numbers(inertial.find("mass"), "value", []),
             numbers(other.find("mass"), "value", []))
        near(f"{name}: centre", origin(inertial)[0], origin(other)[0])
        wanted_inertia = inertia_in_link(other)
        near(f"{name}: inertia", inertia_in_link(inertial), wanted_inertia,
             FLOAT * max(map(abs, wanted_inertia)))
    for kind in ("visual", "collision"):
        compare_shapes(f"{name}: {kind}", found.findall(kind), wanted.findall(kind), folders)


def compare_joint(name, found, wanted):
    for end in ("parent", "child"):
        expect(f"{name}: {end}", found.find(end).get("link"), wanted.find(end).get("link"))
    kind = wanted.get("type")
    expect(f"{name}: type", found.get("type"), kind)
    for (x, y), part in zip(zip(origin(found), origin(wanted)), ("position", "orientation")):
        near(f"{name}: {part}", x, y)
    if kind in ("revolute", "continuous", "prismatic", "planar"):
        near(f"{name}: axis", numbers(found.find("axis"), "xyz", [1.0, 0, 0]),
             numbers(wanted.find("axis"), "xyz", [1.0, 0, 0]))
    for element, words in (("limit", ("lower", "upper", "effort", "velocity")),
                           ("dynamics", ("damping", "friction")),
                           ("safety_controller", ("soft_lower_limit", "soft_upper_limit",
                                                  "k_position", "k_velocity")),
                           ("calibration", ("rising", "falling"))):
        a, b = found.find(element), wanted.find(element)
        if b is None or element == "limit" and kind in ("fixed", "continuous"):
            continue
        for word in words:
            wanted_numbers = numbers(b, word, [0.0])
            if word in ("effort", "velocity") and wanted_numbers == [0.0]:
                wanted_numbers = NO_LIMIT
            near(f"{name}: {element} {word}", numbers(a, word, [0.0]), wanted_numbers)


def law_of(joints, name):
    """-> leader, multiplier, offset; of a joint that follows a follower by its leader."""
    leader, multiplier, offset = name, 1.0, 0.0
    while (mimic := joints[leader].find("mimic")) is not None:
        offset += multiplier * float(mimic.get("offset", "0"))
        multiplier *= float(mimic.get("multiplier", "1"))
        leader = mimic.get("joint")
    return leader, multiplier, offset


def compare_laws(found, wanted):
    for name in sorted(set(found) & set(wanted)):
        (leader, *law), (other, *wanted_law) = law_of(found, name), law_of(wanted, name)
        expect(f"{name}: leader", leader, other)
        near(f"{name}: law", law, wanted_law)


def with_balls(robot, balls):
    """Three hinges about x, y and z are put together as the ball that they are written for."""
    joints = {joint.get("name"): joint for joint in robot.findall("joint")}
    links = {link.get("name"): link for link in robot.findall("link")}
    for name in balls:
        first, second, last = (joints[f"{name}_{axis}"] for axis in "xyz")
        expect(f"{name}: axes", [hinge.find("axis").get("xyz") for hinge in (first, second, last)],
               ["1 0 0", "0 1 0", "0 0 1"])
        for before, after in ((first, second), (second, last)):
            between = before.find("child").get("link")
            expect(f"{name}: chain", after.find("parent").get("link"), between)
            robot.remove(links[between])
            robot.remove(after)
        first.set("name", name)
        first.set("type", "spherical")
        first.find("child").set("link", last.find("child").get("link"))


def compare(found_file, wanted_file, replaced=None):
    """`replaced`: joints that have another name, as floating ones, which are no prims."""
    found, wanted = (xml.etree.ElementTree.parse(path).getroot()
                     for path in (found_file, wanted_file))
    with_balls(found, [joint.get("name") for joint in wanted.findall("joint")
                       if joint.get("type") == "spherical"])
    folders = (found_file.parent, wanted_file.parent)
    expect(f"{found_file.name}: robot", found.get("name"), wanted.get("name"))
    for kind, same in (("link", lambda *a: compare_link(*a, folders)), ("joint", compare_joint)):
        ours = {element.get("name"): element for element in found.findall(kind)}
        theirs = {(replaced or {}).get(element.get("name"), element.get("name")): element
                  for element in wanted.findall(kind)}
        expect(f"{found_file.name}: {kind}s", sorted(ours), sorted(theirs))
        for name in sorted(set(ours) & set(theirs)):
            same(name, ours[name], theirs[name])
        if kind == "joint":
            compare_laws(ours, theirs)


def left_out(answer):
    return sorted({d["message"].split(",")[0].split(":")[0] for d in answer["diagnostics"]
                   if d["rule"] == "urdf.left-out"})


def check_there_and_back(work, source, replaced=None):
    """URDF -> USD -> URDF: equal numbers."""
    name = source.stem
    asset, back = work / f"{name}.usda", work / "back" / f"{name}.urdf"
    back.parent.mkdir(exist_ok=True)
    convert(source, asset)
    found = left_out(convert(asset, back))
    compare(back, source, replaced)
    return back, found


def check_by_mujoco(asset, description, variant=()):
    """MuJoCo makes a model of the description, meshes and all, with the asset's numbers."""
    try:
        # pylint: disable=import-outside-toplevel
        import mujoco
        from mujoco_reading import Reading, WorldComparison
    except ImportError as error:
        print(f"without MuJoCo's reading: {error}")
        return
    folder = {str(path.relative_to(description.parent)): path.read_bytes()
              for path in description.parent.rglob("*.obj")}
    try:
        spec = mujoco.MjSpec.from_string(description.read_text())
        spec.assets = {**folder, **{pathlib.Path(name).name: data
                                    for name, data in folder.items()}}
        spec.compiler.discardvisual = False
        expect(f"{description.name}: MuJoCo has meshes", spec.compile().nmesh > 0, bool(folder))
    except ValueError as error:
        faults.append(f"{description.name}: MuJoCo: {error}")
    code, scene = tenon("physics", asset, *variant)
    expect(f"{asset.name}: physics", code, 0)
    comparison = WorldComparison(asset.name, Reading(description), scene).run()
    faults.extend(comparison.faults)
    print(f"{asset.name}: {comparison.compared} numbers compared with MuJoCo's")


def check_own(work):
    joints = URDF / "every_joint.urdf"
    _, found = check_there_and_back(work, joints, {"free": "loose_joint",
                                                   "tool mount": "tool frame_joint"})
    expect("every_joint: left out", found, [])
    shapes = work / "shapes.usda"
    convert(URDF / "shapes.urdf", shapes)
    found = convert(shapes, work / "shapes.urdf")
    expect("shapes: mesh files", found["meshes"], 4)  # two of two materials each
    expect("shapes: left out", left_out(found), ["the colour comes from a network of shaders"])


def check_refusals(work):
    empty = work / "empty.usda"
    empty.write_text('#usda 1.0\n(defaultPrim = "a")\ndef Xform "a" {}\n')
    code, answer = tenon("convert", empty, work / "empty.urdf")
    expect("no robot", (code, answer["diagnostics"][-1]["rule"]), (2, "urdf.no-robot"))
    expect("no robot: writes nothing", (work / "empty.urdf").exists(), False)


def check_hand(work):
    for hand in (OWN_HAND, HAND):
        if hand.exists():
            first, _ = check_there_and_back(work, hand)
            check_by_mujoco(work / f"{hand.stem}.usda", first)


def check_structured(work):
    """A hand that was structured into files, and the one that another tool structured."""
    asset = work / "structured"
    code, answer = tenon("convert", OWN_HAND, asset)
    expect("a structured hand", code, 0)
    check_asset(work, asset / f"{OWN_HAND.stem}.usda")
    if ISAAC_HAND.exists():
        check_asset(work, ISAAC_HAND)


def check_asset(work, asset):
    target = work / "hand.urdf"
    convert(asset, target)
    check_by_mujoco(asset, target)
    check_there_and_back(work, target)


def main():
    part = sys.argv[3]
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        if part == "own":
            check_own(work)
            check_refusals(work)
        elif part == "hand":
            check_hand(work)
        elif part == "isaac":
            check_structured(work)
        else:
            check_asset(work, EXAMPLE)
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
