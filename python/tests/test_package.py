# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The package as a whole: what it loads, its texts, its neighbours in a process, the command."""

import inspect
import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import unittest

import support

import tenon_usd as tenon

PROGRAM = os.path.join(sysconfig.get_path("scripts"), "tenon")
# Results that are quantities.
NUMBERS = re.compile(r"NDArray|float\b|Array\b")


def run(code, **environment):
    """-> standard output of a process of its own."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True,
                          env={**os.environ, **environment})
    if done.returncode:
        raise AssertionError(done.stderr)
    return done.stdout


class Loading(unittest.TestCase):
    def test_the_import_loads_no_numpy(self):
        loaded = run("import sys, tenon_usd; print('numpy' in sys.modules)")
        self.assertEqual(loaded.strip(), "False")

    def test_nothing_of_the_library_is_seen_by_others(self):
        exported = subprocess.run(["nm", "-D", "--defined-only", tenon._tenon.__file__],
                                  capture_output=True, text=True).stdout.split("\n")
        names = [line.split()[-1] for line in exported if line]
        self.assertEqual([name for name in names if name.startswith("_ZN5tenon")], [])


class Command(unittest.TestCase):
    def test_the_command_is_the_program(self):
        done = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True)
        self.assertEqual(done.stdout.split(), ["tenon", tenon.__version__])
        done = subprocess.run([PROGRAM, "check", support.HAND], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([PROGRAM, "sim", support.GRASP, "--engine", "physx", "--duration",
                                   "0.02"], capture_output=True, text=True, cwd=folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_command_shows_assets_where_the_build_has_its_page(self):
        page = os.path.join(support.ROOT, "build/release/share/tenon/page")
        own = os.path.join(os.path.dirname(tenon.__file__), "share/tenon/page")
        if not os.path.exists(os.path.join(page, "report.html")):
            self.assertFalse(os.path.exists(own))
            self.skipTest("this build has no page: node and npm are missing")
        self.assertEqual(sorted(os.listdir(own)), sorted(os.listdir(page)))
        with tempfile.TemporaryDirectory() as folder:
            report = os.path.join(folder, "hand.html")
            done = subprocess.run([PROGRAM, "report", support.HAND, "-o", report],
                                  capture_output=True, text=True,
                                  env={**os.environ, "TENON_PAGE": ""})
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertGreater(os.path.getsize(report), 100_000)


def documented():
    """(name, object) of everything public: functions, classes, their methods and properties."""
    from tenon_usd import (
        actuators, draws, dynamics, errors, functions, log, observations, options, pages, recording,
        rendering, tables, text, world)
    from tenon_usd.tasks import task

    for module in (tenon, tenon._tenon, actuators, draws, dynamics, errors, functions, log,
                   observations, options, pages, recording, rendering, tables, task, text,
                   world):
        for name, one in vars(module).items():
            own = getattr(one, "__module__", "").startswith("tenon_usd") or (
                getattr(one, "__module__", "") == "_tenon")
            if name.startswith("_") or not own or not callable(one):
                continue
            yield f"{module.__name__}.{name}", one
            if inspect.isclass(one):
                for member, value in vars(one).items():
                    told = callable(value) or hasattr(value, "__get__")
                    if told and not member.startswith("_"):
                        yield f"{module.__name__}.{name}.{member}", value


class Texts(unittest.TestCase):
    # What World, Dynamics and the functions stand on; they say what it is.
    INSIDE = ("tenon_usd._tenon.Batch", "tenon_usd._tenon.PosedScene",
              "tenon_usd._tenon.OpenArguments")

    def test_every_public_name_has_a_text(self):
        count, bare = 0, []
        for name, one in documented():
            if name.startswith(self.INSIDE) or inspect.isbuiltin(one):
                continue
            if name.startswith("tenon_usd._tenon.") and not inspect.isclass(one) and (
                    name.count(".") == 2):
                continue  # functions that tenon_usd.functions wraps
            count += 1
            text = inspect.getdoc(one) or ""
            # The library's own begin with the signature.
            text = re.sub(r"^def .*\n?|^\w+\(.*\) -> .*\n?", "", text).strip()
            if len(text) < 8 or not text.rstrip(")").endswith((".", ":", "!")):
                bare.append(f"{name}: {text!r}")
        self.assertEqual(bare, [])
        self.assertGreater(count, 300)

    def test_arrays_tell_their_unit_or_what_they_count(self):
        from tenon_usd.dynamics import Dynamics
        from tenon_usd.world import World

        quiet = {"contact_counts"}  # how many
        for name, one in [*vars(World).items(), *vars(Dynamics).items()]:
            getter = one.fget if isinstance(one, property) else one
            result = str(getattr(getter, "__annotations__", {}).get("return", ""))
            if name.startswith("_") or not NUMBERS.search(result) or name in quiet:
                continue
            self.assertRegex(inspect.getdoc(one), r"\[[^\]]+\]", name)
            if "Array" in result:
                self.assertRegex(inspect.getdoc(one), r"\((envs|count|n|bodies|3|6)\b", name)


if __name__ == "__main__":
    support.main()
