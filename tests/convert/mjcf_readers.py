#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""MJCF that tenon writes, loaded by others who read MJCF.

    mjcf_readers.py ROOT TENON ENGINE_PYTHON READER...

Published models (build/robots, as corpus_round_trip.py finds them, and URDF files beside them) go
through USD and back, once with the source that assets keep and once made anew of what the asset
says. Each reader, in ENGINE_PYTHON, loads the source and both. What a reader does not take of the
source is none of tenon's matter, nor are collisions that a URDF file asks for and a reader does not
implement; of all others 95 % must load. Each one that does not is printed with the reader's reason.
READER: mujoco, mujoco_warp, mjx, newton.
"""

import collections
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ENGINE, READERS = (sys.argv[3], sys.argv[4:]) if len(sys.argv) > 4 else ("", [])
sys.argv[3:] = []

from corpus_round_trip import converted, models_below  # noqa: E402
from round_trip import ROOT, without_source  # noqa: E402

LEAST = 0.95
SECONDS = 300   # for one file in one reader
URDFS = 40      # an even choice of those in build/robots
FORMS = ("kept", "anew")

# Reads paths, one on each line, and answers each with a line of JSON: null or the reason.
LOADER = """
import contextlib, io, json, sys
reader = sys.argv[1]
import mujoco
def load(path):
    if reader == "newton":
        import newton
        builder = newton.ModelBuilder()
        builder.add_mjcf(path)
        return builder
    model = mujoco.MjModel.from_xml_path(path)
    if reader == "mujoco_warp":
        import mujoco_warp
        return mujoco_warp.put_model(model)
    if reader == "mjx":
        from mujoco import mjx
        return mjx.put_model(model)
    return model
answers = sys.stdout
sys.stdout = sys.stderr
for line in sys.stdin:
    reason = None
    try:
        load(line.rstrip("\\n"))
    except BaseException as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:200]
    print(json.dumps(reason), file=answers, flush=True)
"""


class Loader:
    """A reader in a process of its own, which is made anew after it dies or takes too long."""

    def __init__(self, reader):
        self.reader, self.process = reader, None

    def load(self, path):
        """The reason why it does not load; None: it does."""
        if self.process is None:
            self.process = subprocess.Popen([ENGINE, "-B", "-c", LOADER, self.reader], text=True,
                                            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL,
                                            env={**os.environ, "JAX_PLATFORMS": "cpu"})
        try:
            self.process.stdin.write(f"{path}\n")
            self.process.stdin.flush()
            with concurrent.futures.ThreadPoolExecutor(1) as pool:
                answer = pool.submit(self.process.stdout.readline)
                try:
                    line = answer.result(timeout=SECONDS)
                except concurrent.futures.TimeoutError:
                    self.process.kill()
                    line = ""
        except BrokenPipeError:
            line = ""
        if line:
            return json.loads(line)
        self.process.kill()
        self.process = None
        return "the reader ends or takes too long"


def written(source, folder):
    """What is written of a source: paths by form, or the reason why there are none."""
    folder.mkdir()
    asset, anew = folder / "asset.usda", folder / "anew.usda"
    reason = converted(source, asset) or converted(asset, folder / "kept.xml")
    if reason:
        return reason
    if source.suffix == ".urdf":
        return {"anew": folder / "kept.xml"}
    anew.write_bytes(asset.read_bytes())
    without_source(anew)
    reason = converted(anew, folder / "anew.xml")
    return reason or {form: folder / f"{form}.xml" for form in FORMS}


def sources():
    robots = ROOT / "build/robots"
    urdfs = sorted(path for path in robots.rglob("*.urdf")
                   if "<robot" in path.read_text(encoding="utf-8", errors="replace"))
    return models_below(robots) + [urdfs[i * len(urdfs) // URDFS] for i in range(URDFS)] \
        if len(urdfs) > URDFS else models_below(robots) + urdfs


def judge(reader, made):
    """Counts of what a reader loads of each form; prints what it does not load."""
    loader, counts = Loader(reader), collections.Counter()
    for source, forms in made:
        if source.suffix == ".xml" and loader.load(source) is not None:
            counts["not its own matter"] += 1
            continue
        for form, path in forms.items():
            reason = loader.load(path)
            if reason is not None:
                print(f"{reader}: {source}: {form}: {reason}", flush=True)
            if source.suffix == ".urdf" and (reason or "").startswith("NotImplementedError"):
                counts["not implemented"] += 1
                continue
            counts[form] += 1
            counts[form, "loads"] += reason is None
    return counts


def main():
    with tempfile.TemporaryDirectory() as folder:
        found = sources()
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            results = list(pool.map(lambda each: written(each[1], pathlib.Path(folder) /
                                                         str(each[0])), enumerate(found)))
        made = [(source, forms) for source, forms in zip(found, results)
                if not isinstance(forms, str)]
        said, good = [], bool(made)
        for reader in READERS:
            counts = judge(reader, made)
            for form in FORMS:
                good = good and counts[form, "loads"] >= LEAST * counts[form] > 0
            lacks = counts["not implemented"]
            said.append(f"{reader} " + ", ".join(
                f"{counts[form, 'loads']} of {counts[form]} {form}" for form in FORMS)
                + (f", {lacks} ask for more than it implements" if lacks else ""))
    print(f"{len(made)} of {len(found)} files written; loaded by " + "; ".join(said))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
