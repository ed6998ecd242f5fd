# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares `tenon physics --json` with OpenUSD's own physics parser: which objects there are,
frames, sizes, masses, limits, gains and filtered pairs. Needs Python with OpenUSD's modules.

usage: physics.py --tenon PROGRAM [--list] [FILE...]

Without FILE: the hand of examples/, scenes of this project and, where the folder named by
TENON_SHARED_DIR (default: ../shared) is, the other hand, the seven scenes and the published physics
suite, each under every variant of its default prim's set "Physics". OpenUSD computes in floats:
numbers agree within
1e-3. Known misses are named with their reason in physics_misses.txt: one more or one less makes
this fail.
"""

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

os.environ.setdefault("PXR_WORK_THREAD_LIMIT", "1")
try:
    import numpy as np
    from pxr import Sdf, Usd
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

HERE = os.path.dirname(os.path.abspath(__file__))
REPO = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
import suite  # noqa: E402  pylint: disable=wrong-import-position

SHARED = suite.SHARED
TOLERANCE = 1e-3
DEGREE = math.pi / 180
SHAPES = {
    "CubeShape": "box",
    "SphereShape": "sphere",
    "CapsuleShape": "capsule",
    "CylinderShape": "cylinder",
    "ConeShape": "cone",
    "PlaneShape": "plane",
    "SpherePointsShape": "spheres",
}
JOINTS = {
    "RevoluteJoint": "revolute",
    "PrismaticJoint": "prismatic",
    "SphericalJoint": "spherical",
    "FixedJoint": "fixed",
    "DistanceJoint": "distance",
    "D6Joint": "d6",
}


def close(a, b, scale=1.0):
    """Equal within the tolerance of floats, relative to `scale` or to themselves."""
    a = np.asarray(a, dtype=float)
    b = np.asarray(b, dtype=float)
    if a.shape != b.shape or not np.all(np.isfinite(a)) or not np.all(np.isfinite(b)):
        return False
    return bool(np.all(np.abs(a - b) <= TOLERANCE * np.maximum(scale, np.maximum(abs(a), abs(b)))))


def rotation(q):
    """3x3 matrix (columns are the images of the axes) of w, x, y, z."""
    w, x, y, z = np.asarray(q, dtype=float) / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def same_rotation(p, q):
    return bool(np.abs(rotation(p) - rotation(q)).max() <= TOLERANCE)


def unlimited(value):
    """None for what OpenUSD writes for no limit."""
    value = float(value)
    return None if not math.isfinite(value) or abs(value) >= 0.5e38 else value


class Case:
    """One file under one variant: what differs between the two readings."""

    def __init__(self, name, oracle, ours, stage):
        self.name = name
        self.oracle = oracle
        self.ours = {
            key: {row["path"]: row for row in rows if row.get("path")}
            for key, rows in ours.items()
            if isinstance(rows, list) and rows and isinstance(rows[0], dict) and "path" in rows[0]
        }
        self.raw = ours
        self.stage = stage
        self.length = oracle["metersPerUnit"]
        self.mass = oracle["kilogramsPerUnit"]
        self.extent = 1e-3  # metres that count as small in this scene
        self.found = []

    def add(self, kind, path, detail=""):
        self.found.append((f"{self.name} {kind} {path}", str(detail)[:300]))

    def objects(self, kinds):
        for kind in kinds:
            for path, row in self.oracle["objects"].get(kind, []):
                yield kind, path, row

    def rows(self, key):
        return self.ours.get(key, {})

    def same_paths(self, what, expected, actual):
        for path in sorted(set(expected) - set(actual)):
            self.add(f"{what}-missing", path)
        for path in sorted(set(actual) - set(expected)):
            self.add(f"{what}-extra", path)

    def run(self):
        self.compare_scenes()
        self.compare_bodies()
        self.compare_masses()
        self.compare_shapes()
        self.compare_materials()
        self.compare_joints()
        self.compare_articulations()
        self.compare_pairs()
        return self.found

    # -- scenes and bodies

    def compare_scenes(self):
        scenes = {path: row for _, path, row in self.objects(["Scene"])}
        self.same_paths("scene", scenes, self.rows("scenes"))
        for path, row in scenes.items():
            ours = self.rows("scenes").get(path)
            wanted = np.array(row["gravityDirection"]) * row["gravityMagnitude"] * self.length
            if ours and not close(wanted, ours["gravity"]):
                self.add("gravity", path, (list(wanted), ours["gravity"]))

    def bodies(self):
        return {p: r for _, p, r in self.objects(["RigidBody"]) if r["rigidBodyEnabled"]}

    def compare_bodies(self):
        bodies = self.bodies()
        self.same_paths("body", bodies, self.rows("bodies"))
        for path, row in bodies.items():
            ours = self.rows("bodies").get(path)
            if ours is None:
                continue
            wanted = np.array(row["position"]) * self.length
            if not close(wanted, ours["position"], self.extent):
                self.add("body-position", path, (list(wanted), ours["position"]))
            if not same_rotation(row["rotation"], ours["orientation"]):
                self.add("body-orientation", path, (row["rotation"], ours["orientation"]))
            if row["kinematicBody"] != ours["kinematic"]:
                self.add("body-kinematic", path)
            if row["startsAsleep"] != ours["startsAsleep"]:
                self.add("body-asleep", path)

    def authored(self, path, name):
        attribute = self.stage.GetPrimAtPath(path).GetAttribute(f"physics:{name}")
        return attribute.Get() if attribute and attribute.HasAuthoredValue() else None

    def small_inertia(self, path):
        """A real inertia that is so small that OpenUSD takes it for unauthored (S-45)."""
        diagonal = self.authored(path, "diagonalInertia")
        if diagonal is None or not 0 < np.linalg.norm(diagonal) <= 1e-5:
            return None
        axes = self.authored(path, "principalAxes")
        turn = rotation([axes.real, *axes.imaginary]) if axes else np.eye(3)
        return turn @ np.diag(diagonal) @ turn.T * self.mass * self.length**2

    def principal_turn(self, path, row):
        """OpenUSD leaves the axes as they lay in memory where inertia is authored and they are not;
        mostly, but not always, these are no turn."""
        axes = np.asarray(row["principalAxes"], dtype=float)
        is_turn = np.all(np.isfinite(axes)) and abs(np.linalg.norm(axes) - 1) <= TOLERANCE
        left_alone = (self.authored(path, "diagonalInertia") is not None
                      and self.authored(path, "principalAxes") is None)
        return np.eye(3) if left_alone and not is_turn else rotation(axes)

    def is_weighed(self, path):
        """The oracle's mass is its own: it knows volumes of boxes and balls only."""
        if all(self.authored(path, name) is not None
               for name in ("mass", "centerOfMass", "diagonalInertia")):
            return True
        shapes = {p: k for k, p, _ in self.objects(SHAPES)}
        known = [shapes.get(p) in ("CubeShape", "SphereShape")
                 for p in self.bodies()[path]["collisions"]]
        return bool(known) and all(known)

    def compare_masses(self):
        for path, row in self.oracle["mass"].items():
            ours = self.rows("bodies").get(path)
            if ours is None or "mass" not in row or not self.is_weighed(path):
                continue
            mass = row["mass"] * self.mass
            if not close(mass, ours["mass"], 1e-9):
                self.add("mass", path, (mass, ours["mass"]))
            com = np.array(row["com"]) * self.length
            if not close(com, ours["centerOfMass"], self.extent):
                self.add("center-of-mass", path, (list(com), ours["centerOfMass"]))
            wanted = self.small_inertia(path)
            if wanted is None:
                axes = self.principal_turn(path, row)
                unit = self.mass * self.length**2
                wanted = axes @ np.diag(np.array(row["inertia"]) * unit) @ axes.T
            actual = np.array(ours["inertia"]).reshape(3, 3)
            if not close(wanted, actual, np.trace(wanted)):
                self.add("inertia", path, (wanted.tolist(), ours["inertia"]))

    # -- colliders

    def compare_shapes(self):
        kinds = list(SHAPES) + ["MeshShape", "CustomShape", "Capsule1Shape", "Cylinder1Shape"]
        shapes = {path: (kind, row) for kind, path, row in self.objects(kinds)}
        self.same_paths("collider", shapes, self.rows("colliders"))
        for path, (kind, row) in shapes.items():
            ours = self.rows("colliders").get(path)
            if ours is not None:
                self.compare_shape(path, kind, row, ours)

    def compare_shape(self, path, kind, row, ours):
        if (row["rigidBody"] or None) != ours["body"] and row["rigidBody"] in self.bodies():
            self.add("collider-body", path, (row["rigidBody"], ours["body"]))
        if row["collisionEnabled"] != ours["enabled"]:
            self.add("collider-enabled", path)
        materials = [m for m in row["materials"] if m]
        if (materials[0] if materials else None) != ours["material"]:
            self.add("collider-material", path, (materials, ours["material"]))
        if kind in SHAPES and SHAPES[kind] != ours["shape"]:
            self.add("collider-shape", path, (kind, ours["shape"]))
            return
        if kind in SHAPES:
            self.compare_sizes(path, row, ours)
        if ours["shape"] in ("box", "sphere") and kind == "MeshShape":
            return  # a bounding solid has a pose of its own
        wanted = np.array(row["localPos"]) * self.length
        if not close(wanted, ours["position"], self.extent):
            self.add("collider-position", path, (wanted.tolist(), ours["position"]))
        if not same_rotation(row["localRot"], ours["orientation"]):
            self.add("collider-orientation", path, (row["localRot"], ours["orientation"]))

    def compare_sizes(self, path, row, ours):
        for name in ("halfExtents", "radius", "halfHeight"):
            if name in row and name in ours:
                wanted = np.abs(np.array(row[name])) * self.length
                if not close(wanted, ours[name], self.extent):
                    self.add(f"collider-{name}", path, (wanted.tolist(), ours[name]))
        if "axis" in row and "axis" in ours and row["axis"] != ours["axis"]:
            self.add("collider-axis", path, (row["axis"], ours["axis"]))

    def compare_materials(self):
        for _, path, row in self.objects(["RigidBodyMaterial"]):
            ours = self.rows("materials").get(path)
            if ours is None:
                self.add("material-missing", path)
                continue
            for name in ("staticFriction", "dynamicFriction", "restitution"):
                if not close(row[name], ours[name]):
                    self.add(f"material-{name}", path, (row[name], ours[name]))

    # -- joints

    def compare_joints(self):
        joints = {path: (kind, row) for kind, path, row in self.objects(JOINTS)}
        self.same_paths("joint", joints, self.rows("joints"))
        for path, (kind, row) in joints.items():
            ours = self.rows("joints").get(path)
            if ours is None:
                continue
            if JOINTS[kind] != ours["type"]:
                self.add("joint-type", path, (kind, ours["type"]))
                continue
            for side in (0, 1):
                self.compare_side(path, row, ours, side)
            if row["jointEnabled"] != ours["enabled"]:
                self.add("joint-enabled", path)
            if row["collisionEnabled"] != ours["collisionEnabled"]:
                self.add("joint-collision", path)
            if "axis" in row and row["axis"] != ours["axis"]:
                self.add("joint-axis", path, (row["axis"], ours["axis"]))
            self.compare_limits(path, kind, row, ours)
            self.compare_drives(path, kind, row, ours)

    def compare_side(self, path, row, ours, side):
        body = row[f"body{side}"]
        is_body = body in self.bodies()
        if (body if is_body else None) != ours[f"body{side}"]:
            self.add(f"joint-body{side}", path, (body, ours[f"body{side}"]))
            return
        position = np.array(row[f"localPose{side}Position"])
        turn = rotation(row[f"localPose{side}Orientation"])
        if body and not is_body:  # the frame is seen from a static collider
            shape = next((r for _, p, r in self.objects(SHAPES) if p == body), None)
            if shape is None:
                return
            position = np.array(shape["localPos"]) + rotation(shape["localRot"]) @ position
            turn = rotation(shape["localRot"]) @ turn
        frame = ours[f"frame{side}"]
        if not close(position * self.length, frame["position"], self.extent):
            self.add(f"joint-position{side}", path, (position.tolist(), frame["position"]))
        if np.abs(turn - rotation(frame["orientation"])).max() > TOLERANCE:
            self.add(f"joint-orientation{side}", path, frame["orientation"])

    def compare_limits(self, path, kind, row, ours):
        if kind in ("RevoluteJoint", "PrismaticJoint"):
            unit = DEGREE if kind == "RevoluteJoint" else self.length
            limit = row["limit"]
            for end in ("lower", "upper"):
                wanted = unlimited(limit[end])
                if not limit["enabled"]:
                    wanted = None
                actual = ours[end]
                if (wanted is None) != (actual is None):
                    self.add(f"joint-{end}", path, (limit, actual))
                elif wanted is not None and not close(wanted * unit, actual):
                    self.add(f"joint-{end}", path, (wanted * unit, actual))
        elif kind == "D6Joint":
            theirs = {pair["first"][0].lower() + pair["first"][1:]: pair["second"]
                      for pair in row["jointLimits"] if pair["second"]["enabled"]}
            own = {limit["dof"]: limit for limit in ours["limits"]}
            if set(theirs) - set(own):
                self.add("joint-limits", path, (sorted(theirs), sorted(own)))
            for dof in sorted(set(theirs) & set(own)):
                unit = DEGREE if dof.startswith("rot") else self.length
                for end in ("lower", "upper"):
                    wanted = unlimited(theirs[dof][end])
                    same = (wanted is None) == (own[dof][end] is None) and (
                        wanted is None or close(wanted * unit, own[dof][end])
                    )
                    if not same:
                        self.add(f"joint-{dof}-{end}", path, (wanted, own[dof][end]))

    def compare_drives(self, path, kind, row, ours):
        theirs = {}
        if kind == "D6Joint":
            theirs = {p["first"][0].lower() + p["first"][1:]: p["second"]
                      for p in row["jointDrives"]}
        elif "drive" in row:
            letter = row["axis"]
            theirs = {("rot" if kind == "RevoluteJoint" else "trans") + letter: row["drive"]}
        own = {drive["dof"]: drive for drive in ours["drives"] if drive["source"] == path}
        replaced = {drive["dof"] for drive in ours["drives"] if drive["source"] != path}
        for dof, drive in theirs.items():
            if not drive["enabled"] or dof in replaced:
                continue
            if dof not in own:
                self.add("drive-missing", f"{path}.{dof}")
                continue
            self.compare_drive(f"{path}.{dof}", dof.startswith("rot"), drive, own[dof])

    def compare_drive(self, name, angular, theirs, own):
        acceleration = theirs["acceleration"]
        inertia = 1.0 if acceleration else self.mass * (self.length**2 if angular else 1.0)
        gain = inertia / DEGREE if angular else inertia
        target = DEGREE if angular else self.length
        force = self.mass * self.length * (self.length if angular else 1.0)
        for key, unit, ours in (
            ("stiffness", gain, "stiffness"),
            ("damping", gain, "damping"),
            ("targetPosition", target, "targetPosition"),
            ("targetVelocity", target, "targetVelocity"),
            ("forceLimit", force, "maxForce"),
        ):
            wanted = unlimited(theirs[key])
            if (wanted is None) != (own[ours] is None):
                self.add(f"drive-{ours}", name, (theirs[key], own[ours]))
            elif wanted is not None and not close(wanted * unit, own[ours], 1e-9):
                self.add(f"drive-{ours}", name, (wanted * unit, own[ours]))
        if ("acceleration" if acceleration else "force") != own["type"]:
            self.add("drive-type", name)

    def compare_articulations(self):
        for _, path, row in self.objects(["Articulation"]):
            roots = sorted(r for r in row["rootPrims"] if r)
            ours = sorted(a["root"] for a in self.raw["articulations"] if a["path"] == path)
            if roots != ours:
                self.add("articulation-roots", path, (roots, ours))

    # -- filters

    def off_by_groups(self):
        """Collider pairs that the oracle's group table turns off."""
        table = self.oracle.get("collisionGroupTable")
        shapes = {p: set(r["collisionGroups"]) for _, p, r in
                  self.objects(list(SHAPES) + ["MeshShape"]) if r["collisionGroups"]}
        pairs = set()
        if table is None:
            return pairs
        index = {group: i for i, group in enumerate(table["groups"])}
        for a in shapes:
            for b in shapes:
                off = any(not table["enabled"][index[g]][index[h]]
                          for g in shapes[a] for h in shapes[b] if g in index and h in index)
                if a < b and off:
                    pairs.add((a, b))
        return pairs

    def off_by_name(self):
        """Collider pairs that filteredPairs of bodies and colliders turn off."""
        bodies = self.bodies()

        def colliders(path):
            return bodies[path]["collisions"] if path in bodies else [path]

        pairs = set()
        for _, path, row in self.objects(list(SHAPES) + ["MeshShape", "RigidBody"]):
            for other in row["filteredCollisions"]:
                for a in colliders(path):
                    for b in colliders(other):
                        pairs.add((min(a, b), max(a, b)))
        return pairs

    def compare_pairs(self):
        ours = {tuple(pair) for pair in self.raw["disabledPairs"]}
        colliders = self.rows("colliders")
        wanted = set()
        for a, b in self.off_by_groups() | self.off_by_name():
            if a in colliders and b in colliders and colliders[a]["body"] != colliders[b]["body"]:
                # Scenes do not touch: such pairs need no filter (S-21).
                if colliders[a]["enabled"] and colliders[b]["enabled"] and \
                        colliders[a]["scene"] == colliders[b]["scene"]:
                    wanted.add((a, b))
        for a, b in sorted(wanted - ours):
            self.add("pair-missing", f"{a},{b}")
        for a, b in sorted(ours - wanted):
            if not self.is_joined(colliders[a]["body"], colliders[b]["body"]):
                self.add("pair-extra", f"{a},{b}")

    def is_joined(self, a, b):
        for joint in self.raw["joints"]:
            if {joint["body0"], joint["body1"]} == {a, b}:
                return True
        return any(not art["selfCollision"] and a in art["links"] and b in art["links"]
                   for art in self.raw["articulations"])


# -- running both sides


def oracle_of(path, variant):
    """What OpenUSD says, as physics_oracle.py prints it; None when it cannot open it."""
    tool = os.path.join(HERE, "physics_oracle.py")
    with tempfile.TemporaryDirectory() as folder:
        target = path if variant is None else wrapped(path, variant, folder)
        run = subprocess.run([sys.executable, "-B", tool, target], capture_output=True, text=True,
                             check=False)
    return json.loads(run.stdout) if run.returncode == 0 and run.stdout else None


def wrapped(path, variant, folder):
    """A layer over `path` that selects a variant of the set Physics and repeats its metadata."""
    source = Sdf.Layer.FindOrOpen(path)
    target = os.path.join(folder, os.path.basename(path) + ".usda")
    layer = Sdf.Layer.CreateNew(target)
    layer.subLayerPaths.append(path)
    for key in source.pseudoRoot.ListInfoKeys():
        if key not in ("subLayers", "subLayerOffsets"):
            layer.pseudoRoot.SetInfo(key, source.pseudoRoot.GetInfo(key))
    prim = Sdf.CreatePrimInLayer(layer, "/" + source.defaultPrim)
    prim.specifier = Sdf.SpecifierOver
    prim.variantSelections["Physics"] = variant
    layer.Save()
    return target


def ours_of(program, path, variant):
    # Where readers disagree: OpenUSD tells the frames of joints as they are authored.
    command = [program, "physics", path, "--json", "--reading", "fixed-to-world=together"]
    if variant is not None:
        command += ["--physics", variant]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1) or not run.stdout:
        return None, run.stderr[-2000:] or run.stdout[:500]
    return json.loads(run.stdout), ""


def variants_of(path):
    stage = Usd.Stage.Open(path)
    prim = stage.GetDefaultPrim()
    names = []
    if prim and prim.GetVariantSets().HasVariantSet("Physics"):
        names = sorted(prim.GetVariantSet("Physics").GetVariantNames())
    return names or [None]


def default_files():
    files = [os.path.join(REPO, "examples/inspire_hand/inspire_hand.usda"),
             os.path.join(REPO, "examples/inspire_hand/grasp.usda")]
    if not suite.HAS_PUBLISHED:
        return files
    files.append(os.path.join(SHARED, "assets/inspire_hand_isaac/inspire_hand.usda"))
    scenes = os.path.join(SHARED, "scenes")
    for name in sorted(os.listdir(scenes)):
        files.append(os.path.join(scenes, name))
    with open(os.path.join(SHARED, "conformance/cases.txt"), encoding="utf-8") as file:
        for line in file:
            parts = line.rstrip("\n").split("\t")
            if len(parts) == 3 and parts[0] == "physics_parse":
                files.append(os.path.join(SHARED, "conformance", parts[2]))
    return files


def case_name(path, variant):
    base = REPO if path.startswith(REPO + os.sep) else SHARED
    name = os.path.relpath(path, base)
    return name if variant is None else f"{name}:{variant}"


def compare_file(program, path):
    """-> list of (finding, detail), number of cases."""
    try:
        variants = variants_of(path)
    except Exception:  # pylint: disable=broad-except
        return [], 0  # OpenUSD cannot open it
    found = []
    for variant in variants:
        oracle = oracle_of(path, variant)
        if oracle is None:
            continue
        ours, why = ours_of(program, path, variant)
        name = case_name(path, variant)
        if ours is None:
            found.append((f"{name} not-opened -", why))
            continue
        stage = Usd.Stage.Open(path)
        if variant is not None:
            stage.SetEditTarget(stage.GetSessionLayer())
            stage.GetDefaultPrim().GetVariantSet("Physics").SetVariantSelection(variant)
        found += Case(name, oracle, ours, stage).run()
    return found, len(variants)


def compare_files(program, paths):
    """-> (findings, number of cases)"""
    found, cases = [], 0
    for path in paths:
        rows, count = compare_file(program, os.path.abspath(path))
        found += rows
        cases += count
    return found, cases


def is_here(key):
    """The file of a known miss is this project's, or published and here."""
    return suite.HAS_PUBLISHED or os.path.exists(os.path.join(REPO, key.split()[0].split(":")[0]))


def read_misses():
    misses = {}
    with open(os.path.join(HERE, "physics_misses.txt"), encoding="utf-8") as file:
        for line in file:
            line = line.rstrip("\n")
            if line and not line.startswith("#"):
                key, _, reason = line.partition(" | ")
                if not reason:
                    sys.exit(f"physics_misses.txt: no reason for `{key}`")
                misses[key] = reason
    return misses


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--tenon", required=True)
    parser.add_argument("--list", action="store_true", help="print every finding")
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    suite.forget("physics")
    found, cases = compare_files(arguments.tenon, arguments.files or default_files())
    counted = (len({key.split()[0] for key, _ in found}), cases)
    if not arguments.files:
        rows, count = compare_files(arguments.tenon, suite.own_scenes())
        found, cases = found + rows, cases + count
    misses = read_misses()
    new = [(key, detail) for key, detail in found if key not in misses]
    listed = () if arguments.files else filter(is_here, misses)
    gone = sorted(set(listed) - {key for key, _ in found})
    for key, detail in found if arguments.list else new:
        print(f"{key}\n    {detail}")
    for key in gone:
        print(f"listed as a miss but equal: {key}")
    print(f"{cases} cases, {len(found)} differences, {len(new)} new, {len(gone)} listed in vain")
    if not arguments.files and suite.HAS_PUBLISHED:
        missed, counted_cases = counted
        row = ("physics of stages, against UsdPhysics", counted_cases - missed, counted_cases)
        suite.record("physics", [row],
                     {key: misses[key] for key, _ in found if key in misses})
    return 1 if new or gone else 0


if __name__ == "__main__":
    sys.exit(main())
