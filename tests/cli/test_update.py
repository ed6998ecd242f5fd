#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`--update` of convert and structure: the source changed, the asset was edited, both stay.

    test_update.py ROOT TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]

LINK = ('<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="1" iyy="1" izz="1" '
        'ixy="0" ixz="0" iyz="0"/></inertial><visual><geometry><box size="{size} 1 1"/></geometry>'
        '<material name="paint"><color rgba="1 0 0 1"/></material></visual>'
        '<visual name="skin{name}"><geometry><mesh filename="skin.obj"/></geometry></visual>'
        "<collision><geometry><box size=\"1 1 1\"/></geometry></collision></link>")
JOINT = ('<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>'
         '<origin xyz="0 0 1"/><axis xyz="0 0 1"/><limit lower="-1" upper="{upper}" effort="5" '
         'velocity="2"/></joint>')
MESH = "".join(f"v {i} {i % 7} {i % 5}\n" for i in range(60)) + "".join(
    f"f {i} {i + 1} {i + 2}\n" for i in range(1, 58))


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True,
                             text=True, check=False)
    return process.returncode, json.loads(process.stdout)


def files_of(folder):
    return {p.relative_to(folder).as_posix(): (p.read_bytes(), p.stat().st_mtime_ns)
            for p in folder.rglob("*") if p.is_file()}


def urdf(masses=None, upper=1, links="abc", order=None, sizes=None):
    masses, sizes = {"a": 1, "b": 2, "c": 3, **(masses or {})}, sizes or {}
    text = "".join(LINK.format(name=n, mass=masses.get(n, 1), size=sizes.get(n, 1)) for n in links)
    for parent, child in order or zip(links, links[1:]):
        text += JOINT.format(name=f"j{child}", parent=parent, child=child, upper=upper)
    return f'<robot name="r">{text}</robot>'


MJCF = """<mujoco model="r"><worldbody><body name="a" pos="0 0 1"><freejoint/>
<geom name="ga" size="0.1" mass="{mass}"/><body name="b" pos="0 0 1"><joint name="jb" axis="0 1 0"
 range="-1 1" limited="true" damping="{damping}"/><geom name="gb" size="0.1" mass="2"/></body>
</body></worldbody><actuator><motor name="m" joint="jb" gear="1"/></actuator></mujoco>"""


class Update(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.robot = self.folder / "r.urdf"
        (self.folder / "skin.obj").write_text(MESH)

    def path(self, place, name):
        """A prim of the asset by its name."""
        code, answer = tenon("tree", place)
        self.assertEqual(code, 0, answer)
        text = json.dumps(answer)
        paths = [part for part in text.split('"') if part.startswith("/") and
                 part.endswith("/" + name)]
        self.assertTrue(paths, (name, text))
        return min(paths, key=len)

    def value(self, place, prop):
        code, answer = tenon("where", place, prop)
        self.assertEqual(code, 0, answer)
        return float(answer["value"])

    def convert(self, place, *options, code=0, source=None, conflicts=0):
        got, answer = tenon("convert", source or self.robot, place, *options)
        self.assertEqual(got, code, answer)
        if "--update" in options and code != 2:
            self.assertEqual(len(answer["updated"]["conflicts"]), conflicts, answer)
        return answer

    def set(self, asset, *edits):
        code, answer = tenon("set", asset, *edits)
        self.assertEqual(code, 0, answer)

    def places(self):
        """The asset as a folder and as one file of each form: (output, asset)."""
        for name in ("hand/", "hand.usda", "hand.usdc"):
            home = self.folder / f"in_{name.strip('/').replace('.', '_')}"
            home.mkdir()
            folder = name.endswith("/")
            yield f"{home / name}{'/' if folder else ''}", \
                home / name / "r.usda" if folder else home / name

    def test_takes_what_the_source_changed_and_keeps_edits(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf())
                self.convert(output)
                b, c = self.path(asset, "b"), self.path(asset, "c")
                self.set(asset, f"{b}.physics:mass=20")
                self.robot.write_text(urdf({"b": 2, "c": 30}))
                answer = self.convert(output, "--update")
                self.assertEqual(answer["updated"]["edits"], 1, answer)
                self.assertGreaterEqual(answer["updated"]["changes"], 1)
                self.assertEqual(self.value(asset, f"{b}.physics:mass"), 20)
                self.assertEqual(self.value(asset, f"{c}.physics:mass"), 30)
                # The edit is an edit still, for the next run and for one without --update.
                self.assertEqual(self.convert(output, code=2)["diagnostics"][-1]["rule"],
                                 "output.edited")
                self.robot.write_text(urdf({"a": 10, "c": 30}))
                self.convert(output, "--update")
                self.assertEqual([self.value(asset, f"{self.path(asset, n)}.physics:mass")
                                  for n in "abc"], [10, 20, 30])

    def test_of_an_unedited_asset_gives_what_convert_gives(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf())
                self.convert(output)
                self.robot.write_text(urdf({"b": 20}, links="abcd", sizes={"a": 2}))
                self.convert(output, "--update")
                home = asset.parent
                fresh = self.folder / f"fresh_{len(list(self.folder.iterdir()))}"
                fresh.mkdir()
                self.convert(f"{fresh}/" if output.endswith("/") else fresh / asset.name,
                             *(["--name", "r"] if output.endswith("/") else []))
                self.assertEqual({n: c for n, (c, _) in files_of(home).items()
                                  if not n.endswith(".usda")},
                                 {n: c for n, (c, _) in files_of(fresh).items()
                                  if not n.endswith(".usda")} )
                self.convert(output)  # nothing was edited

    def test_of_an_unchanged_source_writes_nothing(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf())
                self.convert(output)
                self.set(asset, f"{self.path(asset, 'b')}.physics:mass=20")
                before = files_of(asset.parent)
                answer = self.convert(output, "--update")
                self.assertEqual(answer["updated"]["files"], [])
                self.assertEqual(files_of(asset.parent), before)

    def test_names_conflicts_and_does_as_told(self):
        for output, asset in self.places():
            for option, code, mass, kept in (("edits", 1, 20, "edit"), ("source", 1, 5, "source"),
                                             ("fail", 1, 20, "edit")):
                with self.subTest((output, option)):
                    self.robot.write_text(urdf())
                    self.convert(output, "--force")
                    b = self.path(asset, "b")
                    self.set(asset, f"{b}.physics:mass=20")
                    before = files_of(asset.parent)
                    self.robot.write_text(urdf({"b": 5, "c": 7}))
                    answer = self.convert(output, "--update", "--conflicts", option, code=code,
                                          conflicts=1)
                    conflict = answer["updated"]["conflicts"][0]
                    self.assertEqual((conflict["prim"], conflict["property"], conflict["base"],
                                      conflict["edit"], conflict["source"], conflict["kept"]),
                                     (b, "physics:mass", "2", "20", "5", kept))
                    told = [d for d in answer["diagnostics"] if d["rule"] == "update.conflict"]
                    self.assertEqual(len(told), 1)
                    for word in ("was 2", "edit says 20", "source 5"):
                        self.assertIn(word, told[0]["message"])
                    self.assertEqual(self.value(asset, f"{b}.physics:mass"), mass)
                    if option == "fail":
                        self.assertEqual(files_of(asset.parent), before)
                    else:  # told once
                        self.convert(output, "--update")
                        self.assertEqual(self.value(asset, f"{b}.physics:mass"), mass)

    def test_a_conflict_is_told_until_it_is_settled(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf())
                self.convert(output)
                b, c = self.path(asset, "b"), self.path(asset, "c")
                self.set(asset, f"{b}.physics:mass=20", f"{c}.physics:mass=30")
                self.robot.write_text(urdf({"a": 9, "b": 5}))
                for _ in range(2):  # told again, with nothing to write the second time
                    answer = self.convert(output, "--update", code=1, conflicts=1)
                    self.assertEqual(self.value(asset, f"{b}.physics:mass"), 20)
                    self.assertIn("--conflicts source", answer["diagnostics"][-1]["fix"])
                self.assertEqual(answer["updated"]["files"], [])
                self.assertEqual(answer["updated"]["conflicts"][0]["base"], "2")
                # What was taken meanwhile is no conflict when the source changes it once more.
                self.robot.write_text(urdf({"a": 8, "b": 5}))
                self.convert(output, "--update", code=1, conflicts=1)
                # Settled: silent, until the source changes it again.
                self.convert(output, "--update", "--conflicts", "edits", code=1, conflicts=1)
                self.convert(output, "--update")
                self.robot.write_text(urdf({"a": 8, "b": 6}))
                self.convert(output, "--update", code=1, conflicts=1)
                self.convert(output, "--update", "--conflicts", "edits", code=1, conflicts=1)
                # The advice works, even then.
                self.convert(output, "--update", "--conflicts", "source", code=1, conflicts=1)
                self.assertEqual([self.value(asset, f"{self.path(asset, n)}.physics:mass")
                                  for n in "abc"], [8, 6, 30])
                self.convert(output, "--update")

    def test_the_source_can_be_followed_after_a_removal_was_refused(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf(links="abcd"))
                self.convert(output)
                self.set(asset, f"{self.path(asset, 'd')}.physics:mass=20")
                self.robot.write_text(urdf(links="abc"))
                for _ in range(2):
                    code, answer = tenon("convert", self.robot, output, "--update")
                    self.assertEqual((code, {c["kind"] for c in answer["updated"]["conflicts"]}),
                                     (1, {"removedBySource"}))
                    self.assertEqual(self.value(asset, f"{self.path(asset, 'd')}.physics:mass"), 20)
                code, answer = tenon("convert", self.robot, output, "--update", "--conflicts",
                                     "source")
                self.assertEqual(code, 1, answer)
                self.assertNotIn('/d"', json.dumps(tenon("tree", asset)[1]))
                self.assertEqual(len(tenon("physics", asset)[1]["bodies"]), 3)
                self.convert(output, "--update")

    def test_links_that_come_and_go(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf(links="abcd"))
                self.convert(output)
                self.set(asset, f"{self.path(asset, 'b')}.physics:mass=20")
                self.robot.write_text(urdf(links="abcx"))
                self.convert(output, "--update")
                text = json.dumps(tenon("tree", asset)[1])
                self.assertIn("/x", text)
                self.assertNotIn('/d"', text)
                self.assertEqual(self.value(asset, f"{self.path(asset, 'b')}.physics:mass"), 20)
                code, answer = tenon("check", asset)
                self.assertEqual([d for d in answer["diagnostics"] if d["severity"] == "error"], [])
                code, answer = tenon("physics", asset)
                self.assertEqual((code, len(answer["bodies"])), (0, 4))

    def test_an_edit_of_a_link_that_is_gone_stays_and_is_told(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf(links="abcd"))
                self.convert(output)
                d = self.path(asset, "d")
                self.set(asset, f"{d}.physics:mass=20")
                self.robot.write_text(urdf(links="abc"))
                answer = tenon("convert", self.robot, output, "--update")
                self.assertEqual(answer[0], 1)
                kinds = {c["kind"] for c in answer[1]["updated"]["conflicts"]}
                self.assertEqual(kinds, {"removedBySource"})
                self.assertEqual(self.path(asset, "d"), d)
                self.assertEqual(self.value(asset, f"{d}.physics:mass"), 20)
                self.assertEqual(tenon("physics", asset)[0], 0)

    def test_edits_go_along_with_links_that_move(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf())
                self.convert(output)
                before = self.path(asset, "c")
                self.set(asset, f"{before}.physics:mass=33")
                self.robot.write_text(urdf(links="abcs", order=["as", "sb", "bc"]))
                answer = self.convert(output, "--update")
                after = self.path(asset, "c")
                self.assertNotEqual(after, before)
                self.assertIn({"from": before.removesuffix("/c"), "to": after.removesuffix("/c")},
                              answer["updated"]["moved"])
                self.assertEqual(self.value(asset, f"{after}.physics:mass"), 33)
                code, answer = tenon("physics", asset)
                self.assertEqual((code, len(answer["bodies"])), (0, 4))

    def test_added_and_removed_things_of_the_asset_stay(self):
        self.robot.write_text(urdf())
        output, asset = next(self.places())
        self.convert(output)
        b = self.path(asset, "b")
        for edit in (["set", asset, "--apply", f"{b}=PhysxRigidBodyAPI", "--engine", "physx",
                      f"{b}.physxRigidBody:linearDamping=0.5"],
                     ["set", asset, "--engine", "newton", f"{self.path(asset, 'jb')}.physics:"
                      "upperLimit=10"],
                     ["set", asset, "--clear", f"{self.path(asset, 'jc')}.physics:upperLimit"],
                     ["variant", asset, "--default", "Physics=newton"]):
            code, answer = tenon(*edit)
            if code == 2 and edit[0] == "variant":
                continue
            self.assertEqual(code, 0, answer)
        (asset.parent / "notes.txt").write_text("mine")
        text = asset.parent / "payloads/Physics/physics.usda"
        text.write_text(text.read_text().replace("#usda 1.0", "#usda 1.0\n# my comment", 1))
        self.robot.write_text(urdf({"a": 7}))
        self.convert(output, "--update")
        self.assertEqual((asset.parent / "notes.txt").read_text(), "mine")
        self.assertIn("# my comment", text.read_text())
        self.assertEqual(self.value(asset, f"{self.path(asset, 'a')}.physics:mass"), 7)
        self.assertIn("upperLimit = 10",
                      (asset.parent / "payloads/Physics/newton.usda").read_text())
        self.assertIn("linearDamping = 0.5",
                      (asset.parent / "payloads/Physics/physx.usda").read_text())
        self.assertEqual(text.read_text().count("physics:upperLimit"), 1)
        self.assertIn('"newton"', asset.read_text())

    def test_meshes_of_the_source_change_under_edits_of_looks(self):
        for output, asset in self.places():
            with self.subTest(output):
                (self.folder / "skin.obj").write_text(MESH)
                self.robot.write_text(urdf())
                self.convert(output)
                b = self.path(asset, "b")
                self.set(asset, f"{b}.physics:mass=20")
                (self.folder / "skin.obj").write_text(MESH.replace("v 5 5 0", "v 5 5 9"))
                answer = self.convert(output, "--update")
                self.assertNotEqual(answer["updated"]["files"], [])
                self.assertEqual(self.value(asset, f"{b}.physics:mass"), 20)
                flat = subprocess.run([TENON, "cat", "--flatten", asset], capture_output=True,
                                      text=True, check=False)
                self.assertIn("(5, 5, 9)", flat.stdout, flat.stderr)

    def test_without_a_base_it_says_so(self):
        for output, asset in self.places():
            with self.subTest(output):
                self.robot.write_text(urdf())
                self.convert(output)
                b = self.path(asset, "b")
                shutil.rmtree(asset.parent / ".tenon")
                self.robot.write_text(urdf({"c": 9}))
                self.convert(output, "--update")  # nobody edited it: it is its own base
                shutil.rmtree(asset.parent / ".tenon")
                self.set(asset, f"{b}.physics:mass=20")
                before = files_of(asset.parent)
                self.robot.write_text(urdf({"c": 8}))
                answer = self.convert(output, "--update", code=2)
                self.assertEqual(answer["diagnostics"][-1]["rule"], "update.no-base")
                self.assertIn("tenon diff", answer["diagnostics"][-1]["fix"])
                self.assertEqual(files_of(asset.parent), before)

    def test_a_base_of_another_version_is_none(self):
        output, asset = next(self.places())
        self.robot.write_text(urdf())
        self.convert(output)
        old = self.folder / "old"
        shutil.copytree(asset.parent, old)
        self.robot.write_text(urdf({"c": 9}))
        self.convert(output, "--update")
        shutil.rmtree(old / ".tenon")
        shutil.copytree(asset.parent / ".tenon", old / ".tenon")
        self.set(old / "r.usda", f"{self.path(old / 'r.usda', 'b')}.physics:mass=20")
        self.robot.write_text(urdf({"c": 10}))
        answer = self.convert(f"{old}/", "--update", code=2)
        self.assertEqual(answer["diagnostics"][-1]["rule"], "update.no-base")

    def test_damaged_bases_are_errors(self):
        output, asset = next(self.places())
        self.robot.write_text(urdf())
        self.convert(output)
        self.set(asset, f"{self.path(asset, 'b')}.physics:mass=20")
        base = asset.parent / ".tenon/r.usda.base"
        whole = base.read_bytes()
        self.robot.write_text(urdf({"c": 10}))
        for damaged in (b"", b"x", whole[:len(whole) // 2], whole[:200] + b"\xff" * 64 +
                        whole[264:]):
            base.write_bytes(damaged)
            before = files_of(asset.parent)
            code, answer = tenon("convert", self.robot, output, "--update")
            self.assertEqual(code, 2, answer)
            self.assertEqual(files_of(asset.parent), before)

    def test_a_base_that_names_other_files_is_refused(self):
        output, asset = next(self.places())
        self.robot.write_text(urdf())
        self.convert(output)
        victim = asset.parent.parent / "victim.txt"
        victim.write_text("mine")
        base = asset.parent / ".tenon/r.usda.base"
        with zipfile.ZipFile(base) as archive:
            entries = {name: archive.read(name) for name in archive.namelist()}
        self.robot.write_text(urdf({"c": 10}))
        for name in ("../victim.txt", str(victim), "a/../../victim.txt"):
            with zipfile.ZipFile(base, "w") as archive:
                for entry, contents in entries.items():
                    line = f"{'0' * 16} {name}\n".encode() if entry == "digests" else b""
                    archive.writestr(entry, contents + line)
            code, answer = tenon("convert", self.robot, output, "--update", "--conflicts",
                                 "source")
            self.assertEqual(code, 2, answer)
            self.assertIn("outside", answer["diagnostics"][-1]["message"])
            self.assertEqual(victim.read_text(), "mine")

    def test_where_there_is_nothing_it_converts(self):
        for output, asset in self.places():
            self.robot.write_text(urdf())
            code, answer = tenon("convert", self.robot, output, "--update")
            self.assertEqual(code, 0, answer)
            self.assertTrue(asset.exists())

    def test_packages_are_refused(self):
        self.robot.write_text(urdf())
        self.convert(self.folder / "r.usda")
        for ending in ("xml", "urdf"):  # a description is no asset that could be updated
            code, answer = tenon("convert", self.folder / "r.usda", self.folder / f"back.{ending}",
                                 "--update")
            self.assertEqual(code, 2, answer)
            self.assertFalse((self.folder / f"back.{ending}").exists())
        answer = self.convert(self.folder / "r.usdz", "--update", code=2)
        self.assertIn("folder", answer["diagnostics"][-1]["fix"])

    def test_of_mjcf(self):
        model = self.folder / "r.xml"
        for output, asset in self.places():
            with self.subTest(output):
                model.write_text(MJCF.format(mass=1, damping=0.1))
                self.convert(output, source=model)
                b = self.path(asset, "b")
                self.set(asset, f"{b}.physics:mass=20")
                model.write_text(MJCF.format(mass=4, damping=0.1))
                self.convert(output, "--update", source=model)
                self.assertEqual(self.value(asset, f"{b}.physics:mass"), 20)
                self.assertEqual(self.value(asset, f"{self.path(asset, 'a')}.physics:mass"), 4)

    def test_of_usd_by_structure(self):
        self.robot.write_text(urdf())
        source, target = self.folder / "s.usda", self.folder / "made"
        self.convert(source)
        self.assertEqual(tenon("structure", source, "-o", target)[0], 0)
        asset = target / "r.usda"
        b, c = self.path(asset, "b"), self.path(asset, "c")
        self.set(asset, f"{b}.physics:mass=20")
        self.set(source, f"{self.path(source, 'c')}.physics:mass=30")
        code, answer = tenon("structure", source, "-o", target, "--update")
        self.assertEqual((code, answer["updated"]["conflicts"]), (0, []), answer)
        self.assertEqual(self.value(asset, f"{b}.physics:mass"), 20)
        self.assertEqual(self.value(asset, f"{c}.physics:mass"), 30)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
