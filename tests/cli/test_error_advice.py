#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The advice of errors, warnings and notes of all verbs, typed as it is printed: the error is gone.

    test_error_advice.py ROOT TENON

Each sentence of the sources that names a command or an option, and is no help, is in one of two
tables: error_advice.txt says what provokes it and what is typed then; error_advice_by_hand.txt
names those that no script provokes, with the reason, and may only shrink. What rules of
`tenon check` advise is typed by tests/check/test_advice_typed.py.
"""

import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

import test_advice
from test_advice import OPTION, OPTIONS, ROOT, TENON, VERB

HERE = ROOT / "tests/cli"
PLANTED = HERE / "error_advice"
TYPED, BY_HAND = HERE / "error_advice.txt", HERE / "error_advice_by_hand.txt"
BY_HAND_AT_MOST = 20
# What a sentence of the help is an argument of.
OF_HELP = re.compile(r"add_option|add_flag|\.option\(|description\(|footer\(|\.choice\(")
# Where a printed command ends and its sentence goes on.
PRINTED_END = re.compile(r"[;`)\n]|, | \[|  | (?:or|and|to|tells?|lists|says|has|shows|unpacks) |$")
OF_MESSAGE = re.compile(r"Error\(ErrorCode::\w+,\s*$")
# Files whose sentences tell what there is, and advise nothing.
NO_ADVICE = ("cli/text/completion.cpp", "cli/program.cpp", "tenon/live/requests.cpp",
             "tenon/live/messages.cpp", "tenon/live/shapes.h", "tenon/live/panel_requests.cpp",
             "tenon/live/identify_requests.cpp",
             "tenon/check/rules.cpp", "tenon/asset/authoring/kinds.cpp",
             "tenon/settings/settings_keys.cpp",
             "cli/text/settings_text.cpp")


def sources():
    """-> (place, text) of the files that print advice."""
    for folder in test_advice.SOURCES:
        for path in sorted((ROOT / folder).rglob("*")):
            place = path.relative_to(ROOT).as_posix()
            left_out = place in NO_ADVICE or place in test_advice.OF_OTHERS or \
                place.startswith("tenon/check/") or "generated" in path.parts
            if path.suffix in (".cpp", ".h", ".def") and not path.stem.endswith("_test") and \
                    not left_out:
                yield place, path.read_text()


def is_advice(words, call):
    """`call` is the statement of the source up to the sentence."""
    if OF_MESSAGE.search(call) or words == "check --fix":  # the latter is what tenon undo names
        return False
    is_sentence = " " in words.strip() and "\n" not in words and not words[0].isupper() and \
        not words.startswith("--")
    return "with_fix(" in call or (is_sentence and not OF_HELP.search(call))


def advice():
    """-> (place, sentence) of all that errors, warnings and notes advise."""
    for place, text in sources():
        starts = [match.start() for match in re.finditer(r"^", text, re.MULTILINE)]
        for line, words in test_advice.sentences(text):
            named = any(verb in OPTIONS for verb, _ in test_advice.commands(words))
            if not named and not test_advice.loose_options(words):
                continue
            begin = re.split(r'["_\n]', words)[0][:30]
            at = text.index('"' + begin, starts[line - 1])
            call = text[max(text.rfind(end, 0, at) for end in ";{}") + 1:at]
            if is_advice(words, call):
                yield place, words


def rows(path, columns):
    """-> [place, words, ...] of each row of a table."""
    found = []
    for line in path.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            row = [part.strip() for part in line.split("|", columns - 1)]
            assert len(row) == columns and all(row), line
            found.append(row)
    return found


def covers(row, place, sentence):
    return row[1] in sentence and place.endswith(row[0])


class Typed(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_in(self, folder, command):
        """-> (words, exit code, all that it printed); `$` is the folder."""
        words = shlex.split(command.replace("$", str(folder)))
        if words[0] == "python":
            exec(words[1], {"folder": folder, "ROOT": ROOT})  # of the table, which is ours
            return words, 0, ""
        process = subprocess.run([TENON, *words], cwd=folder, capture_output=True, text=True,
                                 timeout=120)
        return words, process.returncode, process.stdout + process.stderr

    def filled(self, command, provoked, printed):
        """The command, with {tenon VERB} as the printed one and {--option} as its printed value."""
        def printed_command(match):
            self.assertIn(match.group(1), printed)
            rest = printed[printed.index(match.group(1)) + len("tenon "):]
            rest = rest[:PRINTED_END.search(rest).start()]
            return rest.replace("ASSET", shlex.quote(provoked[1]))
        def printed_value(match):
            option = match.group(1)
            self.assertIn(option + " ", printed)
            rest = printed[printed.index(option + " ") + len(option) + 1:]
            value = shlex.split(re.split(r"[;,] | \[", rest)[0])[0]
            return f"{option} {shlex.quote(value)}"
        command = re.sub(r"\{(tenon [^}]+)\}", printed_command, command)
        return re.sub(r"\{(--[a-z-]+)\}", printed_value, command)

    def check_typed(self, told, commands):
        """Something that the advice names is typed, or no longer typed where it says so."""
        words = [word for command in commands
                 for word in shlex.split(re.sub(r"^\d:", "", command))]
        out = set(re.findall(r"(?:leave|remove) (--[a-z-]+)", told))
        names = set(OPTION.findall(told)) | set(VERB.findall(told))
        typed = {word.split("=")[0] for word in words} & (names - out)
        self.assertTrue(typed or (out and not out & set(words)), f"{names}: {commands}")

    def follow(self, words, provoke, typed):
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.folder)) / "a folder"
        shutil.copytree(PLANTED, folder)
        shutil.copy(folder / "robot.urdf", folder / "my robot.urdf")  # to be quoted where typed
        *before, last = [command.strip() for command in provoke.split(";;")]
        for command in before:
            _, code, printed = self.run_in(folder, command)
            self.assertIn(code, (0, 1), f"{command}: {printed}")
        provoked, _, printed = self.run_in(folder, last)
        if provoked[0] == "record" and "[browser.missing]" in printed and words not in printed:
            self.skipTest("record asks for Chromium first, and there is none")
        if "[xacro.missing]" in printed or "[xacro.sandbox]" in printed:
            self.skipTest("xacro is not installed, or the kernel cannot confine it")
        self.assertIn(words, printed)
        told = next(line for line in printed.splitlines() if words in line)
        told = told[told.index(words):] if told.index(words) == 0 else told
        commands = [self.filled(command.strip(), provoked, told) if command.strip() != "AGAIN"
                    else last for command in typed.split(";;")]
        self.check_typed(told, commands)
        for command in commands:
            expected, command = re.match(r"(?:(\d):)?(.*)", command, re.DOTALL).groups()
            _, code, printed = self.run_in(folder, command)
            self.assertEqual(code, int(expected or 0), f"{command}: {printed}")
        self.assertNotIn(words, printed, commands[-1])

    def test_each_advice_is_in_a_table(self):
        typed, by_hand = rows(TYPED, 4), rows(BY_HAND, 3)
        self.assertLessEqual(len(by_hand), BY_HAND_AT_MOST)
        seen = 0
        used = set()
        for place, sentence in advice():
            seen += 1
            with self.subTest(place, sentence=sentence):
                found = [tuple(row[:2]) for row in typed + by_hand if covers(row, place, sentence)]
                self.assertTrue(found, "in no table")
                used.update(found)
        self.assertGreater(seen, 100)
        for row in typed + by_hand:
            with self.subTest(row=row):
                self.assertIn(tuple(row[:2]), used, "the sources have no such advice")

    def test_typed_advice_works(self):
        for _, words, provoke, typed in rows(TYPED, 4):
            with self.subTest(words, provoke=provoke):
                self.follow(words, provoke, typed)


if __name__ == "__main__":
    unittest.main(argv=["test_error_advice.py"])
