# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The files of the project, for the checks in this folder."""

import os
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
CODE = (".h", ".cpp", ".def", ".inc")


def project_files(root=ROOT):
    """Relative paths, sorted: what git tracks or would track; all but build/ without git."""
    listing = ["git", "-C", root, "ls-files", "-co", "--exclude-standard", "-z"]
    try:
        done = subprocess.run(listing, capture_output=True, check=True)
        names = [name for name in done.stdout.decode().split("\0") if name]
    except (OSError, subprocess.CalledProcessError):
        names = walk(root)
    return sorted(set(name for name in names if os.path.isfile(os.path.join(root, name))))


def walk(root):
    for folder, folders, files in os.walk(root):
        folders[:] = [f for f in folders if f not in (".git", "build", "__pycache__")]
        for name in files:
            yield os.path.relpath(os.path.join(folder, name), root)


def is_generated(path):
    return "/generated/" in path
