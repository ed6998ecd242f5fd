#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Parts of the page that need no browser: lights, framing, keys, messages (page/tests), and the
types of all of it.

    test_page_parts.py PACKAGES    the folder with node_modules; empty: there is no page
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def check_types(packages):
    """-> the exit code of the compiler, which wants node_modules beside the sources."""
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page"
        shutil.copytree(ROOT / "page", page, ignore=shutil.ignore_patterns("node_modules"))
        (page / "node_modules").symlink_to(pathlib.Path(packages, "node_modules").absolute())
        return subprocess.run([page / "node_modules/.bin/tsc", "--noEmit", "-p", page],
                              check=False, timeout=600).returncode


def main():
    packages = sys.argv[1] if len(sys.argv) > 1 else ""
    if not packages or shutil.which("node") is None:
        print("skipped: node and the packages of the page are not there")
        return 77
    return check_types(packages) or subprocess.run(
        ["node", str(ROOT / "page/tests/run.mjs"), packages], check=False, timeout=600).returncode


if __name__ == "__main__":
    sys.exit(main())
