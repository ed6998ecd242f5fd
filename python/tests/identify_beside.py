# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon identify` beside MuJoCo's own system identification (mujoco.sysid), on the same logs.

    identify_beside.py ROOT TENON PAGE [--write]

Arms of one and of two links, SEEDS logs of each: made with other numbers at a quarter of the time
step, with encoders and noise (tenon_usd.identify.selftest). Both identify friction, damping,
armature and gains from the first part of a log, beginning with the asset's numbers, with the same
bounds, steps and integrator; the rest is predicted with what each found, by one model.
PAGE has the table between its marks; --write makes it. Exit 0: held-out errors of tenon are no
larger and its processor time is less, and PAGE says which robots and tools; 1: not.
"""

import argparse
import contextlib
import io
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import mujoco
import numpy as np
from mujoco import sysid
from test_identify_truth import ARM, HINGE

import tenon_usd
from tenon_usd.identify.model import Model
from tenon_usd.identify.parameters import Row, select
from tenon_usd.identify.selftest import Sensors, commands, measured, perturbed, simulated
from tenon_usd.identify.solve import solve

FAMILIES = ("friction", "damping", "armature", "stiffness", "driveDamping")
ROBOTS = (("one link", HINGE), ("two links", ARM))
SEEDS, STEP, FINER, PERIOD = 3, 0.002, 4, 0.004
DURATION, TRAINING, WINDOW = 6.0, 0.7, 2.0
MARKS = re.compile(r"(<!-- beside: .*? -->\n)(.*?)(<!-- end of beside -->)", re.S)
HEAD = """
Beside MuJoCo's own identification, `mujoco.sysid`, on the same logs, from the same numbers, on one
processor (`make judge ONLY=identify_beside`; logs of 6 s, of which 70 % are fitted; the error of
held-out positions, and how far off the worst of the numbers is):

| robot | seed | by | processor time | left | worst |
|---|---|---|---|---|---|
"""


class Case:
    """One log of one robot, and what both make of it."""

    def __init__(self, tenon, name, text, seed, folder):
        self.name, self.seed = name, seed
        self.asset = folder / "robot.usda"
        self.asset.write_text(text, encoding="utf-8")
        world = tenon_usd.World(str(self.asset), "mujoco", time_step=STEP)
        commanded = commands(world, seed, DURATION, PERIOD)
        plain = simulated(str(self.asset), [], np.zeros(0), commanded, step=STEP, engine="mujoco")
        about = Model(str(self.asset), plain, engine="mujoco", step=STEP, window=DURATION)
        rows = [Row(family) for family in FAMILIES]
        self.parameters = select(rows, about.plant, plain, sums=False)
        self.truth = perturbed(self.parameters, seed, STEP, FINER)
        made = simulated(str(self.asset), self.parameters, self.truth, commanded,
                         step=STEP / FINER, engine="mujoco")
        self.log, self.rest = measured(made, Sensors(), seed).split(TRAINING)
        self.mjcf = folder / "robot.xml"
        subprocess.run([tenon, "convert", str(self.asset), "-o", str(self.mjcf), "-q"], check=True)
        self.order, self.found = [], {}

    def model(self, log):
        return Model(str(self.asset), log, engine="mujoco", step=STEP, window=WINDOW, threads=1)

    def run(self, tool, function):
        begin = time.process_time()
        values = function()
        took = time.process_time() - begin
        model = self.model(self.rest)
        apart = (model.predict(self.parameters, values[None])["position"][0]
                 - model.measured["position"])
        off = np.abs(values - self.truth) / np.abs(self.truth)
        self.found[tool] = (took, float(np.sqrt(np.nanmean(apart ** 2))), float(off.max()))

    def by_tenon(self):
        return solve(self.model(self.log), self.parameters).values

    def by_sysid(self):
        spec = self._spec()
        model = spec.compile()
        sequences = sysid.ModelSequences("robot", spec, "log", *self._measured(model))
        with contextlib.redirect_stdout(io.StringIO()):  # its progress
            found, _ = sysid.optimize(
                initial_params=self._parameters(), optimizer="mujoco", verbose=False,
                residual_fn=sysid.build_residual_fn(
                    models_sequences=[sequences], n_threads=1, modify_residual=self._apart))
        return np.array([float(found[each.name].value[0]) for each in self.parameters])

    def _spec(self):
        spec = mujoco.MjSpec.from_file(str(self.mjcf))
        spec.option.timestep = STEP
        spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
        for kind, sensor in (("position", mujoco.mjtSensor.mjSENS_JOINTPOS),
                             ("effort", mujoco.mjtSensor.mjSENS_JOINTACTFRC)):
            for joint in spec.joints:
                spec.add_sensor(name=f"{joint.name} {kind}", type=sensor, objname=joint.name,
                                objtype=mujoco.mjtObj.mjOBJ_JOINT)
        return spec

    def _measured(self, model):
        """The state at the start, which is at rest, commands of each step, and the log."""
        last = [path.rpartition("/")[2] for path in self.log.joints]
        self.order = [last.index(model.joint(at).name.rpartition("/")[2])
                      for at in range(model.njnt)]
        times = self.log.times
        steps = np.arange(0, times[-1] + STEP / 2, STEP)
        held = np.searchsorted(times, steps + 1e-9, "right") - 1
        position, effort, aim = (each[:, self.order] for each in (
            self.log.position, self.log.effort, self.log.command_position))
        return (sysid.create_initial_state(model, position[0]),
                sysid.TimeSeries.from_control_names(steps, aim[held], model),
                sysid.TimeSeries.from_names(times, np.concatenate([position, effort], 1), model))

    def _apart(self, parameters, predicted, measured_ones, model, *_, state, **_more):
        """What is left of positions, and of efforts by the law that made those of the log: sensors
        of MuJoCo are of the step before."""
        times = measured_ones.times
        place, speed = (np.stack([np.interp(times, state[:, 0], column) for column in
                                  state[:, first:first + model.nv].T], axis=1)
                        for first in (1, 1 + model.nq))
        aim = self.log.command_position[:, self.order]
        aim = np.concatenate([aim[:1], aim[:-1]])
        paths = [self.log.joints[at] for at in self.order]
        gains, dampings = ([parameters[f"{family}:{path}"].value[0] for path in paths]
                           for family in ("stiffness", "driveDamping"))
        made = np.concatenate([place, gains * (aim - place) - dampings * speed], axis=1)
        left = sysid.normalize_residual(made - measured_ones.data, measured_ones.data)[1:]
        return left, sysid.TimeSeries(times, made, measured_ones.signal_mapping), measured_ones

    def _parameters(self):
        found = sysid.ParameterDict()
        for each in self.parameters:
            most = each.high if np.isfinite(each.high) else 10 * max(each.nominal, each.scale)
            found.add(sysid.Parameter(
                each.name, nominal=max(each.nominal, 0.1 * each.scale), min_value=max(each.low, 0),
                max_value=most, modifier=modifier_of(each)))
        return found


def modifier_of(parameter):
    """What writes a number into a model of MuJoCo."""
    name, family = parameter.paths[0].rpartition("/")[2], parameter.family

    def write(spec, own):
        value = float(own.value[0])
        joint = next(each for each in spec.joints if each.name.rpartition("/")[2] == name)
        drive = next(each for each in spec.actuators if each.target == joint.name)
        if family == "stiffness":
            drive.gainprm[0], drive.biasprm[1] = value, -value
        elif family == "driveDamping":
            drive.biasprm[2] = -value
        elif family == "damping":
            joint.damping[0] = value
        else:
            setattr(joint, "frictionloss" if family == "friction" else family, value)

    return write


def table_of(cases):
    lines = HEAD
    for case in cases:
        for tool, (took, left, off) in case.found.items():
            lines += (f"| {case.name} | {case.seed} | {tool} | {took:.2f} s | {left:.3g} rad | "
                      f"{100 * off:.2g} % off |\n")
    return lines


def without_numbers(table):
    return re.sub(r"[0-9.e-]+ (s|rad|%)", r"\1", table)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("tenon")
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    cases = []
    for name, text in ROBOTS:
        for seed in range(SEEDS):
            with tempfile.TemporaryDirectory() as folder:
                case = Case(options.tenon, name, text, seed, pathlib.Path(folder))
                case.run("tenon", case.by_tenon)
                case.run("mujoco.sysid", case.by_sysid)
                print(table_of([case]).removeprefix(HEAD), end="", flush=True)
                cases.append(case)
    table, page = table_of(cases), options.page.read_text(encoding="utf-8")
    known = MARKS.search(page)
    if known is None:
        print(f"{options.page} lacks the marks of the table")
        return 1
    if options.write:
        options.page.write_text(page[:known.start(2)] + table + page[known.end(2):],
                                encoding="utf-8")
        known = MARKS.search(options.page.read_text(encoding="utf-8"))
    pairs = [(case.found["tenon"], case.found["mujoco.sysid"]) for case in cases]
    exact = sum(own[1] <= 1.02 * other[1] for own, other in pairs)
    fast = sum(own[0] < other[0] for own, other in pairs)
    ratio = sum(other[0] for _, other in pairs) / sum(own[0] for own, _ in pairs)
    same = without_numbers(known[2]) == without_numbers(table)
    print(f"{exact} of {len(cases)} held-out errors as small or smaller; {fast} in less processor "
          f"time, {ratio:.2g} times in all; page {'has' if same else 'lacks'} these rows")
    return 0 if exact == fast == len(cases) and same else 1


if __name__ == "__main__":
    sys.exit(main())
