#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A model's world and tendons through USD and back: the same for MuJoCo.

    mjcf_round_trip.py ROOT TENON

MuJoCo's reader is that of tests/robot_requirements.txt; without it the test skips.
"""

import functools
import re
import shutil
import subprocess
import sys

import picture
import round_trip
from round_trip import ROOT, TENON, faults, mujoco, numpy, run

ROUNDING = 1e-7  # relative, of the floats that USD has

OPTIONS = ("timestep", "impratio", "tolerance", "ls_tolerance", "noslip_tolerance", "gravity",
           "wind", "magnetic", "density", "viscosity", "o_margin", "o_solref", "o_solimp",
           "o_friction", "integrator", "cone", "jacobian", "solver", "iterations",
           "ls_iterations", "noslip_iterations", "ccd_iterations", "disableflags",
           "enableflags", "disableactuator")
TENDON = ("stiffness", "damping", "frictionloss", "armature", "margin", "width", "limited",
          "lengthspring", "solref_lim", "solimp_lim", "solref_fri", "solimp_fri")
near = functools.partial(round_trip.near, rounding=ROUNDING)


def tendon_name(model, number):
    return mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_TENDON, number)


def lengths(model, shoulder, elbow, names):
    """Of the tendons, with the hinges turned by these angles from where the model stands."""
    data = mujoco.MjData(model)
    for name, angle in zip(names, (shoulder, elbow)):
        data.qpos[model.joint(name).qposadr[0]] += angle
    mujoco.mj_fwdPosition(model, data)
    return data.ten_length.copy()


def compare(before, after):
    for field in OPTIONS:
        near(field, getattr(after.opt, field), getattr(before.opt, field))
    order = [mujoco.mj_name2id(after, mujoco.mjtObj.mjOBJ_TENDON, tendon_name(before, i))
             for i in range(before.ntendon)]
    if sorted(order) != list(range(before.ntendon)) or after.ntendon != before.ntendon:
        faults.append(f"tendons: {after.ntendon} of {before.ntendon}: {order}")
        return
    hinges = ("shoulder", "elbow")
    # A sum of coordinates counts from where the model stands.
    start = lengths(before, 0, 0, ("shoulder", "elbow")) - lengths(
        after, 0, 0, hinges)[order]
    near("length of the path", start[0], 0)
    for field in TENDON:
        wanted = getattr(before, f"tendon_{field}")
        wanted = wanted - start[:, None] if field == "lengthspring" else wanted
        found = getattr(after, f"tendon_{field}")[order]
        if field == "lengthspring":  # without a spring it does not matter
            found, wanted = found[:1], wanted[:1]
        near(field, found, wanted)
    near("range", after.tendon_range[order], before.tendon_range - start[:, None])
    for angles in ((0.4, -0.3), (-0.9, 1.1), (1.4, 0.2)):
        near(f"lengths at {angles}",
             lengths(after, *angles, hinges)[order] + start,
             lengths(before, *angles, ("shoulder", "elbow")))


def check_world(work):
    source = ROOT / "tests/convert/mjcf/world.xml"
    package, back = work / "package", work / "back.xml"
    answer = run("convert", source, f"{package}/", "--scene")
    rules = sorted(finding["rule"] for finding in answer["diagnostics"])
    if rules != ["convert.floating", "mjcf.reference"]:
        faults.append(f"findings {rules}: {answer['diagnostics']}")
    round_trip.without_source(package / "payloads/base.usda")
    run("convert", package / "world.usda", back, "--physics", "mujoco")
    before = mujoco.MjModel.from_xml_path(str(source))
    compare(before, mujoco.MjModel.from_xml_path(str(back)))
    return before


def check_images(work):
    """Images of materials come back as files, laid out and repeated as before."""
    source, first, back = work / "images", work / "images.usda", work / "back" / "images.xml"
    (source / "pictures").mkdir(parents=True)
    back.parent.mkdir()
    shutil.copy(ROOT / "tests/convert/mjcf/textured.xml", source)
    for name in ("paint", "rough", "wrapped"):
        picture.png(source / "pictures" / f"{name}.png", 4)
    run("convert", source / "textured.xml", first)
    round_trip.without_source(first)
    run("convert", first, back)
    after = mujoco.MjModel.from_xml_path(str(back))
    before = mujoco.MjModel.from_xml_path(str(source / "textured.xml"))
    named = {after.material(i).name: after.material(i) for i in range(after.nmat)}
    roles = {mujoco.mjtTextureRole.mjTEXROLE_RGB: "paint",
             mujoco.mjtTextureRole.mjTEXROLE_ROUGHNESS: "rough"}
    for material, wanted in (("sheet", [0]), ("painted", [0, 1])):
        found = named[material].texid.ravel()
        for number, (role, name) in enumerate(roles.items()):
            texture = int(found[int(role)])
            has = texture >= 0 and name in after.texture(texture).name
            if has != (number in wanted):
                faults.append(f"images: {material} {name}: {texture}")
    near("texrepeat", named["sheet"].texrepeat, [2, 3])
    near("metallic", after.mat_metallic[named["painted"].id], [0.25])
    near("wood", named["wood"].rgba, before.material("wood").rgba * [0.5, 0, 0.5, 1])
    seen = sum(int(group) in (0, 2) for group in after.geom_group)
    if seen != 5 or sorted(path.name for path in (
            back.parent / "images_images").iterdir()) != ["paint.png", "rough.png"]:
        faults.append(f"images: {seen} visuals, {list(back.parent.rglob('*'))}")
    # The same corners have the same places in the image.
    near("places", corners(after, named["sheet"]), corners(before, before.material("sheet")))
    near("mass", sum(after.body_mass), sum(before.body_mass))


def corners(model, material):
    """Sorted rows of a point and its place in the image, of the mesh that has the material."""
    geom = next(i for i in range(model.ngeom) if model.geom_matid[i] == material.id and
                model.geom_type[i] == mujoco.mjtGeom.mjGEOM_MESH)
    mesh = model.geom_dataid[geom]
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    faces = slice(model.mesh_faceadr[mesh], model.mesh_faceadr[mesh] + model.mesh_facenum[mesh])
    points = model.mesh_vert[model.mesh_vertadr[mesh]:][model.mesh_face[faces].ravel()]
    places = model.mesh_texcoord[model.mesh_texcoordadr[mesh]:][
        model.mesh_facetexcoord[faces].ravel()]
    world = points @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom]
    rows = numpy.round(numpy.hstack([world, places]), 5) + 0.0
    return rows[numpy.lexsort(rows.T)]


def sensordata(path):
    """What each kind of sensor reads at the start, with the joint "turn" moving."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    turn = next(i for i in range(model.njnt) if "turn" in model.joint(i).name)
    data.qvel[model.jnt_dofadr[turn]] = 1.5
    mujoco.mj_forward(model, data)
    found = {}
    for i in range(model.nsensor):
        first = model.sensor_adr[i]
        of_turn = "turn" in model.joint(model.sensor_objid[i]).name \
            if model.sensor_objtype[i] == mujoco.mjtObj.mjOBJ_JOINT else False
        key = (int(model.sensor_type[i]), of_turn)
        found.setdefault(key, []).append(data.sensordata[first:first + model.sensor_dim[i]].copy())
    return found


def check_sensors(work):
    """Sensors of sites and joints come back and read the same. A joint is measured as a whole."""
    source, first, back = ROOT / "tests/convert/mjcf/sensors.xml", work / "s.usda", work / "s.xml"
    answer = run("convert", source, first)
    rules = {finding["rule"] for finding in answer["diagnostics"]}
    if "mjcf.left-out" in rules or "mjcf.touch" not in rules:
        faults.append(f"sensors: {sorted(rules)}")
    round_trip.without_source(first)
    run("convert", first, back)
    before, after = sensordata(source), sensordata(back)
    for key, (wanted,) in before.items():
        if key not in after:
            faults.append(f"sensors: {key} is lost")
        elif key[0] != int(mujoco.mjtSensor.mjSENS_TOUCH):  # contacts are as soft as chosen
            nearest = min(after[key], key=lambda found: abs(found - wanted).max())
            near(f"sensor {key}", nearest, wanted)


# What is not converted, and said so: a mesh is no prim of its own.
NO_SENSOR = {"s_tactile"}
SENSOR = ("sensor_type", "sensor_datatype", "sensor_needstage", "sensor_objtype", "sensor_reftype",
          "sensor_intprm", "sensor_dim", "sensor_cutoff", "sensor_noise", "sensor_history",
          "sensor_delay", "sensor_interval", "sensor_user")
NAMED = {"sensor_objtype": "sensor_objid", "sensor_reftype": "sensor_refid"}


def sensor_row(model, number):
    """All that a sensor says; things by their names."""
    row = {field: getattr(model, field)[number].tolist() for field in SENSOR
           if hasattr(model, field)}
    for kind, thing in NAMED.items():
        row[thing] = mujoco.mj_id2name(model, int(getattr(model, kind)[number]),
                                       int(getattr(model, thing)[number]))
    while row["sensor_user"] and row["sensor_user"][-1] == 0:  # as many as the model has room for
        row["sensor_user"].pop()
    return row


def compare_sensors(form, before, after, answer):
    rows = [{model.sensor(i).name or "gyro": sensor_row(model, i)
             for i in range(model.nsensor)} for model in (before, after)]
    for name in NO_SENSOR:
        rows[0].pop(name, None)
    if list(rows[0]) != list(rows[1]):
        faults.append(f"every sensor: {form} {list(rows[1])}: {answer['diagnostics']}")
        return
    for name, wanted in rows[0].items():
        if rows[1][name] != wanted:
            faults.append(f"every sensor: {form} {name}: {rows[1][name]}, before {wanted}")


def check_every_sensor(work):
    """A model that is made anew has every sensor as it was: kind, name, things, numbers, order."""
    source = ROOT / "tests/convert/mjcf/every_sensor.xml"
    before = mujoco.MjModel.from_xml_path(str(source))
    kinds = {int(kind) for kind in mujoco.mjtSensor.__members__.values()}
    if kinds - set(before.sensor_type.tolist()) != {int(mujoco.mjtSensor.mjSENS_PLUGIN)}:
        faults.append(f"every sensor: {kinds - set(before.sensor_type.tolist())} are not tried")
    for form in ("every.usda", "every/"):
        # The sensor that is left out is a warning, not an error.
        answer = run("convert", source, f"{work}/{form}")
        lost = [finding["message"] for finding in answer["diagnostics"]
                if finding["rule"] == "convert.sensor"]
        if len(lost) != len(NO_SENSOR) or not all(name in "".join(lost) for name in NO_SENSOR):
            faults.append(f"every sensor: {lost}")
        asset = work / (f"{form}every_sensor.usda" if form.endswith("/") else form)
        round_trip.without_source(work / "every/payloads/base.usda" if form.endswith("/")
                                  else asset)
        answer = run("convert", asset, work / "every.xml", "--force",
                     *(("--physics", "mujoco") if form.endswith("/") else ()))
        after = mujoco.MjModel.from_xml_path(str(work / "every.xml"))
        compare_sensors(form, before, after, answer)
        sites = [[model.site(name).type.tolist() + model.site(name).size.tolist()
                  for name in ("room", "pad", "tip")] for model in (before, after)]
        near("every sensor: volumes", numpy.ravel(sites[1]), numpy.ravel(sites[0]))


STRANGERS = ("hand/manipulate_block_touch_sensors.xml", "adroit_hand/adroit_hammer.xml")


def check_strangers_sensors(work):
    """The same of hands that nobody here wrote, with 121 and 66 sensors."""
    for name in STRANGERS:
        source = ROOT / "build/robots/gymnasium_robotics/envs/assets" / name
        run("convert", source, work / "stranger.usda", "--force")
        round_trip.without_source(work / "stranger.usda")
        answer = run("convert", work / "stranger.usda", work / "stranger.xml", "--force")
        before, after = (mujoco.MjModel.from_xml_path(str(path))
                         for path in (source, work / "stranger.xml"))
        compare_sensors(name, before, after, answer)


def check_sensor_edits(work):
    """What is edited of an instrument holds for the sensor that it stands for."""
    asset = work / "edited_sensors.usda"
    run("convert", ROOT / "tests/convert/mjcf/sensors.xml", asset)
    round_trip.without_source(asset)
    text = asset.read_text()
    imu = next(re.finditer(r'def IsaacImuSensor "(\w+)"', text))
    moved = text[:imu.end()] + re.sub(
        r"\{", "{\n double3 xformOp:translate = (0, 0, 0.25)\n"
        ' uniform token[] xformOpOrder = ["xformOp:translate"]', text[imu.end():], count=1)
    asset.write_text(moved.replace('def IsaacContactSensor "touch"\n', 'def Xform "touch"\n'))
    answer = run("convert", asset, work / "edited_sensors.xml")
    after = mujoco.MjModel.from_xml_path(str(work / "edited_sensors.xml"))
    names = [after.sensor(i).name for i in range(after.nsensor)]
    if "touch" in names or not any("does not measure it any more" in finding["message"]
                                   for finding in answer["diagnostics"]):
        faults.append(f"sensor edits: {names} {answer['diagnostics']}")
    site = after.sensor_objid[names.index("acceleration")]
    before = mujoco.MjModel.from_xml_path(str(ROOT / "tests/convert/mjcf/sensors.xml"))
    old = before.site("imu")
    shift = numpy.zeros(3)
    mujoco.mju_rotVecQuat(shift, numpy.array([0, 0, 0.25]), old.quat)
    near("sensor edits: place", after.site_pos[site], old.pos + shift)


FRAMES = ("body_pos", "body_quat", "body_ipos", "body_mass", "geom_type", "geom_pos",
          "geom_contype", "geom_conaffinity", "geom_solref", "geom_group", "site_pos",
          "site_quat", "jnt_type", "jnt_axis", "jnt_range", "actuator_gainprm",
          "actuator_biasprm", "qpos0")


def check_names_and_frames(work):
    """A floating robot comes back thing by thing: names, frames, numbers, nothing beside them."""
    source = ROOT / "tests/convert/mjcf/floating.xml"
    run("convert", source, work / "f.usda", "--scene")
    round_trip.without_source(work / "f.usda")
    run("convert", work / "f.usda", work / "f.xml")
    before, after = (mujoco.MjModel.from_xml_path(str(path)) for path in (source, work / "f.xml"))
    for kind, count in (("BODY", "nbody"), ("GEOM", "ngeom"), ("SITE", "nsite"),
                        ("ACTUATOR", "nactuator" if hasattr(before, "nactuator") else "nu")):
        names = [[mujoco.mj_id2name(model, getattr(mujoco.mjtObj, f"mjOBJ_{kind}"), i)
                  for i in range(getattr(model, count))] for model in (before, after)]
        if names[0] != names[1]:
            faults.append(f"{kind}: {names[1]}, before {names[0]}")
            return
    for field in FRAMES:
        near(f"floating: {field}", getattr(after, field), getattr(before, field))
    if after.actuator_forcerange[0].tolist() != [-25, 25] or after.nexclude != 0:
        faults.append(f"floating: {after.actuator_forcerange} {after.nexclude}")


def check_kept(work):
    """A model that nobody changed comes back as it was, of all fields that MuJoCo compiles."""
    for name, flags in (("everything", ()), ("floating", ("--scene",)), ("world", ())):
        source = ROOT / f"tests/convert/mjcf/{name}.xml"
        before = mujoco.MjModel.from_xml_path(str(source))
        for form in (f"kept_{name}/", f"kept_{name}.usda"):
            # A height field is an error, as robots in USD have none.
            subprocess.run([TENON, "convert", source, f"{work}/{form}", "-q", *flags], check=False)
            asset = work / (f"{form}{name}.usda" if form.endswith("/") else form)
            for variant in ("mujoco", "physics") if form.endswith("/") else ("",):
                run("convert", asset, work / "kept.xml", "--force",
                    *(("--physics", variant) if variant else ()))
                after = mujoco.MjModel.from_xml_path(str(work / "kept.xml"))
                for field in round_trip.model_differences(before, after):
                    faults.append(f"kept: {form} {variant}: {field}")


def check_changed(work):
    """One that has no place for a change is made anew of what the asset says, and that is told."""
    asset, back = work / "kept_floating.usda", work / "changed.xml"
    arm = "/floating/Geometry/world/base/arm"
    run("set", asset, f"{arm}.physics:mass=2.5", f"{arm}.xformOp:translate=(0, 0, 0.25)")
    answer = run("convert", asset, back)
    said = [finding for finding in answer["diagnostics"] if finding["rule"] == "mjcf.written-anew"]
    if len(said) != 1 or "xformOp:translate" not in said[0]["message"] or \
            "physics:mass" in said[0]["message"]:
        faults.append(f"changed: {answer['diagnostics']}")
    near("changed: mass", mujoco.MjModel.from_xml_path(str(back)).body("arm").mass, 2.5)
    check_noticed(work)


# Fields that MuJoCo computes of others.
DERIVED = {"body_subtreemass", "dof_length", "body_invweight0", "dof_invweight0", "dof_M0",
           "tendon_invweight0", "actuator_acc0", "stat.meaninertia", "stat.meanmass",
           "stat.meansize"}
SPRING = {"actuator_gainprm", "actuator_biasprm"}
# Model, edit ("*" is another number), and the fields that differ then.
PATCHES = (
    ("floating", "/floating/Geometry/world/base/arm.physics:mass=2.5", {"body_mass"}),
    ("floating", "/floating/Geometry/world/base/arm.physics:centerOfMass=(0, 0, 0.1)",
     {"body_ipos"}),
    ("floating", "/floating/Physics/elbow.physics:upperLimit=60", {"jnt_range"}),
    ("floating", "/floating/Physics/elbow.newton:damping=0.25", {"dof_damping"}),
    ("floating", "/floating/Physics/elbow.newton:armature=0.5", {"dof_armature"}),
    ("floating", "/floating/Physics/elbow.newton:friction=0.5", {"dof_frictionloss"}),
    ("floating", "/floating/Physics/elbow.mjc:stiffness=3", {"jnt_stiffness"}),
    ("floating", "/floating/Physics/elbow.mjc:solreflimit=[0.03, 0.8]", {"jnt_solref"}),
    ("floating", "/floating/Physics/servo.mjc:biasPrm=[0, -30, -2]", SPRING),
    ("floating", "/floating/Physics/servo.mjc:forceRange:max=7 "
     "/floating/Physics/servo.mjc:forceRange:min=-7", {"jnt_actfrcrange"}),
    ("floating", "/floating/Physics/PhysicsScene.physics:gravityMagnitude=3", {"opt.gravity"}),
    ("floating", "/floating/Physics/PhysicsScene.newton:timeStepsPerSecond=250", {"opt.timestep"}),
    ("everything", "/everything/Physics/x.physics:upperLimit=1.5", {"jnt_range"}),
    ("everything", "/everything/Physics/pitch.mjc:solreflimit=[0.04, 0.8]", {"jnt_solref"}),
    ("everything", "/everything/Physics/reach.mjc:biasPrm=[0, -80, -3]", SPRING),
    ("everything", "/everything/Physics/pull.mjc:gainPrm=[25, 0, 0, 0, 0, 0, 0, 0, 0, 0]",
     {"actuator_gainprm"}),
)


def check_patched(work):
    """Edits of numbers go into the model that is kept: all that MJCF alone has comes back."""
    for name, edit, wanted in PATCHES:
        source = ROOT / f"tests/convert/mjcf/{name}.xml"
        before = mujoco.MjModel.from_xml_path(str(source))
        for form in (f"patched_{name}/", f"patched_{name}.usda"):
            subprocess.run([TENON, "convert", source, f"{work}/{form}", "-q", "--scene", "--force"],
                           check=False)
            asset = work / (f"{form}{name}.usda" if form.endswith("/") else form)
            variant = ("--physics", "mujoco") if form.endswith("/") else ()
            api = {"newton:[adf]": "NewtonJointAPI", "mjc:s": "MjcJointAPI"}
            prim, prop = edit.split("=")[0].split(".", 1)
            applied = [f"{prim}={schema}" for start, schema in api.items()
                       if re.match(start, prop)]
            edited = subprocess.run(
                [TENON, "set", asset, *re.split(" (?=/)", edit),
                 *(["--apply", applied[0]] if applied else []), "-q"],
                check=False, capture_output=True, text=True)
            if edited.returncode != 0:
                faults.append(f"patched: {edit}: {edited.stderr}")
                continue
            answer = run("convert", asset, work / "patched.xml", "--force", *variant)
            rules = [finding["rule"] for finding in answer["diagnostics"]]
            if "mjcf.patched" not in rules or "mjcf.written-anew" in rules:
                faults.append(f"patched: {form} {edit}: {answer['diagnostics']}")
                continue
            after = mujoco.MjModel.from_xml_path(str(work / "patched.xml"))
            found = set(round_trip.model_differences(before, after)) - DERIVED
            if not wanted & found or found - wanted:
                faults.append(f"patched: {form} {edit}: {sorted(found)}, wanted {sorted(wanted)}")


def check_friction(work):
    """Friction of one material goes to all shapes that are bound to it, and to no others."""
    asset = work / "friction.usda"
    run("convert", ROOT / "tests/convert/mjcf/floating.xml", asset, "--force")
    text = asset.read_text()
    edited = re.sub("(Friction = )1\n", r"\g<1>0.35\n", text)
    asset.write_text(edited)
    answer = run("convert", asset, work / "friction.xml", "--force")
    after = mujoco.MjModel.from_xml_path(str(work / "friction.xml"))
    near("friction", after.geom_friction[:, 0], [0.35] * after.ngeom)
    if edited == text or "mjcf.patched" not in [d["rule"] for d in answer["diagnostics"]]:
        faults.append(f"friction: {answer['diagnostics']}")


def check_noticed(work):
    """Every kind of edit is noticed: of each property that the asset has, the first one that can be
    changed, and of pairs of bodies what one has and the other gets."""
    asset = work / "noticed.usda"
    run("convert", ROOT / "tests/convert/mjcf/floating.xml", asset, "--scene", "--force")
    text = asset.read_text()
    seen, changed = set(), 0
    for line in re.finditer(r"^ +(?:uniform )?(\S+) (\S+) = (.*)$", text, re.MULTILINE):
        kind, name, value = line.groups()
        if name in seen or not (new := other_value(kind, value)):
            continue
        seen.add(name)
        asset.write_text(text[:line.start(3)] + new + text[line.end(3):])
        answer = run("convert", asset, work / "noticed.xml", "--force")
        rules = [finding["rule"] for finding in answer["diagnostics"]]
        changed += 1
        seen_now = "mjcf.written-anew" in rules or "mjcf.patched" in rules
        if seen_now == name.startswith(UNSEEN):
            faults.append(f"{name}: {value} -> {new} is noticed otherwise: {rules}")
    if changed < 40:
        faults.append(f"only {changed} properties were changed")


# What MuJoCo's format has no place for, and what carries the source itself.
UNSEEN = ("tenon:mjcf:", "isaac:", "extent", "physx", "urdf:", "info:", "outputs:")


def other_value(kind, value):
    """Another value of the same kind; "" for kinds that are not changed here."""
    number = re.search(r"-?\d+(\.\d+)?", value)
    if kind in ("float", "double", "int") and number:
        return "7.25" if kind != "int" else "3"
    if kind.startswith(("float3", "point3", "vector3", "double3", "color3", "quat")) and number:
        return value[:number.start()] + "7.25" + value[number.end():]
    if kind == "bool":
        return "0" if value in ("1", "true") else "1"
    if kind == "rel" and value.startswith("<"):
        return "</nothing>"
    return ""


def check_files(work):
    """Files of the source come along, but nothing else that an asset names as one of them."""
    asset, back = work / "images.usda", work / "files" / "images.xml"
    back.parent.mkdir()
    run("convert", work / "images" / "textured.xml", asset, "--force")
    run("convert", asset, back)
    before = mujoco.MjModel.from_xml_path(str(work / "images" / "textured.xml"))
    for field in round_trip.model_differences(before, mujoco.MjModel.from_xml_path(str(back))):
        faults.append(f"files: {field}")
    # Images that lie where the way back puts them are the asset's own already.
    run("convert", work / "images" / "textured.xml", work / "files" / "same.usda", "--force")
    run("convert", work / "files" / "same.usda", work / "files" / "same.xml")
    for field in round_trip.model_differences(
            before, mujoco.MjModel.from_xml_path(str(work / "files" / "same.xml"))):
        faults.append(f"files beside: {field}")
    (work / "images" / "secret.txt").write_text("nobody else's business")
    text = asset.read_text()
    asset.write_text(re.sub("(asset tenon:mjcf:file0 = )@.*@", r"\1@images/secret.txt@", text))
    answer = run("convert", asset, back, "--force")
    if "mjcf.written-anew" not in [finding["rule"] for finding in answer["diagnostics"]]:
        faults.append(f"files: {answer['diagnostics']}")
    if any(path.name == "secret.txt" for path in back.parent.rglob("*")):
        faults.append("files: an asset named a file that is no shape and got it")


def check_left_out(work):
    """Unless asked for, the world stays out, and that is said."""
    answer = run("convert", ROOT / "tests/convert/mjcf/world.xml", work / "robot.usda")
    said = [finding for finding in answer["diagnostics"] if finding["rule"] == "convert.scene"]
    if len(said) != 1 or "gravity, timestep" not in said[0]["message"]:
        faults.append(f"the world: {said}")
    if "PhysicsScene" in (work / "robot.usda").read_text():
        faults.append("there is a PhysicsScene that nobody asked for")


if __name__ == "__main__":
    sys.exit(round_trip.main(check_world, check_left_out, check_images, check_sensors,
                             check_every_sensor, check_strangers_sensors, check_sensor_edits,
                             check_names_and_frames, check_kept, check_changed, check_patched,
                             check_friction, check_files))
