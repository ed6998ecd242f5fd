# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares interpolated values of every type that blends with OpenUSD's, bit for bit, at many times
and through offsets and scales of sublayers. Needs OpenUSD's Python modules.

usage: interpolation.py TENON [SEED]
"""

import json
import os
import random
import struct
import subprocess
import sys
import tempfile

try:
    from pxr import Gf, Sdf, Usd
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

# Type name -> how many numbers, and the format of one.
SCALARS = {"half": "e", "float": "f", "double": "d"}
TYPES = {"timecode": (1, "d"), "matrix2d": (4, "d"), "matrix3d": (9, "d"), "matrix4d": (16, "d"),
         "quath": (4, "e"), "quatf": (4, "f"), "quatd": (4, "d")}  # fmt: skip
TYPES |= {name + (str(n) if n > 1 else ""): (n, code)
          for name, code in SCALARS.items() for n in (1, 2, 3, 4)}  # fmt: skip
TYPES |= {role: (3, role[-1].replace("h", "e")) for role in ("point3h", "normal3f", "color3d")}
OFFSETS = [(0, 1), (10, 1), (0, 2), (3, 0.5), (-7, 3)]


def value(rng, count, code):
    numbers = [rng.choice([0.0, 1.0, rng.uniform(-1, 1), rng.uniform(-60, 60)])
               for _ in range(count)]  # fmt: skip
    return [struct.unpack(code, struct.pack(code, n))[0] for n in numbers]


def text_of(name, numbers):
    rows = {"matrix2d": 2, "matrix3d": 3, "matrix4d": 4}.get(name)
    if rows:
        lines = [numbers[i * rows : (i + 1) * rows] for i in range(rows)]
        return "( " + ", ".join("(" + ", ".join(map(repr, line)) + ")" for line in lines) + " )"
    return repr(numbers[0]) if len(numbers) == 1 else "(" + ", ".join(map(repr, numbers)) + ")"


def quaternion(rng, code):
    parts = [rng.gauss(0, 1) for _ in range(4)]
    length = sum(p * p for p in parts) ** 0.5
    return [struct.unpack(code, struct.pack(code, p / length))[0] for p in parts]


def layer_text(rng):
    lines = ["#usda 1.0", 'def "A" {']
    for name, (count, code) in TYPES.items():
        for variant in range(4):
            samples = []
            for time in (0, 4, 9.5, 10):
                one = quaternion(rng, code) if name.startswith("quat") else value(rng, count, code)
                if variant == 3 and samples and name.startswith("quat"):
                    one = [n + 1e-4 for n in last]  # so near that they are mixed linearly
                last = one
                item = text_of(name, one)
                samples.append(f"{time}: [{item}, {item}]" if variant == 2 else f"{time}: {item}")
            array = "[]" if variant == 2 else ""
            lines.append(f"{name}{array} {name}_{variant}.timeSamples = {{ {', '.join(samples)} }}")
    return "\n".join(lines) + "\n}\n"


def flat(thing):
    """The numbers of a value of OpenUSD, quaternions with the real part last."""
    if isinstance(thing, (Gf.Quath, Gf.Quatf, Gf.Quatd)):
        return [*thing.GetImaginary(), thing.GetReal()]
    if isinstance(thing, Sdf.TimeCode):
        return [thing.GetValue()]
    if isinstance(thing, (int, float)):
        return [float(thing)]
    return [n for item in thing for n in flat(item)]


def equal(name, theirs, got):
    """Time codes are moved by the offset after they are mixed, in OpenUSD before: they may be one
    rounding apart."""
    if name.startswith("timecode"):
        return all(abs(a - b) <= 1e-13 for a, b in zip(theirs, got, strict=True))
    return theirs == got


def flat_json(thing):
    return [n for item in thing for n in flat_json(item)] if isinstance(thing, list) else [thing]


def ours(program, asset, attribute, times):
    command = [program, "test-runner", "value", asset, attribute, *map(repr, times)]
    run = subprocess.run(command, capture_output=True, text=True, check=True)
    return list(json.loads(run.stdout).values())


def main():
    program = sys.argv[1]
    rng = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    differences, compared = [], 0
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "samples.usda"), "w", encoding="utf-8") as out:
            out.write(layer_text(rng))
        for number, (offset, scale) in enumerate(OFFSETS):
            asset = os.path.join(folder, f"root{number}.usda")
            with open(asset, "w", encoding="utf-8") as out:
                out.write("#usda 1.0\n(subLayers = [@./samples.usda@ "
                          f"(offset = {offset}; scale = {scale})])\n")  # fmt: skip
            stage = Usd.Stage.Open(asset)
            times = sorted({round(offset + scale * rng.uniform(-1, 11), 3) for _ in range(40)})
            for attribute in stage.GetPrimAtPath("/A").GetAttributes():
                mine = ours(program, asset, str(attribute.GetPath()), times)
                for time, one in zip(times, mine, strict=True):
                    theirs = flat(attribute.Get(time))
                    code = TYPES[attribute.GetName().rsplit("_", 1)[0]][1]
                    got = [struct.unpack(code, struct.pack(code, n))[0] for n in flat_json(one)]
                    compared += 1
                    if not equal(attribute.GetName(), theirs, got):
                        differences.append((attribute.GetName(), offset, scale, time, theirs, got))
    for difference in differences[:12]:
        print(*difference)
    print(f"{compared} values compared, {len(differences)} differ")
    return 1 if differences or compared < 10_000 else 0


if __name__ == "__main__":
    sys.exit(main())
