#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon diff: layers, packages, scenes and physics; and as git's diff driver in a real repository.

    test_diff.py ROOT TENON
"""

import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), os.path.abspath(sys.argv[2])
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
PHYSICS = pathlib.Path("payloads/Physics/physics.usda")
JOINT = "/inspire_hand/Physics/right_thumb_1_joint"


def tenon(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


class Diff(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.copy = self.folder / "hand"
        shutil.copytree(HAND.parent, self.copy)
        self.hand = self.copy / HAND.name

    def diff(self, *arguments, code):
        process = tenon("diff", *arguments, "--json")
        self.assertEqual(process.returncode, code, process.stdout + process.stderr)
        answer = json.loads(process.stdout)
        self.assertEqual(answer["equal"], code == 0)
        return answer["differences"]

    def replace(self, old, new, file=PHYSICS, count=1):
        path = self.copy / file
        text = path.read_text()
        self.assertIn(old, text)
        path.write_text(text.replace(old, new, count))

    def test_an_asset_is_equal_to_itself_in_every_form(self):
        self.diff(HAND, self.hand, code=0)
        self.diff(HAND, self.hand, "--composed", code=0)
        self.diff(HAND, self.hand, "--physics", code=0)
        self.diff(HAND.parent, self.copy, code=0)
        crate = self.folder / "physics.usdc"
        tenon("cat", HAND.parent / PHYSICS, "-o", crate)
        self.diff(HAND.parent / PHYSICS, crate, code=0)

    def test_a_value_and_a_schema_are_named_with_their_lines(self):
        self.replace("physics:stiffness = 0.05", "physics:stiffness = 0.07")
        self.replace('"NewtonJointAPI", "PhysicsJointStateAPI:angular", "PhysicsDriveAPI:angular"',
                     '"NewtonJointAPI", "PhysicsDriveAPI:angular"')
        rows = self.diff(HAND.parent / PHYSICS, self.copy / PHYSICS, code=1)
        self.assertEqual([(row["path"], row["field"]) for row in rows],
                         [(JOINT, "apiSchemas"),
                          (f"{JOINT}.drive:angular:physics:stiffness", "default")])
        self.assertEqual((rows[1]["before"], rows[1]["after"]), ("0.05", "0.07"))
        lines = (self.copy / PHYSICS).read_text().splitlines()
        self.assertIn("stiffness = 0.07", lines[rows[1]["afterLine"] - 1])
        text = tenon("diff", HAND.parent / PHYSICS, self.copy / PHYSICS).stdout
        self.assertIn("apiSchemas: prepend - PhysicsJointStateAPI:angular", text)
        self.assertIn("value: 0.05 -> 0.07", text)

    def test_physics_is_told_in_words_and_units(self):
        self.replace("physics:stiffness = 0.05", "physics:stiffness = 0.07")
        self.replace("physics:mass = 0.398207", "physics:mass = 0.4")
        rows = self.diff(HAND, self.hand, "--physics", code=1)
        self.assertEqual([(row["object"], row["path"], row["what"], row["unit"]) for row in rows],
                         [("body", "/inspire_hand/r_base_link", "mass", "kg"),
                          ("joint", JOINT, "drive rotZ stiffness", "N m/rad")])
        self.assertAlmostEqual(rows[0]["after"], 0.4, places=6)
        # N m per degree in the file, per radian for engines
        self.assertAlmostEqual(rows[1]["after"], 0.07 * 57.29577951308232, places=6)
        self.assertIn("mass 0.398207 kg -> 0.4 kg", tenon("diff", HAND, self.hand,
                                                          "--physics").stdout)
        self.diff(HAND, self.hand, "--physics", "--tolerance", 2, code=0)

    def test_a_limit_is_shown_in_degrees_and_told_in_radians(self):
        path = self.copy / PHYSICS
        text = path.read_text()
        at = text.index('"right_thumb_1_joint"', text.index("def PhysicsRevoluteJoint"))
        begin = text.index("physics:upperLimit = ", at)
        end = text.index("\n", begin)
        path.write_text(text[:begin] + "physics:upperLimit = 60" + text[end:])
        rows = self.diff(HAND, self.hand, "--physics", code=1)
        self.assertEqual([row["what"] for row in rows], ["upper limit"])
        self.assertAlmostEqual(rows[0]["after"], 60 / 57.29577951308232, places=6)
        self.assertIn("-> 60 deg", tenon("diff", HAND, self.hand, "--physics").stdout)

    def test_another_variant_is_compared_when_asked_for(self):
        self.replace("physxMimicJoint:rotX:naturalFrequency = 100",
                     "physxMimicJoint:rotX:naturalFrequency = 50",
                     "payloads/Physics/physx.usda")
        self.diff(HAND, self.hand, "--physics", code=0)
        rows = self.diff(HAND, self.hand, "--physics", "--variant", "physx", code=1)
        self.assertEqual({row["what"] for row in rows}, {"mimic rotZ natural frequency"})

    def test_packages_and_folders_are_compared_file_by_file(self):
        package = self.folder / "hand.usdz"
        self.assertEqual(tenon("zip", HAND, "-o", package).returncode, 0)
        shutil.rmtree(self.copy / "generator")
        for name in ("README.md", "generate.py", "grasp.usda"):
            (self.copy / name).unlink()
        self.diff(package, self.copy, code=0)
        self.replace("physics:stiffness = 0.05", "physics:stiffness = 0.07")
        (self.copy / "notes.txt").write_text("new\n")
        rows = self.diff(package, self.copy, code=1)
        self.assertEqual([(row["file"], row["change"]) for row in rows],
                         [("notes.txt", "added"), (str(PHYSICS), "changed")])

    def test_what_may_not_be_read_is_not_called_equal(self):
        secret = self.folder / "secret.usda"
        secret.write_text("#usda 1.0\n")
        (self.copy / "link.usda").symlink_to(secret)
        other = self.folder / "other"
        shutil.copytree(self.copy, other, symlinks=True)
        self.assertEqual(self.diff(self.copy, other, "--sandbox", self.copy, "--sandbox", other,
                                   code=1), [])

    def test_a_side_that_is_not_there_is_empty(self):
        rows = self.diff("/dev/null", HAND, code=1)
        self.assertEqual([row["change"] for row in rows if row["field"] is None], ["added"])
        self.diff("/dev/null", "/dev/null", code=0)
        rows = self.diff(HAND, "/dev/null", "--physics", code=1)
        self.assertEqual({row["change"] for row in rows if row["object"] == "joint"}, {"removed"})
        self.assertEqual(tenon("diff", HAND, self.folder / "gone.usda").returncode, 2)
        self.assertEqual(tenon("diff", HAND).returncode, 2)

    def git(self, *arguments):
        environment = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1",
                       "GIT_AUTHOR_NAME": "t", "GIT_AUTHOR_EMAIL": "t@example.org",
                       "GIT_COMMITTER_NAME": "t", "GIT_COMMITTER_EMAIL": "t@example.org"}
        process = subprocess.run(["git", *arguments], cwd=self.copy, env=environment,
                                 capture_output=True, text=True, check=False)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stdout

    def test_git_shows_differences_by_the_driver_and_by_text(self):
        if shutil.which("git") is None:
            self.skipTest("git is not installed")
        crate = self.copy / "part.usdc"
        tenon("cat", self.copy / PHYSICS, "-o", crate)
        (self.copy / ".gitattributes").write_text("*.usd* diff=usd\n")
        self.git("init", "-q")
        self.git("add", ".")
        self.git("commit", "-q", "-m", "one")
        self.replace("physics:stiffness = 0.05", "physics:stiffness = 0.07")
        tenon("cat", self.copy / PHYSICS, "-o", crate)
        (self.copy / "new.usda").write_text('#usda 1.0\ndef "New"\n{\n}\n')
        (self.copy / "payloads/robot.usda").unlink()
        self.git("add", "-A")
        self.assertIn("Binary files", self.git("diff", "--cached", "part.usdc"))
        self.git("config", "diff.usd.textconv", shlex.quote(str(TENON)) + " cat")
        text = self.git("diff", "--cached", "part.usdc")
        self.assertIn("+            float drive:angular:physics:stiffness = 0.07", text)
        self.git("config", "diff.usd.command", shlex.quote(str(TENON)) + " diff")
        text = self.git("diff", "--cached", "--ext-diff")
        self.assertIn(f"tenon diff {PHYSICS}", text)
        self.assertIn("tenon diff part.usdc", text)
        self.assertEqual(text.count("physics:stiffness  value: 0.05 -> 0.07"), 2)
        self.assertIn("+ /New  prim added", text)
        self.assertIn("- /inspire_hand  prim removed", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
