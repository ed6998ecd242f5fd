#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon inertia` of published robots beside PhysX's generalized mass matrix, at random poses.

    physx_matrices.py ROOT TENON [COUNT]

Runs in an environment with ovphysx (tests/engines_beside/requirements-ovphysx.txt). COUNT robots
(40 without it), an even choice of the descriptions in build/robots, which
tests/convert/ten_robots.py makes, are converted by tenon. ovphysx reads each asset on the
processor, and its joints are put where `tenon inertia --pose` puts them. Of a robot that hangs on
the world the matrix of its joints is compared; of one that floats that of its joints while nothing
holds it, which does not depend on the link that PhysX has chosen as the root. PhysX computes in
single precision and its matrix has no armature, which is taken off here: every number agrees to
1e-4 of the size of its row and column.
"""

import collections
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

RESULTS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)  # what the libraries print

try:
    import numpy as np
    import ovphysx
    import ovstage
    from ovphysx.samples.python_samples.schema_support import physx_schema_paths
    from ovphysx.types import GlobalConfigKey, TensorType
except ImportError as error:
    print(f"skipped: {error}", file=RESULTS)
    sys.exit(77)

from random_poses import descriptions, random_pose  # noqa: E402

ROOT = pathlib.Path(sys.argv[1])
TENON = sys.argv[2]
COUNT = int(sys.argv[3]) if len(sys.argv) > 3 else 40
ROBOTS = ROOT / "build/robots"
CLOSE = 1e-4


def say(*words):
    print(*words, file=RESULTS, flush=True)


def tenon(*arguments):
    done = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True, text=True,
                          check=False)
    answer = json.loads(done.stdout)
    if done.returncode not in (0, 1):
        raise LookupError(next((finding["message"] for finding in answer["diagnostics"]
                                if finding["severity"] == "error"), "no error is told"))
    return answer


class Own:
    """What tenon says of an asset: coordinates of joints by name, and its mass matrix without
    armature."""

    def __init__(self, asset, chance):
        physics = tenon("physics", asset)
        for row in tenon("physics", asset, "--mass")["masses"]:
            if None in (row["authored"]["mass"], row["authored"]["inertia"]):
                raise LookupError("a mass or inertia is computed, by PhysX of its own hulls")
        joints = {joint["path"]: joint for joint in physics["joints"]}
        followers = {(path, mimic["dof"]) for path, joint in joints.items()
                     for mimic in joint["mimics"]}
        pose = random_pose(tenon("inertia", asset)["coordinates"], followers, chance)
        answer = tenon("inertia", asset, "--matrix", *(["--pose", pose] if pose else []))
        rows = answer["coordinates"]
        self.roots = [articulation["path"] for articulation in physics["articulations"]]
        self.places = [i for i, row in enumerate(rows) if row["joint"] is not None]
        self.names = [rows[i]["joint"].rsplit("/", 1)[1] for i in self.places]
        self.positions = [rows[i]["position"] for i in self.places]
        if len(set(self.names)) < len(self.names):
            raise LookupError("two coordinates of one name")
        self.matrix = np.array(answer["massMatrix"])
        for i in self.places:
            self.matrix[i, i] -= joints[rows[i]["joint"]]["armature"]


def of_joints(matrix, joints):
    """(floats, the matrix of the joints while nothing holds the root)"""
    root = [i for i in range(len(matrix)) if i not in set(joints)]
    held = matrix[np.ix_(joints, joints)]
    if not root:
        return False, held
    across = matrix[np.ix_(root, joints)]
    return True, held - across.T @ np.linalg.solve(matrix[np.ix_(root, root)], across)


def physx_matrix(physx, asset, own):
    """The mass matrix of PhysX and the places of tenon's coordinates in it."""
    stage = ovstage.Stage("scene")
    try:
        ovstage.population.open_usd(stage, str(asset), ordinal=1,
                                    domains=ovstage.PopulationDomain.ALL)
        stage.advance_write_floor(ordinal=1).wait()
        physx.wait_task(physx.attach_ovstage(stage, read_ordinal=1))

        def bound(kind):
            return physx.create_tensor_binding(prim_paths=own.roots, tensor_type=kind)

        with bound(TensorType.ARTICULATION_DOF_POSITION) as positions:
            names = positions.dof_names
            if sorted(names) != sorted(own.names):
                raise LookupError(f"{len(own.names)} coordinates here, {len(names)} in PhysX")
            order = [names.index(name) for name in own.names]
            values = np.zeros(positions.shape, dtype=np.float32)
            values[0, order] = own.positions
            positions.write(values)
        with bound(TensorType.ARTICULATION_MASS_MATRIX) as masses:
            matrix = np.zeros(masses.shape, dtype=np.float32)
            masses.read(matrix)
        matrix = matrix[0].astype(float)
        extra = len(matrix) - len(names)
        return matrix, [extra + i for i in order]
    finally:
        if physx.is_stage_attached(stage):
            physx.wait_task(physx.detach_ovstage())
        stage.destroy()


def compare(physx, source, folder, chance):
    """("floats" or "hangs", the largest error)"""
    asset = folder / "robot.usda"
    tenon("convert", source, asset)
    own = Own(asset, chance)
    if len(own.roots) != 1 or not own.places:
        raise LookupError(f"{len(own.roots)} articulations, {len(own.places)} coordinates")
    matrix, places = physx_matrix(physx, asset, own)
    floats, wanted = of_joints(own.matrix, own.places)
    floats_there, found = of_joints(matrix, places)
    if floats != floats_there:
        raise LookupError("only one of the two has a free root")
    size = np.sqrt(np.outer(np.diag(wanted), np.diag(wanted)))
    return "floats" if floats else "hangs", float(np.max(np.abs(found - wanted) / size))


def main():
    files = descriptions(ROBOTS, COUNT)
    if not files:
        say("skipped: there are no published robots in build/robots")
        return 77
    ovphysx.set_global_config(GlobalConfigKey.NUM_THREADS, 0)
    ovphysx.PhysX.set_cpu_mode(True)
    physx = ovphysx.PhysX()
    ovstage.population.register_usd_schemas(
        [*map(str, physx_schema_paths()), str(ovphysx.newton_schema_root())])
    worst, counts, wrong, passed_by = {}, collections.Counter(), 0, []
    for number, source in enumerate(files):
        name = source.relative_to(ROBOTS)
        with tempfile.TemporaryDirectory() as folder:
            try:
                kind, error = compare(physx, source, pathlib.Path(folder), random.Random(number))
            except (LookupError, np.linalg.LinAlgError) as reason:
                passed_by.append(f"{name}: {reason}")
                continue
        counts[kind] += 1
        worst[kind] = max(worst.get(kind, 0.0), error)
        if not error <= CLOSE:
            wrong += 1
            say(f"{name}: it {kind}, {error:.1e}")
    for line in passed_by:
        say("not compared: " + " ".join(line.split()))
    compared = sum(counts.values())
    say(f"{compared} robots, {wrong} wrong; worst: "
        + ", ".join(f"{error:.1e} of {counts[kind]} whose root {kind}"
                    for kind, error in worst.items()))
    return 0 if not wrong and compared >= len(files) // 2 else 1


if __name__ == "__main__":
    code = main()
    RESULTS.flush()
    os._exit(code)  # without the libraries' own ends
