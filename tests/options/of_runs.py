# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Options of runs that several verbs have: how long, how steps are made, what is read otherwise."""

from option_row import Row

OTHERS = ("physx", "jolt")
# Where an engine has one method alone, all others are refused with its name.
NAMED = {"physx": r"engine\.method\] PhysX integrates by",
         "jolt": r"engine\.method\] Jolt integrates by"}
OWN = {"--integrator": {"mujoco": "implicitfast", "physx": "euler", "jolt": "euler"},
       "--solver": {"mujoco": "newton", "physx": "pgs", "jolt": "pgs"}}
HINGE = "/World/Hinge"


def methods(option, choices, wanted=None):
    """Each choice: what the help calls the default changes nothing, all else acts or is refused."""
    own = OWN[option]
    for choice in choices:
        refused = {engine: words for engine, words in NAMED.items() if own[engine] != choice}
        same = tuple(engine for engine, default in own.items() if default == choice)
        yield Row(option, (option, choice), refused=refused, same=same, wanted=wanted)


def of_steps(choices):
    yield Row("--dt", ("--dt", "0.001"))
    yield from methods("--integrator", choices["--integrator"])
    yield from methods("--solver", choices["--solver"])
    yield Row("--iterations", ("--iterations", "1"))


def of_masks():
    yield Row("--deactivate", ("--deactivate", "Hinge"))
    yield Row("--deactivate", ("--deactivate", "/World/Slider"))
    yield Row("--bypass", ("--bypass", "Hinge"))
    yield Row("--anchor", ("--anchor", "Slider"))


def of_starts():
    yield from of_masks()
    yield Row("--reading", ("--reading", "unbound-friction=zero"))
    yield Row("--reading", ("--reading", "velocity-space=body", "--reading",
                            "point-instancers=skip", "--reading", "unbound-friction=one"))
    yield Row("--pose", ("--pose", "Hinge=80deg"))
    yield Row("--set", ("--set", "/World/Slider.physics:velocity=(0.5, 0, 0)"))
    yield Row("--set", ("--set", HINGE + ".drive:angular:physics:targetPosition=-40"))


def of_commands():
    yield Row("--commands", ("--commands", "{folder}/commands.csv"))
    for name in ("target", "velocityTarget", "effort"):
        yield Row("--commands", ("--commands", f"{{folder}}/{name}.csv"))
