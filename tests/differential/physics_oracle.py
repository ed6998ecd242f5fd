# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What OpenUSD's own physics parser says about a stage, as plain data: the descriptors of all
objects, the table of collision groups, the mass properties of every body. Volumes and moments of
inertia, which OpenUSD asks of its caller, are closed forms.

usage: physics_oracle.py FILE    prints it as JSON, in which numbers that are not finite are NaN and
                                 Infinity
"""

import json
import math
import os
import sys

os.environ.setdefault("PXR_WORK_THREAD_LIMIT", "1")
from pxr import Gf, Usd, UsdGeom, UsdPhysics  # pylint: disable=wrong-import-position


def plain(value):
    """Numbers, strings, lists and dictionaries of them."""
    if isinstance(value, (bool, str)) or value is None:
        return value
    if type(value) in (int, float):
        return value
    if isinstance(value, int):  # an enumerator
        return str(value)
    if hasattr(value, "displayName"):
        return value.displayName
    if isinstance(value, (Gf.Quatf, Gf.Quatd, Gf.Quath)):
        return [float(value.real), *(float(x) for x in value.imaginary)]
    if hasattr(value, "pathString"):
        return value.pathString
    if hasattr(value, "__len__") and hasattr(value, "__getitem__"):
        return [plain(x) for x in value]
    names = [name for name in dir(value) if not name.startswith("_")]
    return {name: plain(getattr(value, name)) for name in names
            if not callable(getattr(value, name))}


def about_axis(axis, along, across):
    diagonal = [across] * 3
    diagonal["XYZ".index(axis)] = along
    return diagonal


def integrals(kind, row):
    """(volume, diagonal moments at density 1, centre along the axis), or None."""
    if kind == "CubeShape":
        x, y, z = (2 * abs(h) for h in row["halfExtents"])
        volume = x * y * z
        return volume, [volume / 12 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y)], 0
    if kind not in ("SphereShape", "CylinderShape", "CapsuleShape", "ConeShape"):
        return None
    r = abs(row["radius"])
    ball = 4 / 3 * math.pi * r**3
    if kind == "SphereShape":
        return ball, [0.4 * ball * r * r] * 3, 0
    h = 2 * abs(row["halfHeight"])
    tube = math.pi * r * r * h
    if kind == "CylinderShape":
        return tube, about_axis(row["axis"], tube * r * r / 2, tube * (3 * r * r + h * h) / 12), 0
    if kind == "CapsuleShape":
        across = tube * (h * h / 12 + r * r / 4) + ball * (0.4 * r * r + h * h / 4 + 3 / 8 * h * r)
        along = tube * r * r / 2 + 0.4 * ball * r * r
        return tube + ball, about_axis(row["axis"], along, across), 0
    volume = tube / 3
    across = volume * (3 / 20 * r * r + 3 / 80 * h * h)
    return volume, about_axis(row["axis"], 0.3 * volume * r * r, across), -h / 4


def mass_information(shapes, prim):
    info = UsdPhysics.RigidBodyAPI.MassInformation()
    info.volume = -1.0
    info.inertia = Gf.Matrix3f(0)
    info.centerOfMass = Gf.Vec3f(0)
    info.localPos = Gf.Vec3f(0)
    info.localRot = Gf.Quatf(1)
    kind, row = shapes.get(str(prim.GetPath()), (None, None))
    if row is None:
        return info
    info.localPos = Gf.Vec3f(*row["localPos"])
    info.localRot = Gf.Quatf(*row["localRot"])
    known = integrals(kind, row)
    if known:
        volume, moments, center = known
        info.volume = volume
        info.inertia = Gf.Matrix3f(moments[0], 0, 0, 0, moments[1], 0, 0, 0, moments[2])
        if center:
            offset = [0.0] * 3
            offset["XYZ".index(row["axis"])] = center
            info.centerOfMass = Gf.Vec3f(*offset)
    return info


def read(stage):
    """Objects by kind, sorted by path; groups; masses; the units of the stage."""
    found = UsdPhysics.LoadUsdPhysicsFromRange(stage, ["/"])
    objects, shapes = {}, {}
    for kind, (paths, descriptors) in found.items():
        rows = sorted(zip(map(str, paths), descriptors), key=lambda pair: pair[0])
        objects[str(kind)] = [[path, plain(row)] for path, row in rows]
        if str(kind).endswith("Shape"):
            shapes.update({path: (str(kind), row) for path, row in objects[str(kind)]})
    result = {"metersPerUnit": UsdGeom.GetStageMetersPerUnit(stage),
              "kilogramsPerUnit": UsdPhysics.GetStageKilogramsPerUnit(stage),
              "objects": objects, "mass": {}}
    table = UsdPhysics.CollisionGroup.ComputeCollisionGroupTable(stage)
    groups = sorted(table.GetGroups(), key=str)
    if groups:
        result["collisionGroupTable"] = {
            "groups": [str(g) for g in groups],
            "enabled": [[bool(table.IsCollisionEnabled(a, b)) for b in groups] for a in groups]}
    for path, _ in objects.get("RigidBody", []):
        body = UsdPhysics.RigidBodyAPI(stage.GetPrimAtPath(path))
        mass, inertia, center, axes = body.ComputeMassProperties(
            lambda prim: mass_information(shapes, prim))
        result["mass"][path] = {"mass": float(mass), "inertia": plain(inertia),
                                "com": plain(center), "principalAxes": plain(axes)}
    return result


def read_file(path):
    return read(Usd.Stage.Open(path))


if __name__ == "__main__":
    json.dump(read_file(sys.argv[1]), sys.stdout)
