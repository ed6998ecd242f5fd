# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Changes a limit in the file that owns it; a copy of an asset, its files are written to.

    python edit.py hand.usda /hand/Physics/joint 60
"""

import sys

import tenon_usd as tenon

path, joint, degrees = sys.argv[1:]
stage = tenon.open(path)
for place in stage[joint].set("physics:upperLimit", float(degrees)):
    print(f"{place['file']}: {place['before']} -> {place['after']} degrees")
try:
    stage[joint]["physics:upperLimit"] = "far"
except tenon.InvalidError as error:
    print("refused:", error.fix or error)
print("wrote", *stage.save())
answer = tenon.check(path)
for finding in answer["diagnostics"]:
    if finding["severity"] == "error":
        print(finding["prim"], finding["message"])
print("errors:", answer["summary"]["errors"])
