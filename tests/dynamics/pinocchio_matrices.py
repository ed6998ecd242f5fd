#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Mass matrix, gravity and bias forces of published robots beside Pinocchio, at random poses.

    pinocchio_matrices.py ROOT TENON [COUNT]

COUNT robots (30 without it), an even choice of the URDF files in build/robots and of dm_control's
suite there, which tests/convert/ten_robots.py makes, are converted by tenon. The numbers of
`tenon physics --json` make a model of Pinocchio, which knows nothing of tenon's trees; the Python
package (tenon_usd, in the same interpreter) gives tenon's matrices at three random poses of each,
with random velocities. Every number must agree to 1e-9 of the size of its kind; `tenon inertia
--matrix` at the start must be the package's to the last bit.
"""

import json
import pathlib
import random
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(sys.argv[1])
TENON = sys.argv[2]
COUNT = int(sys.argv[3]) if len(sys.argv) > 3 else 30
ROBOTS = ROOT / "build/robots"
CLOSE = 1e-9
POSES = 3

try:
    import numpy as np
    import pinocchio
    import tenon_usd
except ImportError as missing:
    print(f"skipped: {missing} (python/tests/run.sh, tests/dynamics/requirements-pinocchio.txt)")
    sys.exit(77)


class Skipped(Exception):
    """A robot that cannot be compared, and why."""


def tenon(*arguments):
    done = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True, text=True,
                          check=False)
    try:
        answer = json.loads(done.stdout)
    except json.JSONDecodeError as error:
        raise Skipped(done.stderr.strip()[-200:]) from error
    if done.returncode > 1:
        errors = [one["message"] for one in answer["diagnostics"] if one["severity"] == "error"]
        raise Skipped((errors or ["no error is told"])[0])
    return answer


def chosen():
    """An even choice of all, then the others."""
    files = sorted(ROBOTS.rglob("*.urdf")) + sorted((ROBOTS / "dm_control/suite").glob("*.xml"))
    step = max(1, len(files) // COUNT)
    return files[::step] + [path for i, path in enumerate(files) if i % step]


def placement(words):
    w, x, y, z = words["orientation"]
    return pinocchio.SE3(pinocchio.Quaternion(w, x, y, z).normalized(),
                         np.array(words["position"]))


class Model:
    """The bodies of a scene below the world, each hung on by the joint that a walk meets first."""

    def __init__(self, physics, floating):
        self.model = pinocchio.Model()
        self.model.gravity.linear = np.array(physics["scenes"][0]["gravity"])
        self.bodies = {body["path"]: body for body in physics["bodies"]}
        self.columns = {}  # joint path, or floating body -> first velocity
        self.positions = {}
        self.made = {None: (0, pinocchio.SE3.Identity())}  # body -> joint, place in its frame
        waiting = [joint for joint in physics["joints"] if joint["enabled"]]
        starts = [path for path in floating] + [path for path, body in self.bodies.items()
                                                if body["kinematic"]]
        for path in [*starts, None]:
            if path is not None:
                self.start(path, path in floating)
            # Pinocchio takes what hangs on a joint one after the other: the newest body first.
            branch = [path]
            while branch:
                found = next(((joint, side) for joint in waiting for side in ("body0", "body1")
                              if joint[side] == branch[-1]), None)
                if found is None:
                    branch.pop()
                    continue
                joint, side = found
                waiting.remove(joint)
                other = joint["body1" if side == "body0" else "body0"]
                if other in self.made:
                    raise Skipped("loops: the matrices are those of trees")
                self.hang(joint, side == "body1")
                branch.append(other)
        if len(self.made) <= len(self.bodies):
            raise Skipped("bodies hang on nothing")
        self.data = self.model.createData()

    def put(self, path, joint, place):
        body = self.bodies[path]
        inertia = pinocchio.Inertia(body["mass"], np.array(body["centerOfMass"]),
                                    np.array(body["inertia"]).reshape(3, 3))
        self.model.appendBodyToJoint(joint, inertia, place)
        self.made[path] = (joint, place)

    def start(self, path, floats):
        place = placement(self.bodies[path])
        if not floats:
            self.made[path] = (0, place)
            return
        joint = self.model.addJoint(0, pinocchio.JointModelFreeFlyer(), place, path)
        self.columns[path] = self.model.joints[joint].idx_v
        self.put(path, joint, pinocchio.SE3.Identity())

    def hang(self, joint, reverse):
        names, frames = ["body0", "body1"], ["frame0", "frame1"]
        if reverse:
            names.reverse()
            frames.reverse()
        parent, place = self.made[joint[names[0]]]
        here = place * placement(joint[frames[0]])
        back = placement(joint[frames[1]]).inverse()
        if joint["type"] == "fixed":
            self.put(joint[names[1]], parent, here * back)
            return
        if joint["type"] not in ("revolute", "prismatic"):
            raise Skipped(f"{joint['path']} is {joint['type']}")
        axis = np.eye(3)["XYZ".index(joint["axis"].upper())] * (-1 if reverse else 1)
        kind = (pinocchio.JointModelRevoluteUnaligned if joint["type"] == "revolute"
                else pinocchio.JointModelPrismaticUnaligned)
        made = self.model.addJoint(parent, kind(axis), here, joint["path"])
        self.columns[joint["path"]] = self.model.joints[made].idx_v
        self.positions[joint["path"]] = self.model.joints[made].idx_q
        armature = self.model.armature.copy()
        armature[self.model.joints[made].idx_v] = joint["armature"]
        self.model.armature = armature
        self.put(joint[names[1]], made, back)

    def change(self, coordinates, posture):
        """v_pinocchio = change v_tenon, and what that loses of an acceleration, as a function."""
        pinocchio.forwardKinematics(self.model, self.data, posture)
        result = np.zeros((self.model.nv, len(coordinates)))
        free = {}
        order = ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"]
        for column, row in enumerate(coordinates):
            if row.joint is not None:
                result[self.columns[row.joint], column] = 1
                continue
            first = self.columns[row.body]
            joint, _ = self.made[row.body]
            turn = self.data.oMi[joint].rotation
            arm = turn @ np.array(self.bodies[row.body]["centerOfMass"])
            free.setdefault(row.body, (first, turn, {}))[2][row.dof] = column
            axis = np.eye(3)[order.index(row.dof) % 3]
            if row.dof.startswith("trans"):
                result[first:first + 3, column] = turn.T @ axis
            else:
                result[first:first + 3, column] = turn.T @ -np.cross(axis, arm)
                result[first + 3:first + 6, column] = turn.T @ axis

        def lost(velocities):
            bias = np.zeros(self.model.nv)
            for first, turn, columns in free.values():
                speed = np.array([velocities[columns[dof]] for dof in order[:3]])
                turning = np.array([velocities[columns[dof]] for dof in order[3:]])
                bias[first:first + 3] = -turn.T @ np.cross(turning, speed)
            return bias

        return result, lost

    def matrices(self, own, velocities):
        """Mass matrix, gravity and bias in tenon's coordinates."""
        posture = pinocchio.neutral(self.model)
        for row, value in zip(own.coordinates, own.positions):
            if row.joint is not None:
                posture[self.positions[row.joint]] = value
        change, lost = self.change(own.coordinates, posture)
        if change.shape[0] != change.shape[1]:
            raise Skipped(f"{change.shape[1]} coordinates here, {change.shape[0]} in Pinocchio")
        mass = np.triu(pinocchio.crba(self.model, self.data, posture))
        mass = mass + np.triu(mass, 1).T
        gravity = pinocchio.computeGeneralizedGravity(self.model, self.data, posture).copy()
        bias = pinocchio.nonLinearEffects(self.model, self.data, posture,
                                          change @ velocities) - gravity
        return (change.T @ mass @ change, -change.T @ gravity,
                change.T @ (mass @ lost(velocities) + bias))


def random_pose(own, followers, chance):
    return {row.joint: chance.uniform(-1.5, 1.5) if row.dof.startswith("rot")
            else chance.uniform(-0.05, 0.05)
            for row in own.coordinates if row.joint is not None and row.joint not in followers}


def compare(source, work, chance):
    """-> {kind: worst error}"""
    asset = work / "robot.usda"
    tenon("convert", source, asset, "--force")
    physics = tenon("physics", asset)
    own = tenon_usd.Dynamics(tenon_usd.physics(str(asset)))
    if not own.coordinates:
        raise Skipped("nothing moves")
    said = np.array(tenon("inertia", asset, "--matrix")["massMatrix"])
    if not np.array_equal(said, own.mass_matrix()):
        return {"the command beside the package": 1.0}
    model = Model(physics, list(dict.fromkeys(row.body for row in own.coordinates
                                              if row.joint is None)))
    followers = {joint["path"] for joint in physics["joints"] if joint.get("mimics")}
    worst = {}
    for _ in range(POSES):
        posed = own.moved(random_pose(own, followers, chance))
        velocities = np.array([chance.uniform(-2, 2) for _ in own.coordinates])
        mass, gravity, bias = model.matrices(posed, velocities)
        size = np.sqrt(np.outer(np.diag(mass), np.diag(mass)))
        errors = {"mass matrix": np.abs(posed.mass_matrix() - mass) / size}
        for kind, here, there in (("gravity", posed.gravity_forces(), gravity),
                                  ("bias", posed.bias_forces(velocities), bias)):
            errors[kind] = np.abs(here - there) / max(1e-3, np.abs(there).max())
        for kind, values in errors.items():
            worst[kind] = max(worst.get(kind, 0.0), float(np.max(values)))
    return worst


def main():
    files = chosen()
    if not files:
        print("skipped: there are no published robots in build/robots")
        return 77
    compared = wrong = 0
    worst = {}
    for number, source in enumerate(files):
        name = source.relative_to(ROBOTS)
        with tempfile.TemporaryDirectory() as folder:
            try:
                found = compare(source, pathlib.Path(folder), random.Random(number))
            except (Skipped, tenon_usd.Error) as why:
                print(f"not compared: {name}: " + " ".join(str(why).split())[:200])
                continue
        compared += 1
        for kind, value in found.items():
            worst[kind] = max(worst.get(kind, 0.0), value)
        if not max(found.values()) <= CLOSE:
            wrong += 1
            print(f"{name}: " + ", ".join(f"{kind} {value:.1e}" for kind, value in found.items()))
        if compared == COUNT:
            break
    print(f"{compared} robots at {POSES} poses each, {wrong} wrong; worst: "
          + ", ".join(f"{kind} {value:.1e}" for kind, value in worst.items()))
    return 0 if not wrong and compared >= COUNT else 1


if __name__ == "__main__":
    sys.exit(main())
