#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Names of value types and which paths and arcs a layer may hold, as the AOUSD core specification's
data type tests ask for them.

usage: run_types.py TENON

names     every type name and old name that OpenUSD registers is read, and written in its new name;
          other names are rejected
paths     object paths accepted and rejected as OpenUSD does
arcs      references and payloads accepted and rejected as OpenUSD does
"""

import itertools
import os
import subprocess
import sys
import tempfile

import suite

try:
    from pxr import Sdf
except ImportError:
    suite.skip("no OpenUSD modules in this Python")

# Old spellings that only the text reader knows; the value type registry does not list them.
OLD_NAMES = ("Transform", "PointIndex", "EdgeIndex", "FaceIndex", "Schema")
NO_NAMES = ("float5", "vec3f", "Float", "color3", "color5f", "matrix5d", "double[][]", "quat",
            "point4f", "texCoord4f", "int8", "frame3d", "bool2", "Vec5f", "list", "opaque[]")
PATHS = (
    "/", "/A", "/A/B", "/A.b", "/A.b:c", "/A.b:c:d", "/A/B.c", "/_a1", "/A{v=x}", "/A{v=x}B",
    "/A{v=x}B.c", "/A.r[/B]", "/A.r[/B.c]", "/A.r[/B].c", "A", "A/B", "../A", ".", "..", ".a",
    "/\u00fcber", "/A.\u00fc", "//", "/A//B", "/A/", "/1A", "/A b", "/A.", "/A..b", "/A:b",
    "/A.b/C", "/A.1b", "/A{", "/A{v=x", "/A{v}", "/A-b", "/A.b.c", "/A.b:", "/A.:b", "", "/..",
    "/A/../B", "/A.r[", "/A.r[]", "/A{v=x-y}B", "/A{v=1}", "/A{v=.x}", "/A{=x}", "$", "/A#",
)
ASSETS = ("", "@a.usda@", "@./b c.usd@", "@@@d@@@", "@http://h/x.usd@", "@@")
PRIMS = ("", "</A>", "</A/B>", "<>", "<A>", "</A.b>", "</>", "</A{v=x}B>", "<../A>", "</1>")
OFFSETS = ("", " (offset = 1)", " (scale = 2)", " (offset = 1; scale = -2)", " (scale = 0)",
           " (offset = inf)", " (offset = a)", " (offset = (1, 2))", " (stretch = 2)")


def accepted(text):
    """What OpenUSD makes of a text layer: its canonical text, or None."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    try:
        return layer.ExportToString() if layer.ImportFromString(text) else None
    except Exception:  # pylint: disable=broad-except
        return None


def convert(tenon, folder, text):
    path = os.path.join(folder, "layer.usda")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    run = subprocess.run([tenon, "cat", path], capture_output=True, check=False)
    return run.stdout.decode() if run.returncode == 0 else None


def compare(tenon, folder, text):
    expected, actual = accepted(text), convert(tenon, folder, text)
    if expected == actual:
        return None
    if expected is None or actual is None:
        return "OpenUSD rejects it" if expected is None else "OpenUSD accepts it"
    return f"expected {expected!r}, actual {actual!r}"


def type_names():
    types = [getattr(Sdf.ValueTypeNames, name) for name in dir(Sdf.ValueTypeNames)]
    types = [value for value in types if isinstance(value, Sdf.ValueTypeName)]
    names = {str(value) for value in types}
    aliases = {alias for value in types for alias in value.aliasesAsStrings} - names
    return sorted(names), sorted(aliases | {name + suffix for name in OLD_NAMES
                                            for suffix in ("", "[]")})


def prim(inside, arcs=""):
    return f'#usda 1.0\n\ndef "P"{arcs}\n{{\n    {inside}\n}}\n'


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    results = suite.Results("types")
    names, aliases = type_names()
    texts = [("type names", name, prim(f"custom {name} x")) for name in names]
    texts += [("old type names", name, prim(f"custom {name} x")) for name in aliases]
    texts += [("names that are no type", name, prim(f"custom {name} x")) for name in NO_NAMES]
    texts += [("paths accepted or rejected", repr(path), prim(f"rel r = <{path}>"))
              for path in PATHS]
    arcs = [asset + path + offset for asset, path, offset in
            itertools.product(ASSETS, PRIMS, OFFSETS) if not (offset and path in PRIMS[3:])]
    for kind in ("references", "payload"):
        texts += [(f"{kind} accepted or rejected", f"{kind} {arc}",
                   prim("", f" (\n    prepend {kind} = {arc}\n)")) for arc in arcs]
    with tempfile.TemporaryDirectory() as folder:
        for label, name, text in texts:
            results.add(label, name, compare(sys.argv[1], folder, text))
    sys.exit(results.finish())


if __name__ == "__main__":
    main()
