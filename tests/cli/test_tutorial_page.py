#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A page with commands is true: each command of its console blocks, run in order in one folder
beside a copy of the examples, prints what the page shows and ends as it says. A command that fails
is refused unless the block is marked as meant to (tools/check_snippets.py).

    test_tutorial_page.py ROOT TENON PAGE           compares
    test_tutorial_page.py ROOT TENON PAGE --write   writes what the commands print into the page
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(sys.argv[1], "tools"))
import check_snippets

ROOT, TENON = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
PAGE = ROOT / sys.argv[3]
BLOCK = re.compile(r"^```console\n(.*?)^```$", re.M | re.S)


def commands_of(block):
    """The lines after "$ "."""
    return [line[2:] for line in block.split("\n") if line.startswith("$ ")]


def run(command, folder):
    """What a reader sees; an exit code other than 0 stands in a line of its own."""
    environment = {**os.environ, "PATH": f"{TENON.parent}:{os.environ['PATH']}", "LC_ALL": "C"}
    process = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    code = f"[exit code {process.returncode}]\n" if process.returncode else ""
    return process.stdout + code


def main():
    text = PAGE.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        for name in ("inspire_hand", "scenes", "cpp/robots", "sweep"):
            shutil.copytree(ROOT / "examples" / name, f"{folder}/examples/{name}")

        def replay(match):
            shown = "".join(f"$ {command}\n{run(command, folder)}"
                            for command in commands_of(match[1]))
            return f"```console\n{shown}```"

        played = BLOCK.sub(replay, text)
    failures = list(check_snippets.failures(sys.argv[3], played))
    if failures:
        print("\n".join(failures))
        return 1
    if sys.argv[4:] == ["--write"]:
        PAGE.write_text(played, encoding="utf-8")
        return 0
    for number, (wanted, found) in enumerate(zip(text.split("\n"), played.split("\n")), 1):
        if wanted != found:
            print(f"{sys.argv[3]}:{number}: the page shows {wanted!r}, found {found!r}")
            return 1
    print(f"{len(BLOCK.findall(text))} blocks of {sys.argv[3]} are as shown")
    return 0 if played == text else 1


if __name__ == "__main__":
    sys.exit(main())
