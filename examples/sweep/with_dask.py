# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A sweep on Dask: pip install tenon-usd 'dask[distributed]'.

    python with_dask.py grasp.toml runs                     on the processes of this machine
    python with_dask.py grasp.toml runs tcp://HOST:8786     on a cluster

Each task makes one chunk of the plan; this process writes them, so that workers need no folder of
results. The plan's folder has the same name on all machines.
"""

import sys

import dask

from tenon_usd.sweep import Results, Worker, load_plan
from tenon_usd.sweep.simulate import digest_of, make_runner


def work(plan, chunk):
    return Worker(plan, make_runner).rows(chunk)


if __name__ == "__main__":
    plan = load_plan(sys.argv[1])
    results = Results(sys.argv[2], plan, digest_of(plan))
    if len(sys.argv) > 3:
        from dask.distributed import Client

        client = Client(sys.argv[3])
    where = {} if len(sys.argv) > 3 else {"scheduler": "processes"}
    missing = results.missing(range(plan.chunk_count))
    rows = dask.compute(*[dask.delayed(work)(plan, chunk) for chunk in missing], **where)
    for chunk, each in zip(missing, rows):
        results.write_chunk(chunk, each)
    print(results.merge())
