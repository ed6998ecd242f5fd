#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon check` where others run it: logs of SARIF, the step of action.yml, the hook of pre-commit.

    test_integration.py ROOT TENON
"""

import copy
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import sarif_rules

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), pathlib.Path(sys.argv[2]).absolute()
SCENES = ROOT / "tests/check/scenes"
HAND = ROOT / "examples/inspire_hand"
ODD = '#usda 1.0\ndef Xform "A" (prepend apiSchemas = ["PhysicsMassAPI"])\n{\n' \
      "    float physics:mass = -1\n    rel r = </gone>\n}\n"


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tenon integration ä "))
        self.addCleanup(shutil.rmtree, self.folder)

    def put(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def run_words(self, *words, **variables):
        environment = {**os.environ, "PATH": f"{TENON.parent}:{os.environ['PATH']}", **variables}
        return subprocess.run([str(word) for word in words], cwd=self.folder, env=environment,
                              capture_output=True, text=True, check=False)


def leave_root():
    if os.getuid() == 0:
        os.setgroups([])
        os.setgid(65534)
        os.setuid(65534)


class Folders(Folder):
    def test_a_folder_that_cannot_be_entered_is_told(self):
        """A gate that skips what it cannot read is green for no reason."""
        self.put("good.usda", '#usda 1.0\ndef Xform "A" {}\n')
        self.put("inside/bad.usda", ODD)
        for part in (self.folder, self.folder / "good.usda"):
            part.chmod(0o755)
        (self.folder / "inside").chmod(0)
        self.addCleanup((self.folder / "inside").chmod, 0o755)
        try:
            done = subprocess.run([TENON, "check", self.folder], capture_output=True, text=True,
                                  check=False, cwd="/", preexec_fn=leave_root)
        except PermissionError:
            self.skipTest("nobody may not run this build")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("inside", done.stderr)
        self.assertIn("cannot be read", done.stderr)


    def test_what_is_no_file_is_told(self):
        self.put("good.usda", '#usda 1.0\ndef Xform "A" {}\n')
        os.mkfifo(self.folder / "pipe.usda")
        (self.folder / "gone.usda").symlink_to("nowhere.usda")
        (self.folder / "ring.usda").symlink_to("ring.usda")
        (self.folder / "endless.usda").symlink_to("/dev/zero")
        (self.folder / "up").symlink_to(".")
        done = self.run_words(TENON, "check", ".")
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for name, why in (("pipe", "not a regular file"), ("endless", "No such device"),
                          ("gone", "what this symbolic link leads to: No such file"),
                          ("ring", "Too many levels of symbolic links")):
            self.assertRegex(done.stdout, f"{name}.usda: error: .*{why}")
        self.assertIn("4 errors", done.stderr)


class Sarif(Folder):
    def log_of(self, *arguments):
        done = self.run_words(TENON, "check", *arguments, "--sarif", "-")
        log = json.loads(done.stdout)
        self.assertEqual(sarif_rules.faults(log), [], arguments)
        return log

    def test_every_scene_of_every_rule_gives_a_log_by_the_specification(self):
        log = self.log_of(SCENES)
        rules = {result["ruleId"] for result in log["runs"][0]["results"]}
        self.assertGreater(len(rules), 80)

    def test_odd_names_and_files_that_cannot_be_read(self):
        self.put("a b/ü%#?[x].usda", ODD)
        self.put("broken.usda", '#usda 1.0\ndef Cube "A" {\n')
        log = self.log_of(".")
        uris = {result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
                for result in log["runs"][0]["results"]}
        self.assertEqual(uris, {"broken.usda", "a%20b/%C3%BC%25%23%3F%5Bx%5D.usda"})

    def test_suppressed_and_empty_logs(self):
        self.put("a.usda", ODD)
        self.run_words(TENON, "check", "a.usda", "--write-baseline", "known.json")
        log = self.log_of("a.usda", "--baseline", "known.json")
        self.assertTrue(all(r["suppressions"] for r in log["runs"][0]["results"]))
        self.put("empty.usda", "#usda 1.0\n")
        self.log_of("empty.usda", "--only", "mass.negative")

    def test_a_log_that_breaks_a_rule_is_seen(self):
        self.put("a.usda", ODD)
        good = self.log_of("a.usda")

        def broken(change):
            log = copy.deepcopy(good)
            change(log["runs"][0]["results"][0], log["runs"][0])
            return sarif_rules.faults(log)

        for change in (lambda result, run: result.pop("message"),
                       lambda result, run: result.update(ruleIndex=99),
                       lambda result, run: result.update(level="info"),
                       lambda result, run: result.update(severity="error"),
                       lambda result, run: run.pop("tool"),
                       lambda result, run: result["locations"][0]["physicalLocation"]
                       ["artifactLocation"].update(uri="a b"),
                       lambda result, run: result["locations"][0]["physicalLocation"]
                       ["region"].update(startLine=0)):
            self.assertTrue(broken(change))


class Action(Folder):
    def step(self, **inputs):
        output = self.folder / "github_output"
        output.unlink(missing_ok=True)
        done = self.run_words(ROOT / "tools/action_check.sh", GITHUB_OUTPUT=str(output), **inputs)
        self.assertEqual(done.returncode, 0, done.stderr)
        return dict(line.split("=", 1) for line in output.read_text().splitlines()), done

    def test_findings_go_to_the_next_steps(self):
        self.put("assets/a b.usda", ODD)
        told, _ = self.step(TENON_ASSETS="assets\n")
        self.assertEqual(told, {"code": "1", "sarif": "tenon.sarif"})
        log = json.loads((self.folder / "tenon.sarif").read_text())
        self.assertEqual(sarif_rules.faults(log), [])
        place = log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]
        self.assertEqual(place["artifactLocation"]["uri"], "assets/a%20b.usda")

    def test_known_findings_profile_and_strictness(self):
        shutil.copytree(HAND, self.folder / "hand")
        self.assertEqual(self.step(TENON_ASSETS="hand/inspire_hand.usda",
                                   TENON_PROFILE="isaac-3.0")[0]["code"], "0")
        self.put("a.usda", ODD)
        self.run_words(TENON, "check", "a.usda", "--write-baseline", "known.json")
        told, _ = self.step(TENON_ASSETS="a.usda", TENON_BASELINE="known.json",
                            TENON_STRICT="true", TENON_SARIF="out.sarif")
        self.assertEqual(told, {"code": "0", "sarif": "out.sarif"})

    def test_without_tenon_and_without_a_wheel_it_says_what_to_give(self):
        (self.folder / "bin").mkdir()
        (self.folder / "bin/bash").symlink_to(shutil.which("bash"))
        done = self.run_words(ROOT / "tools/action_check.sh", PATH=str(self.folder / "bin"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("input package", done.stderr)

    def test_a_wheel_without_a_version_is_not_installed(self):
        (self.folder / "bin").mkdir()
        (self.folder / "bin/bash").symlink_to(shutil.which("bash"))
        done = self.run_words(ROOT / "tools/action_check.sh", PATH=str(self.folder / "bin"),
                              TENON_PACKAGE="tenon-usd")
        self.assertEqual(done.returncode, 2)
        self.assertIn("tenon-usd==VERSION", done.stderr)

    def test_what_the_action_uses_is_pinned_by_its_commit(self):
        used = re.findall(r"uses: (\S+)", (ROOT / "action.yml").read_text())
        self.assertTrue(used)
        for name in used:
            self.assertRegex(name, r"@[0-9a-f]{40}$")

    def test_an_input_is_never_a_command_or_an_option(self):
        told, _ = self.step(TENON_ASSETS="$(touch planted)\n--fix\n; touch planted")
        self.assertEqual(told["code"], "2")
        self.assertFalse((self.folder / "planted").exists())

    def test_a_log_of_before_is_not_handed_on(self):
        self.put("tenon.sarif", "{}")
        told, _ = self.step(TENON_ASSETS="gone.usda")
        self.assertEqual(told["code"], "2")
        self.assertNotEqual((self.folder / "tenon.sarif").exists() and
                            (self.folder / "tenon.sarif").read_text(), "{}")

    def test_each_variable_of_the_script_is_an_input_of_the_action(self):
        script = (ROOT / "tools/action_check.sh").read_text()
        action = (ROOT / "action.yml").read_text()
        used = set(re.findall(r"\$\{(TENON_[A-Z]+)", script))
        given = dict(re.findall(r"(TENON_[A-Z]+): \$\{\{ inputs\.(\w+) \}\}", action))
        self.assertEqual(set(given), used)
        inputs = action.split("inputs:\n")[1].split("outputs:\n")[0]
        named = set(re.findall(r"^  (\w+):$", inputs, re.M))
        self.assertEqual(named, set(given.values()) | {"upload"})


class Hook(Folder):
    def test_the_hook_finds_the_fault_behind_a_changed_layer(self):
        text = (ROOT / ".pre-commit-hooks.yaml").read_text()
        entry = re.search(r"^  entry: (.*)$", text, re.M)[1]
        arguments = json.loads(re.search(r"^  args: (.*)$", text, re.M)[1])
        files = re.search(r"^  files: (.*)$", text, re.M)[1]
        self.assertTrue(re.search(files, "hand/payloads/geometry.usdc"))
        self.assertFalse(re.search(files, "hand/notes.md"))
        shutil.copytree(HAND, self.folder / "hand")
        words = [*entry.split(), *arguments]
        before = self.run_words(*words)
        layer = self.folder / "hand/payloads/Physics/physics.usda"
        layer.write_text(re.sub(r"physics:mass = [0-9.e-]+", "physics:mass = -1",
                                layer.read_text(), count=1))
        after = self.run_words(*words)
        self.assertIn("mass.negative", after.stdout + after.stderr)
        self.assertNotIn("mass.negative", before.stdout + before.stderr)
        self.assertEqual(after.returncode, 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
