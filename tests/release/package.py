#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Programs outside build against what is installed, wherever the prefix was moved to: examples/cpp
by find_package, one of them by pkg-config, and every header, with g++ and clang++.

usage: package.py BUILD_OF_THE_PRESET_RELEASE. Exit 0: so it is; 1: what is not; 77: not built.
"""

import math
import os
import re
import shutil
import subprocess
import sys
import tempfile

import installed

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLES = os.path.join(ROOT, "examples/cpp")
HAND = os.path.join(ROOT, "examples/inspire_hand")
USUAL_HEADERS = ("string", "vector", "span", "optional", "memory")
MAX_HEADER_LINES = 12000  # preprocessed, not blank, beyond those of the usual headers
STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
# Compiler -> what its programs are compiled with: with type information and exceptions, as most
# programs are, and without, as the library is.
COMPILERS = {"g++": "", "clang++-19": "-fno-exceptions -fno-rtti"}


def run(*words, cwd=None, **environment):
    done = subprocess.run(words, cwd=cwd, capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})
    if done.returncode:
        sys.exit(f"{' '.join(words)}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def moved_prefix(build, folder):
    """What is installed, at another place than it was installed to."""
    with installed.install(build) as prefix:
        place = os.path.join(folder, "elsewhere")
        shutil.copytree(prefix, place, symlinks=True)
        return place, prefix


def faults_of_paths(prefix, first):
    """Texts of the package that name where it was built or installed first."""
    for folder, _, names in os.walk(prefix):
        for name in names:
            if name.endswith((".cmake", ".pc")):
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    text = file.read()
                if first in text or ROOT in text:
                    yield f"{name} names an absolute path"


def compile_headers(prefix, folder, compiler):
    """All headers in one source, warnings are errors."""
    names = []
    for place, _, files in os.walk(os.path.join(prefix, "include/tenon")):
        names += [os.path.relpath(os.path.join(place, name), os.path.join(prefix, "include"))
                  for name in files if name.endswith(".h")]
    source = os.path.join(folder, "headers.cpp")
    with open(source, "w", encoding="utf-8") as file:
        file.writelines(f'#include "{name}"\n' for name in sorted(names))
    flags = run("pkg-config", "--cflags", "tenon",
                PKG_CONFIG_PATH=os.path.join(prefix, "lib/pkgconfig")).stdout.split()
    run(compiler, "-std=c++20", *STRICT, "-fsyntax-only", *flags, source)
    return len(names)


def preprocessed_lines(compiler, flags, *headers):
    source = "".join(f"#include <{header}>\n" for header in headers)
    done = subprocess.run([compiler, "-std=c++20", *flags, "-E", "-x", "c++", "-"], input=source,
                          capture_output=True, text=True, check=True)
    return sum(1 for line in done.stdout.split("\n") if line.strip() and not line.startswith("#"))


def faults_of_length(prefix, compiler):
    """tenon.h makes nobody wait: what it adds to the headers that every program has."""
    flags = ["-I" + os.path.join(prefix, "include")]
    lines = preprocessed_lines(compiler, flags, *USUAL_HEADERS, "tenon/tenon.h")
    lines -= preprocessed_lines(compiler, flags, *USUAL_HEADERS)
    print(f"{compiler}: tenon.h is {lines} lines beyond the usual headers")
    if lines > MAX_HEADER_LINES:
        yield f"tenon.h is {lines} lines, more than {MAX_HEADER_LINES}"


def build_examples(prefix, folder, compiler, flags):
    place = os.path.join(folder, "examples_" + compiler)
    run("cmake", "-G", "Ninja", "-S", EXAMPLES, "-B", place, f"-DCMAKE_PREFIX_PATH={prefix}",
        f"-DCMAKE_CXX_COMPILER={compiler}", f"-DCMAKE_CXX_FLAGS={flags}")
    run("cmake", "--build", place)
    return place


def build_by_make(prefix, folder, compiler):
    """The example `physics`, by examples/cpp/Makefile in a folder of its own."""
    place = os.path.join(folder, "make_" + compiler)
    os.makedirs(place)
    for name in ("Makefile", "example.h", "physics.cpp"):
        shutil.copy(os.path.join(EXAMPLES, name), place)
    run("make", "physics", f"CXX={compiler} {' '.join(STRICT)}", cwd=place,
        PKG_CONFIG_PATH=os.path.join(prefix, "lib/pkgconfig"))
    return place


def number(output, name):
    found = re.search(rf"^{re.escape(name)}: (-?[0-9.]+)", output, re.M)
    return float(found.group(1)) if found else math.nan


def faults_of_numbers(what, output, expected):
    for name, (value, tolerance) in expected.items():
        found = number(output, name)
        if not abs(found - value) <= tolerance:
            yield f"{what}: {name} is {found}, not {value}"


def faults_of_physics(place, hand):
    output = run(os.path.join(place, "physics"), hand + "/inspire_hand.usda").stdout
    yield from faults_of_numbers("physics", output, {
        "bodies": (13, 0), "colliders": (13, 0), "joints": (13, 0), "mass": (0.54, 1e-6)})


PENDULUM = """#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W"
{
    def Xform "rod" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"])
    {
        float physics:mass = 2
        point3f physics:centerOfMass = (0.5, 0, 0)
        float3 physics:diagonalInertia = (0.125, 0.25, 0.25)
    }
    def PhysicsRevoluteJoint "hinge"
    {
        rel physics:body1 = </W/rod>
        uniform token physics:axis = "Y"
    }
}
"""


def faults_of_dynamics(place, folder):
    """A rod of 2 kg, its centre 0.5 m from a horizontal hinge: I + m l^2, m g l cos 60 deg."""
    asset = os.path.join(folder, "pendulum.usda")
    with open(asset, "w", encoding="utf-8") as file:
        file.write(PENDULUM)
    output = run(os.path.join(place, "dynamics"), asset, "hinge=60deg").stdout
    yield from faults_of_numbers("dynamics", output, {
        "mass": (2, 1e-9), "inertia of hinge": (0.25 + 2 * 0.5 ** 2, 1e-8),
        "weight on hinge": (2 * 9.81 * 0.5 * math.cos(math.radians(60)), 1e-8),
        "speed by hinge": (0.5, 1e-8)})


def faults_of_control_loop(place, hand, prefix):
    """Without load a drive reaches its target, and a torque moves it by torque / stiffness; the
    contacts carry the can, 0.1 kg. Friction of the finger's two joints, 0.002 N m each, holds some
    of the torque."""
    done = run(os.path.join(place, "control_loop"), hand + "/grasp.usda", LD_DEBUG="libs")
    yield from faults_of_numbers("control_loop", done.stdout, {
        "target": (0.2 * 1.7, 1e-4), "position": (0.2 * 1.7, 0.01),
        "pushed by": ((0.05 - 0.0021) / 2.86479, 0.0021 / 2.86479),
        "mean force on the can, upwards": (0.981, 0.01)})
    if "continued the same: yes" not in done.stdout:
        yield "control_loop: a restored state goes on in another way"
    if f"calling init: {prefix}/lib/tenon/libmujoco" not in done.stderr:
        yield "control_loop: MuJoCo is not taken from the prefix"


def faults_of_checking(place, hand):
    output = run(os.path.join(place, "checking"), hand + "/inspire_hand.usda",
                 "/inspire_hand").stdout
    yield from faults_of_numbers("checking", output, {"errors": (0, 0), "files to correct": (0, 0)})
    if '"prim": "/inspire_hand"' not in output:
        yield f"checking: it explains nothing: {output}"


def faults_of_environments(place, hand):
    output = run(os.path.join(place, "environments"), hand + "/inspire_hand.usda").stdout
    positions = [number(output, f"environment {i}") for i in range(16)]
    # The stiffest reach the limit of their velocity, and are as far as each other.
    if ("environments: 16, failed: 0" not in output or positions != sorted(positions) or
            len(set(positions)) < 8):
        yield f"environments: stiffer drives are not faster: {positions}"


def faults_of_files(place, hand, folder):
    """The examples that write."""
    output = run(os.path.join(place, "prims"), hand + "/inspire_hand.usda").stdout
    yield from faults_of_numbers("prims", output, {
        "authored mass": (0.54, 1e-6), "authored mass now": (0.54 - 0.398207 + 0.5, 1e-6)})
    box = os.path.join(folder, "box.usda")
    output = run(os.path.join(place, "authoring"), box).stdout
    if "/World/Box: 4.000000 kg, moment of inertia 0.02666667" not in output:  # m a^2 / 6
        yield f"authoring: {output}"
    robots = [os.path.join(EXAMPLES, "robots", name) for name in ("arm.urdf", "cart.xml")]
    output = run(os.path.join(place, "batch_conversion"), os.path.join(folder, "made"),
                 *robots).stdout
    for line in ("arm.urdf: 2 links, 2 bodies, 1 joints", "cart.xml: 3 links, 2 bodies, 2 joints"):
        if line not in output:
            yield f"batch_conversion: not `{line}` but: {output}"


def faults_of_examples(place, prefix, folder):
    with tempfile.TemporaryDirectory(dir=folder) as work:
        hand = shutil.copytree(HAND, os.path.join(work, "hand"))
        yield from faults_of_physics(place, hand)
        yield from faults_of_dynamics(place, work)
        yield from faults_of_control_loop(place, hand, prefix)
        yield from faults_of_environments(place, hand)
        yield from faults_of_checking(place, hand)
        yield from faults_of_files(place, hand, work)


def main():
    build = installed.release_build()
    compilers = {name: flags for name, flags in COMPILERS.items() if shutil.which(name)}
    if len(compilers) < len(COMPILERS):
        print(f"without {', '.join(set(COMPILERS) - set(compilers))}, which is not installed")
    with tempfile.TemporaryDirectory(prefix="tenon_package_") as folder:
        prefix, first = moved_prefix(build, folder)
        faults = list(faults_of_paths(prefix, first))
        for compiler, flags in compilers.items():
            headers = compile_headers(prefix, folder, compiler)
            faults += faults_of_length(prefix, compiler)
            place = build_examples(prefix, folder, compiler, flags)
            faults += [f"{compiler}: {fault}"
                       for fault in faults_of_examples(place, prefix, folder)]
            by_make = build_by_make(prefix, folder, compiler)
            faults += [f"{compiler}, pkg-config: {fault}"
                       for fault in faults_of_physics(by_make, HAND)]
    for fault in faults:
        print(fault)
    print(f"{headers} headers, compilers {', '.join(compilers)}, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
