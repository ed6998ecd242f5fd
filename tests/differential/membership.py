# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares path expressions and collections with OpenUSD over random ones (seeded): which texts are
accepted, their canonical text, and the members of collections. Needs OpenUSD's Python modules.

usage: membership.py COLLECTION_DUMP RETEXT [SEED COUNT]

COLLECTION_DUMP and RETEXT are built from tests/tools. OpenUSD evaluates an expression in two ways,
path by path and by a search over the stage; where the two disagree its search is at fault (it
mixes up the states of patterns after a shortcut) and members are not compared. Nor are collections
that it crashes on.
"""

import os
import pickle
import random
import subprocess
import sys
import tempfile

try:
    from pxr import Sdf, Tf, Usd
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

import random_expressions

FAULTS_SHOWN = 8


class Report:
    def __init__(self):
        self.compared = 0
        self.skipped = 0
        self.differences = []

    def compare(self, what, expected, actual):
        self.compared += 1
        if expected != actual:
            self.differences.append(f"{what}\n  OpenUSD {expected}\n  tenon   {actual}")


def canonical(text):
    try:
        return Sdf.PathExpression(text).GetText()
    except Tf.ErrorException:
        return ""


def compare_texts(report, retext, rng, count, folder):
    """Expressions as values of time samples, where paths stay as they are."""
    texts = [random_expressions.expression(rng) for _ in range(count)]
    texts += [random_expressions.broken(rng, text) for text in texts]
    texts = [text for text in texts if all(" " <= c <= "~" for c in text)]
    source = os.path.join(folder, "texts.usda")
    with open(source, "w", encoding="utf-8") as out:
        out.write('#usda 1.0\ndef "A" {\n')
        for i, text in enumerate(texts):
            quoted = random_expressions.quoted(text)
            out.write(f"pathExpression e{i}.timeSamples = {{ 0: {quoted} }}\n")
        out.write("}\n")
    into = os.path.join(folder, "retext")
    os.mkdir(into)
    subprocess.run([retext, "--into", into, source], check=True, capture_output=True)
    written = Sdf.Layer.CreateAnonymous(".usda")
    with open(os.path.join(into, os.listdir(into)[0]), encoding="utf-8") as text:
        written.ImportFromString(text.read())
    for i, text in enumerate(texts):
        value = written.QueryTimeSample(f"/A.e{i}", 0)
        report.compare(f"text {text!r}", canonical(text), value.GetText())


def all_objects(stage):
    for prim in stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)):
        yield prim.GetPath()
        for prop in prim.GetProperties():
            yield prop.GetPath()


def expected_lines(path):
    """(what, prim, name) -> sorted paths; None for members that OpenUSD gets wrong itself."""
    stage = Usd.Stage.Open(path)
    result = {}
    objects = list(all_objects(stage))
    for prim in stage.Traverse(Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)):
        for api in Usd.CollectionAPI.GetAll(prim):
            key = (str(prim.GetPath()), api.GetName())
            try:
                query = api.ComputeMembershipQuery()
                contained = [str(p) for p in objects if query.IsPathIncluded(p)]
                members = [str(p) for p in api.ComputeIncludedPaths(query, stage)]
            except Tf.ErrorException:
                result[("contains",) + key] = None
                result[("members",) + key] = None
                continue
            result[("contains",) + key] = sorted(contained)
            by_path = stage_members(stage, query, api)
            faulty = not query.UsesPathExpansionRuleMap() and sorted(members) != by_path
            result[("members",) + key] = None if faulty else sorted(members)
    return result


def stage_members(stage, query, api):
    """What a search over the stage meets, asked path by path."""
    rule = api.GetExpansionRuleAttr().Get()
    found = []
    if rule == "explicitOnly":
        return found
    for prim in stage.Traverse():
        paths = [prim.GetPath()]
        if rule == "expandPrimsAndProperties":
            paths += [prop.GetPath() for prop in prim.GetProperties()]
        found += [str(p) for p in paths if query.IsPathIncluded(p)]
    return sorted(found)


def in_child(function, argument):
    """What the function returns, run in a process of its own; None when that crashes."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        with os.fdopen(writer, "wb") as out:
            pickle.dump(function(argument), out)
        os._exit(0)  # pylint: disable=protected-access
    os.close(writer)
    with os.fdopen(reader, "rb") as back:
        data = back.read()
    _, status = os.waitpid(child, 0)
    return pickle.loads(data) if status == 0 else None


def actual_lines(program, paths):
    run = subprocess.run([program] + paths, capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        sys.exit(f"{program} crashed:\n{run.stderr[-3000:]}")
    files = {}
    current = {}
    for line in run.stdout.splitlines():
        words = line.split(" ")
        if words[0] == "file":
            current = files.setdefault(words[1], {})
        else:
            current[tuple(words[:3])] = sorted(words[3:])
    return files


def compare_collections(report, program, seeds, folder):
    paths = {}
    for seed in seeds:
        path = os.path.join(folder, f"{seed}.usda")
        with open(path, "w", encoding="utf-8") as out:
            out.write(random_expressions.scene_text(seed))
        paths[seed] = path
    actual = actual_lines(program, list(paths.values()))
    for seed, path in paths.items():
        expected = in_child(expected_lines, path)
        if expected is None:
            report.skipped += len(actual[path])
            continue
        report.compare(f"collections of {seed}", sorted(expected), sorted(actual[path]))
        for key, value in expected.items():
            if value is None:
                report.skipped += 1
            else:
                report.compare(f"{seed}: {' '.join(key)}", value, actual[path].get(key))


def main():
    collection_dump, retext = sys.argv[1:3]
    seed, count = (int(a) for a in sys.argv[3:5]) if len(sys.argv) > 4 else (1, 150)
    report = Report()
    with tempfile.TemporaryDirectory() as folder:
        compare_texts(report, retext, random.Random(seed), 20 * count, folder)
        compare_collections(report, collection_dump, range(seed, seed + count), folder)
    for difference in report.differences[:FAULTS_SHOWN]:
        print(difference)
    print(
        f"{report.compared} compared, {len(report.differences)} different, "
        f"{report.skipped} left out as OpenUSD fails or contradicts itself"
    )
    return 1 if report.differences or report.compared < count else 0


if __name__ == "__main__":
    sys.exit(main())
