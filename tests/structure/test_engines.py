#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon structure` with layers of engines that are asked for, or that no variant loads.

    test_engines.py ROOT TENON
"""

import pathlib
import shutil
import sys
import tempfile
import unittest

from program import EXAMPLE, breaches, files_of, run, structure, tenon

FOLDER = tempfile.TemporaryDirectory()


def made(asset, *options):
    return structure(asset, pathlib.Path(tempfile.mkdtemp(dir=FOLDER.name)) / "out", *options)


def file_of(interface, name):
    return (interface.parent / "payloads" / name).read_text(encoding="utf-8")


def bodies_of(asset, variant):
    return tenon("physics", asset, "--physics", variant)["bodies"]


class Engines(unittest.TestCase):
    """Layers of engines that are asked for, or that stand there already."""

    def copy(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=FOLDER.name)) / "hand"
        shutil.copytree(EXAMPLE.parent, folder)
        return folder / EXAMPLE.name

    def test_a_layer_is_made_for_an_engine_and_stays(self):
        interface = made(EXAMPLE, "--engine", "newton", "--engine", "havok")
        for engine in ("newton", "havok"):
            text = file_of(interface, f"Physics/{engine}.usda")
            self.assertIn("@./physics.usda@", text)
            self.assertNotIn("over", text)
            self.assertEqual(bodies_of(interface, engine),
                             bodies_of(interface, "physics"))
        self.assertEqual([d for d in breaches(interface) if d["severity"] != "info"], [])
        again = made(interface)
        self.assertEqual(files_of(again.parent), files_of(interface.parent))

    def test_a_layer_that_no_variant_loads_is_kept(self):
        asset = self.copy()
        folder = asset.parent / "payloads/Physics"
        text = ('#usda 1.0\n(\n    defaultPrim = "inspire_hand"\n'
                '    subLayers = [@./physics.usda@]\n    metersPerUnit = 1\n'
                '    upAxis = "Z"\n)\nover "inspire_hand"\n{\n'
                '    over "r_base_link"\n    {\n        float physics:mass = 3\n    }\n}\n')
        (folder / "havok.usda").write_text(text)
        (folder / "notes.usda").write_text("#usda 1.0\n")
        out = pathlib.Path(tempfile.mkdtemp(dir=FOLDER.name)) / "out"
        answer = tenon("structure", asset, "-o", out)
        loose = {pathlib.Path(d["file"]).name: d["message"] for d in answer["diagnostics"]
                 if d["rule"] == "structure.loose-layer"}
        self.assertEqual(set(loose), {"havok.usda", "notes.usda"})
        self.assertIn('becomes the variant "havok"', loose["havok.usda"])
        self.assertIn("skipped", loose["notes.usda"])
        interface = out / "inspire_hand.usda"
        masses = {body["path"]: body["mass"] for body in bodies_of(interface, "havok")}
        self.assertEqual(masses["/inspire_hand/r_base_link"], 3)

    def test_names_that_cannot_be_are_refused(self):
        for name in ("none", "physics", "a/b", ""):
            process = run("structure", EXAMPLE, "--dry-run", "--engine", name)
            self.assertEqual(process.returncode, 2, name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
