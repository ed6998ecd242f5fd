#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Holds the dependency rule of tenon/folders.txt over every #include line of tenon/, that a source
file includes its own header first, which proves that the header stands alone, and that above
tenon/bytes files are asked for through bytes::Files, never from the disk itself.

Usage: check_folders.py [ROOT]. Exit 0: the rule holds; 1: each breach on a line of its own.
"""

import fnmatch
import os
import re
import sys

import source_files

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
USERS = ("cli/", "worker/", "tests/", "bench/", "fuzz/")
BELOW_FILES = ("base", "bytes")
# For programs outside: it may include all, and nothing inside includes it.
SHORT_PATH = "tenon/tenon.h"

# Libraries that only some files may name: pattern of the include -> patterns of the files.
SYSTEM = ["tenon/base/*", "tenon/bytes/*", "tenon/guard/*", "worker/*", "cli/*", "tests/*",
          "bench/*", "fuzz/*", "*_test.cpp", "tenon/serve/test_socket.h"]
LIBRARIES = {
    # The operating system: files, memory and libraries up to `bytes`, processes in `guard`.
    **dict.fromkeys(["sys/*", "unistd.h", "fcntl.h", "dlfcn.h", "spawn.h", "poll.h", "sched.h",
                     "signal.h", "pthread.h", "malloc.h", "termios.h", "dirent.h", "execinfo.h"],
                    SYSTEM),
    "Eigen/*": ["tenon/math/*.cpp", "tenon/dynamics/*.cpp", "tenon/dynamics/constraints.h",
                "tenon/dynamics/least_energy.h", "tenon/dynamics/loop_closure.h"],
    "boost/*": ["tenon/serve/hub.h", "tenon/serve/*.cpp"],
    "fast_float/*": ["tenon/base/text/number_from_text.h"],
    "meshoptimizer.h": ["tenon/approximate/*.cpp"],
    "lz4*.h": ["tenon/bytes/*.cpp"],
    "zlib.h": ["tenon/bytes/gzip.cpp"],
    "mujoco/*": [
        "tenon/engines/mujoco/mujoco_library.h",
        "tenon/engines/mujoco/set_up/*_test.cpp",
        "bench/step_mujoco.cpp",
    ],
    "pugixml.hpp": ["tenon/asset/mjcf_files.cpp", "tenon/asset/converting/model_text.h",
                    "tenon/urdf/*", "tenon/sdf/*"],
    "toml++/*": ["tenon/settings/toml_table.cpp"],
    "assimp/*": ["tenon/mesh/assimp_scene.cpp"],
    "CLI/*": ["cli/command_line.cpp"],
    "nlohmann/*": ["tenon/answers/*", "tenon/browser/*.cpp", "tenon/glb/*.cpp",
                   "tenon/glb/glb_buffer.h", "tests/*", "bench/*"],
}

# What asks the disk whatever files were handed over. Of std::filesystem only paths do not, and
# Files() and AssetResolver() without arguments are the disk.
DISK = re.compile(
    r"\bFileBytes::open\b|(?<!~)\b(?:Files|AssetResolver)(?:\(\)|\{\})|\b[io]?fstream\b"
    r"|\b(?:fopen|freopen|opendir)\(|\busing namespace std::filesystem\b"
    r"|\b(?:fs|filesystem)::(?!path\b)\w+")
IGNORED = re.compile(r'//.*|\bfopen\("/dev/null"|(?<!#include )"(?:[^"\\]|\\.)*"')
# Who does, and why. One that does not any more is a fault, too.
DISK_USERS = {
    "tenon/approximate/piece_cache.cpp": "keeps a cache of its own",
    "tenon/asset/layers/output_place.cpp": "looks at what is to be written to",
    "tenon/asset/viewing/page_place.cpp": "finds the page, which is a part of the program",
    "tenon/formats/open_layer.cpp": "opens layers of the disk for tools",
    "tenon/guard/worker_place.cpp": "finds the worker's program",
    "tenon/guard/workers.cpp": "tells the worker where files lie",
    "tenon/mjcf/read_mjcf.cpp": "runs in the worker",
    "tenon/mjcf/keep_source.cpp": "runs in the worker",
    "tenon/mjcf/shapes/textures.cpp": "runs in the worker",
    "tenon/asset/updating/base_copy.cpp": "looks at what is to be written over",
    "tenon/asset/updating/update_asset.cpp": "looks at what is to be written over",
    "tenon/settings/settings.cpp": "tells a link to nothing, which Files cannot, from nothing",
    "tenon/structure/write_folder.cpp": "writes",
    "tenon/structure/written_note.cpp": "looks at what is to be written over",
}


def read_rule(path):
    """-> ({folder: allowed folders}, {folder: what its tests may add}, [faults])"""
    folders, tests, faults = {}, {}, []
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            line = line.split("#")[0].strip()
            if not line:
                continue
            key, _, rest = line.partition(":")
            words = key.split()
            table = tests if words[1:] == ["tests"] else folders
            for used in rest.split():
                if used not in folders:
                    faults.append(f"{path}:{number}: `{used}` must stand above `{words[0]}`")
            table[words[0]] = set(rest.split())
    return folders, tests, faults


def folder_of(path, folders):
    """tenon/engines/mujoco/step.h -> engines/mujoco; tenon/open_stage.h -> tenon; else None."""
    parts = path.split("/")[1:-1]
    if not parts:
        return "tenon"
    while parts:
        name = "/".join(parts)
        if name in folders:
            return name
        parts.pop()
    return None


def library_breach(path, target):
    for pattern, users in LIBRARIES.items():
        if fnmatch.fnmatch(target, pattern):
            if not any(fnmatch.fnmatch(path, user) for user in users):
                return f"<{target}> is reserved for {', '.join(users)}"
    return None


def is_of_tests(path):
    """A test, or a header for tests: test_*.h."""
    return path.endswith("_test.cpp") or os.path.basename(path).startswith("test_")


def folder_breach(path, quote, target, folders, tests):
    """Why `path`, a file under tenon/, may not include `target`; None where it may."""
    if target.startswith(USERS):
        return f"nothing in tenon/ may include {target.split('/')[0]}/"
    if not target.startswith("tenon/"):
        return f'write the include from the root: "tenon/.../{target}"' if quote == '"' else None
    if target == SHORT_PATH:
        return "tenon.h is for programs outside: include the headers that it names"
    if path == SHORT_PATH:
        return None
    own = folder_of(path, folders)
    other = folder_of(target, folders)
    allowed = {own} | folders[own]
    if is_of_tests(path):
        allowed |= tests.get(own, set())
    elif is_of_tests(target):
        return "only tests may include what is for tests"
    if other not in allowed:
        return f"`{own}` may not include `{other}` (tenon/folders.txt)"
    return None


def own_header(root, path):
    """The header that x.cpp has to include first: x.h beside it; None without one."""
    header = re.sub(r"\.cpp$", ".h", path)
    there = header != path and os.path.exists(os.path.join(root, header))
    return header if there else None


def asks_disk(root, path):
    """-> [(line number, what)] of a file above tenon/bytes that is no test."""
    if not path.startswith("tenon/") or is_of_tests(path) or path.split("/")[1] in BELOW_FILES:
        return []
    with open(os.path.join(root, path), encoding="utf-8") as file:
        return [(number, found[0]) for number, line in enumerate(file, 1)
                if (found := DISK.search(IGNORED.sub("", line)))]


def disk_faults(root, files):
    found = {path: asks_disk(root, path) for path in files}
    for path, places in found.items():
        if path in DISK_USERS and not places:
            yield f"tools/check_folders.py:1: {path} does not ask the disk: leave DISK_USERS"
        for number, what in places if path not in DISK_USERS else []:
            yield (f"{path}:{number}: `{what}` asks the disk: read through the bytes::Files of "
                   "the options, the resolver or the policy")


def check_file(root, path, folders, tests):
    in_library = path.startswith("tenon/")
    if in_library and folder_of(path, folders) is None:
        yield f"{path}:1: the folder is not listed in tenon/folders.txt"
        return
    header = own_header(root, path)
    with open(os.path.join(root, path), encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            quote, target = match.groups()
            if header and target != header:
                yield f"{path}:{number}: {header} is included first, so that it stands alone"
            header = None
            reason = library_breach(path, target)
            if not reason and in_library:
                reason = folder_breach(path, quote, target, folders, tests)
            if reason:
                yield f"{path}:{number}: {reason}"


def check(root):
    folders, tests, faults = read_rule(os.path.join(root, "tenon/folders.txt"))
    places = ("tenon/",) + USERS
    files = [
        path
        for path in source_files.project_files(root)
        if path.startswith(places) and path.endswith(source_files.CODE)
    ]
    for path in files:
        faults.extend(check_file(root, path, folders, tests))
    faults.extend(disk_faults(root, files))
    return files, faults


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else source_files.ROOT
    files, faults = check(root)
    for fault in faults:
        print(fault)
    print(f"{len(files)} files, {len(faults)} breaches of the dependency rule")
    return 1 if faults or not files else 0


if __name__ == "__main__":
    sys.exit(main())
