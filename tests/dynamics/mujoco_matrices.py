#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon inertia` of published robots beside MuJoCo's mass matrix and gravity, at random poses.

    mujoco_matrices.py ROOT TENON [COUNT]

COUNT robots (30 without it), an even choice of the descriptions in build/robots, which
tests/convert/ten_robots.py makes, are converted by tenon and posed at random. The numbers of
`tenon physics --json` make a model of MuJoCo (PyPI), which knows nothing of tenon's trees. From its
matrix come, by NumPy: the mass matrix in tenon's coordinates, the forces of gravity, and both
effective inertias, with mimics by projection. Every number must agree to 1e-9 of the size of its
kind.
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
sys.path.insert(0, str(ROBOTS))

try:
    import mujoco
    import numpy as np
except ImportError as error:
    print(f"skipped: {error} (tests/convert/ten_robots.py fetches it)")
    sys.exit(77)

from random_poses import descriptions, random_pose  # noqa: E402

CLOSE = 1e-9


def tenon(*arguments):
    done = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True, text=True,
                          check=False)
    try:
        return done.returncode, json.loads(done.stdout)
    except json.JSONDecodeError:
        return done.returncode, {"diagnostics": [{"message": done.stderr[-300:]}]}


def why(answer):
    """The first error of an answer."""
    return next((finding["message"] for finding in answer["diagnostics"]
                 if finding.get("severity") == "error"), "no error is told")


def to_com(model, data, body):
    """Velocities of a free joint to those of the centre of mass, along the axes of the world."""
    offset = data.xipos[body] - data.xpos[body]
    turn = data.xmat[body].reshape(3, 3)
    cross = np.array([[0, -offset[2], offset[1]], [offset[2], 0, -offset[0]],
                      [-offset[1], offset[0], 0]])
    result = np.zeros((6, 6))
    result[:3, :3] = np.eye(3)
    result[:3, 3:] = -cross @ turn
    result[3:, 3:] = turn
    return result


def pose(words):
    """(position, quaternion) of a pose in JSON."""
    return np.array(words["position"]), np.array(words["orientation"])


def product(a, b):
    place, turn = np.zeros(3), np.zeros(4)
    mujoco.mju_mulPose(place, turn, *a, *b)
    return place, turn


def inverse(a):
    place, turn = np.zeros(3), np.zeros(4)
    mujoco.mju_negPose(place, turn, *a)
    return place, turn


def model_of(physics):
    """Bodies below the world, each hung on by the joint that a walk from the world meets first."""
    spec = mujoco.MjSpec()
    spec.option.gravity = physics["scenes"][0]["gravity"]
    joints = [joint for joint in physics["joints"] if joint["enabled"]]
    bodies = {body["path"]: body for body in physics["bodies"]}
    made, waiting = {None: spec.worldbody}, list(joints)
    roots = [path for path in bodies]
    while len(made) <= len(bodies):
        for joint in list(waiting):
            sides = [joint["body0"], joint["body1"]]
            if (sides[0] in made) != (sides[1] in made):
                hang(made, bodies, joint, sides[0] not in made)
                waiting.remove(joint)
                break
        else:
            path = next(path for path in roots if path not in made)
            body = bodies[path]
            made[path] = with_inertia(made[None].add_body(name=path, pos=body["position"],
                                                          quat=body["orientation"]), body)
            if not body["kinematic"]:
                made[path].add_freejoint(name=path)
    if waiting:
        raise LookupError("loops: the matrices are those of trees")
    return spec.compile()


def with_inertia(made, body):
    inertia = body["inertia"]
    made.mass, made.ipos, made.explicitinertial = body["mass"], body["centerOfMass"], True
    made.fullinertia = [inertia[i] for i in (0, 4, 8, 1, 2, 5)]
    return made


def hang(made, bodies, joint, reverse):
    names = ("body1", "body0") if reverse else ("body0", "body1")
    frames = ("frame1", "frame0") if reverse else ("frame0", "frame1")
    own = pose(joint[frames[1]])
    place, turn = product(pose(joint[frames[0]]), inverse(own))
    path = joint[names[1]]
    body = made[joint[names[0]]].add_body(name=path, pos=place, quat=turn)
    made[path] = with_inertia(body, bodies[path])
    if joint["type"] == "fixed":
        return
    if joint["type"] not in ("revolute", "prismatic"):
        raise LookupError(f"{joint['path']} is {joint['type']}")
    axis = np.zeros(3)
    mujoco.mju_rotVecQuat(axis, np.eye(3)["XYZ".index(joint["axis"].upper())], own[1])
    kinds = {"revolute": mujoco.mjtJoint.mjJNT_HINGE, "prismatic": mujoco.mjtJoint.mjJNT_SLIDE}
    body.add_joint(name=joint["path"], type=kinds[joint["type"]], pos=own[0],
                   axis=-axis if reverse else axis, armature=joint["armature"])


class Beside:
    """One robot in both."""

    def __init__(self, asset, work, chance):
        self.asset, self.work = asset, work
        self.worst = {}
        code, before = tenon("inertia", asset)
        if code != 0:
            raise LookupError(why(before))
        _, self.physics = tenon("physics", asset)
        self.mimics = []  # (follower, leader, multiplier)
        joints = self.physics["joints"]
        for joint in joints:
            for mimic in joint.get("mimics", []):
                leader = joints[mimic["leader"]] if isinstance(mimic["leader"], int) else None
                leader = leader["path"] if leader else mimic["leader"]
                self.mimics.append(((joint["path"], mimic["dof"]), (leader, mimic["leaderDof"]),
                                    mimic["multiplier"]))
        followers = {follower for follower, _, _ in self.mimics}
        pose = random_pose(before["coordinates"], followers, chance)
        options = ["--pose", pose] if pose else []
        code, self.tenon = tenon("inertia", asset, "--matrix", *options)
        if code != 0:
            raise LookupError(why(self.tenon))
        self.rows = self.tenon["coordinates"]

    def load(self):
        self.model = model_of(self.physics)
        self.data = mujoco.MjData(self.model)

    def compare(self):
        model, data = self.model, self.data
        places = self.place()
        mujoco.mj_forward(model, data)
        mass = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, mass)
        # Coordinates of tenon from those of MuJoCo: v_mujoco = change v_tenon.
        change = self.change(places)
        mass = change.T @ mass @ change
        gravity = change.T @ -data.qfrc_bias
        own = np.array(self.tenon["massMatrix"])
        size = np.sqrt(np.outer(np.diag(mass), np.diag(mass)))
        self.note("mass matrix", np.abs(own - mass) / size)
        self.note("gravity", np.abs(np.array([row["gravity"] for row in self.rows]) - gravity)
                  / max(1e-3, np.abs(gravity).max()))
        self.inertias(mass)

    def place(self):
        """Sets MuJoCo's coordinates; -> first degree of freedom of each row."""
        model, data = self.model, self.data
        places = []
        names = {model.joint(j).name: j for j in range(model.njnt)}
        for row in self.rows:
            if row["joint"] is None:
                free = [j for j in range(model.njnt) if model.jnt_type[j] == 0]
                if len(free) != 1:
                    raise LookupError("several bodies float")
                places.append(("free", free[0], row["dof"]))
                continue
            index = names[row["joint"]]
            data.qpos[model.jnt_qposadr[index]] = row["position"]
            places.append(("joint", index, row["dof"]))
        return places

    def change(self, places):
        model, data = self.model, self.data
        result = np.zeros((model.nv, len(places)))
        order = ["transX", "transY", "transZ", "rotX", "rotY", "rotZ"]
        for column, (kind, index, dof) in enumerate(places):
            first = model.jnt_dofadr[index]
            if kind == "free":
                inverse = np.linalg.inv(to_com(model, data, model.jnt_bodyid[index]))
                result[first:first + 6, column] = inverse[:, order.index(dof)]
            else:
                result[first, column] = 1
        if len(places) != model.nv:
            raise LookupError(f"{len(places)} coordinates here, {model.nv} in MuJoCo")
        return result

    def inertias(self, mass):
        count = len(self.rows)
        keys = {(row["joint"], row["dof"]): i for i, row in enumerate(self.rows)}
        ties = np.zeros((len(self.mimics), count))
        for r, (follower, leader, multiplier) in enumerate(self.mimics):
            ties[r, keys[follower]], ties[r, keys[leader]] = 1, -multiplier
        _, values, right = np.linalg.svd(ties) if len(ties) else (0, np.zeros(0), np.eye(count))
        ways = right[np.count_nonzero(values > 1e-12):].T
        response = ways @ np.linalg.solve(ways.T @ mass @ ways, ways.T)
        for i, row in enumerate(self.rows):
            self.note("free", [abs(row["free"] * response[i, i] - 1)])
            tied, grows = {i}, True
            while grows:
                size = len(tied)
                for follower, leader, _ in self.mimics:
                    if keys[follower] in tied or keys[leader] in tied:
                        tied |= {keys[follower], keys[leader]}
                grows = len(tied) > size
            moving = sorted(tied | {k for k, r in enumerate(self.rows) if r["joint"] is None})
            inner = ties[:, moving]
            _, values, right = (np.linalg.svd(inner) if len(inner)
                                else (0, np.zeros(0), np.eye(len(moving))))
            own = right[np.count_nonzero(values > 1e-12):].T
            part = mass[np.ix_(moving, moving)]
            speeds = own @ np.linalg.solve(own.T @ part @ own, own.T)
            place = moving.index(i)
            self.note("held", [abs(row["held"] * speeds[place, place] - 1)])

    def note(self, kind, errors):
        self.worst[kind] = max(self.worst.get(kind, 0.0), float(np.max(errors, initial=0)))


def convert(source, work):
    asset = work / "robot.usda"
    _, made = tenon("convert", source, asset)
    if not asset.exists():
        raise LookupError(why(made))
    return asset


def main():
    files = descriptions(ROBOTS, COUNT)
    if not files:
        print("skipped: there are no published robots in build/robots")
        return 77
    compared, wrong, passed_by = 0, 0, []
    worst = {}
    for number, source in enumerate(files):
        name = source.relative_to(ROBOTS)
        with tempfile.TemporaryDirectory() as folder:
            try:
                work = pathlib.Path(folder)
                beside = Beside(convert(source, work), work, random.Random(number))
                if not beside.rows:
                    raise LookupError("nothing moves")
                beside.load()
                beside.compare()
            except (LookupError, ValueError, np.linalg.LinAlgError) as error:
                passed_by.append(f"{name}: {error}")
                continue
        compared += 1
        for kind, value in beside.worst.items():
            worst[kind] = max(worst.get(kind, 0.0), value)
        if not max(beside.worst.values()) <= CLOSE:
            wrong += 1
            print(f"{name}: " + ", ".join(f"{k} {v:.1e}" for k, v in beside.worst.items()))
    for line in passed_by:
        print("not compared: " + " ".join(line.split()))
    print(f"{compared} robots, {wrong} wrong; worst: "
          + ", ".join(f"{k} {v:.1e}" for k, v in worst.items()))
    return 0 if not wrong and compared >= len(files) // 2 else 1


if __name__ == "__main__":
    sys.exit(main())
