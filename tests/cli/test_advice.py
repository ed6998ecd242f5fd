#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What messages, fixes, help and the pages of rules tell people to type exists: every verb and
option that they name, of the verbs that can print it.

    test_advice.py ROOT TENON
"""

import json
import pathlib
import re
import subprocess
import sys
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
SOURCES = ("tenon", "cli", "worker")
TOKEN = re.compile(r"""//[^\n]*|/\*.*?\*/|'(?:[^'\\]|\\.)'|"((?:[^"\\\n]|\\.)*)\"""", re.DOTALL)
# What may stand between two literals of one sentence: nothing, or sums of values.
JOINT = re.compile(r"\s*(\+[^;{}\"]*?\+)?\s*\Z", re.DOTALL)
VERB = re.compile(r"\btenon ([a-z][a-z-]*)")
OPTION = re.compile(r"(?<![\w-])--[a-z][A-Za-z0-9-]*[a-z0-9]")
# A command ends where its sentence goes on.
END = re.compile(r"[;`)\n:]|, |  | (?:or|and|to|tells?|lists|names|says|has|shows|makes|unpacks) ")
# Words behind "tenon" that are not verbs but go on with the sentence.
PROSE = {"again", "for", "has", "in", "is", "journal", "knows", "printed", "scene", "state", "to",
         "was", "with", "does", "that", "itself", "brings", "tenon"}
# Options of programs that tenon starts.
OF_OTHERS = {"tenon/browser/browser_page.cpp", "tenon/browser/browser_process.cpp"}
# The verbs that can print what a folder or a file says; the longest name counts. Files of
# cli/verbs speak for their own verbs.
RUNS = ("bake", "record", "report", "sim")
PRINTED_BY = {
    "cli/verbs/author_verbs.cpp": (),
    "tenon/asset/authoring": ("add",),
    "tenon/asset/authoring/remove_edits.cpp": ("remove",),
    "tenon/asset/benchmarking": ("benchmark",),
    "tenon/asset/checking": ("check",),
    "tenon/asset/colliders": ("colliders",),
    "tenon/asset/comparing_engines": ("compare",),
    "tenon/asset/edit_asset.cpp": ("add", "set"),
    "tenon/asset/edit_file_choice.cpp": ("add", "set"),
    "tenon/asset/editing/edit_reason.cpp": ("set",),
    "tenon/asset/editing/engine_forms.cpp": ("set",),
    "tenon/asset/editing/stage_metadata.cpp": ("set",),
    "tenon/asset/layers/strip_asset.cpp": ("strip",),
    "tenon/asset/layers/select_variant.cpp": ("variant",),
    "tenon/asset/many_environments": ("bench",),
    "tenon/asset/converting/describe_asset.cpp": ("convert",),
    "tenon/asset/exporting": ("convert",),
    "tenon/asset/drives": ("drives",),
    "tenon/asset/pairs": ("pairs",),
    "tenon/asset/poses": ("pose",),
    "tenon/asset/simulating/simulate_asset.cpp": RUNS,
    "tenon/asset/tuning": ("tune",),
    "tenon/asset/updating": ("convert", "structure"),
    "tenon/sdf": ("convert",),
    "tenon/xacro": ("convert",),
    "tenon/asset/viewing/record_asset.cpp": ("record",),
    "tenon/bake/commands": ("sim",),
    "tenon/bake/record_outputs.cpp": ("sim",),
    "tenon/browser": ("record",),
    "tenon/convert": ("convert",),
    "tenon/dynamics": ("inertia",),
    "tenon/compose": ("info", "check", "sim", "tree", "cat", "set", "view", "convert"),
    "tenon/stage": ("info", "check", "sim", "tree", "cat", "set", "view", "convert"),
    "tenon/structure/make": ("structure",),
    "tenon/structure/write_folder.cpp": ("convert", "structure"),
    "tenon/structure/written_note.cpp": ("convert", "structure"),
    "tenon/urdf": ("convert",),
    "tenon/serve": ("view",),
    "cli/recording.cpp": ("record",),
    "cli/update.cpp": ("convert", "structure"),
}
# Options that fewer verbs of a row can be told of.
ALONE = {
    ("tenon/asset/simulating/simulate_asset.cpp", "--state-out"): ("sim",),
    ("tenon/structure/write_folder.cpp", "--in-place"): ("structure",),
}


def sentences(text):
    """-> (line, text) of each run of literals that makes one sentence, values of it as `_`."""
    found, end = [], None
    for match in TOKEN.finditer(text):
        if match.group(1) is None:
            continue
        between = text[end:match.start()] if end is not None else ";"
        words = match.group(1).replace('\\"', '"').replace("\\n", "\n")
        joint = JOINT.match(between)
        if joint:
            found[-1][1] += ("_" if joint.group(1) else "") + words
        else:
            found.append([text.count("\n", 0, match.start()) + 1, words])
        end = match.end()
    return found


def all_sentences():
    for folder in SOURCES:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".cpp", ".h", ".def") and not path.stem.endswith("_test") and \
                    "generated" not in path.parts:
                for line, words in sentences(path.read_text()):
                    yield path.relative_to(ROOT).as_posix(), line, words


def verbs_and_options():
    answer = json.loads(subprocess.run([TENON, "help", "--json"], check=True, capture_output=True,
                                       text=True).stdout)
    def names(rows):
        return {name for row in rows for name in row["names"]}
    shared = names(answer["options"]) | {"--help"}
    return {verb["name"]: shared | names(verb["options"]) |
            {name for inner in verb["verbs"] for name in names(inner["options"])}
            for verb in answer["verbs"]}


OPTIONS = verbs_and_options()
EVERY = set().union(*OPTIONS.values())


def printed_by(place):
    if place.startswith("cli/verbs/") and place not in PRINTED_BY:
        return (re.sub(r"_verb\.cpp$", "", place.removeprefix("cli/verbs/")).replace("_", "-"),)
    rows = [name for name in PRINTED_BY if place == name or place.startswith(name + "/")]
    return PRINTED_BY[max(rows, key=len)] if rows else ()


def commands(words):
    """-> (verb, the options of its command)."""
    for match in VERB.finditer(words):
        rest = words[match.end():]
        end = END.search(rest)
        yield match.group(1), OPTION.findall(rest[:end.start()] if end else rest)


def loose_options(words):
    """-> options outside of any command."""
    for match in VERB.finditer(words):
        rest = words[match.end():]
        end = END.search(rest)
        stop = match.end() + (end.start() if end else len(rest))
        words = words[:match.start()] + "#" * (stop - match.start()) + words[stop:]
    return OPTION.findall(words)


class Advice(unittest.TestCase):
    def test_sentences_are_read_from_sources(self):
        text = 'f("a " "b" + x() + " c", "d"); // "no"\ng(\'"\', "e");'
        self.assertEqual([words for _, words in sentences(text)], ["a b_ c", "d", "e"])

    def test_each_verb_that_is_named_exists(self):
        seen = set()
        for place, line, words in all_sentences():
            for verb, _ in commands(words):
                with self.subTest(f"{place}:{line}", words=words):
                    self.assertIn(verb, OPTIONS.keys() | PROSE)
                    seen.add(verb)
        self.assertGreater(len(seen & OPTIONS.keys()), 25)

    def test_each_option_of_a_command_is_one_of_its_verb(self):
        seen = 0
        for place, line, words in all_sentences():
            for verb, options in commands(words):
                for option in options if verb in OPTIONS else []:
                    seen += 1
                    with self.subTest(f"{place}:{line}", words=words, verb=verb):
                        self.assertIn(option, OPTIONS[verb])
        self.assertGreater(seen, 80)

    def test_each_other_option_is_one_of_the_verbs_that_print_it(self):
        held = 0
        for place, line, words in all_sentences():
            for option in loose_options(words) if place not in OF_OTHERS else []:
                with self.subTest(f"{place}:{line}", words=words):
                    self.assertIn(option, EVERY)
                    for verb in ALONE.get((place, option), printed_by(place)):
                        held += 1
                        if verb in OPTIONS:
                            self.assertIn(option, OPTIONS[verb], verb)
        self.assertGreater(held, 100)

    def test_pages_of_rules_name_what_exists(self):
        held = 0
        for page in sorted((ROOT / "docs/rules").glob("[a-z]*.md")):
            for code in re.findall(r"`([^`\n]+)`", page.read_text()):
                for verb, options in commands(code):
                    held += 1
                    with self.subTest(page.name, code=code):
                        self.assertIn(verb, OPTIONS)
                        self.assertLessEqual(set(options), OPTIONS[verb])
                self.assertLessEqual(set(loose_options(code)), EVERY, f"{page.name}: {code}")
        self.assertGreater(held, 5)

    def test_each_row_names_places_and_verbs_that_there_are(self):
        for place, verbs in PRINTED_BY.items():
            self.assertTrue((ROOT / place).exists(), place)
            self.assertLessEqual(set(verbs), OPTIONS.keys(), place)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
