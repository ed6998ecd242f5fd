# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The Python of docs/cookbook.md prints what the page shows, run in order behind its commands.

    test_cookbook.py           compares
    test_cookbook.py --write   writes what is printed into the page
"""

import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import tenon_usd

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/cookbook.md"
BLOCK = re.compile(r"^```console\n(?P<console>.*?)^```$"
                   r"|^```python\n(?P<python>.*?)^```\n\n```text\n(?P<shown>.*?)^```$", re.M | re.S)
PROGRAMS = pathlib.Path(tenon_usd.__file__).parent / "bin"


def run_console(block):
    environment = {**os.environ, "PATH": f"{PROGRAMS}:{os.environ['PATH']}"}
    for line in block.split("\n"):
        if line.startswith("$ "):
            subprocess.run(["bash", "-c", line[2:]], env=environment, capture_output=True,
                           check=False)


def run_python(block):
    """What a block prints."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(compile(block, str(PAGE), "exec"), {"__name__": "cookbook"})
    return printed.getvalue()


def replayed(text):
    """The page with what its blocks of Python print now."""
    def replay(match):
        if match["python"] is None:
            run_console(match["console"])
            return match[0]
        return f"```python\n{match['python']}```\n\n```text\n{run_python(match['python'])}```"
    return BLOCK.sub(replay, text)


def replay_in_folder():
    before, folder = os.getcwd(), tempfile.mkdtemp()
    try:
        for name in ("inspire_hand", "scenes", "cpp/robots", "sweep"):
            shutil.copytree(ROOT / "examples" / name, f"{folder}/examples/{name}")
        os.chdir(folder)
        return replayed(PAGE.read_text(encoding="utf-8"))
    finally:
        os.chdir(before)
        shutil.rmtree(folder)


class Cookbook(unittest.TestCase):
    def test_it_is_as_shown(self):
        text = PAGE.read_text(encoding="utf-8")
        self.assertEqual(text.count("```python"), len(re.findall(r"^```text$", text, re.M)))
        self.assertEqual(len(re.findall(r"^## \d+\. ", text, re.M)), 20)
        self.assertEqual(replay_in_folder(), text)


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        PAGE.write_text(replay_in_folder(), encoding="utf-8")
    else:
        unittest.main()
