#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What `tenon record` makes with a real Chromium, decoded by another program (ffmpeg): sizes,
frames, durations, that something is seen where it should be and lit alike wherever it is, that a
film moves, that two runs of a picture are the same bytes, that the browser has nothing to say, and
what comes of one that fails.

    recordings.py ROOT TENON

Exit 0: all good; 1: a line for each fault; 77: no Chromium or no ffmpeg here.
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import numpy

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
GRASP = ROOT / "examples/inspire_hand/grasp.usda"
SCENES = [GRASP, ROOT / "examples/inspire_hand/inspire_hand.usda",
          *sorted((ROOT / "examples/scenes").glob("*.usda"))]
WIDTH, HEIGHT = 320, 240
COLOURED = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Sphere "ball"
{
    color3f[] primvars:displayColor = [(1, 0, 0)]
}
def Camera "behind"
{
    double3 xformOp:translate = (0, 0, 9)
    float xformOp:rotateX = 180
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
def Camera "above"
{
    double3 xformOp:translate = (0, 0, 9)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""

PLACED = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{{
    double3 xformOp:translate = ({x}, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Sphere "ball" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        double radius = 0.5
        {look}
    }}
    def Material "Metal"
    {{
        token outputs:surface.connect = </World/Metal/Shader.outputs:surface>
        def Shader "Shader"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.9, 0.9, 0.9)
            float inputs:metallic = 1
            float inputs:roughness = 0.2
            token outputs:surface
        }}
    }}
}}
"""
LOOKS = {"coloured": "color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)]", "plain": "",
         "metal": "rel material:binding = </World/Metal>"}
FLOORED = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "World"
{
    def Cube "box"
    {
        double size = 0.1
        color3f[] primvars:displayColor = [(1, 0, 0)]
        double3 xformOp:translate = (0, 0, 0.05)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Cube "floor"
    {
        double size = 1
        color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)]
        float3 xformOp:scale = (20, 20, 0.1)
        double3 xformOp:translate = (0, 0, -0.05)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
    }
}
"""


class Recordings:
    def __init__(self, folder):
        self.folder, self.faults, self.made = folder, [], 0

    def hold(self, well, what):
        if not well:
            self.faults.append(what)

    def record(self, asset, name, *words, code=0, verb=("record",)):
        """-> (the file, what is told); nothing but the findings of the asset is said."""
        path = self.folder / name
        out = ["-o"] if verb == ("record",) else []
        done = subprocess.run([TENON, verb[0], str(asset), *verb[1:], *out, str(path), "--json",
                               *map(str, words)], capture_output=True, text=True, check=False,
                              timeout=600)
        self.made += 1
        told = json.loads(done.stdout)
        said = [one["message"] for one in told["diagnostics"] if one["rule"].startswith("browser.")]
        self.hold(done.returncode == code, f"{name}: exit {done.returncode}: {done.stdout[-600:]}")
        self.hold(code != 0 or not said, f"{name}: {said}")
        return path, told

    def pixels(self, path, count=None, channels="rgb24"):
        """All frames: (n, height, width, channels)."""
        depth = 4 if channels == "rgba" else 3
        raw = subprocess.run(["ffmpeg", "-v", "error", "-i", str(path), "-f", "rawvideo",
                              "-pix_fmt", channels, "-"], capture_output=True, check=False)
        self.hold(not raw.stderr, f"{path.name}: {raw.stderr.decode()[-300:]}")
        frames = numpy.frombuffer(raw.stdout, numpy.uint8)
        self.hold(frames.size % (WIDTH * HEIGHT * depth) == 0 and frames.size > 0,
                  f"{path.name}: is of another size")
        frames = frames[:frames.size // (WIDTH * HEIGHT * depth) * WIDTH * HEIGHT * depth]
        frames = frames.reshape(-1, HEIGHT, WIDTH, depth).astype(int)
        self.hold(count is None or len(frames) == count,
                  f"{path.name}: {len(frames)} frames, not {count}")
        return frames

    def pictures(self):
        for asset in SCENES:
            name = asset.stem
            first, told = self.record(asset, f"{name}.png", "--size", f"{WIDTH}x{HEIGHT}")
            second, _ = self.record(asset, f"{name}_again.png", "--size", f"{WIDTH}x{HEIGHT}")
            self.hold(first.read_bytes() == second.read_bytes(), f"{name}: two runs, two pictures")
            self.hold(told["triangles"] > 0, f"{name}: no triangles")
            self.hold(self.pixels(first, 1)[0].std(axis=(0, 1)).max() > 3, f"{name}: is blank")

    def looks(self):
        """Options change what they say."""
        scene = self.folder / "ball.usda"
        scene.write_text(COLOURED, encoding="utf-8")
        size = ("--size", f"{WIDTH}x{HEIGHT}")
        clear, _ = self.record(scene, "clear.png", "--background", "transparent", "--hide", "grid",
                               *size)
        pixels = self.pixels(clear, 1, "rgba")[0]
        alpha = pixels[..., 3]
        seen = (alpha > 128).mean()
        # The box around it fits: its sphere takes half of the height or more, pi / 16 * 3 / 4.
        self.hold(0.15 < seen < 0.6, f"clear: {seen:.3f} of the picture is ball")
        self.hold(alpha[0, 0] == 0 and alpha[HEIGHT // 2, WIDTH // 2] == 255, "clear: is not clear")
        red, green, blue, _ = pixels[HEIGHT // 2, WIDTH // 2]
        self.hold(red > 2 * green and red > 2 * blue,
                  f"clear: is not red: {red} {green} {blue}")
        far, _ = self.record(scene, "far.png", "--background", "transparent", "--hide", "grid",
                             "--zoom", 0.5, *size)
        smaller = (self.pixels(far, 1, "rgba")[0][..., 3] > 128).mean()
        self.hold(0.18 < smaller / seen < 0.3, f"far: {smaller / seen:.3f} of the size")
        green, _ = self.record(scene, "green.png", "--background", "#00ff00", "--hide",
                               "grid,visuals", *size)
        self.hold((self.pixels(green, 1)[0] == [0, 255, 0]).all(), "green: is not all green")
        for camera, there in (("/above", True), ("/behind", False)):
            path, _ = self.record(scene, f"{camera[1:]}.png", "--camera", camera, "--background",
                                  "transparent", "--hide", "grid", *size)
            at_middle = self.pixels(path, 1, "rgba")[0][HEIGHT // 2, WIDTH // 2, 3]
            self.hold((at_middle == 255) == there, f"{camera}: {at_middle} in the middle")
        plain, _ = self.record(GRASP, "plain.png", *size)
        for name in ("colliders", "joints", "limits", "masses", "inertia", "frames", "tree"):
            path, _ = self.record(GRASP, f"{name}.png", "--show", name, *size)
            self.hold((self.pixels(path, 1) != self.pixels(plain, 1)).mean() > 0.001,
                      f"--show {name} changes nothing")
        marked, _ = self.record(GRASP, "marked.png", "--select", "/World/can", *size)
        self.hold((self.pixels(marked, 1) != self.pixels(plain, 1)).mean() > 0.01,
                  "--select changes nothing")
        later, _ = self.record(GRASP, "later.png", "--time", 1.5, *size)
        self.hold((self.pixels(later, 1) != self.pixels(plain, 1)).mean() > 0.01,
                  "--time changes nothing")
        shot, _ = self.record(GRASP, "shot.png", *size, verb=("view", "--screenshot"))
        self.hold((self.pixels(shot, 1) == self.pixels(plain, 1)).all(),
                  "view --screenshot is not record")
        self.record(GRASP, "panels.png", "--panels", "--time", 0.5, "--size", "1000x600")
        self.record(GRASP, "nothing.png", "--look-at", "/World/none", *size, code=2)
        self.hold(not (self.folder / "nothing.png").exists(), "a picture of nothing was written")

    def light(self):
        """A ball is as bright far from the origin as in it, from all sides, and never black."""
        scene = self.folder / "placed.usda"
        for look, said in LOOKS.items():
            for azimuth in (0, 90, 180, 270):
                means = []
                for x in (0, 20):
                    scene.write_text(PLACED.format(x=x, look=said), encoding="utf-8")
                    path, _ = self.record(scene, "placed.png", "--background", "transparent",
                                          "--hide", "grid", "--azimuth", azimuth, "--elevation",
                                          10, "--size", f"{WIDTH}x{HEIGHT}")
                    pixels = self.pixels(path, 1, "rgba")[0]
                    means.append(pixels[pixels[..., 3] == 255][..., :3].mean())
                self.hold(abs(means[0] - means[1]) <= 1, f"{look}, {azimuth}: {means}")
                self.hold(70 < means[0] < 235, f"{look}, {azimuth}: brightness {means[0]:.0f}")
        levels = len(numpy.unique(pixels[..., 3]))
        self.hold(levels > 8, f"edges have {levels} levels: they are not smooth")

    def frames(self):
        """A ground does not make what stands on it a dot."""
        scene = self.folder / "floored.usda"
        scene.write_text(FLOORED, encoding="utf-8")
        path, _ = self.record(scene, "floored.png", "--size", f"{WIDTH}x{HEIGHT}")
        red, green, _ = numpy.moveaxis(self.pixels(path, 1)[0], -1, 0)
        share = (red > 2 * green).mean()
        self.hold(share > 0.1, f"the box on the floor is {share:.4f} of the picture")

    def films(self):
        for name, words in (("a.webm", []), ("b.webm", ["--codec", "vp8"]),
                            ("c.webm", ["--codec", "av1"]), ("d.mp4", []),
                            ("e.mp4", ["--codec", "vp9"]), ("f.webm", ["--turn", 90])):
            path, told = self.record(GRASP, name, "--duration", 1, "--fps", 15, "--size",
                                     f"{WIDTH}x{HEIGHT}", *words)
            if not path.exists():
                continue
            frames = self.pixels(path, 15)
            probed = json.loads(subprocess.run(
                ["ffprobe", "-v", "error", "-show_streams", "-show_format", "-of", "json",
                 str(path)], capture_output=True, check=True).stdout)
            stream = probed["streams"][0]
            self.hold((stream["width"], stream["height"]) == (WIDTH, HEIGHT), f"{name}: size")
            self.hold(abs(float(probed["format"]["duration"]) - 1) < 0.04,
                      f"{name}: {probed['format']['duration']} s")
            self.hold(stream["codec_name"] == told["codec"], f"{name}: {stream['codec_name']}")
            self.hold(frames[0].std() > 5, f"{name}: is blank")
            moved = (abs(frames[-1] - frames[0]).max(axis=-1) > 40).mean()
            self.hold(moved > (0.05 if "--turn" in words else 0.005), f"{name}: stands still")
            # The first frame is the picture of the start, as far as the codec keeps it.
            start, _ = self.record(GRASP, "start.png", "--size", f"{WIDTH}x{HEIGHT}")
            apart = abs(frames[0] - self.pixels(start, 1)[0]).mean()
            self.hold(apart < 6, f"{name}: begins {apart:.1f} away from the picture")


    def failures(self, browser, place):
        """A browser without WebGL, and one that is killed at work: a message, and no file."""
        blind = self.folder / "blind"
        blind.write_text(f'#!/bin/sh\nexec {browser} "$@" --disable-3d-apis\n')
        blind.chmod(0o755)
        path, told = self.record(GRASP, "blind.png", "--browser", blind, code=4)
        self.hold(told["diagnostics"][-1]["rule"] == "browser.webgl", f"blind: {told}")
        self.hold(not path.exists(), "blind: a file was written")
        film = self.folder / "killed.webm"
        process = subprocess.Popen([TENON, "record", str(GRASP), "-o", str(film), "--duration",
                                    "60"], stderr=subprocess.PIPE, text=True)
        for _ in range(600):
            if browsers := [pid for pid in processes() if of_browser(pid, place)]:
                time.sleep(2)  # it draws
                os.kill(browsers[0], signal.SIGKILL)
                break
            time.sleep(0.1)
        said = process.communicate(timeout=120)[1]
        self.made += 1
        self.hold(process.returncode == 2 and "browser.ended" in said, f"killed: {said[-300:]}")
        self.hold(not film.exists(), "killed: a file was written")


def processes():
    return sorted(int(name) for name in os.listdir("/proc") if name.isdigit())


def of_browser(pid, place):
    """The first process of a browser whose profile is below `place`."""
    try:
        words = pathlib.Path(f"/proc/{pid}/cmdline").read_bytes().decode().split("\0")
    except (OSError, UnicodeDecodeError):
        return False
    return ("--remote-debugging-pipe" in words
            and any(word.startswith(f"--user-data-dir={place}") for word in words)
            and not any(word.startswith("--type=") for word in words))


def main():
    found = json.loads(subprocess.run([TENON, "doctor", "--json"], capture_output=True,
                                      check=False).stdout)
    browser = next(part for part in found["libraries"] if part["name"] == "browser")
    if not browser["available"] or not shutil.which("ffmpeg"):
        print(browser["howToGet"] or "install ffmpeg")
        return 77
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as place:
        os.environ["TMPDIR"] = os.environ["HOME"] = place
        recordings = Recordings(pathlib.Path(folder))
        recordings.pictures()
        recordings.looks()
        recordings.light()
        recordings.frames()
        recordings.films()
        recordings.failures(browser["version"], place)
        recordings.hold(not os.listdir(place), f"left behind: {os.listdir(place)}")
    for fault in recordings.faults:
        print(fault)
    print(f"{recordings.made} recordings by {browser['version']} decoded, "
          f"{len(recordings.faults)} faults")
    return 1 if recordings.faults else 0


if __name__ == "__main__":
    sys.exit(main())
