#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon add of meshes, tenon set of units, time codes and default prims.

    test_authoring_files.py ROOT TENON CLASS...
"""

import ast
import json
import re
import sys
import unittest

from authoring_case import LAID_OUT, MESHES, Case, stl


class Meshes(Case):
    """Mesh files as shapes of a scene."""

    def value(self, name):
        """Of the one prim that has it, as the layer's text has it."""
        text = self.do("cat", self.scene).stdout
        return ast.literal_eval(re.search(rf" {name} = (\[.*?\])(?: \(|\n)", text)[1])

    def test_every_format_is_one_shape_that_collides(self):
        self.do("new", self.scene)
        for ending in MESHES:
            with self.subTest(ending=ending):
                out = self.do("add", self.scene, f"/World/{ending}=mesh,body,collider,mass",
                              "--file", f"part.{ending}", "--approximation", "convexHull",
                              "--mass", "2", "--at", "0,0,1").stdout
                self.assertIn(f"4 faces of part.{ending}, whose unit is 1 m and whose up axis "
                              + ("Y" if ending == "glb" else "Z"), out)
                physics = json.loads(self.do("physics", self.scene, "--json").stdout)
                body, = [body for body in physics["bodies"] if body["path"].endswith(ending)]
                self.assertEqual(body["mass"], 2)
        self.assertEqual(len(physics["colliders"]), 4)
        self.assertNotIn("error", self.do("check", self.scene).stdout.replace("0 errors", ""))

    def test_numbers_become_those_of_the_stage(self):
        for options, up, meters, last in (
                ([], "Z", 1, (0, 0, 2)),
                ([], "Z", 0.01, (0, 0, 200)),
                (["--file-meters", "0.001"], "Z", 0.01, (0, 0, 0.2)),
                (["--file-up", "Y"], "Z", 1, (0, -2, 0)),
                (["--file-up", "Z"], "Y", 1, (0, 2, 0)),
                (["--file-up", "Y"], "Y", 1, (0, 0, 2))):
            with self.subTest(options=options, up=up, meters=meters):
                self.do("new", self.scene, "--force", "--up", up, "--meters", meters)
                self.do("add", self.scene, "/World/m=mesh", "--file", "part.obj", *options)
                points = self.value("points")
                for found, wanted in zip(points[3], last):
                    self.assertAlmostEqual(found, wanted, 5)

    def test_a_colour_of_the_file_is_shown(self):
        self.do("new", self.scene)
        self.do("add", self.scene, "/World/m=mesh", "--file", "part.glb")
        (color,) = self.value("primvars:displayColor")
        for found, wanted in zip(color, (1, 0.5, 0.25)):
            self.assertAlmostEqual(found, wanted, 3)

    def test_a_file_in_millimetres_is_noticed(self):
        far = stl().replace(b"vertex 1 0 0", b"vertex 120 0 0")
        (self.folder / "far.stl").write_bytes(far)
        self.do("new", self.scene)
        self.assertIn("--file-meters 0.001", self.do("add", self.scene, "/World/m=mesh", "--file",
                                                     "far.stl").stderr)
        self.do("remove", self.scene, "/World/m")
        self.assertEqual("", self.do("add", self.scene, "/World/m=mesh", "--file", "far.stl",
                                     "--file-meters", "0.001").stderr)

    def test_damaged_files_are_refused_with_their_names(self):
        self.do("new", self.scene)
        before = self.scene.read_bytes()
        for ending, contents in MESHES.items():
            whole = contents()
            cut = whole[:len(whole) // 2]
            for number, damaged in enumerate((b"", b"\0" * 400, cut)):
                if ending == "stl" and damaged == cut:
                    continue  # facets of text that are whole count
                name = f"damaged{number}.{ending}"
                (self.folder / name).write_bytes(damaged)
                with self.subTest(name=name):
                    process = self.do("add", self.scene, "/World/m=mesh", "--file", name, code=2)
                    self.assertRegex(process.stderr, rf"{name}.*\[\S+\]")
                    self.assertEqual(self.scene.read_bytes(), before)
        for rule, *words in (
                ("file.not-found", "--file", "none.stl"),
                ("mesh.format", "--file", "part.usda"),
                ("edit.bad-argument", "--file", "part.stl", "--file-meters", "0"),
                ("edit.bad-argument", "--file", "part.stl", "--file-meters", "mm"),
                ("edit.bad-argument", "--file", "part.stl", "--file-up", "W"),
                ("edit.bad-argument",)):
            with self.subTest(words=words):
                self.refused(rule, "add", self.scene, "/World/m=mesh", *words)


class Metadata(Case):
    """Units, time codes and the default prim of layers that are there."""

    VALUES = {"timeCodesPerSecond": "60", "startTimeCode": "-5", "endTimeCode": "300",
              "metersPerUnit": "0.01", "kilogramsPerUnit": "0.001", "upAxis": "Y",
              "defaultPrim": "Other"}

    def test_every_name_is_set_in_text_and_binary(self):
        fix = self.refused("edit.bad-argument", "set", self.laid_out(), "--layer", "?=1")
        names = re.search(r"NAME=VALUE for ([\w, ]+)", fix)[1].strip().split(", ")
        self.assertEqual(sorted(names), sorted(self.VALUES))
        for file in ("s.usda", "s.usdc"):
            self.do("new", file, "--force")
            self.do("add", file, "/Other=xform")
            for name in names:
                with self.subTest(file=file, name=name):
                    value = self.VALUES[name]
                    done = self.do("set", file, "--layer", f"{name}={value}")
                    written = value if name not in ("upAxis", "defaultPrim") else f'"{value}"'
                    self.assertIn(f"{name} = {written}", self.do("cat", file).stdout)
                    warned = name in ("metersPerUnit", "kilogramsPerUnit", "upAxis")
                    self.assertEqual("edit.not-rescaled" in done.stderr, warned, done.stderr)

    def test_comments_stay_and_a_dry_run_writes_nothing(self):
        scene = self.laid_out()
        self.do("set", scene, "--layer", "metersPerUnit=1", "--dry-run")
        self.assertEqual(scene.read_text(encoding="utf-8"), LAID_OUT)
        self.do("set", scene, "--layer", "metersPerUnit=1")
        self.assertEqual(scene.read_text(encoding="utf-8"),
                         LAID_OUT.replace("metersPerUnit = 0.01 # cm", "metersPerUnit = 1 # cm"))

    def test_other_time_codes_are_told_where_there_are_samples(self):
        self.do("new", self.scene, "--time-codes-per-second", "30", "--start-time-code", "1",
                "--end-time-code", "90")
        text = self.scene.read_text(encoding="utf-8")
        for part in ("timeCodesPerSecond = 30", "startTimeCode = 1", "endTimeCode = 90"):
            self.assertIn(part, text)
        self.scene.write_text(text + 'def Xform "m"\n{\n    double3 xformOp:translate.timeSamples '
                              '= {\n        1: (0, 0, 0),\n    }\n}\n', encoding="utf-8")
        self.assertIn("edit.not-rescaled", self.do("set", self.scene, "--layer",
                                                   "timeCodesPerSecond=60").stderr)

    def test_wrong_use_is_refused(self):
        scene = self.laid_out()
        for rule, *words in (
                ("edit.bad-argument", "--layer", "metersPerUnit=0"),
                ("edit.bad-argument", "--layer", "timeCodesPerSecond=nan"),
                ("edit.bad-argument", "--layer", "endTimeCode=soon"),
                ("edit.bad-argument", "--layer", "upAxis=W"),
                ("edit.bad-argument", "--layer", "metersPerUnit=1", "--in", "s.usda"),
                ("edit.no-prim", "--layer", "defaultPrim=None")):
            with self.subTest(words=words):
                self.refused(rule, "set", scene, *words)
        self.assertIn("did you mean metersPerUnit?", self.refused(
            "edit.bad-argument", "set", scene, "--layer", "metrePerUnit=1"))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
