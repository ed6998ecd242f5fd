#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Assets that are made for SimReady pass what it asks for.

    test_made.py ROOT TENON

A description with all that makes a difference (a joint that follows, one that nothing moves,
friction, a mesh that is drawn and collides) is converted with --profile simready, the example hand
is structured with it. Codes that fail are those of MAY_FAIL, and no others.
"""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile

from other_choices import OTHER_CHOICES

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
# No picture is drawn here.
NO_PICTURE = {"SR.002", "RC.004"}
SAID = ["--profile", "simready", "--no-thumbnail", "--metadata", "author=the tenon authors",
        "--metadata", "asset_license=Apache-2.0"]
JOINT = """  <joint name="{name}" type="{kind}">
    <parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}"/><axis xyz="0 0 1"/>
    {more}
  </joint>
"""
LIMIT = '<limit lower="-1" upper="1" effort="5" velocity="2"/>'


def link(name, visual, collision):
    return f"""  <link name="{name}">
    <inertial><mass value="1"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry>{visual}</geometry></visual>
    <collision><geometry>{collision}</geometry></collision>
  </link>
"""


def robot():
    mesh = '<mesh filename="wedge.stl"/>'
    box = '<box size="0.1 0.1 0.1"/>'
    return ('<robot name="arm">\n' + link("base", mesh, mesh) + link("lower", mesh, box)
            + link("upper", box, mesh) + link("finger", mesh, mesh)
            + JOINT.format(name="turn", kind="revolute", parent="base", child="lower",
                           xyz="0 0 1", more=LIMIT + '<dynamics damping="0.1" friction="0.2"/>')
            + JOINT.format(name="spin", kind="continuous", parent="lower", child="upper",
                           xyz="0 0 1", more="")
            + JOINT.format(name="follow", kind="revolute", parent="upper", child="finger",
                           xyz="0 1 0", more=LIMIT
                           + '<mimic joint="turn" multiplier="0.5" offset="0.1"/>') + "</robot>\n")


def wedge():
    corners = [(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0, 0, 0.1)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in corners[i]), 0)
                    for face in faces)
    return bytes(80) + struct.pack("<I", len(faces)) + body


def tenon(*arguments, code=0):
    done = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)
    if done.returncode != code:
        sys.exit(f"tenon {' '.join(map(str, arguments))}: {done.returncode}\n{done.stderr}")
    return done


def failing(asset):
    """{code: its first message}, and how it is opened."""
    done = subprocess.run([TENON, "check", "--json", "--no-settings", "--only", "simready",
                           "--profile", "simready-robot", str(asset)], capture_output=True,
                          text=True, check=False)
    said = json.loads(done.stdout)
    messages = {}
    for one in said["diagnostics"]:
        messages.setdefault(one["rule"].removeprefix("simready."), one["message"])
    return {one["code"].split(".", 3)[3]: messages.get(one["code"].split(".", 3)[3], "")
            for one in said["assets"][0]["codes"] if one["verdict"] == "fail"}


def faults_of(what, asset, more=frozenset()):
    found = failing(asset)
    allowed = OTHER_CHOICES | NO_PICTURE | more
    return [f"{what}: {code} fails: {found[code]}" for code in sorted(set(found) - allowed)]


def physics_with(asset, folder, variants):
    """The neutral description with these variants of the robot's prim selected."""
    over = folder / "over.usda"
    name = asset.stem
    chosen = "".join(f'        string {key} = "{value}"\n' for key, value in variants.items())
    over.write_text(f'#usda 1.0\n(\n    defaultPrim = "{name}"\n    metersPerUnit = 1\n'
                    f'    kilogramsPerUnit = 1\n    upAxis = "Z"\n    subLayers = [@{asset}@]\n)\n'
                    f'over "{name}" (\n    variants = {{\n{chosen}    }}\n)\n{{\n}}\n', "utf-8")
    return json.loads(tenon("physics", "--json", over).stdout)


def joint_facts(description, limits):
    """What schemas of engines say about the joints, rounded as floats are."""
    names = ["armature", "friction", "damping"] + (["velocityLimit"] if limits else [])
    facts = {}
    for joint in description["joints"]:
        law = joint["mimic"] and (joint["mimic"]["multiplier"], joint["mimic"]["offset"])
        numbers = [joint[name] if isinstance(joint[name], list) else [joint[name]]
                   for name in names] + [law or []]
        facts[joint["path"]] = [[x if x is None or isinstance(x, str) else float(f"{x:.5g}")
                                 for x in one] for one in numbers]
    return facts


def conversion_faults(folder):
    source = folder / "arm.urdf"
    source.write_text(robot(), "utf-8")
    (folder / "wedge.stl").write_bytes(wedge())
    home = folder / "arm"
    home.mkdir()
    tenon("convert", source, f"{home}/usd/", "--robot-type", "Manipulator", *SAID)
    asset = home / "usd/arm.usda"
    faults = faults_of("convert", asset)
    before = {path: path.read_bytes() for path in (home / "usd").rglob("*") if path.is_file()}
    tenon("convert", source, f"{home}/usd/", "--robot-type", "Manipulator", *SAID)
    faults += [f"{path.name}: converted again it differs" for path, text in before.items()
               if path.read_bytes() != text]
    # The neutral physics leave the follower free; each runtime says what "Physics" says.
    if any(joint["mimic"] for joint in physics_with(asset, folder, {})["joints"]):
        faults.append("the neutral physics couples joints")
    whole = physics_with(asset, folder, {"Physics": "physx"})
    for runtime in ("PhysX", "Newton", "MuJoCo"):
        limits = runtime != "MuJoCo"  # it knows none of velocities
        found = joint_facts(physics_with(asset, folder, {runtime: "Enabled"}), limits)
        if found != joint_facts(whole, limits):
            faults.append(f"{runtime}: {found}\n  but Physics=physx: {joint_facts(whole, limits)}")
    # Structured again, the asset stays what it is.
    again = folder / "again/arm"
    again.parent.mkdir()
    tenon("structure", asset, "-o", again, *SAID)
    faults += [f"{path.relative_to(home / 'usd')}: structured again it differs"
               for path, text in before.items()
               if path.suffix == ".usda" and path.parent != home / "usd"
               and (again / path.relative_to(home / "usd")).read_bytes() != text]
    return faults


def structure_faults(folder):
    home = folder / "hand"
    home.mkdir()
    hand = next((ROOT / "examples/inspire_hand").glob("*.usda"))
    tenon("structure", hand, "-o", home / hand.stem, "--robot-type", "End Effector", *SAID)
    return faults_of("structure", home / hand.stem / hand.name)


def folder_faults(folder):
    """A robot without visuals has empty layers; its folder is one asset all the same."""
    home = folder / "bare"
    home.mkdir()
    tenon("convert", ROOT / "examples/cpp/robots/arm.urdf", f"{home}/usd/", "--robot-type",
          "Manipulator", *SAID)
    said = json.loads(tenon("check", "--json", "--no-settings", "--profile", "simready",
                            home / "usd", code=1).stdout)
    found = [asset["asset"] for asset in said["assets"]]
    return [] if found == [str(home / "usd/arm.usda")] else [f"check FOLDER: {found}"]


def message_faults(folder):
    source = folder / "arm.urdf"
    faults = []
    rows = (((f"{folder}/told/", "--profile", "simready", "--no-thumbnail"), 0,
             ("author", "asset_license", "kind of robot")),
            ((f"{folder}/one.usda", "--profile", "simready"), 2, ("name a folder",)),
            ((f"{folder}/two/", "--metadata", "author=X"), 2, ("--profile simready",)),
            ((f"{folder}/two/", "--profile", "simready", "--metadata", "mass=3"), 2,
             ("asset_license",)),
            ((f"{folder}/two/", "--profile", "simready", "--names", "tutorial"), 2,
             ("--names tutorial",)))
    for arguments, code, words in rows:
        said = tenon("convert", source, *arguments, code=code).stderr
        faults += [f"{arguments}: nothing is said of {word}" for word in words if word not in said]
    return faults


def main():
    with tempfile.TemporaryDirectory(prefix="tenon-simready-") as name:
        folder = pathlib.Path(name)
        faults = (conversion_faults(folder) + message_faults(folder) + structure_faults(folder)
                  + folder_faults(folder))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
