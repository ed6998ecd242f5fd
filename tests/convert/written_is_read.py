#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a conversion writes is read: no vendor's property in an output stands under `notRead`.

    written_is_read.py ROOT TENON

The sources are all MJCF and URDF files beside this test, and what build/robots has (ten_robots.py).
Each is converted and its physics read under every variant. `written_is_read_misses.txt` names what
is known not to be read; it may only shrink, so a row of it that is not met is a fault, too.
"""

import json
import pathlib
import subprocess
import sys
import tempfile

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
HERE = ROOT / "tests/convert"
VARIANTS = ("physics", "physx", "mujoco")
PREFIXES = ("mjc:", "newton:", "physx")


def sources():
    yield from sorted((HERE / "mjcf").glob("*.xml"))
    yield from sorted((HERE / "urdf").glob("*.urdf"))
    for path in sorted((ROOT / "build/robots").rglob("*")):
        if path.suffix in (".urdf", ".xml") and path.is_file():
            yield path


def unread(asset):
    """Names of vendors' properties that are not read under some variant."""
    names = set()
    for variant in VARIANTS:
        done = subprocess.run([TENON, "physics", asset, "--json", "--physics", variant],
                              capture_output=True, text=True, check=False, timeout=120)
        if done.returncode in (0, 1) and done.stdout.startswith("{"):
            names |= {row["property"] for row in json.loads(done.stdout)["notRead"]
                      if row["property"].startswith(PREFIXES)}
    return names


def main():
    known = {line for line in (HERE / "written_is_read_misses.txt").read_text().splitlines()
             if line and not line.startswith("#")}
    found, converted = {}, 0
    for count, source in enumerate(sources()):
        # Of the many published ones every fourth.
        if HERE not in source.parents and count % 4:
            continue
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder) / "asset"
            done = subprocess.run([TENON, "convert", source, out], capture_output=True, text=True,
                                  check=False, timeout=300)
            if done.returncode:
                continue
            converted += 1
            for name in unread(next(out.glob("*.usda"))):
                found.setdefault(name, source.name)
    for name in sorted(found.keys() - known):
        print(f"{name} is written for {found[name]} and not read")
    for name in sorted(known - found.keys()):
        print(f"{name} is read, or not written any more: take it out of written_is_read_misses.txt")
    print(f"{converted} converted, {len(found)} properties not read")
    return 1 if found.keys() != known or converted < 12 else 0


if __name__ == "__main__":
    sys.exit(main())
