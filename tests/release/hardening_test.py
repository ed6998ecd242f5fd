#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What hardening.py finds: nothing in a program built with all flags, each lack in one without."""

import os
import subprocess
import sys
import tempfile
import unittest

import hardening

SOURCE = """
#include <cstdio>
#include <cstring>
int main(int count, char** words) {
  char copy[64];
  std::strcpy(copy, words[count - 1]);
  return std::printf("%s", copy) < 0;
}
"""
ALL = ["-O2", "-fPIE", "-pie", "-fstack-protector-strong", "-U_FORTIFY_SOURCE",
       "-D_FORTIFY_SOURCE=2", "-Wl,-z,relro,-z,now,-z,noexecstack"]


def faults(*flags):
    with tempfile.TemporaryDirectory() as folder:
        source, program = os.path.join(folder, "a.cpp"), os.path.join(folder, "a")
        with open(source, "w", encoding="utf-8") as file:
            file.write(SOURCE)
        subprocess.run(["c++", source, "-o", program, *ALL, *flags], check=True,
                       capture_output=True)
        return hardening.faults_of(*[hardening.read_elf(program, what)
                                     for what in ("-h", "-l", "-d", "--dyn-syms")])


class Hardening(unittest.TestCase):
    def test_nothing_lacks_with_all_flags(self):
        self.assertEqual(faults(), [])

    def test_each_lack_is_named(self):
        for flags, word in ((["-no-pie", "-fno-pie"], "PIE"),
                            (["-Wl,-z,norelro"], "RELRO"),
                            (["-Wl,-z,lazy"], "BIND_NOW"),
                            (["-Wl,-z,execstack"], "GNU_STACK"),
                            (["-fno-stack-protector"], "stack protector"),
                            (["-U_FORTIFY_SOURCE"], "_FORTIFY_SOURCE")):
            found = faults(*flags)
            self.assertEqual(len(found), 1, (flags, found))
            self.assertIn(word, found[0])


if __name__ == "__main__":
    unittest.main()
