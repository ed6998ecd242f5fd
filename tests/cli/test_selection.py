#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What of a scene is composed: --load, --unloaded, --mask and --mute-layer.

usage: test_selection.py TENON
"""

import json
import os
import subprocess
import sys
import tempfile
import unittest

TENON = ""
ROOT = """#usda 1.0
(
    subLayers = [@./sub/weak.usda@]
)
def "A" (payload = @./payload.usda@</P>)
{
    def "Own" (payload = @./payload.usda@</P>)
    {
    }
}
def "B" (payload = @./payload.usda@</P>)
{
}
def "C" (references = @./payload.usda@</P>)
{
}
"""
WHOLE = ["/A", "/A/Own", "/A/Own/Kid", "/A/Kid", "/B", "/B/Kid", "/C", "/C/Kid", "/Weak"]


class Selection(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = os.path.realpath(temporary.name)
        self.root = self.put("root.usda", ROOT)
        self.put("sub/weak.usda", '#usda 1.0\ndef "Weak"\n{\n}\n')
        self.put("payload.usda", '#usda 1.0\ndef "P"\n{\n    def "Kid"\n    {\n    }\n}\n')

    def put(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def run_tenon(self, *words, folder=None):
        return subprocess.run([TENON, *words], capture_output=True, text=True, check=False,
                              cwd=folder or self.folder)

    def prims(self, *options, folder=None):
        done = self.run_tenon("tree", self.root, "--json", *options, folder=folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return sorted(prim["path"] for prim in json.loads(done.stdout)["prims"])

    def without(self, *left_out):
        return sorted(path for path in WHOLE if path not in left_out)

    def test_payloads_are_loaded_as_asked(self):
        for options in ((), ("--load", "all")):
            self.assertEqual(self.prims(*options), sorted(WHOLE))
        for options in (("--load", "none"), ("--unloaded",)):
            self.assertEqual(self.prims(*options), self.without("/A/Own/Kid", "/A/Kid", "/B/Kid"))
        self.assertEqual(self.prims("--load", "/B"), self.without("/A/Own/Kid", "/A/Kid"))
        self.assertEqual(self.prims("--load", "/A"), self.without("/B/Kid"))
        self.assertEqual(self.prims("--load", "/A/Own,/B"), sorted(WHOLE))

    def test_a_muted_layer_is_as_absent(self):
        sub = os.path.join(self.folder, "sub")
        for name in ("sub/weak.usda", "./sub/weak.usda", os.path.join(sub, "weak.usda")):
            self.assertEqual(self.prims("--mute-layer", name), self.without("/Weak"))
        for folder, name in (("/", "sub/weak.usda"), (sub, "weak.usda")):
            self.assertEqual(self.prims("--mute-layer", name, folder=folder), self.without("/Weak"))
        kids = ("/A/Own/Kid", "/A/Kid", "/B/Kid", "/C/Kid")
        self.assertEqual(self.prims("--mute-layer", "payload.usda,sub/weak.usda"),
                         self.without("/Weak", *kids))

    def test_a_mask_and_loading_together(self):
        self.assertEqual(self.prims("--mask", "/A,/C", "--load", "none"),
                         ["/A", "/A/Own", "/C", "/C/Kid"])

    def test_what_is_no_path_is_refused(self):
        for options in (("--load", "A"), ("--load", "/A.x"), ("--load", "none,/A")):
            done = self.run_tenon("tree", self.root, *options)
            self.assertNotEqual(done.returncode, 0, options)
            self.assertIn("is not the path of a prim", done.stderr)

    def test_other_verbs_understand_the_same(self):
        flat = self.run_tenon("cat", self.root, "--load", "none", "--mute-layer", "sub/weak.usda")
        self.assertNotIn("Weak", flat.stdout)
        self.assertEqual(flat.stdout.count('"Kid"'), 1)
        dump = self.run_tenon("dump", self.root, "--load", "/B")
        self.assertNotIn("/A/Kid", json.loads(dump.stdout)["prims"])
        self.assertIn("/B/Kid", json.loads(dump.stdout)["prims"])
        index = self.run_tenon("dump-index", self.root, "--mute-layer", "sub/weak.usda")
        self.assertNotIn("weak.usda", index.stdout)


if __name__ == "__main__":
    TENON = os.path.abspath(sys.argv.pop(1))
    unittest.main()
