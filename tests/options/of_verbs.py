# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Options of each verb. A function of the choices that the program's own table has -> its rows."""

import json
import math
import pathlib
import re

from of_assets import of_assets, of_every_verb, of_settings
from of_runs import HINGE, of_commands, of_masks, of_starts, of_steps
from option_row import Row

ROOT = pathlib.Path(__file__).resolve().parents[2]


def file(name):
    return lambda outcome: outcome.files.get(name)


def answered(*keys):
    """A value of the answer."""
    def value(outcome):
        found = outcome.answer
        for key in keys:
            found = found[key]
        return found
    return value


def becomes(see, value):
    """True of a run of which `see` has that value, and had not without the option."""
    def wanted(without, outcome, engine):
        after = value(engine) if callable(value) else value
        return see(outcome) == after and see(without) != after
    return wanted


def of_one_engine(see):
    """The engine that is asked for is the one that runs; without the option it is MuJoCo."""
    return Row("--engine", ("--engine", "{engine}"), leaves_out=("--engine",),
               wanted=lambda before, after, engine: see(before) == "mujoco" and
               see(after) == engine)


def frames(outcome):
    """Of a log."""
    return [json.loads(line) for line in outcome.files["run.jsonl"].decode().splitlines()
            if '"time"' in line]


def numbers(value):
    """All numbers below a value of JSON."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for each in value for number in numbers(each)]
    return [value] if isinstance(value, (int, float)) else []


def below(value, key):
    """All numbers below keys of that name."""
    if isinstance(value, dict):
        here = numbers(value[key]) if key in value else []
        return here + [number for each in value.values() for number in below(each, key)]
    return [number for each in value for number in below(each, key)] if isinstance(
        value, list) else []


# What a series is called in a frame of the log, where it is not called as the series.
KEYS = {"efforts": "driveEffort", "reactions": "reactionForce",
        "accelerations": "linearAcceleration"}


def has_numbers_of(series):
    """True where the log has the series from its first frame on, finite, and not always 0; without
    the option there is none of it."""
    key = KEYS.get(series, series)

    def wanted(without, outcome, _):
        listed = frames(outcome)
        found = [below(frame, key) for frame in listed]
        every = [number for frame in found for number in frame]
        return not below(frames(without)[-1], key) and any(every) and (
            series == "contacts" or all(found)) and all(map(math.isfinite, every))
    return wanted


def enumerators(header, name):
    """Of an enumeration in the sources, as the program writes them."""
    text = (ROOT / header).read_text()
    body = re.search(r"enum class " + name + r"[^{]*\{(.*?)\};", text, re.DOTALL)[1]
    return [one[0].lower() + one[1:] for one in re.findall(r"^\s*(\w+),", body, re.MULTILINE)]


def reads(kind):
    """True where a sensor of that kind reads finite numbers in every frame, and not always 0."""
    def wanted(_, outcome, __):
        found = [[numbers(sensor) for sensor in frame["sensors"].values() if sensor["kind"] == kind]
                 for frame in frames(outcome)]
        every = [number for frame in found for sensor in frame for number in sensor]
        return all(found) and any(every) and all(map(math.isfinite, every))
    return wanted


def of_logs(choices):
    yield Row("--output", ("-o", "run.csv"), sees=file("run.csv"))
    for ending in choices["--format"]:
        yield Row("--format", ("-o", "run", "--format", ending), sees=file("run"),
                  wanted=lambda _, out, __: out.files.get("run"))
    for series in choices["--log"]:
        yield Row("--log", ("--log", series), with_=("-o", "run.jsonl"),
                  wanted=has_numbers_of(series))
    for kind in enumerators("tenon/scene/sensors.h", "SensorKind"):
        yield Row("--log", ("--log", "sensors"), with_=("-o", "run.jsonl"), wanted=reads(kind))
    yield Row("--fps", ("--fps", "20"), with_=("-o", "run.jsonl"),
              sees=lambda outcome: len(frames(outcome)))


def of_states():
    yield Row("--state-out", ("--state-out", "end.state"), sees=file("end.state"))
    yield Row("--state-in", ("--state-in", "{folder}/{engine}.state"))
    yield Row("--until", ("--until", "rest"), asset="resting.usda", with_=("--duration", "1"),
              sees=answered("time"))
    yield Row("--bake", ("--bake", "motion.usda"), sees=file("motion.usda"))
    yield Row("--timing", ("--timing",), wanted=lambda _, out, __: out.answer["realTimeFactor"] > 0)


def sim(choices):
    yield from of_every_verb()
    yield from of_assets()
    yield of_settings(answered("engine"))
    yield of_one_engine(answered("engine"))
    yield Row("--duration", ("--duration", "0.2"), wanted=becomes(
        lambda o: round(o.answer["time"], 6), 0.2))
    yield from of_steps(choices)
    yield from of_starts()
    yield from of_commands()
    yield from of_logs(choices)
    yield from of_states()


# What --vary may name beside the fields of the description: the parameters of engines.
PARAMETERS = {"bodyMass": 2, "colliderFriction": 0.3, "driveStiffness": 3, "driveDamping": 3,
              "driveMaxForce": 0.1, "jointDamping": 50, "jointFriction": 9, "jointArmature": 9}
OTHERS = ("gravity=0.5", "jointPosition@/World/Hinge=0.3", "bodyPosition@/World/Slider=0.2")
REFUSED = {"jointFriction=9": {"physx": "jointFriction acts on PhysX where the joint has neither"}}
FIELDS = ("colliders.shape.halfExtents=0.9", "joints.upper@/World/Hinge=0.02",
          "bodies.linearVelocity@/World/Slider=2")


def bench(choices):
    del choices
    yield from of_every_verb()
    yield from of_assets()
    yield of_settings(answered("engine"))
    yield of_one_engine(answered("engine"))
    yield Row("--envs", ("--envs", "3"), wanted=becomes(answered("environments"), 3))
    yield Row("--threads", ("--threads", "2"), wanted=lambda before, after, _: (
        before.answer["threads"], after.answer["threads"]) == (1, 2) and before.seen == after.seen)
    yield Row("--duration", ("--duration", "0.2"))
    yield Row("--dt", ("--dt", "0.001"))
    yield Row("--steps", ("--steps", "7"), same=("mujoco", "physx", "jolt"))
    parameters = enumerators("tenon/engines/simulation_values.h", "Parameter")
    for what in (*(f"{name}={PARAMETERS[name]}" for name in parameters), *OTHERS, *FIELDS):
        yield Row("--vary", ("--vary", what), refused=REFUSED.get(what, {}))
    yield Row("--seed", ("--seed", "5"), with_=("--vary", "gravity=0.5..2"))
    yield from of_masks()
    yield Row("--reading", ("--reading", "unbound-friction=zero"))
    yield Row("--set", ("--set", "/World/Slider.physics:velocity=(0.5, 0, 0)"))


def metrics_of(outcome):
    return [gap["metric"] for pair in outcome.answer["pairs"] for gap in pair["gaps"]]


def compare(choices):
    yield from of_every_verb()
    yield from of_assets()
    yield Row("--no-settings", ("--no-settings",), asset="settled/main.usda", once=True,
              leaves_out=("--engines",), wanted=lambda before, after, _: (
                  before.answer["engines"][0]["name"], after.answer["engines"][0]["name"]) == (
                      "jolt", "mujoco"))
    yield Row("--engines", ("--engines", "{engine}"), leaves_out=("--engines",),
              refused={"*": "two|second"})
    yield Row("--engines", ("--engines", "{other},{engine}"), wanted=lambda _, out, engine: [
        run["engine"] for run in out.answer["engines"]][1] == engine)
    yield Row("--engines", ("--engines", "{engine}:light,{engine}:heavy"),
              wanted=lambda _, out, e: [(run["engine"], run["variant"])
                                        for run in out.answer["engines"]] == [
                                            (e, "light"), (e, "heavy")])
    yield Row("--duration", ("--duration", "0.2"))
    yield Row("--dt", ("--dt", "0.001"))
    yield Row("--fps", ("--fps", "20"))
    yield from of_starts()
    yield from of_commands()
    for metric in choices["--metrics"]:
        yield Row("--metrics", ("--metrics", metric), wanted=lambda before, after, _, m=metric: (
            set(metrics_of(after)) == {m} and len(set(metrics_of(before))) > 1))
    yield Row("--fail-above", ("--fail-above", "position=1e-12mm"),
              wanted=lambda before, after, _: (before.code, after.code) == (0, 1))
    yield Row("--trials", ("--trials", "1"), leaves_out=("--no-reasons",), sees=answered("pairs"))
    yield Row("--no-reasons", ("--no-reasons",), leaves_out=("--no-reasons",),
              sees=answered("pairs"))
    for ending in (".html", ".json", ".csv"):
        yield Row("--output", ("-o", "gaps" + ending), sees=file("gaps" + ending))
    yield Row("--timing", ("--timing",), sees=lambda o: sorted(o.answer["engines"][0]))


GLB = {"with_": ("-o", "motion.glb"), "sees": lambda o: len(o.files["motion.glb"])}


def bake(choices):
    yield from of_every_verb()
    yield from of_assets()
    yield Row("--no-settings", ("--no-settings",), asset="settled/main.usda",
              leaves_out=("--engine",), once=True)
    yield Row("--engine", ("--engine", "{engine}"), leaves_out=("--engine",), same=("mujoco",))
    yield Row("--duration", ("--duration", "0.2"))
    yield Row("--fps", ("--fps", "20"))
    yield from of_steps(choices)
    yield from of_starts()
    yield Row("--output", ("-o", "other.usda"), sees=file("other.usda"))
    yield Row("--simplify", ("--simplify", "100"), **GLB)
    yield Row("--compress", ("--compress",), **GLB)
    yield Row("--simplify", ("--simplify", "100"), refused={"*": "--simplify"})
    yield Row("--compress", ("--compress",), refused={"*": "--compress"})
    yield Row("--uninstance", ("--uninstance",))
    yield Row("--uninstance", ("--uninstance",), with_=("-o", "motion.glb"), once=True,
              refused={"*": "--uninstance is of layers"})
