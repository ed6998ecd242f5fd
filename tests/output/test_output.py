#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every verb of the program, wherever its output cannot go: exit 2 and a message, nothing lost.

    test_output.py ROOT TENON
"""

import ctypes
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

from program import (EDITS, PRINTING, ROOT, TENON, WRITING, make_inputs, run, snapshot, verbs)

MESH = """#usda 1.0
(
    defaultPrim = "r"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "r" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    float physics:mass = 1
    def Mesh "m" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    }
}
"""
LIBC = ctypes.CDLL(None, use_errno=True)
NOBODY = 65534


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.put_inputs()

    def put_inputs(self):
        make_inputs(self.folder)
        for name in ("link.usda", "same.usda"):
            (self.folder / name).unlink(missing_ok=True)
        (self.folder / "link.usda").symlink_to("base.usda")
        os.link(self.folder / "base.usda", self.folder / "same.usda")

    def go(self, arguments, **options):
        return run(*arguments, cwd=self.folder, **options)

    def same(self, before):
        """All files are as they were; puts them back if not."""
        after = snapshot(self.folder)
        differ = [name for name in sorted({*before, *after})
                  if after.get(name) != before.get(name)]
        for name in differ:
            (self.folder / name).unlink(missing_ok=True)
        if differ:
            self.put_inputs()
        self.assertEqual(differ, [])

    def fails(self, process, what):
        self.assertEqual(process.returncode, 2, f"{what}: {process.stderr}")
        said = process.stderr + (process.stdout or "")
        self.assertIn("error", said, what)


class EveryVerb(Folder):
    def test_is_known_here(self):
        """A new verb joins the loops below: with what it prints and what it writes."""
        self.assertEqual(set(verbs()), set(PRINTING))
        self.assertEqual(set(verbs()), set(WRITING))

    def test_says_that_standard_output_is_full_or_closed(self):
        texts = [*PRINTING.values(), ["--help"], ["--version"],
                 *([verb, "--help"] for verb in verbs()),
                 *([*arguments, "--json"] for arguments in PRINTING.values()
                   if "-" not in arguments and arguments[0] not in ("cat", "dump", "convert", "zip",
                                                                    "test-runner"))]
        for arguments in texts:
            with self.subTest(" ".join(arguments)):
                before = snapshot(self.folder)
                with open("/dev/full", "w", encoding="utf-8") as full:
                    process = self.go(arguments, capture_output=False, stdout=full,
                                      stderr=subprocess.PIPE)
                self.fails(process, "full")
                shell = ["sh", "-c", '"$0" "$@" >&-', TENON, *arguments]
                process = subprocess.run(shell, cwd=self.folder, stderr=subprocess.PIPE, text=True,
                                         check=False, timeout=120)
                self.fails(process, "closed")
                after = snapshot(self.folder)
                self.assertEqual({name: after.get(name) for name in before}, before)

    def test_ends_quietly_when_the_reader_is_gone(self):
        for arguments in PRINTING.values():
            with self.subTest(" ".join(arguments)):
                reader, writer = os.pipe()
                os.close(reader)
                process = self.go(arguments, capture_output=False, stdout=writer,
                                  stderr=subprocess.PIPE)
                os.close(writer)
                self.assertNotEqual(process.returncode, 0)
                self.assertGreater(process.returncode, 0, "no signal")
                self.assertNotIn("standard output", process.stderr)

    def outputs(self, place):
        """-> argument lists of all verbs, with an output in the folder `place`."""
        for verb in verbs():
            for arguments in WRITING[verb]:
                yield [argument.replace("OUT", f"{place}/out") if argument.startswith("OUT")
                       else argument for argument in arguments]

    def refused(self, place, **options):
        """Each output fails there, and all is as it was."""
        before = snapshot(self.folder)
        for arguments in self.outputs(place):
            with self.subTest(" ".join(arguments)):
                self.fails(self.go(arguments, **options), place)
                self.same(before)
                here = self.folder / place
                self.assertEqual(list(here.iterdir()) if here.exists() else [], [])

    def test_says_that_there_is_no_such_folder(self):
        self.refused("missing")

    def test_looks_at_the_place_of_an_output_before_it_reads(self):
        """Of an input that is not there and an output that cannot be, the output is named."""
        for arguments in (["convert", "gone.urdf", "missing/out/"],
                          ["convert", "gone.urdf", "missing/out.usda"],
                          ["structure", "gone.usda", "-o", "missing/out"],
                          ["bake", "gone.usda", "-o", "missing/out.usda"]):
            with self.subTest(" ".join(arguments)):
                process = self.go(arguments)
                self.fails(process, "missing")
                self.assertIn("missing/out", process.stderr)
                self.assertNotIn("gone", process.stderr)

    def test_says_that_the_folder_is_read_only(self):
        place = self.folder / "closed"
        place.mkdir()
        place.chmod(0o555)
        self.folder.chmod(0o755)
        os_user = {"user": NOBODY} if os.geteuid() == 0 else {}
        if os_user and run("--version", **os_user).returncode != 0:
            self.skipTest("the program cannot be run by another user")
        self.refused("closed", **os_user)

    def test_says_that_files_may_not_grow(self):
        place = self.folder / "small"
        place.mkdir()

        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20))
        self.refused("small", preexec_fn=limit)

    def test_says_that_the_disk_is_full(self):
        place = self.folder / "disk"
        place.mkdir()
        if LIBC.mount(b"tenon", str(place).encode(), b"tmpfs", 0, b"size=4k") != 0:
            self.skipTest("a file system cannot be mounted here")
        self.addCleanup(LIBC.umount2, str(place).encode(), 2)
        (place / "rest").write_bytes(b"x" * 4096)
        for arguments in self.outputs("disk"):
            with self.subTest(" ".join(arguments)):
                self.fails(self.go(arguments), "disk")
                self.assertEqual([path.name for path in place.iterdir()], ["rest"])

    def test_edits_that_cannot_be_written_leave_the_old(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (20, 20))
        for edits in EDITS.values():
            for arguments, _ in edits:
                with self.subTest(" ".join(arguments)):
                    before = snapshot(self.folder)
                    self.fails(self.go(arguments, preexec_fn=limit), "edit")
                    self.same(before)


class Inputs(Folder):
    """What a run has read is not written over, by any of its names."""

    def test_no_output_replaces_a_file_that_is_read(self):
        names = ["scene.usda", "base.usda", "over.usda", "link.usda", "same.usda",
                 "./hand/../base.usda", str(self.folder / "base.usda")]
        before = snapshot(self.folder)
        for verb in verbs():
            for arguments in WRITING[verb]:
                if "scene.usda" not in arguments:
                    continue
                for name in names:
                    given = [name if part.startswith("OUT") else part for part in arguments]
                    with self.subTest(" ".join(given)):
                        self.fails(self.go(given), name)
                        self.same(before)

    def test_names_that_fit_the_kind_are_no_way_round(self):
        """Other programs' formats as inputs: what is read is found out by what it is."""
        self.go(["check", "scene.usda", "--write-baseline", "known.json"])
        before = snapshot(self.folder)
        for arguments in (["check", "scene.usda", "--baseline", "known.json", "--sarif",
                           "known.json"],
                          ["check", "scene.usda", "--baseline", "known.json", "--write-baseline",
                           "./known.json"]):
            with self.subTest(" ".join(arguments)):
                self.fails(self.go(arguments), "baseline")
                self.same(before)

    def test_no_folder_replaces_what_is_read(self):
        before = snapshot(self.folder)
        hand = "hand/inspire_hand.usda"
        for arguments, place in ((["structure", hand, "-o", "hand"], "."),
                                 (["structure", hand, "-o", "hand/"], "."),
                                 (["structure", "base.usda", "-o", "."], "."),
                                 (["structure", "inspire_hand.usda", "-o", "."], "hand"),
                                 (["strip", hand, "-o", "hand"], ".")):
            with self.subTest(" ".join(arguments)):
                process = run(*arguments, cwd=self.folder / place)
                self.fails(process, "folder")
                self.same(before)

    def test_the_current_folder_stays_the_current_folder(self):
        here = self.folder / "here"
        here.mkdir()
        inode = here.stat().st_ino
        for _ in range(2):
            self.assertEqual(run("structure", "../base.usda", "-o", ".", cwd=here).returncode, 0)
            self.assertEqual(here.stat().st_ino, inode)
            self.assertTrue((here / "World.usda").exists())
        self.assertEqual(run("structure", "World.usda", "--in-place", cwd=here).returncode, 0)
        self.assertEqual(here.stat().st_ino, inode)

    def test_in_place_says_that_it_is_wanted(self):
        process = self.go(["cat", "scene.usda", "--flatten", "-o", "scene.usda", "--in-place"])
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertNotIn("subLayers", (self.folder / "scene.usda").read_text())

    def test_two_outputs_of_one_place_are_refused(self):
        before = snapshot(self.folder)
        for arguments in (["sim", "scene.usda", "-o", "-", "--bake", "-"],
                          ["check", "scene.usda", "--sarif", "a.json", "--write-baseline",
                           "./a.json"]):
            with self.subTest(" ".join(arguments)):
                self.fails(self.go(arguments), "twice")
                self.same(before)


class Kinds(Folder):
    """Names are looked at before the work."""

    def test_a_name_that_says_another_kind_is_refused(self):
        for arguments in (["cat", "scene.usda", "-o", "y.usda", "--format", "usdc"],
                          ["cat", "scene.usda", "-o", "y.usdc", "--format", "usda"],
                          ["cat", "scene.usda", "-o", "y.usd", "--format", "usdz"],
                          ["cat", "scene.usda", "-o", "y.usdz", "--format", "usda"],
                          ["cat", "scene.usda", "-o", "y.txt"],
                          ["sim", "scene.usda", "-o", "run.xls", "--duration", "1e9"],
                          ["sim", "scene.usda", "-o", "run.csv", "--format", "jsonl"],
                          ["sim", "scene.usda", "--bake", "run.usdz", "--duration", "1e9"],
                          ["bake", "scene.usda", "-o", "run.txt", "--duration", "1e9"],
                          ["dump", "scene.usda", "-o", "new.usda"],
                          ["check", "scene.usda", "--sarif", "new.usdc"],
                          ["check", "scene.usda", "--write-baseline", "new.usd"],
                          ["zip", "scene.usda", "-o", "new.zip"],
                          ["convert", "arm.urdf", "new.txt"],
                          ["strip", "scene.usda", "-o", "new.txt"],
                          ["variant", "base.usda", "Physics=none", "-o", "new.txt"]):
            with self.subTest(" ".join(arguments)):
                before = snapshot(self.folder)
                self.fails(self.go(arguments, timeout=20), "kind")
                self.same(before)

    def test_usd_may_be_text_or_binary(self):
        for name, start in (("usda", b"#usda"), ("usdc", b"PXR-USDC")):
            self.assertEqual(self.go(["cat", "scene.usda", "-o", "y.usd", "--format",
                                      name]).returncode, 0)
            self.assertTrue((self.folder / "y.usd").read_bytes().startswith(start))

    def test_a_log_goes_to_standard_output(self):
        run_it = ["sim", "scene.usda", "--duration", "0.1", "-o", "-"]
        self.assertTrue(self.go(run_it).stdout.startswith("time,"))
        rows = self.go([*run_it, "--format", "jsonl"]).stdout
        self.assertTrue(rows.startswith('{"time"'), rows[:80])
        self.fails(self.go([*run_it, "--json"]), "both")

    def test_no_duration_is_no_step(self):
        process = self.go(["sim", "scene.usda", "--duration", "0", "--json"])
        self.assertIn('"steps": 0,', process.stdout)


class Edited(Folder):
    """An asset that was edited since it was made is not made again over the edits."""

    def test_unedited_outputs_are_replaced_and_edited_ones_are_not(self):
        edits = {"made.usda": "made.usda", "made": "made/payloads/Physics/physics.usda"}
        for output, edited in edits.items():
            with self.subTest(output):
                for robot in ("arm.urdf", "arm.urdf", "arm2.urdf"):
                    process = self.go(["convert", robot, output])
                    self.assertEqual(process.returncode, 0, process.stderr)
                path = self.folder / edited
                path.write_text(path.read_text() + "# tuned\n")
                before = snapshot(self.folder)
                process = self.go(["convert", "arm.urdf", output])
                self.fails(process, output)
                self.assertIn(path.name, process.stderr)
                self.assertIn("--force", process.stderr)
                self.same(before)
                process = self.go(["convert", "arm.urdf", output, "--force"])
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertNotIn("# tuned", path.read_text())
                self.assertEqual(self.go(["convert", "arm.urdf", output]).returncode, 0)

    def test_binary_ones_know_as_well(self):
        for output in ("made.usdc", "made.usd", "made.usdz"):
            with self.subTest(output):
                for robot in ("arm.urdf", "arm.urdf", "arm2.urdf"):
                    process = self.go(["convert", robot, output])
                    self.assertEqual(process.returncode, 0, process.stderr)
                self.go(["cat", output, "--flatten", "-o", "other.usda"])
                text = (self.folder / "other.usda").read_text()
                (self.folder / "other.usda").write_text(text.replace('def Xform "tip"',
                                                                     'def Xform "top"'))
                self.go(["cat", "other.usda", "-o", output])
                before = snapshot(self.folder)
                self.fails(self.go(["convert", "arm.urdf", output]), output)
                self.same(before)
                self.assertEqual(self.go(["convert", "arm.urdf", output, "--force"]).returncode, 0)

    def test_descriptions_know_as_well(self):
        (self.folder / "other.usda").write_text(
            (self.folder / "base.usda").read_text().replace("mass = 2", "mass = 3"))
        for output in ("made.xml", "made.urdf"):
            with self.subTest(output):
                for asset in ("base.usda", "base.usda", "other.usda"):
                    process = self.go(["convert", asset, output])
                    self.assertEqual(process.returncode, 0, process.stderr)
                path = self.folder / output
                made = path.read_bytes()
                self.go(["convert", "other.usda", "again" + path.suffix])
                self.assertEqual((self.folder / f"again{path.suffix}").read_bytes(), made)
                for text in (made.replace(b'"3"', b'"4"'), made + b"<!-- mine -->\n",
                             b"<mujoco/>\n" if output.endswith("xml") else b"<robot/>\n", b""):
                    path.write_bytes(text)
                    before = snapshot(self.folder)
                    process = self.go(["convert", "base.usda", output])
                    self.fails(process, output)
                    self.assertIn("--force", process.stderr)
                    self.same(before)
                process = self.go(["convert", "base.usda", output, "--force"])
                self.assertEqual(process.returncode, 0, process.stderr)
                self.assertEqual(self.go(["convert", "base.usda", output]).returncode, 0)

    def test_meshes_beside_a_description_are_part_of_it(self):
        (self.folder / "mesh.usda").write_text(MESH)
        mesh = self.folder / "two--robots_meshes/mesh_0.obj"
        words = ["convert", "mesh.usda", "two--robots.urdf"]
        mesh.parent.mkdir()
        mesh.write_text("of somebody else")
        before = snapshot(self.folder)
        self.fails(self.go(words), "a mesh of somebody else")
        self.same(before)
        mesh.unlink()
        for _ in range(2):
            process = self.go(words)
            self.assertEqual(process.returncode, 0, process.stderr)
        mesh.write_text(mesh.read_text() + "# tuned\n")
        before = snapshot(self.folder)
        process = self.go(words)
        self.fails(process, "edited mesh")
        self.assertIn("mesh_0.obj", process.stderr)
        self.same(before)
        self.assertEqual(self.go([*words, "--force"]).returncode, 0)
        self.assertNotIn("tuned", mesh.read_text())

    def test_images_of_somebody_else_stay(self):
        """Textures of a description that lies elsewhere come into a folder beside the layer."""
        words = ["convert", ROOT / "tests/convert/urdf/shapes.urdf", "made.usda"]
        image = self.folder / "made_images/stripes.png"
        image.parent.mkdir()
        image.write_text("of somebody else")
        before = snapshot(self.folder)
        process = self.go(words)
        self.fails(process, "image")
        self.assertIn("stripes.png", process.stderr)
        self.same(before)
        self.assertEqual(self.go([*words, "--force"]).returncode, 0)
        self.assertTrue(image.read_bytes().startswith(b"\x89PNG"))
        self.assertEqual(self.go(words).returncode, 0)

    def test_edits_by_this_program_count(self):
        self.go(["convert", "arm.urdf", "made"])
        process = self.go(["set", "made/arm.usda", "--mass", "/arm/Geometry/base=7"])
        if process.returncode != 0:
            process = self.go(["variant", "made/arm.usda", "Physics=none", "--in-place"])
        self.assertEqual(process.returncode, 0, process.stderr)
        self.fails(self.go(["convert", "arm.urdf", "made"]), "set")

    def test_files_of_others_stay(self):
        self.go(["convert", "arm.urdf", "made"])
        for name in ("notes.txt", "payloads/Physics/newton.usda"):
            (self.folder / "made" / name).write_text("#usda 1.0\n")
            before = snapshot(self.folder)
            process = self.go(["convert", "arm.urdf", "made"])
            self.fails(process, name)
            self.assertIn(name, process.stderr)
            self.same(before)
        self.assertEqual(self.go(["convert", "arm.urdf", "made", "--force"]).returncode, 0)
        self.assertTrue((self.folder / "made/notes.txt").exists())

    def test_a_folder_of_somebody_else_is_left_alone(self):
        process = self.go(["convert", "arm.urdf", "hand"])
        self.fails(process, "hand")

    def test_structure_keeps_to_the_same_rule(self):
        self.assertEqual(self.go(["structure", "base.usda", "-o", "made"]).returncode, 0)
        self.assertEqual(self.go(["structure", "base.usda", "-o", "made"]).returncode, 0)
        path = self.folder / "made/payloads/base.usda"
        path.write_text(path.read_text() + "# tuned\n")
        self.fails(self.go(["structure", "base.usda", "-o", "made"]), "structure")
        self.assertEqual(self.go(["structure", "base.usda", "-o", "made", "--force"]).returncode, 0)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
