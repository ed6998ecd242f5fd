#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The hand that Isaac's own pipeline structured: counts, five stable seconds, mimic laws, and a
baked layer that OpenUSD plays with the same poses; its gains beside those of the example hand,
which docs/tuning.md has.

    test_isaac_hand.py ROOT TENON [--write]    with --write that table is made

Exit 77, with the reason, where ../shared or usd-core is absent.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
SHARED = pathlib.Path(os.environ.get("TENON_SHARED_DIR", ROOT.parent / "shared"))
ASSET = SHARED / "assets/inspire_hand_isaac/inspire_hand.usda"
# Follower, leader, multiplier of the URDF that the asset was made from; offsets are zero.
LAWS = [("R_thumb_intermediate", "R_thumb_proximal_pitch", 1.6),
        ("R_thumb_distal", "R_thumb_proximal_pitch", 2.4)]
PAGE = ROOT / "docs/tuning.md"
BEGIN, END = "<!-- hands beside each other -->\n", "<!-- end of hands -->"
# Driven joints of the example, and of the vendor's hand.
HANDS = [("right_thumb_1_joint", "R_thumb_proximal_yaw_joint"),
         ("right_thumb_2_joint", "R_thumb_proximal_pitch_joint"),
         ("right_index_1_joint", "R_index_proximal_joint"),
         ("right_middle_1_joint", "R_middle_proximal_joint"),
         ("right_ring_1_joint", "R_ring_proximal_joint"),
         ("right_little_1_joint", "R_pinky_proximal_joint")]
LAWS += [(f"R_{f}_intermediate", f"R_{f}_proximal", 1.0)
         for f in ("index", "middle", "ring", "pinky")]


def tenon(*arguments):
    process = subprocess.run([TENON, *map(str, arguments)], capture_output=True, text=True,
                             check=False)
    if process.returncode != 0:
        sys.exit(f"{arguments}: exit {process.returncode}\n{process.stderr}")
    return json.loads(process.stdout)


def check_counts(faults):
    physics = tenon("info", ASSET, "--json", "--physics", "physics")["physics"]
    found = [physics["bodies"], physics["joints"]["revolute"], physics["joints"]["fixed"],
             physics["drives"], physics["mimics"], physics["colliders"]]
    if found != [13, 12, 1, 12, 6, 13]:
        faults.append(f"counts under physics: {found}")
    none = tenon("info", ASSET, "--json", "--physics", "none")["physics"]
    if none["bodies"] != 0 or sum(none["joints"].values()) != 0:
        faults.append("none has bodies or joints")


def gains_of(asset):
    """Joint -> its inertia, authored gains, frequency [Hz] and ratio, and the gains of 8 Hz."""
    told = tenon("tune", asset, "--physics", "physics", "--frequency", 8, "--damping-ratio", 1,
                 "--json")
    return {row["joint"].rsplit("/", 1)[1]: row for row in told["drives"] if row["to"]}


def hands_table():
    example, vendor = gains_of(ROOT / "examples/inspire_hand/inspire_hand.usda"), gains_of(ASSET)
    lines = "| joint | hand | inertia | stiffness, damping | Hz, ratio | at 8 Hz, ratio 1 |\n"
    lines += "|---|---|---|---|---|---|\n"
    for names in HANDS:
        for hand, rows, name in (("example", example, names[0]), ("vendor's", vendor, names[1])):
            row = rows[name]
            now, then = row["authored"], row["to"]["authored"]
            has = row["frequencyHz"] is not None
            response = f"{row['frequencyHz']:.4g}, {row['dampingRatio']:.4g}" if has else "-"
            lines += (f"| {name.removesuffix('_joint')} | {hand} | {row['inertia']:.4g} | "
                      f"{now['stiffness']:.4g}, {now['damping']:.4g} | {response} | "
                      f"{then['stiffness']:.4g}, {then['damping']:.4g} |\n")
    return lines


def check_tuning(faults):
    """The table of docs/tuning.md."""
    page = PAGE.read_text(encoding="utf-8")
    head, _, rest = page.partition(BEGIN)
    _, _, tail = rest.partition(END)
    made = head + BEGIN + hands_table() + END + tail
    if "--write" in sys.argv:
        PAGE.write_text(made, encoding="utf-8")
    elif made != page:
        faults.append("docs/tuning.md has other gains of the hands: --write")


def check_laws(state, faults):
    if state["unstable"]:
        faults.append("unstable")
    angle = {path.rsplit("/", 1)[1]: joint["position"] for path, joint in state["joints"].items()}
    for follower, leader, factor in LAWS:
        error = angle[f"{follower}_joint"][0] - factor * angle[f"{leader}_joint"][0]
        if abs(error) > 0.5:
            faults.append(f"{follower} is {error:.3f} degrees off its law")


def check_bake(state, motion, faults):
    from pxr import Usd, UsdGeom
    stage = Usd.Stage.Open(str(motion))
    if stage.GetCompositionErrors():
        faults.append(f"composition errors: {stage.GetCompositionErrors()}")
    end = stage.GetEndTimeCode()
    cache = UsdGeom.XformCache(end)
    for path, body in state["bodies"].items():
        matrix = cache.GetLocalToWorldTransform(stage.GetPrimAtPath(path)).RemoveScaleShear()
        position = matrix.ExtractTranslation()
        turn = matrix.ExtractRotationQuat()
        turn = [turn.GetReal(), *turn.GetImaginary()]
        off = max(abs(a - b) for a, b in zip(position, body["position"]))
        same = sum(a * b for a, b in zip(turn, body["orientation"])) >= 0
        off = max(off, max(abs(a - (b if same else -b))
                           for a, b in zip(turn, body["orientation"])))
        if off > 1e-5:
            faults.append(f"{path} is off by {off:.2e} in the baked layer")


def main():
    if not ASSET.exists():
        print(f"skipped: {ASSET} does not exist")
        return 77
    faults = []
    check_counts(faults)
    check_tuning(faults)
    with tempfile.TemporaryDirectory() as folder:
        motion = pathlib.Path(folder) / "motion.usda"
        state = tenon("sim", ASSET, "--physics", "physics", "--duration", 5, "--json",
                      "--bake", motion)
        check_laws(state, faults)
        try:
            import pxr  # noqa: F401
        except ImportError:
            print("usd-core is not installed here: the baked layer is not compared")
        else:
            check_bake(state, motion, faults)
    print("\n".join(faults))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
