#!/usr/bin/env bash
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
# Installs what the build needs and this machine lacks (Debian 12, Ubuntu 22.04 and later).
#   tools/bootstrap.sh build        to build the program
#   tools/bootstrap.sh build engines   with the engines that are built from sources
#   tools/bootstrap.sh build wheel   to make the Python package
#   tools/bootstrap.sh build test   to run the tests too
#   tools/bootstrap.sh build test judge   and the long runs, some of which need clang
#   tools/bootstrap.sh picture      to draw: the page, and a Chromium
#   tools/bootstrap.sh docs         to make the reference of the headers
#   tools/bootstrap.sh deb          to make the Debian package
# Says what it does; asks for root only to install; with all there it does nothing, offline too.
set -euo pipefail

missing=()

# need_package PACKAGE...: Debian packages that must be installed.
need_package() {
  for package in "$@"; do
    dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -q '^installed$' ||
      missing+=("$package")
  done
}

# need_tool PACKAGE COMMAND...: the package, unless COMMAND succeeds (a tool of one's own counts).
need_tool() {
  local package=$1
  shift
  "$@" >/dev/null 2>&1 || missing+=("$package")
}

at_least() { # at_least WANTED FOUND: version order
  [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]
}

compiler_is_new_enough() { at_least 11 "$(c++ -dumpversion)"; }

cmake_is_new_enough() { at_least 3.22 "$(cmake --version | sed -n '1s/[^0-9]*//p')"; }

# usd-core has wheels from Python 3.11 on; Ubuntu 22.04 has 3.10 and offers 3.11 beside it.
need_oracle_python() {
  local python
  for python in python3 python3.14 python3.13 python3.12 python3.11; do
    if "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
      "$python" -c 'import ensurepip, venv' 2>/dev/null || missing+=("$python-venv")
      return
    fi
  done
  missing+=(python3-venv python3.11-venv)
}

need_for_build() {
  need_tool g++ compiler_is_new_enough
  need_tool cmake cmake_is_new_enough
  need_tool ninja-build ninja --version
  need_tool python3 python3 --version
  need_tool python3-pip python3 -m pip --version
  need_package ca-certificates libcli11-dev nlohmann-json3-dev liblz4-dev \
    zlib1g-dev libeigen3-dev libqhull-dev libpugixml-dev libassimp-dev libmeshoptimizer-dev \
    libboost-dev
  need_toml
}

# Ubuntu 22.04 has no toml++; the program is built without tenon.toml there.
need_toml() {
  if ! (. /etc/os-release && [ "${VERSION_CODENAME:-}" = jammy ]); then
    need_package libtomlplusplus-dev
  fi
}

# Headers of the Python that the package is built for (tools/make_wheel.sh), 3.11 or later.
need_for_wheel() {
  need_nlopt
  local python
  for python in python3 python3.14 python3.13 python3.12 python3.11; do
    if "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
      "$python" -c 'import ensurepip, venv' 2>/dev/null || missing+=("$python-venv")
      "$python" -c 'import os, sys, sysconfig as s
sys.exit(not os.path.exists(os.path.join(s.get_paths()["include"], "Python.h")))' 2>/dev/null ||
        missing+=("$python-dev")
      return
    fi
  done
  missing+=(python3-dev python3-venv)
}

# Ubuntu 22.04 has node 12, which is too old; the page and its tests are left out there.
need_for_page() {
  need_tool nodejs node --version
  need_tool npm npm --version
}

need_for_picture() {
  need_for_page
  need_tool chromium chromium_is_there
}

# Debian 12's own cargo is too old to fetch single crates; it has a newer one beside it.
need_for_engines() {
  cargo_is_new_enough && return
  local package=cargo
  if (. /etc/os-release && [ "${VERSION_CODENAME:-}" = bookworm ]); then
    package=cargo-web
  fi
  missing+=("$package")
}

cargo_is_new_enough() {
  cargo --version >/dev/null 2>&1 && at_least 1.70 "$(cargo --version | cut -d ' ' -f 2)"
}

need_for_test() {
  need_for_engines
  need_for_wheel
  need_for_deb
  need_for_page
  need_package libgtest-dev
  need_tool valgrind valgrind --version
  need_tool strace strace --version
  need_tool binutils readelf --version
  need_tool pkg-config pkg-config --version
  need_oracle_python
}

need_for_judge() {
  need_for_docs
  need_tool chromium chromium_is_there # of recordings and the tests in a browser
  need_tool ffmpeg ffmpeg -version     # other programs decode recordings
  need_tool debootstrap test -x /usr/sbin/debootstrap
  need_tool clang-19 clang++-19 --version
  need_package libclang-rt-19-dev
  if [ "$(dpkg --print-architecture)" = amd64 ]; then # of the preset bits32
    need_package g++-multilib
    for library in liblz4-dev libqhull-dev libpugixml-dev libgtest-dev libmeshoptimizer-dev \
                   zlib1g; do
      need_package "$library:i386"
    done
  fi
}

chromium_is_there() {
  command -v chromium || command -v chromium-browser || command -v google-chrome
}

need_for_docs() { need_tool doxygen doxygen --version; }

# Searches gains (`tenon tune --search`); the wheel has it in it, the Debian package recommends it.
need_nlopt() { need_package libnlopt0; }

need_for_deb() {
  need_nlopt
  need_tool dpkg-dev dpkg-shlibdeps --version
  need_tool file file --version # CPack asks it what programs are
}

install_missing() {
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "bootstrap: no sudo here; run as root: apt-get install ${missing[*]}" >&2
      exit 1
    }
    root=(sudo)
  fi
  echo "bootstrap: installing ${missing[*]}"
  local quiet=(-qq -o Dpkg::Use-Pty=0)
  [[ "${missing[*]}" != *:i386* ]] || "${root[@]}" dpkg --add-architecture i386
  # A list that cannot be fetched just now is no reason to stop: the older one may do.
  "${root[@]}" apt-get "${quiet[@]}" update || true
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get "${quiet[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null
}

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "bootstrap: not Debian or Ubuntu; see docs/dependencies.md for what to install" >&2
  exit 0
fi
for part in "${@:-build}"; do
  case "$part" in
    build) need_for_build ;;
    engines) need_for_engines ;;
    wheel) need_for_wheel ;;
    test) need_for_test ;;
    judge) need_for_judge ;;
    docs) need_for_docs ;;
    deb) need_for_deb ;;
    picture) need_for_picture ;;
    *)
      echo "bootstrap: unknown part '$part'; expected:" \
        "build, engines, wheel, test, judge, picture, docs, deb" >&2
      exit 2
      ;;
  esac
done
[ ${#missing[@]} -eq 0 ] || install_missing
