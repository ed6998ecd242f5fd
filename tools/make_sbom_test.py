#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tools/make_sbom.py: what is installed is listed with its version, files with their sums."""

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import unittest

import make_sbom

SCRIPT = os.path.join(make_sbom.ROOT, "tools/make_sbom.py")


class Bills(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.install("mujoco")

    def install(self, name):
        os.makedirs(os.path.join(self.folder, "share/doc/tenon", name))

    def made(self):
        file, bill = (os.path.join(self.folder, name) for name in ("a.whl", "bill.json"))
        with open(file, "wb") as out:
            out.write(b"wheel")
        done = subprocess.run([sys.executable, "-B", SCRIPT, self.folder, bill, file],
                              capture_output=True, text=True, check=False)
        if done.returncode:
            return done.stderr
        with open(bill, encoding="utf-8") as made:
            return json.load(made)

    def test_libraries_and_files(self):
        os.makedirs(os.path.join(self.folder, "share/tenon/page"))
        bill = self.made()
        versions = {each["name"]: each["versionInfo"] for each in bill["packages"]}
        self.assertEqual(versions["tenon"], make_sbom.version_of_tenon())
        self.assertEqual(versions["mujoco"], make_sbom.pinned_versions()["mujoco"])
        self.assertRegex(versions["three"], r"^[0-9.]+$")
        (file,) = bill["files"]
        self.assertEqual(file["checksums"][0]["checksumValue"],
                         hashlib.sha256(b"wheel").hexdigest())
        known = {each["SPDXID"] for each in [bill, *bill["packages"], *bill["files"]]}
        for relation in bill["relationships"]:
            self.assertLessEqual({relation["spdxElementId"], relation["relatedSpdxElement"]}, known)
        self.assertEqual(self.made(), bill)

    def test_a_library_without_a_version_ends_it(self):
        self.install("no-such-library")
        self.assertIn("no-such-library", self.made())


if __name__ == "__main__":
    unittest.main()
