#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""An installation needs nothing of the folders that it was built in: no installed file names one,
without its own libraries it finds none, and with the sources and the build hidden it reads,
decomposes and simulates on every engine.

usage: moved.py BUILD_OF_THE_PRESET_RELEASE. Exit 0: so it is; 1: what is not; 77: not built.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

import installed

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
HAND = os.path.join(ROOT, "examples/inspire_hand")
ROBOT = os.path.join(ROOT, "examples/cpp/robots/arm.urdf")
SOURCES = (".h", ".hpp", ".inl", ".c", ".cpp")
# In a mount namespace of its own, in which the folders $1 and $2 are empty, runs the rest.
HIDDEN = 'mount -t tmpfs none "$1" && { [ ! -d "$2" ] || mount -t tmpfs none "$2"; } && ' \
         'shift 2 && exec "$@"'
ENTER = ("unshare", "--user", "--map-root-user", "--mount", "sh", "-c", HIDDEN, "sh")


def builders_folders(build):
    """-> the sources, and the folder that engines are built in, as CMake knows them."""
    with open(os.path.join(build, "CMakeCache.txt"), encoding="utf-8") as file:
        cache = dict(re.findall(r"^([\w.-]+):\w+=(.*)$", file.read(), re.M))
    return cache["CMAKE_HOME_DIRECTORY"], cache["TENON_ENGINE_CACHE"]


def faults_of_files(prefix, folders):
    """Installed files that name a folder of the builder."""
    for folder, _, names in os.walk(prefix):
        for path in (os.path.join(folder, name) for name in names):
            with open(path, "rb") as file:
                content = file.read()
            for named in folders:
                for found in re.finditer(re.escape(named.encode()) + rb"/[\x20-\x7e]*", content):
                    text = found[0].decode()
                    if not text.endswith(SOURCES):  # in messages of PhysX, which opens none
                        yield f"{os.path.relpath(path, prefix)} names {text}"


def run(prefix, work, *words, hide=()):
    enter = (*ENTER, *hide) if hide else ()
    environment = {"PATH": "/usr/bin:/bin", "HOME": work}
    return subprocess.run([*enter, os.path.join(prefix, "bin/tenon"), *words], cwd=work,
                          env=environment, capture_output=True, text=True, check=False)


def parts(prefix, work, **options):
    """-> {part: whether it is there} of the engines and libraries that doctor names."""
    answer = json.loads(run(prefix, work, "doctor", "--json", **options).stdout)
    return {part["name"]: part["available"] for part in answer["engines"] + answer["libraries"]}


def faults_without_libraries(prefix, work):
    """With lib/tenon taken away none of what was in it is there."""
    folder = os.path.join(prefix, "lib/tenon")
    held = {"mujoco": "libmujoco", "physx": "libtenon_physx", "coacd": "coacd"}
    held = {part for part, name in held.items()
            if any(each.startswith(name) for each in os.listdir(folder))}
    os.rename(folder, folder + ".away")
    found = parts(prefix, work)
    os.rename(folder + ".away", folder)
    if not held:
        yield "lib/tenon holds no library: the test sees nothing"
    for part in sorted(held):
        if found[part]:
            yield f"{part} is found although lib/tenon is gone"
    for part, available in parts(prefix, work).items():
        if part in held and not available:
            yield f"{part} is not found although it is installed"


def faults_while_hidden(prefix, work, hide):
    engines = [name for name in ("mujoco", "physx", "jolt") if parts(prefix, work, hide=hide)[name]]
    commands = [("info", "hand/inspire_hand.usda"), ("convert", "arm.urdf", "arm/")]
    commands += [("sim", "hand/inspire_hand.usda", "--engine", engine, "--duration", "0.02")
                 for engine in engines]
    for words in commands:
        done = run(prefix, work, *words, hide=hide)
        if done.returncode:
            yield f"{' '.join(words)}: exit {done.returncode} {done.stderr}"
    print(f"hidden: {' '.join(hide)}; ran: {', '.join(' '.join(words) for words in commands)}")


def main():
    build = installed.release_build()
    folders = builders_folders(build)
    with installed.install(build) as prefix, tempfile.TemporaryDirectory() as work:
        shutil.copytree(HAND, os.path.join(work, "hand"))
        shutil.copy(ROBOT, work)
        faults = [*faults_of_files(prefix, folders), *faults_without_libraries(prefix, work)]
        hidden = subprocess.run([*ENTER, *folders, "true"], check=False, capture_output=True,
                                text=True)
        inside = [folder for folder in folders if prefix.startswith(folder + "/")]
        if hidden.returncode or inside:
            print(f"not tried with hidden sources: {hidden.stderr.strip() or inside}")
        else:
            faults += faults_while_hidden(prefix, work, folders)
    for fault in faults:
        print(fault)
    print(f"{len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
