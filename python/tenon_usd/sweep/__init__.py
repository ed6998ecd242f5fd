# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Sweeps: one asset simulated many times, with values that a plan names.

A plan is a TOML file (docs/sweep.md). The same plan gives the same bytes on threads, on shards and
on a cluster of Ray, and a run that was stopped goes on where it was.
"""

from .._toml import Fault
from .cases import Case, Cases, ExtraMissing
from .chunks import FolderError, Results
from .plan import Metric, Plan, PlanError, Vary, load_plan, plan_from_table
from .table import read
from .work import Outcome, Runner, Worker, run_on_ray, run_on_threads, shard_of

__all__ = ["Case", "Cases", "ExtraMissing", "Fault", "FolderError", "Metric", "Outcome", "Plan",
           "PlanError", "Results", "Runner", "Vary", "Worker", "load_plan", "plan_from_table",
           "read", "run_on_ray", "run_on_threads", "shard_of"]
