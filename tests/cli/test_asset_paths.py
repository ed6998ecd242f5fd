# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Search paths and the sandbox of the command.

usage: test_asset_paths.py TENON
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
    defaultPrim = "A"
    subLayers = [@../outside/sub.usda@]
)
def "A" (
    references = [@%(outside)s/ref.usda@</R>, @./link.usda@</R>, @./inside.usda@</In>,
                  @file://%(outside)s/uri.usda@</R>]
    payload = @../outside/p.usdz@
)
{
    asset texture = @../outside/t.png@
    asset own = @./own.png@
}
"""
LAYER = '#usda 1.0\n(\n    defaultPrim = "R"\n)\ndef "R"\n{\n    int secret = 1\n}\n'

PAINTED = """#usda 1.0
(
    defaultPrim = "r"
)
def Xform "r"
{
    def Shader "s"
    {
        uniform asset info:mdl:sourceAsset = @OmniPBR.mdl@
        asset inputs:bark = @bark.<UDIM>.png@
        asset inputs:gone = @gone.png@
        asset inputs:skin = @skin.png@
    }
}
"""


class AssetPaths(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = os.path.realpath(self.temporary.name)
        outside = self.path("outside")
        for name in ("sub.usda", "ref.usda", "uri.usda", "lib/found.usda"):
            self.put("outside/" + name, LAYER)
        self.put("outside/t.png", "PNG")
        self.put("in/own.png", "PNG")
        self.put("in/inside.usda", '#usda 1.0\ndef "In"\n{\n    int mine = 1\n}\n')
        self.put("in/root.usda", ROOT % {"outside": outside})
        self.put("in/search.usda", '#usda 1.0\ndef "S" (references = @found.usda@)\n{\n}\n')
        os.symlink(self.path("outside/ref.usda"), self.path("in/link.usda"))
        self.run_tenon("cat", self.path("outside/ref.usda"), "-o", self.path("outside/p.usdz"))

    def tearDown(self):
        self.temporary.cleanup()

    def path(self, name):
        return os.path.join(self.folder, name)

    def put(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def run_tenon(self, *words, **environment):
        return subprocess.run([TENON, *words], capture_output=True, text=True, check=False,
                              env={**os.environ, **environment})

    def test_sandbox_opens_nothing_outside(self):
        free = self.run_tenon("cat", self.path("in/root.usda"), "--flatten")
        self.assertIn("secret", free.stdout)
        run = self.run_tenon("cat", self.path("in/root.usda"), "--flatten", "--sandbox",
                             self.path("in"))
        self.assertNotIn("secret", run.stdout)
        self.assertIn("mine", run.stdout)
        os.remove(self.path("outside/t.png"))  # what lies outside makes no difference
        again = self.run_tenon("cat", self.path("in/root.usda"), "--flatten", "--sandbox",
                               self.path("in"))
        self.assertEqual(again.stdout, run.stdout)

    def test_sandbox_names_layer_and_prim(self):
        run = self.run_tenon("--json", "info", self.path("in/root.usda"), "--sandbox",
                             self.path("in"))
        found = [d for d in json.loads(run.stdout)["diagnostics"] if "outside" in d["message"]]
        self.assertEqual(len(found), 6, found)
        for diagnostic in found:
            self.assertTrue(diagnostic["file"].endswith("root.usda"), diagnostic)
        prims = [diagnostic["prim"] for diagnostic in found]
        self.assertEqual(prims.count("/A"), 5, prims)

    def test_sandbox_keeps_the_root_layer_in(self):
        run = self.run_tenon("tree", self.path("outside/ref.usda"), "--sandbox", self.path("in"))
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("outside", run.stderr)

    def test_search_paths(self):
        asset = self.path("in/search.usda")
        self.assertNotIn("secret", self.run_tenon("cat", asset, "--flatten").stdout)
        lib = self.path("outside/lib")
        option = self.run_tenon("cat", asset, "--flatten", "--search-path", lib)
        self.assertIn("secret", option.stdout)
        variable = self.run_tenon("cat", asset, "--flatten",
                                  PXR_AR_DEFAULT_SEARCH_PATH="/no:" + lib)
        self.assertIn("secret", variable.stdout)

    def test_structure_collects_what_search_paths_lead_to(self):
        self.put("in/painted.usda", PAINTED)
        for name in ("skin.png", "bark.1001.png", "bark.1012.png"):
            self.put("shelf/" + name, "GIF89a" + name)
        run = self.run_tenon("structure", self.path("in/painted.usda"), "-o", self.path("made"),
                             "--search-path", self.path("shelf"), "--json")
        answer = json.loads(run.stdout)
        names = [row["file"] for row in answer["files"] if "Textures" in row["file"]]
        self.assertEqual(names, ["Textures/bark.1001.png", "Textures/bark.1012.png",
                                 "Textures/skin.png"])
        said = [(d["rule"], d["message"]) for d in answer["diagnostics"]]
        self.assertEqual([rule for rule, _ in said], ["structure.asset-missing"], said)
        self.assertIn("@gone.png@", said[0][1])
        with open(self.path("made/payloads/base.usda"), encoding="utf-8") as file:
            text = file.read()
        for name in ("../Textures/skin.png", "../Textures/bark.<UDIM>.png", "gone.png",
                     "OmniPBR.mdl"):
            self.assertIn(f"@{name}@", text)

    def test_structure_keeps_to_what_may_be_read_in_search_paths(self):
        self.put("in/painted.usda", PAINTED)
        self.put("shelf/skin.png", "password=1")
        run = self.run_tenon("structure", self.path("in/painted.usda"), "-o", self.path("made"),
                             "--search-path", self.path("shelf"), "--json")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("read.wrong-kind", run.stdout)
        self.assertFalse(os.path.exists(self.path("made/Textures/skin.png")))

    def test_what_structure_may_not_read_is_told_with_the_file(self):
        self.put("in/painted.usda", PAINTED.replace("@gone.png@", "@/etc/hostname@"))
        run = self.run_tenon("structure", self.path("in/painted.usda"), "-o", self.path("made"))
        self.assertEqual(run.returncode, 1)
        self.assertRegex(run.stderr, r"painted\.usda: error: @/etc/hostname@ is outside")

    def test_a_default_prim_that_is_physics_itself_is_not_structured(self):
        for kind in ("PhysicsPrismaticJoint", "PhysicsFixedJoint", "PhysicsScene",
                     "PhysicsCollisionGroup"):
            self.put("in/part.usda", f'#usda 1.0\n(\n    defaultPrim = "A"\n)\ndef {kind} "A"\n{{\n'
                                     "}\n")
            run = self.run_tenon("structure", self.path("in/part.usda"), "-o", self.path("part"))
            self.assertEqual(run.returncode, 2, kind)
            self.assertIn(kind + ", which is physics itself", run.stderr)
            self.assertFalse(os.path.exists(self.path("part")))


if __name__ == "__main__":
    TENON = os.path.abspath(sys.argv.pop(1))
    unittest.main()
