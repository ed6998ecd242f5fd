# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A sweep on the processes of joblib: pip install tenon-usd joblib.

    python with_joblib.py grasp.toml runs

Each task makes one chunk of the plan and writes it, as `tenon sweep` does: the folder is the same,
and either of the two goes on where the other was stopped.
"""

import sys

from joblib import Parallel, delayed

from tenon_usd.sweep import Results, Worker, load_plan
from tenon_usd.sweep.simulate import digest_of, make_runner


def work(results, chunk):
    results.write_chunk(chunk, Worker(results.plan, make_runner).rows(chunk))


if __name__ == "__main__":
    plan = load_plan(sys.argv[1])
    results = Results(sys.argv[2], plan, digest_of(plan))
    missing = results.missing(range(plan.chunk_count))
    Parallel(n_jobs=-1)(delayed(work)(results, chunk) for chunk in missing)
    print(results.merge())
