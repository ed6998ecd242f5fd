# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon_usd.sweep from the sources, without the rest of the wheel, and a runner whose results
follow from a formula: a falling stone with drag varies in mass and height."""

import math
import os
import pathlib
import sys
import time
import types

SOURCES = pathlib.Path(__file__).resolve().parent.parent
if "tenon_usd" not in sys.modules:
    package = types.ModuleType("tenon_usd")
    package.__path__ = [str(SOURCES / "tenon_usd")]
    sys.modules["tenon_usd"] = package

from tenon_usd.sweep import Outcome  # noqa: E402

PLAN = """
asset = "stone.usda"
duration = 2.0
samples = 25
seed = 7
chunk = 8

[[vary]]
scale = "bodyMass"
grid = [0.5, 1, 2, 4]

[[vary]]
name = "height"
value = "height"
random = [1, 10]

[[metric]]
name = "speed"
of = "speed@/Stone"
"""


class Stone:
    """Speed after the plan's duration; a stone that is too high is unstable."""

    def __init__(self, plan):
        self.plan = plan

    def run(self, cases):
        time.sleep(float(os.environ.get("STONE_SECONDS", 0)) * len(cases))
        return [self.outcome(*case.values) for case in cases]

    def outcome(self, mass, height):
        if height > 9:
            return Outcome("unstable", height / 10, (), "simulation.unstable", f"at {height} m, ä")
        return Outcome("ok", self.plan.duration,
                       (math.sqrt(mass * 9.81) * math.tanh(height / mass),))


def digest_of(plan):
    return plan.digest()


if __name__ == "__main__":  # a driver that can be killed
    from tenon_usd.sweep.command import main
    sys.exit(main(sys.argv[1:], Stone, digest_of))
