# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Steps scenes in ovphysx on the CPU.

usage: run_ovphysx.py < jobs > poses

A job is a line of JSON {"file", "times", "step", "moves"} on standard input, its answer a line
{path: [[x, y, z, qx, qy, qz, qw] at each time]} in the units of the stage, or {"error": words}.
What the libraries print goes to standard error. `moves` are kinematic bodies: path -> velocity,
from where they stand at the start.
"""

import json
import os
import sys

ANSWERS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)  # what the libraries print

import numpy  # noqa: E402
import ovphysx  # noqa: E402
import ovstage  # noqa: E402
from ovphysx.samples.python_samples.schema_support import physx_schema_paths  # noqa: E402
from ovphysx.types import GlobalConfigKey, ObjectScope, SimObjectType  # noqa: E402

KINDS = (SimObjectType.RIGID_BODY, SimObjectType.ARTICULATION_LINK)


def poses(physx, stage):
    """-> {path: position and orientation} of all bodies and links."""
    found = {}
    with ovstage.PathDictionary(stage) as paths:
        for kind in KINDS:
            for what in ("position", "orientation"):
                with physx.read_sync(kind, [what], scope=ObjectScope.ALL) as result:
                    for group in result.groups:
                        listed = paths.get_paths(group.prim_list)
                        rows = group.tensors[0].numpy().reshape(group.prim_count, -1)
                        for row in range(group.prim_count):
                            path = paths.path_to_string(listed[group.prim_offset + row])
                            found.setdefault(path, []).extend(map(float, rows[row]))
    return found


class Mover:
    """Writes where a kinematic body is to be at the end of the next step."""

    def __init__(self, stage, path, velocity, start):
        self.stage, self.velocity, self.start = stage, numpy.array(velocity), numpy.array(start[:3])
        self.paths = ovstage.PathDictionary(stage)
        self.list = self.paths.create_path_list_from_strings([path])
        self.query = stage.query_from_path_list(self.list)

    def write(self, time, ordinal):
        matrix = numpy.eye(4)
        matrix[3, :3] = self.start + self.velocity * time
        tensor = ovstage.make_dltensor(
            matrix,
            dtype=ovstage.DLDataType(ovstage.DLDataTypeCode.kDLFloat, 64, 16),
            shape=[1],
            ndim=1,
        )
        for name in ("omni:xform", "omni:fabric:worldMatrix"):
            self.stage.write_attribute(self.query, name, ordinal, tensor, is_array=False).wait()

    def close(self):
        self.stage.release_query(self.query).wait()
        self.paths.destroy_path_list(self.list)
        self.paths.destroy()


def run(physx, job):
    step = job["step"]
    stage = ovstage.Stage("scene")
    movers = []
    try:
        ovstage.population.open_usd(
            stage, job["file"], ordinal=1, domains=ovstage.PopulationDomain.ALL
        )
        stage.advance_write_floor(ordinal=1).wait()
        physx.wait_task(physx.attach_ovstage(stage, read_ordinal=1))
        start = poses(physx, stage)
        movers = [
            Mover(stage, path, velocity, start[path]) for path, velocity in job["moves"].items()
        ]
        answer = {path: [] for path in start}
        done = 0
        for time in job["times"]:
            for done in range(done + 1, round(time / step) + 1):
                for mover in movers:
                    mover.write(done * step, done + 1)
                if movers:
                    stage.advance_write_floor(ordinal=done + 1).wait()
                    physx.wait_task(physx.update_from_ovstage(done + 1, done + 1))
                physx.step_sync(step)
            for path, pose in poses(physx, stage).items():
                answer[path].append(pose)
        return answer
    finally:
        for mover in movers:
            mover.close()
        if physx.is_stage_attached(stage):
            physx.wait_task(physx.detach_ovstage())
        stage.destroy()


def main():
    ovphysx.set_global_config(GlobalConfigKey.NUM_THREADS, 0)
    ovphysx.PhysX.set_cpu_mode(True)
    physx = ovphysx.PhysX()
    ovstage.population.register_usd_schemas(
        [*map(str, physx_schema_paths()), str(ovphysx.newton_schema_root())]
    )
    try:
        for line in sys.stdin:
            try:
                answer = run(physx, json.loads(line))
            except Exception as error:  # the libraries' own kinds
                answer = {"error": f"{type(error).__name__}: {error}"}
            print(json.dumps(answer), file=ANSWERS, flush=True)
    finally:
        physx.destroy()
    return 0


if __name__ == "__main__":
    sys.exit(main())
