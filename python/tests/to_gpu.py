# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""World.to_warp(), to_mjx() and to_newton() step like the world that they are made of.

    to_gpu.py ROOT [COUNT [PACKAGE...]]

For the judge, in an environment with tests/convert/requirements-readers.txt and the wheel by
PYTHONPATH, as mjcf readers have it. COUNT (20) published robots, an even choice of the descriptions
in build/robots, are converted with gains, without shapes, so that nothing touches, and moved for 2
s by weight and drives in 3 environments with targets of their own: by tenon on MuJoCo, and by each
PACKAGE (warp, mjx, newton) on the device that it finds, the processor where there is no GPU. Their
numbers have 24 bits: joints end up where tenon's do to 0.01 (rad or m; 0.05 in Newton), unless the
batch told what it lost; what a package refuses is listed, and so are models that MJX does not
compile in 5 minutes. Each batch has a process of its own.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

COUNT, SECONDS, ENVS, LONGEST = 20, 2.0, 3, 300
# [rad or m]; Newton makes its own model of the asset.
CLOSE = {"warp": 0.01, "mjx": 0.01, "newton": 0.05}
FOLDERS = ("cmeel.prefix/share/example-robot-data/robots", "airo_models", "upkie_description")
LEAST = 0.9  # of the batches that were made


def chosen(root, count):
    files = [path for folder in FOLDERS
             for path in sorted((root / "build/robots" / folder).rglob("*.urdf"))
             if "<link" in path.read_text(errors="replace")]
    return files[::max(1, len(files) // count)][:count]


def without_shapes(source, copy):
    text = source.read_text(encoding="utf-8", errors="replace")
    copy.write_text(re.sub(r"<(visual|collision)\b.*?</\1>", "", text, flags=re.DOTALL),
                    encoding="utf-8")
    return copy


def one(package, asset):
    """Steps both; -> what came of it."""
    import warnings

    import numpy as np

    import tenon_usd as tenon

    warnings.simplefilter("ignore")
    world = tenon.World(asset, "mujoco", ENVS)
    targets = world.drive_targets + np.linspace(-0.2, 0.2, ENVS)[:, None]
    world.drive_targets = targets
    batch = getattr(world, f"to_{package}")()
    positions, _ = batch.joints()
    begun = float(np.nanmax(np.abs(positions - world.joint_positions), initial=0))
    started = world.joint_positions
    steps = round(SECONDS / world.time_step)
    batch.step(steps)
    world.step(steps)
    positions, _ = batch.joints()
    return {"lost": len(batch.lost), "joints": len(world.joint_names), "begun": begun,
            "missing": int(np.isnan(positions[0]).sum()),
            "moved": float(np.abs(world.joint_positions - started).max(initial=0)),
            "apart": float(np.nanmax(np.abs(positions - world.joint_positions), initial=0))}


def stepped(package, asset):
    """The same in a process of its own; a text where it ends otherwise."""
    try:
        done = subprocess.run([sys.executable, "-B", __file__, "--one", package, asset], text=True,
                              capture_output=True, timeout=LONGEST, check=False,
                              env={**os.environ, "MUJOCO_GL": "disable"})
    except subprocess.TimeoutExpired:
        return f"not in {LONGEST} s"
    lines = done.stdout.strip().splitlines()
    if done.returncode or not lines:
        reasons = re.findall(r"^[\w.]*(?:Error|Exception)\b.*", done.stderr, re.MULTILINE)
        return (reasons or done.stderr.strip().splitlines() or ["it ended"])[-1][:200]
    return json.loads(lines[-1])


def verdict(package, found):
    """What a batch is counted as."""
    if isinstance(found, str):
        return "listed"
    if found["begun"] > 1e-5:
        return "wrong"
    if found["apart"] <= CLOSE[package] and not found["missing"]:
        return "alike"
    return "told" if found["lost"] else "wrong"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    count = int(sys.argv[2]) if len(sys.argv) > 2 else COUNT
    packages = sys.argv[3:] or list(CLOSE)
    import tenon_usd as tenon

    counts = {package: {} for package in packages}
    with tempfile.TemporaryDirectory() as folder:
        for number, source in enumerate(chosen(root, count)):
            asset = pathlib.Path(folder) / f"{number}.usda"
            try:
                tenon.convert(without_shapes(source, asset.with_suffix(".urdf")), asset,
                              gains=(50, 5))
            except tenon.Error as error:
                print(f"{source.stem}: {error}", flush=True)
                continue
            for package in packages:
                found = stepped(package, str(asset))
                kind = verdict(package, found)
                counts[package][kind] = counts[package].get(kind, 0) + 1
                print(f"{source.stem}: {package}: {kind}: "
                      f"{found if isinstance(found, str) else json.dumps(found)}", flush=True)
    good, said = True, []
    for package, kinds in counts.items():
        made = sum(kinds.values())
        good = good and kinds.get("wrong", 0) == 0 and kinds.get("alike", 0) + \
            kinds.get("told", 0) >= (LEAST * made if package != "mjx" else 1)
        said.append(f"{package} " + ", ".join(f"{kinds[kind]} {kind}" for kind in sorted(kinds)))
    print(f"{SECONDS:g} s of {count} robots, {ENVS} environments: " + "; ".join(said))
    return 0 if good else 1


if __name__ == "__main__":
    if sys.argv[1:2] == ["--one"]:
        print(json.dumps(one(*sys.argv[2:4])))
        sys.exit(0)
    sys.exit(main())
