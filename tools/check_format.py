#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds C++ files to .clang-format, with the version that tests/requirements.txt pins.

usage: check_format.py FOLDER [--write]
Generated files are left out. Exit 0: held; 1: files that are laid out otherwise; 77: clang-format
is missing. --write lays them out.
"""

import os
import subprocess
import sys

import source_files

SKIPPED = 77
AT_ONCE = 40  # files for one process


def program():
    """clang-format of the Python that runs this; None where it is not installed."""
    path = os.path.join(os.path.dirname(sys.executable), "clang-format")
    return path if os.path.exists(path) else None


def unformatted(root, clang_format, names, write=False):
    """Those of `names` that clang-format would change."""
    found = []
    for first in range(0, len(names), AT_ONCE):
        some = names[first:first + AT_ONCE]
        mode = ["-i"] if write else ["--dry-run", "--Werror"]
        done = subprocess.run([clang_format, *mode, *some], cwd=root, capture_output=True,
                              text=True, check=write)
        if done.returncode:
            told = {line.split(":", 1)[0] for line in done.stderr.splitlines()
                    if "[-Wclang-format-violations]" in line}
            found += sorted(told) or some
    return found


def main():
    root = sys.argv[1]
    clang_format = program()
    if clang_format is None:
        print("skipped: clang-format is missing (tools/make_oracle.sh)")
        return SKIPPED
    names = [name for name in source_files.project_files(root)
             if name.endswith((".h", ".cpp")) and not source_files.is_generated(name)]
    faults = unformatted(root, clang_format, names, "--write" in sys.argv[2:])
    for name in faults:
        print(f"{name}: not as .clang-format has it; run tools/python.sh tools/check_format.py . "
              "--write")
    print(f"{len(names)} files, {len(faults)} laid out otherwise")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
