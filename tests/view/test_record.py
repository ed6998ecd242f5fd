#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon record and view --screenshot without a browser: tests/view/fake_browser.py stands for it.
What real ones draw is in the judge's row `recordings` (tests/view/recordings.py).

    test_record.py ROOT TENON
"""

import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
del sys.argv[1:3]
FAKE = ROOT / "tests/view/fake_browser.py"
JOINT = ROOT / "examples/scenes/joint.usda"
SCENE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Cube "box" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"])
{
    def Camera "eye"
    {
    }
    def Camera "flat"
    {
        token projection = "orthographic"
    }
}
"""


class Record(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = pathlib.Path(kept.name)
        (self.folder / "temporary").mkdir()
        self.scene = self.folder / "scene.usda"
        self.scene.write_text(SCENE, encoding="utf-8")
        if "view.no-page" in self.run_tenon("record", self.scene, "-o", "x.png").stderr:
            self.skipTest("this build has no page: it needs node 18 and npm")
        (self.folder / "x.png").unlink()

    def environment(self, fault="", **more):
        return {**os.environ, "TENON_CHROMIUM": str(FAKE), "TENON_FAKE_BROWSER": fault,
                "TMPDIR": str(self.folder / "temporary"), **more}

    def run_tenon(self, *words, fault="", **more):
        return subprocess.run([TENON, *map(str, words)], capture_output=True, text=True,
                              check=False, timeout=60, cwd=self.folder,
                              env=self.environment(fault, **more))

    def record(self, *words, **more):
        return self.run_tenon("record", self.scene, *words, **more)

    def refused(self, code, said, *words, output="o.png", **more):
        """Ends with the code and these words, and leaves nothing behind."""
        before = sorted(self.folder.rglob("*"))
        done = self.record("-o", output, *words, **more)
        self.assertEqual(done.returncode, code, (words, done.stderr))
        self.assertIn(said, done.stderr, words)
        self.assertEqual(sorted(self.folder.rglob("*")), before, words)
        return done

    def test_files_of_every_kind(self):
        for name, codec in (("a.png", None), ("a.webm", "vp9"), ("a.mp4", "h264")):
            words = ["-o", name] + ([] if codec is None else ["--duration", 0.2, "--fps", 10])
            done = self.record(*words, "--json", "--size", "320x200")
            self.assertEqual(done.returncode, 0, done.stderr)
            told = json.loads(done.stdout)
            self.assertEqual(told["size"], (self.folder / name).stat().st_size)
            self.assertEqual((told["width"], told["height"], told["codec"]), (320, 200, codec))
            self.assertEqual(told["frames"], 1 if codec is None else 2)
            self.assertAlmostEqual(told["duration"], 0 if codec is None else 0.2)
            self.assertEqual(told["browser"], "Fake/1")
        self.assertEqual(list((self.folder / "temporary").iterdir()), [])

    def test_slow_motion_has_more_frames(self):
        done = self.record("-o", "a.webm", "--duration", 0.2, "--fps", 10, "--speed", 0.25,
                           "--json")
        told = json.loads(done.stdout)
        self.assertEqual((told["frames"], told["duration"]), (8, 0.8))

    def test_view_makes_a_picture_too(self):
        done = self.run_tenon("view", self.scene, "--screenshot", "s.png", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "s.png").read_bytes().startswith(b"\x89PNG"))
        done = self.run_tenon("view", self.scene, "--screenshot", "s.webm")
        self.assertEqual(done.returncode, 2)
        self.assertIn("output.kind", done.stderr)

    def test_view_refuses_options_of_the_other_kind(self):
        shot = ["--screenshot", "s.png"]
        flags = {"--watch", "--read-only", "--no-sandbox"}
        for names, words in (
                (("--bind", "--port", "--engine", "--dt", "--watch", "--read-only", "--for"), shot),
                (("--size", "--browser", "--no-sandbox", "--patience"), [])):
            for name in names:
                value = [] if name in flags else ["mujoco" if name == "--engine" else "1"]
                done = self.run_tenon("view", self.scene, *words, name, *value)
                self.assertEqual(done.returncode, 2, (name, done.stdout))
                self.assertIn(f"{name} is of ", done.stderr)
                self.assertFalse((self.folder / "s.png").exists())

    def test_panels_are_those_of_the_report(self):
        done = self.record("-o", "p.png", "--panels")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_options_that_cannot_be(self):
        for said, output, words in (
                ("is no size", "o.png", ["--size", "big"]),
                ("is no size", "o.png", ["--size", "0x100"]),
                ("is no size", "o.png", ["--size", "100x5000"]),
                ("is no size", "o.png", ["--size", "100x100x100"]),
                ("even numbers", "o.webm", ["--size", "101x100"]),
                ("output.kind", "o.gif", []),
                ("output.kind", "-", []),
                ("of films alone", "o.png", ["--duration", 1]),
                ("of films alone", "o.png", ["--turn", 90]),
                ("of films alone", "o.png", ["--codec", "vp9"]),
                ("of pictures alone", "o.webm", ["--time", 1]),
                ("of pictures alone", "o.mp4", ["--panels"]),
                ("holds no h264", "o.webm", ["--codec", "h264"]),
                ("holds no vp8", "o.mp4", ["--codec", "vp8"]),
                ("cannot be transparent", "o.webm", ["--background", "transparent"]),
                ("is not a colour", "o.png", ["--background", "reddish"]),
                ("is not a colour", "o.png", ["--background", "#12345"]),
                ("called walls", "o.png", ["--show", "walls"]),
                ("through a camera", "o.png", ["--panels", "--camera", "/box/eye"]),
                ("elevation", "o.png", ["--elevation", 90]),
                ("100,000 frames", "o.webm", ["--duration", 1, "--speed", 0.0001])):
            with self.subTest(words=words):
                self.refused(2, said, *words, output=output)

    def test_cameras(self):
        done = self.record("-o", "c.png", "--camera", "/box/eye")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.refused(2, "orthographic", "--camera", "/box/flat")
        self.refused(2, "its type is Cube", "--camera", "/box")
        self.refused(2, "no such prim", "--camera", "/nobody")

    def test_browsers_that_fail(self):
        for fault, code, said in (("ends", 2, "planted words"), ("crashes", 2, "crashed"),
                                  ("garbage", 2, "is not understood"), ("webgl", 4, "WebGL"),
                                  ("throws", 2, "planted")):
            with self.subTest(fault=fault):
                self.refused(code, said, fault=fault)
        self.refused(2, "says nothing", "--patience", 0.5, fault="hangs")
        done = self.refused(4, "--codec vp8, --codec av1", "--duration", 0.1, output="o.webm",
                            fault="codec")
        self.assertIn("record.codec", done.stderr)

    def test_without_a_browser_it_says_how_to_get_one(self):
        self.refused(4, "apt-get install chromium", TENON_CHROMIUM="", PATH="/nowhere")
        self.refused(4, "/no/such/browser", TENON_CHROMIUM="/no/such/browser")
        self.refused(4, "/no/such/one", "--browser", "/no/such/one")
        self.refused(4, "scene.usda", "--browser", self.scene)  # no program
        told = json.loads(self.run_tenon("doctor", "--json", TENON_CHROMIUM="",
                                         PATH="/nowhere").stdout)
        browser = next(part for part in told["libraries"] if part["name"] == "browser")
        self.assertFalse(browser["available"])
        self.assertIn("apt-get install chromium", browser["howToGet"])

    def test_what_the_page_says_is_told(self):
        done = self.record("-o", "m.png", fault="message")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("error: planted", done.stderr)
        self.assertNotIn("browser", self.record("-o", "m.png").stderr.replace("fake_browser", ""))

    def test_inputs_stay(self):
        named = self.folder / "in.png"
        named.symlink_to(self.scene)
        before = self.scene.read_bytes()
        done = self.record("-o", "in.png")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(self.scene.read_bytes(), before)

    def test_an_interrupt_leaves_nothing(self):
        process = subprocess.Popen([TENON, "record", str(self.scene), "-o", "i.png"],
                                   cwd=self.folder, env=self.environment("hangs"),
                                   stderr=subprocess.PIPE)
        for _ in range(500):
            if any((self.folder / "temporary").iterdir()):
                break
            time.sleep(0.02)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=30), 130, process.stderr.read())
        process.stderr.close()
        self.assertFalse((self.folder / "i.png").exists())
        self.assertEqual(list((self.folder / "temporary").iterdir()), [])

    def test_layers_are_those_of_the_page(self):
        """What --show and --hide name is in the page, and all of it but what needs a live run."""
        page = (ROOT / "page/src/panel/layers.ts").read_text(encoding="utf-8")
        there = set(re.findall(r'(?:name: |overlay\()"(\w+)"', page))
        told = self.refused(2, "", "--show", "no-such").stderr
        help_text = re.sub(r"\s+", " ", self.run_tenon("help", "record").stdout)
        for name in there - {"contacts", "filtered"}:
            self.assertIn(name, help_text, told)
            self.assertNotIn("called", self.record("-o", "l.png", "--show", name).stderr)


if __name__ == "__main__":
    unittest.main()
