#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Models of SDF beside Drake's reading of them: where their bodies are, and what they weigh.

    sdf_beside_drake.py ROOT TENON [FILE_OR_FOLDER...]

Each model is converted, and its bodies are placed by the joints of `tenon physics` at random
coordinates; Drake's own reader places its bodies by the same ones. The models are those of
tests/convert/sdf, those that Drake's package ships, and robots of other packages, whose URDF is
written as SDF here: with frames, axes and places relative to whatever the dice say, which changes
no body. Files named on the command line come on top. The other way round, those URDF robots and the
examples are made assets and written as SDF by this program, and Drake's reading of that is held to
the asset. Good when every model that Drake loads converts, Drake loads all that is written, and
places are within 1e-6, masses and moments within 1e-6 of their size. Runs in an environment with
Drake (requirements-sdf.txt).
"""

import collections
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import sysconfig
import tempfile
import xml.etree.ElementTree as xml

import numpy as np
import pydrake
from pydrake.all import (AngleAxis, BallRpyJoint, BodyIndex,
                         MultibodyPlant, Parser,
                         PrismaticJoint, Quaternion, RevoluteJoint, RigidTransform, RotationMatrix,
                         RollPitchYaw, ScrewJoint, UniversalJoint, world_model_instance)

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
NEAR = 1e-6
POSTURES = 5
ROBOTS = ("cmeel.prefix/share/example-robot-data", "airo_models", "upkie_description")


def legal(name):
    return re.sub(r"[^A-Za-z0-9_]", "_", name)


def transform(place):
    quaternion = np.array(place["orientation"])
    return RigidTransform(Quaternion(wxyz=quaternion / np.linalg.norm(quaternion)),
                          place["position"])


def converted(source, target):
    done = subprocess.run([TENON, "convert", source, target, "--force", "--json"],
                          capture_output=True, text=True, check=False, timeout=300)
    if done.returncode not in (0, 1):
        raise LookupError(json.loads(done.stdout)["diagnostics"][-1]["message"])


class Converted:
    """The asset, as an engine receives it."""

    def __init__(self, file, work):
        asset = file if file.suffix == ".usda" else pathlib.Path(work) / "asset.usda"
        if asset != file:
            converted(file, asset)
        physics = subprocess.run([TENON, "physics", asset, "--json"], capture_output=True,
                                 text=True, check=False, timeout=300)
        self.scene = json.loads(physics.stdout)
        self.bodies = {body["path"]: body for body in self.scene["bodies"]}

    def places(self, coordinates):
        """Of bodies by name; `coordinates` are those of joints by name."""
        placed = {None: RigidTransform()}
        waiting = [j for j in self.scene["joints"] if not j["excludeFromArticulation"]]
        children = {j["body1"] for j in waiting if j["body1"] is not None}
        for path, body in self.bodies.items():
            if path not in children:
                placed[path] = transform(body)
        while waiting:
            for joint in list(waiting):
                if joint["body0"] in placed:
                    placed[joint["body1"]] = (placed[joint["body0"]] @ transform(joint["frame0"]) @
                                              self.motion(joint, coordinates) @
                                              transform(joint["frame1"]).inverse())
                    waiting.remove(joint)
                    break
            else:
                raise LookupError("the joints are no tree")
        return {path.rpartition("/")[2]: place for path, place in placed.items() if path}

    def motion(self, joint, coordinates):
        name = joint["path"].rpartition("/")[2]
        kind = joint["type"]
        if kind == "fixed":
            return RigidTransform()
        for mimic in joint.get("mimics", []):
            leader = mimic["leader"].rpartition("/")[2]
            value = mimic["offset"] + mimic["multiplier"] * coordinates[leader]
            break
        else:
            value = coordinates[name]
        if kind == "spherical":
            return RigidTransform(RollPitchYaw(value), [0, 0, 0])
        axis = np.eye(3)["XYZ".index(joint["axis"].upper())]
        if kind == "prismatic":
            return RigidTransform(axis * value)
        if kind != "revolute":
            raise LookupError(f"a joint is {kind}")
        return RigidTransform(RotationMatrix(AngleAxis(value, axis)),
                              [0, 0, 0])


def package_name(mark):
    if not mark.exists():
        return None
    if mark.name == "model.config":
        return mark.parent.name
    name = xml.parse(mark).getroot().find("name")
    return None if name is None else name.text.strip()


class Drakes:
    """The same model as Drake reads it."""

    def __init__(self, file):
        self.plant = MultibodyPlant(0.001)  # without shapes: no mesh is read
        parser = Parser(self.plant)
        if parser.package_map().Contains("drake_models"):  # which Drake would download
            parser.package_map().Remove("drake_models")
        for folder in (file.parent, *file.parents[:5]):
            for mark in ("package.xml", "model.config"):
                name = package_name(folder / mark)
                if name and not parser.package_map().Contains(name):
                    parser.package_map().Add(name, str(folder))
        for folder in file.parent.parent.glob("*/model.config"):
            if not parser.package_map().Contains(folder.parent.name):
                parser.package_map().Add(folder.parent.name, str(folder.parent))
        [self.model] = parser.AddModels(str(file))[:1]
        self.plant.Finalize()
        self.top = self.plant.GetModelInstanceName(self.model)
        self.context = self.plant.CreateDefaultContext()

    def name_of(self, thing):
        full = self.plant.GetModelInstanceName(thing.model_instance()) + "::" + thing.name()
        top = self.top + "::"
        return legal(full[len(top):] if full.startswith(top) else full)

    def move(self, dice):
        """Random coordinates of all joints, by the names that this program gives them."""
        coordinates = {}
        for index in self.plant.GetJointIndices():
            joint = self.plant.get_joint(index)
            name = self.name_of(joint)
            if isinstance(joint, RevoluteJoint):
                coordinates[name] = dice.uniform(-2, 2)
                joint.set_angle(self.context, coordinates[name])
            elif isinstance(joint, PrismaticJoint):
                coordinates[name] = dice.uniform(-1, 1)
                joint.set_translation(self.context, coordinates[name])
            elif isinstance(joint, UniversalJoint):
                angles = [dice.uniform(-1, 1), dice.uniform(-1, 1)]
                coordinates[name + "_1"], coordinates[name + "_2"] = angles
                joint.set_angles(self.context, angles)
            elif isinstance(joint, ScrewJoint):
                coordinates[name] = dice.uniform(-2, 2)
                positions = self.plant.GetPositions(self.context)
                positions[joint.position_start()] = coordinates[name]
                self.plant.SetPositions(self.context, positions)
            elif isinstance(joint, BallRpyJoint):
                coordinates[name] = [dice.uniform(-1, 1) for _ in range(3)]
                joint.set_angles(self.context, coordinates[name])
        return coordinates

    def bodies(self):
        for index in range(self.plant.num_bodies()):
            body = self.plant.get_body(BodyIndex(index))
            if body.model_instance() != world_model_instance():
                yield self.name_of(body), body


def compare(file, work, dice, asset=None):
    """-> figures; LookupError says what differs. `asset` is what the file is made of."""
    drake = Drakes(file)
    ours = Converted(asset or file, work)
    worst = 0.0
    known = {path.rpartition("/")[2]: body for path, body in ours.bodies.items()}
    compared = 0
    for number in range(POSTURES):
        coordinates = drake.move(dice)
        if asset:  # a joint that has the name of a link is written as another
            for name in [n for n in coordinates if n.endswith("_joint")]:
                coordinates.setdefault(name.removesuffix("_joint"), coordinates[name])
        for path in ours.scene["joints"]:
            name = path["path"].rpartition("/")[2]
            # A mimic that Drake takes as a constraint moves nothing in its kinematics.
            if path.get("mimics") and name in coordinates:
                path["mimics"] = []
        places = ours.places(coordinates)
        for name, body in drake.bodies():
            if name not in places:
                # What stands still with shapes is a link of SDF, and no body of an asset.
                stands = asset and drake.plant.IsAnchored(body)
                if not is_static(file) and not stands:
                    raise LookupError(f"no body {name}")
                continue
            there = drake.plant.EvalBodyPoseInWorld(drake.context, body)
            apart = there.InvertAndCompose(places[name])
            turn = 2 * math.asin(min(1, np.linalg.norm(apart.rotation().ToQuaternion().xyz())))
            # Long robots: floats of USD are 1e-7 of a length.
            size = max(1, np.linalg.norm(there.translation()))
            worst = max(worst, np.linalg.norm(apart.translation()) / size, turn)
            if number == 0:
                compared += 1
                weigh(name, known[name], body, drake.context)
    if worst > NEAR:
        raise LookupError(f"a body is {worst:.2g} apart")
    return worst, compared


def weigh(name, ours, theirs, context):
    inertia = theirs.CalcSpatialInertiaInBodyFrame(context)
    mass = inertia.get_mass()
    if abs(ours["mass"] - mass) > NEAR * max(mass, 1e-12):
        raise LookupError(f"{name} weighs {ours['mass']}, not {mass}")
    center = np.linalg.norm(np.array(ours["centerOfMass"]) - inertia.get_com())
    if mass > 0 and center > NEAR:
        raise LookupError(f"the centre of mass of {name} is {center:.2g} apart")
    own = np.array(ours["inertia"]).reshape(3, 3)
    moments = np.linalg.eigvalsh(own)
    if moments[2] > moments[0] + moments[1]:
        return  # no body has it; Drake takes another
    wanted = inertia.Shift(inertia.get_com()).CalcRotationalInertia().CopyToFullMatrix3()
    if mass > 0 and np.abs(own - wanted).max() > NEAR * max(np.abs(wanted).max(), 1e-11):
        raise LookupError(f"the inertia of {name} is {np.abs(own - wanted).max():.2g} apart")


def is_static(file):
    return "<static>" in file.read_text(encoding="utf-8", errors="replace")


# --- URDF as SDF ------------------------------------------------------------------------------


def pose_of(element):
    origin = element.find("origin")
    if origin is None:
        return RigidTransform()
    xyz = [float(x) for x in origin.get("xyz", "0 0 0").split()]
    rpy = [float(x) for x in origin.get("rpy", "0 0 0").split()]
    return RigidTransform(RollPitchYaw(rpy), xyz)


def written(place, dice):
    """-> attributes and text of <pose>, as angles or as a quaternion."""
    where = " ".join(repr(float(x)) for x in place.translation())
    if dice.random() < 0.5:
        q = place.rotation().ToQuaternion()
        return ' rotation_format="quat_xyzw"', where + " " + " ".join(
            repr(float(x)) for x in (q.x(), q.y(), q.z(), q.w()))
    angles = RollPitchYaw(place.rotation()).vector()
    return "", where + " " + " ".join(repr(float(x)) for x in angles)


def is_sound(inertial):
    """Whether the inertia is one that a body can have, which this program keeps as it is."""
    if inertial is None or inertial.find("mass") is None or inertial.find("inertia") is None:
        return False
    value = {k: float(v) for k, v in inertial.find("inertia").items()}
    moments = np.linalg.eigvalsh([[value["ixx"], value.get("ixy", 0), value.get("ixz", 0)],
                                  [value.get("ixy", 0), value["iyy"], value.get("iyz", 0)],
                                  [value.get("ixz", 0), value.get("iyz", 0), value["izz"]]])
    return float(inertial.find("mass").get("value")) > 0 and moments[0] > 1e-3 * moments[2] and \
        moments[2] <= moments[0] + moments[1]


def joint_lines(joint, place_of, dice):
    lines = []
    kind = joint.get("type")
    parent, child = joint.find("parent").get("link"), joint.find("child").get("link")
    lines.append(f'<joint name="{joint.get("name")}" type="{kind}"><parent>{parent}</parent>'
                 f"<child>{child}</child>")
    turned = RigidTransform(RollPitchYaw([dice.uniform(-1, 1) for _ in range(3)]), [0, 0, 0])
    if dice.random() < 0.5:
        turned = RigidTransform()
    form, text = written(turned, dice)
    lines.append(f"<pose{form}>{text}</pose>")
    if kind != "fixed":
        axis = joint.find("axis")
        xyz = np.array([float(x) for x in (axis.get("xyz", "1 0 0") if axis is not None
                                           else "1 0 0").split()])
        where = dice.choice(["", "__model__", child, parent])
        rotation = {"": turned.rotation().inverse(), child: RotationMatrix(),
                    "__model__": place_of(child).rotation(),
                    parent: pose_of(joint).rotation()}[where]
        said = f' expressed_in="{where}"' if where else ""
        direction = " ".join(repr(float(x)) for x in rotation.multiply(xyz))
        limit = joint.find("limit")
        bounds = ""
        if limit is not None and kind != "continuous":
            bounds = (f"<limit><lower>{limit.get('lower', 0)}</lower>"
                      f"<upper>{limit.get('upper', 0)}</upper></limit>")
        lines.append(f"<axis><xyz{said}>{direction}</xyz>{bounds}</axis>")
    lines.append("</joint>")
    return lines


def as_sdf(urdf, dice):
    robot = xml.fromstring(urdf)
    for part in robot.iter():  # one name for two things, and that of the world, are none in SDF
        for key in ("name", "link"):
            if part.tag in ("link", "parent", "child") and part.get(key):
                part.set(key, part.get(key) + "_link")
    joints = {j.find("child").get("link"): j for j in robot.findall("joint")}
    if any(j.get("type") in ("planar", "floating", "ball") for j in joints.values()):
        raise LookupError("joints that SDF has not")
    places = {}

    def place_of(link):
        if link not in places:
            joint = joints.get(link)
            places[link] = RigidTransform() if joint is None else \
                place_of(joint.find("parent").get("link")) @ pose_of(joint)
        return places[link]

    lines = ['<sdf version="1.9"><model name="robot">']
    links = [link.get("name") for link in robot.findall("link")]
    for link in robot.findall("link"):
        name = link.get("name")
        joint = joints.get(name)
        lines.append(f'<link name="{name}">')
        # Each link relative to the model, or to any link that comes before it.
        other = dice.choice(links[:max(1, links.index(name))])
        if joint is None or other == name or dice.random() < 0.5:
            form, text = written(place_of(name), dice)
        else:
            form, text = written(place_of(other).inverse() @ place_of(name), dice)
            form += f' relative_to="{other}"'
        lines.append(f"<pose{form}>{text}</pose>")
        inertial = link.find("inertial")
        if not is_sound(inertial):
            lines.append("<inertial><mass>0.001</mass><inertia><ixx>1e-6</ixx><iyy>1e-6</iyy>"
                         "<izz>1e-6</izz></inertia></inertial>")
        else:
            form, text = written(pose_of(inertial), dice)
            mass = inertial.find("mass").get("value")
            values = "".join(f"<{k}>{v}</{k}>" for k, v in inertial.find("inertia").items())
            lines.append(f"<inertial><pose{form}>{text}</pose><mass>{mass}</mass><inertia>{values}"
                         "</inertia></inertial>")
        lines.append("</link>")
    for joint in robot.findall("joint"):
        lines += joint_lines(joint, place_of, dice)
    return "\n".join(lines) + "\n</model></sdf>\n"


def sources(more):
    """(name, file), and (name, text of a URDF)."""
    for file in sorted((ROOT / "tests/convert/sdf").glob("*.sdf")):
        yield f"own/{file.name}", file
    share = pathlib.Path(pydrake.getDrakePath())
    for file in sorted(share.rglob("*.sdf")):
        yield f"drake/{file.name}", file
    site = pathlib.Path(sysconfig.get_paths()["purelib"])
    for folder in ROBOTS:
        for file in sorted((site / folder).rglob("*.urdf")):
            yield f"{folder.rpartition('/')[2]}/{file.name}", file
    for name in more:
        path = pathlib.Path(name)
        for file in sorted(path.rglob("*.sdf")) if path.is_dir() else [path]:
            yield str(file), file


def written_sources():
    """(name, file) of what is made an asset and written as SDF."""
    for file in (ROOT / "examples/inspire_hand/inspire_hand.usda",
                 *sorted((ROOT / "tests/convert/urdf").glob("*.urdf"))):
        if file.stem not in ("cycle", "not_a_number", "every_joint"):  # faults, and a plane
            yield f"own/{file.name}", file
    site = pathlib.Path(sysconfig.get_paths()["purelib"])
    for folder in ROBOTS:
        for file in sorted((site / folder).rglob("*.urdf")):
            yield f"{folder.rpartition('/')[2]}/{file.name}", file


def check_written(work, dice, outcome, bad):
    """-> the largest distance."""
    worst = 0.0
    for name, file in written_sources():
        asset, made = pathlib.Path(work) / "robot.usda", pathlib.Path(work) / "written.sdf"
        try:
            if file.suffix == ".usda":
                asset = file
            else:
                converted(file, asset)
        except LookupError as error:
            print(f"{name}: not converted: {str(error)[:120]}")
            continue
        try:
            if not Converted(asset, work).bodies:
                print(f"{name}: nothing in it moves or has mass")
                continue
            converted(asset, made)
            apart, count = compare(made, work, dice, asset)
            outcome["written"] += 1
            worst = max(worst, apart)
            print(f"{name}: written, {count} bodies, {apart:.1e}")
        except (LookupError, RuntimeError, KeyError) as error:
            outcome["wrong"] += 1
            bad.append(name)
            print(f"{name}: WRONG as written: {str(error)[:300]}")
    return worst


def main():
    dice = random.Random(50)
    outcome = collections.Counter()
    worst = 0.0
    bad = []
    with tempfile.TemporaryDirectory() as work:
        for name, file in sources(sys.argv[3:]):
            try:
                if file.suffix == ".urdf":
                    text = as_sdf(file.read_text(encoding="utf-8"), dice)
                    file = pathlib.Path(work) / "made.sdf"
                    file.write_text(text, encoding="utf-8")
                Drakes(file)
            except (RuntimeError, LookupError, ValueError, KeyError, AttributeError,
                    RecursionError, TypeError, xml.ParseError) as error:
                outcome["not for Drake"] += 1
                print(f"{name}: not for Drake: {str(error).splitlines()[0][:160]}")
                continue
            try:
                apart, count = compare(file, work, dice)
                outcome["equal"] += 1
                worst = max(worst, apart)
                print(f"{name}: {count} bodies, {apart:.1e}")
            except LookupError as error:
                outcome["wrong"] += 1
                bad.append(name)
                print(f"{name}: WRONG: {error}")
        worst_written = check_written(work, dice, outcome, bad)
    print(f"{outcome['written']} robots written as SDF are their assets in Drake, the worst "
          f"{worst_written:.1e}")
    print(f"{outcome['equal']} models as Drake reads them, the worst {worst:.1e}; "
          f"{outcome['wrong']} wrong; {outcome['not for Drake']} that Drake does not load")
    return 1 if bad or outcome["equal"] < 40 or outcome["written"] < 40 else 0


if __name__ == "__main__":
    sys.exit(main())
