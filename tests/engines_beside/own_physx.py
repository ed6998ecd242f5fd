#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The same files on PhysX twice: tenon's engine physx, and ovphysx with its own reader of USD.

usage: own_physx.py PYTHON TENON PAGE [--show] [--write]

PYTHON: one with ovphysx; TENON: one with PhysX. The rows of table.py without what the rules of
portability name, the seven scenes of examples/scenes, and the example hand. A body agrees where it
is within 1 % of its way from the start, or what half a degree at half a metre is, and within half
a degree; what does not is a row of
KNOWN, with its reason. PAGE has a part with what came of it. Exit 0: all is as KNOWN and the page
say; 1: not.
"""

import argparse
import math
import multiprocessing.pool
import os
import pathlib
import re
import sys
import tempfile

import beside
import page_part
from row import OVPHYSX, Row

# Of its way; the way of half a degree at half a metre [m]; and that half a degree.
SHARE, LEAST, DEGREES = 0.01, 0.0044, 0.5
ENGINE = ("--engine", "physx")
ROOT = beside.HERE.parent.parent
IMPACT = "_after_impact"
OWN_FILES = (  # file in examples, times [s], what the case is called beside the file
    *((f"scenes/{name}", (0.5, 0.95), "") for name in ("box_on_box", "box_on_quad")),
    *((f"scenes/{name}", (1.5, 2.5), IMPACT) for name in ("box_on_box", "box_on_quad")),
    ("scenes/spheres_with_materials", (0.5, 0.9), ""),
    ("scenes/spheres_with_materials", (1.5, 2.0), IMPACT),
    *((f"scenes/{name}", (0.5, 1.0), "") for name in ("group_filtering", "pair_filtering")),
    ("scenes/joint", (0.5, 1.0), ""),
    ("scenes/distance_joint", (0.5, 1.0), ""),
    ("inspire_hand/inspire_hand", (0.25, 0.5), ""),
)
TILTED = (
    "it lands tilted by half a degree on one edge, where both are g t dt / 2 apart (5 mm): what "
    "follows depends on that"
)
# What does not agree: name of the case -> why.
KNOWN = {
    "spheres_with_materials" + IMPACT: "ovphysx's spheres stop dead on this mesh, also with "
    "restitution 0.8 on both sides; those of the rows named bounce rebound alike",
    "box_on_box" + IMPACT: TILTED,
    "box_on_quad" + IMPACT: TILTED,
    "closing_hand": "its thumb meets the index finger after 0.3 s, and slides off it elsewhere",
    "distance_joint": "[distance-tolerance](rules/portability.distance-tolerance.md): ovphysx lets "
    "it grow beyond its bounds",
    "mesh_convexDecomposition": "another decomposition: CoACD here",
    "mesh_floor": "it slides along the edge that two triangles share, and turns there on "
    "PhysX 5.1.3",
}


class OwnFile:
    """A file as it stands, with what beside.Case has."""

    def __init__(self, name, times, suffix):
        self.path = ROOT / "examples" / f"{name}.usda"
        self.name = name.split("/")[1] + suffix
        layer = self.path.read_text(encoding="utf-8")
        shows = f"examples/{name}.usda" + suffix.replace("_", " ")
        self.row = Row(self.name, shows, layer, times)
        self.own, self.other = {}, {}
        self.job = beside.Case.job.__get__(self)


class MovingHand(OwnFile):
    """The example hand, driven to where grasp.usda leads its drives at last, as ovphysx follows no
    samples; all of them, or without its thumb."""

    def __init__(self, folder, name, times, thumb):
        super().__init__("inspire_hand/grasp", times, "")
        found = re.findall(
            r'over "(\w+)"\s*{\s*(float drive:\S+)\.timeSamples = {[^}]*: (\S+),\s*}',
            self.row.layer,
        )
        found = [row for row in found if thumb or "thumb" not in row[0]]
        moves = "".join(f'over "{joint}" {{\n{name} = {to}\n}}\n' for joint, name, to in found)
        hand = self.path.parent / "inspire_hand.usda"
        layer = (
            "#usda 1.0\n(metersPerUnit = 1\nkilogramsPerUnit = 1\nupAxis = \"Z\")\n"
            'def PhysicsScene "Scene" {}\n'
            f'def Xform "Hand" (prepend references = @{hand}@)\n'
            f'{{\nover "Physics" {{\n{moves}}}\n}}\n'
        )
        self.name = name
        self.path = pathlib.Path(folder) / f"{name}.usda"
        self.path.write_text(layer)
        shows = f"the example hand, {len(found)} drives to the grasp of grasp.usda"
        self.row = Row(self.name, shows, layer, times)


class Apart:
    """The body that is farthest beyond what it may be."""

    def __init__(self, case):
        self.error = case.own.get("error") or case.other.get("error")
        self.measure, self.metres, self.degrees = 0.0, 0.0, 0.0
        if self.error:
            return
        scale = beside.meters_per_unit(case.row.layer)
        missing = set(case.own) - set(case.other)
        if missing:
            self.error = f"ovphysx has no {sorted(missing)[0]}"
            return
        for path, ours in case.own.items():
            for a, b in zip(ours, case.other[path]):
                if not all(map(math.isfinite, b)):
                    self.error = f"ovphysx: {path} is not finite"
                    return
                way = math.dist(case.start.get(path, a[:3]), a[:3]) * scale
                metres = math.dist(a[:3], b[:3]) * scale
                degrees = beside.turn_between(a[3:], b[3:])
                self.metres, self.degrees = max(self.metres, metres), max(self.degrees, degrees)
                beyond = max(metres / max(SHARE * way, LEAST), degrees / DEGREES)
                self.measure = max(self.measure, beyond)

    def agrees(self):
        return self.error is None and self.measure <= 1

    def __str__(self):
        return self.error or f"{1000 * self.metres:.3g} mm, {self.degrees:.2g} degrees apart"


def all_cases(folder):
    plain = [
        case
        for cases in beside.all_cases(OVPHYSX, folder, None)
        for case in cases
        if not case.expects_difference()
    ]
    hands = [
        MovingHand(folder, "closing_fingers", (0.25, 0.5, 1.0), False),
        MovingHand(folder, "closing_hand", (0.25, 0.5, 1.0), True),
    ]
    return [*(OwnFile(*row) for row in OWN_FILES), *hands, *plain]


def run_tenon(tenon, case):
    case.own = beside.run_tenon(tenon, case, ENGINE)
    case.start = {}
    if "error" not in case.own:
        at_start = {path: poses[0][:3] for path, poses in beside.run_tenon(
            tenon, Start(case), ENGINE).items()}
        case.start = at_start


class Start:
    """A case at its beginning."""

    def __init__(self, case):
        self.path, self.name = case.path, case.name
        self.row = Row(case.name, "", case.row.layer, (0.0, 0.05))


def page(results):
    agreeing = [(case, apart) for case, apart in results if apart.agrees()]
    lines = f"{len(results)} scenes: {len(agreeing)} agree.\n\n"
    lines += page_part.cells("scene", "apart", "because")
    lines += "|---|---|---|\n"
    for case, apart in results:
        if not apart.agrees():
            lines += page_part.cells(case.row.shows, apart, KNOWN.get(case.name, "?"))
    own = {pathlib.Path(name).name + suffix for name, _, suffix in OWN_FILES} | {"closing_fingers"}
    lines += "\nOf those that agree:\n\n" + page_part.cells("scene", "compared at", "apart")
    lines += "|---|---|---|\n"
    for case, apart in agreeing:
        if case.name in own:
            lines += page_part.cells(
                case.row.shows,
                page_part.compared(case.row),
                f"below {page_part.below(1000 * apart.metres)} mm, "
                f"{page_part.below(apart.degrees)} degrees",
            )
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("python")
    parser.add_argument("tenon")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true", help="make the part of the page")
    parser.add_argument("--show", action="store_true", help="tell every scene's distance")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cases = all_cases(folder)
        with multiprocessing.pool.ThreadPool(os.cpu_count()) as pool:
            pool.map(lambda case: run_tenon(arguments.tenon, case), cases)
        with open(pathlib.Path(folder) / "log.txt", "w", encoding="utf-8") as log:
            beside.run_engine(OVPHYSX, arguments.python, cases, log, pathlib.Path(folder))
    results = [(case, Apart(case)) for case in cases]
    faults = 0
    for case, apart in results:
        known = case.name in KNOWN
        wrong = apart.agrees() == known
        faults += wrong
        if wrong or arguments.show:
            words = "agrees, but a reason is named" if known and wrong else apart
            print(f"{'FAULT' if wrong else 'good '} {case.name:32} {words}")
    if not faults:
        wrong = beside.held_page(arguments.page, "own_physx", page(results), arguments.write)
        if wrong:
            faults += 1
            print(wrong)
    print(f"{len(results)} scenes on PhysX twice, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
