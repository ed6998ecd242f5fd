# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares layers read and written as text with OpenUSD: which files are accepted, and the bytes of
the canonical text. Text and binary layers are read. Needs Python with OpenUSD's modules.

usage: text_layers.py RETEXT [FOLDER...]

RETEXT is built from tests/tools/retext.cpp. Without FOLDER the layers of this project are read, and
the conformance files, scenes and assets below the folder named by TENON_SHARED_DIR (default:
../shared), where that is.
Known misses are named in text_misses.txt: one more or one less makes this fail.
"""

import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
import suite  # noqa: E402  pylint: disable=wrong-import-position

try:
    from pxr import Sdf
except ImportError:
    suite.skip("no OpenUSD modules in this Python")

SHARED = suite.SHARED
LARGEST = 30_000_000  # bytes


def layer_files(folders):
    """All layers below the folders, sorted."""
    found = []
    for folder in folders:
        for directory, _, names in os.walk(folder):
            for name in names:
                path = os.path.join(directory, name)
                if name.endswith((".usda", ".usd", ".usdc")) and os.path.getsize(path) <= LARGEST:
                    found.append(path)
    return sorted(found)


def expected_text(path):
    """What OpenUSD exports, or None when it rejects the file."""
    try:
        layer = Sdf.Layer.FindOrOpen(path)
        return None if layer is None else layer.ExportToString()
    except Exception:  # pylint: disable=broad-except
        return None


def actual_texts(program, paths):
    """Path -> text that the program writes; rejected files are left out."""
    texts = {}
    with tempfile.TemporaryDirectory() as folder:
        run = subprocess.run(
            [program, "--into", folder] + paths, capture_output=True, text=True, check=False
        )
        if run.returncode not in (0, 1):
            sys.exit(f"{program} crashed:\n{run.stderr[-3000:]}")
        for i, path in enumerate(paths):
            out = os.path.join(folder, str(i))
            if os.path.exists(out):
                with open(out, "rb") as file:
                    texts[path] = file.read().decode("utf-8", "surrogateescape")
    return texts


def first_difference(expected, actual):
    for number, (a, b) in enumerate(zip(expected.split("\n"), actual.split("\n")), 1):
        if a != b:
            return f"line {number}\n   expected {a[:160]}\n   actual   {b[:160]}"
    return "one text ends early"


def misses(program, files):
    """Name -> what differs."""
    found = {}
    for start in range(0, len(files), 50):
        batch = files[start : start + 50]
        texts = actual_texts(program, batch)
        for path in batch:
            expected = expected_text(path)
            actual = texts.get(path)
            if (expected is None) != (actual is None):
                found[path] = "OpenUSD rejects it" if expected is None else "OpenUSD accepts it"
            elif expected is not None and expected != actual:
                found[path] = first_difference(expected, actual)
    return found


def compare_own(program):
    own = suite.Results("own_text", os.path.join(HERE, "text_misses.txt"))
    files = suite.own_layers()
    found = misses(program, files)
    for path in files:
        own.add("layers of this project: bytes as OpenUSD's, or rejected by both",
                suite.own_name(path), found.get(path))
    return own.finish(is_whole=False)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folders = sys.argv[2:] or [os.path.join(SHARED, n) for n in ("conformance", "scenes", "assets")]
    folders = [folder for folder in folders if os.path.isdir(folder)]
    results = suite.Results("text", os.path.join(HERE, "text_misses.txt"))
    files = layer_files(folders)
    found = misses(sys.argv[1], files)
    for path in files:
        results.add("text of layers: bytes as OpenUSD's, or rejected by both",
                    os.path.relpath(path, SHARED), found.get(path))
    code = results.finish(is_whole=not sys.argv[2:] and suite.HAS_PUBLISHED)
    if not sys.argv[2:]:
        code |= compare_own(sys.argv[1])
    sys.exit(code)


if __name__ == "__main__":
    main()
