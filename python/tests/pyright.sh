#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# For the judge: pyright accepts the examples as strictly as it can, finds what is wrong in a wrong
# one, and knows the type of every public name of the package. Needs node and npm, and what
# python/tests/install.sh makes; pyright is pinned by pyright/package-lock.json and kept in
# ~/.cache/tenon.
set -euo pipefail
cd "$(dirname "$0")/../.."
command -v npm >/dev/null || { echo "skipped: no npm (apt-get install nodejs npm)"; exit 77; }
key=$(sha256sum python/tests/pyright/package-lock.json | cut -c1-12)
kept=${XDG_CACHE_HOME:-$HOME/.cache}/tenon/pyright-$key
if [ ! -e "$kept/made" ]; then
  rm -rf "$kept"
  mkdir -p "$kept"
  cp python/tests/pyright/*.json "$kept/"
  (cd "$kept" && npm ci --omit=optional --ignore-scripts --no-audit --no-fund --loglevel=error)
  touch "$kept/made"
fi
pyright() { node "$kept/node_modules/pyright/index.js" "$@"; }

work=build/wheel/pyright
rm -rf "$work"
mkdir -p "$work"
cp python/examples/*.py "$work/"
cat >"$work/wrong.py" <<'END'
import tenon_usd as tenon

tenon.open("a.usda", phsyics="mujoco")
mass: str = tenon.physics("a.usda").bodies[0].mass
END
packages=$(cd build/wheel/clean/lib/python*/site-packages && pwd)
check() { # check FILE...: strict, with the packages of both environments
  local files
  files=$(printf '"%s",' "$@")
  printf '{"typeCheckingMode": "strict", "include": [%s], "extraPaths": ["%s"]}\n' \
    "${files%,}" "$packages" >"$work/pyrightconfig.json"
  pyright -p "$work" --pythonpath build/wheel/beside/bin/python
}
examples=$(cd python/examples && ls -- *.py)
# shellcheck disable=SC2086
check $examples
if check wrong.py >"$work/wrong.txt"; then
  echo "pyright accepts a wrong example"
  exit 1
fi
grep -q phsyics "$work/wrong.txt"
grep -q '"float" is not assignable' "$work/wrong.txt"
# Types that pyright has to guess count as known; what stands on Gymnasium has no more than that.
(cd "$work" && PYTHONPATH=$packages pyright --pythonpath ../beside/bin/python --ignoreexternal \
  --outputjson --verifytypes tenon_usd) >"$work/names.json" || true
python3 - "$work/names.json" "$(echo "$examples" | wc -w)" <<'END'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    symbols = json.load(file)["typeCompleteness"]["symbols"]
public = [each for each in symbols if each["isExported"]]
unknown = [each["name"] for each in public
           if not (each["isTypeKnown"] or each["isTypeAmbiguous"])
           and not each["name"].startswith(("tenon_usd.gym.", "tenon_usd.tasks.env."))
           and each["name"] not in ("tenon_usd.tasks.TaskEnv", "tenon_usd.tasks.single_task")]
if unknown or len(public) < 300:
    sys.exit(f"{len(public)} names; without a type: {unknown}")
print(f"pyright accepts {sys.argv[2]} examples; {len(public)} public names, each with a type")
END
