# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What is linear in a log with efforts: the law of a drive gives its gains, the inverse dynamics
give armature, damping and friction. Least squares within bounds (scipy.optimize.lsq_linear).

    effort = stiffness (command - position) + driveDamping (command velocity - velocity)
    effort = (M a + bias - gravity) + armature a + damping v + friction sign(v)

Speeds and accelerations are derivatives of smoothed positions. It is where the fit by simulation
begins, not its result: noise of accelerations makes these numbers too small.
"""

from __future__ import annotations

import importlib
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from ..dynamics import Dynamics
from ..errors import Error
from ..sweep.cases import ExtraMissing
from .log import Array
from .model import Held, Model, has
from .parameters import POWERS, Parameter
from .stribeck import DECAY

#: Samples of the inverse dynamics.
MAX_SAMPLES = 400
#: What acts along a joint beside its weight and the inertia of links.
PLANT = ("armature", "damping", "friction", "stribeck")
#: The quantile that counts as the largest speed or effort, and by how much a model exceeds it that
#: lacks the limit.
MOST, EXCEEDED = 0.99, 1.05
#: Delays that are tried, in steps of the model.
MAX_DELAYS = 60


def scipy(part: str) -> Any:
    """A module of SciPy. Raises ExtraMissing."""
    try:
        return importlib.import_module(f"scipy.{part}")
    except ImportError as error:
        raise ExtraMissing("SciPy", "identify", "identify") from error


def smoothed(times: Array, values: Array, half: float) -> tuple[Array, Array, Array]:
    """Position, velocity and acceleration of one joint at equal times, by parabolas through the
    samples within `half` seconds."""
    signal = scipy("signal")
    step = float(np.median(np.diff(times)))
    even = np.arange(times[0], times[-1], step)
    own = np.interp(even, times, values)
    width = max(5, 2 * round(half / step) + 1)
    if even.size <= width:
        return (values, np.gradient(values, times),
                np.gradient(np.gradient(values, times), times))
    made = [signal.savgol_filter(own, width, 3, deriv=order, delta=step) for order in range(3)]
    place, speed, turn = (np.interp(times, even, each) for each in made)
    return place, speed, turn


def linear_start(model: Model, parameters: list[Parameter]) -> Array:
    """A start for every parameter, shape (P,): what efforts tell, else its own."""
    values = np.array([each.start for each in parameters])
    log = model.log
    if log.position is None or len(log) < 20:
        return values
    moves = [smoothed(log.times, log.position[:, j], 3 * log.step + 0.01)
             if has(log.position, j) else None for j in range(len(log.joints))]
    if log.effort is not None:
        optimize = scipy("optimize")
        _gains(model, parameters, values, moves, optimize)
        _plants(model, parameters, values, moves, optimize)
    _limits(model, parameters, values, moves)
    return values


def _limits(model: Model, parameters: list[Parameter], values: Array, moves: list[Any]) -> None:
    """Limits of speed and effort begin at the largest that the log has, where the model exceeds
    that: a limit that is not reached tells nothing."""
    own = [at for at, each in enumerate(parameters) if each.family in ("velocityLimit", "maxForce")
           and each.paths[0] in model.log.joints]
    if not own:
        return
    made = model.predict(parameters, values[None])
    for at in own:
        column = model.log.joints.index(parameters[at].paths[0])
        if parameters[at].family == "velocityLimit":
            place = made["position"][0, ..., column]
            real = None if moves[column] is None else moves[column][1]
            modelled = np.gradient(place, model.log.step, axis=-1)
        else:
            real = model.log.effort[:, column] if model.log.effort is not None else None
            modelled = made["effort"][0, ..., column] if "effort" in made else np.zeros(0)
        if real is None or not np.isfinite(real).any() or not np.isfinite(modelled).any():
            continue
        most, exceeded = (float(np.nanquantile(np.abs(each), MOST)) for each in (real, modelled))
        if exceeded > EXCEEDED * most > 0:
            values[at] = min(max(most, parameters[at].low), parameters[at].high)


def _of(parameters: list[Parameter], family: str, joint: str) -> int | None:
    """The number of a parameter of one joint alone, or of one and its followers."""
    for at, each in enumerate(parameters):
        if each.family == family and each.paths[0] == joint and (
                len(each.paths) == 1 or each.weights):
            return at
    return None


def _bounded(optimize: Any, matrix: Array, wanted: Array, low: Array, high: Array) -> Array:
    """Least squares within bounds; sizes are 1, for the solver ends at differences of its own."""
    size = np.sqrt((matrix ** 2).sum(axis=0))
    size = np.where(size > 0, size, 1.0)
    unit = float(np.linalg.norm(wanted)) or 1.0
    least, most = low * size / unit, high * size / unit
    done = optimize.lsq_linear(matrix / size, wanted / unit,
                               bounds=(least, np.where(most > least, most, least + 1e-12)))
    found: Array = np.asarray(done.x) * unit / size
    return found


def _gains(model: Model, parameters: list[Parameter], values: Array, moves: list[Any],
           optimize: Any) -> None:
    """Gains of drives that follow positions, each at the delay that fits the joints best that
    share it; where no delay is asked for, commands come at once."""
    delayed = [each for each in parameters if each.family == "delay"]
    for shared in [*delayed, None]:
        joints = shared.paths if shared else [
            joint for joint in model.log.joints if not any(joint in each.paths for each in delayed)]
        delay = _gains_of(model, parameters, values, moves, optimize, joints, shared is not None)
        if shared and delay is not None:
            at = next(i for i, each in enumerate(parameters) if each is shared)
            values[at] = min(max(delay, shared.low), shared.high)


def _gains_of(model: Model, parameters: list[Parameter], values: Array, moves: list[Any],
              optimize: Any, joints: Sequence[str], is_late: bool) -> float | None:
    """Sets the gains of some joints. Returns the delay that fits them best; None where efforts
    tell nothing."""
    log = model.log
    assert log.effort is not None
    delays = (np.arange(MAX_DELAYS) - MAX_DELAYS // 10) * model.step if is_late else np.zeros(1)
    errors = np.zeros(len(delays))
    found: dict[tuple[int, int], tuple[Array, list[int]]] = {}
    for column, _, position, velocity in model._aimed:
        joint = log.joints[column]
        own = [_of(parameters, family, joint) for family in ("stiffness", "driveDamping")]
        if joint not in joints or position is None or moves[column] is None \
                or not has(log.effort, column):
            continue
        drive = model.plant.drives[joint]
        good = np.isfinite(log.effort[:, column])
        good &= np.abs(log.effort[:, column]) < 0.98 * drive.max_force
        if good.sum() < 20:
            continue
        place, speed, _ = moves[column]
        for at, delay in enumerate(delays):
            times = log.times - delay - 1e-9
            aimed = position.at(times), velocity.at(times) if velocity else 0.0
            matrix, wanted, mine = _drive_rows((aimed[0] - place, aimed[1] - speed),
                                               log.effort[:, column], own, drive)
            if mine:
                made = _bounded(optimize, matrix[good], wanted[good],
                                *_bounds(parameters, mine))
                wanted = wanted - matrix @ made
                found[column, at] = (made, mine)
            errors[at] += float((wanted[good] ** 2).sum()) / float(
                np.var(log.effort[good, column]) or 1.0)
    if not errors.any():
        return None
    best = int(np.argmin(errors))
    # Efforts tell between which samples a command counts; here all delays are the same to them.
    alike = np.flatnonzero(errors <= errors[best] * (1 + 1e-6))
    alike = alike[np.abs(delays[alike] - delays[best]) <= log.step]
    for (_, at), (made, mine) in found.items():
        if at == best:
            values[mine] = made
    return float(delays[alike].mean())


def _drive_rows(columns: tuple[Array, Array], effort: Array, own: list[int | None], drive: Any
                ) -> tuple[Array, Array, list[int]]:
    """Of how far a drive is from its targets of position and velocity the columns of the gains
    that are asked for, what they have to explain, and their numbers."""
    known = [drive.stiffness, drive.damping]
    wanted = effort.copy()
    mine, kept = [], []
    for column, number, value in zip(columns, own, known):
        if number is None:
            wanted = wanted - value * column
        else:
            mine.append(number)
            kept.append(column)
    return np.stack(kept, axis=1) if kept else np.zeros((len(effort), 0)), wanted, mine


def _plants(model: Model, parameters: list[Parameter], values: Array, moves: list[Any],
            optimize: Any) -> None:
    """Armature, damping and friction of joints whose effort is in the log."""
    log = model.log
    assert log.effort is not None
    wanted = [each for each in parameters if each.family in PLANT]
    if not wanted or any(move is None for move in moves):
        return
    at = np.arange(3, len(log) - 3, max(1, len(log) // MAX_SAMPLES))
    needed = _inverse(model, moves, at)
    if needed is None:
        return
    for column, joint in enumerate(log.joints):
        own = [(family, _of(parameters, family, joint)) for family in PLANT]
        mine = [number for _, number in own if number is not None]
        if not mine or not has(log.effort, column):
            continue
        _, speed, turn = (each[at] for each in moves[column])
        # Where a joint hardly moves the sign of its speed is not known.
        still = 0.05 * float(np.max(np.abs(speed)) or 1.0)
        columns = {"armature": turn, "damping": speed, "friction": np.tanh(speed / still)}
        columns["stribeck"] = columns["friction"] * np.exp(-(speed / DECAY) ** 2)
        rest = log.effort[at, column] - _with_followers(model, needed, column)
        for family, number in own:
            rest = rest - _known(model, parameters, family, number, joint) * columns[family]
        kept = [columns[family] for family, number in own if number is not None]
        good = np.isfinite(rest)
        if good.sum() < 3 * len(mine):
            continue
        values[mine] = _bounded(optimize, np.stack(kept, axis=1)[good], rest[good],
                                *_bounds(parameters, mine))


def _bounds(parameters: list[Parameter], mine: list[int]) -> tuple[Array, Array]:
    return (np.array([parameters[i].low for i in mine]),
            np.array([parameters[i].high for i in mine]))


def _with_followers(model: Model, needed: Array, column: int) -> Array:
    """What a joint has to exert for itself and for those that follow it."""
    joints = model.log.joints
    total = needed[:, column]
    for k, other in enumerate(joints):
        leader, ratio = model.plant.followers.get(other, ("", 0.0))
        if leader == joints[column]:
            total = total + ratio * needed[:, k]
    return total


def _known(model: Model, parameters: list[Parameter], family: str, number: int | None,
           joint: str) -> float:
    """What the asset says of a joint and its followers, as the joint feels it, without those that
    the parameter means."""
    if family == "stribeck":
        return 0.0
    asked = parameters[number].paths if number is not None else ()
    paths = {joint: 1.0, **{path: abs(ratio) for path, (leader, ratio)
                            in model.plant.followers.items() if leader == joint}}
    return float(sum(ratio ** POWERS[family] * getattr(model.plant.joints[path], family)
                     for path, ratio in paths.items() if path not in asked))


def _inverse(model: Model, moves: list[Any], at: npt.NDArray[np.int64]) -> Array | None:
    """M a + bias - gravity without armature at samples, shape (samples, N); None where the asset
    has coordinates that are not in the log."""
    log, scene = model.log, model.scene
    try:
        home = Dynamics(scene)
        places = [home.coordinate(joint) for joint in log.joints]
        if len(places) != len(home.coordinates):
            return None
        armature = np.zeros(len(places))
        for joint, place in zip(log.joints, places):
            armature[place] = model.plant.joints[joint].armature if joint in model.plant.joints \
                else 0.0
        made = np.empty((len(at), len(places)))
        for row, sample in enumerate(at):
            posed = home.moved({joint: float(moves[j][0][sample])
                                for j, joint in enumerate(log.joints)})
            speed, turn = np.zeros(len(places)), np.zeros(len(places))
            for j, place in enumerate(places):
                speed[place], turn[place] = moves[j][1][sample], moves[j][2][sample]
            force = (posed.mass_matrix() @ turn - armature * turn + posed.bias_forces(speed)
                     - posed.gravity_forces())
            made[row] = force[places]
    except Error:
        return None
    return made
