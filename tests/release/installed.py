# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The installed release program, for the tests of this folder and for tools/make_reference.py: made
from build/release, which `make test` builds beside its own."""

import os
import subprocess
import sys
import tempfile

SKIPPED = 77


def release_build():
    """The folder of argument 1; the test skips when the program is not built there."""
    build = os.path.abspath(sys.argv[1])
    if not os.path.exists(os.path.join(build, "bin/tenon")):
        print(f"skipped: no program in {build}; `make test` builds it: cmake --preset release, "
              "cmake --build build/release")
        sys.exit(SKIPPED)
    return build


def install(build):
    """-> a temporary folder with all that is installed; to be used with `with`."""
    folder = tempfile.TemporaryDirectory(prefix="tenon_installed_")
    done = subprocess.run(["cmake", "--install", build, "--prefix", folder.name],
                          capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"cmake --install {build}: exit {done.returncode}\n{done.stderr}")
    return folder


def programs(prefix):
    """Every installed file that can be run and is no library."""
    found = []
    for folder, _, names in os.walk(prefix):
        for name in names:
            path = os.path.join(folder, name)
            with open(path, "rb") as file:
                is_elf = file.read(4) == b"\x7fELF"
            if is_elf and os.access(path, os.X_OK) and ".so" not in name:
                found.append(path)
    return sorted(found)
