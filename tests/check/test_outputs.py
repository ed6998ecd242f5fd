#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What `tenon check` gives to people, scripts and continuous integration.

    test_outputs.py ROOT TENON
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
SCENES = ROOT / "tests/check/scenes"
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT / "../shared"))

# Errors and warnings that published assets give for good reason.
KNOWN = {
    "03_spheres_with_materials_fixed.usda": {"mass.density"},  # 10 kg per cubic centimetre
    "07_distance_joint_fixed.usda": {"joint.outside-limit"},   # starts at distance 0 of 10 to 50
    # Thumb joints whose leader goes further than they may.
    "inspire_hand.usda": {"mimic.outside-limits"},
}

# What the seven scenes of the proposal give as they are written: Q-1..Q-8, Q-12, Q-14.
AS_WRITTEN = {
    "01_box_on_box_proposal": {"attribute.moved-input", "collider.default-size"},
    "02_box_on_quad_asis": {"text.syntax"},
    "02_box_on_quad_proposal": {"collider.subdivision-ignored", "collider.normals-flipped",
                                "mass.center-moved"},
    "03_spheres_with_materials_asis": {"text.syntax"},
    "03_spheres_with_materials_proposal": {"attribute.unprefixed", "material.binding-api-missing",
                                           "collider.subdivision-ignored"},
    "06_joint_proposal": {"scene.legacy-gravity"},
    "07_distance_joint_asis": {"text.syntax"},
    "07_distance_joint_proposal": {"joint.unknown-type", "attribute.unprefixed"},
}

EIGHT = """#usda 1.0
(
    defaultPrim = "R"
    kilogramsPerUnit = 1
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "R" (
    prepend apiSchemas = ["PhysicsArticulationRootAPI"]
)
{
    def PhysicsScene "Scene"
    {
    }
"""


def body(name, x, lines=(), size=0.1):
    text = "".join(f"        {line}\n" for line in lines)
    return f"""
    def Cube "{name}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {{
        double size = {size}
{text}        double3 xformOp:translate = ({x}, 0, 1)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
"""


def joint(name, side0, side1, lines=(), offset=-0.5):
    text = "".join(f"        {line}\n" for line in lines)
    return f"""
    def PhysicsRevoluteJoint "{name}" (
        prepend apiSchemas = ["PhysicsDriveAPI:angular"]
    )
    {{
        rel physics:body0 = </R/{side0}>
        rel physics:body1 = </R/{side1}>
        point3f physics:localPos0 = (0.5, 0, 0)
        point3f physics:localPos1 = ({offset}, 0, 0)
{text}        float drive:angular:physics:maxForce = 5
    }}
"""


def gains(stiffness, damping):
    return (f"float drive:angular:physics:stiffness = {stiffness}",
            f"float drive:angular:physics:damping = {damping}")


def eight_defects():
    limits = ("float physics:lowerLimit = 30", "float physics:upperLimit = -30")
    zero = ("quatf physics:localRot0 = (0, 0, 0, 0)",)
    triangle = ("float physics:mass = 1", "float3 physics:diagonalInertia = (0.001, 0.001, 0.01)")
    return (EIGHT + body("A", 0, triangle) + body("B", 1, ["float physics:mass = 100000"])
            + body("C", 2, ["float physics:mass = 1"])
            + body("D", 3, ["bool physics:kinematicEnabled = 1", "float physics:mass = 1"])
            + body("E", 4, ["float physics:mass = 1"])
            + joint("J1", "A", "B", limits + gains(10, 1))
            + joint("J2", "B", "C", gains(10, 1), 4.5)
            + joint("J3", "C", "D", zero + gains(1e12, 1)) + joint("J4", "D", "E", gains(10, -1))
            + "}\n")


def run(*arguments, cwd=None):
    return subprocess.run([TENON, "check", *map(str, arguments)], capture_output=True, text=True,
                          check=False, cwd=cwd)


class Outputs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def copy(self, rule, name=None):
        path = self.folder / (name or f"{rule}.usda")
        path.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(SCENES / f"{rule}.usda", path)
        return path

    def json(self, *arguments, code=None):
        process = run(*arguments, "--json")
        answer = json.loads(process.stdout)
        self.assertEqual(answer["schema"], "tenon.check/1")
        self.assertEqual(answer["ok"], process.returncode == 0)
        if code is not None:
            self.assertEqual(process.returncode, code, process.stdout)
        return answer

    def rules(self, *arguments):
        return {d["rule"] for d in self.json(*arguments)["diagnostics"]
                if d["severity"] != "info" and not d["suppressed"]}

    def test_all_eight_planted_defects_are_found(self):
        found = self.rules(self.write("eight.usda", eight_defects()))
        self.assertLessEqual({"mass.inertia-triangle", "mass.density", "joint.limits-crossed",
                              "articulation.kinematic-link", "joint.rotation-zero",
                              "joint.frames-apart", "drive.absurd-gain", "drive.negative-gain"},
                             found)

    def test_json_has_the_contracts_keys(self):
        answer = self.json(SCENES / "mass.inertia-triangle.usda", code=0)
        self.assertEqual(set(answer["diagnostics"][0]),
                         {"severity", "rule", "message", "file", "line", "column",
                          "endLine", "endColumn", "prim",
                          "property", "fix", "related", "variants", "numbers", "engines",
                          "autofix", "suggestedFix", "suppressed", "code"})
        self.assertEqual(answer["diagnostics"][0]["numbers"], "S-45, M-19")
        self.assertEqual(answer["summary"], {"errors": 0, "warnings": 1, "infos": 0, "fixable": 0,
                                             "suggested": 0, "suppressed": 0})

    def test_text_is_one_line_per_finding_on_standard_output(self):
        process = run(SCENES / "mass.inertia-triangle.usda")
        self.assertRegex(process.stdout,
                         r"^\S.*usda:\d+:\d+: warning: .* \[mass\.inertia-triangle\]\n$")
        self.assertIn("1 warning", process.stderr)
        self.assertEqual(run(SCENES / "mass.inertia-triangle.usda", "-q").stdout, "")

    def test_infos_show_on_request(self):
        scene = SCENES / "joint.one-sided-limit.usda"
        self.assertEqual(run(scene).stdout, "")
        self.assertIn("[joint.one-sided-limit]", run(scene, "-v").stdout)

    def test_output_is_the_same_twice(self):
        self.assertEqual(run(HAND, "--json").stdout, run(HAND, "--json").stdout)

    def test_rules_can_be_chosen_and_passed_over(self):
        scene = self.write("eight.usda", eight_defects())
        self.assertEqual(self.rules(scene, "--only", "mass.density,drive"),
                         {"mass.density", "drive.absurd-gain", "drive.negative-gain",
                          "drive.locked-axis"})
        self.assertNotIn("mass.density", self.rules(scene, "--skip", "mass"))
        self.assertEqual(run(scene, "--only", "no.such-rule").returncode, 2)

    def test_usage_errors_are_2(self):
        for arguments in [(), ("--dry-run", HAND), (HAND, "--json", "--sarif", "-"),
                          (self.folder / "gone.usda",), ("--explain", "no.such-rule"),
                          (HAND, "--baseline", self.folder / "no")]:
            self.assertEqual(run(*arguments).returncode, 2, arguments)

    def test_a_file_that_cannot_be_read_is_a_finding_and_2(self):
        self.copy("mass.tiny")
        self.write("broken.usda", "#usda 1.0\ndef Cube \"A\" {\n")
        answer = self.json(self.folder, code=2)
        self.assertEqual([d["rule"] for d in answer["diagnostics"]], ["text.syntax", "mass.tiny"])

    def test_explain_prints_the_page(self):
        page = (ROOT / "docs/rules/mass.inertia-triangle.md").read_text()
        self.assertEqual(run("--explain", "mass.inertia-triangle").stdout, page)
        self.assertIn("# text", run("--explain", "text.syntax").stdout)

    def test_a_folder_is_checked_by_its_roots(self):
        copy = self.folder / "hand"
        shutil.copytree(HAND.parent, copy)
        self.copy("mass.tiny", "deep/er/tiny.usda")
        answer = self.json(self.folder)
        names = [pathlib.Path(asset["asset"]).name for asset in answer["assets"]]
        self.assertEqual(names, ["tiny.usda", "grasp.usda"])  # grasp.usda references the hand

    def test_layers_in_a_circle_are_checked_once(self):
        for a, b in (("a", "b"), ("b", "a")):
            self.write(f"{a}.usda", f"#usda 1.0\n(\n    subLayers = [@./{b}.usda@]\n)\n")
        assets = self.json(self.folder, code=1)["assets"]
        self.assertEqual([pathlib.Path(a["asset"]).name for a in assets], ["a.usda"])

    def test_a_baseline_keeps_known_findings_quiet(self):
        scene = self.write("eight.usda", eight_defects())
        known = self.folder / "known.json"
        self.assertEqual(run(scene, "--write-baseline", known).returncode, 1)
        process = run(scene, "--strict", "--baseline", known)
        self.assertEqual((process.returncode, process.stdout), (0, ""))
        scene.write_text("#usda 1.0\n# a line more\n" + eight_defects().split("\n", 1)[1])
        self.assertEqual(run(scene, "--strict", "--baseline", known).returncode, 0)
        scene.write_text(scene.read_text().replace("physics:mass = 1\n", "physics:mass = -1\n", 1))
        self.assertEqual(self.rules(scene, "--baseline", known), {"mass.negative"})
        whole = known.read_text()
        for text, said in ((whole[:60], "known.json:4:10: "), (whole + "x", "no JSON here"),
                           (whole.replace('"findings": [', '"findings": [7,'), 'no "rule"'),
                           (whole.replace("{", '{"schema": "", ', 1), '"schema" is there twice')):
            known.write_text(text)
            process = run(scene, "--baseline", known)
            self.assertEqual(process.returncode, 2, text)
            self.assertIn(said, process.stderr)

    def test_sarif_has_the_shape_of_2_1_0(self):
        scene = self.write("a b/eight.usda", eight_defects())
        process = run(scene, "--sarif", "-", cwd=self.folder)
        log = json.loads(process.stdout)
        self.assertEqual(log["version"], "2.1.0")
        (only,) = log["runs"]
        driver = only["tool"]["driver"]
        self.assertEqual(driver["name"], "tenon")
        ids = [rule["id"] for rule in driver["rules"]]
        self.assertEqual(ids, sorted(set(ids)))
        for rule in driver["rules"]:
            self.assertTrue(rule["shortDescription"]["text"].endswith("."), rule)
            self.assertTrue(rule["help"]["markdown"].startswith("# "), rule)
        self.assertGreaterEqual(len(only["results"]), 8)
        for result in only["results"]:
            self.assertEqual(ids[result["ruleIndex"]], result["ruleId"])
            self.assertIn(result["level"], ("note", "warning", "error"))
            place = result["locations"][0]["physicalLocation"]
            self.assertEqual(place["artifactLocation"]["uri"], "a%20b/eight.usda")
            self.assertGreater(place["region"]["startLine"], 0)
            self.assertTrue(result["message"]["text"])
            self.assertEqual(len(result["partialFingerprints"]["tenon/1"]), 64)

    def test_columns_in_sarif_are_characters(self):
        text = ('#usda 1.0\ndef Xform "\u00e4" { string s = "\u4e2d\U0001d11e"; '
                'rel r = [</gone>,\n\t/* \u00fc */ </lost>]\n}\n')
        scene = self.write("a.usda", text)
        log = json.loads(run(scene, "--only", "stage.target-missing", "--sarif", "-").stdout)
        (only,) = log["runs"]
        self.assertEqual(only["columnKind"], "unicodeCodePoints")
        lines, found = text.split("\n"), []
        for result in only["results"]:
            region = result["locations"][0]["physicalLocation"]["region"]
            self.assertEqual(region["startLine"], region["endLine"])
            line = lines[region["startLine"] - 1]
            found.append(line[region["startColumn"] - 1:region["endColumn"] - 1])
        self.assertEqual(found, ["</gone>", "</lost>"])

    def write_over(self, name, sublayer):
        return self.write(name, "#usda 1.0\n(\n    defaultPrim = \"World\"\n    "
                          "kilogramsPerUnit = 1\n    metersPerUnit = 1\n    subLayers = "
                          f"[@{sublayer}@]\n    upAxis = \"Z\"\n)\n")

    def test_fixes_land_in_the_layer_that_owns_the_opinion(self):
        weak = self.copy("material.restitution", "weak.usda")
        over = self.write_over("over.usda", "./weak.usda")
        before = over.read_text()
        answer = self.json(over, "--fix", code=0)
        self.assertEqual([pathlib.Path(f["file"]).name for f in answer["corrected"]], ["weak.usda"])
        self.assertEqual(over.read_text(), before)
        self.assertIn("physics:restitution = 1\n", weak.read_text())

    def test_layers_of_others_are_not_corrected(self):
        """A stranger's asset may name any layer; only what is to be checked is changed."""
        own = self.copy("material.restitution", "mine/own.usda")
        asset = self.write_over("stranger/a.usda", "../mine/own.usda")
        before = own.read_text()
        answer = self.json(asset, "--fix")
        self.assertEqual(answer["corrected"], [])
        self.assertIn("read.outside", {d["rule"] for d in answer["diagnostics"]})
        self.assertEqual(own.read_text(), before)
        for more in (["--allow-read", own.parent], [own.parent]):
            own.write_text(before)
            answer = self.json(asset, "--fix", *more)
            self.assertEqual([f["file"].split("/")[-1] for f in answer["corrected"]], ["own.usda"])

    def test_targets_below_what_is_switched_off_are_not_missing(self):
        scene = (SCENES / "stage.target-missing.clean.usda").read_text()
        scene = scene.replace("custom rel likes = </World>", "custom rel likes = </World/Off/Part>")
        scene = scene.rstrip().removesuffix("}") + """
    def Xform "Off" (
        active = false
    )
    {
        def Xform "Part"
        {
        }
    }
}
"""
        self.assertEqual(self.rules(self.write("off.usda", scene)), set())
        scene = scene.replace("active = false", "active = true").replace("Part>", "Other>")
        self.assertEqual(self.rules(self.write("on.usda", scene)), {"stage.target-missing"})

    def test_binary_layers_are_corrected_and_packages_are_not(self):
        scene = self.copy("material.restitution")
        for name, fixed in (("a.usdc", True), ("a.usdz", False)):
            out = self.folder / name
            subprocess.run([TENON, "cat", scene, "-o", out], check=True)
            self.json(out, "--fix")
            self.assertEqual("material.restitution" not in self.rules(out), fixed, name)

    def test_findings_of_variants_are_said_once(self):
        scene = (SCENES / "variant.physics-unselected.clean.usda").read_text()
        apis = '"PhysicsRigidBodyAPI", "PhysicsCollisionAPI"'
        scene = scene.replace(apis, apis + ', "PhysicsMassAPI"')
        scene = scene.replace("            )\n            {\n", "            )\n            {\n"
                              "                float physics:mass = -1\n")
        path = self.write("v.usda", scene)
        (found,) = self.json(path, code=1)["diagnostics"]
        self.assertEqual((found["rule"], found["variants"]), ("mass.negative", ["physics"]))
        self.assertEqual(self.rules(path, "--physics", "none"), set())


class CleanAssets(unittest.TestCase):
    def warnings(self, path):
        answer = json.loads(run(path, "--json").stdout)
        return {d["rule"] for d in answer["diagnostics"] if d["severity"] != "info"}

    def test_own_examples_give_no_warnings(self):
        for name in ("inspire_hand.usda", "grasp.usda"):
            self.assertEqual(self.warnings(HAND.parent / name), set(), name)

    def test_own_physics_scenes_give_none_but_their_subject(self):
        subjects = {"body.nested", "body.velocity-space", "mass.default", "body.no-collider",
                    "body.mirrored", "articulation.link-velocity",
                    "body.in-instance", "point-instancer.readings", "joint.velocities-apart"}
        for path in sorted((ROOT / "tests/physics/scenes").glob("*.usda")):
            self.assertLessEqual(self.warnings(path), subjects, path)

    def test_published_scenes_give_only_what_is_known(self):
        scenes = sorted((SHARED / "scenes").glob("*_fixed.usda"))
        if not scenes:
            self.skipTest(f"no scenes in {SHARED}")
        scenes += sorted((SHARED / "scenes").glob("*_feasible.usda"))
        for path in scenes:
            self.assertEqual(self.warnings(path), KNOWN.get(path.name, set()), path.name)

    def test_published_scenes_as_written_give_the_findings_on_them(self):
        folder = SHARED / "scenes"
        if not folder.is_dir():
            self.skipTest(f"no scenes in {SHARED}")
        for name, rules in AS_WRITTEN.items():
            answer = json.loads(run(folder / f"{name}.usda", "--json").stdout)
            self.assertLessEqual(rules, {d["rule"] for d in answer["diagnostics"]}, name)

    def test_the_converted_hand_gives_only_what_is_known(self):
        path = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"
        if not path.is_file():
            self.skipTest(f"no hand in {SHARED}")
        self.assertEqual(self.warnings(path), KNOWN[path.name])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
