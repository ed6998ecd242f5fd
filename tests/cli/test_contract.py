#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the program as scripts do and holds it to its contract: exit codes, streams, JSON.

    test_contract.py ROOT TENON
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"


def tenon(*arguments, cwd=None, env=None):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False, cwd=cwd, env={**os.environ, **(env or {})})


def tree_bytes(folder):
    return {p: p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


class Contract(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def json(self, *arguments, code=0):
        process = tenon(*arguments, "--json")
        self.assertEqual(process.returncode, code, process.stderr)
        answer = json.loads(process.stdout)
        self.assertEqual(answer["tool"], "tenon")
        self.assertEqual(answer["schema"], f"tenon.{arguments[0]}/1")
        self.assertEqual(answer["ok"], code == 0)
        self.assertIsInstance(answer["diagnostics"], list)
        return answer

    def test_every_verb_has_help_with_an_example(self):
        for verb in (verb["name"] for verb in self.json("help")["verbs"]):
            process = tenon(verb, "--help")
            self.assertEqual(process.returncode, 0, verb)
            self.assertIn(f"tenon {verb}", process.stdout)
            self.assertIn("Example", process.stdout, verb)

    def test_usage_errors_are_2(self):
        for arguments in [(), ("no-such-verb",), ("info",), ("info", HAND, "--no-such-option"),
                          ("cat", self.folder / "missing.usda"), ("sim", HAND, "--duration", "-1"),
                          ("info", HAND, "--physics", "no-such-variant")]:
            self.assertEqual(tenon(*arguments).returncode, 2, arguments)

    def test_version_and_quiet(self):
        self.assertRegex(tenon("--version").stdout, r"^tenon \d+\.\d+\.\d+\n$")

    def test_no_library_is_taken_from_the_current_folder(self):
        for name in ("libc.so.6", "libm.so.6", "liblz4.so.1"):
            self.write(name, "no library")
        process = tenon("--version", cwd=self.folder)
        self.assertEqual(process.returncode, 0, process.stderr)

    def test_an_engine_that_is_not_built_is_4_and_an_unknown_one_2(self):
        built = {engine["name"]: engine["available"] for engine in self.json("doctor")["engines"]}
        missing = [(name, 4) for name, available in built.items() if not available]
        for engine, code in [*missing, ("no-such-engine", 2)]:
            process = tenon("sim", HAND, "--engine", engine)
            self.assertEqual(process.returncode, code, process.stderr)
            self.assertIn(engine, process.stderr)

    def test_info_counts_what_the_variant_switches(self):
        counts = {}
        for variant in ("none", "physics", "physx", "mujoco"):
            answer = self.json("info", HAND, "--physics", variant)
            counts[variant] = answer["physics"]
            self.assertEqual(answer["missing"], [])
            self.assertEqual(answer["variants"][0]["selection"], variant)
        for variant in ("physics", "physx", "mujoco"):
            physics = counts[variant]
            self.assertEqual([physics[k] for k in ("bodies", "colliders", "mimics", "dofs")],
                             [13, 13, 6, 12], variant)
            self.assertEqual(physics["joints"], {"revolute": 12, "prismatic": 0, "spherical": 0,
                                                 "fixed": 1, "distance": 0, "d6": 0})
            self.assertAlmostEqual(physics["mass_kg"], 0.54, places=6)
        self.assertEqual(counts["none"]["bodies"], 0)
        self.assertEqual(sum(counts["none"]["joints"].values()), 0)
        self.assertEqual(counts["none"]["colliders"], 0)

    def test_output_is_the_same_twice(self):
        for verb in ("info", "physics", "tree", "dump", "dump-index"):
            self.assertEqual(tenon(verb, HAND, "--json").stdout, tenon(verb, HAND, "--json").stdout)

    def test_no_color_in_pipes_unless_asked(self):
        bad = self.write("bad.usda", "#usda 1.0\ndef Cube \"A\" {\n")
        self.assertNotIn("\033", tenon("cat", bad).stderr)
        self.assertIn("\033", tenon("cat", bad, "--color", "always").stderr)
        self.assertNotIn("\033", tenon("cat", bad, env={"NO_COLOR": "1"}).stderr)

    def test_a_parse_error_names_file_line_and_column(self):
        bad = self.write("bad.usda", "#usda 1.0\n\ndef Cube \"A\"\n{\n    double size = \"x\"\n}\n")
        process = tenon("cat", bad)
        self.assertEqual(process.returncode, 2)
        self.assertRegex(process.stderr, r"bad\.usda:5:\d+: error: .* \[[a-z.-]+\]")
        finding = self.json("cat", bad, "-o", self.folder / "x.usda", code=2)["diagnostics"][0]
        self.assertEqual((finding["severity"], finding["line"]), ("error", 5))
        self.assertEqual(set(finding), {"severity", "rule", "message", "file", "line", "column",
                                        "endLine", "endColumn", "prim", "property", "fix",
                                        "related"})
        self.assertFalse((self.folder / "x.usda").exists())

    def test_a_missing_reference_is_a_finding_and_the_rest_opens(self):
        scene = self.write("scene.usda", '#usda 1.0\ndef Xform "A" (\n    references = '
                           '@./gone.usda@</X>\n)\n{\n}\ndef Cube "B"\n{\n}\n')
        answer = self.json("info", scene, code=1)
        self.assertEqual(answer["missing"], [{"layer": "scene.usda", "prim": "/A",
                                              "arc": "reference", "path": "./gone.usda"}])
        self.assertEqual(answer["stage"]["primCount"], 2)
        self.assertTrue(any("gone.usda" in d["message"] for d in answer["diagnostics"]))

    def test_cat_goes_from_text_to_crate_to_package_and_back(self):
        text = tenon("cat", HAND).stdout
        for name in ("a.usdc", "a.usdz", "a.usda"):
            out = self.folder / name
            self.assertEqual(tenon("cat", HAND, "-o", out).returncode, 0)
            self.assertEqual(tenon("cat", out).stdout, text, name)
        self.assertEqual((self.folder / "a.usdc").read_bytes()[:8], b"PXR-USDC")

    def test_a_selection_is_edited_in_place_and_all_else_stays(self):
        copy = self.folder / "hand"
        shutil.copytree(HAND.parent, copy)
        asset = copy / HAND.name
        before = asset.read_text()
        asset.write_text(before.replace("#usda 1.0", "#usda 1.0\n# a comment of mine", 1))
        before = asset.read_text()
        self.json("variant", asset, "Physics=mujoco", "--in-place")
        after = asset.read_text()
        self.assertIn("# a comment of mine", after)
        changed = [(a, b) for a, b in zip(before.splitlines(), after.splitlines()) if a != b]
        self.assertEqual(len(changed), 1, changed)
        self.assertIn("mujoco", changed[0][1])
        self.assertEqual(self.json("variant", asset)["variants"][0]["selection"], "mujoco")

    def test_a_selection_can_be_laid_over_from_another_folder(self):
        out = self.folder / "chosen.usda"
        self.json("variant", HAND, "Physics=none", "-o", out)
        self.assertEqual(self.json("info", out)["physics"]["bodies"], 0)
        process = tenon("variant", HAND, "Physics=nope", "-o", out)
        self.assertEqual(process.returncode, 2)
        self.assertIn("choose one of", process.stderr)

    def test_tree_with_physics_is_the_kinematic_tree(self):
        for arguments in (("tree", HAND, "--show", "physics"), ("tree", HAND, "--physics"),
                          ("tree", "--physics", HAND)):
            process = tenon(*arguments)
            self.assertEqual(process.returncode, 0, process.stderr)
            self.assertTrue(process.stdout.startswith("world\n"), process.stdout)
            self.assertEqual(process.stdout.count("revolute, 1 dof"), 12)
        links = self.json("tree", HAND, "--physics", "physics", "--show",
                          "physics")["kinematicTree"]["links"]
        self.assertEqual(len(links), 13)

    def test_overrides_hold_for_the_run_only(self):
        before = tree_bytes(HAND.parent)
        joint = "/inspire_hand/Physics/right_index_1_joint"
        override = f"{joint}.drive:angular:physics:targetPosition=30"
        answer = self.json("sim", HAND, "--duration", 1, "--set", override)
        plain = self.json("sim", HAND, "--duration", 1)
        self.assertGreater(answer["joints"][joint]["position"][0],
                           plain["joints"][joint]["position"][0] + 10)
        self.assertEqual(before, tree_bytes(HAND.parent))
        process = tenon("sim", HAND, "--set", f"{joint}.drive:angular:physics:targetPosition=fast")
        self.assertEqual(process.returncode, 2)

    def test_sim_answers_what_the_contract_names(self):
        answer = self.json("sim", HAND, "--duration", 0.1, "--dt", 0.001)
        self.assertEqual((answer["engine"], answer["dt"], answer["steps"]), ("mujoco", 0.001, 100))
        for key in ("engineVersion", "time", "unstable", "bodies", "joints",
                    "energy", "contacts", "events", "notMapped"):
            self.assertIn(key, answer)
        self.assertNotIn("realTimeFactor", answer)  # same input, same bytes
        self.assertGreater(self.json("sim", HAND, "--duration", 0.1, "--timing")["realTimeFactor"],
                           0)
        body = answer["bodies"]["/inspire_hand/r_base_link"]
        self.assertEqual({k: len(v) for k, v in body.items()},
                         {"position": 3, "orientation": 4, "linearVelocity": 3,
                          "angularVelocity": 3})

    def test_logs_by_suffix(self):
        for name in ("run.csv", "run.jsonl", "run.npz"):
            out = self.folder / name
            self.json("sim", HAND, "--duration", 0.1, "-o", out)
            self.assertGreater(out.stat().st_size, 1000)
        rows = (self.folder / "run.csv").read_text().splitlines()
        self.assertEqual(len(rows), 1 + 7)
        self.assertEqual(len({row.count(",") for row in rows}), 1)
        lines = (self.folder / "run.jsonl").read_text().splitlines()
        self.assertEqual(json.loads(lines[-1])["time"], 0.1)
        try:
            import numpy
        except ImportError:
            return
        archive = numpy.load(self.folder / "run.npz")
        self.assertEqual(archive["position"].shape, (7, 13, 3))
        self.assertEqual(archive["joint_position"].shape, (7, 12))
        process = tenon("sim", HAND, "--duration", 0.1, "-o", self.folder / "run.xls")
        self.assertEqual(process.returncode, 2)

    def test_physics_lists_are_sorted_and_complete(self):
        answer = self.json("physics", HAND, "--physics", "physx")
        for name in ("bodies", "colliders", "joints", "materials", "articulations"):
            paths = [item["path"] for item in answer[name]]
            self.assertEqual(paths, sorted(paths), name)
        follower = next(j for j in answer["joints"] if j["path"].endswith("right_thumb_4_joint"))
        self.assertAlmostEqual(follower["mimic"]["multiplier"], 0.7508, places=6)
        self.assertEqual(follower["mimics"], [follower["mimic"]])
        others = [j["mimics"] for j in answer["joints"] if j["mimic"] is None]
        self.assertEqual(others, [[]] * 7)

    def test_a_reading_can_be_chosen(self):
        answer = self.json("physics", HAND, "--reading", "mass-inheritance=own",
                           "--reading", "nesting=ignore")
        self.assertEqual(len(answer["bodies"]), 1 + 12)
        for wrong in ("nesting=upwards", "nestling=ignore", "nesting"):
            process = tenon("physics", HAND, "--reading", wrong)
            self.assertEqual(process.returncode, 2)
            self.assertIn("nest", process.stderr)

    def test_bake_leaves_the_asset_untouched(self):
        copy = self.folder / "hand"
        shutil.copytree(HAND.parent, copy)
        before = tree_bytes(copy)
        out = self.folder / "motion.usda"
        self.json("bake", copy / HAND.name, "-o", out, "--duration", 0.5)
        self.assertEqual(before, tree_bytes(copy))
        text = out.read_text()
        self.assertTrue(re.search(r"@\./hand/inspire_hand\.usda@", text), text[:400])
        self.assertEqual(self.json("info", out)["missing"], [])

    def test_sim_tells_of_joints_that_broke(self):
        scene = ROOT / "tests/physics/scenes/switches.usda"
        answer = self.json("sim", scene, "--duration", 0.2)
        events = {event["prim"]: event for event in answer["events"]}
        self.assertIn("/World/Thread", events)  # 98 N on 50 N
        self.assertNotIn("/World/Cable", events)  # 98 N on 150 N
        self.assertIn("broke", events["/World/Thread"]["what"])
        self.assertLessEqual(events["/World/Thread"]["time"], 0.2)
        self.assertIn("</World/Thread> broke", tenon("sim", scene, "--duration", 0.2).stdout)

    def test_doctor_lists_engines(self):
        process = tenon("doctor", "--json")
        engines = {e["name"]: e for e in json.loads(process.stdout)["engines"]}
        self.assertTrue(engines["mujoco"]["available"])

    def test_the_selected_variant_names_the_engine(self):
        has_physx = any(e["name"] == "physx" and e["available"]
                        for e in json.loads(tenon("doctor", "--json").stdout)["engines"])
        for variant, engine in (("physics", "mujoco"), ("mujoco", "mujoco"), ("physx", "physx")):
            answer = self.json("sim", HAND, "--physics", variant, "--duration", 0.01)
            rules = [finding["rule"] for finding in answer["diagnostics"]]
            expected = engine if has_physx else "mujoco"
            self.assertEqual(answer["engine"], expected, variant)
            self.assertEqual("sim.engine-fallback" in rules, expected != engine, variant)
            asked = self.json("sim", HAND, "--physics", variant, "--engine", "mujoco",
                              "--duration", 0.01)
            self.assertEqual(asked["engine"], "mujoco")


if __name__ == "__main__":
    if tenon("doctor").stdout.find("mujoco        not") >= 0:
        print("skipped: this build has no MuJoCo")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=1)
