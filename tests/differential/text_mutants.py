# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares what is accepted as text with OpenUSD, on layers that are nearly right: words of good
layers are left out, repeated, exchanged, or replaced by others. Both sides accept or reject alike,
and what both accept is written alike. Needs Python with OpenUSD's modules.

usage: text_mutants.py RETEXT [--count N] [--seed N] [--keep FOLDER]

RETEXT is built from tests/tools/retext.cpp. The layers come from mutant_seeds and, where it is,
the folder named by TENON_SHARED_DIR (default: ../shared). --keep leaves the mutants that differ.
Mutants that OpenUSD cannot be asked about (it stops, or takes a minute) are left out.
"""

import argparse
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
sys.path.insert(0, HERE)
import suite  # noqa: E402  pylint: disable=wrong-import-position
import mutant_seeds  # noqa: E402  pylint: disable=wrong-import-position

LARGEST_SEED = 8_000  # bytes
BATCH = 100
ORACLE_SECONDS = 60
WORDS = re.compile(
    r'"""[\s\S]*?"""|\'\'\'[\s\S]*?\'\'\'|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    r"|@@@[^\n]*?@@@|@[^@\n]*@|<[^>\n]*>|#[^\n]*|/\*[\s\S]*?\*/"
    r"|-?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[^\W\d]\w*|\n|[ \t]+|.")
ORACLE = """
import os, sys
os.environ["PXR_USDC_EMIT_DEPRECATION_WARNINGS"] = "0"
from pxr import Sdf
for path in sys.stdin.read().split("\\n"):
    try:
        layer = Sdf.Layer.OpenAsAnonymous(path)
        text = None if layer is None else layer.ExportToString()
    except Exception:
        text = None
    if text is not None:
        with open(path + ".expected", "w", encoding="utf-8") as file:
            file.write(text)
    open(path + ".asked", "w").close()
"""


def seed_texts():
    """Good layers, split into words."""
    texts = list(mutant_seeds.TEXTS)
    for folder in ("sdfparse", "tinyusdz", "mxpv"):
        for directory, _, names in sorted(os.walk(os.path.join(suite.CONFORMANCE, folder))):
            for name in sorted(names):
                path = os.path.join(directory, name)
                if (name.endswith(".usda") and "bad" not in name
                        and os.path.getsize(path) <= LARGEST_SEED):
                    with open(path, "rb") as file:
                        texts.append(file.read().decode("utf-8", "replace"))
    return [WORDS.findall(text) for text in texts]


def mutate(rng, words, vocabulary):
    """A copy with one or two changes behind the first line."""
    words = list(words)
    first = words.index("\n") + 1 if "\n" in words else 0
    for _ in range(rng.choice((1, 1, 1, 2))):
        if len(words) <= first + 1:
            break
        at = rng.randrange(first, len(words))
        change = rng.randrange(6)
        if change == 0:
            del words[at]
        elif change == 1:
            words.insert(at, words[at])
        elif change == 2:
            other = rng.randrange(first, len(words))
            words[at], words[other] = words[other], words[at]
        elif change == 3:
            words[at] = rng.choice(words[first:])
        elif change == 4:
            words[at] = rng.choice(vocabulary)
        else:
            words.insert(at, rng.choice(vocabulary))
    return "".join(words)


def ask_openusd(paths):
    """Leaves the text of each accepted path in PATH.expected, and PATH.asked."""
    left = list(paths)
    while left:
        try:
            subprocess.run([sys.executable, "-c", ORACLE], input="\n".join(left), text=True,
                           capture_output=True, check=False, timeout=ORACLE_SECONDS)
        except subprocess.TimeoutExpired:
            pass
        asked = [path for path in left if os.path.exists(path + ".asked")]
        left = left[len(asked) + 1:]  # the one after them stopped it


def read(path):
    if not os.path.exists(path):
        return None
    with open(path, "rb") as file:
        return file.read().decode("utf-8", "surrogateescape")


def first_difference(expected, actual):
    """The first lines that differ; None where OpenUSD only loses a path that is the value of
    unknown metadata (`x = `) or of an attribute (`int x </A>`, which nothing can read)."""
    for a, b in zip(expected.split("\n"), actual.split("\n")):
        lost = b.endswith(">") and (a.endswith(" = ") and b.startswith(a)
                                    or " ".join(a.split()) == b.strip().replace(" = <", " <"))
        if a != b and not lost:
            return f"expected {a[:120]!r}, actual {b[:120]!r}"
    return None if expected.count("\n") == actual.count("\n") else "one text ends early"


def compare(program, paths, folder):
    """Path -> what differs."""
    run = subprocess.run([program, "--into", folder] + paths, capture_output=True, text=True,
                         errors="replace", check=False)
    if run.returncode not in (0, 1):
        return {path: f"{program} ended with {run.returncode}: {run.stderr[-300:]}"
                for path in paths[:1]}
    ask_openusd(paths)
    found = {}
    for i, path in enumerate(paths):
        if not os.path.exists(path + ".asked"):
            continue
        expected, actual = read(path + ".expected"), read(os.path.join(folder, str(i)))
        if (expected is None) != (actual is None):
            found[path] = "OpenUSD rejects it" if expected is None else "OpenUSD accepts it"
        elif expected is not None:
            found[path] = first_difference(expected, actual)
    return {path: difference for path, difference in found.items() if difference}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=600)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep")
    arguments = parser.parse_args()
    if subprocess.run([sys.executable, "-c", "from pxr import Sdf"], capture_output=True,
                      check=False).returncode != 0:
        suite.skip("no OpenUSD modules in this Python")
    seeds = seed_texts()
    vocabulary = sorted({word for words in seeds for word in words if not word.isspace()
                         and len(word) < 40}) + list(mutant_seeds.VOCABULARY) * 20
    rng = random.Random(arguments.seed)
    results = suite.Results("text_mutants", os.path.join(HERE, "text_mutant_misses.txt"))
    whole = arguments.count == 600 and arguments.seed == 1
    for start in range(0, arguments.count, BATCH):
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for i in range(start, min(start + BATCH, arguments.count)):
                paths.append(os.path.join(folder, f"m{i}.usda"))
                with open(paths[-1], "w", encoding="utf-8", errors="replace") as file:
                    file.write(mutate(rng, rng.choice(seeds), vocabulary))
            found = compare(arguments.program, paths, folder)
            for path in paths:
                name = f"seed {arguments.seed} {os.path.basename(path)}"
                results.add("text mutants: accepted and written as by OpenUSD", name,
                            found.get(path))
                if arguments.keep and path in found:
                    os.makedirs(arguments.keep, exist_ok=True)
                    shutil.copy(path, arguments.keep)
    sys.exit(results.finish(is_whole=whole))


if __name__ == "__main__":
    main()
