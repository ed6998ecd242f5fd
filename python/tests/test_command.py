# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the command can do and the package: every verb and option has the name in Python that does
the same, or the reason why there is none. The verbs and options are those that the program of the
package names, so that a new one without a row here fails."""

import inspect
import json
import re
import subprocess
from pathlib import Path

import support

import tenon_usd as tenon
from tenon_usd.options import OpenOptions

TENON = Path(tenon.__file__).parent / "bin/tenon"

# A row is one or more names of the package, "check(only=), check(skip=)", with the argument that
# does what the option does; or a sentence that says why there is none.
NAME = re.compile(r"[A-Za-z_.]+(\(\w+=\))?")

# How assets are read: the same for every verb.
READING = {
    "--physics": "open(physics=)", "--mask": "open(mask=)", "--unloaded": "open(payloads=)",
    "--load": "open(load=)", "--mute-layer": "open(muted=)",
    "--search-path": "open(search_paths=)", "--sandbox": "open(sandbox=)",
    "--allow-read": "open(allow_read=)", "--max-work": "open(max_work=)",
    "--reading": "open(readings=)",
}
# Of kinds (`tenon help add`): Stage.add() hands them on by their names.
KINDS = """at rotate scale size radius height width length axis file file-meters file-up prim
    intensity color angle texture focal-length gravity-direction gravity-magnitude static-friction
    dynamic-friction restitution density members filtered body0 body1 lower upper cone0 cone1 min
    max break-force break-torque collide velocity angular-velocity kinematic asleep approximation
    mass com inertia principal-axes material with dof low high stiffness damping max-force
    target-position target-velocity drive-type leader multiplier offset variant""".split()
IN_MEMORY = "edits are in memory: Stage.undo() takes them back, and nothing is written"
MASKED = "links and joints are skipped and held by tenon tune alone"
SIMREADY = "tenon convert and tenon structure have it: a browser draws the picture of it"
UPDATE = {"--update": "{0}(update=)", "--conflicts": "{0}(conflicts=)", "--force": "{0}(force=)",
          "--profile": SIMREADY, "--robot-type": "{0}(robot_type=)", "--metadata": SIMREADY,
          "--no-thumbnail": SIMREADY, "--name": "{0}(name=)", "--names": "{0}(names=)",
          "--schema": "{0}(schema=)"}


def update_of(function):
    return {option: row.format(function) for option, row in UPDATE.items()}


# Verbs that make, author and edit, option by option.
AUTHORING = {
    "add": {
        **{f"--{name}": "Stage.add(options=)" for name in KINDS},
        "asset": "open", "what": "Stage.add", "--match": "Stage.add_matching",
        "--set": "Stage.add(options=)", "--engine": "Stage.add(engine=)",
        "--in": "Stage.add(layer=)", "--dry-run": IN_MEMORY,
    },
    "cat": {
        "asset": "open", "--output": "Stage.flatten(path=)", "--flatten": "Stage.flatten",
        "--in-place": "Stage.save writes what was edited, in the format that it has",
        "--flatten-layer-stack": "a stage of Python is one scene, without the arcs of its layers",
        "--format": "the ending of the file says it",
    },
    "check": {
        "assets": "check(paths=)", "--fix": "check(fix=)", "--suggested": "check(suggested=)",
        "--dry-run": "check() without fix writes nothing, and its findings say what can be fixed",
        "--strict": "the answer counts errors and warnings", "--for": "check(for_=)",
        "--profile": "check(profile=)", "--only": "check(only=)", "--skip": "check(skip=)",
        "--sarif": "findings are dictionaries", "--baseline": "check(baseline=)",
        "--write-baseline": "the command writes it once, in a repository", "--list-rules": "rules",
        "--explain": "rule",
    },
    "colliders": {
        "asset": "colliders(path=)", "--engine": "colliders(engine=)",
        "--colliders": "colliders(colliders=)", "--try": "colliders(approximation=)",
        "--budget": "colliders(budget=)", "--gap": "colliders(gap=)", "--save": "colliders(save=)",
    },
    "convert": {
        **update_of("convert"), "input": "convert(input=)", "--output": "convert(output=)",
        "--package": "convert(packages=)", "--arg": "convert(arg=)", "--model": "convert(model=)",
        "--fix-base": "convert(fix_base=)", "--float-base": "convert(float_base=)",
        "--self-collision": "convert(self_collision=)", "--start": "convert(start=)",
        "--merge-fixed": "convert(merge_fixed=)", "--format": "convert(format=)",
        "--assets": "convert(assets=)", "--scene": "convert(scene=)", "--flat": "convert(flat=)",
        "--gains": "convert(gains=)", "--armature": "convert(armature=)",
        "--friction": "convert(friction=)", "--collision": "convert(collision=)",
        "--density": "convert(density=)",
    },
    "drives": "Stage.set(drive=) writes gains and limits; what drives need is computed by the "
              "command alone",
    "new": {
        "file": "new(path=)", "--up": "new(up_axis=)", "--meters": "new(meters_per_unit=)",
        "--kilograms": "new(kilograms_per_unit=)",
        "--time-codes-per-second": "new(time_codes_per_second=)",
        "--start-time-code": "new(start_time_code=)", "--end-time-code": "new(end_time_code=)",
        "--default-prim": "new(default_prim=)", "--force": "new(force=)",
    },
    "pairs": "Stage.set(filter=) filters pairs, Prim.remove_targets takes filters away; which "
             "never touch is computed by the command alone",
    "pose": {
        "asset": "pose(path=)", "--list": "poses", "--show": "poses", "--save": "pose(save=)",
        "--rename": "edit_poses(rename=)", "--remove": "edit_poses(remove=)",
        "--import": "edit_poses(import_=)", "--export": "poses(export=)", "--pose": "pose(pose=)",
        "--state-in": "a state of World.save() is in memory; its joints are numbers for pose()",
        "--engine": "it goes with --state-in", "--ik": "pose(ik=)", "--rotation": "pose(rotation=)",
        "--hold": "pose(hold=)", "--tolerance": "pose(tolerance=)", "--starts": "pose(starts=)",
        "--seed": "pose(seed=)", "--robot": "pose(robot=), edit_poses(robot=)",
        "--dry-run": "pose() without save writes nothing",
    },
    "remove": {
        "asset": "open", "what": "Stage.remove, Prim.remove", "--with": "Stage.remove(options=)",
        "--dof": "Stage.remove(options=)",
        "--variant": "Stage.remove(options=), Prim.remove_variant",
        "--engine": "Stage.remove(engine=)", "--dry-run": IN_MEMORY,
    },
    "rename": {
        "asset": "open", "path": "Prim.rename, Prim.rename_property", "name": "Prim.rename(name=)",
        "--dry-run": IN_MEMORY,
    },
    "set": {
        "asset": "open", "assignments": "Stage.set(assignments=), Prim.set",
        "--clear": "Stage.set(clear=), Prim.clear", "--apply": "Stage.set(apply=), Prim.apply",
        "--remove": "Stage.set(remove=), Prim.unapply", "--mass": "Stage.set(mass=)",
        "--drive": "Stage.set(drive=)", "--mimic": "Stage.set(mimic=)",
        "--collider": "Stage.set(collider=)", "--material": "Stage.set(material=)",
        "--layer": "Stage.set_metadata", "--filter": "Stage.set(filter=)",
        "--filter-overlaps": "Stage.set(filter_overlaps=)",
        "--type": "Stage.set(type_name=), Prim.set(type_name=)",
        "--in": "Stage.set(layer=), Prim.set(layer=), Prim.apply(layer=), Stage.define(layer=)",
        "--engine": "Stage.set(engine=), Prim.set(engine=), Prim.apply(engine=)",
        "--all-engines": "Stage.set(all_engines=)", "--dry-run": IN_MEMORY,
    },
    "strip": "tenon strip writes a copy without physics; Stage.remove takes single parts away",
    "structure": {
        **update_of("structure"), "asset": "structure(path=)", "--output": "structure(folder=)",
        "--in-place": "a folder of its own is never in the way", "--links": "structure(links=)",
        "--engine": "structure(engines=)",
        "--overridable-colliders": "structure(overridable_colliders=)",
        "--dry-run": "structure() without a folder writes nothing",
    },
    "tune": {
        "asset": "tune(path=)", "--joints": "tune(joints=)", "--frequency": "tune(frequency=)",
        "--damping-ratio": "tune(damping_ratio=)", "--gains": "tune(gains=)",
        "--save": "tune(save=)", "--force": "tune(force=)", "--engine": "tune(engine=)",
        "--test": "tune(test=)", "--sequence": "tune(sequence=)", "--period": "tune(period=)",
        "--amplitude": "tune(amplitude=)", "--duration": "tune(duration=)",
        "--seed": "tune(seed=)", "--adversarial": "tune(adversarial=)",
        "--search": "tune(search=)", "--overshoot": "tune(overshoot=)",
        "--settle": "tune(settle=)", "--payload": "tune(masses=)", "--at": "tune(at=)",
        "--poses": "tune(poses=)", "--dt": "tune(time_step=)", "--set": "tune(overrides=)",
        "--deactivate": MASKED, "--bypass": MASKED, "--anchor": MASKED,
        "--output": "the answer is what .json has, its rows are tables; tenon tune -o draws the "
                    "page",
    },
    "undo": {"asset": "undo(path=), Stage.undo", "--dry-run": "undo(dry_run=)"},
    "variant": {
        "asset": "open", "selection": "Prim.select_variant, Prim.variants", "--prim": "Stage.prim",
        "--output": "Stage.flatten writes the scene with it", "--in-place": "Stage.save",
    },
    "zip": "tenon zip packs; Stage.flatten writes a package of what is composed",
}
# What else there is; no row for each option, since nothing is authored.
OTHERS = {
    "bake": "tenon_usd.recording takes the motion of a World",
    "bench": "a World counts what it steps",
    "benchmark": "verdicts on whole assets are the command's", "compare": "compare",
    "completion": "of a shell", "diff": "diff", "doctor": "doctor",
    "dump": "Stage.prims and Prim read the same",
    "dump-index": "Prim.arcs and Stage.where read the same",
    "excite": "tenon_usd.identify has it", "explain": "explain", "help": "help() of Python",
    "identify": "tenon_usd.identify has it", "inertia": "Dynamics", "info": "info",
    "manual": "of a shell", "physics": "physics", "record": "tenon_usd.rendering draws a World",
    "report": "view", "sim": "World", "sweep": "tenon_usd.sweep has it",
    "test-runner": "of conformance suites", "tree": "Stage.tree", "version": "__version__",
    "view": "a page for browsers", "where": "where",
}


def names_of(row):
    """The names of a row; none of a sentence."""
    parts = row.split(", ")
    return parts if all(NAME.fullmatch(part) for part in parts) else []


class Rows(support.FilesTestCase):
    maxDiff = None

    @classmethod
    def setUpClass(cls):
        told = subprocess.run([TENON, "help", "--json"], capture_output=True, check=True).stdout
        cls.verbs = {verb["name"]: {option["names"][-1] for option in verb["options"]}
                     for verb in json.loads(told)["verbs"]}

    def check_name(self, name):
        called, _, argument = name.rstrip("=)").partition("(")
        found = tenon
        for part in called.split("."):
            self.assertTrue(hasattr(found, part), f"{name}: tenon_usd has no {called}")
            found = getattr(found, part)
        if not argument or argument in OpenOptions.__annotations__:
            return
        if inspect.isfunction(found):
            self.assertIn(argument, inspect.signature(found).parameters, name)
        else:  # of the extension: the signature is in front of the text
            self.assertRegex(found.__doc__.split("\n")[0], rf"[(,] \*{{0,2}}{argument}: ", name)

    def test_every_verb(self):
        self.assertEqual(self.verbs.keys(), AUTHORING.keys() | OTHERS.keys())
        self.assertEqual(AUTHORING.keys() & OTHERS.keys(), set())
        for verb, row in {**OTHERS, **AUTHORING}.items():
            if isinstance(row, str):
                with self.subTest(verb):
                    for name in names_of(row):
                        self.check_name(name)

    def test_every_option_of_verbs_that_author(self):
        for verb, rows in AUTHORING.items():
            if isinstance(rows, str):
                continue
            with self.subTest(verb):
                self.assertEqual(self.verbs[verb] - READING.keys(), rows.keys())
        for rows in [READING, *AUTHORING.values()]:
            for option, row in rows.items() if isinstance(rows, dict) else ():
                with self.subTest(option=option, row=row):
                    for name in names_of(row):
                        self.check_name(name)


if __name__ == "__main__":
    support.main()
