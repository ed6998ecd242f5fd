#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Verbs that write print paths as they were given: absolute ones absolute, relative ones relative.

    test_written_paths.py ROOT TENON
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), str(pathlib.Path(sys.argv[2]).resolve())
PLANTED = ROOT / "tests/cli/error_advice"
# Commands of which the last one is looked at; @NAME is a path, which is given in each way.
VERBS = {
    "convert": "convert @robot.urdf @out.usda",
    "convert into a folder": "convert @robot.urdf @new/",
    "convert --update": "convert @robot.urdf @new/ ; convert @robot.urdf @new/ --update --force",
    "convert to URDF": "convert @scene.usda @out.urdf",
    "convert to MJCF": "convert @scene.usda @out.xml",
    "structure": "structure @scene.usda -o @new",
    "structure --in-place": "structure @scene.usda -o @new ; structure @new/World.usda --in-place",
    "strip": "strip @scene.usda -o @out.usda",
    "strip --output=": "strip @scene.usda --output=@out.usda",
    "strip into a folder": "strip @scene.usda -o @new/",
    "strip --mute": "strip @scene.usda --mute -o @out.usda",
    "cat": "cat @shared.usda --flatten -o @out.usda",
    "dump": "dump @scene.usda -o @out.json",
    "zip": "zip @scene.usda -o @out.usdz",
    "zip --extract": "zip @scene.usda -o @out.usdz ; zip @out.usdz --extract @new",
    "variant": "variant @parts/part.usda Kind=soft -o @out.usda",
    "variant --in-place": "variant @parts/part.usda Kind=soft --in-place",
    "sim": "sim @scene.usda --engine mujoco --duration 0.01 -o @out.csv --state-out @out.state",
    "bake": "bake @scene.usda --engine mujoco --duration 0.01 -o @out.usda",
    "report": "report @scene.usda -o @out.html --duration 0",
    "check --fix": "check @scene.usda --fix",
    "check --sarif": "check @scene.usda --sarif @out.sarif --write-baseline @out.json",
    "new": "new @out.usda",
    "add": "add @scene.usda /World/New=cube",
    "set": "set @shared.usda /World/One/Shape.size=2",
    "remove": "remove @scene.usda /World/Six",
    "rename": "rename @scene.usda /World/Box Crate",
    "undo": "rename @scene.usda /World/Box Crate ; undo @scene.usda",
}
# How a path is given, and where from: the working folder, and what is put before a name.
WAYS = {
    "relative": ("here", ""),
    "relative, with a dot": ("here", "./"),
    "relative, from beside": ("beside", "../here/"),
    "absolute": ("here", "{here}/"),
    "absolute, from beside": ("beside", "{here}/"),
    "absolute, from below": ("here/parts", "{here}/"),
}


# Fields of JSON that hold paths; in packages `name` is one of the package.
FIELDS = ("asset", "file", "folder", "output")


def paths(value, key=""):
    """-> all texts in fields of a JSON value that hold paths, and messages."""
    if isinstance(value, dict):
        for name, inner in value.items():
            yield from paths(inner, name)
    elif isinstance(value, list):
        for inner in value:
            yield from paths(inner, key)
    elif isinstance(value, str) and key in (*FIELDS, "message", "fix"):
        yield value


class WrittenPaths(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, self.folder)

    def printed(self, command, way, as_json):
        """-> the folder of the files, and the texts that the last command prints."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        here = folder / "here"
        shutil.copytree(PLANTED, here)
        (folder / "beside").mkdir()
        cwd, before = WAYS[way]
        before = before.format(here=here)
        for part in command.split(" ; "):
            words = [word.replace("@", before) for word in part.split()]
            process = subprocess.run([TENON, *words, *(["--json"] if as_json else [])],
                                     cwd=folder / cwd, capture_output=True, text=True, timeout=120)
            self.assertIn(process.returncode, (0, 1), f"{words}: {process.stderr}")
        if not as_json:
            return here, before, (process.stdout + process.stderr).splitlines()
        answer = json.loads(process.stdout) if process.stdout else {}  # of dump it is the output
        return here, before, [*paths(answer), *process.stderr.splitlines()]

    def look(self, command, way, as_json):
        here, before, texts = self.printed(command, way, as_json)
        for text in texts:
            if way.startswith("absolute"):
                self.assertNotIn("../", text)
                for name in re.findall(r"@(\S+?\.\w+|new)", command):
                    at = text.find(name)
                    if at >= 0 and re.search(r"(?:^|[ @])" + re.escape(name), text):
                        self.assertNotRegex(text, r"(?:^|[ @])" + re.escape(name), text)
            else:
                self.assertNotIn(str(here), text)
                if before == "../here/":
                    self.assertNotRegex(text, r"\.\./\.\./")
                else:
                    self.assertNotIn("../", text)

    def test_paths_are_printed_as_they_are_given(self):
        for verb, command in VERBS.items():
            for way in WAYS:
                for as_json in (False, True):
                    with self.subTest(verb, way=way, as_json=as_json):
                        self.look(command, way, as_json)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
