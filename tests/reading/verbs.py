# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every verb that reads an asset takes --sandbox, --search-path and --allow-read, and --sandbox
means the same to each: no file outside of these folders is opened.

    verbs.py TENON

The verbs are those that the program names; one without a row here is a fault.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

TENON = os.path.abspath(sys.argv[1])
os.environ["TENON_CHROMIUM"] = str(
    pathlib.Path(__file__).absolute().parents[1] / "view/fake_browser.py")
OPTIONS = ("--sandbox", "--search-path", "--allow-read")
MARK = "CANARY"

# What reads no asset.
WITHOUT = {"doctor", "help", "version", "completion", "manual", "new", "sweep", "undo", "excite",
           "identify", "test-runner list-op", "test-runner schemas"}
# Verb -> its arguments behind the asset; OUT is a folder.
ROWS = {
    "add": ["/A/new=scope", "--dry-run"],
    "bake": ["-o", "OUT/b.usda", "--duration", "0.01"],
    "bench": ["--duration", "0.01"],
    "benchmark": ["--tests", "ground_drop"],
    "cat": ["--flatten"],
    "check": [],
    "colliders": [],
    "compare": ["--engines", "mujoco,mujoco", "--duration", "0.01"],
    "convert": ["OUT/c.xml"],
    "diff": ["OWN", "--composed"],
    "dump": [],
    "dump-index": [],
    "explain": ["/A"],
    "inertia": [],
    "info": [],
    "drives": [],
    "pairs": [],
    "physics": [],
    "pose": [],
    "record": ["-o", "OUT/r.png"],
    "remove": ["/A", "--dry-run"],
    "rename": ["/A", "B", "--dry-run"],
    "report": ["-o", "OUT/r.html", "--duration", "0.01"],
    "set": ["/A.visibility=inherited", "--dry-run"],
    "sim": ["--duration", "0.01"],
    "strip": ["-o", "OUT/s.usda"],
    "structure": ["-o", "OUT/s"],
    "test-runner composition": [],
    "test-runner layer": [],
    "test-runner value": ["/A.visibility", "default"],
    "tree": [],
    "tune": [],
    "variant": [],
    "view": ["--for", "0"],
    "view --screenshot": ["OUT/v.png"],
    "where": ["/A.visibility"],
    "zip": ["-o", "OUT/z.usdz"],
    "zip --list": [],
    "zip --extract": ["OUT/e"],
}
ASSET = """#usda 1.0
(
    defaultPrim = "A"
    subLayers = [@%s@]
)
def Xform "A" (
    prepend apiSchemas = ["PhysicsRigidBodyAPI"]
)
{
    token visibility = "inherited"
    def Cube "Box" (prepend apiSchemas = ["PhysicsCollisionAPI"])
    {
    }
}
"""
OTHER = (f'#usda 1.0\nover "A"\n{{\n    string told = "{MARK}"\n    def Cube "{MARK}"\n    {{\n'
         "    }\n}\n")


def run(*words):
    return subprocess.run([TENON, *map(str, words)], capture_output=True, text=True, check=False,
                          timeout=60)


def all_verbs():
    """-> for each verb that the program has, the names of its options, from its own help."""
    found = {}
    for verb in json.loads(run("help", "--json").stdout)["verbs"]:
        inner = verb["verbs"] if verb["name"] == "test-runner" else []
        for row in inner or [verb]:
            name = f"{verb['name']} {row['name']}" if inner else row["name"]
            found[name] = {word for option in row["options"] for word in option["names"]}
    return found


def words_of(verb, asset, folder):
    first, *rest = verb.split()
    behind = [word.replace("OUT", str(folder / "out")).replace("OWN", str(folder / "in/own.usda"))
              for word in ROWS[verb]]
    if rest and rest[0].startswith("--"):
        return [first, asset, rest[0], *behind]
    return [first, *rest, asset, *behind]


def check_sandbox(verb, folder):
    """An asset outside is not opened; one inside is, without what it names outside."""
    package = verb.startswith("zip --")
    outside = folder / ("other/p.usdz" if package else "other/o.usda")
    inside = folder / ("in/p.usdz" if package else "in/a.usda")
    for asset, sandbox, may in ((outside, "in", False), (inside, "in", True)):
        done = run(*words_of(verb, asset, folder), "--sandbox", folder / sandbox)
        said = done.stdout + done.stderr
        written = b"".join(path.read_bytes() for path in (folder / "out").rglob("*")
                           if path.is_file())
        if MARK in said or MARK.encode() in written:
            yield f"{verb}: opened a file outside of its sandbox"
        if "view.no-page" in said:
            return  # a build without node
        if not may and done.returncode == 0:
            yield f"{verb}: opened an asset outside of its sandbox"
        if not may and "outside" not in said:
            yield f"{verb}: does not say why it opens nothing: {said[-200:]}"
        if may and package and done.returncode != 0:
            yield f"{verb}: does not open an asset in its sandbox: {said[-200:]}"
        if may and not package and verb != "test-runner layer" and "outside" not in said:
            yield f"{verb}: does not say what it leaves out: {said[-200:]}"


def main():
    faults = []
    verbs = all_verbs()
    if len(verbs) < 15:
        faults.append(f"only {len(verbs)} verbs were found: {verbs}")
    for verb in verbs:
        if verb in WITHOUT:
            continue
        faults += [f"{verb}: has no {option}" for option in OPTIONS if option not in verbs[verb]]
        if verb not in ROWS:
            faults.append(f"{verb}: this test has no row for it")
    for verb in ROWS:
        if verb in verbs or " --" in verb:
            with tempfile.TemporaryDirectory() as temporary:
                folder = pathlib.Path(os.path.realpath(temporary))
                for name in ("in", "out", "other"):
                    (folder / name).mkdir()
                (folder / "other/s.usda").write_text(OTHER)
                (folder / "other/o.usda").write_text(ASSET % "./s.usda")
                (folder / "in/a.usda").write_text(ASSET % "../other/s.usda")
                (folder / "in/own.usda").write_text(ASSET % "./none.usda")
                for place in ("other", "in"):
                    run("cat", folder / "in/own.usda", "-o", folder / place / "p.usdz")
                faults += check_sandbox(verb, folder)
    for fault in faults:
        print(fault)
    print(f"{len(verbs)} verbs, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
