#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# learned.sh PYTHON: for the judge, in an environment with python/examples/learn/
# requirements-learn.txt: what the example learns of each task that the package has, in processor
# time of minutes. Its curves are written to build/judge/learned.
set -euo pipefail
cd "$(dirname "$0")/../.."
packages=$(cd build/wheel/clean/lib/python*/site-packages && pwd)
mkdir -p build/judge/learned
learn() { # learn TASK FRAMES GOAL
  PYTHONPATH=$packages "$python" -B python/examples/learn/ppo.py "$1" --frames "$2" --goal "$3" \
    --curve "build/judge/learned/$1.csv" >build/judge/learned/"$1".txt ||
    { tail -n 3 build/judge/learned/"$1".txt; echo "$1: mean return below $3"; exit 1; }
  result="$result$1: mean return $(tail -n 1 build/judge/learned/"$1".txt | sed 's/.*: //'), "
  result="$result$(tail -n 1 build/judge/learned/"$1".csv | cut -d, -f2) s of processor time; "
}
python=$1
result=""
learn balance 80000 475
learn reach 200000 65
echo "${result%; }"
