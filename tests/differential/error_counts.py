# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Composition errors that OpenUSD tells twice and tenon once: the same ones are told, and
CONFORMANCE.md lists why their number differs. Needs OpenUSD's Python modules.

usage: error_counts.py TENON

Fails too where OpenUSD no longer repeats itself, so that the list can shrink.
"""

import collections
import json
import os
import re
import subprocess
import sys
import tempfile

try:
    from pxr import Usd
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

# An expression that cannot be evaluated, in a payload: OpenUSD evaluates it to learn whether there
# is a payload, and again to add it.
EXPRESSION = {
    "root.usda": """#usda 1.0
def "A" (
    payload = @`if(not(${MISSING}), "./x.usda", "./y.usda")`@
)
{
}
def "B" (
    references = @`"./${MISSING}.usda"`@
)
{
}
"""
}

# A prim that specializes itself, and prims below it that reach it again: of some of these OpenUSD
# tells the one cycle twice.
CYCLE = {
    "root.usda": """#usda 1.0
(
    subLayers = [@./weak.usda@]
)
def "P2" (
    prepend references = @./part.usda@</P1>
)
{
    def "C2" (
        prepend specializes = </P2/C1>
    )
    {
    }
}
""",
    "weak.usda": """#usda 1.0
over "P2"
{
    class "C1" (
        prepend inherits = </P5/C0/G1>
    )
    {
    }
    def "C0" (
        prepend inherits = </P5/C0/G1>
        prepend specializes = </P2/C0>
    )
    {
    }
}
def "P5"
{
    def "C0"
    {
        def "G1" (
            prepend specializes = </P2/C2>
        )
        {
        }
    }
}
""",
    "part.usda": """#usda 1.0
class "P0"
{
    def "C3" (
        prepend payload = @./leaf.usda@</P4>
    )
    {
    }
}
def "P1" (
    prepend specializes = </P0/C3>
)
{
    over "C2"
    {
        def "G0" (
            prepend specializes = </P0>
        )
        {
        }
    }
}
""",
    "leaf.usda": """#usda 1.0
def "P4"
{
    class "C2" (
        prepend specializes = </P4/C0>
    )
    {
    }
}
""",
}
SCENES = {"expression of a payload": EXPRESSION, "prim that specializes itself": CYCLE}


def class_name(error):
    return "compose." + re.sub(r"(?<!^)([A-Z])", r"-\1", error.replace("Error", "", 1)).lower()


def told_by_openusd(root):
    """{class: [errors as text]}"""
    found = collections.defaultdict(list)
    for error in Usd.Stage.Open(root).GetCompositionErrors():
        found[class_name(type(error).__name__)].append(f"{error.rootSite.path} {error}")
    return found


def told_by_tenon(program, root):
    done = subprocess.run([program, "info", "--json", root], capture_output=True, check=False)
    found = collections.defaultdict(list)
    for finding in json.loads(done.stdout)["diagnostics"]:
        if finding["rule"].startswith("compose."):
            found[finding["rule"]].append(f"{finding['prim']} {finding['message']}")
    return found


def judge(name, program, root):
    """What is wrong with one scene."""
    want, have = told_by_openusd(root), told_by_tenon(program, root)
    if not any(len(set(errors)) < len(errors) for errors in want.values()):
        yield f"{name}: OpenUSD tells no error twice any more: shorten CONFORMANCE.md"
    for rule in sorted(want.keys() | have.keys()):
        ours, theirs = len(set(have[rule])), len(set(want[rule]))
        print(f"{name}: {rule}: {ours} of tenon ({len(have[rule])} told), {theirs} of OpenUSD "
              f"({len(want[rule])} told)")
        if ours != theirs:
            yield f"{name}: {rule}: {ours}, OpenUSD {theirs}"


def main():
    faults = []
    for name, files in SCENES.items():
        with tempfile.TemporaryDirectory() as folder:
            for file, text in files.items():
                with open(os.path.join(folder, file), "w", encoding="utf-8") as out:
                    out.write(text)
            faults += judge(name, sys.argv[1], os.path.join(folder, "root.usda"))
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
