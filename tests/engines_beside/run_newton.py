# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Steps scenes in Newton's MuJoCo solver, on the CPU.

usage: run_newton.py < jobs > poses

Jobs and answers are those of run_ovphysx.py; the labels of Newton's bodies are their paths.
"""

import json
import os
import sys

ANSWERS = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)  # what the libraries print

import newton  # noqa: E402
import warp  # noqa: E402


def run(job):
    step = job["step"]
    builder = newton.ModelBuilder()
    newton.solvers.SolverMuJoCo.register_custom_attributes(builder)
    builder.add_usd(job["file"], apply_up_axis_from_stage=True)
    model = builder.finalize(device="cpu")
    labels = list(model.body_label)
    solver = newton.solvers.SolverMuJoCo(model, use_mujoco_cpu=True)
    before, after, control = model.state(), model.state(), model.control()
    newton.eval_fk(model, model.joint_q, model.joint_qd, before)
    answer = {label: [] for label in labels}
    done = 0
    for time in job["times"]:
        for done in range(done + 1, round(time / step) + 1):
            before.clear_forces()
            solver.step(before, after, control, None, step)
            before, after = after, before
        for label, pose in zip(labels, before.body_q.numpy().tolist()):
            answer[label].append(pose)
    return answer


def main():
    warp.config.quiet = True
    with warp.ScopedDevice("cpu"):
        for line in sys.stdin:
            try:
                answer = run(json.loads(line))
            except Exception as error:  # the libraries' own kinds
                answer = {"error": f"{type(error).__name__}: {error}"[:300]}
            print(json.dumps(answer), file=ANSWERS, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
