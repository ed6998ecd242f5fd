#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Values of composed stages that are rare, as OpenUSD 26.11 gives them.

usage: test_composed_values.py TENON
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

TENON = sys.argv[1]


def tenon(*arguments):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False)  # fmt: skip


class ComposedValues(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = self.folder / name
        path.write_text("#usda 1.0\n" + text)
        return path

    def values(self, asset, attribute, *times):
        run = tenon("test-runner", "value", asset, attribute, *times)
        return list(json.loads(run.stdout).values())

    def test_negative_time_codes_per_second_turn_time_around(self):
        self.write("sub.usda", 'def "A" {\n double x.timeSamples = { 0: 0, 10: 10, 24: 24 }\n'
                   " timecode t = 5\n}\n")  # fmt: skip
        for text, factor in [("(timeCodesPerSecond = -24\nsubLayers = [@./sub.usda@])\n", 1),
                             ("(timeCodesPerSecond = -48\n)\ndef \"A\" "
                              "(references = @./sub.usda@</A>) {\n}\n", 2)]:  # fmt: skip
            root = self.write("root.usda", text)
            times = [-30 * factor, -24 * factor, -10 * factor, -5 * factor, 0, 10]
            self.assertEqual(self.values(root, "/A.x", *times), [24, 24, 10, 0, 0, 0])
            self.assertEqual(self.values(root, "/A.t", 1), [-5 * factor])

    def test_prims_of_abstract_types_have_no_place_in_the_world(self):
        asset = self.write("a.usda", 'def Gprim "A" {\n double3 xformOp:translate = (5, 0, 0)\n'
                           ' uniform token[] xformOpOrder = ["xformOp:translate"]\n'
                           ' def Xform "B" {\n }\n}\n')  # fmt: skip
        prims = tenon("dump", "--xforms", asset).stdout
        self.assertEqual(prims.count('"localToWorld"'), 1)

    def test_two_blocks_of_one_variant_are_merged_and_told(self):
        """OpenUSD loses opinions of the first block without a word (CONFORMANCE.md)."""
        asset = self.write("a.usda", 'def "A" (\n variants = { string v = "x" }\n'
                           ' variantSets = "v"\n)\n{\n variantSet "v" = {\n'
                           ' "x" {\n  double a = 1\n  double b = 1\n }\n'
                           ' "x" {\n  double b = 2\n  double c = 2\n }\n }\n}\n')  # fmt: skip
        for name, value in (("a", 1), ("b", 2), ("c", 2)):
            self.assertEqual(self.values(asset, f"/A.{name}", "default"), [value], name)
        self.assertIn("given twice; both blocks are merged", tenon("info", asset).stderr)

    def test_flattening_writes_no_text_that_cannot_be_read(self):
        """A value of one layer under the type of another: text has no words for it, binary has."""
        self.write("weak.usda", 'def "A" {\n double a = 1\n double b = 2\n double c = 3\n'
                   " double d.timeSamples = { 0: 1 }\n}\n")  # fmt: skip
        clip = self.write("clip.usda", 'def "A" {\n double e.timeSamples = { 0: 1 }\n}\n')
        clips = (f"clips = {{\n dictionary default = {{\n asset[] assetPaths = [@./{clip.name}@]\n"
                 ' string primPath = "/A"\n double2[] active = [(0, 0)]\n}\n}\n')
        for line, flags in [("matrix4d a", ["--flatten", "--flatten-layer-stack"]),
                            ("string b", ["--flatten", "--flatten-layer-stack"]),
                            ("double[] c", ["--flatten", "--flatten-layer-stack"]),
                            ("token d", ["--flatten", "--flatten-layer-stack"]),
                            ("string e", ["--flatten"])]:  # fmt: skip
            root = self.write("root.usda", "(subLayers = [@./weak.usda@])\n"
                              f'over "A" ({clips}) {{\n {line}\n}}\n')  # fmt: skip
            for flag in flags:
                with self.subTest(line, flag=flag):
                    run = tenon("cat", flag, root, "-o", self.folder / "out.usda")
                    self.assertEqual(run.returncode, 2, run.stderr)
                    self.assertIn("no text form", run.stderr)
                    self.assertFalse((self.folder / "out.usda").exists())
                    run = tenon("cat", flag, root, "-o", self.folder / "out.usdc")
                    self.assertEqual(run.returncode, 0, run.stderr)
        root = self.write("root.usda", '(subLayers = [@./weak.usda@])\nover "A" {\n double a\n}\n')
        self.assertEqual(tenon("cat", "--flatten", root).returncode, 0)

    def test_flattening_anchors_what_a_package_does_not_have(self):
        with zipfile.ZipFile(self.folder / "p.usdz", "w") as package:
            package.writestr("a.usda", "#usda 1.0\n")
        asset = self.write("a.usda", 'def "A" {\n asset a = @p.usdz[t.<UDIM>.png]@\n'
                           " asset b = @none.usdz[t.png]@\n"
                           " asset c = @t.<UDIM>.png@\n}\n")  # fmt: skip
        text = tenon("cat", "--flatten", asset).stdout
        self.assertIn(f"asset a = @{self.folder}/p.usdz[t.<UDIM>.png]@", text)
        self.assertIn("asset b = @none.usdz[t.png]@", text)
        self.assertIn("asset c = @t.<UDIM>.png@", text)

    def test_indices_are_dumped_with_a_session_layer(self):
        asset = self.write("a.usda", 'def "A" {\n}\n')
        session = self.write("s.usda", 'over "A" (references = </C>) {\n}\nclass "C" {\n}\n')
        for command in (["dump-index"], ["test-runner", "composition"]):
            self.assertNotIn("s.usda", tenon(*command, asset).stdout)
            run = tenon(*command, asset, "--session", session)
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn("s.usda", run.stdout)

    def test_knots_that_nothing_can_read_again_are_refused(self):
        knots = ["0: inf", "0: 3 & inf", "0: nan & 1", "0: 1; pre (-1, 2)", "0: 1; pre (inf, 2)",
                 "0: 1; post curve (1, nan)"]  # fmt: skip
        cases = [("double", knot) for knot in knots] + [("half", "0: 70000"), ("float", "0: 1e40")]
        for kind, knot in cases:
            asset = self.write("a.usda", f'def "A" {{\n {kind} s.spline = {{ {knot} }}\n}}\n')
            run = tenon("cat", asset)
            self.assertEqual(run.returncode, 2, (kind, knot))
            self.assertIn("a.usda:3:", run.stderr)

    def test_knots_have_the_precision_of_their_type(self):
        asset = self.write("a.usda", 'def "A" {\n half h.spline = { 0: 0.1; post held, }\n}\n')
        self.assertAlmostEqual(self.values(asset, "/A.h", 0)[0], 0.0999755859375, 8)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
