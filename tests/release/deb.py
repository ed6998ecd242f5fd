#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The Debian package, unpacked into an empty root: its command simulates on every engine, reads by
its worker and finds its library; what its programs link to is inside or in what it depends on.

usage: deb.py BUILD_OF_THE_PRESET_RELEASE [PACKAGE]. Without a package one is made of the build.
Exit 0: so it is; 1: what is not; 77: not built, or no tools of Debian here.
"""

import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

import installed
import libraries

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HAND = os.path.join(ROOT, "examples/inspire_hand/inspire_hand.usda")
ROBOT = os.path.join(ROOT, "examples/cpp/robots/arm.urdf")
TOOLS = ("cpack", "dpkg-deb", "dpkg-shlibdeps", "dpkg-query")
# Package-relative: what somebody looks for.
WANTED = ("usr/bin/tenon", "usr/libexec/tenon/tenon-worker", "usr/lib/libtenon.so",
          "usr/include/tenon/tenon.h", "usr/lib/pkgconfig/tenon.pc",
          "usr/lib/cmake/tenon/tenon-config.cmake", "usr/share/man/man1/tenon.1",
          "usr/share/doc/tenon/LICENSE")


def run(*words, **options):
    return subprocess.run(words, capture_output=True, text=True, check=False, **options)


def make_package(build, folder):
    """-> the path of a package that is made quickly, not small."""
    done = run("cpack", "--config", os.path.join(build, "CPackConfig.cmake"), "-B", folder, "-D",
               "CPACK_DEBIAN_COMPRESSION_TYPE=gzip")
    if done.returncode:
        sys.exit(f"cpack: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return glob.glob(os.path.join(folder, "*.deb"))[0]


def faults_of_fields(package):
    fields = {}
    for name in ("Package", "Version", "Architecture", "Depends", "Recommends"):
        fields[name] = run("dpkg-deb", "-f", package, name).stdout.strip()
    with open(os.path.join(ROOT, "CMakeLists.txt"), encoding="utf-8") as file:
        version = re.search(r"project\(tenon VERSION ([0-9.]+)", file.read())[1]
    wanted = {"Package": "tenon", "Version": version,
              "Architecture": run("dpkg", "--print-architecture").stdout.strip()}
    for name, value in wanted.items():
        if fields[name] != value:
            yield f"field {name} is {fields[name]!r}, not {value!r}"
    for library in ("libc6", "liblz4", "libqhull"):
        if library not in fields["Depends"]:
            yield f"it does not depend on {library}: {fields['Depends']}"
    for library in ("libassimp", "libmeshoptimizer", "libnlopt"):
        if library not in fields["Recommends"]:
            yield f"it does not recommend {library}: {fields['Recommends']}"


def faults_of_libraries(root, package):
    """Every NEEDED name is a file inside, or one of a package that is named."""
    inside = {os.path.basename(path) for path in glob.glob(root + "/usr/lib/**", recursive=True)}
    named = re.findall(r"[a-z0-9+.-]+", run("dpkg-deb", "-f", package, "Depends").stdout)
    files = [*installed.programs(root), *glob.glob(root + "/usr/lib/**/*.so*", recursive=True)]
    for path in (path for path in files if not os.path.islink(path)):
        for library in libraries.needed(path):
            owner = run("dpkg-query", "-S", f"*/{library}").stdout
            owners = set(re.findall(r"^([^:, \n]+)", owner, re.M))
            if library not in inside and not owners & set(named):
                yield f"{os.path.relpath(path, root)} needs {library}, of {owners or 'nobody'}"


def faults_of_program(root, work):
    """The command of the root alone is on the path."""
    tenon = os.path.join(root, "usr/bin/tenon")
    environment = {"PATH": f"{os.path.dirname(tenon)}:/usr/bin:/bin", "HOME": work}

    def answer(*words):
        done = run("tenon", *words, "--json", env=environment, cwd=work)
        return json.loads(done.stdout), done.returncode

    doctor, _ = answer("doctor")
    engines = [engine["name"] for engine in doctor["engines"] if engine["available"]]
    print("engines", *engines)
    # A browser is the machine's.
    lacking = [part["name"] for part in doctor["libraries"]
               if not part["available"] and part["name"] != "browser"]
    if lacking or "mujoco" not in engines:
        yield f"doctor misses {lacking}, has the engines {engines}"
    for engine in engines:
        found, code = answer("sim", HAND, "--engine", engine, "--duration", "0.02", "-o",
                             f"{engine}.csv")
        if code or not os.path.getsize(os.path.join(work, f"{engine}.csv")):
            yield f"sim on {engine}: exit {code} {found['diagnostics'][:3]}"
    found, code = answer("convert", ROBOT, "arm.usda")
    if code or not os.path.exists(os.path.join(work, "arm.usda")):
        yield f"convert: exit {code} {found['diagnostics'][:3]}"
    if os.path.realpath(shutil.which("tenon", path=environment["PATH"])) != tenon:
        yield "another tenon was asked"


def faults_of_library(root):
    """pkg-config, told where the root is, names what is in it."""
    done = run("pkg-config", "--cflags", "--libs", "tenon",
               env={**os.environ, "PKG_CONFIG_PATH": root + "/usr/lib/pkgconfig"})
    for folder in re.findall(r"-[IL](\S+)", done.stdout):
        if not os.path.isdir(folder) or not os.path.realpath(folder).startswith(root):
            yield f"pkg-config names {folder}"
    if done.returncode or "-ltenon" not in done.stdout:
        yield f"pkg-config: {done.stdout}{done.stderr}"


def main():
    build = installed.release_build()
    if missing := [tool for tool in TOOLS if not shutil.which(tool)]:
        print(f"skipped: {', '.join(missing)} are not here: tools/bootstrap.sh deb installs them")
        return installed.SKIPPED
    with tempfile.TemporaryDirectory(prefix="tenon_deb_") as folder:
        folder = os.path.realpath(folder)
        package = sys.argv[2] if len(sys.argv) > 2 else make_package(build, folder + "/made")
        root, work = folder + "/root", folder + "/work"
        os.makedirs(work)
        done = run("dpkg-deb", "-x", package, root)
        faults = [f"dpkg-deb -x: {done.stderr}"] if done.returncode else []
        faults += [f"{name} is missing" for name in WANTED
                   if not os.path.exists(os.path.join(root, name))]
        faults += faults_of_fields(package)
        faults += faults_of_libraries(root, package)
        faults += faults_of_program(root, work)
        faults += faults_of_library(root)
        size = os.path.getsize(package)
    for fault in faults:
        print(fault)
    print(f"{os.path.basename(package)}, {size} bytes, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
