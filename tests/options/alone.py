#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every option of every verb, given alone: something changes, or the option is refused by name.

    alone.py TENON [VERB...]

The options are those of the program's own table (`tenon help --json`). Each verb runs twice on the
asset of scenes.py, or on a robot's description, without the option and with nothing but it; what
is printed and which files there are afterwards is compared. Where nothing differs, LIKE_BEFORE has
the reason, or it is a fault; a row that is not needed is one, too.

Then what the table says of options that need others (`onlyWith`) or exclude them (`notWith`) is
tried: each is refused as an error of usage that names both.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests/engines_beside"), str(pathlib.Path(__file__).parent)]

# pylint: disable=wrong-import-position
import scenes

ROBOT = """<robot name="r">
  <link name="a"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  <collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="b"><collision><geometry><mesh filename="m.obj"/></geometry></collision></link>
  <link name="c"><inertial><mass value="1"/>
  <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
  <limit lower="0.5" upper="1" effort="9" velocity="9"/></joint>
  <joint name="k" type="fixed"><parent link="a"/><child link="c"/><origin xyz="2 0 0"/></joint>
</robot>
"""
MESH = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"

HINGE = "/World/Hinge"
RUN = ["--duration", "0.02", "--engine", "mujoco"]
# What the verb is given besides.
WORDS = {
    "add": ["main.usda", "/World/new=sphere"],
    "bake": ["main.usda", "-o", "out.usda", *RUN],
    "bench": ["main.usda", "--envs", "3", "--threads", "1", "--json", *RUN],
    "benchmark": ["main.usda", "--tests", "velocity_limit,drive_gain_validation", "--json",
                  "--engine", "mujoco"],
    "cat": ["main.usda"],
    "check": ["main.usda"],
    "colliders": ["main.usda"],
    "compare": ["main.usda", "--duration", "0.02", "--engines", "mujoco,mujoco:heavy", "--json"],
    "convert": ["r.urdf", "made.usda"],
    "diff": ["main.usda", "other.usda"],
    "drives": ["main.usda"],
    "dump": ["main.usda"],
    "dump-index": ["main.usda", "/World/Loaded"],
    "explain": ["main.usda", "/World/Slider"],
    "inertia": ["main.usda"],
    "info": ["main.usda"],
    "new": ["made.usda"],
    "pairs": ["main.usda", "--json"],
    "physics": ["main.usda", "--json"],
    "pose": ["main.usda", "--json"],
    "remove": ["resting.usda", "/World/Box"],
    "rename": ["resting.usda", "/World/Box", "Crate"],
    "set": ["main.usda", "/World/Slider.size=3"],
    "sim": ["main.usda", *RUN],
    "strip": ["main.usda", "-o", "out.usda"],
    "structure": ["main.usda", "-o", "out"],
    "tree": ["main.usda"],
    "tune": ["main.usda"],
    "undo": ["main.usda"],
    "variant": ["main.usda", "Physics=heavy", "-o", "out.usda"],
    "where": ["main.usda", "/World/Slider.physics:velocity"],
    "zip": ["main.usda", "-o", "out.usdz"],
}
# Why not here.
ELSEWHERE = {
    "view": "every_option.py", "record": "every_option.py",
    "report": "tests/view/test_report.py", "sweep": "tests/sweep",
    "excite": "python/tests/test_excite.py",
    "identify": "python/tests/test_identify.py",
    "completion": "has none", "doctor": "has none", "help": "has none", "manual": "has none",
    "test-runner": "has none", "version": "has none",
}
# Options of assets that name files elsewhere: of_assets.py.
OF_FILES = ("--search-path", "--sandbox", "--allow-read", "--max-work")

VALUES = {
    "--at": "1,2,3", "--rotate": "10,20,30", "--scale": "1,2,3", "--size": "3", "--radius": "3",
    "--physics": "heavy", "--mask": "/World/Slider", "--load": "none", "--mute-layer": "parts.usda",
    "--reading": "unbound-friction=zero", "--pose": "Hinge=80deg", "--engine": "jolt",
    "--deactivate": "Hinge", "--bypass": "Hinge", "--anchor": "Slider",
    "--set": "/World/Slider.physics:velocity=(0.5, 0, 0)", "--duration": "0.04", "--dt": "0.001",
    "--iterations": "1", "--fps": "20", "--seed": "4", "--commands": "commands.csv",
    "--output": "more.usda", "--vary": "gravity=0.5", "--threads": "2", "--envs": "2",
    "--steps": "3", "--only": "mass", "--skip": "body.no-collider", "--explain": "mass.total",
    "--sarif": "out.sarif", "--baseline": "baseline.json", "--write-baseline": "base.json",
    "--metrics": "position", "--fail-above": "position=1e-12mm", "--trials": "1",
    "--package": "x=.", "--arg": "x=y", "--name": "other", "--model": "x", "--gains": "5,1",
    "--armature": "0.2", "--friction": "0.2", "--collision": "sphere", "--density": "500",
    "--assets": "meshes",
    "--variant": "heavy", "--tolerance": "1000", "--sample": "3", "--specs": "specs.toml",
    "--mimic": "rigid", "--session": "session.usda", "--variant-fallback": "Physics=heavy",
    "--full-arrays": "100000", "--meters": "0.01", "--kilograms": "0.001",
    "--default-prim": "Other",
    "--time-codes-per-second": "30", "--start-time-code": "3", "--end-time-code": "9",
    "--srdf": "out.srdf", "--filter": "/World/Slider,/World/Said", "--in": "extra.usda",
    "--unfilter": "/World/Slider,/World/Said", "--clear": "/World/Slider.physics:velocity",
    "--apply": "/World/Seen=PhysicsCollisionAPI", "--remove": "/World/Said=PhysicsMassAPI",
    "--mass": "/World/Slider=3", "--drive": HINGE + "=stiffness:10", "--type": "float",
    "--collider": "/World/Seen=convexHull", "--material": "/World/Slider=/World/Rough",
    "--layer": "timeCodesPerSecond=30", "--state-in": "begin.state", "--state-out": "end.state",
    "--bake": "motion.usda", "--joints": "Hinge", "--frequency": "3", "--damping-ratio": "0.5",
    "--metadata": "author=Somebody",
    "--sequence": "Hinge", "--period": "1", "--amplitude": "2", "--time": "3", "--prim": "/World",
    "--extract": "out", "--simplify": "100", "--with": "/World/Slider", "--dof": "rotX",
    "--colliders": "Slider", "--try": "hull", "--budget": "8", "--gap": "0.1",
}
OF_VERBS = {
    "add": {"--engine": "physx", "--physics": "heavy", "--set": "purpose=guide",
            "--kinematic": "true", "--asleep": "true",
            "--collide": "true", "--dof": "rotX", "--with": "/World/Slider", "--mass": "2",
            "--material": "/World/Rough", "--drive-type": "force", "--variant": "A=b",
            "--filtered": "/World", "--members": "/World", "--file": "parts.usda",
            "--leader": HINGE, "--body0": "/World/Slider", "--body1": "/World/Said",
            "--texture": "x.png", "--collider": "x", "--approximation": "convexHull",
            "--color": "1,0,0", "--com": "1,0,0", "--inertia": "1,1,1",
            "--principal-axes": "1,0,0,0", "--velocity": "1,0,0", "--angular-velocity": "1,0,0",
            "--gravity-direction": "0,0,1", "--axis": "X", "--file-up": "Z", "--prim": "/World"},
    "bench": {"--output": "x"},
    "benchmark": {"--set": HINGE + ".drive:angular:physics:stiffness=3"},
    "compare": {"--output": "gaps.json", "--engines": "mujoco:heavy,mujoco"},
    "check": {"--profile": "isaac-3.0"},
    "convert": {"--self-collision": "on", "--conflicts": "edits"},
    "diff": {"--physics": "heavy"},
    "pose": {"--show": "none", "--save": "new", "--rename": "none=other", "--remove": "none",
             "--import": "none.json", "--export": "poses.json", "--ik": "/World/Arm=0,0,1",
             "--rotation": "1,0,0,0", "--hold": "Hinge", "--robot": "/World"},
    "dump": {"--output": "out.json"},
    "new": {"--up": "Y"},
    "pairs": {"--self-collision": "off"},
    "remove": {"--engine": "physx", "--variant": "Physics=heavy"},
    "set": {"--engine": "physx", "--mimic": HINGE + "=/World/Rail,2"},
    "sim": {"--output": "run.csv"},
    "strip": {"--output": "other.usda"},
    "structure": {"--output": "elsewhere", "--engine": "newton"},
    "tune": {"--test": "sine", "--gains": "gains.toml", "--output": "out.json",
             "--anchor": "Arm", "--overshoot": "5%", "--payload": "0.5"},
    "variant": {"--output": "other.usda"},
    "zip": {"--output": "other.usdz"},
}

# Nothing differs, and this is why.
NOTHING = "the asset has nothing that it is about"
LIKE_BEFORE = {
    "bench --steps": "says when threads meet, which changes no answer",
    "check --reading": NOTHING,
    "check --for": NOTHING,
    "colliders --physics": NOTHING,
    "colliders --try": NOTHING,
    "convert --package": NOTHING,
    "convert --force": "nothing is in the way",
    "convert --update": "there is nothing to update: it is made",
    "diff --tolerance": NOTHING,
    "dump --variant-fallback": NOTHING,
    "dump-index --variant-fallback": NOTHING,
    "dump-index --mask": "the index of a prim is its own",
    "explain --unloaded": NOTHING,
    "explain --load": NOTHING,
    "explain --reading": NOTHING,
    "new --force": "nothing is in the way",
    "pairs --physics": NOTHING,
    "physics --geometry": NOTHING,
    "pose --list": "is done anyhow",
    "pose --physics": NOTHING,
    "dump-index --physics": NOTHING,
    "dump-index --session": NOTHING,
    "set --filter-overlaps": NOTHING,
    "set --type": "the attribute is there",
    "set --all-engines": NOTHING,
    "structure --force": "nothing is in the way",
    "structure --in-place": "allows what -o does not do here",
    "structure --update": "there is nothing to update: it is made",
    "structure --overridable-colliders": NOTHING,
    "tree --physics": NOTHING,
    "tune --unloaded": NOTHING,
    "tune --load": NOTHING,
    "tune --engine": "drives are judged by the steps of an engine, and these hold on all",
    "tune --dt": "drives are judged by the time step, and these hold with both",
    "tune --reading": NOTHING,
    "tune --set": NOTHING,
    "variant --physics": NOTHING,
    "variant --mask": NOTHING,
    "variant --unloaded": NOTHING,
    "variant --load": NOTHING,
    "variant --prim": "the set is looked for there anyhow",
    "where --mask": NOTHING,
    "where --unloaded": NOTHING,
    "where --load": NOTHING,
    "zip --strict": "nothing is missing",
}
# Errors that say what is missing without naming the option.
REFUSED = {
    "add --engine": "no files for single engines",
    "add --match": "is for what is put on prims",
    "set --engine": "no files for single engines",
    "pairs --unfilter": "lists the other",
    "pose --rename": "keeps no pose called",
    "tune --save": "nothing to save",
    "structure --schema": "would not be the same",
    "structure --links": "would not be the same",
    "structure --profile": "would not be the same",
}


class Program:
    def __init__(self, tenon, folder):
        self.tenon, self.folder, self.known = tenon, folder, {}
        self.home = {"PATH": "/usr/bin:/bin", "HOME": str(folder), "LC_ALL": "C.UTF-8",
                     "XDG_STATE_HOME": str(folder / "state")}
        made = folder / "made"
        made.mkdir()
        scenes.write(made)
        self.asset = made / "asset"
        shutil.copy(made / "commands.csv", self.asset)
        (self.asset / "other.usda").write_text(
            (self.asset / "main.usda").read_text().replace('"light"\n    }', '"heavy"\n    }'))
        (self.asset / "session.usda").write_text(
            '#usda 1.0\nover "World"\n{\n    int new = 1\n}\n')
        (self.asset / "r.urdf").write_text(ROBOT)
        (self.asset / "m.obj").write_text(MESH)
        (self.asset / "specs.toml").write_text("[Hinge]\nmax_effort = 5\n")
        (self.asset / "gains.toml").write_text("[Hinge]\nfrequency = 4\ndamping_ratio = 1\n")
        self.call("sim", "main.usda", "--engine", "mujoco", "--duration", "0.02", "--state-out",
                  "begin.state")
        self.call("check", "main.usda", "--write-baseline", "baseline.json")

    def call(self, *words, cwd=None):
        return subprocess.run([self.tenon, *words], capture_output=True, text=True, check=False,
                              errors="replace", cwd=cwd or self.asset, env=self.home,
                              stdin=subprocess.DEVNULL, timeout=60)

    def table(self):
        return json.loads(self.call("help", "--json").stdout)

    def outcome(self, verb, words):
        """Exit code, what was printed, and the files that are there afterwards."""
        key = (verb, *words)
        if key not in self.known:
            place = self.folder / "run"
            shutil.rmtree(place, ignore_errors=True)
            shutil.copytree(self.asset, place)
            if verb == "undo":
                self.call("set", "main.usda", "/World/Slider.size=3", cwd=place)
            done = self.call(verb, *words, cwd=place)
            files = {str(path.relative_to(place)): path.read_bytes()
                     for path in sorted(place.rglob("*")) if path.is_file()}
            if verb in ("bench", "compare"):  # times of the clock
                done.stdout = without_times(done.stdout)
            self.known[key] = (done.returncode, done.stdout, done.stderr, files)
        return self.known[key]


def without_times(text):
    answer = json.loads(text) if text.startswith("{") else {}
    for name in ("setupSeconds", "stepsPerSecond", "stepsPerCpuSecond", "realTimeFactor",
                 "bytesPerEnvironment", "seconds"):
        answer.pop(name, None)
    return json.dumps(answer)


def value_of(verb, option):
    """The words behind the option's name."""
    name = option["names"][-1]
    if option["value"] is None:
        return []
    given = OF_VERBS.get(verb, {}).get(name)
    if given is None and option["choices"]:
        given = option["choices"][-1]
    if given is None:
        given = VALUES.get(name)
    if given is None and (option["range"] or verb == "add"):
        given = "1"
    return None if given is None else [given]


def fault_of(program, verb, option):
    """-> what is wrong with an option that is given alone, and whether nothing differed."""
    name, value = option["names"][-1], value_of(verb, option)
    if value is None:
        return "no row of VALUES gives it a value", False
    given = set(option["names"])
    base = WORDS[verb]
    if verb in WORDS and given & set(base):  # the run has it anyhow: another value
        at = next(i for i, word in enumerate(base) if word in given)
        words = base[:at] + base[at + 1 + len(value):] + [name, *value]
    else:
        words = [*base, name, *value]
    before, after = program.outcome(verb, base), program.outcome(verb, words)
    if before[0] not in (0, 1):
        return f"without it: {before[2][:300]}", False
    named = (*given, *value, REFUSED.get(f"{verb} {name}", name))
    if after[0] == 2 and not any(word in after[2] + after[1] for word in named):
        return f"ends with an error that does not name it: {(after[2] or after[1])[:300]}", False
    return None, before == after


def check_alone(program, verb, options):
    for option in options:
        name = option["names"][-1]
        if option["positional"] or name in OF_FILES:
            continue
        fault, same = fault_of(program, verb, option)
        key = f"{verb} {name}"
        if fault:
            yield f"{key}: {fault}"
        elif same and key not in LIKE_BEFORE:
            yield f"{key}: changes nothing, and nothing is said"
        elif not same and key in LIKE_BEFORE:
            yield f"{key}: has a row of LIKE_BEFORE and changes something"


def typed(other, options):
    """"--test=stress" or "--vary" as words, with a value where it takes one."""
    name, _, value = other.partition("=")
    [option] = [row for row in options if name in row["names"]]
    if option["value"] is None:
        return [name]
    return [name, value or (option["choices"][-1] if option["choices"] else "1")]


def check_company(program, verb, options, every):
    """-> faults, and how many rules there are."""
    count = 0
    for option in options:
        name, value = option["names"][-1], [] if option["value"] is None else (
            value_of(verb, option) or ["1"])
        tries = [([name, *value, *typed(other, every)], other) for other in option["notWith"]]
        tries += [([name, *value], other) for other in option["onlyWith"]]
        for words, other in tries:
            count += 1
            base = WORDS.get(verb, ["main.usda"] + (
                ["-o", "out"] if verb != "view" else []))
            done = program.call(verb, *(word for word in base if word != "--json"), *words)
            company, told = other.partition("=")[0], done.stderr
            if done.returncode != 2 or "[usage.conflict]" not in told:
                yield f"{verb} {' '.join(words)}: is not refused: {told[:300]}"
            elif "has no effect with" not in told or name not in told or company not in told:
                yield f"{verb} {' '.join(words)}: does not name both: {told[:300]}"
    program.rules = getattr(program, "rules", 0) + count


def main():
    faults, count = [], 0
    with tempfile.TemporaryDirectory() as folder:
        program = Program(str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(folder))
        table = program.table()
        verbs = {row["name"]: row["options"] for row in table["verbs"]}
        faults += [f"{verb}: has no row of WORDS" for verb in verbs
                   if verb not in WORDS and verb not in ELSEWHERE]
        for verb, options in verbs.items():
            if sys.argv[2:] and verb not in sys.argv[2:]:
                continue
            faults += check_company(program, verb, options, options + table["options"])
            if verb in WORDS:
                faults += check_alone(program, verb, options)
                count += len(options)
        known = {f"{verb} {option['names'][-1]}" for verb, rows in verbs.items() for option in rows}
        faults += [f"{key}: a row of LIKE_BEFORE of no option" for key in LIKE_BEFORE
                   if key not in known]
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults; {count} options, {program.rules} rules")
    return 1 if faults or (not sys.argv[2:] and not program.rules) else 0


if __name__ == "__main__":
    sys.exit(main())
