#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Chains of list edits folded into one: the published chains of the AOUSD core specification,
where they are, chains of this project, and random ones against OpenUSD.

usage: run_list_ops.py TENON [--random COUNT]
"""

import json
import random
import subprocess
import sys

import suite

EDITS = ("deleted", "prepended", "appended")


def fold(tenon, chain):
    run = subprocess.run([tenon, "test-runner", "list-op"], input=json.dumps(chain),
                         capture_output=True, text=True, check=False)
    return json.loads(run.stdout) if run.returncode == 0 else None


def compare(tenon, chain, expected):
    actual = fold(tenon, chain)
    return None if actual == expected else f"{chain}: expected {expected}, actual {actual}"


def run_published(tenon, results):
    for name, path in suite.cases("aousd_combine_chain"):
        with open(path, encoding="utf-8") as file:
            for number, case in enumerate(json.load(file)):
                results.add("AOUSD list edits: published chains", f"{name} {number}",
                            compare(tenon, case["chain"], case["combined_reduced"]))


# Strongest first, and the one edit that they amount to.
OWN_CHAINS = (
    ([{"explicit_items": [1, 2]}], {"explicit_items": [1, 2]}),
    ([{"prepended_items": [3]}, {"explicit_items": [1, 2]}], {"explicit_items": [3, 1, 2]}),
    ([{"appended_items": [1]}, {"explicit_items": [1, 2]}], {"explicit_items": [2, 1]}),
    ([{"deleted_items": [2]}, {"explicit_items": [1, 2]}], {"explicit_items": [1]}),
    ([{"explicit_items": [7]}, {"prepended_items": [1]}], {"explicit_items": [7]}),
    ([{"prepended_items": [1]}, {"prepended_items": [2]}], {"prepended_items": [1, 2]}),
    ([{"appended_items": [1]}, {"appended_items": [2]}], {"appended_items": [2, 1]}),
    ([{"prepended_items": [1]}, {"appended_items": [1, 2]}],
     {"prepended_items": [1], "appended_items": [2]}),
)


def run_own(tenon, results):
    for number, (chain, expected) in enumerate(OWN_CHAINS):
        results.add("list edits: chains of this project", f"own {number}",
                    compare(tenon, chain, expected))


def random_edit(source):
    if source.random() < 0.15:
        return {"explicit_items": source.sample(range(9), source.randrange(4))}
    edit = {name + "_items": source.sample(range(9), source.randrange(4)) for name in EDITS}
    if source.random() < 0.05:
        edit[source.choice(["added_items", "ordered_items"])] = [source.randrange(9)]
    return {name: items for name, items in edit.items() if items}


def fold_by_openusd(chain):
    """The chain folded and reduced, None where OpenUSD finds no single edit."""
    from pxr import Sdf

    folded = Sdf.IntListOp()
    for edit in reversed(chain):
        op = Sdf.IntListOp.CreateExplicit([]) if "explicit_items" in edit else Sdf.IntListOp()
        for name, items in edit.items():
            setattr(op, name.replace("_items", "Items"), items)
        folded = op.ApplyOperations(folded)
        if folded is None:
            return None
    folded = folded.ApplyOperations(Sdf.IntListOp())
    if folded.isExplicit:
        return {"explicit_items": list(folded.explicitItems)}
    lists = {name + "_items": list(getattr(folded, name + "Items")) for name in EDITS}
    return {name: items for name, items in lists.items() if items}


def run_random(tenon, results, count):
    source = random.Random(20251121)
    for number in range(count):
        chain = [random_edit(source) for _ in range(source.randrange(1, 5))]
        results.add("list edits: random chains, against OpenUSD", f"random {number}",
                    compare(tenon, chain, fold_by_openusd(chain)))


def main():
    if len(sys.argv) not in (2, 4):
        sys.exit(__doc__)
    results = suite.Results("list_ops")
    run_published(sys.argv[1], results)
    try:
        run_random(sys.argv[1], results, int(sys.argv[3]) if len(sys.argv) == 4 else 200)
    except ImportError:
        print("no OpenUSD modules in this Python: random chains left out")
    own = suite.Results("own_list_ops")
    run_own(sys.argv[1], own)
    sys.exit(results.finish(is_whole=suite.HAS_PUBLISHED) | own.finish(is_whole=False))


if __name__ == "__main__":
    main()
