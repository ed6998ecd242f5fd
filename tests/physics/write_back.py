# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Bakes scenes/write_back.usda and reads the layer with OpenUSD: every body stands, at every frame,
where the log of the same run says, its scale and shear as at the start, its scale op untouched.

usage: write_back.py --tenon PROGRAM
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

try:
    import numpy as np
    from pxr import Usd, UsdGeom
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scenes", "write_back.usda")
INSTANCES = ("/World/Many/instance_0/Drop", "/World/Many/instance_1/Drop")
BODIES = (*INSTANCES, "/World/Outer", "/World/Outer/Free", "/World/Outer/Held",
          "/World/Part/Box", "/World/Tumbling", "/World/Turned/Slab")
RUN = ("--duration", "0.5", "--fps", "24")
TOLERANCE = 1e-4  # stage units; positions are written as doubles, rotations as doubles


def pose_matrix(position, w, x, y, z):
    """Row-vector 4x4 matrix of a pose."""
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
                     [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
                     [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]])
    result = np.eye(4)
    result[:3, :3] = turn
    result[3, :3] = position
    return result


def worlds(stage, code):
    """World matrices of BODIES; those of instances by the point instancer, without its velocities,
    which tell of the time between samples."""
    cache = UsdGeom.XformCache(code)
    many = UsdGeom.PointInstancer(stage.GetPrimAtPath("/World/Many"))
    placed = many.ComputeInstanceTransformsAtTime(code, code)
    above = cache.GetLocalToWorldTransform(many.GetPrim())
    return [np.array(matrix * above) for matrix in placed] + \
        [np.array(cache.GetLocalToWorldTransform(stage.GetPrimAtPath(path)))
         for path in BODIES[len(INSTANCES):]]


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        sys.exit(f"{arguments}: exit {done.returncode}\n{done.stdout}{done.stderr}")


def instanced_faults(program, layer):
    """A body inside an instance stays unless the instance may be taken apart (S-123)."""
    done = subprocess.run([program, "--json", "bake", SCENE, "-o", layer, *RUN],
                          capture_output=True, text=True, check=False)
    found = [d for d in json.loads(done.stdout)["diagnostics"]
             if d["rule"] == "bake.instanced-body"]
    if [(d["severity"], d["prim"]) for d in found] != [("error", "/World/Part/Box")]:
        yield f"bodies inside instances: {found}"
    stage = Usd.Stage.Open(layer)
    if not stage.GetPrimAtPath("/World/Part").IsInstance():
        yield "/World/Part was taken apart unasked"


def faults(baked, log):
    asset = Usd.Stage.Open(SCENE)
    start = worlds(asset, Usd.TimeCode.Default())
    poses = [[pose_matrix(p, *q) for p, q in zip(log["position"][frame], log["orientation"][frame])]
             for frame in range(len(log["position"]))]
    stretch = [world @ np.linalg.inv(pose) for world, pose in zip(start, poses[0])]
    for frame, placed in enumerate(poses):
        code = frame * baked.GetTimeCodesPerSecond() / 24
        for path, actual, pose, shape in zip(BODIES, worlds(baked, code), placed, stretch):
            error = np.abs(actual - shape @ pose).max()
            if not error < TOLERANCE:
                yield f"{path} at frame {frame}: off by {error}\n{actual}\n{shape @ pose}"
    for path in BODIES[len(INSTANCES):]:
        scale = baked.GetPrimAtPath(path).GetAttribute("xformOp:scale")
        before = asset.GetPrimAtPath(path).GetAttribute("xformOp:scale")
        if before and (scale.GetNumTimeSamples() or scale.Get() != before.Get()):
            yield f"{path}: the scale op is not as it was"
    turned = baked.GetPrimAtPath("/World/Tumbling").GetAttribute("xformOp:rotateZYX")
    if turned.GetNumTimeSamples() < 2:
        yield "/World/Tumbling: the rotate op is not animated"
    moved = [np.abs(poses[-1][i] - poses[0][i]).max() for i in range(len(BODIES))]
    for path, distance in zip(BODIES, moved):
        if (distance < 1) != (path == "/World/Outer/Held"):
            yield f"{path}: moved by {distance}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--tenon", required=True)
    program = parser.parse_args().tenon
    with tempfile.TemporaryDirectory() as folder:
        layer, table = os.path.join(folder, "baked.usda"), os.path.join(folder, "run.npz")
        found = list(instanced_faults(program, layer))
        run(program, "bake", SCENE, "-o", layer, "--uninstance", *RUN)
        run(program, "sim", SCENE, "-o", table, *RUN)
        with np.load(table) as log:
            found += faults(Usd.Stage.Open(layer), log)
    for fault in found:
        print(fault)
    print(f"{len(BODIES)} bodies, {len(found)} faults")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
