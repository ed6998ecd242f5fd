#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots that are edited as assets, on the way in again and on the way back.

    edited_corpus.py ROOT TENON [--all]

URDF: masses and limits are edited in the asset, other numbers change in the source. What `convert
--update` makes of both is what comes of converting the new source and editing that. Meshes are
balls here, as only numbers matter. MJCF: one mass and one limit are edited; what `convert` writes
differs from the source in that number alone, with as many cameras, lights, sensors and all else,
or it is made anew and says why. The robots are those of build/robots
(tests/convert/ten_robots.py makes it), a choice of them unless --all asks for every one; what is
random has a fixed seed.
"""

import collections
import concurrent.futures
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

import numpy
from round_trip import ROOT, TENON, mujoco

ROBOTS = ROOT / "build/robots"
CHOSEN = 12
COUNTS = ("nbody", "njnt", "ngeom", "ncam", "nlight", "nsensor", "nu", "nkey", "ntex", "nmat")
MESH = re.compile(r"<mesh\b[^>]*?(/>|>\s*</mesh>)", re.DOTALL)


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False)
    return process.returncode, json.loads(process.stdout)


def changed(text, attribute, factor, chance, count):
    """The text with some of the numbers of an attribute multiplied."""
    spots = list(re.finditer(attribute + r'="(-?[0-9.]+(?:e-?[0-9]+)?)"', text))
    for spot in sorted(chance.sample(spots, min(count, len(spots))), key=lambda s: -s.start()):
        text = text[:spot.start(1)] + repr(float(spot[1]) * factor) + text[spot.end(1):]
    return text


def edits_of(asset, chance, masses, limits):
    code, answer = tenon("physics", asset)
    if code != 0:
        return []
    bodies = [(f"{b['path']}.physics:mass", f"{chance.uniform(0.1, 5):.3f}")
              for b in answer["bodies"]]
    hinges = [(f"{j['path']}.physics:upperLimit", f"{chance.uniform(150, 170):.2f}")
              for j in answer["joints"] if j["type"] == "revolute" and j["upper"] is not None]
    return [*chance.sample(bodies, min(masses, len(bodies))),
            *chance.sample(hinges, min(limits, len(hinges)))]


def edited(asset, edits):
    return [edit for edit in edits if tenon("set", asset, "=".join(edit))[0] == 0]


def flat(asset):
    """All that it says but the note of what was written."""
    process = subprocess.run([TENON, "cat", "--flatten", asset], capture_output=True, text=True,
                             check=False)
    return re.sub(r'"[0-9a-f]{16}"|int64\[\] self = .*', "", process.stdout)


def update(source):
    """(outcome, faults) of a URDF in each form of asset."""
    text = MESH.sub('<sphere radius="0.05"/>', source.read_text(errors="replace"))
    faults = []
    for form in ("r/", "r.usda", "r.usdc"):
        chance = random.Random(str(source.relative_to(ROBOTS)) + form)
        with tempfile.TemporaryDirectory() as folder:
            work = pathlib.Path(folder)
            robot = work / "r.urdf"
            robot.write_text(text)
            (work / "old").mkdir()
            (work / "new").mkdir()
            old, new = (work / at / (f"{form}r.usda" if form == "r/" else form)
                        for at in ("old", "new"))
            if tenon("convert", robot, work / "old" / form, "--name", "r")[0] == 2:
                return "refused", []
            edits = edits_of(old, chance, 3, 2)
            if not edits:
                return "no physics", []
            done = edited(old, edits)
            for attribute, factor in (("lower", 0.75), ("ixx", 1.1), ("effort", 2)):
                text_now = changed(robot.read_text(), attribute, factor, chance, 2)
                robot.write_text(text_now)
            code, answer = tenon("convert", robot, work / "old" / form, "--name", "r", "--update")
            tenon("convert", robot, work / "new" / form, "--name", "r")
            if code == 2 or answer["updated"]["conflicts"]:
                faults.append(f"{source.name} {form}: {answer['diagnostics'][-1:]}")
            elif edited(new, edits) != done or flat(old) != flat(new):
                faults.append(f"{source.name} {form}: an update is not the edited new asset")
            answer = tenon("convert", robot, work / "old" / form, "--name", "r", "--update")[1]
            if answer["updated"]["files"]:
                faults.append(f"{source.name} {form}: writes what is there already")
    return "updated", faults


def one_number(before, after, field):
    """Only one number of one field differs, but for what inertia says about other axes."""
    if any(getattr(before, name) != getattr(after, name) for name in COUNTS):
        return False
    for name in ("body_mass", "jnt_range", "dof_damping", "geom_friction", "actuator_biasprm"):
        near = numpy.isclose(getattr(before, name), getattr(after, name), rtol=1e-5, atol=1e-6)
        if int((~near).sum()) != (1 if name == field else 0):
            return False
    return numpy.allclose(numpy.sort(before.body_inertia), numpy.sort(after.body_inertia),
                          rtol=1e-4, atol=1e-9)


def patch(source):
    """(outcome, faults) of a MJCF model."""
    chance = random.Random(str(source.relative_to(ROBOTS)))
    try:
        before = mujoco.MjModel.from_xml_path(str(source))
    except ValueError:
        return "no model", []
    outcomes, faults = [], []
    with tempfile.TemporaryDirectory() as folder:
        asset, back = pathlib.Path(folder, "m.usda"), pathlib.Path(folder, "m.xml")
        if tenon("convert", source, asset, "--scene")[0] == 2:
            return "refused", []
        text = asset.read_text()
        for edit in edits_of(asset, chance, 1, 1) if "tenon:mjcf:model" in text else []:
            asset.write_text(text)
            if not edited(asset, [edit]):
                continue
            rules = [d["rule"] for d in tenon("convert", asset, back, "--force")[1]["diagnostics"]]
            if ("mjcf.patched" in rules) == ("mjcf.written-anew" in rules):
                faults.append(f"{source.name} {edit[0]}: not told what became of it: {rules}")
            if "mjcf.patched" in rules:
                field = "body_mass" if edit[0].endswith("mass") else "jnt_range"
                if not one_number(before, mujoco.MjModel.from_xml_path(str(back)), field):
                    faults.append(f"{source.name} {edit[0]}: more than {field} differs")
            outcomes.append("anew" if "mjcf.written-anew" in rules else "patched")
    return "patched" if outcomes and "anew" not in outcomes else "some anew", faults


def chosen(found):
    found = sorted(found)
    step = 1 if "--all" in sys.argv else max(1, len(found) // CHOSEN)
    return found[::step]


def main():
    urdf = [p for p in ROBOTS.rglob("*.urdf") if p.stat().st_size < 400000]
    mjcf = [p for p in ROBOTS.rglob("*.xml")
            if "<mujoco" in p.read_text(encoding="utf-8", errors="replace")[:20000]]
    if not urdf:
        print("skipped: no robots are there (tests/convert/ten_robots.py fetches them)")
        return 77
    faults, told = [], []
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for what, judge, found in (("URDF", update, urdf), ("MJCF", patch, mjcf)):
            results = list(pool.map(judge, chosen(found)))
            counts = sorted(collections.Counter(outcome for outcome, _ in results).items())
            told.append(f"{what}: " + ", ".join(f"{count} {what}" for what, count in counts))
            faults += [fault for _, own in results for fault in own]
    for fault in faults:
        print(fault)
    print(f"{'; '.join(told)}; {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
