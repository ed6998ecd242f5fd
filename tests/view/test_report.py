#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon report: one page that asks the network for nothing, whose data is what the other verbs say,
and in which no text of an asset is markup.

usage: test_report.py TENON
"""

import base64
import gzip
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from glb_file import Glb

TENON = sys.argv.pop(1)
ROOT = pathlib.Path(__file__).resolve().parents[2]
GRASP = ROOT / "examples/inspire_hand/grasp.usda"
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
VENDORS_HAND = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"  # 120,000 triangles
EVIL = "</script><img src=x onerror=alert(1)>"
HOSTILE = f"""#usda 1.0
(
    defaultPrim = "World"
    doc = "{EVIL}"
    metersPerUnit = 1
)
def Xform "World" (
    displayName = "{EVIL}"
)
{{
    def Sphere "ball" (
        displayName = "{EVIL}"
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "NoSuch<b>API"]
    )
    {{
        custom string note = "{EVIL}"
    }}
    def PhysicsRevoluteJoint "hinge"
    {{
        rel physics:body1 = </World/gone>
    }}
}}
"""


def tenon(*arguments, **options):
    return subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                          check=False, timeout=120, **options)


def unpacked(text):
    """Seven bits in a character, the highest first, 256 higher where HTML would read it."""
    bits = "".join(f"{ord(character) & 255:07b}" for character in text)
    return bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits) - len(bits) % 8, 8))


class Page:
    def __init__(self, text):
        self.text = text
        self.slots = {}
        slot = r'<script type="[^"]*" id="(tenon-\w+)" data-coding="(\w*)">([^<]*)</script>'
        for name, coding, content in re.findall(slot, text):
            data = unpacked(content)
            self.slots[name] = gzip.decompress(data) if coding == "gzip" else data
        # What is left is the frame, which comes from us.
        self.frame = re.sub(slot, "", text)


class Report(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)

    def report(self, asset, *arguments, name="r.html"):
        done = tenon("report", asset, "-o", self.folder / name, *arguments)
        if "view.no-page" in done.stderr:
            self.skipTest("this build has no page: it needs node 18 and npm")
        self.assertEqual(done.returncode, 0, done.stderr)
        return Page((self.folder / name).read_text(encoding="utf-8"))

    def test_it_needs_nothing_else(self):
        page = self.report(GRASP, "--duration", 1)
        self.assertEqual(re.findall(r"(?:https?:)?//[a-z]", page.frame), [])
        self.assertEqual(re.findall(r"\b(?:src|href)=", page.frame), [])
        self.assertLess(len(page.text.encode()), 350_000)

    def test_its_policy_knows_its_own_script_alone(self):
        page = self.report(GRASP, "--duration", 0)
        policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page.text).group(1)
        self.assertTrue(policy.startswith("default-src 'none'; "), policy)
        scripts = re.findall(r"<script[^>]*>(.*?)</script>", page.frame, re.S)
        self.assertEqual(len(scripts), 1)
        digest = base64.b64encode(hashlib.sha256(scripts[0].encode()).digest()).decode()
        self.assertIn(f"'sha256-{digest}'", policy)
        self.assertNotIn("unsafe-inline", policy)

    def test_the_picture_is_the_file_that_bake_writes(self):
        page = self.report(GRASP, "--duration", 0.5)
        said = Glb(page.slots["tenon-scene"]).json["scenes"][0]["extras"]["tenon"]
        scene = json.loads(tenon("physics", GRASP, "--json").stdout)
        self.assertEqual([body["path"] for body in said["bodies"]],
                         [body["path"] for body in scene["bodies"]])

    def test_findings_and_masses_are_those_of_the_other_verbs(self):
        page = self.report(GRASP, "--duration", 0)
        data = json.loads(page.slots["tenon-data"])
        found = json.loads(tenon("check", GRASP, "--json").stdout)
        text = json.dumps(data)
        for finding in found["diagnostics"]:
            self.assertIn(json.dumps(finding["message"])[1:-1], text)

    def test_text_of_an_asset_is_never_markup(self):
        (self.folder / "evil.usda").write_text(HOSTILE, encoding="utf-8")
        tenon("report", self.folder / "evil.usda", "-o", self.folder / "e.html")
        page = Page((self.folder / "e.html").read_text(encoding="utf-8"))
        self.assertNotIn("onerror", page.text)
        self.assertNotIn("<b>", page.text)
        named = self.folder / "<img src=x>.usda"
        named.write_text('#usda 1.0\ndef Xform "A" {}\n', encoding="utf-8")
        page = self.report(named, "--duration", 0, name="n.html")
        self.assertNotIn("<img", page.text)

    def test_the_same_run_gives_the_same_bytes(self):
        one = self.report(GRASP, "--duration", 0.2, name="a.html")
        other = self.report(GRASP, "--duration", 0.2, name="b.html")
        self.assertEqual(one.text, other.text)

    @unittest.skipUnless(VENDORS_HAND.exists(), "the vendor's hand is not there")
    def test_a_hand_in_full_can_be_mailed(self):
        run = ("--duration", 10, "--fps", 30)
        full = self.report(VENDORS_HAND, *run, name="full.html")
        self.assertLess(len(full.text.encode()), 550_000)
        thin = self.report(VENDORS_HAND, *run, "--simplify", 30000, name="thin.html")
        self.assertLess(len(thin.text.encode()), 350_000)

    def test_without_the_page_it_says_how_to_get_it(self):
        done = tenon("report", GRASP, "-o", self.folder / "r.html",
                     env={"TENON_PAGE": str(self.folder / "none"), "PATH": "/usr/bin:/bin"})
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("npm", done.stderr)
        self.assertFalse((self.folder / "r.html").exists())


if __name__ == "__main__":
    unittest.main()
