#!/bin/sh
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# fuzz/run.sh TARGET SECONDS [FLAGS...]: runs a libFuzzer target of build/fuzz with this project's
# limits, from its corpus; what it finds on the way stays in build/fuzz/corpus/TARGET, findings in
# build/fuzz/findings. An input may take 5 s and, interned names included, 3 GB.
set -e
root=$(cd "$(dirname "$0")/.." && pwd)
target=${1%_fuzz}_fuzz
seconds=$2
shift 2
work=$root/build/fuzz/corpus/$target
findings=$root/build/fuzz/findings
mkdir -p "$work" "$findings"
cat "$root"/fuzz/dictionaries/*.dict > "$root/build/fuzz/all.dict"
case $target in
  expression_fuzz | path_expression_fuzz | path_fuzz) longest=4096 ;;
  *) longest=65536 ;;
esac
exec "$root/build/fuzz/bin/$target" -max_total_time="$seconds" -timeout=5 -rss_limit_mb=3000 \
  -max_len=$longest -dict="$root/build/fuzz/all.dict" -artifact_prefix="$findings/$target-" \
  -print_final_stats=1 "$@" "$work" "$root/fuzz/corpus/$target"
