#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The table of README.md beside other tools: what each needs on disk, and what it makes of the
example hand, as URDF and as USD.

usage: beside_tools.py                      compares README.md with the recorded results
       beside_tools.py --write              writes the table into README.md
       beside_tools.py --measure FOLDER TENON [TOOL...]
                                            measures; writes bench/results/beside_tools.json

Each tool gets a virtual environment of its own in FOLDER, with the version below and what pip
chooses beside it (Isaac's importer needs a Python 3.12). tenon is installed by CMake from the build
that TENON is part of, with every engine. The hand is examples/inspire_hand; its URDF is the one
that tenon writes. Exit 0: good; 1: the table differs.
"""

import json
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RESULTS = ROOT / "bench/results/beside_tools.json"
PAGE = ROOT / "README.md"
TABLE = re.compile(r"(<!-- beside other tools: .*? -->\n).*?(<!-- end -->)", re.S)
HAND = ROOT / "examples/inspire_hand/inspire_hand.usda"
PYTHONS = {"isaac": "python3.12"}
COMPONENTS = ("runtime", "program")
ISAAC = """
import sys
from isaacsim.asset.importer.urdf import URDFImporter, URDFImporterConfig
print(URDFImporter(URDFImporterConfig(urdf_path=sys.argv[1], usd_path=sys.argv[2])).import_urdf())
"""
MUJOCO = """
import sys, mujoco, numpy
model = mujoco.MjSpec.from_file(sys.argv[1]).compile()
data = mujoco.MjData(model)
mujoco.mj_step(model, data, int(1 / model.opt.timestep))
assert numpy.isfinite(data.qpos).all()
"""
NEWTON = """
import sys, newton, numpy
builder = newton.ModelBuilder()
newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
builder.add_usd(sys.argv[1])
model = builder.finalize(device="cpu")
solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
one, two = model.state(), model.state()
for _ in range(500):
    solver.step(one, two, model.control(), None, 0.002)
    one, two = two, one
assert numpy.isfinite(one.joint_q.numpy()).all()
"""
# What a converted file has where it is opened as it is, read by usd-core.
COUNT = """
import sys
from pxr import Usd
stage = Usd.Stage.Open(sys.argv[1])
prims = list(stage.Traverse(Usd.TraverseInstanceProxies()))
moving = [p for p in prims if p.GetTypeName() in ("PhysicsRevoluteJoint", "PhysicsPrismaticJoint")]
names = [f"drive:{kind}:physics:stiffness" for kind in ("angular", "linear")]
gains = [p for p in moving if any(p.GetAttribute(name) and p.GetAttribute(name).Get()
                                  for name in names)]
print(len(moving), "joints,", len(gains), "driven,",
      sum(p.GetTypeName() == "Mesh" for p in prims), "meshes")
"""
# name -> (title, what pip installs, URDF to USD, simulation of the USD for 1 s)
TOOLS = {
    "tenon": ("tenon", None,
              ["{bin}/tenon", "convert", "{urdf}", "{out}/", "--gains", "2.86,0.086"],
              ["{bin}/tenon", "sim", "{usd}", "--duration", "1"]),
    "usd-core": ("usd-core 26.11", ["usd-core==26.11"], None, None),
    "isaac": ("Isaac's importer 6.2.0", ["isaacsim-asset-isolated==6.2.0.0"],
              ["{bin}/python", "-c", ISAAC, "{urdf}", "{out}"], None),
    "urdf-usd-converter": ("urdf-usd-converter 0.3.4", ["urdf-usd-converter==0.3.4"],
                           ["{bin}/urdf_usd_converter", "{urdf}", "{out}"], None),
    "newton": ("Newton 1.8.0", ["newton[sim,importers]==1.8.0"], None,
               ["{bin}/python", "-c", NEWTON, "{usd}"]),
    "mujoco-usd": ("mujoco-usd 4.0.1", ["mujoco-usd==4.0.1"], None,
                   ["{bin}/python", "-c", MUJOCO, "{usd}"]),
}
ROWS = [("disk", "installed, on disk"), ("urdf", "example hand, URDF to USD: processor time"),
        ("found", "the USD as it opens"), ("usd", "example hand, USD: simulates 1 s")]


def megabytes(folder):
    return int(subprocess.run(["du", "-sm", folder], capture_output=True, check=True,
                              text=True).stdout.split()[0])


def environment(folder, name, packages):
    """Makes it where it is missing. -> (folder with programs, MB that the packages added)"""
    place = folder / name
    note = place / "megabytes"
    if not note.exists():
        python = PYTHONS.get(name, sys.executable)
        subprocess.run([python, "-m", "venv", "--clear", place], check=True)
        before = megabytes(place)
        subprocess.run([place / "bin/pip", "install", "-q", "--disable-pip-version-check",
                        *packages], check=True)
        note.write_text(str(megabytes(place) - before), encoding="utf-8")
    return place / "bin", int(note.read_text(encoding="utf-8"))


def installed(folder, tenon):
    """tenon with every engine, without symbols. -> (folder with programs, MB)"""
    build, prefix = pathlib.Path(tenon).parent.parent, folder / "tenon"
    shutil.rmtree(prefix, ignore_errors=True)
    for component in COMPONENTS:
        subprocess.run(["cmake", "--install", build, "--prefix", prefix, "--strip", "--component",
                        component], check=True, capture_output=True)
    return prefix / "bin", megabytes(prefix)


def last_words(text):
    """The last line of an error that says something, without paths."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    said = [line for line in lines if re.match(r"\w*(Error|error)", line)]
    said = said or lines or ["no message"]
    return re.sub(r"^\w+: (Error: )?", "", said[-1])


def processor_seconds():
    """Of all processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def converted(command, words, folder):
    """-> (cell, file that was made): the median of five processes"""
    seconds = []
    for _ in range(5):
        shutil.rmtree(words["out"], ignore_errors=True)
        start = processor_seconds()
        done = subprocess.run([word.format(**words) for word in command], cwd=folder,
                              capture_output=True, text=True, check=False)
        seconds.append(processor_seconds() - start)
        if done.returncode:
            return f"fails: {last_words(done.stderr)}", None
    tops = [path for path in pathlib.Path(words["out"]).rglob("*.usd*")
            if path.parent.name.lower() not in ("payload", "payloads", "physics")]
    return f"{statistics.median(seconds):.2f} s", min(tops, key=lambda path: len(path.parts))


def measure(folder, tenon, names):
    results = json.loads(RESULTS.read_text(encoding="utf-8")) if RESULTS.exists() else {}
    urdf = folder / "hand/hand.urdf"
    urdf.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([tenon, "convert", HAND, urdf, "--force", "-q"], check=True)
    reader, _ = environment(folder, "usd-core", TOOLS["usd-core"][1])
    for name in names or TOOLS:
        title, packages, convert, simulate = TOOLS[name]
        programs, size = (environment(folder, name, packages) if packages
                          else installed(folder, tenon))
        words = {"bin": programs, "urdf": urdf, "usd": HAND, "out": folder / f"out_{name}"}
        row = {"title": title, "disk": f"{size:,} MB"}
        if convert:
            row["urdf"], made = converted(convert, words, folder)
            if made:
                row["found"] = subprocess.run([reader / "python", "-c", COUNT, made], check=True,
                                              capture_output=True, text=True).stdout.strip()
        if simulate:
            done = subprocess.run([word.format(**words) for word in simulate], cwd=folder,
                                  capture_output=True, text=True, check=False)
            row["usd"] = "yes" if done.returncode == 0 else f"fails: {last_words(done.stderr)}"
        results[name] = row
        print(name, row, flush=True)
    results = {name: results[name] for name in TOOLS if name in results}
    RESULTS.write_text(json.dumps(results, indent=1) + "\n", encoding="utf-8")


def table(results):
    tools = list(results.values())
    lines = ["| | " + " | ".join(tool["title"] for tool in tools) + " |",
             "|---" * (len(tools) + 1) + "|"]
    for key, title in ROWS:
        lines.append(f"| {title} | " + " | ".join(tool.get(key, "-") for tool in tools) + " |")
    return "\n".join(lines) + "\n"


def main():
    if sys.argv[1:2] == ["--measure"]:
        measure(pathlib.Path(sys.argv[2]).resolve(), str(pathlib.Path(sys.argv[3]).resolve()),
                sys.argv[4:])
        return 0
    text = PAGE.read_text(encoding="utf-8")
    wanted = TABLE.sub(lambda found: found[1] + table(json.loads(
        RESULTS.read_text(encoding="utf-8"))) + found[2], text)
    if "--write" in sys.argv:
        PAGE.write_text(wanted, encoding="utf-8")
    elif text != wanted or not TABLE.search(text):
        print("README.md does not show the recorded results: bench/beside_tools.py --write")
        return 1
    print(f"the table of README.md has the {len(TOOLS)} tools as they were measured")
    return 0


if __name__ == "__main__":
    sys.exit(main())
