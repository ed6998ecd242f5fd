#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Checks examples/inspire_hand with OpenUSD, independently of tenon's own code.

    test_inspire_hand.py ROOT

ROOT is the checkout. Exit 0: all hold; 1: each fault on a line; 77: OpenUSD is missing. What is
held: every layer opens without a complaint; what each Physics variant contains; masses; joint
frames that meet; surfaces that are closed and face outward; the mimic law being one law in three
dialects; actuators being the drives in radians; the files being what generate.py writes.
"""

import math
import pathlib
import subprocess
import sys
import tempfile

SKIPPED = 77
try:
    from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdUtils, UsdValidation
except ImportError:
    print("skipped: no usd-core here; tools/make_oracle.sh makes a Python that has it")
    sys.exit(SKIPPED)

ROBOT = "/inspire_hand"
VARIANTS = ("none", "physics", "physx", "mujoco")
FINGERS = ("index", "middle", "ring", "little")
ACTUATED = ["right_thumb_1", "right_thumb_2"] + [f"right_{name}_1" for name in FINGERS]
# Follower -> leader, factor, offset in degrees: q = offset + factor * q(leader).
LAWS = {
    "right_thumb_3": ("right_thumb_2", 1.6, 0.0),
    "right_thumb_4": ("right_thumb_3", 0.7508, -0.1),
    **{f"right_{name}_2": (f"right_{name}_1", 1.0, 0.0) for name in FINGERS},
}

faults = []


def expect(condition, words):
    if not condition:
        faults.append(words)


def expect_near(value, wanted, tolerance, words):
    near = value is not None and abs(value - wanted) <= tolerance
    expect(near, f"{words}: {value}, want {wanted}")


def open_stage(path, variant=None):
    """Opens a stage, with the variant selected in the session layer; any complaint is a fault."""
    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    session = Sdf.Layer.CreateAnonymous()
    if variant:
        over = Sdf.CreatePrimInLayer(session, ROBOT)
        over.variantSelections["Physics"] = variant
    stage = Usd.Stage.Open(Sdf.Layer.FindOrOpen(str(path)), session)
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        for relationship in prim.GetRelationships():
            for target in relationship.GetTargets():
                known = stage.GetObjectAtPath(target)
                expect(known, f"{path.name}[{variant}]: {relationship.GetPath()} dangles: {target}")
    for error in stage.GetCompositionErrors():
        faults.append(f"{path.name}[{variant}]: {error}")
    for complaint in delegate.TakeUncoalescedDiagnostics():
        faults.append(f"{path.name}[{variant}]: {complaint.commentary}")
    return stage


def count(stage):
    """Number of active prims with a schema of interest, instance contents included."""
    found = dict.fromkeys(
        ("bodies", "colliders", "revolute", "fixed", "drives", "mimics", "roots", "physics"), 0)
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        applied = prim.GetPrimTypeInfo().GetAppliedAPISchemas()
        found["bodies"] += prim.HasAPI(UsdPhysics.RigidBodyAPI)
        found["colliders"] += prim.HasAPI(UsdPhysics.CollisionAPI)
        found["revolute"] += prim.IsA(UsdPhysics.RevoluteJoint)
        found["fixed"] += prim.IsA(UsdPhysics.FixedJoint)
        found["drives"] += prim.HasAPI(UsdPhysics.DriveAPI, "angular")
        found["mimics"] += "NewtonMimicAPI" in applied
        found["roots"] += prim.HasAPI(UsdPhysics.ArticulationRootAPI)
        found["physics"] += any(name.startswith("Physics") for name in applied)
    return found


def check_counts(path):
    for variant in VARIANTS:
        found = count(open_stage(path, variant))
        if variant == "none":
            expect(not any(found.values()), f"none: is not free of physics: {found}")
            continue
        wanted = {"bodies": 13, "colliders": 13, "revolute": 12, "fixed": 1, "drives": 6,
                  "mimics": 6, "roots": 1}
        for what, number in wanted.items():
            expect(found[what] == number, f"{variant}: {found[what]} {what}, want {number}")


def check_validators(path):
    """OpenUSD's own validators find nothing, under any variant."""
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    expect(len(validators) > 10, "OpenUSD has no validators; nothing was checked")
    for variant in VARIANTS:
        stage = open_stage(path, variant)
        for error in UsdValidation.ValidationContext(validators).Validate(stage):
            faults.append(f"{path.name}[{variant}]: {error.GetName()}: {error.GetMessage()}")


def check_default_selection(path):
    stage = open_stage(path)
    variants = stage.GetDefaultPrim().GetVariantSet("Physics")
    expect(sorted(variants.GetVariantNames()) == sorted(VARIANTS), "variants are not the four")
    expect(variants.GetVariantSelection() == "physics", "the selection is not `physics`")


def check_masses(stage):
    total = 0.0
    for prim in stage.Traverse():
        if not prim.HasAPI(UsdPhysics.RigidBodyAPI):
            continue
        mass = UsdPhysics.MassAPI(prim)
        total += mass.GetMassAttr().Get()
        a, b, c = sorted(mass.GetDiagonalInertiaAttr().Get())
        expect(a > 0 and a + b >= c, f"{prim.GetPath()}: no body has the inertia {a}, {b}, {c}")
        axes = mass.GetPrincipalAxesAttr().Get()
        expect_near(axes.GetLength(), 1, 1e-5, f"{prim.GetPath()}: length of principalAxes")
    expect_near(total, 0.540, 1e-6, "total mass")


def check_frames(stage):
    """Both frames of a joint are one frame in the world, in the pose that base.usda shows."""
    cache = UsdGeom.XformCache()
    for prim in stage.Traverse():
        if not prim.IsA(UsdPhysics.Joint):
            continue
        joint, frames = UsdPhysics.Joint(prim), []
        for body, place, turn in (
                (joint.GetBody0Rel(), joint.GetLocalPos0Attr(), joint.GetLocalRot0Attr()),
                (joint.GetBody1Rel(), joint.GetLocalPos1Attr(), joint.GetLocalRot1Attr())):
            local = Gf.Matrix4d().SetRotate(Gf.Quatd(turn.Get()).GetNormalized())
            local.SetTranslateOnly(Gf.Vec3d(place.Get()))
            world = cache.GetLocalToWorldTransform(stage.GetPrimAtPath(body.GetTargets()[0]))
            frames.append(local * world)
        gap = max(abs(x - y) for r, s in zip(*frames) for x, y in zip(r, s))
        # OpenUSD takes xformOp:orient through its angle, which costs 2e-6 near the identity.
        expect(gap < 4e-6, f"{prim.GetPath()}: the frames differ by {gap}")


def check_surface(mesh):
    """Every edge is used once in each direction (closed, one winding); the volume is positive."""
    points = mesh.GetPointsAttr().Get()
    indices, edges, volume, start = list(mesh.GetFaceVertexIndicesAttr().Get()), set(), 0.0, 0
    where = mesh.GetPath()
    for size in mesh.GetFaceVertexCountsAttr().Get():
        face = indices[start:start + size]
        start += size
        for edge in zip(face, face[1:] + face[:1]):
            expect(edge not in edges, f"{where}: edge {edge} is used twice one way")
            edges.add(edge)
        for i, j in zip(face[1:], face[2:]):
            volume += Gf.Dot(points[face[0]], Gf.Cross(points[i], points[j])) / 6
    expect(start == len(indices), f"{where}: faceVertexCounts do not add up")
    expect(all((b, a) in edges for a, b in edges), f"{where}: is not closed")
    expect(volume > 1e-6, f"{where}: volume {volume}: faces look inward")
    expect(mesh.GetSubdivisionSchemeAttr().Get() == "none", f"{where}: is subdivided")
    expect(len(mesh.GetNormalsAttr().Get()) == len(points), f"{where}: normals per point")
    expect(UsdGeom.PointBased.ComputeExtent(points) == mesh.GetExtentAttr().Get(),
           f"{where}: extent is not that of the points")


def check_geometry(path):
    stage = open_stage(path)
    meshes = [UsdGeom.Mesh(prim) for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)]
    expect(len(meshes) == 13, f"geometry: {len(meshes)} meshes, want 13")
    for mesh in meshes:
        check_surface(mesh)


def check_colliders(stage):
    """A collider is a guide, takes its hull, and is bound to a material that has friction."""
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        if not prim.HasAPI(UsdPhysics.CollisionAPI):
            continue
        mesh = UsdPhysics.MeshCollisionAPI(prim)
        expect(mesh.GetApproximationAttr().Get() == "convexHull", f"{prim.GetPath()}: no hull")
        expect(UsdGeom.Imageable(prim).ComputePurpose() == "guide", f"{prim.GetPath()}: is drawn")
        material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")
        friction = UsdPhysics.MaterialAPI(material).GetDynamicFrictionAttr().Get()
        expect(friction and friction >= 0.3, f"{prim.GetPath()}: friction {friction}")


def joint_prim(stage, link):
    return stage.GetPrimAtPath(f"{ROBOT}/Physics/{link}_joint")


def value(prim, name):
    return prim.GetAttribute(name).Get()


def leader_of(prim, name):
    targets = prim.GetRelationship(name).GetTargets()
    return str(targets[0]) if len(targets) == 1 else None


def check_laws(path):
    """Newton's, PhysX's and MuJoCo's form of every mimic law say the same; limits leave it room."""
    stages = {variant: open_stage(path, variant) for variant in ("physics", "physx", "mujoco")}
    for follower, (leader, factor, offset) in LAWS.items():
        leader_path = f"{ROBOT}/Physics/{leader}_joint"
        for variant, stage in stages.items():
            prim = joint_prim(stage, follower)
            where = f"{follower}_joint[{variant}]"
            expect(leader_of(prim, "newton:mimicJoint") == leader_path, f"{where}: leader")
            expect_near(value(prim, "newton:mimicCoef0"), offset, 1e-6, f"{where}: coef0")
            expect_near(value(prim, "newton:mimicCoef1"), factor, 1e-6, f"{where}: coef1")
            expect(not prim.HasAPI(UsdPhysics.DriveAPI, "angular"), f"{where}: is driven as well")
        prim, mimic = joint_prim(stages["physx"], follower), "physxMimicJoint:rotX:"
        where = f"{follower}_joint[physx]"
        expect(leader_of(prim, mimic + "referenceJoint") == leader_path, f"{where}: leader")
        # q + gearing * q(leader) + offset = 0.
        expect_near(value(prim, mimic + "gearing"), -factor, 1e-6, f"{where}: gearing")
        expect_near(value(prim, mimic + "offset"), -offset, 1e-6, f"{where}: offset")
        check_stiffness(prim, joint_prim(stages["mujoco"], follower), follower)
        check_room(stages["physics"], follower, leader, factor, offset)


def check_stiffness(physx, mujoco, follower):
    """solref = (1 / (frequency * ratio), ratio) of PhysX's compliance."""
    frequency = value(physx, "physxMimicJoint:rotX:naturalFrequency")
    ratio = value(physx, "physxMimicJoint:rotX:dampingRatio")
    time_constant, damping_ratio = value(mujoco, "mjc:solref")
    expect_near(time_constant, 1 / (frequency * ratio), 1e-6, f"{follower}: solref")
    expect_near(damping_ratio, ratio, 1e-6, f"{follower}: solref's damping ratio")
    expect("MjcEqualityJointAPI" in mujoco.GetPrimTypeInfo().GetAppliedAPISchemas(),
           f"{follower}: no MjcEqualityJointAPI")


def check_room(stage, follower, leader, factor, offset):
    own, other = joint_prim(stage, follower), joint_prim(stage, leader)
    for limit in ("physics:lowerLimit", "physics:upperLimit"):
        asked = offset + factor * value(other, limit)
        low, high = value(own, "physics:lowerLimit"), value(own, "physics:upperLimit")
        expect(low <= asked <= high, f"{follower}: is asked for {asked} of [{low}, {high}]")


def check_actuators(path):
    stage = open_stage(path, "mujoco")
    actuators = [prim for prim in stage.Traverse() if prim.GetTypeName() == "MjcActuator"]
    expect(len(actuators) == 6, f"{len(actuators)} actuators, want 6")
    for actuator in actuators:
        joint = stage.GetPrimAtPath(leader_of(actuator, "mjc:target"))
        where = actuator.GetName()
        drive = UsdPhysics.DriveAPI(joint, "angular")
        stiffness = math.degrees(drive.GetStiffnessAttr().Get())
        damping = math.degrees(drive.GetDampingAttr().Get())
        gain, bias = value(actuator, "mjc:gainPrm"), value(actuator, "mjc:biasPrm")
        expect_near(gain[0], stiffness, 1e-5, f"{where}: gain in N m/rad")
        expect_near(bias[1], -stiffness, 1e-5, f"{where}: bias on the angle")
        expect_near(bias[2], -damping, 1e-5, f"{where}: bias on the speed")
        expect_near(value(actuator, "mjc:forceRange:max"), drive.GetMaxForceAttr().Get(), 1e-6,
                    f"{where}: force range")
        expect_near(value(actuator, "mjc:ctrlRange:max"),
                    math.radians(value(joint, "physics:upperLimit")), 1e-5, f"{where}: ctrl range")


def check_thumb(stage):
    """The thumb's swing stands where the published hand has it and ends at 75 degrees."""
    link = UsdGeom.Xformable(stage.GetPrimAtPath(f"{ROBOT}/right_thumb_1"))
    place = link.GetLocalTransformation().ExtractTranslation()
    expect(Gf.IsClose(place, Gf.Vec3d(0.01696, 0.02045, 0.0667), 1e-9), f"right_thumb_1 at {place}")
    prim = joint_prim(stage, "right_thumb_1")
    expect(value(prim, "physics:lowerLimit") == 0, "right_thumb_1_joint: lower limit")
    expect_near(value(prim, "physics:upperLimit"), 75, 1e-3, "right_thumb_1_joint: upper limit")
    for link in ACTUATED:
        expect(joint_prim(stage, link).HasAPI(UsdPhysics.DriveAPI, "angular"), f"{link}: no drive")


def check_grasp(path):
    stage = open_stage(path)
    expect(stage.GetTimeCodesPerSecond() == 60 and stage.GetEndTimeCode() == 240, "grasp: not 4 s")
    for link in ACTUATED:
        target = stage.GetAttributeAtPath(
            f"/World{ROBOT}/Physics/{link}_joint.drive:angular:physics:targetPosition")
        expect(target.GetNumTimeSamples() >= 2, f"grasp: {link}_joint's target does not move")
        limit = target.GetPrim().GetAttribute("physics:upperLimit").Get()
        last = target.Get(stage.GetEndTimeCode())
        expect(0 < last <= limit, f"grasp: {link}_joint's target {last} is not within its limits")
    can = UsdGeom.Cylinder(stage.GetPrimAtPath("/World/can"))
    table = stage.GetPrimAtPath("/World/table")
    expect(UsdPhysics.RigidBodyAPI(table).GetKinematicEnabledAttr().Get(), "grasp: table is loose")
    box = [UsdGeom.BBoxCache(time, ["default"]).ComputeWorldBound(table).ComputeAlignedRange()
           for time in (0, 240)]
    centre = can.ComputeLocalToWorldTransform(0).ExtractTranslation()
    bottom = centre[2] - can.GetHeightAttr().Get() / 2
    expect_near(box[0].GetMax()[2], bottom, 1e-6, "grasp: table top under the can")
    expect(box[1].GetMax()[2] < bottom - 0.1, "grasp: the table stays under the can")


def check_generated(folder):
    """generate.py would write what is there; the geometry is compared here, without tenon."""
    script = str(folder / "generate.py")
    command = [sys.executable, script, "--check", "--tenon", "none"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    expect(run.returncode == 0, f"generate.py --check: {run.stdout.strip()} {run.stderr.strip()}")
    with tempfile.TemporaryDirectory() as scratch:
        fresh = pathlib.Path(scratch) / "geometry.usda"
        subprocess.run([sys.executable, script, "--geometry", str(fresh)], check=True)
        wanted = Sdf.Layer.FindOrOpen(str(fresh)).ExportToString()
    kept = folder / "payloads/geometry.usdc"
    expect(kept.read_bytes()[:8] == b"PXR-USDC", "geometry.usdc: is not binary")
    expect(Sdf.Layer.FindOrOpen(str(kept)).ExportToString() == wanted,
           "geometry.usdc: is not what generate.py --geometry writes")


def main():
    folder = pathlib.Path(sys.argv[1]).resolve() / "examples/inspire_hand"
    hand = folder / "inspire_hand.usda"
    check_counts(hand)
    check_validators(hand)
    check_default_selection(hand)
    check_masses(open_stage(hand, "physics"))
    check_frames(open_stage(hand, "physics"))
    check_geometry(folder / "payloads/geometry.usdc")
    check_colliders(open_stage(hand, "physics"))
    check_laws(hand)
    check_actuators(hand)
    check_thumb(open_stage(hand, "physics"))
    check_grasp(folder / "grasp.usda")
    check_generated(folder)
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults in {folder.name}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
