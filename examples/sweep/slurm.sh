#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# One sweep on 16 machines of a Slurm cluster: sbatch examples/sweep/slurm.sh. The folder of results
# lies where all of them reach it. Whichever task is the last puts the results together; a task that
# was ended goes on where it was: sbatch --array=<its number> examples/sweep/slurm.sh.
#SBATCH --job-name=tenon-sweep
#SBATCH --array=0-15
#SBATCH --cpus-per-task=8
#SBATCH --requeue
set -eu
exec tenon sweep "${PLAN:-examples/sweep/grasp.toml}" -o "${RUNS:-runs}" \
  -j "${SLURM_CPUS_PER_TASK:-1}" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
