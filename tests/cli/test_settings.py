#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon.toml: which file counts, every key and what replaces it, what is refused, skipped rules.

    test_settings.py ROOT TENON
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
PAGE = ROOT / "docs/settings.md"
# A body with a negative mass, an error, and without a collider, a warning.
SCENE = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    kilogramsPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def PhysicsScene "Scene"
    {
        vector3f physics:gravityDirection = (0, 0, -1)
        float physics:gravityMagnitude = 9.81
    }
    def Xform "Body" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = -1
    }
}
"""
BALL = SCENE.replace("-1\n    }\n}", "1\n    }\n}")
URDF = """<robot name="arm"><link name="base"/><link name="tip"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="j" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>
"""
# What each verb of the key `engine` is given beside the asset; OUT is a folder of its own.
RUNS = {
    "sim": ["--duration", "0.01"],
    "bake": ["--duration", "0.01", "-o", "OUT/motion.usda"],
    "bench": ["--duration", "0.01"],
    "record": ["-o", "OUT/picture.png", "--time", "0.01"],
    "report": ["--duration", "0.01", "-o", "OUT/page.html"],
    "view": ["--for", "0"],
}


def tenon(*arguments, cwd=None):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False, cwd=cwd, stdin=subprocess.DEVNULL)


def keys():
    """-> the rows of the program's own table."""
    return json.loads(tenon("help", "settings", "--json").stdout)["keys"]


def engines():
    """-> {name: whether it is built}"""
    told = json.loads(tenon("doctor", "--json").stdout)["engines"]
    return {engine["name"]: engine["available"] for engine in told}


class Case(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve() / "repository"
        (self.root / ".git").mkdir(parents=True)
        self.scene = self.write("scene.usda", SCENE)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def settings(self, text, name="tenon.toml"):
        return self.write(name, text)

    def json(self, *arguments, code=None):
        run = tenon(*arguments, "--json", cwd=self.root)
        if code is not None:
            self.assertEqual(run.returncode, code, run.stdout + run.stderr)
        return json.loads(run.stdout)

    def rules(self, *arguments, code=None):
        return sorted({row["rule"] for row in self.json("check", *arguments,
                                                        code=code)["diagnostics"]})


class Table(Case):
    def test_the_page_has_every_key_with_its_choices_and_option(self):
        rows = re.findall(r"^\| `([a-z.]+)` \| (.+) \| (.+) \|$", PAGE.read_text(), re.MULTILINE)
        self.assertEqual([row[0] for row in rows], [key["key"] for key in keys()])
        for (_, about, instead), key in zip(rows, keys()):
            for choice in key["choices"] or []:
                self.assertIn(f"`{choice}`", about)
            for option in re.findall(r"--[a-z-]+", key["instead"]):
                self.assertIn(f"`{option}`", instead)

    def test_help_and_manual_have_every_key(self):
        shown, manual = tenon("help", "settings").stdout, tenon("manual").stdout
        for key in keys():
            self.assertIn(f"\n  {key['key']}\n", shown)
            self.assertIn(key["example"].split("\n")[-1], shown)
            self.assertIn(f"\n.B {key['key']}\n", manual)
        self.assertIn("--no-settings", tenon("completion", "bash").stdout)

    def test_every_option_that_replaces_a_key_exists(self):
        known = json.dumps(json.loads(tenon("help", "--json").stdout))
        for key in keys():
            for option in re.findall(r"--[a-z-]+", key["instead"]):
                self.assertIn(f'"{option}"', known)

    def test_every_example_and_every_choice_is_read(self):
        for key in keys():
            texts = [key["example"]]
            table, _, name = key["key"].rpartition(".")
            texts += [(f"[{table}]\n" if table else "") + f'{name} = "{choice}"'
                      for choice in key["choices"] or []]
            for text in texts:
                self.settings(text)
                told = self.json("check", self.scene)
                self.assertEqual(told["assets"][0]["settings"], "tenon.toml", text)

    def test_the_page_example_is_read(self):
        self.settings(re.search(r"```toml\n(.*?)```", PAGE.read_text(), re.DOTALL)[1])
        self.assertEqual(self.json("check", self.scene)["assets"][0]["settings"], "tenon.toml")


class Wrong(Case):
    def refused(self, text, rule, line, *parts):
        self.settings(text)
        for verb in (["check"], ["sim", "--duration", "0.01"]):
            told = self.json(*verb, self.scene, code=2)
            faults = [row for row in told["diagnostics"] if row["rule"] == rule]
            self.assertEqual([(row["file"], row["line"]) for row in faults],
                             [("tenon.toml", line)], told)
            for part in parts:
                self.assertIn(part, faults[0]["message"] + faults[0]["fix"])
            run = tenon(*verb, self.scene, cwd=self.root)
            self.assertEqual(run.returncode, 2)
            self.assertIn(f"tenon.toml:{line}:", run.stderr)
            run = tenon(*verb, self.scene, "--no-settings", cwd=self.root)
            self.assertNotIn("tenon.toml", run.stderr)

    def test_bad_toml(self):
        self.refused("engine = \n", "settings.syntax", 1)
        self.refused("engine = mujoco\n", "settings.syntax", 1, "text in quotes, as in name =")
        self.refused("\n[check\n", "settings.syntax", 2)
        self.refused('engine = "mujoco"\nengine = "mujoco"\n', "settings.syntax", 2)

    def test_unknown_keys_get_the_nearest_name_or_all(self):
        for key in keys():
            table, _, name = key["key"].rpartition(".")
            head = f"[{table}]\n" if table else ""
            self.refused(f'{head}{name}s = "x"\n', "settings.unknown-key", 1 + bool(table),
                         key["key"])
        self.refused("search-paths = []\n", "settings.unknown-key", 1,
                     *(key["key"] for key in keys()))
        self.refused("[chek]\nprofile = 1\n", "settings.unknown-key", 2, '"chek')

    def test_wrong_types(self):
        for key in keys():
            table, _, name = key["key"].rpartition(".")
            head = f"[{table}]\n" if table else ""
            for value in ("3", "1.5", "true", "[]", "2026-01-01"):
                self.refused(f"{head}{name} = {value}\n", "settings.type", 1 + bool(table),
                             key["key"])
            if key["choices"]:
                self.refused(f'[{key["key"]}]\nx = "y"\n', "settings.type", 2, key["key"])
        self.refused("check = 1\n", "settings.type", 1, "check is a table")
        self.refused('[check.skip]\n"mass.zero" = 1\n', "settings.type", 2, "mass.zero")

    def test_unknown_values_get_the_nearest_name(self):
        for key in keys():
            table, _, name = key["key"].rpartition(".")
            head = f"[{table}]\n" if table else ""
            for choice in key["choices"] or []:
                self.refused(f'{head}{name} = "{choice}x"\n', "settings.value", 1 + bool(table),
                             f'did you mean "{choice}"?')

    def test_rules_that_are_skipped(self):
        head = "[check.skip]\n"
        self.refused(head + '"mass.negativ" = "x"\n', "settings.value", 2,
                     'did you mean "mass.negative"?')
        self.refused(head + '"mass" = "x"\n', "settings.value", 2, 'no rule "mass"')
        self.refused(head + '"qqq" = "x"\n', "settings.value", 2, "--list-rules")
        for reason in ("", " ", "\\n"):
            self.refused(head + f'"mass.zero" = "{reason}"\n', "settings.value", 2, "is empty")
        self.refused(head + '"mass.zero" = "x"\nmass.zero = "y"\n', "settings.value", 3, "twice")

    def test_all_faults_are_told_at_once(self):
        self.settings('engine = "x"\nnames = 1\n[check]\nother = 2\n')
        told = self.json("check", self.scene, code=2)["diagnostics"]
        self.assertEqual([row["line"] for row in told], [1, 2, 4])

    def test_what_is_no_file_or_too_large_is_refused(self):
        (self.root / "tenon.toml").mkdir()
        self.json("check", self.scene, code=2)
        (self.root / "tenon.toml").rmdir()
        os.mkfifo(self.root / "tenon.toml")
        self.json("check", self.scene, code=2)
        (self.root / "tenon.toml").unlink()
        (self.root / "tenon.toml").write_bytes(b'engine = "\xe9"\n')
        told = self.json("check", self.scene, code=2)["diagnostics"]
        self.assertEqual(told[0]["fix"], "save the file as UTF-8")
        self.settings("#" * 40_000)
        told = self.json("check", self.scene, code=2)["diagnostics"]
        self.assertEqual(told[0]["rule"], "file.too-large")

    def test_a_link_to_nothing_or_out_of_the_repository_is_refused(self):
        outside, link = self.root.parent / "other.toml", self.root / "a/tenon.toml"
        scene = self.write("a/scene.usda", SCENE)
        self.settings("")  # which does not count in its place
        outside.write_text('engine = "mujoco"\n')
        for target, rule, part in (("nowhere", "file.not-found", "this symbolic link leads to"),
                                   ("tenon.toml", "file.unreadable", "this symbolic link"),
                                   (outside, "settings.outside", "outside of")):
            link.symlink_to(target)
            for verb in (["check"], ["sim", "--duration", "0.01"]):
                told = self.json(*verb, scene, code=2)["diagnostics"][0]
                self.assertEqual((told["rule"], told["file"]), (rule, "a/tenon.toml"), told)
                self.assertIn(part, told["message"])
                self.assertNotIn("did you mean", told["fix"] or "")
                self.json(*verb, scene, "--no-settings")
            link.unlink()
        link.symlink_to("../tenon.toml")
        self.assertEqual(self.json("check", scene)["assets"][0]["settings"], "a/tenon.toml")

    def test_a_wrong_file_leaves_all_files_alone(self):
        self.settings("x = 1\n", "b/tenon.toml")
        for name in ("a/x.usda", "b/x.usda"):
            self.write(name, SCENE.replace("    kilogramsPerUnit = 1\n", ""))
        before = {path: path.read_bytes() for path in self.root.rglob("*.usda")}
        self.json("check", self.root, "--fix", code=2)
        self.assertEqual(before, {path: path.read_bytes() for path in before})


class Place(Case):
    def used(self, asset, *arguments):
        return self.json("check", asset, *arguments)["assets"][0]["settings"]

    def test_the_nearest_file_up_to_the_repository_counts(self):
        deep = self.write("a/b/c/scene.usda", SCENE)
        self.assertIsNone(self.used(deep))
        for name in ("tenon.toml", "a/b/tenon.toml", "a/b/c/tenon.toml"):
            self.settings("", name)
            self.assertEqual(self.used(deep), name)
        self.assertEqual(self.used(self.scene), "tenon.toml")
        self.assertIsNone(self.used(deep, "--no-settings"))

    def test_nothing_above_the_repository_counts(self):
        (self.root.parent / "tenon.toml").write_text("x = 1\n")
        self.assertIsNone(self.used(self.scene))
        (self.root / ".git").rmdir()
        (self.root / ".git").write_text("gitdir: elsewhere\n")  # of a work tree or a submodule
        self.assertIsNone(self.used(self.scene))

    def test_without_a_repository_only_the_own_folder_counts(self):
        (self.root / ".git").rmdir()
        deep = self.write("a/scene.usda", SCENE)
        self.settings("")
        self.assertIsNone(self.used(deep))
        self.assertEqual(self.used(self.scene), "tenon.toml")

    def test_relative_names_and_links_to_folders_lead_to_the_repository(self):
        self.write("a/scene.usda", SCENE)
        self.settings("")
        run = tenon("check", "scene.usda", "-v", cwd=self.root / "a")
        self.assertIn("settings: ../tenon.toml", run.stderr)
        link = self.root.parent / "link"
        link.symlink_to(self.root / "a")
        self.assertIsNotNone(self.used(link / "scene.usda"))

    def test_standard_input_has_none(self):
        self.settings("x = 1\n")
        run = subprocess.run([TENON, "sim", "-", "--duration", "0.01", "--json"], text=True,
                             input=BALL, capture_output=True, cwd=self.root, check=False)
        self.assertEqual(run.returncode, 0, run.stdout)

    def test_commands_without_settings_do_not_read_it(self):
        self.settings("x = 1\n")
        self.assertEqual(tenon("info", self.scene, cwd=self.root).returncode, 0)
        self.assertEqual(tenon("tree", self.scene, cwd=self.root).returncode, 0)


class Skipping(Case):
    def test_skipped_findings_are_counted_and_named(self):
        self.assertIn("mass.negative", self.rules(self.scene, code=1))
        self.settings('[check.skip]\n"mass.negative" = "set later"\n')
        told = self.json("check", self.scene, code=0)
        self.assertNotIn("mass.negative", [row["rule"] for row in told["diagnostics"]])
        self.assertEqual(told["skipped"], [{"rule": "mass.negative", "reason": "set later",
                                            "count": 1, "settings": "tenon.toml"}])
        self.assertEqual(told["summary"]["errors"], 0)
        run = tenon("check", self.scene, cwd=self.root)
        self.assertEqual(run.returncode, 0)
        self.assertIn("skipped by tenon.toml: mass.negative (set later) x 1\n", run.stderr)
        self.assertNotIn("settings:", run.stderr)
        self.assertIn("settings: tenon.toml\n", tenon("check", self.scene, "-v",
                                                      cwd=self.root).stderr)
        self.assertEqual(tenon("check", self.scene, "-q", cwd=self.root).stderr, "")

    def test_the_command_line_wins(self):
        self.settings('[check.skip]\n"mass.negative" = "set later"\n')
        for arguments in (["--no-settings"], ["--only", "mass.negative"], ["--only", "mass"]):
            told = self.json("check", self.scene, *arguments, code=1)
            self.assertEqual(told["skipped"], [])
            self.assertIn("mass.negative", [row["rule"] for row in told["diagnostics"]])
        self.assertEqual(self.json("check", self.scene, "--skip", "mass")["skipped"], [])

    def test_strict_baselines_and_sarif_are_about_the_rest(self):
        warnings = [row["rule"] for row in self.json("check", self.scene)["diagnostics"]
                    if row["severity"] == "warning"]
        text = "".join(f'"{rule}" = "no"\n' for rule in {*warnings, "mass.negative"})
        self.settings("[check.skip]\n" + text)
        self.json("check", self.scene, "--strict", "--sarif", "a.sarif", "--write-baseline",
                  "b.json", code=0)
        for name in ("a.sarif", "b.json"):
            self.assertNotIn("mass.negative\"", (self.root / name).read_text().replace(
                '"id": "mass.negative"', ""))

    def test_fix_leaves_skipped_findings_alone(self):
        self.scene.write_text(SCENE.replace("    kilogramsPerUnit = 1\n", ""))
        self.settings('[check.skip]\n"stage.kilograms-per-unit-missing" = "no"\n')
        self.json("check", self.scene, "--fix")
        self.assertNotIn("kilogramsPerUnit", self.scene.read_text())
        self.json("check", self.scene, "--fix", "--no-settings")
        self.assertIn("kilogramsPerUnit", self.scene.read_text())

    def test_an_asset_that_does_not_open_is_reported(self):
        self.scene.write_text("#usda 1.0\ndef {")
        found = self.rules(self.scene, code=2)
        known = set(row["rule"] for row in self.json("check", "--list-rules")["rules"])
        self.settings("[check.skip]\n" + "".join(f'"{rule}" = "no"\n' for rule in known))
        self.assertEqual(self.rules(self.scene, code=2), found)

    def test_a_folder_with_several_files(self):
        for name in ("a/x.usda", "b/x.usda", "b/c/x.usda"):
            self.write(name, SCENE)
        self.settings('[check.skip]\n"mass.negative" = "here"\n')
        self.settings('[check.skip]\n"mass.negative" = "there"\n', "b/tenon.toml")
        self.settings("", "b/c/tenon.toml")
        told = self.json("check", self.root, code=1)
        for row in told["diagnostics"] + told["assets"] + told["skipped"]:
            for field in {"file", "asset", "settings"} & {key for key in row if row[key]}:
                row[field] = os.path.relpath(row[field], self.root)
        self.assertEqual([row["file"] for row in told["diagnostics"]
                          if row["rule"] == "mass.negative"], ["b/c/x.usda"])
        self.assertEqual({row["asset"]: row["settings"] for row in told["assets"]},
                         {"a/x.usda": "tenon.toml", "b/x.usda": "b/tenon.toml",
                          "b/c/x.usda": "b/c/tenon.toml", "scene.usda": "tenon.toml"})
        self.assertEqual({row["settings"]: (row["reason"], row["count"])
                          for row in told["skipped"]},
                         {"tenon.toml": ("here", 2), "b/tenon.toml": ("there", 1)})

    def test_a_layer_of_two_assets_counts_once_for_each_file(self):
        self.write("base.usda", SCENE)
        for name in ("a.usda", "b.usda"):
            self.write(name, "#usda 1.0\n(\n    defaultPrim = \"World\"\n    subLayers = "
                             "[@./base.usda@]\n)\n")
        self.scene.unlink()
        self.settings('[check.skip]\n"mass.negative" = "x"\n')
        self.assertEqual([row["count"] for row in self.json("check", self.root)["skipped"]], [1])


class Defaults(Case):
    def setUp(self):
        super().setUp()
        self.scene.write_text(BALL)

    def test_the_profile(self):
        plain, structured = (self.rules(self.scene, *more)
                             for more in ([], ["--profile", "isaac-3.0"]))
        self.assertNotEqual(plain, structured)
        self.settings('[check]\nprofile = "isaac-3.0"\n')
        self.assertEqual(self.rules(self.scene), structured)
        self.assertEqual(self.rules(self.scene, "--no-settings"), plain)

    def test_the_engine_of_each_command(self):
        for engine, built in engines().items():
            self.settings(f'engine = "{engine}"\n')
            for verb, more in RUNS.items():
                told = []
                for way in ([], ["--engine", engine, "--no-settings"]):
                    folder = self.root / f"{verb}{len(told)}{engine}"
                    folder.mkdir(exist_ok=True)
                    told.append(self.json(verb, self.scene, *way, *(
                        part.replace("OUT", str(folder)) for part in more)))
                self.assertEqual(told[0].pop("settings"), "tenon.toml", verb)
                self.assertNotIn("settings", told[1])
                self.assertEqual(told[0]["ok"], told[1]["ok"], (verb, engine))
                self.assertEqual(told[0].get("engine"), told[1].get("engine"), verb)
                self.assertEqual([row["message"] for row in told[0]["diagnostics"]],
                                 [row["message"] for row in told[1]["diagnostics"]], verb)
            self.assertEqual(tenon("sim", self.scene, "--duration", "0.01").returncode,
                             0 if built else 4)

    def test_an_engine_on_the_command_line_wins(self):
        missing = [name for name, built in engines().items() if not built]
        if not missing:
            self.skipTest("every engine is built")
        self.settings(f'engine = "{missing[0]}"\n')
        self.json("sim", self.scene, "--duration", "0.01", code=4)
        told = self.json("sim", self.scene, "--duration", "0.01", "--engine", "mujoco", code=0)
        self.assertEqual(told["engine"], "mujoco")

    def test_compare_compares_the_others_with_it(self):
        for engine, built in engines().items():
            self.settings(f'engine = "{engine}"\n')
            told = self.json("compare", self.scene, "--duration", "0.01", "--no-reasons")
            self.assertEqual(told["settings"], "tenon.toml")
            if not built:
                self.assertIn(engine, told["diagnostics"][-1]["message"].lower())
            elif sum(engines().values()) > 1:
                self.assertEqual(told["engines"][0]["engine"], engine)

    def test_names(self):
        robot = self.write("arm.urdf", URDF)
        for names in ("current", "tutorial"):
            self.settings(f'names = "{names}"\n')
            for verb, asset, out in (("convert", robot, []), ("structure", self.scene, ["-o"])):
                made = []
                for way in ([], ["--names", names, "--no-settings"]):
                    folder = self.root / f"{verb}-{names}-{len(made)}"
                    self.json(verb, asset, *out, f"{folder}/", *way, code=0)
                    made.append(sorted(path.relative_to(folder) for path in folder.rglob("*.usd*")))
                self.assertEqual(*made)
        self.json("convert", robot, self.root / "arm.usda", code=0)  # one file has no such names
        self.json("convert", robot, f"{self.root}/other/", "--names", "current", code=0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
