#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon zip: an asset with all its variants in one file, listed and unpacked again.

    test_zip.py ROOT TENON

Where usd-core is installed it opens the package under every variant and has to find what it finds
in the unpacked asset. The hand of ../shared joins in where it is there.
"""

import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
ISAAC = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"
VARIANTS = ("mujoco", "none", "physics", "physx")
PARTS = {"inspire_hand.usda", "payloads/base.usda", "payloads/robot.usda",
         "payloads/instances.usda", "payloads/material.usda", "payloads/geometry.usdc",
         "payloads/Physics/physics.usda", "payloads/Physics/physx.usda",
         "payloads/Physics/mujoco.usda"}


def tenon(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)


def composed(path, variant):
    """Every prim and property of usd-core's stage under a variant, asset paths by their names."""
    from pxr import Sdf, Usd
    stage = Usd.Stage.Open(str(path))
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        stage.GetDefaultPrim().GetVariantSets().SetSelection("Physics", variant)
    found = {}
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        found[str(prim.GetPath())] = (str(prim.GetTypeName()), str(prim.GetMetadata("apiSchemas")))
        for attribute in prim.GetAttributes():
            value = attribute.Get()
            if isinstance(value, Sdf.AssetPath):
                value = (value.path, bool(value.resolvedPath))
            found[str(attribute.GetPath())] = str(value)
        for relationship in prim.GetRelationships():
            found[str(relationship.GetPath())] = str(relationship.GetTargets())
    return found, [str(error) for error in stage.GetCompositionErrors()]


class Zip(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.package = self.folder / "hand.usdz"

    def run_json(self, *arguments, code=0):
        process = tenon("zip", *arguments, "--json")
        self.assertEqual(process.returncode, code, process.stdout + process.stderr)
        return json.loads(process.stdout)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def test_all_variants_go_in_each_file_at_its_place(self):
        answer = self.run_json(HAND, "-o", self.package)
        self.assertEqual({file["name"] for file in answer["files"]}, PARTS)
        self.assertEqual(answer["files"][0]["name"], "inspire_hand.usda")
        self.assertTrue(answer["complete"])
        with zipfile.ZipFile(self.package) as archive:
            self.assertIsNone(archive.testzip())
            for name in archive.namelist():
                self.assertEqual(archive.read(name), (HAND.parent / name).read_bytes(), name)

    def test_data_lie_at_multiples_of_64_and_bytes_are_the_same_twice(self):
        self.run_json(HAND, "-o", self.package)
        again = self.folder / "again.usdz"
        self.run_json(HAND, "-o", again)
        data = self.package.read_bytes()
        self.assertEqual(data, again.read_bytes())
        with zipfile.ZipFile(self.package) as archive:
            for entry in archive.infolist():
                name_size, extra = struct.unpack_from("<HH", data, entry.header_offset + 26)
                self.assertEqual((entry.header_offset + 30 + name_size + extra) % 64, 0)
                self.assertEqual(entry.compress_type, zipfile.ZIP_STORED)
        for row in self.run_json(self.package, "--list")["files"]:
            self.assertTrue(row["aligned"] and row["stored"], row)

    def test_it_opens_with_every_variant_as_the_unpacked_asset(self):
        for asset in (HAND, ISAAC):
            if not asset.exists():
                print(f"not compared: {asset} does not exist")
                continue
            self.run_json(asset, "-o", self.package)
            for variant in VARIANTS:
                process = tenon("diff", asset, self.package, "--composed", "--variant", variant)
                self.assertEqual(process.returncode, 0, process.stdout + process.stderr)
                try:
                    import pxr  # noqa: F401
                except ImportError:
                    print("usd-core is not installed here: its view is not compared")
                    continue
                wanted, wanted_errors = composed(asset, variant)
                found, errors = composed(self.package, variant)
                self.assertEqual(found, wanted, variant)
                self.assertEqual(len(errors), len(wanted_errors), errors)

    def test_it_is_unpacked_to_what_it_was(self):
        self.run_json(HAND, "-o", self.package)
        folder = self.folder / "out"
        self.run_json(self.package, "--extract", folder)
        files = {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}
        self.assertEqual(files, PARTS)
        for name in files:
            self.assertEqual((folder / name).read_bytes(), (HAND.parent / name).read_bytes())
        self.assertEqual(tenon("zip", self.package, "--extract", folder).returncode, 2)

    def test_an_empty_package_is_an_empty_folder(self):
        for name, entries in (("empty", []), ("folders", ["a/", "b/c/"])):
            with zipfile.ZipFile(self.folder / f"{name}.usdz", "w") as package:
                for entry in entries:
                    package.writestr(entry, "")
            for place in (name, f"{name}_slash/", f"deep/er/{name}"):
                self.run_json(self.folder / f"{name}.usdz", "--extract", self.folder / place)
                folder = self.folder / place
                self.assertTrue(folder.is_dir(), place)
                self.assertEqual(sorted(f"{path.relative_to(folder)}/" for path in
                                        folder.rglob("*") if path.name != "b"), entries)

    def test_no_file_leaves_the_folder(self):
        inner = self.folder / "inner"
        inner.mkdir()
        for name in ("../evil.usda", "/tmp/tenon_zip_evil.usda", "a/../../evil.usda"):
            with zipfile.ZipFile(self.package, "w") as archive:
                archive.writestr("good.usda", "#usda 1.0\n")
                archive.writestr(zipfile.ZipInfo(name), "#usda 1.0\n")
            process = tenon("zip", self.package, "--extract", inner / "out")
            self.assertEqual(process.returncode, 2, name)
            self.assertIn("package.bad-name", process.stderr)
            self.assertEqual(list(inner.iterdir()), [], name)
            self.assertFalse((self.folder / "evil.usda").exists())

    def test_what_lies_outside_or_is_missing_is_named(self):
        self.write("lib/part.usda", '#usda 1.0\ndef "P"\n{\n}\n')
        asset = self.write("asset/a.usda", '#usda 1.0\n(\n    defaultPrim = "A"\n)\ndef "A" (\n'
                           '    references = [@../lib/part.usda@</P>, @./gone.usda@</G>]\n)\n{\n'
                           '    asset t = @./no.png@\n    asset m = @./x.mdl@\n}\n')
        self.write("asset/x.mdl", "mdl 1.0;\n")
        alone = self.run_json(asset, "-o", self.package, code=1)
        self.assertNotIn("part.usda", str(alone["files"]))
        self.assertIn("read.outside", {finding["rule"] for finding in alone["diagnostics"]})
        library = ("--allow-read", self.folder / "lib")
        answer = self.run_json(asset, "-o", self.package, *library, code=1)
        outside = [file for file in answer["files"] if file["outside"]]
        self.assertEqual([file["name"] for file in outside], ["0/part.usda"])
        self.assertTrue(outside[0]["source"].endswith("lib/part.usda"))
        self.assertFalse(answer["complete"])
        told = {(finding["rule"], word) for finding in answer["diagnostics"]
                for word in ("gone.usda", "no.png", "x.mdl", "part.usda")
                if word in finding["message"]}
        self.assertLessEqual({("package.missing", "gone.usda"), ("package.missing", "no.png"),
                              ("package.file-type", "x.mdl"), ("package.outside", "part.usda")},
                             told)
        self.assertIn("part.usda", tenon("zip", asset, "-o", self.package, *library).stderr)
        places = {finding["message"].split("@")[1]: finding for finding in answer["diagnostics"]
                  if finding["rule"] == "package.missing"}
        for path, text, prim_property in (("./gone.usda", "@./gone.usda@</G>", ("/A", None)),
                                          ("./no.png", "@./no.png@", ("/A", "t"))):
            finding = places[path]
            line = asset.read_text().split("\n")[finding["line"] - 1]
            self.assertEqual(line[finding["column"] - 1:finding["endColumn"] - 1], text)
            self.assertEqual((finding["prim"], finding["property"]), prim_property)
        before = self.package.read_bytes()
        answer = self.run_json(asset, "-o", self.package, "--strict", code=1)
        self.assertIsNone(answer["output"])
        self.assertEqual(self.package.read_bytes(), before)

    def test_what_an_expression_stands_for_goes_in(self):
        for name in ("asset/wood.png", "lib/far.png"):
            self.write(name, "").write_bytes(b"\x89PNG\r\n\x1a\n")
        self.write("asset/part.usda", '#usda 1.0\nover "A"\n{\n}\n')
        self.write("asset/ref.usda", '#usda 1.0\n(\n    defaultPrim = "R"\n'
                   '    expressionVariables = {\n        string OWN = "wood"\n'
                   '        string PART = "weaker"\n    }\n)\n'
                   'def "R"\n{\n    asset w = @`"./${OWN}.png"`@\n'
                   '    asset p = @`"./${PART}.usda"`@\n}\n')
        text = """#usda 1.0
(
    defaultPrim = "A"
    expressionVariables = {
        string PART = "part"
    }
    subLayers = [@`"./${PART}.usda"`@]
)
def "A" (
    references = @./ref.usda@
)
{
    asset none = @`None`@
    asset gone = @`"./${PART}.png"`@
    asset bad = @`${`@
    asset unset = @`"${NOPE}.png"`@
    asset far = @`"../lib/far.png"`@
}
"""
        asset = self.write("asset/a.usda", text)
        answer = self.run_json(asset, "-o", self.package, "--allow-read", self.folder / "lib",
                               code=1)
        self.assertEqual({file["name"] for file in answer["files"]},
                         {"a.usda", "part.usda", "ref.usda", "wood.png", "0/far.png"})
        told = {finding["property"]: finding["rule"] for finding in answer["diagnostics"]
                if finding["severity"] == "warning"}
        self.assertEqual(told, {"gone": "package.missing", "bad": "package.expression",
                                "unset": "package.missing", "far": "package.expression"})
        self.assertIn('@./part.png@, the value of @`"./${PART}.png"`@, is not in the package',
                      str([finding["message"] for finding in answer["diagnostics"]]))
        self.assertFalse(answer["complete"])
        with zipfile.ZipFile(self.package) as package:
            self.assertEqual(package.read("a.usda").decode(), text)
        for path in ("${PART}", "${NOPE}", "../lib/far"):
            text = text.replace(path + ".png", "wood.png")
        text = text.replace("`${`", '`"wood.png"`')
        whole = self.write("asset/b.usda", text)
        self.assertTrue(self.run_json(whole, "-o", self.package)["complete"])
        flat = tenon("cat", "--flatten", self.package).stdout
        self.assertEqual(flat.count("wood.png"), 5, flat)

    def test_a_missing_file_stands_where_it_is_named(self):
        text = """#usda 1.0
(
    subLayers = [@./a.usda@ (offset = 2), @./b.usda@]
)
def "A" (
    assetInfo = {
        asset identifier = @./c.usda@
    }
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./d.usda@, @./e.usda@]
            string templateAssetPath = "./f.###.usda"
        }
    }
    variantSets = "v"
)
{
    asset[] many = [@./g.png@, @./h.png@]
    asset moving.timeSamples = {
        0: None,
        1: @./i.png@,
        2.50: @./j.png@,
    }
    variantSet "v" = {
        "x" (
            payload = @./k.usda@</K>
        ) {
        }
    }
}
"""
        asset = self.write("a.usda.d/asset.usda", text)
        answer = self.run_json(asset, "-o", self.package, code=1)
        lines, found = text.split("\n"), {}
        for finding in answer["diagnostics"]:
            if finding["rule"] == "package.missing":
                line = lines[finding["line"] - 1]
                found[finding["message"].split("@")[1]] = \
                    line[finding["column"] - 1:finding["endColumn"] - 1]
        wanted = {f"./{name}": f"@./{name}@" for name in
                  ("a.usda", "b.usda", "d.usda", "e.usda", "g.png", "h.png", "i.png", "j.png")}
        wanted["./c.usda"] = "@./c.usda@"
        wanted["./f.###.usda"] = '"./f.###.usda"'
        wanted["./k.usda"] = "@./k.usda@</K>"
        self.assertEqual(found, wanted)

    def test_files_of_one_pattern_stay_together_and_no_name_is_given_twice(self):
        for name in ("x/t.1002", "y/t.1001", "y/t.1002", "z/c.1", "z/c.2", "x/c.2"):
            kind = "usda" if "/c" in name else "png"
            front = "#usda 1.0\n# " if kind == "usda" else "\x89PNG\r\n\x1a\n"
            path = self.folder / "lib" / f"{name}.{kind}"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(front.encode("latin-1") + name.encode())
        asset = self.write("asset/a.usda", """#usda 1.0
(
    subLayers = [@../lib/x/c.2.usda@]
)
def "A" (
    clips = {
        dictionary default = {
            string templateAssetPath = "../lib/z/c.#.usda"
        }
    }
)
{
    asset a = @../lib/x/t.1002.png@
    asset b = @../lib/y/t.<UDIM>.png@
    asset c = @../lib/y/t.<UDIM>.png@
}
""")
        self.run_json(asset, "-o", self.package, "--allow-read", self.folder / "lib", code=0)
        with zipfile.ZipFile(self.package) as package:
            names = package.namelist()
            self.assertEqual(len(names), len(set(names)), names)
            text = package.read("a.usda").decode()

            def path_of(pattern, tile=""):
                path = re.search(pattern, text).group(1)
                return package.read(path.removeprefix("./").replace("<UDIM>", tile)
                                    .replace("#", tile)).decode("latin-1")
            self.assertTrue(path_of("asset a = @(.*)@").endswith("x/t.1002"))
            for attribute in "bc":
                for tile in ("1001", "1002"):
                    self.assertTrue(path_of(f"asset {attribute} = @(.*)@", tile)
                                    .endswith(f"y/t.{tile}"))
            for tile in "12":
                self.assertTrue(path_of('templateAssetPath = "(.*)"', tile)
                                .endswith(f"z/c.{tile}"))

    def test_usage(self):
        for arguments in ((HAND,), (HAND, "-o", self.folder / "x.zip"), (HAND, "--list"),
                          (self.folder / "gone.usdz", "--list"),
                          (HAND, "-o", self.package, "--list")):
            self.assertEqual(tenon("zip", *arguments).returncode, 2, arguments)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
