#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Writes every layer of the Inspire Hand example from the numbers and shapes in generator/.

    generate.py                     write the layers beside this script
    generate.py --check             write nothing; exit 1 and name each file that is not what
    would be written
    generate.py --geometry FILE     write only the geometry, as text, to FILE

Python's standard library is enough. Geometry is written as text and turned into the binary
payloads/geometry.usdc by `tenon cat`; --tenon names the executable (default:
build/release/bin/tenon of this checkout). Without it the geometry on disk is left alone.
"""

import argparse
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True

from generator import grasp, hand, layers, shapes  # noqa: E402

GEOMETRY = "payloads/geometry.usdc"


def make_layers(links):
    """Relative path -> text, all text layers in the order in which the README tells of them."""
    return {
        "payloads/material.usda": layers.material(),
        "payloads/robot.usda": layers.robot(links),
        "payloads/instances.usda": layers.instances(links),
        "payloads/base.usda": layers.base(links),
        "payloads/Physics/physics.usda": layers.physics(links),
        "payloads/Physics/physx.usda": layers.physx(),
        "payloads/Physics/mujoco.usda": layers.mujoco(),
        "inspire_hand.usda": layers.interface(),
        "grasp.usda": grasp.grasp(),
    }


def run_tenon(tenon, *arguments):
    return subprocess.run(
        [str(tenon), *map(str, arguments)], check=True, capture_output=True
    ).stdout


def write_geometry(tenon, text, target):
    """Turns the text into a binary layer; the file in place is replaced only by a whole new
    one."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "geometry.usda"
        source.write_text(text)
        fresh = pathlib.Path(folder) / "geometry.usdc"
        run_tenon(tenon, "cat", source, "-o", fresh)
        target.write_bytes(fresh.read_bytes())


def geometry_differs(tenon, text, target):
    """Compares what the binary layer says with what the text says, both printed by tenon."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "geometry.usda"
        source.write_text(text)
        return run_tenon(tenon, "cat", source) != run_tenon(tenon, "cat", target)


def check(texts, geometry, tenon):
    stale = [
        name
        for name, text in texts.items()
        if not (HERE / name).is_file() or (HERE / name).read_text() != text
    ]
    if not (HERE / GEOMETRY).is_file():
        stale.append(GEOMETRY)
    elif tenon.is_file():
        if geometry_differs(tenon, geometry, HERE / GEOMETRY):
            stale.append(GEOMETRY)
    else:
        print(f"{GEOMETRY}: not compared, no {tenon}")
    for name in stale:
        print(f"{name}: is not what generate.py writes; run it, or move the change into generator/")
    return 1 if stale else 0


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--geometry", type=pathlib.Path, metavar="FILE")
    parser.add_argument(
        "--tenon", type=pathlib.Path, default=HERE.parents[1] / "build/release/bin/tenon"
    )
    options = parser.parse_args()

    geometry = layers.geometry(shapes.make_surfaces())
    if options.geometry:
        options.geometry.write_text(geometry)
        return 0
    texts = make_layers(hand.make_links())
    if options.check:
        return check(texts, geometry, options.tenon)
    for name, text in texts.items():
        (HERE / name).parent.mkdir(parents=True, exist_ok=True)
        (HERE / name).write_text(text)
    if options.tenon.is_file():
        write_geometry(options.tenon, geometry, HERE / GEOMETRY)
    else:
        print(f"{GEOMETRY}: left alone, no {options.tenon}")
    print(f"{len(texts)} text layers written under {HERE.name}/")
    return 0


if __name__ == "__main__":
    sys.exit(main())
