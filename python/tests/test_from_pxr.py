# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""docs/python-from-pxr.md: both snippets of every task give the same, and what the page says.

Each snippet runs in a folder of its own, behind the first one of its side, which opens the stage.
What its last line gives is its result. The comment behind the one of tenon_usd is that result, too:
where there is no pxr, it is what tenon_usd is held to.
"""

import ast
import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest
import warnings
from pathlib import Path

import support

import tenon_usd

PAGE = support.ROOT / "docs/python-from-pxr.md"
TASK = re.compile(r"^## (\d+)\. (.+)$", re.M)
FENCE = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)
SIDES = ("pxr", "tenon_usd")
TASKS = 30  # that the page has at least
HAS_PXR = importlib.util.find_spec("pxr") is not None
TENON = Path(tenon_usd.__file__).parent / "bin/tenon"


def plain(value):
    """Texts, numbers, lists and dictionaries, whichever library the value is of."""
    if isinstance(value, (bool, int, float, str)) or value is None:
        return value
    if isinstance(value, dict):
        return {str(key): plain(one) for key, one in value.items()}
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "pathString"):  # Sdf.Path
        return value.pathString
    return [plain(one) for one in value]


def alike(first, second):
    """The same to six digits, as floats have."""
    if isinstance(first, dict) and isinstance(second, dict):
        return first.keys() == second.keys() and all(alike(first[k], second[k]) for k in first)
    if isinstance(first, list) and isinstance(second, list):
        return len(first) == len(second) and all(map(alike, first, second))
    if isinstance(first, bool) or isinstance(second, bool):
        return first is second
    if isinstance(first, (int, float)) and isinstance(second, (int, float)):
        return abs(first - second) <= 1e-6 * max(abs(first), abs(second)) + 1e-12
    return type(first) is type(second) and first == second


def says_nothing(value):
    """A result that would be the same if both sides did nothing."""
    return value is None or value in ([], {}, "")


def result_of(code, names):
    """Runs a snippet; -> what its last line gives."""
    parsed = ast.parse(code)
    last = parsed.body.pop()
    if not isinstance(last, ast.Expr):
        raise AssertionError(f"the last line gives nothing:\n{code}")
    exec(compile(parsed, "<snippet>", "exec"), names)
    return plain(eval(compile(ast.Expression(last.value), "<snippet>", "eval"), names))


def recorded(code):
    """The result that the comment at the end says."""
    last = code.rstrip().splitlines()[-1]
    if not last.startswith("# "):
        raise AssertionError(f"there is no result at the end of:\n{code}")
    return plain(ast.literal_eval(last[2:]))


class Task:
    """A section of the page: a snippet of each side, and commands before that of tenon_usd."""

    def __init__(self, number, title, text):
        self.number, self.title = int(number), title
        self.snippets, self.commands = {}, []
        for language, code in FENCE.findall(text):
            if language == "sh":
                self.commands += code.splitlines()
                continue
            side = code.splitlines()[0].removeprefix("# ")
            if language != "python" or side not in SIDES or side in self.snippets:
                raise AssertionError(f"{title}: a snippet begins with # pxr or # tenon_usd, once")
            self.snippets[side] = code
        if set(self.snippets) != set(SIDES):
            raise AssertionError(f"{title}: there are snippets of {sorted(self.snippets)} alone")


def tasks_of(text):
    heads = list(TASK.finditer(text))
    ends = [head.start() for head in heads[1:]] + [text.find("\n## What", heads[-1].end())]
    return [Task(head[1], head[2], text[head.end():end]) for head, end in zip(heads, ends)]


class Page(support.FilesTestCase):
    def setUp(self):
        super().setUp()
        self.tasks = tasks_of(PAGE.read_text())
        self.addCleanup(os.chdir, os.getcwd())

    def run_side(self, task, side):
        """The result of a side in a new folder with the examples."""
        folder = self.folder / f"{task.number}-{side}"
        for name, source in (("hand", support.HAND.parent), ("scenes", support.SCENES)):
            shutil.copytree(source, folder / name, ignore=shutil.ignore_patterns("*.py"))
        os.chdir(folder)
        names = {}
        opened = result_of(self.tasks[0].snippets[side], names)
        if task.number == 1:
            return opened
        if side == "tenon_usd":
            for command in task.commands:
                self.run_command(command)
        return result_of(task.snippets[side], names)

    def run_command(self, command):
        program, *arguments = shlex.split(command)
        self.assertEqual(program, "tenon")
        done = subprocess.run([TENON, *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_page_has_what_it_says(self):
        self.assertGreaterEqual(len(self.tasks), TASKS)
        self.assertEqual([task.number for task in self.tasks], list(range(1, len(self.tasks) + 1)))

    def test_tenon_gives_what_the_page_says(self):
        for task in self.tasks:
            with self.subTest(task.title), warnings.catch_warnings():
                warnings.simplefilter("error")
                wanted = recorded(task.snippets["tenon_usd"])
                given = self.run_side(task, "tenon_usd")
                self.assertFalse(says_nothing(wanted), wanted)
                self.assertTrue(alike(given, wanted), f"{given} is not {wanted}")

    @unittest.skipUnless(HAS_PXR, "there is no pxr here (python/tests/requirements.txt)")
    def test_pxr_gives_the_same(self):
        for task in self.tasks:
            with self.subTest(task.title):
                wanted = recorded(task.snippets["tenon_usd"])
                given = self.run_side(task, "pxr")
                self.assertTrue(alike(given, wanted), f"{given} is not {wanted}")


class Comparison(unittest.TestCase):
    """The comparison finds what differs."""

    def test_numbers(self):
        self.assertTrue(alike([0.1, 2], [0.10000000149, 2.0]))
        for other in ([0.1], [0.10001, 2], ["0.1", 2], 0.1):
            self.assertFalse(alike([0.1, 2], other), other)
        self.assertFalse(alike(True, 1))
        self.assertFalse(alike({"a": 1}, {"b": 1}))

    def test_snippets_without_a_result(self):
        with self.assertRaises(AssertionError):
            result_of("a = 1\n", {})
        with self.assertRaises(AssertionError):
            recorded("1 + 1\n")


if __name__ == "__main__":
    if not HAS_PXR:
        print("pxr is not here: its half of the page is not run", file=sys.stderr)
    support.main()
