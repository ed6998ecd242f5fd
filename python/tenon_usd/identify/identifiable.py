# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What a log can tell about parameters, before anything is fitted: how much each changes what the
joints would have done, which change it in the same way, and how far off each would be.

Sensitivities are differences of simulations; with the noise of the log they give the Fisher
information, whose inverse holds the variances that the best fit could have.
"""

from __future__ import annotations

import dataclasses

import numpy as np
import numpy.typing as npt

from .log import Array, Log
from .model import Model
from .parameters import FAMILIES, Parameter

#: A parameter whose standard error is more than this part of it is not told by the log.
MOST_ERROR = 0.5
#: Parts of a direction that belong to a group of parameters that only appear together.
TOGETHER = 0.2
#: Directions in which columns of length 1 move by less are as good as none: differences of
#: simulations, in which friction sets in at once, are no more exact than that.
DOUBT = 5e-3
#: What a parameter is of such a direction at least to be lost with it.
TOLD_APART = 0.02
#: Noise counts as at least this part of a signal's deviation: no model is better than that.
LEAST_NOISE = 0.01


@dataclasses.dataclass(frozen=True)
class Identifiability:
    """`errors` are the standard errors [SI, rad] that a fit can be expected to have, inf where
    nothing tells the parameter; `sensitivities` how many deviations of the noise all samples
    together move by the scale of the parameter; `singular_values` those of the scaled sensitivity
    matrix, largest first; `groups` parameters (by number) that only appear together; `refused`
    those that the log does not tell."""

    errors: Array
    sensitivities: Array
    singular_values: Array
    groups: tuple[tuple[int, ...], ...]
    refused: tuple[int, ...]


def noise_of(log: Log, name: str) -> Array:
    """The deviation of the noise of a signal's columns, shape (N,): of third differences, which
    hardly see motion, and at least LEAST_NOISE of the signal's own."""
    values = getattr(log, name)
    made = np.full(len(log.joints), np.nan)
    for column in range(len(log.joints)):
        own = values[:, column][np.isfinite(values[:, column])]
        if own.size < 5:
            continue
        rough = np.diff(own, 3)
        noise = 1.4826 * float(np.median(np.abs(rough))) / np.sqrt(20.0)
        made[column] = max(noise, LEAST_NOISE * float(np.std(own)), 1e-9)
    return made


def weights_of(model: Model) -> dict[str, Array]:
    """1 / noise of each channel and joint, shape (N,)."""
    return {name: 1.0 / noise_of(model.log, name) for name in model.measured}


def residuals(model: Model, predicted: dict[str, Array], weights: dict[str, Array]) -> Array:
    """Differences from the log, of every set: (S, numbers); 0 where the log has nothing."""
    parts = []
    for name, values in predicted.items():
        apart = (values - model.measured[name][None]) * np.nan_to_num(weights[name])
        known = np.isfinite(model.measured[name])
        # An unstable set is far away from everything.
        apart = np.where(np.isfinite(apart), apart, 1e3)[:, known]
        parts.append(apart)
    return np.concatenate(parts, axis=1)


def moments_of(model: Model) -> tuple[Array, Array]:
    """Of each residual the number of its moment in the log, and that of its channel and joint."""
    parts = [np.nonzero(np.isfinite(values)) for values in model.measured.values()]
    samples, joints = model.windows.samples, len(model.log.joints)
    return (np.concatenate([window * samples + sample for window, sample, _ in parts]),
            np.concatenate([at * joints + joint for at, (_, _, joint) in enumerate(parts)]))


def sensitivity(model: Model, parameters: list[Parameter], values: Array,
                weights: dict[str, Array]) -> tuple[Array, Array]:
    """Residuals (numbers,) at `values`, and their derivatives (numbers, P), of differences to both
    sides."""
    return Around(model, parameters, values, True).slopes(weights)


class Around:
    """What a model does with values, in the first set, and with each of them a little changed.

    `exact`: to both sides, where bounds leave room. Which command counts at a sample is the same
    with a little more delay: it changes an effort by what the joint does, not by a jump."""

    def __init__(self, model: Model, parameters: list[Parameter], values: Array,
                 exact: bool = False) -> None:
        self.model, self.values = model, values.copy()
        ahead, behind, self._both, sets, clock = _varied(model, parameters, values, exact)
        self._steps = ahead + behind
        self.predicted = model.predict(parameters, sets, clock)

    def slopes(self, weights: dict[str, Array]) -> tuple[Array, Array]:
        """Residuals (numbers,) and their derivatives (numbers, P)."""
        apart, count = residuals(self.model, self.predicted, weights), len(self.values)
        lower = np.repeat(apart[:1], count, axis=0)
        lower[self._both] = apart[1 + count:]
        return apart[0], np.asarray((apart[1:1 + count] - lower).T / self._steps)


def _varied(model: Model, parameters: list[Parameter], values: Array, exact: bool
            ) -> tuple[Array, Array, npt.NDArray[np.intp], Array, Array]:
    """Steps ahead and behind (P,), which parameters have both, and the sets with their clocks."""
    ahead, behind = np.zeros(len(parameters)), np.zeros(len(parameters))
    for at, parameter in enumerate(parameters):
        if parameter.family == "delay":
            ahead[at] = behind[at] = 0.5 * model.step
            continue
        step = 2e-3 * max(abs(values[at]), parameter.scale)
        ahead[at] = -step if values[at] + step > parameter.high else step
        if exact and parameter.low <= values[at] - step and values[at] + step <= parameter.high:
            behind[at] = step
    both = np.flatnonzero(behind)
    sets = np.concatenate([values[None], values[None] + np.diag(ahead),
                           values[None] - np.diag(behind)[both]])
    clock = sets.copy()
    late = [at for at, parameter in enumerate(parameters) if parameter.family == "delay"]
    clock[:, late] = values[late]
    return ahead, behind, both, sets, clock


def scales_of(parameters: list[Parameter], values: Array) -> Array:
    """What counts as all of each parameter, shape (P,)."""
    return np.array([max(abs(value), each.scale) if each.family not in ("delay", "offset")
                     else each.scale for each, value in zip(parameters, values)])


def prior_rows(parameters: list[Parameter], values: Array) -> tuple[Array, Array]:
    """Residuals and derivatives of priors: (R,), (R, P)."""
    rows, apart = [], []
    for at, parameter in enumerate(parameters):
        if parameter.prior is not None:
            deviation = max(parameter.deviation or 0.0, 1e-6 * parameter.scale)
            row = np.zeros(len(parameters))
            row[at] = 1.0 / deviation
            rows.append(row)
            apart.append((values[at] - parameter.prior) / deviation)
    return np.array(apart), np.array(rows).reshape(len(rows), len(parameters))


def judge(parameters: list[Parameter], jacobian: Array, values: Array, doubt: float = 1e-7
          ) -> Identifiability:
    """What derivatives of residuals in deviations of the noise say, as if all residuals were
    independent of each other. `doubt` is how exact columns are that have the length 1."""
    scales = scales_of(parameters, values)
    _, known = prior_rows(parameters, values)
    scaled = np.concatenate([jacobian, known]) * scales
    seen = np.sqrt((scaled ** 2).sum(axis=0))
    # Columns of equal length: what is left of small singular values is that columns are alike.
    lengths = np.where(seen > 1e-9, seen, 1.0)
    triangle = np.linalg.qr(np.concatenate([scaled, np.zeros((len(parameters),) * 2)]), mode="r")
    _, singular, right = np.linalg.svd(triangle / lengths)
    inverse = 1.0 / np.maximum(singular, doubt) ** 2
    variances = np.zeros(len(parameters))
    for size, value, direction in zip(singular, inverse, right):
        variances += direction ** 2 * value
        if size <= doubt:
            variances[np.abs(direction) > TOLD_APART] = np.inf
    errors = np.where(seen > 1e-9, np.sqrt(variances) / lengths, np.inf)
    least = MOST_ERROR * _wholes(parameters, values)
    refused = tuple(int(i) for i in np.flatnonzero(errors * scales > least))
    groups = _groups(right, np.where(singular > doubt, singular, 0.0), lengths, refused)
    return Identifiability(errors * scales, seen, np.linalg.svd(triangle, compute_uv=False), groups,
                           refused)


def _wholes(parameters: list[Parameter], values: Array) -> Array:
    """Of what an expected error is a part: of the number, or of its scale where the asset has
    none, shape (P,)."""
    scales = scales_of(parameters, values)
    return np.array([scale if each.nominal <= 0 or each.is_place
                     or not np.isfinite(each.nominal) else max(abs(value), each.nominal)
                     for each, value, scale in zip(parameters, values, scales)])


def _groups(right: Array, singular: Array, lengths: Array,
            refused: tuple[int, ...]) -> tuple[tuple[int, ...], ...]:
    """Parameters of directions along which refused ones are lost."""
    found: list[tuple[int, ...]] = []
    for value, direction in zip(singular[::-1], right[::-1]):
        own = [at for at in refused
               if abs(direction[at]) > TOGETHER * MOST_ERROR * value * lengths[at]
               and abs(direction[at]) > TOGETHER]
        group = tuple(int(i) for i in np.flatnonzero(np.abs(direction) > TOGETHER))
        if own and value < 0.3 and len(group) > 1 and group not in found:
            found.append(group)
    return tuple(found)


def reasons(parameters: list[Parameter], told: Identifiability) -> list[str]:
    """Why each refused parameter is refused and what would tell it."""
    lines = []
    for at in told.refused:
        own, error = parameters[at], told.errors[at]
        family = FAMILIES[own.family]
        together = sorted({other for group in told.groups if at in group for other in group
                           if other != at})
        if not np.isfinite(error) and told.sensitivities[at] < 1e-6:
            why = "nothing in the log depends on it"
        elif together:
            names = ", ".join(parameters[i].name for i in together[:4])
            why = f"it only appears together with {names}"
        else:
            why = f"its standard error would be {error:.3g}"
        lines.append(f"{own.name} is not told by the log: {why}; log {family.motion}, or give a "
                     "prior")
    return lines
