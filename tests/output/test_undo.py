#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon undo takes back what each verb that edits has written, or refuses.

    test_undo.py ROOT TENON
"""

import json
import os
import pathlib
import shutil
import stat
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from program import EDITS, make_inputs, run, snapshot  # noqa: E402

LIMITS = {"kUndoEdits": 100}
# What an edit is of: the file behind the verb, or the place that it writes to.
ASSET = {"cat": "scene.usda"}


class Undo(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tenon_undo_"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.work, self.state = self.folder / "work", self.folder / "state"
        self.work.mkdir()
        make_inputs(self.work)
        for path in self.work.rglob("*"):
            path.chmod(0o755 if path.is_dir() else 0o644)
        self.environment = {**os.environ, "XDG_STATE_HOME": str(self.state)}

    def go(self, *arguments, code=0):
        done = run(*arguments, cwd=self.work, env=self.environment)
        self.assertEqual(done.returncode, code, (arguments, done.stdout, done.stderr))
        return done

    def edit(self, arguments):
        before = snapshot(self.work)
        done = run(*arguments, cwd=self.work, env=self.environment)
        self.assertIn(done.returncode, (0, 1), done.stderr)  # check --fix may find more
        self.assertNotEqual(snapshot(self.work), before, arguments)
        return before

    def records(self):
        return sorted(self.state.rglob("*.undo"))

    def refused(self, rule, asset, code=2):
        before = snapshot(self.work)
        done = self.go("undo", asset, code=code)
        self.assertIn(f"[{rule}]", done.stderr)
        self.assertEqual(snapshot(self.work), before)
        return done.stderr

    def test_every_edit_of_every_verb_is_taken_back(self):
        seen = 0
        for verb, pairs in EDITS.items():
            for arguments, _ in pairs:
                with self.subTest(" ".join(arguments)):
                    before = self.edit(arguments)
                    asset = ASSET.get(verb, arguments[1])
                    edited = snapshot(self.work)
                    self.go("undo", asset, "--dry-run")
                    self.assertEqual(snapshot(self.work), edited)
                    self.assertIn(f"tenon {verb}", self.go("undo", asset).stderr)
                    self.assertEqual(snapshot(self.work), before)
                    self.refused("undo.none", asset)
                    seen += 1
        self.assertGreater(seen, 8)
        self.assertEqual(self.records(), [])

    def test_edits_are_taken_back_one_by_one(self):
        states = [self.edit(["set", "base.usda", f"/World/box.size={size}"]) for size in (1, 2, 3)]
        for state in reversed(states):
            self.go("undo", "base.usda")
            self.assertEqual(snapshot(self.work), state)
        self.refused("undo.none", "base.usda")

    def test_an_asset_is_found_by_its_files_and_by_other_names(self):
        before = self.edit(["set", "scene.usda", "/World/box.size=1",
                            "/World/box.physics:rigidBodyEnabled=0"])
        (self.work / "link.usda").symlink_to("base.usda")
        self.refused("undo.none", "fixable.usda")
        self.go("undo", "link.usda")
        (self.work / "link.usda").unlink()
        self.assertEqual(snapshot(self.work), before)

    def test_what_changed_since_stays(self):
        self.edit(["set", "scene.usda", "/World/box.size=1",
                   "/World/box.physics:rigidBodyEnabled=0"])
        base = self.work / "base.usda"
        base.write_text(base.read_text(encoding="utf-8") + "# mine\n", encoding="utf-8")
        self.assertIn("base.usda", self.refused("undo.changed", "scene.usda"))
        base.unlink()
        self.assertIn("base.usda", self.refused("undo.changed", "scene.usda"))

    def test_a_dry_run_shows_the_difference(self):
        self.edit(["set", "base.usda", "/World/box.size=7"])
        self.assertIn("-        double size = 7", self.go("undo", "base.usda", "--dry-run").stdout)
        answer = json.loads(self.go("undo", "base.usda", "--dry-run", "--json").stdout)
        self.assertEqual((answer["verb"], answer["dryRun"]), ("set", True))
        self.assertEqual([file["file"] for file in answer["files"]], ["base.usda"])
        self.go("undo", "base.usda")

    def test_files_that_an_edit_made_go_and_those_it_removed_come_back(self):
        asset = "hand/inspire_hand.usda"
        before = self.edit(["add", asset, "/inspire_hand=engine", "--engine", "newton"])
        made = snapshot(self.work)
        self.assertGreater(len(made), len(before))
        self.edit(["remove", asset, "/inspire_hand=engine", "--engine", "newton"])
        self.go("undo", asset)
        self.assertEqual(snapshot(self.work), made)
        self.go("undo", asset)
        self.assertEqual(snapshot(self.work), before)

    def test_an_edit_that_cannot_be_kept_is_made_and_undo_says_so(self):
        self.state.write_text("no folder", encoding="utf-8")
        self.edit(["set", "base.usda", "/World/box.size=7"])
        self.assertIn(str(self.state.name), self.refused("undo.none", "base.usda"))
        self.assertEqual(self.state.read_text(encoding="utf-8"), "no folder")
        self.environment = {name: value for name, value in os.environ.items()
                            if name not in ("HOME", "XDG_STATE_HOME")}
        self.edit(["set", "base.usda", "/World/box.size=8"])
        self.refused("undo.no-folder", "base.usda", code=4)

    def test_a_folder_that_others_may_write_is_not_used(self):
        place = self.state / "tenon/undo"
        place.mkdir(parents=True)
        place.chmod(0o777)
        self.edit(["set", "base.usda", "/World/box.size=7"])
        self.assertEqual(self.records(), [])
        place.chmod(0o700)
        self.edit(["set", "base.usda", "/World/box.size=8"])
        place.chmod(0o777)
        self.refused("undo.none", "base.usda")

    def test_a_damaged_record_is_passed_over(self):
        for cut in (0, 10, 40, 200, None):
            with self.subTest(cut=cut):
                self.edit(["set", "base.usda", f"/World/box.size={cut or 5}.5"])
                record = self.records()[-1]
                whole = record.read_bytes()
                record.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]) if cut is None
                                   else whole[:cut])
                done = run("undo", "base.usda", cwd=self.work, env=self.environment)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertRegex(done.stderr, r"\[undo\.(none|changed)\]")
                record.unlink()
        os.mkfifo(record)  # which nobody writes to
        done = run("undo", "base.usda", cwd=self.work, env=self.environment)
        self.assertEqual(done.returncode, 2, done.stderr)
        record.unlink()

    def test_what_is_kept_is_the_users_alone_and_bounded(self):
        self.edit(["set", "base.usda", "/World/box.size=1"])
        record, = self.records()
        self.assertEqual(stat.S_IMODE(record.stat().st_mode), 0o600)
        self.assertEqual(stat.S_IMODE(record.parent.stat().st_mode), 0o700)
        whole = record.read_bytes()
        for number in range(2, LIMITS["kUndoEdits"] + 20):
            (record.parent / f"{number:012}.undo").write_bytes(whole)
        self.edit(["set", "base.usda", "/World/box.size=2"])
        names = [path.name for path in self.records()]
        self.assertEqual(len(names), LIMITS["kUndoEdits"])
        self.assertNotIn(record.name, names)
        self.go("undo", "base.usda")

    def test_outputs_elsewhere_are_no_edits(self):
        self.go("strip", "base.usda", "-o", "bare.usda")
        self.go("new", "new.usda")
        self.assertEqual(self.records(), [])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
