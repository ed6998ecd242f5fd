# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Robots' descriptions made into assets, beside urdf-usd-converter as a process.

tenon converts and makes Asset Structure 3.0, proven; the other program only converts. It is
measured where it is installed:

    python3 -m venv build/converter && build/converter/bin/pip install urdf-usd-converter
"""

import os
import shutil

ROBOTS = "cmeel.prefix/share/example-robot-data"
# By name: the description below build/robots (tests/convert/ten_robots.py fetches them) and the
# ROS packages that the other program has to be told.
DESCRIPTIONS = {
    "ur5": (f"{ROBOTS}/robots/ur_description/urdf/ur5_robot.urdf", ROBOTS),
    "panda": (f"{ROBOTS}/robots/panda_description/urdf/panda.urdf", ROBOTS),
    "solo12": (f"{ROBOTS}/robots/solo_description/robots/solo12.urdf", ROBOTS),
    "anymal": (f"{ROBOTS}/robots/anymal_c_simple_description/urdf/anymal.urdf", ROBOTS),
    "allegro_hand": (f"{ROBOTS}/robots/allegro_hand_description/urdf/allegro_right_hand.urdf",
                     ROBOTS),
    "simple_humanoid": (
        f"{ROBOTS}/robots/simple_humanoid_description/urdf/simple_humanoid.urdf", ROBOTS),
}


def converter(root):
    """The other program, or None."""
    own = os.path.join(root, "build/converter/bin/urdf_usd_converter")
    return own if os.path.exists(own) else shutil.which("urdf_usd_converter")


def descriptions(root, shared):
    """-> name, file, arguments of the other program."""
    hand = os.path.join(shared, "assets/inspire_hand_urdf/inspire_hand.urdf")
    if os.path.exists(hand):
        yield "inspire_hand", hand, []
    for name, (file, package) in DESCRIPTIONS.items():
        path = os.path.join(root, "build/robots", file)
        if os.path.exists(path):
            folder = os.path.join(root, "build/robots", package)
            yield name, path, ["--package", f"{os.path.basename(package)}={folder}"]


def tasks(bench, root, shared):
    tenon = os.path.join(bench.arguments.build, "bin/tenon")
    other = converter(root)
    if other is None or not os.path.exists(tenon):
        missing = "urdf_usd_converter is not installed" if other is None else f"no {tenon}"
        print(f"convert: skipped, {missing}", flush=True)
        return
    for name, file, packages in descriptions(root, shared):
        ours, theirs = (bench.scene(f"{side}_{name}") for side in ("converted", "other"))
        yield (f"convert_{name}", bench.measure_processes,
               [tenon, "convert", file, ours + "/", "-q"], [other, file, theirs, *packages],
               "structured and proven; the other only converts")
