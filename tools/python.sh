#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Runs the Python of build/oracle (tools/make_oracle.sh) where it exists, else python3.
set -eu
own="$(dirname "$0")/../build/oracle/bin/python"
python="${TENON_ORACLE_PYTHON:-$own}"
[ -x "$python" ] || python=python3
exec "$python" -B "$@"
