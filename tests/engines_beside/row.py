# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What one row of the table of scenes says."""

import dataclasses

OVPHYSX, NEWTON = "ovphysx", "newton"


@dataclasses.dataclass(frozen=True)
class Difference:
    """An engine moves the scene otherwise: the rule that names the cause, the scene without it."""

    rule: str
    cause: str  # the property, in words
    without: str  # the layer


@dataclasses.dataclass(frozen=True)
class Row:
    """One scene; its bodies are compared at `times` [s], by place [m] and by turn [degrees].

    Newton's steps are MuJoCo's, too, so that it is held to a tolerance of its own.
    """

    name: str
    shows: str
    layer: str
    times: tuple = (0.25, 0.5)
    metres: float = 0.003
    degrees: float = 0.3
    engines: tuple = (OVPHYSX, NEWTON)
    differs: dict = dataclasses.field(default_factory=dict)  # by engine
    step: float = 0.001  # [s], of the engine
    moves: dict = dataclasses.field(default_factory=dict)  # kinematic bodies: path -> velocity
    beside_newton: tuple = (0.001, 0.1)

    def tolerance(self, engine):
        """-> [m], [degrees]"""
        return self.beside_newton if engine == NEWTON else (self.metres, self.degrees)


def beside_physx(
    name, shows, rule, cause, layers, times=(0.25, 0.5), metres=0.003, degrees=0.3, **more
):
    """A row for ovphysx; `layers`: with and without the property."""
    differs = {OVPHYSX: Difference(f"portability.{rule}", cause, layers[1])}
    return Row(name, shows, layers[0], times, metres, degrees, (OVPHYSX,), differs, **more)


def beside_newton(name, shows, rule, cause, layers, times=(0.25, 0.5), metres=0.001, degrees=0.1):
    differs = {NEWTON: Difference(f"portability.{rule}", cause, layers[1])}
    tolerance = metres, degrees
    return Row(
        name, shows, layers[0], times, *tolerance, (NEWTON,), differs, beside_newton=tolerance
    )
