#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The text parsing suite of OpenUSD, where it is, and the texts of text_cases.py: files named `bad`
are rejected and the others accepted, and the text written from each accepted one equals OpenUSD's,
byte by byte; the JSON of its layer, too.

usage: run_text_parsing.py TENON
"""

import json
import os
import subprocess
import sys
import tempfile

import suite
import text_cases

try:
    import openusd_json
    from pxr import Sdf
except ImportError:
    suite.skip("no OpenUSD modules in this Python")


def run(tenon, *arguments):
    process = subprocess.run([tenon, *arguments], capture_output=True, check=False)
    if process.returncode not in (0, 2):
        sys.exit(f"{' '.join(arguments)}: exit {process.returncode}\n{process.stderr[-2000:]}")
    return process.stdout if process.returncode == 0 else None


def open_by_openusd(path):
    try:
        return Sdf.Layer.OpenAsAnonymous(path)
    except Exception:  # pylint: disable=broad-except
        return None


def first_difference(expected, actual):
    for number, pair in enumerate(zip(expected.split("\n"), actual.split("\n")), 1):
        if pair[0] != pair[1]:
            return f"line {number}: expected {pair[0][:120]!r}, actual {pair[1][:120]!r}"
    return "one text ends early"


def check(tenon, name, path, results, is_bad):
    text = run(tenon, "cat", path)
    verdict = None if (text is None) == is_bad else "rejected" if text is None else "accepted"
    results.add("text parsing: rejected as bad" if is_bad else "text parsing: accepted as good",
                name, verdict)
    layer = open_by_openusd(path)
    if layer is None or text is None:
        if layer is not None or text is not None:
            results.add("text parsing: same verdict as OpenUSD", name, "only one side accepts it")
        return
    expected, actual = layer.ExportToString(), text.decode("utf-8", "surrogateescape")
    results.add("text written again: bytes as OpenUSD's", name,
                None if expected == actual else first_difference(expected, actual))
    fields = run(tenon, "test-runner", "layer", path)
    fields = json.loads(fields.decode("utf-8", "surrogateescape"))
    results.add("text layers: fields as OpenUSD's", name,
                openusd_json.differs(layer, fields))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    results = suite.Results("text_parsing")
    for name, path in suite.cases("openusd_sdf_parsing"):
        check(sys.argv[1], name, path, results, "_bad_" in name)
    own = suite.Results("own_text_parsing")
    with tempfile.TemporaryDirectory() as folder:
        for name, text, is_bad in text_cases.cases():
            path = os.path.join(folder, name + ".usda")
            with open(path, "w", encoding="utf-8", newline="") as file:
                file.write(text)
            check(sys.argv[1], name, path, own, is_bad)
    sys.exit(results.finish(is_whole=suite.HAS_PUBLISHED) | own.finish(is_whole=False))


if __name__ == "__main__":
    main()
