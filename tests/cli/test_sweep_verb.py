#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon sweep` of the bare program: it finds the Python package or says how to get it, and hands
on what it was given.

    test_sweep_verb.py ROOT TENON
"""

import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), pathlib.Path(sys.argv[2]).absolute()
STAND_IN = """import json, sys
def main(words):
    print(json.dumps(words))
    return 3
"""
PLAN = 'asset = "a.usda"\n[[vary]]\nscale = "bodyMass"\ngrid = [1, 2]\n'


class Sweep(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        self.put("plan.toml", PLAN)

    def put(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def python(self, *options):
        """A python3 that knows no package, or those of a folder."""
        command = shlex.join([sys.executable, *options])
        script = self.put("python", f'#!/bin/sh\nexec {command} "$@"\n')
        script.chmod(0o755)
        return str(script)

    def run_sweep(self, *words, python, **variables):
        environment = {**os.environ, "TENON_PYTHON": python, **variables}
        return subprocess.run([TENON, "sweep", *words], cwd=self.folder, env=environment,
                              capture_output=True, text=True, check=False)

    def test_without_the_package_it_says_how_to_get_it(self):
        for python in (self.python("-I", "-S"), "/no/such/python3"):
            done = self.run_sweep("plan.toml", python=python)
            self.assertEqual(done.returncode, 4, done)
            self.assertIn("pip install dist/tenon_usd-*.whl", done.stderr)
            done = self.run_sweep("plan.toml", "--json", python=python)
            self.assertEqual(done.returncode, 4)
            self.assertEqual(json.loads(done.stdout)["diagnostics"][0]["rule"], "python.missing")

    def test_a_package_in_the_working_directory_is_not_the_package(self):
        self.put("tenon_usd/__init__.py", "open('planted', 'w')")
        self.put("importlib/__init__.py", "open('planted', 'w')")
        done = self.run_sweep("plan.toml", python=self.python("-S"), PYTHONPATH="")
        self.assertEqual(done.returncode, 4, done)
        self.assertFalse((self.folder / "planted").exists())

    def test_words_and_exit_code_are_handed_on(self):
        self.put("site/tenon_usd/__init__.py", "")
        self.put("site/tenon_usd/sweep/__init__.py", "")
        self.put("site/tenon_usd/sweep/command.py", STAND_IN)
        done = self.run_sweep("plan.toml", "-j", "3", "--vary", "a=1..2", "--vary=/B.c=1,2",
                              "--merge", "-q", "--json", "-o", "a b",
                              python=self.python("-S"), PYTHONPATH=str(self.folder / "site"))
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(json.loads(done.stdout), [
            "--output=a b", "--jobs=3", "--vary=a=1..2", "--vary=/B.c=1,2", "--merge", "--json",
            "--quiet", "--", "plan.toml"])

    def sources(self):
        """A tenon_usd whose parts are those of the source tree, without what is compiled."""
        self.put("site/tenon_usd/__init__.py",
                 f"__path__.append({str(ROOT / 'python/tenon_usd')!r})\n")
        return str(self.folder / "site")

    def test_options_are_those_of_the_package(self):
        done = subprocess.run([TENON, "help", "--json"], capture_output=True, text=True, check=True)
        (verb,) = [verb for verb in json.loads(done.stdout)["verbs"] if verb["name"] == "sweep"]
        own = {name for option in verb["options"] for name in option["names"]
               if not option["positional"]}
        listing = ("import json; from tenon_usd.sweep.command import _parser; print(json.dumps("
                   "[name for action in _parser()._actions for name in action.option_strings]))")
        done = subprocess.run([sys.executable, "-c", listing], capture_output=True, text=True,
                              check=True, env={**os.environ, "PYTHONPATH": self.sources()})
        self.assertEqual(set(json.loads(done.stdout)) - {"-h", "--help"},
                         (own | {"--json", "-q", "--quiet"}) - {"-h", "--help"})

    def test_the_real_package_answers(self):
        done = self.run_sweep("plan.toml", "--list", python=sys.executable,
                              PYTHONPATH=self.sources())
        self.assertEqual((done.returncode, done.stdout),
                         (0, "case,bodyMass\n0,1.0\n1,2.0\n"), done.stderr)
        done = self.run_sweep("gone.toml", "--json", python=sys.executable,
                              PYTHONPATH=self.sources())
        self.assertEqual(done.returncode, 2)
        self.assertIn("gone.toml", json.loads(done.stdout)["error"])

    def test_output_that_cannot_go_anywhere_is_no_success(self):
        environment = {**os.environ, "TENON_PYTHON": sys.executable, "PYTHONPATH": self.sources()}
        for where in (">/dev/full", ">&-"):
            done = subprocess.run(["sh", "-c", f'"$0" sweep plan.toml --list {where}', TENON],
                                  cwd=self.folder, env=environment, capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 2, done)
            self.assertIn("error", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
