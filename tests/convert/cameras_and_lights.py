#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Cameras and lights of a model: what OpenUSD shows of them is what MuJoCo shows, and they come
back, edits with them.

    cameras_and_lights.py ROOT TENON

MuJoCo's reader is that of tests/robot_requirements.txt; without it the test skips.
"""

import json
import subprocess
import sys

import round_trip
from round_trip import ROOT, TENON, faults, mujoco, near, numpy, run, without_source

MODEL = ROOT / "tests/convert/mjcf/eyes.xml"
FLOAT = 1e-6  # relative rounding
CAMERA = ("mode", "targetbodyid", "pos", "quat", "projection", "fovy", "ipd", "resolution",
          "output", "sensorsize", "intrinsic")
OBJECTS = {"cam": "CAMERA", "light": "LIGHT"}
CAMERAS = ("front", "watch", "flat", "hand", "tracker")
LIGHTS = ("sun", "lamp", "bulb", "torch")
LIGHT = ("mode", "targetbodyid", "type", "castshadow", "bulbradius", "intensity", "range",
         "active", "pos", "dir", "attenuation", "cutoff", "softness", "exponent", "ambient",
         "diffuse", "specular")
# MuJoCo turns these itself; an asset has the turn.
TURNED = ("watch", "bulb")


def started(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return data


def expect(what, found, wanted):
    if found != wanted:
        faults.append(f"{what}: {found!r}, expected {wanted!r}")


def field_of(model, kind, name, field):
    number = mujoco.mj_name2id(model, getattr(mujoco.mjtObj, f"mjOBJ_{OBJECTS[kind]}"), name)
    return getattr(model, f"{kind}_{field}")[number] if number >= 0 else None


def compare(before, after, without=()):
    """All fields of all cameras and lights, by name; `without`: (name, field) of edits."""
    for kind, fields, names in (("cam", CAMERA, CAMERAS), ("light", LIGHT, LIGHTS)):
        for name in names:
            for field in fields:
                found = field_of(after, kind, name, field)
                if found is None:
                    faults.append(f"{name} is lost")
                    break
                # Without a lens the intrinsics are those of the nearest that any camera sees.
                other = (name in TURNED and field in ("quat", "dir")
                         or field == "intrinsic" and name != "hand")
                if (name, field) not in without and not other:
                    near(f"{name}: {field}", found, field_of(before, kind, name, field), FLOAT)


def beside_openusd(asset):
    """Poses, angles, films and brightness as OpenUSD reads them, beside MuJoCo."""
    try:
        from pxr import Gf, Usd, UsdGeom, UsdLux
    except ImportError:
        print("without usd-core")
        return
    stage, cache = Usd.Stage.Open(str(asset)), UsdGeom.XformCache()
    prims = {prim.GetName(): prim for prim in stage.Traverse()}
    model = mujoco.MjModel.from_xml_path(str(MODEL))
    data = started(model)
    for i in range(model.ncam):
        name = model.camera(i).name
        matrix = numpy.array(cache.GetLocalToWorldTransform(prims[name]))
        near(f"{name}: turn in OpenUSD", matrix[:3, :3].T, data.cam_xmat[i].reshape(3, 3), 1e-12)
        near(f"{name}: place in OpenUSD", matrix[3, :3], data.cam_xpos[i], 1e-12)
        camera = UsdGeom.Camera(prims[name]).GetCamera()
        scene, view = mujoco.MjvScene(model, 10), mujoco.MjvCamera()
        view.type, view.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, i
        mujoco.mjv_updateScene(model, data, mujoco.MjvOption(), None, view,
                               mujoco.mjtCatBit.mjCAT_ALL, scene)
        shown, window = scene.camera[0], camera.frustum.window
        scale = 1 if camera.projection == Gf.Camera.Orthographic else shown.frustum_near
        near(f"{name}: edges in OpenUSD", [window.GetMin()[1], window.GetMax()[1]],
             numpy.array([shown.frustum_bottom, shown.frustum_top]) / scale, 1e-6)
        near(f"{name}: nearest and farthest", [camera.clippingRange.min, camera.clippingRange.max],
             [shown.frustum_near, shown.frustum_far], 1e-6)
        if name == "hand":
            middle, half = shown.frustum_center / scale, shown.frustum_width / scale
            near(f"{name}: sides in OpenUSD", [window.GetMin()[0], window.GetMax()[0]],
                 [middle - half, middle + half], 1e-6)
    for i in range(model.nlight):
        light = model.light(i)
        prim = prims[light.name]
        matrix = numpy.array(cache.GetLocalToWorldTransform(prim))
        near(f"{light.name}: shines", -matrix[2, :3], data.light_xdir[i], 1e-12)
        api = UsdLux.LightAPI(prim)
        expect(f"{light.name}: is a light", bool(api), True)
        intensity = api.GetIntensityAttr().Get() * 2 ** api.GetExposureAttr().Get()
        if prim.IsA(UsdLux.DistantLight):  # normalized: the illuminance
            shown = intensity / numpy.pi
        else:  # a quarter of it by the square of the distance
            distance = numpy.linalg.norm(data.light_xpos[i] - model.stat.center)
            shown = intensity / 4 / distance ** 2 / numpy.pi
        near(f"{light.name}: white", shown, 1, 1e-6)
        near(f"{light.name}: colour", api.GetColorAttr().Get(), light.diffuse, FLOAT)
    expect("visible", UsdGeom.Imageable(prims["bulb"]).GetVisibilityAttr().Get(), "invisible")


def check_conversion(work):
    asset = work / "eyes.usda"
    answer = run("convert", MODEL, asset)
    said = [finding["message"] for finding in answer["diagnostics"]]
    expect("findings", [line for line in said if "camera" in line or "light" in line], [])
    beside_openusd(asset)


def check_way_back(work):
    """Of the model that the asset keeps, and of one that is made anew."""
    before = mujoco.MjModel.from_xml_path(str(MODEL))
    asset, package = work / "eyes.usda", work / "eyes"
    run("convert", MODEL, asset)
    run("structure", asset, "-o", package)
    for source in (asset, package / "eyes.usda"):
        back = work / "kept.xml"
        run("convert", source, back, "--force",
            *(("--physics", "mujoco") if source != asset else ()))
        compare(before, mujoco.MjModel.from_xml_path(str(back)))
    without_source(asset)
    run("convert", asset, work / "anew.xml")
    compare(before, mujoco.MjModel.from_xml_path(str(work / "anew.xml")))


# An edit of the asset; the field of the model that follows.
EDITS = (
    ("front.focalLength=7.6454", ("front", "fovy"), 90),  # half of the film's height
    ("front.xformOp:translate=(0,-3,1)", ("front", "pos"), (0, -3, 1)),
    ("hand.focalLength=0.08", ("hand", "intrinsic"), (0.0084, 0.008, 0.0001, 0.0002)),
    ("flat.verticalAperture=30", ("flat", "fovy"), 3),
    ("sun.inputs:color=(0.5,0.25,1)", ("sun", "diffuse"), (0.5, 0.25, 1)),
    ("sun.inputs:exposure=-1", ("sun", "diffuse"), (0.4, 0.35, 0.3)),
    ("lamp.inputs:shaping:cone:angle=20", ("lamp", "cutoff"), 20),
    ("lamp.inputs:radius=0.1", ("lamp", "bulbradius"), 0.1),
    ("bulb.visibility=inherited", ("bulb", "active"), 1),
    ("lamp.tenon:mujoco:ambient=[0.2,0.2,0.2]", ("lamp", "ambient"), (0.2, 0.2, 0.2)),
)


def path_of(asset, name):
    process = subprocess.run([TENON, "tree", asset, "--json"], capture_output=True, text=True,
                             check=False)
    pending = [json.loads(process.stdout)]
    while pending:
        item = pending.pop()
        if isinstance(item, dict):
            if str(item.get("path", "")).endswith("/" + name):
                return item["path"]
            pending += list(item.values())
        elif isinstance(item, list):
            pending += item
    return "/" + name


def check_edits(work):
    """Each edit goes into the model that is kept, and nothing else changes."""
    before = mujoco.MjModel.from_xml_path(str(MODEL))
    for number, (edit, changed, wanted) in enumerate(EDITS):
        asset, back = work / f"edit{number}.usda", work / f"edit{number}.xml"
        run("convert", MODEL, asset)
        name, value = edit.split(".", 1)
        run("set", asset, f"{path_of(asset, name)}.{value}")
        rules = {finding["rule"] for finding in run("convert", asset, back)["diagnostics"]}
        expect(f"{edit}: patched", "mjcf.patched" in rules, True)
        after = mujoco.MjModel.from_xml_path(str(back))
        compare(before, after, [changed, ("hand", "fovy")])
        kind = "light" if name in LIGHTS else "cam"
        near(edit, field_of(after, kind, *changed), wanted, 1e-6)


def check_written_anew(work):
    """Where another edit forbids the model that is kept, cameras and lights are still there."""
    before = mujoco.MjModel.from_xml_path(str(MODEL))
    asset, back = work / "other.usda", work / "other.xml"
    run("convert", MODEL, asset)
    run("set", asset, f"{path_of(asset, 'g')}.radius=0.06")
    run("set", asset, f"{path_of(asset, 'front')}.focalLength=7.6454")
    rules = {finding["rule"] for finding in run("convert", asset, back)["diagnostics"]}
    expect("anew", "mjcf.written-anew" in rules, True)
    after = mujoco.MjModel.from_xml_path(str(back))
    compare(before, after, [("front", "fovy")])
    near("front: fovy", field_of(after, "cam", "front", "fovy"), 90, 1e-6)


if __name__ == "__main__":
    sys.exit(round_trip.main(check_conversion, check_way_back, check_edits, check_written_anew))
