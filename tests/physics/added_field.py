#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Adds a field to a struct of the physics scene in a copy of the sources, and its row in the table:
JSON, schema, difference, proof, hash and wire form must carry it with no other change, and without
the row the copy must not compile.

    added_field.py ROOT
"""

import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1]).resolve()
WORK = ROOT / "build/added_field"
COPY = WORK / "source"
PARTS = ("CMakeLists.txt", "cmake", "tenon", "cli", "worker", "tests/physics/conformance.txt")
SCENE, TABLE = "tenon/scene/physics_scene.h", "tenon/scene/fields/object_fields.h"
MEMBER = "  double gravity_scale = 1;\n"
ROW = "      field<&Body::gravity_scale>("
ADDED_MEMBER = "  double added = 0;\n"
ADDED_ROW = '      field<&Body::added>({.name = "added", .meaning = "for a test"}),\n'
TARGET = """
add_executable(added_field {root}/tests/physics/added_field.cpp structure/proof/compare_physics.cpp)
target_link_libraries(added_field PRIVATE tenon_answers)
"""


def copy_sources():
    shutil.rmtree(COPY, ignore_errors=True)
    COPY.mkdir(parents=True)
    for part in PARTS:
        source = ROOT / part
        (COPY / part).parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if source.is_dir() else shutil.copy2)(source, COPY / part)


def insert(path, before, text):
    """Puts `text` before the only place where `before` stands."""
    old = (COPY / path).read_text(encoding="utf-8")
    if old.count(before) != 1:
        sys.exit(f"{path} has {old.count(before)} times: {before.strip()}")
    (COPY / path).write_text(old.replace(before, text + before), encoding="utf-8")


def cmake(*arguments):
    return subprocess.run(["cmake", *map(str, arguments)], capture_output=True, text=True,
                          check=False)


def build():
    return cmake("--build", WORK / "build", "--target", "added_field")


def main():
    copy_sources()
    insert(SCENE, MEMBER, ADDED_MEMBER)
    with open(COPY / "tenon/CMakeLists.txt", "a", encoding="utf-8") as file:
        file.write(TARGET.format(root=ROOT))
    configured = cmake("-S", COPY, "-B", WORK / "build", "-G", "Ninja", "-DTENON_WITH_MUJOCO=OFF",
                       "-DTENON_WITH_COACD=OFF", "-DCMAKE_BUILD_TYPE=Debug",
                       "-DCMAKE_CXX_FLAGS_DEBUG=-O0")
    if configured.returncode:
        sys.exit(configured.stdout + configured.stderr)
    refused = build()
    if refused.returncode == 0 or "static assertion failed" not in refused.stdout:
        sys.exit("a member without a row compiles, or fails for another reason:\n" +
                 refused.stdout[-3000:])
    print("without a row in the table it does not compile")
    insert(TABLE, ROW, ADDED_ROW)
    built = build()
    if built.returncode:
        sys.exit(built.stdout[-3000:] + built.stderr)
    sys.exit(subprocess.run([WORK / "build/bin/added_field"], check=False).returncode)


if __name__ == "__main__":
    main()
