#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Tests of skipped_tests.py, and of the list of tests that may skip."""

import unittest

import skipped_tests

MOST = 3  # tests in the list; lower it with the list

TESTS_LOG = """
2/4 Test  #63: cli.hand ....................***Skipped   0.13 sec

The following tests did not run:
\t 63 - cli.hand (Skipped)
\t 70 - Files.Birth (Skipped)
"""
LAST_LOG = """Start testing: Nov 28 08:06 UTC
----------------------------------------------------------
1/4 Testing: cli.hand
Output:
----------------------------------------------------------
skipped: /elsewhere/hand.usda does not exist
<end of output>
Test time =   0.13 sec
2/4 Testing: Files.Birth
Output:
----------------------------------------------------------
[ RUN      ] Files.Birth
/clone/files_test.cpp:237: Skipped
the file system keeps no times of birth
[  SKIPPED ] Files.Birth (0 ms)
<end of output>
3/4 Testing: structure.Hand
Output:
----------------------------------------------------------
ss
Ran 2 tests in 0.001s

OK (skipped=2)
<end of output>
4/4 Testing: structure.Other
Output:
----------------------------------------------------------
s.
Ran 2 tests in 0.001s

OK (skipped=1)
<end of output>
"""


class SkippedTests(unittest.TestCase):
    def test_each_is_named_with_its_reason(self):
        self.assertEqual(skipped_tests.skipped_tests(TESTS_LOG, LAST_LOG),
                         {"Files.Birth": "the file system keeps no times of birth",
                          "cli.hand": "/elsewhere/hand.usda does not exist",
                          "structure.Hand": "all 2 cases skipped"})

    def test_what_is_not_listed_is_told(self):
        found = skipped_tests.skipped_tests(TESTS_LOG, LAST_LOG)
        lines, others = skipped_tests.report(found, {"cli.hand": "not ours"})
        self.assertEqual(lines[0], "3 tests skipped, 2 not in tools/allowed_skips.txt")
        self.assertEqual(others, ["Files.Birth", "structure.Hand"])
        self.assertEqual(skipped_tests.report({}, {}), (["0 tests skipped"], []))

    def test_the_list_only_shrinks_and_gives_reasons(self):
        allowed = skipped_tests.allowed_skips(skipped_tests.read(skipped_tests.ALLOWED))
        self.assertTrue(all(allowed.values()), allowed)
        self.assertEqual(len(allowed), MOST, "lower MOST with the list; it never grows")


if __name__ == "__main__":
    unittest.main()
