# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares `tenon physics` with OpenUSD's physics parser, mass properties and table of collision
groups on random scenes, read with OpenUSD's readings where readers disagree.

usage: physics_random.py --tenon PROGRAM [--seeds N] [--first SEED] [--keep FOLDER]
       [--shrink-runs N]

A scene that differs is made smaller piece by piece while it still differs in the same way; the
smallest is printed, and written to FOLDER. What OpenUSD gets wrong stands in FAULTS, each with its
reason; one that excuses nothing over at least 500 seeds makes this fail.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections import Counter

import physics  # exits with 77 without OpenUSD
import physics_oracle
import physics_scenes

import numpy as np
from pxr import Tf, Usd, UsdGeom

READINGS = ("fixed-to-world=together", "mass-inheritance=own", "missing-target=world",
            "negative-gravity=literal", "one-sided-limits=drop", "sheared-offsets=factored",
            "stretched-sphere=ball", "ungrouped=on", "velocity-space=world")
SEEDS, SEEDS_OF_A_LONG_RUN = 60, 500
SHRINK_RUNS = 400


def is_sheared(stage, path):
    """Some prim from the root to `path` turns under a scale that is not uniform."""
    prim = stage.GetPrimAtPath(path)
    world = UsdGeom.XformCache().GetLocalToWorldTransform(prim)
    linear = np.array([[world[i][j] for j in range(3)] for i in range(3)])
    square = linear @ linear.T
    return np.abs(square - np.diag(np.diag(square))).max() > 1e-6 * np.trace(square)


def is_mirrored(stage, path):
    """The prim's transform to the world turns a right hand into a left one."""
    world = UsdGeom.XformCache().GetLocalToWorldTransform(stage.GetPrimAtPath(path))
    return world.GetDeterminant3() < 0


class RandomCase(physics.Case):
    """The comparison of physics.py, of all that the random scenes author."""

    def run(self):
        super().run()
        self.compare_owners()
        self.compare_velocities()
        self.compare_breaks()
        self.compare_bounds()
        return self.found

    def is_weighed(self, path):
        """All colliders that count have closed forms, and one of them counts; the oracle weighs no
        meshes, whatever they collide as."""
        collisions = self.bodies()[path]["collisions"]
        enabled = [self.rows("colliders")[p] for p in collisions
                   if p in self.rows("colliders") and self.rows("colliders")[p]["enabled"]]
        shapes = ("box", "sphere", "capsule", "cylinder", "cone")
        return bool(enabled) and all(
            row["shape"] in shapes and
            self.stage.GetPrimAtPath(row["path"]).GetTypeName() != "Mesh" for row in enabled)

    def compare_owners(self):
        """The scene that an object names simulates it, else the first one; OpenUSD lists what is
        named, be it a scene or not. A collider goes with its body."""
        scenes = [str(prim.GetPath()) for prim in self.stage.Traverse()
                  if prim.GetTypeName() == "PhysicsScene"]

        def owner_of(row):
            named = [path for path in row["simulationOwners"] if path in scenes]
            return (named or scenes or [None])[0]

        wanted = {path: owner_of(row) for _, path, row in self.objects(["RigidBody"])}
        for path, ours in self.rows("bodies").items():
            if ours["scene"] != wanted.get(path):
                self.add("body-owner", path, (wanted.get(path), ours["scene"]))
        for _, path, row in self.objects(physics.SHAPES):
            ours = self.rows("colliders").get(path)
            if ours is not None:
                owner = wanted[ours["body"]] if ours["body"] else owner_of(row)
                if ours["scene"] != owner:
                    self.add("collider-owner", path, (owner, ours["scene"]))

    def compare_velocities(self):
        for path, row in self.bodies().items():
            ours = self.rows("bodies").get(path)
            if ours is None or row["kinematicBody"]:
                continue
            units = {"linearVelocity": self.length, "angularVelocity": physics.DEGREE}
            for name, unit in units.items():
                wanted = np.array(row[name]) * unit
                if not physics.close(wanted, ours[name], self.extent):
                    self.add(f"body-{name}", path, (wanted.tolist(), ours[name]))

    def same_bound(self, kind, path, wanted, actual, unit):
        if wanted is not None and physics.unlimited(wanted) is None:
            wanted = None
        if (wanted is None) != (actual is None):
            self.add(kind, path, (wanted, actual))
        elif wanted is not None and not physics.close(wanted * unit, actual, 1e-9):
            self.add(kind, path, (wanted * unit, actual))

    def compare_breaks(self):
        force = self.mass * self.length
        for _, path, row in self.objects(physics.JOINTS):
            ours = self.rows("joints").get(path)
            if ours is not None:
                self.same_bound("break-force", path, row["breakForce"], ours["breakForce"], force)
                self.same_bound("break-torque", path, row["breakTorque"], ours["breakTorque"],
                                force * self.length)

    def compare_bounds(self):
        for _, path, row in self.objects(["SphericalJoint"]):
            ours = self.rows("joints").get(path)
            limit = row["limit"]
            if ours is not None:
                for end, name in (("lower", "coneAngle0"), ("upper", "coneAngle1")):
                    wanted = limit[end] if limit["enabled"] else None
                    self.same_bound("cone", path, wanted, ours[name], physics.DEGREE)
        for _, path, row in self.objects(["DistanceJoint"]):
            ours = self.rows("joints").get(path)
            if ours is not None:
                low = row["limit"]["lower"] if row["minEnabled"] else None
                high = row["limit"]["upper"] if row["maxEnabled"] else None
                self.same_bound("distance", path, low, ours["lower"], self.length)
                self.same_bound("distance", path, high, ours["upper"], self.length)


def sheared_collider(case, kind, path):
    ours = case.rows("colliders").get(path)
    if not kind.startswith("collider-") or ours is None:
        return False
    return any(is_sheared(case.stage, p) for p in (path, ours["body"]) if p)


def sheared_mass(case, kind, path):
    return kind in ("mass", "center-of-mass", "inertia") and any(
        is_sheared(case.stage, p) for p in [path, *case.bodies()[path]["collisions"]])


def mirrored(case, kind, path):
    """A mirror is a half turn and three negative scales in OpenUSD, which loses it in some."""
    if kind.startswith("collider-"):
        ours = case.rows("colliders").get(path)
        return ours is not None and any(is_mirrored(case.stage, p)
                                        for p in (path, ours["body"]) if p)
    if kind in ("center-of-mass", "inertia"):
        return any(is_mirrored(case.stage, p)
                   for p in [path, *case.bodies()[path]["collisions"]])
    return False


def articulation(case, kind, path):
    """(row of OpenUSD, its enabled joints as tenon reads them), or None for other findings."""
    if kind != "articulation-roots":
        return None
    row = next(row for _, p, row in case.objects(["Articulation"]) if p == path)
    joints = [case.rows("joints")[p] for p in row["articulatedJoints"] if p in case.rows("joints")]
    return row, [joint for joint in joints if joint["enabled"]]


def single_body(case, kind, path):
    """OpenUSD roots an articulation in bodies without joints too."""
    found = articulation(case, kind, path)
    if found is None:
        return False
    jointed = {joint[side] for joint in found[1] for side in ("body0", "body1")}
    ours = {a["root"] for a in case.raw["articulations"] if a["path"] == path}
    extra = set(found[0]["rootPrims"]) - ours
    return bool(extra) and not extra & jointed and extra <= set(case.rows("bodies"))


def irreducible(case, kind, path):
    """OpenUSD makes trees of distance joints and of joints with free axes too."""
    found = articulation(case, kind, path)
    return found is not None and any(j["type"] in ("distance", "d6") for j in found[1])


def several_bases(case, kind, path):
    """Of several joints to the world OpenUSD takes another than the first."""
    found = articulation(case, kind, path)
    return found is not None and \
        sum(j["body0"] is None or j["body1"] is None for j in found[1]) > 1


def unusable_root(case, kind, path):
    """OpenUSD accepts kinematic and disabled bodies as roots, and joints to the world of such."""
    found = articulation(case, kind, path)
    if found is None:
        return False
    dynamic = {p for p, body in case.rows("bodies").items() if not body["kinematic"]}
    bodies = {p for _, p, _ in case.objects(["RigidBody"])}
    sides = {p: {row["body0"], row["body1"]} & bodies for _, p, row in case.objects(physics.JOINTS)}
    roots = [sides.get(root, {root} & bodies) for root in found[0]["rootPrims"]]
    return any(root and not root & dynamic for root in roots)


def sheared_anchor(case, kind, path):
    """OpenUSD scales anchors on sheared bodies along axes in the order of its eigenvalue solver."""
    if not kind.startswith("joint-position"):
        return False
    row = next(row for _, p, row in case.objects(physics.JOINTS) if p == path)
    target = row[f"body{kind[-1]}"]
    return bool(target) and is_sheared(case.stage, target)


def no_body(case, kind, path):
    """OpenUSD lists joints without any body."""
    row = next((row for _, p, row in case.objects(physics.JOINTS) if p == path), None)
    return kind == "joint-missing" and not {row["body0"], row["body1"]} & set(case.bodies())


def inherited_binding(case, kind, path):
    """OpenUSD looks for a binding only where the collider itself has MaterialBindingAPI."""
    prim = case.stage.GetPrimAtPath(path)
    return kind == "collider-material" and not prim.HasAPI("MaterialBindingAPI")


def moments_without_axes(case, kind, path):
    """OpenUSD turns authored moments by the principal axes of the computed inertia."""
    if kind != "inertia" or case.authored(path, "diagonalInertia") is None or \
            case.authored(path, "principalAxes") is not None:
        return False
    unit = case.mass * case.length**2
    wanted = np.sort(np.array(case.oracle["mass"][path]["inertia"]) * unit)
    ours = np.array(case.rows("bodies")[path]["inertia"]).reshape(3, 3)
    return physics.close(wanted, np.sort(np.linalg.eigvalsh(ours)), wanted[2])


def body_and_collider(case, kind, path):
    """OpenUSD takes the mass API of a body that is a collider too for both, then adds up."""
    if kind not in ("center-of-mass", "inertia"):
        return False
    authored = any(case.authored(path, name) is not None
                   for name in ("mass", "centerOfMass", "diagonalInertia"))
    collisions = case.bodies().get(path, {"collisions": []})["collisions"]
    return authored and path in collisions and len(collisions) > 1


FAULTS = {
    "a round shape or box turned under a scale that is not uniform is exact here (S-56)":
        sheared_collider,
    "volumes and offsets under shear follow the exact shapes (S-33, S-56)": sheared_mass,
    "a mirror goes into the shapes, whose poses stay proper (S-34, S-55)": mirrored,
    "the order of scales under shear is arbitrary in OpenUSD (S-84)": sheared_anchor,
    "a body without joints is a plain body (S-112)": single_body,
    "joints that no reduced solver takes are constraints (S-114)": irreducible,
    "the first of several joints to the world is the root (S-110)": several_bases,
    "kinematic and disabled bodies are no roots (S-113)": unusable_root,
    "a joint without a body is left out (S-88)": no_body,
    "a material bound above a collider without the binding API counts (S-69)": inherited_binding,
    "moments without axes are about the axes of the body (S-46, M-16)": moments_without_axes,
    "the mass API of a body that is a collider too is the body's alone (S-39, M-14)":
        body_and_collider,
}


def differences(program, text, excused):
    """-> {"kind path": detail} of one scene; counts in `excused` what FAULTS explain."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.usda")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        try:
            stage = Usd.Stage.Open(path)
        except Tf.ErrorException:
            return {}
        command = [program, "physics", path, "--json"]
        for reading in READINGS:
            command += ["--reading", reading]
        run = subprocess.run(command, capture_output=True, text=True, check=False)
        if run.returncode not in (0, 1) or not run.stdout:
            return {"not-opened -": run.stderr[-1000:] or run.stdout[:500]}
        case = RandomCase("-", physics_oracle.read(stage), json.loads(run.stdout), stage)
        found = {}
        for key, detail in case.run():
            kind, where = key.split(" ", 2)[1:]
            fault = next((why for why, holds in FAULTS.items() if holds(case, kind, where)), None)
            if fault:
                excused[fault] += 1
            else:
                found[f"{kind} {where}"] = detail
        return found


def shrink(program, scene, kind, most_runs):
    """The smallest scene found that still differs in the same kind."""
    runs, smaller = 0, True
    while smaller and runs < most_runs:
        smaller = False
        for part in scene.smaller():
            runs += 1
            if runs > most_runs:
                break
            found = differences(program, part.text(), Counter())
            if any(key.split()[0] == kind for key in found):
                scene, smaller = part, True
                break
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--tenon", required=True)
    parser.add_argument("--seeds", type=int, default=SEEDS)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--keep", help="folder for the smallest scenes that differ")
    parser.add_argument("--shrink-runs", type=int, default=SHRINK_RUNS)
    arguments = parser.parse_args()
    excused, failed = Counter(), []
    for seed in range(arguments.first, arguments.first + arguments.seeds):
        scene = physics_scenes.make_scene(seed)
        found = differences(arguments.tenon, scene.text(), excused)
        if not found:
            continue
        kind = sorted(found)[0].split()[0]
        failed.append(seed)
        smallest = shrink(arguments.tenon, scene, kind, arguments.shrink_runs)
        left = differences(arguments.tenon, smallest.text(), Counter())
        print(f"seed {seed}: {len(found)} differences, the smallest scene with `{kind}`:")
        print(smallest.text())
        for key, detail in left.items():
            print(f"    {key}: {detail}")
        if arguments.keep:
            name = os.path.join(arguments.keep, f"{kind}_{seed}.usda")
            with open(name, "w", encoding="utf-8") as file:
                file.write(smallest.text())
    unused = [why for why in FAULTS if not excused[why]]
    for why, count in excused.items():
        print(f"excused {count} times: {why}")
    if arguments.seeds >= SEEDS_OF_A_LONG_RUN:
        for why in unused:
            print(f"a fault that excuses nothing: {why}")
    print(f"{arguments.seeds} scenes, {len(failed)} differ")
    return 1 if failed or (unused and arguments.seeds >= SEEDS_OF_A_LONG_RUN) else 0


if __name__ == "__main__":
    sys.exit(main())
