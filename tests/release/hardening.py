#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Reads the ELF of every installed program: cmake/hardening.cmake has had its effect.

usage: hardening.py BUILD_OF_THE_PRESET_RELEASE. Exit 0: hardened; 1: what lacks; 77: not built.
"""

import os
import re
import subprocess
import sys

import installed


def read_elf(path, *what):
    done = subprocess.run(["readelf", "-W", *what, path], capture_output=True, text=True,
                          check=True, env={**os.environ, "LC_ALL": "C"})
    return done.stdout


def faults_of(header, segments, dynamic, symbols):
    """What an ELF lacks, by what readelf prints of it."""
    names = set(re.findall(r"\b(__\w+_chk|__stack_chk_fail)\b", symbols))
    stack = re.search(r"^\s*GNU_STACK\s.*\s(RWE|RW|R E|R|E)\s+0x", segments, re.M)
    checks = [
        (re.search(r"Type:\s+DYN", header) and re.search(r"FLAGS_1.*\bPIE\b", dynamic),
         "it is no position-independent program (PIE)"),
        ("GNU_RELRO" in segments, "its relocations stay writable (RELRO)"),
        (re.search(r"\(FLAGS\).*BIND_NOW", dynamic) or re.search(r"FLAGS_1.*\bNOW\b", dynamic),
         "its functions are bound when they are first called (BIND_NOW)"),
        (stack and "E" not in stack[1], "its stack can run code (GNU_STACK)"),
        ("__stack_chk_fail" in names, "no function of it has a stack protector"),
        (names - {"__stack_chk_fail"}, "no call of it is a checked one (_FORTIFY_SOURCE)"),
    ]
    return [words for good, words in checks if not good]


def main():
    build = installed.release_build()
    faults = 0
    with installed.install(build) as prefix:
        found = installed.programs(prefix)
        for path in found:
            parts = [read_elf(path, what) for what in ("-h", "-l", "-d", "--dyn-syms")]
            for fault in faults_of(*parts):
                print(f"{os.path.relpath(path, prefix)}: {fault}; see cmake/hardening.cmake")
                faults += 1
    print(f"{len(found)} programs, {faults} faults")
    return 1 if faults or not found else 0


if __name__ == "__main__":
    sys.exit(main())
