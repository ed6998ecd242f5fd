#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The reference of the public headers, those that an installation has, as build/docs/html, with the
guide of docs/cpp in front.

Usage: make_reference.py [BUILD]    BUILD: a configured build, build/release unless given

Needs doxygen. Exit 0: made, without a warning; 1: what doxygen warned of; 77: no doxygen.
"""

import glob
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests/release"))
import installed

# Of doxygen itself, at a specialization of std::hash for a type of tenon.
OWN_FAULT = re.compile(r"Internal inconsistency: scope for class std::hash<")
OUTPUT = os.path.join(ROOT, "build/docs")
# Pages beyond docs/ that its pages lead to.
LINKED = ("README.md", "ARCHITECTURE.md", "CHANGELOG.md", "CONFORMANCE.md", "CONTRIBUTING.md",
          "SECURITY.md", "examples/vendor_hand/README.md")


def main():
    build = sys.argv[1] if len(sys.argv) > 1 else os.path.join(ROOT, "build/release")
    if not shutil.which("doxygen"):
        print("make_reference: doxygen is not installed: apt-get install doxygen")
        return 77
    if not os.path.exists(os.path.join(build, "cmake_install.cmake")):
        sys.exit(f"make_reference: {build} is not configured: run `make build`")
    with installed.install(build) as folder:
        headers = os.path.join(folder, "include")
        guide = os.path.join(ROOT, "docs/cpp")
        with open(os.path.join(guide, "Doxyfile"), encoding="utf-8") as file:
            settings = file.read()
        pages = sorted(glob.glob(os.path.join(ROOT, "docs/*.md")))
        pages.append(os.path.join(ROOT, "docs/rules"))
        pages += [os.path.join(ROOT, page) for page in LINKED]
        pages = [guide, os.path.join(ROOT, "examples/cpp/README.md"), headers, *pages]
        settings += ("INPUT = " + " ".join(f'"{page}"' for page in pages) + "\n"
                     f'USE_MDFILE_AS_MAINPAGE = "{guide}/README.md"\n'
                     f'STRIP_FROM_PATH = "{headers}" "{ROOT}"\n'
                     f'OUTPUT_DIRECTORY = "{OUTPUT}"\n')
        shutil.rmtree(OUTPUT, ignore_errors=True)
        os.makedirs(OUTPUT)
        done = subprocess.run(["doxygen", "-"], input=settings, cwd=ROOT, capture_output=True,
                              text=True, check=False)
        warnings = [line.replace(headers + "/", "") for line in done.stderr.split("\n")
                    if line.strip() and not OWN_FAULT.search(line)]
        count = sum(name.endswith(".h") for _, _, names in os.walk(headers) for name in names)
    for line in warnings:
        print(line)
    print(f"{count} headers, {len(warnings)} warnings: {os.path.relpath(OUTPUT, ROOT)}/html")
    return 1 if warnings or done.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
