#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# The first step of action.yml: installs tenon where it is missing, checks the assets, writes SARIF
# and tells the next steps what came of it. Inputs are variables, so that no text of a pull request
# becomes a command: TENON_ASSETS (one a line), TENON_STRICT, TENON_PROFILE, TENON_BASELINE,
# TENON_SARIF, TENON_PACKAGE. Exit 0 also where there are findings: a later step fails with the
# code.
set -u
if ! command -v tenon >/dev/null; then
  if [ -z "${TENON_PACKAGE:-}" ]; then
    echo "::error::tenon is not on the PATH; name its wheel with the input package" >&2
    exit 2
  fi
  case "$TENON_PACKAGE" in
    */* | *.whl | *==*) ;;
    *)
      echo "::error::the input package names no version; write $TENON_PACKAGE==VERSION" >&2
      exit 2
      ;;
  esac
  python3 -m pip install --quiet "$TENON_PACKAGE" || exit 2
fi
assets=()
while IFS= read -r line; do
  [ -z "$line" ] || assets+=("$line")
done <<<"${TENON_ASSETS:-.}"
options=(--sarif "${TENON_SARIF:-tenon.sarif}")
[ "${TENON_STRICT:-false}" != true ] || options+=(--strict)
[ -z "${TENON_PROFILE:-}" ] || options+=(--profile "$TENON_PROFILE")
[ -z "${TENON_BASELINE:-}" ] || options+=(--baseline "$TENON_BASELINE")
rm -f -- "${TENON_SARIF:-tenon.sarif}"
tenon check "${options[@]}" -- "${assets[@]}"
code=$?
{
  echo "code=$code"
  [ ! -s "${TENON_SARIF:-tenon.sarif}" ] || echo "sarif=${TENON_SARIF:-tenon.sarif}"
} >>"${GITHUB_OUTPUT:-/dev/null}"
exit 0
