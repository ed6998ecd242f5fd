#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every verb on small assets that are odd: no run dies of a signal, and none fails without a word.

    test_odd_assets.py TENON [all]

The verbs are those that the program's help lists. The default prim is of every type that may hold
physics; with `all` of every type that the program knows, in every form.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

TENON = sys.argv[1]
os.environ["TENON_CHROMIUM"] = str(
    pathlib.Path(__file__).resolve().parents[1] / "view/fake_browser.py")
ALL = sys.argv[2:] == ["all"]

BODY = 'def Xform "B" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) { %s }'
CUBE = 'def Cube "C" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {}'
# What may stand below and beside the default prim.
INSIDES = {
    "nothing": "",
    "body": BODY % CUBE,
    "joint": BODY % "" + ' def PhysicsRevoluteJoint "J" { rel physics:body1 = </A/B> }',
    "robot": BODY % CUBE + ' def PhysicsScene "S" {} def Material "M" {} def Scope "L" {}'
             ' def PhysicsFixedJoint "J" { rel physics:body0 = </A>\nrel physics:body1 = </A/B> }',
}
# Relationships that lead to a property, to their own prim, to nothing, to a prim of another kind.
TARGETS = "".join(
    f'def {kind} "{kind}{number}" (prepend apiSchemas = ["{api}"]) {{ rel {name} = {target}\n}}\n'
    for number, target in enumerate(["</A.x>", "</A>", "</No/Where>", "</A/Scope>", "None",
                                     "[</A/PhysicsFixedJoint1>, </A.x>, </No>]"])
    for kind, api, name in [("PhysicsFixedJoint", "UnknownAPI", "physics:body1"),
                            ("Cube", "PhysicsCollisionAPI", "physics:simulationOwner"),
                            ("Xform", "PhysicsRigidBodyAPI", "physics:simulationOwner"),
                            ("PhysicsRevoluteJoint", "NewtonMimicAPI", "newton:mimicJoint"),
                            ("Sphere", "PhysicsFilteredPairsAPI", "physics:filteredPairs"),
                            ("PhysicsCollisionGroup", "UnknownAPI", "physics:filteredGroups"),
                            ("PointInstancer", "UnknownAPI", "prototypes"),
                            ("MjcActuator", "UnknownAPI", "mjc:target"),
                            ("MjcTendon", "UnknownAPI", "mjc:path"),
                            ("Capsule", "MaterialBindingAPI", "material:binding:physics"),
                            ("Plane", "IsaacRobotAPI", "isaac:physics:robotLinks")]
) + 'def Scope "Scope" {}\ndouble x = 1\n'  # fmt: skip

FEW_TYPES = ["", "Unknown", "Xform", "Mesh", "Material", "Camera", "GeomSubset",
             "PointInstancer", "PhysicsScene", "PhysicsCollisionGroup", "PhysicsPrismaticJoint",
             "PhysicsJoint"]  # fmt: skip
APIS = ["PhysicsRigidBodyAPI", "PhysicsArticulationRootAPI", "PhysicsCollisionAPI",
        "PhysicsMeshCollisionAPI", "PhysicsMassAPI", "PhysicsMaterialAPI",
        "PhysicsDriveAPI:angular", "PhysicsLimitAPI:rotX", "PhysicsFilteredPairsAPI",
        "IsaacRobotAPI", "IsaacLinkAPI", "IsaacJointAPI", "NewtonMimicAPI",
        "UnknownAPI"]  # fmt: skip

SET_OPTIONS = {
    "--apply": "PhysicsMassAPI", "--remove": "PhysicsRigidBodyAPI", "--mass": "2",
    "--drive": "stiffness:10,damping:1", "--mimic": "/A/J,2", "--collider": "convexHull",
    "--material": "/A/M",
}  # fmt: skip

HEADER = '#usda 1.0\n(defaultPrim = "A")\n'
SHAPES = {
    "empty": "#usda 1.0\n",
    "no_default": '#usda 1.0\ndef Xform "A" { %s }\n' % INSIDES["body"],
    "missing_default": HEADER + 'def Xform "Other" { %s }\n' % INSIDES["nothing"],
    "default_below": '#usda 1.0\n(defaultPrim = "A/B")\ndef Xform "A" { %s }\n' % INSIDES["body"],
    "default_is_no_name": '#usda 1.0\n(defaultPrim = "1 a")\ndef Xform "A" {}\n',
    "class": HEADER + 'class Xform "A" { %s }\n' % INSIDES["robot"],
    "over": HEADER + 'over "A" { %s }\n' % INSIDES["robot"],
    "inactive": HEADER + 'def Xform "A" (active = false) { %s }\n' % INSIDES["robot"],
    "inactive_child": HEADER + 'def Xform "A" { def Xform "B" (active = false) {} }\n',
    "instance": HEADER + 'def Xform "A" (instanceable = true\nreferences = </P>) {}\n'
                'def Xform "P" { %s }\n' % (BODY % CUBE),
    "instance_below": HEADER + 'def Xform "A" { def "I" (instanceable = true\nreferences = </P>)'
                      ' {} }\nclass Xform "P" { %s }\n' % (BODY % CUBE),
    "in_variant": HEADER + 'def Xform "A" (variants = { string v = "x" }\nprepend variantSets = '
                  '"v") {\nvariantSet "v" = { "x" { %s } "y" {} }\n}\n' % INSIDES["body"],
    "type_in_variant": HEADER + 'over "A" (variants = { string v = "x" }\nprepend variantSets = '
                       '"v") {\nvariantSet "v" = { "x" (active = false) { } }\n}\n',
    "no_variants": HEADER + 'def Xform "A" (prepend variantSets = ["v", "Physics"]) {\n}\n',
    "missing_arcs": HEADER + 'def "A" (references = [@none.usda@, </No>]\npayload = @no.usda@\n'
                    'inherits = </Nowhere>\nspecializes = </A>) {}\n',
    "missing_sublayer": '#usda 1.0\n(subLayers = [@no.usda@])\n',
    "root_properties": HEADER + 'def Xform "A" { rel r = [</A>, </No.p>]\n'
                       'double3 xformOp:translate = (1, 2, 3)\n'
                       'uniform token[] xformOpOrder = ["xformOp:rotateX"] }\n',
    "joint_of_itself": HEADER + 'def PhysicsRevoluteJoint "A" (prepend apiSchemas = '
                       '["PhysicsDriveAPI:angular"]) { rel physics:body0 = </A>\n'
                       'rel physics:body1 = </A> }\n',
    "default_is_a_property": '#usda 1.0\n(defaultPrim = "A.x")\ndef Xform "A" { double x = 1\n}\n',
    "default_is_in_a_variant": '#usda 1.0\n(defaultPrim = "/A{v=x}B")\ndef Xform "A" { '
                               'variantSet "v" = { "x" { def Xform "B" {} } } }\n',
    "default_is_the_root": '#usda 1.0\n(defaultPrim = "/")\ndef Xform "A" { %s }\n'
                           % INSIDES["body"],
    "default_has_no_type": HEADER + 'def "A" { %s }\nover "B" {}\nclass "C" {}\n'
                           % INSIDES["joint"],
    "targets_that_are_none": HEADER + 'def Xform "A" { %s }\n' % TARGETS,
    # An inner body that samples switch off, with a collider that only its carrier can have.
    "plane_in_a_switched_body": HEADER + 'def Xform "A" (prepend apiSchemas = '
        '["PhysicsRigidBodyAPI"]) { bool physics:kinematicEnabled = true\n'
        'def Xform "B" (prepend apiSchemas = ["PhysicsRigidBodyAPI"]) {\n'
        'bool physics:rigidBodyEnabled.timeSamples = { 0: 1, 5: 0, }\n'
        'def Plane "C" (prepend apiSchemas = ["PhysicsCollisionAPI"]) {} } }\n',
    "splines_of_nothing": HEADER + 'def Xform "A" { double s.spline = { }\n'
        'double xformOp:translateX.spline = { post: loop repeat, }\n'
        'uniform token[] xformOpOrder = ["xformOp:translateX", "xformOp:", "!invert!", ""]\n}\n',
    "axis_of_no_name": HEADER + 'def Xform "A" { %s def PhysicsRevoluteJoint "J" (prepend '
        'apiSchemas = ["NewtonMimicAPI", "PhysxMimicJointAPI:rotX"]) { rel newton:mimicJoint = '
        '</A/K>\nrel physxMimicJoint:rotX:referenceJoint = </A/K>\n'
        'uniform token physics:axis = ""\nrel physics:body1 = </A/B>\n}\n'
        'def PhysicsRevoluteJoint "K" { uniform token physics:axis = "X:Y Z"\n'
        'rel physics:body1 = </A/B>\n} }\n' % (BODY % ""),
    "lonely_attributes": HEADER + 'def Xform "A" { float physics:mass = 1\n'
                         'rel physics:body0 = </A>\ntoken physics:axis = "Q"\n'
                         'point3f[] points = []\nint[] faceVertexCounts = [3]\n}\n',
}  # fmt: skip


def of_type(name, inside="body", api=""):
    api = f'(prepend apiSchemas = ["{api}"])' if api else ""
    return HEADER + f'def {name} "A" {api} {{ {INSIDES[inside]} }}\n'


def known_types():
    run = subprocess.run([TENON, "test-runner", "schemas"], capture_output=True, check=True)
    schemas = json.loads(run.stdout)
    return [name for name, schema in schemas.items() if not name.endswith("API")
            and "API" not in schema["kind"]]  # fmt: skip


def assets():
    """Name and text of each."""
    for name, text in one_line_assets():
        yield name, text.replace("{ ", "{\n").replace("} ", "}\n").replace(" }", "\n}")


def one_line_assets():
    yield from SHAPES.items()
    for name in FEW_TYPES:
        yield f"type_{name}", of_type(name)
    if not ALL:
        yield "joint_with_body_api", of_type("PhysicsJoint", "robot", "PhysicsRigidBodyAPI")
        return
    for name in sorted(set(known_types() + FEW_TYPES)):
        for inside in INSIDES:
            yield f"type_{name}_{inside}", of_type(name, inside)
    for api in APIS:
        for name in FEW_TYPES:
            yield f"api_{api.replace(':', '_')}_{name}", of_type(name, "robot", api)


def verbs():
    text = subprocess.run([TENON, "help", "--json"], capture_output=True, check=True).stdout
    names = [verb["name"] for verb in json.loads(text)["verbs"]]
    assert len(names) > 15, names
    return names


def calls(verb, asset, folder):
    """The argument lists to try; a verb that is not named here takes the asset alone."""
    out = os.path.join(folder, "out")
    session = os.path.join(os.path.dirname(asset), "session.usda")
    return {
        "bake": [["--duration", "0.01", "-o", out + ".usda"]],
        "cat": [[], ["--flatten"], ["-o", out + ".usdc"]],
        "check": [[], ["--fix", "--dry-run"]],
        "convert": [[out + ".xml"], [out + ".urdf"]],
        "diff": [[asset], ["/dev/null"], ["/dev/null", "--physics"]],
        "dump": [["--xforms"], ["--session", session]],
        "explain": [["/A"], ["/A/B.physics:mass"]],
        "set": [["/A.physics:mass=2"], ["/A.active=false"], ["--clear", "/A.physics:mass"],
                *([option, f"{prim}={value}"] for prim in ("/A", "/A/B") for option, value in
                  SET_OPTIONS.items() if ALL)],
        "sim": [["--duration", "0.01"]],
        "strip": [["-o", out + ".usda"]],
        "structure": [["-o", out], ["--dry-run"], ["--dry-run", "--schema", "both"]],
        "test-runner": [["composition"], ["layer"]],
        "tree": [[], ["--physics", "physics"], ["--show", "physics"]],
        "record": [["-o", out + ".png"]],
        "report": [["-o", out + ".html", "--duration", "0.01"]],
        "view": [["--for", "0"]],
        "where": [["/A"], ["/A.physics:mass"], ["/A/B"]],
        "zip": [["-o", out + ".usdz"]],
    }.get(verb, [[]])


def run(verb, asset, extra):
    """None, or what is wrong."""
    command = [TENON, verb, asset, *extra]
    if verb == "test-runner":
        command = [TENON, verb, *extra, asset]
    elif verb == "diff":
        command = [TENON, verb, asset, *extra]
    done = subprocess.run(command, capture_output=True, check=False, timeout=300,
                          stdin=subprocess.DEVNULL)  # fmt: skip
    said = done.stdout + done.stderr
    if done.returncode < 0 or done.returncode >= 128 or b"Sanitizer" in said:
        return f"died ({done.returncode}): {' '.join(command)}\n{said.decode()[-2000:]}"
    if done.returncode not in (0, 1, 2, 3, 4):
        return f"exit {done.returncode}: {' '.join(command)}"
    return f"fails without a word: {' '.join(command)}" if done.returncode and not said else None


def try_asset(folder, name, text, names):
    place = os.path.join(folder, name)
    faults, count = [], 0
    os.makedirs(place)
    pathlib.Path(place, "a.usda").write_text(text, encoding="utf-8")
    read = subprocess.run([TENON, "cat", os.path.join(place, "a.usda")], capture_output=True,
                          check=False)  # fmt: skip
    if read.returncode != 0:
        return 1, [f"{name}: is no layer: {read.stderr.decode()}"]
    for verb in names:
        for extra in calls(verb, os.path.join(place, "a.usda"), place):
            os.makedirs(place, exist_ok=True)
            asset = pathlib.Path(place, "a.usda")
            asset.write_text(text, encoding="utf-8")
            pathlib.Path(place, "session.usda").write_text(
                '#usda 1.0\nover "A" { def Xform "B" {} }\n', encoding="utf-8")  # fmt: skip
            fault = run(verb, str(asset), extra)
            faults += [f"{name}: {fault}"] if fault else []
            count += 1
            subprocess.run(["rm", "-rf", place], check=True)
    return count, faults


def main():
    names = verbs()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        done = list(pool.map(lambda a: try_asset(folder, *a, names), assets()))
    faults = [fault for _, found in done for fault in found]
    for fault in faults[:40]:
        print(fault)
    print(f"{len(done)} assets, {len(names)} verbs, {sum(n for n, _ in done)} runs, "
          f"{len(faults)} faults")  # fmt: skip
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
