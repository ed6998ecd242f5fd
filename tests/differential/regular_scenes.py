# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Regular scenes, whose binary layers are a small part of what they hold, read back: those that
OpenUSD writes by tenon, those that tenon writes by tenon and OpenUSD, as text and binary. The
memory that a binary layer takes stays within the rule of docs/limits.md. Needs OpenUSD's modules.

usage: regular_scenes.py TENON PRIMS [ours]

PRIMS: about how many; `ours`: without OpenUSD, which takes minutes for a million.
"""

import os
import subprocess
import sys
import tempfile

OURS = sys.argv[3:] == ["ours"]
if not OURS:
    try:
        from pxr import Sdf
    except ImportError:
        print("skipped: no OpenUSD modules in this Python")
        sys.exit(77)

BYTES_PER_SPEC = 300


def groups(prims, attribute):
    """Groups of groups of prims with the same names in each."""
    side = round(prims ** (1 / 3))
    body = ["double size = 1.5"] if attribute else []
    leaves = "".join(f'def Cube "c{i}"\n{{\n' + "\n".join(body) + "\n}\n" for i in range(side))
    middle = "".join(f'def Xform "m{i}"\n{{\n{leaves}}}\n' for i in range(side))
    return "".join(f'def Xform "g{i}"\n{{\n{middle}}}\n' for i in range(side))


def flat(prims, _attribute):
    """Prims with names and values of their own."""
    return "".join(f'def Cube "c{i}"\n{{\ndouble size = {i}\n}}\n' for i in range(prims))


def run(program, *arguments):
    done = subprocess.run([program, *arguments], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(f"{arguments}: {done.returncode}\n{done.stderr[-2000:]}")


def round_trip(program, folder, text, specs):
    at = {name: os.path.join(folder, name) for name in
          ("a.usda", "a.usdc", "b.usda", "u.usdc", "v.usda", "n.usdc")}  # fmt: skip
    with open(at["a.usda"], "w", encoding="utf-8") as out:
        out.write("#usda 1.0\n" + text)
    run(program, "cat", at["a.usda"], "-o", at["a.usdc"])
    run(program, "cat", at["a.usdc"], "-o", at["b.usda"])
    run(program, "cat", at["a.usda"], "-o", at["v.usda"])
    with open(at["b.usda"], "rb") as one, open(at["v.usda"], "rb") as other:
        assert one.read() == other.read(), "another layer came back"
    size = os.path.getsize(at["a.usdc"])
    print(f"{specs} specs, {size} bytes of tenon", end="")
    if not OURS:
        layer = Sdf.Layer.OpenAsAnonymous(at["a.usdc"])
        layer.Export(at["u.usdc"])
        print(f", {os.path.getsize(at['u.usdc'])} of OpenUSD", end="")
        run(program, "cat", at["u.usdc"], "-o", at["v.usda"])
        with open(at["b.usda"], "rb") as one, open(at["v.usda"], "rb") as other:
            assert one.read() == other.read(), "OpenUSD wrote another layer"
    print()
    return at["a.usdc"], size


def main():
    program, prims, over = sys.argv[1], int(sys.argv[2]), False
    with tempfile.TemporaryDirectory() as folder:
        for make, attribute in ((groups, False), (groups, True), (flat, True)):
            text = make(prims, attribute)
            specs = text.count("\ndef ") + text.count("\ndouble ")
            crate, size = round_trip(program, folder, text, specs)
            used = measured([program, "cat", crate, "-o", os.path.join(folder, "n.usda")])
            most = (64 << 20) + 40 * size + BYTES_PER_SPEC * specs
            print(f"  {used >> 20} MB used to write it as text, {most >> 20} MB allowed")
            over = over or (used > most and not is_sanitized(program))
    return 1 if over else 0


def is_sanitized(program):
    with open(program, "rb") as file:
        return b"__asan_init" in file.read()


def measured(command):
    """Peak memory of a command in bytes, from the kernel's account of its children."""
    script = ("import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, "
              "stdout=subprocess.DEVNULL); "
              "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)")  # fmt: skip
    done = subprocess.run([sys.executable, "-c", script, *command], capture_output=True, text=True,
                          check=True)  # fmt: skip
    return int(done.stdout) * 1024


if __name__ == "__main__":
    sys.exit(main())
