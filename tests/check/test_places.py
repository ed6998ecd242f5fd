#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Findings stand at the item that they are about, with its end.

    test_places.py ROOT TENON

Over the scenes of all rules: the text between the start and the end of each finding is looked at.
ITEMS says by rule which item of the message has to stand there; elsewhere it is the statement of
the property that the finding names, an item of it, or the head of the prim.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
SCENES = ROOT / "tests/check/scenes"
PATH = r"<(/[^>]*)>"
ASSET = r"@([^@]+)@"
QUOTED = r'"([^"]*)"'
API = r"\b((?:Physics|Physx|Newton|Mjc)\w*API(?::\w+)?)"

# Rule -> what in its message is the item, as a pattern whose group stands in the text there.
ITEMS = {
    "stage.unknown-type": QUOTED,
    "stage.unknown-api": QUOTED,
    "stage.target-missing": PATH,
    "stage.asset-missing": ASSET,
    "stage.default-prim-unresolved": QUOTED,
    "xform.op": r"`([^`]*)`",
    "joint.unknown-type": QUOTED,
    "joint.body-missing": PATH,
    "joint.target-not-prim": PATH,
    "filter.target-missing": PATH,
    "group.unknown-target": PATH,
    "material.target-unusable": PATH,
    "mimic.leader-missing": PATH,
    "actuator.target-missing": PATH,
    "scene.owner-missing": PATH,
    "collider.mesh-api-alone": API,
    "collider.mesh-api-ignored": API,
    "collider.is-material": API,
    "collider.not-a-shape": API,
    "body.not-xformable": API,
    "drive.axis-token": API,
    "drive.no-such-axis": API,
    "limit.unknown-axis": API,
    "limit.other-axis": API,
    "mass.between": API,
    "mass.outside-body": API,
    "joint.physx-joint-api": API,
    "compose.invalid-asset-path": ASSET,
    "compose.invalid-sublayer-path": ASSET,
    "compose.muted-asset-path": ASSET,
    "compose.invalid-external-target-path": PATH,
    "compose.invalid-authored-relocation": PATH,
}


def findings(*arguments):
    done = subprocess.run([TENON, "check", "--json", *map(str, arguments)], capture_output=True,
                          check=False)
    return json.loads(done.stdout)["diagnostics"]


def text_at(finding, folder):
    """The bytes from the start to the end of a finding; None where either is unknown."""
    if None in (finding["line"], finding["column"], finding["endLine"], finding["endColumn"]):
        return None
    lines = (folder / finding["file"]).read_bytes().split(b"\n")
    first, last = finding["line"] - 1, finding["endLine"] - 1
    if first == last:
        return lines[first][finding["column"] - 1:finding["endColumn"] - 1].decode()
    parts = [lines[first][finding["column"] - 1:], *lines[first + 1:last],
             lines[last][:finding["endColumn"] - 1]]
    return b"\n".join(parts).decode()


class Scenes(unittest.TestCase):
    def test_every_finding_of_every_scene_has_the_place_of_its_item(self):
        seen, faults = set(), []
        for finding in findings(SCENES):  # one run for all of them
            where = f"{finding['file']}: {finding['rule']}: {finding['message']}"
            text = text_at(finding, pathlib.Path.cwd())
            if text is None:
                if finding["prim"] is not None and finding["line"] is not None:
                    faults.append(f"{where}: no end")
                continue
            seen.add(finding["rule"])
            fault = self.fault(finding, text)
            if fault:
                faults.append(f"{where}: {fault}")
        self.assertEqual(faults, [])
        missing = [rule for rule in ITEMS if rule not in seen and
                   (SCENES / f"{rule}.usda").exists()]
        self.assertEqual(missing, [])

    def fault(self, finding, text):
        """What is wrong with a place whose text is this; nothing when it is right."""
        pattern = ITEMS.get(finding["rule"])
        item = re.search(pattern, finding["message"]) if pattern else None
        if pattern and item is None:
            return "the message names no item"
        if item:
            name = item.group(1)
            if name not in text and name.rpartition("/")[2] not in text:
                return f"{name} is not in `{text}`"
            return f"`{text}` is much more than {name}" if len(text) > len(name) + 40 else None
        if finding["property"]:
            return None if self.tells(finding, text) else f"`{text}` is not the property"
        return None if self.is_head(text) else f"`{text}` is no prim, API or entry"

    @staticmethod
    def tells(finding, text):
        """The statement of the property, an item of it, or the prim that has none of its own."""
        name = finding["property"]
        return (name in text or text.startswith(("<", "@", '"', "def", "over", "class"))
                or re.match(r"[-\d(\[]", text) is not None)

    @staticmethod
    def is_head(text):
        return re.match(r'(def|over|class)\b|"|[\w:]+ \w+ = |\w+ = |@|<|\w+$', text) is not None


class Places(unittest.TestCase):
    def setUp(self):
        self.kept = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.kept.name)
        self.addCleanup(self.kept.cleanup)

    def write(self, name, text):
        (self.folder / name).write_bytes(text.encode())
        return self.folder / name

    def places(self, text, verb="check", name="scene.usda"):
        """rule -> the texts at its findings, in their order."""
        path = self.write(name, text)
        done = subprocess.run([TENON, verb, "--json", path], capture_output=True, check=False,
                              cwd=self.folder)
        found = {}
        for finding in json.loads(done.stdout)["diagnostics"]:
            found.setdefault(finding["rule"], []).append(text_at(finding, self.folder))
        return found

    def test_arcs_apis_and_targets_stand_where_they_are_written(self):
        found = self.places("""#usda 1.0
(
    defaultPrim = "robot"
    subLayers = [@./gone_a.usda@, @./gone_b.usda@ (offset = 3)]
)
def Xform "robot" (
    prepend apiSchemas = ["PhysicsMassAPI", "PhysicsRigidBodyApi"]
    references = [@./missing.usda@</X>, </nowhere>]
    payload = @./lost.usda@
    inherits = </robot>
    variants = { string look = "none" }
    variantSets = "look"
)
{
    rel physics:x = [</ok>, </robot>,
        </nope>]
    color3f inputs:c.connect = </robot.gone>
    asset inputs:file = @./no.png@
    variantSet "look" = { "a" { } }
}
""")
        self.assertEqual(found["compose.invalid-sublayer-path"],
                         ["@./gone_a.usda@", "@./gone_b.usda@"])
        self.assertEqual(found["compose.invalid-asset-path"],
                         ["@./missing.usda@</X>", "@./lost.usda@"])
        self.assertEqual(found["compose.unresolved-prim-path"], ["</nowhere>"])
        self.assertEqual(found["compose.arc-cycle"], ["</robot>"])
        self.assertEqual(found["stage.unknown-api"], ['"PhysicsRigidBodyApi"'])
        self.assertEqual(found["stage.target-missing"], ["</ok>", "</nope>", "</robot.gone>"])
        self.assertEqual(found["stage.asset-missing"], ["@./no.png@"])
        self.assertEqual(found["variant.unknown-selection"], ['"none"'])

    def test_an_item_of_a_weaker_layer_stands_in_that_layer(self):
        self.write("weak.usda", '#usda 1.0\ndef Xform "a" (\n    apiSchemas = '
                   '["PhysicsRigidBodyApi"]\n)\n{\n    prepend rel r = <b>\n}\n')
        found = self.places('#usda 1.0\n(\n    subLayers = [@./weak.usda@]\n)\nover "a"\n{\n'
                            '    append rel r = <../c>\n}\n')
        self.assertEqual(found["stage.unknown-api"], ['"PhysicsRigidBodyApi"'])
        self.assertEqual(sorted(found["stage.target-missing"]), ["<../c>", "<b>"])

    def test_rates_and_units_stand_where_a_layer_says_them(self):
        self.write("part.usda", '#usda 1.0\n(\n    defaultPrim = "p"\n    metersPerUnit = 7\n'
                   '    framesPerSecond = inf\n    timeCodesPerSecond = nan\n)\ndef "p"\n{\n}\n')
        self.write("weak.usda", "#usda 1.0\n(\n    timeCodesPerSecond = 0\n)\n")
        found = self.places("""#usda 1.0
(
    metersPerUnit = 1
    subLayers = [@./weak.usda@]
    timeCodesPerSecond = -1
    framesPerSecond = 30
)
def "a" (
    references = @./part.usda@
)
{
}
""")
        self.assertEqual(sorted(found["units.time-codes-per-second"]),
                         ["framesPerSecond = inf", "timeCodesPerSecond = -1",
                          "timeCodesPerSecond = 0", "timeCodesPerSecond = nan"])
        self.assertEqual(found["units.mixed"], ["metersPerUnit = 7"])

    def test_findings_on_a_robot_stand_at_the_tags_of_its_parts(self):
        robot = self.write("r.urdf", """<robot name="r"><!-- \u00fc -->
  <link name="a"/><link name="b"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 0"/>
    <limit lower="1" upper="-1" effort="1" velocity="1"/></joint>
</robot>
""")
        done = subprocess.run([TENON, "convert", "--json", robot, self.folder / "r.usda"],
                              capture_output=True, check=False, cwd=self.folder)
        found = {finding["rule"]: text_at(finding, self.folder)
                 for finding in json.loads(done.stdout)["diagnostics"]}
        self.assertEqual(found["robot.zero-axis"], '<joint name="j" type="revolute">')
        self.assertEqual(found["robot.limit-order"], '<joint name="j" type="revolute">')

    def test_text_that_is_piped_in_has_the_places_of_a_file(self):
        text = """#usda 1.0
(
    subLayers = [@./gone_a.usda@, @./gone_b.usda@ (offset = 3)]
)
def "a" (
    references = [@./missing.usda@</X>, </nowhere>]
)
{
}
"""
        self.write("scene.usda", text)
        (self.folder / "-").write_text("#usda 1.0\n")  # a file of that name is not the input
        found = []
        for asset in ("scene.usda", "-"):
            done = subprocess.run([TENON, "info", "--json", asset], capture_output=True,
                                  input=text.encode(), check=False, cwd=self.folder)
            found.append([(finding["rule"], text_at(finding, self.folder) if asset != "-" else
                           text_at({**finding, "file": "scene.usda"}, self.folder))
                          for finding in json.loads(done.stdout)["diagnostics"]])
        self.assertEqual(found[0], found[1])
        self.assertEqual([place for _, place in found[0]],
                         ["@./gone_a.usda@", "@./gone_b.usda@", "@./missing.usda@</X>",
                          "</nowhere>"])

    def test_clips_stand_where_their_entries_do(self):
        found = self.places("""#usda 1.0
def Xform "a" (
    clips = {
        dictionary one = {
            double2[] active = [(0, 4)]
            asset[] assetPaths = [@./gone.usda@]
            string primPath = "/P"
        }
        dictionary two = {
            double2[] active = [(0, 0)]
            asset[] assetPaths = [@./gone.usda@]
            string primPath = "/P"
        }
    }
)
{
    double x
}
""")
        self.assertEqual(found["clips.invalid"], ["double2[] active = [(0, 4)]"])
        self.assertEqual(found["clips.layer"], ["@./gone.usda@"])

    def test_columns_of_long_lines_are_not_cut(self):
        blanks = " " * 70000
        found = self.places(f'#usda 1.0\ndef "a" {{ {blanks}rel r = </gone>;{blanks}'
                            f'rel s = [ {blanks}</lost>]\n}}\n')
        self.assertEqual(found["stage.target-missing"], ["</gone>", "</lost>"])
        far = " " * 16_777_300  # more than specs keep
        found = self.places(f'#usda 1.0\ndef "a" {{ {far}rel r = </gone>\n}}\n')
        self.assertEqual(found["stage.target-missing"], ["</gone>"])

    def test_binary_layers_have_no_places(self):
        text = self.write("a.usda", '#usda 1.0\ndef "a" (references = @./gone.usda@) { }\n')
        binary = self.folder / "a.usdc"
        subprocess.run([TENON, "cat", text, "-o", binary], check=True, capture_output=True)
        for finding in findings(binary):
            if finding["rule"] == "compose.invalid-asset-path":
                self.assertEqual([finding[key] for key in
                                  ("line", "column", "endLine", "endColumn")], [None] * 4)
                break
        else:
            self.fail("the missing reference is not found")

    def test_all_faults_of_a_refused_layer_are_told(self):
        bad = self.write("bad.usda", '#usda 1.0\ndef "a"\n{\n    int x = \n}\n'
                         'def "b"\n{\n    int y = = 2\n}\n')
        done = subprocess.run([TENON, "cat", bad], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)
        places = re.findall(r"bad\.usda:(\d+:\d+): error: ", done.stderr)
        self.assertEqual(places, ["4:13", "8:13"])
        for verb in ("check", "info", "tree"):
            done = subprocess.run([TENON, verb, "--json", bad], capture_output=True, check=False)
            self.assertEqual(done.returncode, 2, verb)
            found = [(finding["line"], finding["column"], finding["endColumn"])
                     for finding in json.loads(done.stdout)["diagnostics"]]
            self.assertEqual(found, [(4, 13, 13), (8, 13, 14)], verb)

    def test_sarif_has_regions_with_ends(self):
        scene = self.write("s.usda", '#usda 1.0\ndef Xform "a" (\n    references = '
                           '@./gone.usda@\n)\n{\n    rel r = [</ok>,\n        </nope>]\n}\n')
        log = self.folder / "log.sarif"
        subprocess.run([TENON, "check", scene, "--sarif", log], capture_output=True, check=False)
        regions = {}
        for result in json.loads(log.read_text())["runs"][0]["results"]:
            region = result["locations"][0]["physicalLocation"].get("region")
            if region is not None:
                self.assertLessEqual({"startLine"}, set(region))
                self.assertTrue(all(isinstance(n, int) and n > 0 for n in region.values()))
                self.assertEqual("endLine" in region, "endColumn" in region)
                if "endLine" in region:
                    self.assertLessEqual((region["startLine"], region["startColumn"]),
                                         (region["endLine"], region["endColumn"]))
                regions.setdefault(result["ruleId"], []).append(region)
        self.assertEqual(regions["compose.invalid-asset-path"],
                         [{"startLine": 3, "startColumn": 18, "endLine": 3, "endColumn": 31}])
        self.assertEqual(regions["stage.target-missing"][1],
                         {"startLine": 7, "startColumn": 9, "endLine": 7, "endColumn": 16})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
