#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The program starts without the large libraries that few assets need, says where one is not what
it was built with, and answers what it can without.

usage: libraries.py BUILD_OF_THE_PRESET_RELEASE. Exit 0: so it is; 1: what is not; 77: not built.
"""

import json
import os
import re
import subprocess
import sys
import tempfile

import hardening
import installed

SMALL = re.compile(r"^(lib(lz4|qhull_r|m|c|gcc_s|dl|pthread|rt)\.so[.0-9]*|ld-linux.*)$")
BODIES = """#usda 1.0
def Xform "Box" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
{
    float physics:mass = 1
}
"""
# A library of MuJoCo's name that is none.
OTHER = "int mj_version(void) { return 1; }\n"
# A library that leaves a file where it was opened.
PLANTED = """#include <fcntl.h>
__attribute__((constructor)) static void opened(void) { open("opened", O_CREAT | O_WRONLY, 0600); }
"""
# Verb -> its exit code where MuJoCo cannot be used.
EXITS = {"info": 0, "check": 0, "physics": 0, "sim": 4, "doctor": 4}


def needed(program):
    return re.findall(r"\(NEEDED\).*\[(.*)\]", hardening.read_elf(program, "-d"))


def make_other(folder, soname):
    source = os.path.join(folder, "other.c")
    with open(source, "w", encoding="utf-8") as file:
        file.write(OTHER)
    subprocess.run(["cc", "-shared", "-fPIC", f"-Wl,-soname,{soname}", "-o",
                    os.path.join(folder, soname), source], check=True)


def run(program, folder, verb):
    words = [program, verb] + ([] if verb == "doctor" else ["bodies.usda"]) + ["--json"]
    environment = {**os.environ, "LD_LIBRARY_PATH": folder}
    return subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True,
                          check=False)


def faults_with_other_library(program, folder):
    for verb, status in EXITS.items():
        done = run(program, folder, verb)
        answer = json.loads(done.stdout)
        rules = [found["rule"] for found in answer["diagnostics"]]
        if done.returncode != status:
            yield f"{verb}: exit {done.returncode}, not {status}: {done.stderr.strip()}"
        if verb == "sim" and "engine.missing" not in rules:
            yield f"sim: does not say engine.missing, but {rules}"
        if verb == "doctor":
            engine = next(each for each in answer["engines"] if each["name"] == "mujoco")
            if engine["available"] or not engine["howToGet"]:
                yield "doctor: MuJoCo is there, or it does not say how to get it"


def is_opened_from_working_folder(program, folder):
    """Whether the program, found by the PATH, opens what lies where its own libraries would be if
    it stood in the working directory."""
    work = os.path.join(folder, "bin")
    place = os.path.join(folder, "lib/tenon/coacd")
    os.makedirs(work)
    os.makedirs(place)
    source = os.path.join(folder, "planted.c")
    with open(source, "w", encoding="utf-8") as file:
        file.write(PLANTED)
    subprocess.run(["cc", "-shared", "-fPIC", "-o", os.path.join(place, "lib_coacd.so"), source],
                   check=True)
    subprocess.run(["tenon", "doctor"], executable=program, cwd=work, capture_output=True,
                   check=False)
    return os.path.exists(os.path.join(work, "opened"))


def main():
    build = installed.release_build()
    with installed.install(build) as prefix, tempfile.TemporaryDirectory() as folder:
        program = os.path.join(prefix, "bin/tenon")
        faults = [f"the program is linked to {name}" for name in needed(program)
                  if not SMALL.match(name)]
        if is_opened_from_working_folder(program, folder):
            faults.append("a library of CoACD's name is opened from beside the working directory")
        libraries = [name for name in os.listdir(os.path.join(prefix, "lib/tenon"))
                     if name.startswith("libmujoco.so")]
        if libraries:
            make_other(folder, libraries[0])
            with open(os.path.join(folder, "bodies.usda"), "w", encoding="utf-8") as file:
                file.write(BODIES)
            faults += faults_with_other_library(program, folder)
    for fault in faults:
        print(fault)
    print(f"{len(EXITS)} verbs, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
