# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a scene with a known answer is: a layer, and quantities of its run with their values.

A tolerance is what an engineer accepts at the default step of 2 ms. The methods of all engines are
of first order: of a motion with the rate w they lose about w dt / 2, and what moves with v is known
to v dt. So it is 1 to 2 % of the way that a body makes, and the scene says so where it is more.
"""

import dataclasses
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "engines_beside"))

G = 9.81
STEP = 0.002
RATE = 500  # frames per second of the log: one for each step
AXES = "xyz"
WEIGHTLESS = ["float physics:gravityMagnitude = 0"]


@dataclasses.dataclass(frozen=True)
class See:
    """One quantity of a run; `measured` takes a Run."""

    what: str
    measured: object
    expected: float
    tolerance: float


@dataclasses.dataclass(frozen=True)
class Form:
    """One scene. `says`: rules that rightly speak, since what they say is what happens; `beside`:
    messages about something else than what is measured here; `quiet`: whatever speaks is wrong,
    also where it ends the run."""

    name: str
    shows: str
    layer: str
    seconds: float
    sees: tuple
    says: tuple = ()
    beside: tuple = ()
    quiet: bool = False
    log: str = ""  # what the log has beside states
    kind: str = ""


def path_of(name):
    return name if name.startswith("/") else "/World/" + name


class Run:
    """The frames of a log, one for each step, in the units of the stage and degrees."""

    def __init__(self, frames, answer):
        self.frames, self.answer = frames, answer

    def at(self, time):
        frame = self.frames[round(time * RATE)]
        assert abs(frame["time"] - time) < STEP, (time, frame["time"])
        return frame

    def body(self, name, time):
        return self.at(time)["bodies"][path_of(name)]

    def place(self, name, time):
        return self.body(name, time)["position"]

    def velocity(self, name, time):
        return self.body(name, time)["linearVelocity"]

    def spin(self, name, time):
        return self.body(name, time)["angularVelocity"]

    def turn(self, name, time):
        return self.body(name, time)["orientation"]

    def joint(self, name, time, which=0):
        return self.at(time)["joints"][path_of(name)]["position"][which]

    def joint_speed(self, name, time, which=0):
        return self.at(time)["joints"][path_of(name)]["velocity"][which]

    def all_of(self, name, what, axis, start=0.0, end=None):
        """One component over all steps from `start` on."""
        last = None if end is None else round(end * RATE) + 1
        return [
            frame["bodies"][path_of(name)][what][axis]
            for frame in self.frames[round(start * RATE) : last]
        ]

    def contacts(self, time):
        return self.at(time)["contacts"]


def close(expected, share=0.01, least=0.001):
    return max(abs(expected) * share, least)


def moved(time, axis, way, share=0.01, least=0.001, name="A", start=None):
    """The way of a body along an axis since the start, or since `start` [s]."""
    i = AXES.index(axis)

    def measured(run):
        return run.place(name, time)[i] - run.place(name, start or 0)[i]

    since = f" from {start:g} s" if start else ""
    return See(
        f"way of {name} along {axis}{since} to {time:g} s", measured, way, close(way, share, least)
    )


def stands(time, axis, where, within, name="A"):
    i = AXES.index(axis)
    return See(
        f"{axis} of {name} at {time:g} s", lambda run: run.place(name, time)[i], where, within
    )


def speed(time, axis, value, share=0.01, least=0.005, name="A"):
    i = AXES.index(axis)
    return See(
        f"velocity of {name} along {axis} at {time:g} s",
        lambda run: run.velocity(name, time)[i],
        value,
        close(value, share, least),
    )


def turning(time, axis, value, share=0.01, least=0.5, name="A"):
    """Angular velocity [degrees/s]."""
    i = AXES.index(axis)
    return See(
        f"angular velocity of {name} about {axis} at {time:g} s",
        lambda run: run.spin(name, time)[i],
        value,
        close(value, share, least),
    )


def coordinate(time, value, within, name="J"):
    return See(
        f"coordinate of {name} at {time:g} s", lambda run: run.joint(name, time), value, within
    )


def rate(time, value, within, name="J"):
    return See(
        f"rate of {name} at {time:g} s", lambda run: run.joint_speed(name, time), value, within
    )


def turned(time, axis, degrees, within=None, name="A"):
    """A turn about one axis, below 180 degrees."""
    i = AXES.index(axis)

    def measured(run):
        turn = run.turn(name, time)
        return (math.degrees(2 * math.atan2(turn[1 + i], turn[0])) + 180) % 360 - 180

    return See(
        f"turn of {name} about {axis} at {time:g} s",
        measured,
        degrees,
        within or close(degrees, 0.01, 0.3),
    )


def turn_between(a, b):
    """[degrees], of two quaternions."""
    size = math.hypot(*a) * math.hypot(*b)
    return math.degrees(2 * math.acos(min(1, abs(sum(x * y for x, y in zip(a, b))) / size)))


def facing(time, turn, within, name="A"):
    """How far a body is turned away from an orientation (w, x, y, z)."""
    return See(
        f"turn of {name} away from the exact one at {time:g} s",
        lambda run: turn_between(run.turn(name, time), turn),
        0.0,
        within,
    )


def farthest(axis, value, within, name="A", least=False, start=0.0, what="position"):
    """The largest component over the run, or the least one."""
    i = AXES.index(axis)
    pick = min if least else max
    word = "least" if least else "largest"
    of = axis if what == "position" else f"{what} along {axis}"
    return See(
        f"{word} {of} of {name}", lambda run: pick(run.all_of(name, what, i, start)), value, within
    )


def rotate(turn, vector):
    """A vector turned by a quaternion (w, x, y, z)."""
    w, x, y, z = turn
    a, b, c = vector
    cross = (y * c - z * b, z * a - x * c, x * b - y * a)
    again = (y * cross[2] - z * cross[1], z * cross[0] - x * cross[2], x * cross[1] - y * cross[0])
    return tuple(v + 2 * (w * p + q) for v, p, q in zip(vector, cross, again))


def about(axis, degrees):
    """The quaternion of a turn about x, y or z."""
    half = math.radians(degrees) / 2
    turn = [math.cos(half), 0.0, 0.0, 0.0]
    turn[1 + AXES.index(axis)] = math.sin(half)
    return tuple(turn)


def timed(layer, codes=100):
    """The layer with a number of time codes per second."""
    return layer.replace("metersPerUnit", f"timeCodesPerSecond = {codes}\n    metersPerUnit", 1)


def samples(kind, values):
    """`values`: time code -> number or vector; the text of time samples."""
    inside = ", ".join(f"{code}: {value!r}" for code, value in values.items())
    return f"{kind}.timeSamples = {{ {inside} }}"
