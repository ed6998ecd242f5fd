#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Each requirement of REP-0158: met by one small robot, broken by a copy with one edit.

    test_rep0158.py ROOT TENON [CHECKER_PYTHON [ASSET...] | --write]

docs/rep-0158.md lists the requirements; --write makes its table. With a Python that has
ros-openusd-compliance-checker, whose code runs from Python 3.11 on, the robot, its copies and the
assets are judged by it, too, and each code and severity has to be the same.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
TABLE = ROOT / "tenon/check/rep0158/requirements.def"
PAGE = ROOT / "docs/rep-0158.md"
ROW = re.compile(r'TENON_REP\("([^"]+)", (\w+), \w+,\s*((?:"[^"]*"\s*)+)\)')
TEXT = re.compile('"([^"]*)"')
MARKED = re.compile(r"(<!-- codes -->\n).*?(<!-- end of codes -->)", re.S)
GOOD = """#usda 1.0
(
    defaultPrim = "Robot"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    timeCodesPerSecond = 1
    upAxis = "Z"
)
def Xform "Robot" (
    apiSchemas = ["RosContextAPI"]
    assetInfo = { string identifier = "robot"
        string version = "1" }
    kind = "component"
    variants = { string Look = "plain" }
    variantSets = "Look"
)
{
    string ros:context:namespace = "/cell/robot_1"
    string ros:context:parent_frame = "map"
    variantSet "Look" = { "plain" {} }
    def Xform "Base" (
        apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysicsArticulationRootAPI"]
    )
    {
        float physics:mass = 1
        double3 xformOp:translate = (0, 0, 1)
        quatf xformOp:orient = (1, 0, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]
        def Mesh "Solid" (
            apiSchemas = ["PhysicsCollisionAPI", "PhysicsMeshCollisionAPI", "MaterialBindingAPI"]
        )
        {
            uniform token purpose = "guide"
            uniform token physics:approximation = "none"
            rel material:binding:physics = </Robot/Rubber>
            point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
            int[] faceVertexCounts = [3, 3, 3, 3]
            int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
        }
        def Camera "Eye" ()
        {
            def Xform "Optical" (apiSchemas = ["RosFrameAPI"])
            {
                string ros:frame:id = "eye_optical"
                bool ros:frame:static = true
                float xformOp:rotateX = 180
                uniform token[] xformOpOrder = ["xformOp:rotateX"]
            }
        }
        def Xform "Imu" (apiSchemas = ["RosTopicAPI"])
        {
            token ros:topic:role = "publisher"
            string ros:topic:name = "imu/data"
            string ros:topic:type = "sensor_msgs/msg/Imu"
            double ros:topic:publish_rate = 100
            token ros:topic:qos:reliability = "reliable"
            token ros:topic:qos:history = "keep_last"
            int ros:topic:qos:depth = 5
            bool ros:topic:starts_enabled = true
            string ros:topic:override_frame_id = "map"
            bool ros:topic:qos:match_publisher = false
        }
    }
    def Xform "Arm" (apiSchemas = ["PhysicsRigidBodyAPI"]) {}
    def PhysicsRevoluteJoint "Joint"
    {
        rel physics:body0 = </Robot/Base>
        rel physics:body1 = </Robot/Arm>
        float physics:lowerLimit = -90
        float physics:upperLimit = 90
        custom string ros:joint:name = "joint"
    }
    def Scope "Calls"
    {
        def Scope "Service" (apiSchemas = ["RosServiceAPI"])
        {
            token ros:service:role = "server"
            string ros:service:name = "reset"
            string ros:service:type = "std_srvs/srv/Trigger"
            bool ros:service:starts_enabled = true
        }
        def Scope "Action" (apiSchemas = ["RosActionAPI"])
        {
            token ros:action:role = "server"
            string ros:action:name = "move"
            string ros:action:type = "control_msgs/action/GripperCommand"
            bool ros:action:starts_enabled = true
        }
    }
    def Material "Rubber" (apiSchemas = ["PhysicsMaterialAPI"])
    {
        float physics:staticFriction = 1
        float physics:dynamicFriction = 1
        float physics:restitution = 0
    }
}
def Xform "Side" {}
"""
MIMIC = """    def PhysicsRevoluteJoint "Second" (apiSchemas = ["MimicJointAPI"])
    {
        rel mimic:joint = </Robot/Joint>
        float physics:lowerLimit = -90
        float physics:upperLimit = 90
        custom string ros:joint:name = "second"
    }
"""
MESH = ('def Mesh "Large"\n{\n    point3f[] points = [' + ", ".join(["(0, 0, 0)"] * 60) +
        "]\n}\n")
INSTANCER = ('def PointInstancer "Many"\n{\n    rel prototypes = </Robot/Arm>\n'
             "    int[] protoIndices = [0]\n    point3f[] positions = [(0, 0, 0)]\n}\n")
END = 'def Xform "Side" {}\n'

# Code, what is replaced, by what. Several edits of one code are several copies.
EDITS = (
    ("1.1.1", "metersPerUnit = 1", "metersPerUnit = 0.01"),
    ("1.1.2", "kilogramsPerUnit = 1", "kilogramsPerUnit = 2"),
    ("1.1.3", 'upAxis = "Z"', 'upAxis = "Y"'),
    ("1.1.4", "    string ros:context:namespace",
     "    float xformOp:rotateZ = 9\n    uniform token[] xformOpOrder = [\"xformOp:rotateZ\"]\n"
     "    string ros:context:namespace"),
    ("1.1.5", "timeCodesPerSecond = 1", "timeCodesPerSecond = 24"),
    ("1.1.6", '["xformOp:translate", "xformOp:orient"]', '["xformOp:translate"]'),
    ("1.1.7", '"xformOp:orient"]', '"xformOp:orient", "xformOp:scale"]\n'
     "        float3 xformOp:scale = (2, 2, 2)"),
    ("1.2.1", '    defaultPrim = "Robot"\n', ""),
    ("1.2.2", 'string identifier = "robot"', 'string name = "robot"'),
    ("1.2.3", 'string version = "1"', 'string revision = "1"'),
    ("1.2.4", END, 'def Xform "Side" (references = @/nowhere/a.usda@) {}\n'),
    ("1.2.6", 'def Scope "Calls"', 'def Scope "Calls" (kind = "component")'),
    ("1.2.7", '    variants = { string Look = "plain" }\n', ""),
    ("1.2.8", END, 'class "C" {}\ndef Xform "Side" (inherits = </C>) {}\n'),
    ("1.2.8", END, 'class "C" {}\ndef Xform "Side" (specializes = </C>) {}\n'),
    ("1.2.9", END, 'def Xform "Side"\n{\n    custom string my:AssetPath = "a.usda"\n}\n'),
    ("1.2.10", 'def Xform "Arm" (apiSchemas', 'def Xform "Arm" (payload = @./part.usda@\n'
     "        apiSchemas"),
    ("1.2.11", END, INSTANCER),
    ("1.2.13", END, MESH),
    ("1.3.1", "        float physics:lowerLimit = -90\n", ""),
    ("1.3.2", 'def Xform "Arm" (apiSchemas = ["PhysicsRigidBodyAPI"]',
     'def Xform "Arm" (apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsArticulationRootAPI"]'),
    ("1.3.3", "physics:mass = 1", "physics:mass = 0"),
    ("1.3.4", 'purpose = "guide"', 'purpose = "default"'),
    ("1.3.4", 'approximation = "none"', 'approximation = "convexHull"'),
    ("1.3.5", "            rel material:binding:physics = </Robot/Rubber>\n", ""),
    ("1.3.5", "        float physics:restitution = 0\n", ""),
    ("1.3.7", '    def Scope "Calls"', MIMIC.replace("</Robot/Joint>", "</Robot/Arm>") +
     '    def Scope "Calls"'),
    ("1.3.7", '    def Scope "Calls"', MIMIC.replace("</Robot/Joint>", "</Robot/Second>") +
     '    def Scope "Calls"'),
    ("1.3.7", 'def Xform "Side"', 'def Xform "Side" (apiSchemas = ["MimicJointAPI"])'),
    ("1.3.8", 'def Xform "Arm" (apiSchemas', 'def Xform "Arm" (instanceable = true\n'
     "        apiSchemas"),
    ("1.3.9", '    def Scope "Calls"', MIMIC + '    def Scope "Calls"'),
    ("2.1.1", END, 'def Xform "Side" (payload = @./part.usda@) '
     '{\ndef Scope "In" (apiSchemas = ["RosContextAPI"]) {}\n}\n'),
    ("2.1.2", END, 'def Xform "Side" (apiSchemas = ["RosContextAPI"])\n'
     '{\nstring ros:context:parent_frame = "map"\n}\n'),
    ("2.1.3", '"/cell/robot_1"', '"~/robot"'),
    ("2.2.1", END, 'def Xform "Side" (payload = @./part.usda@) '
     '{\ndef Scope "In" (apiSchemas = ["RosServiceAPI"])\n{\n'
     'token ros:service:role = "client"\nstring ros:service:name = "a"\n'
     'string ros:service:type = "b"\n}\n}\n'),
    ("2.2.2", 'def Scope "Service" (apiSchemas = ["RosServiceAPI"]',
     'def Xform "Service" (apiSchemas = ["RosServiceAPI", "PhysicsRigidBodyAPI"]'),
    ("2.2.3", '["RosServiceAPI"]', '["RosServiceAPI", "RosActionAPI"]'),
    ("2.2.4", 'def Xform "Imu"', 'def Scope "Imu"'),
    ("2.3.1", '"imu/data"', '"imu//data"'),
    ("2.3.1", '"reset"', '"9reset"'),
    ("2.3.1", '"move"', '"mo-ve"'),
    ("2.4.1", 'topic:role = "publisher"', 'topic:role = "speaker"'),
    ("2.4.2", '            string ros:topic:name = "imu/data"\n', ""),
    ("2.4.3", '            string ros:topic:type = "sensor_msgs/msg/Imu"\n', ""),
    ("2.4.4", "            double ros:topic:publish_rate = 100\n", ""),
    ("2.4.5", 'reliability = "reliable"', 'reliability = "sure"'),
    ("2.4.6", "bool ros:topic:starts_enabled = true", "int ros:topic:starts_enabled = 1"),
    ("2.4.7", 'override_frame_id = "map"', 'override_frame_id = "the map"'),
    ("2.4.7", 'string ros:topic:override_frame_id = "map"', "int ros:topic:override_frame_id = 3"),
    ("2.4.8", "match_publisher = false", "match_publisher = true"),
    ("2.4.8", "bool ros:topic:qos:match_publisher = false",
     "float ros:topic:qos:match_publisher = 1"),
    ("2.4.9", "qos:depth = 5", "qos:depth = 0"),
    ("2.4.9", "int ros:topic:qos:depth = 5", "double ros:topic:qos:depth = 5"),
    ("2.5.1", 'service:role = "server"', 'service:role = "waiter"'),
    ("2.5.1", '            string ros:service:type = "std_srvs/srv/Trigger"\n', ""),
    ("2.5.2", "bool ros:service:starts_enabled = true", "int ros:service:starts_enabled = 1"),
    ("2.6.1", '            string ros:action:name = "move"\n', ""),
    ("2.6.2", "bool ros:action:starts_enabled = true", "int ros:action:starts_enabled = 1"),
    ("2.7.1", 'def Xform "Arm" (apiSchemas = ["PhysicsRigidBodyAPI"]',
     'def Xform "Arm" (apiSchemas = ["PhysicsRigidBodyAPI", "RosFrameAPI"]'),
    ("2.7.2", '"eye_optical"', '"eye optical"'),
    ("2.7.3", "bool ros:frame:static = true", "int ros:frame:static = 1"),
    ("2.8.1", '                uniform token[] xformOpOrder = ["xformOp:rotateX"]\n', ""),
    ("2.8.1", 'def Camera "Eye" ()', 'def Camera "Eye" (apiSchemas = ["RosTopicAPI"])'),
    ("2.9.1", '"imu/data"', '"/clock"'),
    ("2.9.2", '"sensor_msgs/msg/Imu"', '"rosgraph_msgs/msg/Clock"'),
    ("2.10.1", '        custom string ros:joint:name = "joint"\n', ""),
)
# An edit cannot break these: the layer would have to be binary.
WITHOUT = {"1.2.12"}
CHECKER = """
import json, sys
from compliance_checker.checker import ComplianceChecker
for path in sys.argv[1:]:
    found = ComplianceChecker.from_path(path, include_extensions=False).run().violations
    print(json.dumps([path, sorted({(v.check_id, v.severity.value) for v in found})]), flush=True)
"""


def written(folder):
    """[(code or none, path)]"""
    (folder / "part.usda").write_text('#usda 1.0\n(defaultPrim = "P")\ndef Xform "P" {}\n')
    made = [(None, folder / "good.usda")]
    made[0][1].write_text(GOOD)
    for i, (code, old, new) in enumerate(EDITS):
        assert GOOD.count(old) == 1, (code, GOOD.count(old))
        made.append((code, folder / f"{code}_{i}.usda"))
        made[-1][1].write_text(GOOD.replace(old, new))
    return made


def judged(paths):
    """{path: {(code, severity)}}"""
    found = {}
    for path in paths:
        done = subprocess.run([TENON, "check", "--json", "--no-settings", "--profile", "rep-0158",
                               "--only", "rep-0158", path], capture_output=True, text=True,
                              check=False)
        said = json.loads(done.stdout)
        found[path] = {(f["rule"].removeprefix("rep-0158."), f["severity"])
                       for f in said["diagnostics"]}
        verdicts = {one["code"].removeprefix("rep-0158.") for row in said["assets"]
                    for one in row["codes"] if one["verdict"] == "fail"}
        if {code for code, _ in found[path]} != verdicts:
            yield f"{path}: verdicts {verdicts}"
    yield found


def page_of(rows):
    """docs/rep-0158.md with the table of the requirements."""
    table = "| code | | asks |\n|---|---|---|\n"
    for code, need, texts in rows:
        severity = {"Must": "error", "May": "warning"}[need]
        table += f"| {code} | {severity} | {''.join(TEXT.findall(texts))} |\n"
    return MARKED.sub(lambda at: at[1] + table + at[2], PAGE.read_text("utf-8"))


def main():
    rows = ROW.findall(TABLE.read_text("utf-8"))
    if "--write" in sys.argv:
        PAGE.write_text(page_of(rows), "utf-8")
        return 0
    codes = {code: need for code, need, _ in rows}
    faults = [f"{code} has no edit" for code in codes.keys() - {c for c, _, _ in EDITS} - WITHOUT]
    if page_of(rows) != PAGE.read_text("utf-8"):
        faults.append(f"{PAGE.name} is not up to date: run {pathlib.Path(__file__).name} --write")
    with tempfile.TemporaryDirectory() as home:
        made = written(pathlib.Path(home))
        *more, found = judged([str(path) for _, path in made] + sys.argv[4:])
        faults += more
        for code, path in made:
            if code is None and found[str(path)]:
                faults.append(f"the good robot: {found[str(path)]}")
            if code is not None and code not in {one for one, _ in found[str(path)]}:
                faults.append(f"{path.name}: {found[str(path)]}")
        if len(sys.argv) > 3:
            done = subprocess.run([sys.argv[3], "-c", CHECKER, *found], capture_output=True,
                                  text=True, check=True)
            for line in done.stdout.splitlines():
                path, theirs = json.loads(line)
                if {tuple(one) for one in theirs} != found[path]:
                    faults.append(f"{pathlib.Path(path).name}: the checker says {theirs}, "
                                  f"tenon {sorted(found[path])}")
    print("\n".join(faults + [f"{len(codes)} requirements, {len(found)} robots, "
                              f"{len(faults)} faults"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
