#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Runs every fuzz target over its corpus, fuzz/corpus/<target>, and counts the inputs.

usage: run_fuzz_replays.py PROGRAM...
"""

import os
import subprocess
import sys

import suite


def main():
    results = suite.Results("fuzz")
    for program in sys.argv[1:]:
        target = os.path.basename(program)
        corpus = os.path.join(suite.REPO, "fuzz", "corpus", target)
        run = subprocess.run([program, corpus], capture_output=True, text=True, check=False)
        replayed = [line for line in run.stdout.splitlines() if os.path.isfile(line)]
        if run.returncode and not replayed:
            sys.exit(f"{program}: exit {run.returncode}\n{run.stderr[-3000:]}")
        for path in replayed:  # the last one is what a crash ended
            is_finding = run.returncode and path == replayed[-1]
            results.add("fuzz corpora: inputs without a finding",
                        f"{target} {os.path.basename(path)}",
                        f"exit {run.returncode}: {run.stderr[-300:]}" if is_finding else None)
    sys.exit(results.finish())


if __name__ == "__main__":
    main()
