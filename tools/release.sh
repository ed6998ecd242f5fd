#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Makes everything that a release consists of out of the commit that is checked out, and checks it:
# dist/tenon-VERSION/ with the wheel, the Debian package, the archive of the sources, a bill of
# materials and SHA256SUMS. docs/releasing.md says what stands before and after it.
#   tools/release.sh            all of it; the archive of the sources is built, which takes long
#   tools/release.sh --quick    without that build
# Exit 1: the first check that failed, told in a line. Nothing is published and no tag is set.
set -euo pipefail
cd "$(dirname "$0")/.."
quick=${1:-}
jobs=${JOBS:-$(nproc)}
version=$(sed -n 's/^project(tenon VERSION \([0-9.]*\) .*/\1/p' CMakeLists.txt)
work=build/release_files
out=dist/tenon-$version

fail() { echo "release: $1" >&2; exit 1; }
step() { echo "release: $1"; }

[ -n "$version" ] || fail "no version in CMakeLists.txt"
[ -z "$(git status --porcelain)" ] || fail "files are changed or unknown to git: commit them first"
grep -q "^## $version" CHANGELOG.md || fail "CHANGELOG.md has no part for $version"
! grep -q "^## $version (unreleased)" CHANGELOG.md ||
  step "note: CHANGELOG.md still says unreleased"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
rm -rf "$work" "$out"
mkdir -p "$work" "$out"

step "sources of $(git rev-parse --short HEAD)"
git archive --format=tar --prefix="tenon-$version/" HEAD | gzip -9n >"$out/tenon-$version.tar.gz"

step "wheel and Debian package"
make --no-print-directory JOBS="$jobs" wheel >"$work/wheel.log" ||
  fail "make wheel: $work/wheel.log"
[ ! -e build/wheel.missing ] || fail "$(cat build/wheel.missing)"
cp "$(cat build/wheel/made)" "$out/"
make --no-print-directory JOBS="$jobs" deb >"$work/deb.log" || fail "make deb: $work/deb.log"
cp "$(ls -t dist/tenon_*.deb | head -n 1)" "$out/"
wheel=$(ls "$out"/*.whl)
deb=$(ls "$out"/*.deb)

step "one version everywhere"
is_of_version() { [ "$("$1" --version)" = "tenon $version" ] || fail "$1 has another version"; }
is_of_version build/release/bin/tenon
case $(basename "$wheel") in tenon_usd-"$version"-*) ;; *) fail "$wheel is not of $version" ;; esac
[ "$(dpkg-deb -f "$deb" Version | cut -d- -f1)" = "$version" ] || fail "$deb is not of $version"

step "the wheel, in an environment with NumPy alone"
python=$(cat build/wheel/python)
"$python" -m venv "$work/own"
"$work/own/bin/python" -m pip install --quiet --disable-pip-version-check "$wheel"
for test in stage physics world functions package; do
  "$work/own/bin/python" -B "python/tests/test_$test.py" >"$work/wheel_$test.log" 2>&1 ||
    fail "the wheel: $work/wheel_$test.log"
done
is_of_version "$work/own/bin/tenon"

step "the Debian package"
python3 -B tests/release/deb.py build/release "$deb" >"$work/deb_check.log" 2>&1 ||
  fail "the package: $work/deb_check.log"

step "the archive of the sources"
tar -xzf "$out/tenon-$version.tar.gz" -C "$work"
diff <(cd "$work/tenon-$version" && find . -type f -o -type l | sort) \
  <(git ls-files | sed 's,^,./,' | sort) >"$work/source_files.diff" ||
  fail "the archive has not the files of the commit"
if [ "$quick" != --quick ]; then
  (cd "$work/tenon-$version" && cmake --preset release && cmake --build build/release -j "$jobs") \
    >"$work/source.log" || fail "the sources do not build: $work/source.log"
  is_of_version "$work/tenon-$version/build/release/bin/tenon"
fi

step "bill of materials and sums"
rm -rf "$work/prefix"
cmake --install build/release --prefix "$work/prefix" >"$work/install.log"
tools/make_sbom.py "$work/prefix" "$out/tenon-$version.spdx.json" "$out"/*
(cd "$out" && sha256sum -- * >../SHA256SUMS && mv ../SHA256SUMS . &&
  sha256sum --quiet -c SHA256SUMS)
ls -l "$out"
