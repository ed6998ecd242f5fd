#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""As a part of another project tenon changes none of its options and fetches into its build folder.

The project is configured, not built, with a copy of the sources. What pip is to fetch comes from
what this build has fetched, by a stand-in for python3: nothing is asked of the network.

usage: subproject.py. Exit 0: so it is; 1: what is not; 77: nothing was fetched here.
"""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SKIPPED = 77
PARTS = ("CMakeLists.txt", "LICENSE", "cmake", "cli", "docs", "tenon", "tests", "thirdparty",
         "worker")
PARENT = """cmake_minimum_required(VERSION 3.22)
project(parent LANGUAGES C CXX)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
include(GNUInstallDirs) # its cache entries are the same for all projects
function(state out)
  get_cmake_property(names VARIABLES)
  list(FILTER names INCLUDE REGEX
       "^CMAKE_(C|CXX|EXE|SHARED|MODULE|STATIC)_|_FLAGS|_OUTPUT_|^CMAKE_(BUILD|INSTALL)_|POSITION")
  list(FILTER names EXCLUDE REGEX "PIE_SUPPORTED$") # what a module of CMake found out
  set(text)
  foreach(name IN LISTS names)
    string(APPEND text "${name}=${${name}}\\n")
  endforeach()
  foreach(property COMPILE_OPTIONS COMPILE_DEFINITIONS LINK_OPTIONS INCLUDE_DIRECTORIES)
    get_directory_property(value ${property})
    string(APPEND text "${property}=${value}\\n")
  endforeach()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()
state(before)
add_subdirectory(${TENON_SOURCES} tenon)
state(after)
file(WRITE ${CMAKE_BINARY_DIR}/before "${before}")
file(WRITE ${CMAKE_BINARY_DIR}/after "${after}")
add_executable(app app.cpp)
target_link_libraries(app PRIVATE tenon::tenon)
install(FILES app.cpp DESTINATION share)
"""
# Stands in for python3 -m pip download: makes the wheel again of what lies in the folder unpacked.
PIP = """import os, sys, zipfile
words = sys.argv
target = words[words.index("--dest") + 1]
name = os.path.basename(words[words.index("-r") + 1]).split("-")[0]
source = {sources!r}[name]
project = "mujoco_core" if name == "mujoco" else name
os.makedirs(target)
with zipfile.ZipFile(os.path.join(target, name + ".whl"), "w") as wheel:
    for folder, _, files in os.walk(source):
        for file in files:
            path = os.path.join(folder, file)
            inner = os.path.relpath(path, source)
            if inner.startswith("licences/"):
                inner = project + "-1.dist-info/" + os.path.basename(path)
            elif name == "mujoco":
                inner = "mujoco/" + inner.removeprefix("lib/")
            wheel.write(path, inner)
"""


def fetched():
    """{"mujoco": folder, "coacd": folder} of the sources' own build; skips without them."""
    deps = os.path.join(ROOT, "build/_deps")
    names = os.listdir(deps) if os.path.isdir(deps) else []
    found = {}
    for project in ("mujoco", "coacd"):
        folders = [name for name in names if re.fullmatch(project + r"-[0-9.]+", name)]
        if not folders:
            print(f"skipped: no {project} in {deps}")
            sys.exit(SKIPPED)
        found[project] = os.path.join(deps, sorted(folders)[-1])
    return found


def write(path, text, mode=0o644):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    os.chmod(path, mode)


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def files_below(folder):
    return {os.path.join(place, name) for place, _, names in os.walk(folder) for name in names}


def configure(folder):
    """-> the folders of the sources, and of the build of the parent."""
    sources, parent, build = (os.path.join(folder, name) for name in ("tenon", "parent", "build"))
    os.makedirs(sources)
    os.makedirs(parent)
    for part in PARTS:
        path = os.path.join(ROOT, part)
        (shutil.copytree if os.path.isdir(path) else shutil.copy)(path,
                                                                  os.path.join(sources, part))
    write(os.path.join(parent, "CMakeLists.txt"), PARENT)
    write(os.path.join(parent, "app.cpp"), '#include "tenon/tenon.h"\nint main() {}\n')
    pip, python = os.path.join(folder, "pip.py"), os.path.join(folder, "python")
    write(pip, PIP.format(sources=fetched()))
    write(python, f'#!/bin/sh\nexec {shlex.join([sys.executable, pip])} "$@"\n', 0o755)
    before = files_below(sources)
    done = subprocess.run(["cmake", "-G", "Ninja", "-S", parent, "-B", build,
                           f"-DTENON_SOURCES={sources}", f"-DTENON_PYTHON={python}"],
                          capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"cmake: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return sources, before, build


def faults_of_options(build):
    """What the parent has that it had not, and how its program is compiled."""
    before, after = (read(os.path.join(build, name)).split("\n") for name in ("before", "after"))
    yield from (f"leaks `{line}`" for line in after if line not in before)
    commands = json.loads(read(os.path.join(build, "compile_commands.json")))
    command = next(each["command"] for each in commands if each["file"].endswith("/app.cpp"))
    words = command.split()[1:command.split().index("-o")]
    yield from (f"the parent's program is compiled with {word}" for word in words
                if not re.match(r"-(I|isystem|std=gnu\+\+20|fvisibility=hidden)|/", word))
    own = [each["command"] for each in commands if "/tenon_base.dir/" in each["command"]]
    hidden = [command for command in own
              if re.findall(r"-fvisibility=(\w+)", command)[-1] != "default"]
    if hidden or not own:
        yield f"what the library exports is hidden as the parent's names are: {hidden}"


def faults_of_places(sources, before, build):
    yield from (f"the source folder gets {path}" for path in sorted(files_below(sources) - before))
    fetched_there = os.path.join(build, "tenon/_deps")
    for name, proof in (("mujoco", "include/mujoco/mujoco.h"), ("coacd", "coacd/lib_coacd.so")):
        if not any(path.endswith(proof) for path in files_below(fetched_there)):
            yield f"{name} is not in {fetched_there}"
    installed = read(os.path.join(build, "tenon/cmake_install.cmake"))
    if "tenon-worker" in installed or "tenon.h" in installed:
        yield "installs its own files with those of the parent"


def main():
    fetched()
    with tempfile.TemporaryDirectory(prefix="tenon_subproject_") as folder:
        sources, before, build = configure(folder)
        faults = [*faults_of_options(build), *faults_of_places(sources, before, build)]
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
