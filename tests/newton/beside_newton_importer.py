#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon_usd.newton beside Newton's own importer: models equal, or why they differ.

    beside_newton_importer.py ROOT TENON ENGINE_PYTHON [PAGE] [--only TEXT]

Stages: those that Newton's package has, examples of this tree, the hand by variant, and conversions
of robots of build/robots. Every array of the two builders and every key of the two answers are
compared (both_importers.py). Each difference has to be one of known_differences.txt, which says
which side is right, and each row there has to be met. Processor time is that of one import each, in
one process, after a first one of each. PAGE gets the table between its marks. Good when at least
100 stages are imported by both, no difference is unknown, and tenon takes a fifth of the time at
most.
"""

import argparse
import collections
import fnmatch
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
KNOWN = HERE / "known_differences.txt"
STAGES = 100     # to be imported by both
FASTER = 5.0     # times, of the sums
ROBOTS = 2       # every so many of the URDF files of build/robots
SMALL = 200_000  # bytes of a description, at most
MARKS = re.compile(r"(<!-- newton: .*? -->\n)(.*?)(<!-- end of newton -->)", re.S)
HAND = "examples/inspire_hand/inspire_hand.usda"
WARM = "examples/scenes/box_on_quad.usda"


def known():
    """-> reasons {key: (who is right, why)}, rows [(pattern, key, arrays)]"""
    reasons, rows = {}, []
    for line in KNOWN.read_text(encoding="utf-8").splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        cells = [cell.strip() for cell in line.split("|")]
        if cells[0] == "reason":
            reasons[cells[1]] = (cells[2], cells[3])
        else:
            rows.append((cells[0], cells[1], cells[2].split()))
    unknown = {key for _, key, _ in rows} - set(reasons)
    if unknown:
        sys.exit(f"{KNOWN.name}: no reason {sorted(unknown)}")
    return reasons, rows


def site_of(root, work):
    """A folder with the package alone, apart from the NumPy that it was installed with."""
    installed = next((root / "build/wheel/clean/lib").glob("python*/site-packages"), None)
    if installed is None:
        sys.exit("skipped: no package (python/tests/install.sh)")
    site = work / "site"
    site.mkdir()
    for each in installed.glob("tenon_usd*"):
        if each.name != "tenon_usd":
            (site / each.name).symlink_to(each)
    package = site / "tenon_usd"
    package.mkdir()
    for each in (installed / "tenon_usd").iterdir():
        if each.suffix != ".py" and each.name not in ("__pycache__", "newton", "sweep"):
            (package / each.name).symlink_to(each)
    for each in (root / "python/tenon_usd").iterdir():  # the sources as they are now
        if each.name != "__pycache__" and not (package / each.name).exists():
            (package / each.name).symlink_to(each)
    return site


def of_newton(engine):
    """Stages of Newton's package by name."""
    found = subprocess.run([engine, "-c", "import importlib.util as u; "
                            "print(u.find_spec('newton').submodule_search_locations[0])"],
                           capture_output=True, text=True, check=True).stdout.strip()
    folder = pathlib.Path(found)
    for path in sorted(folder.rglob("*.usd*")):
        yield f"newton/{path.relative_to(folder)}", path


def of_tree(root, work):
    for path in sorted((root / "examples/scenes").glob("*.usda")):
        yield f"examples/scenes/{path.name}", path
    yield "examples/inspire_hand/grasp.usda", root / "examples/inspire_hand/grasp.usda"
    for variant in ("physics", "physx", "mujoco"):
        path = work / f"hand_{variant}.usda"
        path.write_text(
            f'#usda 1.0\n(\n    defaultPrim = "inspire_hand"\n    metersPerUnit = 1\n'
            f'    upAxis = "Z"\n    subLayers = [@{root / HAND}@]\n)\n'
            f'over "inspire_hand" (\n    variants = {{\n        string Physics = "{variant}"\n'
            "    }\n)\n{\n}\n", encoding="utf-8")
        yield f"hand/{variant}", path


def robots(root, tenon, work, only):
    """Conversions of robots, by the name of the description; those alone that have `only` in it."""
    below = root / "build/robots"
    urdf = [each for each in sorted(below.rglob("*.urdf")) if each.stat().st_size <= SMALL]
    mjcf = sorted((below / "dm_control/suite").glob("*.xml"))
    for number, source in enumerate([*urdf[::ROBOTS], *mjcf]):
        name = f"robots/{source.name}"
        if only not in name:
            continue
        target = work / f"robot{number}"
        done = subprocess.run([tenon, "convert", source, target], capture_output=True, check=False)
        made = sorted(target.glob("*.usda"))
        if done.returncode == 0 and made:
            yield name, made[0]


def is_met(name, found, rows, met):
    """What of an asset's differences no row explains."""
    left = dict(found)
    for pattern, key, arrays in rows:
        if not fnmatch.fnmatch(name, pattern):
            continue
        covered = [each for each in left
                   if any(fnmatch.fnmatch(each, array) for array in arrays)]
        for each in covered:
            met[key].add(name)
            del left[each]
        if covered:
            met[(pattern, key)].add(name)
    return left


class Importers:
    """both_importers.py in a process of its own, started again where it dies."""

    def __init__(self, engine, site):
        self._command = [engine, "-B", str(HERE / "both_importers.py")]
        self._environment = {**os.environ, "PYTHONPATH": str(site)}
        self._process = None

    def judge(self, job):
        if self._process is None:
            self._process = subprocess.Popen(
                self._command, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL, env=self._environment)
        self._process.stdin.write(json.dumps(job) + "\n")
        self._process.stdin.flush()
        line = self._process.stdout.readline()
        if not line:
            self._process = None
            return {"errors": ["died", "died"], "seconds": [0, 0], "differences": {}}
        return json.loads(line)


def differences_of(answer):
    """Arrays that differ; what one side alone refuses is told as one, too."""
    newton, tenon = answer["errors"]
    if newton and tenon:
        return {}
    if tenon:
        return {"refused": tenon}
    if newton:
        return {"newton-refuses": newton}
    return answer["differences"]


def table(reasons, met, results, ratio, middle):
    both = [name for name, answer in results.items() if not any(answer["errors"])]
    equal = [name for name in both if not results[name]["differences"]]
    lines = [f"{len(results)} stages, {len(both)} imported by both, {len(equal)} of them equal. "
             f"Processor time of Newton's importer to tenon's: {ratio:.1f} of the sums, "
             f"{middle:.1f} in the middle.", "",
             "| difference | stages | right is | why |", "|---|---|---|---|"]
    for key, (right, why) in reasons.items():
        lines.append(f"| `{key}` | {len(met[key])} | {right} | {why} |")
    return "\n".join(lines) + "\n"


def write_page(path, text):
    page = pathlib.Path(path)
    old = page.read_text(encoding="utf-8")
    new = MARKS.sub(lambda found: found[1] + text + found[3], old)
    if new != old:
        page.write_text(new, encoding="utf-8")


def run(arguments, work):
    root = pathlib.Path(arguments.root).resolve()
    tenon = os.path.abspath(arguments.tenon)
    importers = Importers(arguments.engine, site_of(root, work))
    for warm in (root / WARM, root / HAND):
        importers.judge({"file": str(warm)})
    reasons, rows = known()
    met, results, faults = collections.defaultdict(set), {}, []
    made = robots(root, tenon, work, arguments.only)
    stages = [*of_newton(arguments.engine), *of_tree(root, work), *made]
    for name, path in stages:
        if arguments.only and arguments.only not in name:
            continue
        answer = importers.judge({"file": str(path), "mujoco": "mjc" in name or "mujoco" in name})
        results[name] = answer
        for array, words in is_met(name, differences_of(answer), rows, met).items():
            faults.append(f"{name}: {array}: {words}")
    if not arguments.only:
        faults += [f"{KNOWN.name}: not met any more: {pattern} | {key}"
                   for pattern, key, _ in rows if not met[(pattern, key)]]
    return reasons, met, results, faults


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root")
    parser.add_argument("tenon")
    parser.add_argument("engine")
    parser.add_argument("page", nargs="?")
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="tenon-newton-") as folder:
        reasons, met, results, faults = run(arguments, pathlib.Path(folder))
    both = [answer for answer in results.values() if not any(answer["errors"])]
    sums = [sum(answer["seconds"][at] for answer in both) for at in (0, 1)]
    ratio = sums[0] / max(sums[1], 1e-9)
    middle = statistics.median(a / max(b, 1e-9) for a, b in (each["seconds"] for each in both))
    print("\n".join(faults))
    text = table(reasons, met, results, ratio, middle)
    print(text)
    if arguments.page and not faults and not arguments.only:
        write_page(arguments.page, text)
    equal = sum(not answer["differences"] for answer in both)
    print(f"{len(both)} of {len(results)} stages imported by both, {equal} equal, "
          f"{len(both) - equal} explained, {len(faults)} faults; "
          f"{sums[0]:.1f} s and {sums[1]:.1f} s, {ratio:.1f} times")
    if arguments.only:
        return 1 if faults else 0
    return 0 if not faults and len(both) >= STAGES and ratio >= FASTER else 1


if __name__ == "__main__":
    sys.exit(main())
