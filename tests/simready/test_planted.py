#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Each requirement of SimReady that tenon decides: met by one small asset, broken by another.

    test_planted.py ROOT TENON

The assets are those of planted.py. Every row of requirements.def with a judge has a pair there, or
is named in WITHOUT with its reason.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

import planted

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
TABLE = ROOT / "tenon/check/simready/requirements.def"
# The length of a path is that of the folder that the asset is in.
WITHOUT = {"NP.004"}


def judged():
    return set(re.findall(r'TENON_REQUIREMENT\("\w+", "([^"]+)"', TABLE.read_text("utf-8")))


def written(folder):
    """{asset: (code, good)} by kind."""
    found = {"robot": {}, "prop": {}}
    for code, kind, good, files in planted.assets():
        home = folder / f"{code}.{'good' if good else 'bad'}"
        for name, text in files.items():
            path = home / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(text if isinstance(text, bytes) else text.encode())
        found[kind][str(home / planted.main_file(files))] = (code, good)
    return found


def verdicts(kind, assets):
    """{asset: {code: verdict}}"""
    done = subprocess.run([TENON, "check", "--json", "--no-settings", "--profile",
                           f"simready-{kind}", *assets], capture_output=True, text=True,
                          check=False)
    said = json.loads(done.stdout)
    return {row["asset"]: {one["code"].split(".", 3)[3]: one["verdict"]
                           for one in row["codes"] or []} for row in said["assets"]}, said


def shown_faults(said):
    """Findings of the family carry the code; errors are those that the profile fails with."""
    family = [one for one in said["diagnostics"] if one["rule"].startswith("simready.")]
    if not family:
        yield "no finding of the family simready"
    for one in family:
        if not one["code"] or not one["code"].endswith(one["rule"][len("simready"):]):
            yield f"{one['rule']}: code {one['code']}"
    for one in said["diagnostics"]:
        if not one["rule"].startswith("simready.") and one["code"] is not None:
            yield f"{one['rule']}: has the code {one['code']}"


def main():
    faults = [f"{code}: no pair of assets in planted.py" for code in sorted(
        judged() - WITHOUT - set(planted.ROBOT) - set(planted.PROP))]
    pairs = 0
    with tempfile.TemporaryDirectory(prefix="tenon-simready-") as folder:
        for kind, assets in written(pathlib.Path(folder)).items():
            found, said = verdicts(kind, assets)
            faults += list(shown_faults(said))[:3]
            for asset, (code, good) in assets.items():
                verdict = found.get(asset, {}).get(code)
                wanted = ("pass", "open") if good else ("fail",)
                pairs += 1
                if verdict not in wanted:
                    faults.append(f"{code}: {'the good' if good else 'the bad'} asset: {verdict}")
    for fault in faults:
        print(fault)
    print(f"{pairs} assets, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
