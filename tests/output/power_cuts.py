#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every state that a power cut may leave of every verb that writes: old files or new ones.

    power_cuts.py ROOT TENON [--verbs A,B] [--recoveries N] [--seed N]

The system calls of a verb are recorded by strace and replayed on a model of a disk: names of a
folder last once the folder is synced, contents once the file is; of what came after, anything may
be there or be lost, and a file that is not synced is cut in the middle. Each state that is neither
old nor new needs a journal: it is made in a folder, the next edit there is run, and then all files
are old or new. Of many such states, N are drawn for each verb. Exit 77: no strace.
"""

import argparse
import itertools
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

from program import EDITS, TENON, WRITING, make_inputs, snapshot, verbs

CALLS = ("open,openat,creat,close,dup,dup2,dup3,fcntl,write,pwrite64,ftruncate,fsync,fdatasync,"
         "rename,renameat,renameat2,link,linkat,unlink,unlinkat,mkdir,mkdirat,rmdir,clone,clone3,"
         "fork,vfork,chdir")
LINE = re.compile(r"^(\d+) +(\w+)\((.*)\) += (-?\d+|\?)")
UNFINISHED = re.compile(r"^(\d+) +(.*) <unfinished \.\.\.>$")
RESUMED = re.compile(r"^(\d+) +<\.\.\. \w+ resumed>(.*)$")
CLONE = re.compile(r"\d+ +(clone3?|v?fork)\(")
TEXT = re.compile(r'"((?:\\x[0-9a-f]{2})*)"')
JOURNAL = ".tenon-journal"
MOST_PENDING = 7  # all subsets of that many; of more, some
# Commands that need others to be run before: these, and the one that is recorded.
PREPARED = [
    ([["set", "scene.usda", "/World/box.size=1", "/World/box.physics:rigidBodyEnabled=0"]],
     ["undo", "scene.usda"]),
    ([["convert", "arm.urdf", "out"]], ["convert", "arm2.urdf", "out", "--update"]),
    ([["structure", "base.usda", "-o", "out"], ["set", "base.usda", "/World/box.size=1"]],
     ["structure", "base.usda", "-o", "out", "--update"]),
    ([["zip", "scene.usda", "-o", "out.usdz"]], ["zip", "out.usdz", "--extract", "out"]),
]


class Failure(Exception):
    pass


class Node:
    """A file or a folder of the model: contents now and on the disk."""

    def __init__(self, is_folder):
        self.is_folder = is_folder
        self.data, self.durable = b"", b""
        self.names, self.durable_names = {}, {}

    def is_synced(self):
        return self.data == self.durable


class Change:
    """One step on names: what it sets and takes away, of which folders."""

    def __init__(self, sets, removes):
        self.sets, self.removes = sets, removes

    def folders(self):
        return {folder for folder, *_ in (*self.sets, *self.removes)}

    def apply(self, names_of):
        for folder, name in self.removes:
            names_of(folder).pop(name, None)
        for folder, name, node in self.sets:
            names_of(folder)[name] = node


class Disk:
    """A folder of files, what has happened to it and what of that is on the disk."""

    def __init__(self, root, syncs_folders=True):
        self.root = Node(True)
        self.pending = []
        self.syncs_folders = syncs_folders
        for path in sorted(root.rglob("*")):
            node = Node(path.is_dir())
            folder = self.find(path.parent.relative_to(root).parts)
            if path.is_file():
                node.data = node.durable = path.read_bytes()
            folder.names[path.name] = folder.durable_names[path.name] = node

    def find(self, parts):
        node = self.root
        for part in parts:
            node = node.names.get(part) if node and node.is_folder else None
        return node

    def change(self, sets=(), removes=()):
        step = Change(list(sets), list(removes))
        step.apply(lambda folder: folder.names)
        self.pending.append(step)

    def sync(self, node):
        if not node.is_folder:
            node.durable = node.data
            return
        if not self.syncs_folders:
            return
        for step in [step for step in self.pending if node in step.folders()]:
            step.apply(lambda folder: folder.durable_names)
            self.pending.remove(step)

    def states(self, chance):
        """Trees that may be found after a power cut now: {path: contents}."""
        count = len(self.pending)
        if count <= MOST_PENDING:
            kept = itertools.product((False, True), repeat=count)
        else:
            kept = [[i < n for i in range(count)] for n in range(count + 1)]
            kept += [[i != n for i in range(count)] for n in range(count)]
            kept += [[i == n for i in range(count)] for n in range(count)]
            kept += [[chance.random() < 0.5 for _ in range(count)] for _ in range(60)]
        for mask in kept:
            names = {}

            def names_of(folder, names=names):
                if folder not in names:
                    names[folder] = dict(folder.durable_names)
                return names[folder]

            for step in itertools.compress(self.pending, mask):
                step.apply(names_of)
            yield dict(self.tree(self.root, names_of, ""))

    def tree(self, folder, names_of, above):
        for name, node in names_of(folder).items():
            if node.is_folder:
                yield from self.tree(node, names_of, f"{above}{name}/")
            elif node.is_synced():
                yield above + name, node.data
            else:
                yield above + name, node.data[:len(node.data) // 2]


def lines_of(log):
    """Whole lines, those put together that strace had to interrupt: where the call ends, or for a
    new process, which may act before that is seen, where it begins."""
    lines, begun = [], {}
    for line in log.read_text(encoding="ascii", errors="replace").splitlines():
        if found := UNFINISHED.match(line):
            begun[found[1]] = (len(lines), line[:-len(" <unfinished ...>")])
            lines.append("")
        elif found := RESUMED.match(line):
            place, start = begun.pop(found[1], (None, found[1] + " x("))
            if place is not None and CLONE.match(start):
                lines[place] = start + found[2]
            else:
                lines.append(start + found[2])
        else:
            lines.append(line)
    return [line for line in lines if line]


def decoded(text):
    return bytes.fromhex(text.replace("\\x", ""))


class Replay:
    """Takes recorded calls one by one and leaves their effects on a disk."""

    def __init__(self, disk, root):
        self.disk, self.root = disk, root
        self.open = {}     # process -> {descriptor: (node, path parts)}
        self.folders = {}  # process -> working folder

    def parts(self, process, text, base="AT_FDCWD"):
        """Below the root, else nothing."""
        path = pathlib.PurePosixPath(decoded(text).decode("utf-8", "surrogateescape"))
        if base not in ("AT_FDCWD", "-100"):
            entry = self.open[process].get(int(base))
            if entry is None:
                return None
            path = self.root.joinpath(*entry[1]) / path
        path = self.folders.get(process, self.root) / path
        try:
            return path.relative_to(self.root).parts
        except ValueError:
            return None

    def take(self, line):
        """True where files changed or were synced."""
        found = LINE.match(line)
        if not found or found[4] in ("?",) or found[4].startswith("-"):
            return False
        process, call, arguments, result = int(found[1]), found[2], found[3], int(found[4])
        self.open.setdefault(process, {})
        texts = TEXT.findall(arguments)
        words = TEXT.sub("TEXT", arguments).split(", ")
        if CLONE.match(line):
            shared = "CLONE_FILES" in arguments
            self.open[result] = self.open[process] if shared else dict(self.open[process])
            return False
        handler = getattr(self, "do_" + call, None)
        return bool(handler and handler(process, words, texts, result))

    def do_openat(self, process, words, texts, result):
        parts = self.parts(process, texts[0], words[0])
        flags = words[2]
        self.open[process].pop(result, None)
        if parts is None:
            return False
        if "O_TMPFILE" in flags:
            self.open[process][result] = (Node(False), parts)
            return False
        node = self.disk.find(parts)
        made = node is None
        if made:
            node = Node(False)
            self.disk.change([(self.disk.find(parts[:-1]), parts[-1], node)])
        elif "O_TRUNC" in flags:
            node.data = b""
        self.open[process][result] = (node, parts)
        return made or "O_TRUNC" in flags

    def do_open(self, process, words, texts, result):
        return self.do_openat(process, ["AT_FDCWD", *words], texts, result)

    def do_dup(self, process, words, _, result):
        entry = self.open[process].get(int(words[0]))
        if entry:
            self.open[process][result] = entry

    do_dup2 = do_dup3 = do_dup

    def do_fcntl(self, process, words, texts, result):
        if "F_DUPFD" in words[1]:
            self.do_dup(process, words, texts, result)

    def do_close(self, process, words, _, __):
        self.open[process].pop(int(words[0]), None)

    def do_write(self, process, words, texts, result):
        entry = self.open[process].get(int(words[0]))
        if not entry:
            return False
        entry[0].data += decoded(texts[0])[:result]
        return True

    def do_pwrite64(self, process, words, texts, result):
        if self.open[process].get(int(words[0])):
            raise Failure("pwrite is not modelled")

    def do_ftruncate(self, process, words, _, __):
        if self.open[process].get(int(words[0])):
            raise Failure("ftruncate is not modelled")

    def do_fsync(self, process, words, _, __):
        entry = self.open[process].get(int(words[0]))
        if not entry:
            return False
        self.disk.sync(entry[0])
        return True

    do_fdatasync = do_fsync

    def do_mkdirat(self, process, words, texts, _):
        parts = self.parts(process, texts[0], words[0])
        if parts is None:
            return False
        self.disk.change([(self.disk.find(parts[:-1]), parts[-1], Node(True))])
        return True

    def do_mkdir(self, process, words, texts, result):
        return self.do_mkdirat(process, ["AT_FDCWD", *words], texts, result)

    def moved(self, process, source, target, *bases):
        """(source folder, name, node) and (target folder, name), where both are below the root."""
        first = self.parts(process, source, bases[0])
        second = self.parts(process, target, bases[1])
        if first is None and second is None:
            return None
        if first is None or second is None:
            raise Failure("a file came from elsewhere or left")
        return ((self.disk.find(first[:-1]), first[-1], self.disk.find(first)),
                (self.disk.find(second[:-1]), second[-1]))

    def do_renameat(self, process, words, texts, _):
        move = self.moved(process, *texts[:2], words[0], words[2])
        if move is None:
            return False
        (folder, name, node), place = move
        self.disk.change([(*place, node)], [(folder, name)])
        return True

    do_renameat2 = do_renameat

    def do_rename(self, process, words, texts, result):
        return self.do_renameat(process, ["AT_FDCWD", words[0], "AT_FDCWD", *words[1:]], texts,
                                result)

    def do_linkat(self, process, words, texts, _):
        source = decoded(texts[0]).decode("utf-8", "surrogateescape")
        parts = self.parts(process, texts[1], words[2])
        if parts is None:
            return False
        if found := re.fullmatch(r"/proc/self/fd/(\d+)", source):
            node = self.open[process][int(found[1])][0]
        else:
            node = self.disk.find(self.parts(process, texts[0], words[0]))
        self.disk.change([(self.disk.find(parts[:-1]), parts[-1], node)])
        return True

    def do_unlinkat(self, process, words, texts, _):
        parts = self.parts(process, texts[0], words[0])
        if parts is None:
            return False
        self.disk.change((), [(self.disk.find(parts[:-1]), parts[-1])])
        return True

    def do_unlink(self, process, words, texts, result):
        return self.do_unlinkat(process, ["AT_FDCWD", *words], texts, result)

    do_rmdir = do_unlink


def visible(tree):
    return {name: contents for name, contents in tree.items()
            if not any(part.startswith(".tenon-") for part in name.split("/"))}


def birth_of(path):
    """As journals have it: number of the file, seconds and nanoseconds of its birth."""
    number, seconds, text = subprocess.run(
        ["stat", "-c", "%i\n%W\n%w", path], capture_output=True, text=True, check=True
    ).stdout.strip().split("\n")
    if seconds in ("0", "-"):
        return None
    return f"{number} {seconds} {int(text.split('.')[1].split()[0])}"


def put(tree, folder):
    """Makes the state in a folder. A journal names the file that it is in: it is written anew."""
    journals = []
    for name, contents in tree.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(contents)
        if path.name == JOURNAL:
            head, zero, rest = contents.partition(b"\0")
            birth = birth_of(path)
            if birth is None:
                return None
            journals.append(path)
            words = head.split(b" ")
            path.write_bytes(b" ".join([*words[:3], birth.encode()]) + zero + rest)
    return journals


def recovered(tree, home):
    """The files after the next edit in the folder of the journal; None: no times of birth here."""
    with tempfile.TemporaryDirectory(dir=home) as made:
        folder = pathlib.Path(made).resolve()
        journals = put(tree, folder)
        if journals is None:
            return None
        for journal in journals:
            extra = journal.parent / "zz_extra.usda"
            extra.write_text('#usda 1.0\ndef "A"\n{\n    double x = 0\n}\n', encoding="utf-8")
            done = subprocess.run([TENON, "set", extra, "/A.x=1"], capture_output=True, text=True,
                                  check=False)
            if done.returncode != 0:
                raise Failure(f"the next edit ends with {done.returncode}: {done.stderr}")
            extra.unlink()
        return snapshot(folder)


def run(arguments, folder):
    done = subprocess.run([TENON, *arguments], cwd=folder, capture_output=True, text=True,
                          check=False)
    if done.returncode not in (0, 1):
        raise Failure(f"{' '.join(arguments)}: exit {done.returncode}: {done.stderr[-400:]}")


def record(arguments, folder, log):
    done = subprocess.run(["strace", "-f", "-qq", "-xx", "-s", "100000000", "-e", "signal=none",
                           "-e", f"trace={CALLS}", "-o", log, TENON, *arguments], cwd=folder,
                          capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1):
        raise Failure(f"exit {done.returncode}: {done.stderr[-400:]}")


def states_of(disk, replay, log, chance):
    """All different trees, and how many calls changed something."""
    seen = {}

    def note():
        for tree in disk.states(chance):
            seen.setdefault(frozenset(tree.items()), tree)

    note()
    steps = 0
    for line in lines_of(log):
        if replay.take(line):
            steps += 1
            note()
    return list(seen.values()), steps


def judge(before, arguments, home, options, chance, syncs_folders=True):
    """-> (states, those that needed the journal, recoveries that were run)."""
    with tempfile.TemporaryDirectory(dir=home) as made:
        folder = pathlib.Path(made).resolve()
        make_inputs(folder)
        for words in before:
            run(words, folder)
        old = snapshot(folder)
        disk = Disk(folder, syncs_folders)
        log = home / "calls"
        record(arguments, folder, log)
        new = snapshot(folder)
        trees, steps = states_of(disk, Replay(disk, folder), log, chance)
        if new != old and steps == 0:
            raise Failure("no call of it was recorded")
        after = dict(disk.tree(disk.root, lambda node: node.names, ""))
        if visible(after) != new:
            raise Failure("the model ends with other files than the program")
    mixed = [tree for tree in trees if visible(tree) not in (old, new)]
    for tree in mixed:
        if not any(name.endswith(JOURNAL) for name in tree):
            names = [name for name in sorted({*old, *new, *visible(tree)})
                     if visible(tree).get(name) not in (old.get(name),)]
            raise Failure(f"neither old nor new, and no journal: {names}")
    drawn = mixed if len(mixed) <= options.recoveries else chance.sample(mixed, options.recoveries)
    for tree in drawn:
        end = recovered(tree, home)
        if end is not None and end not in (old, new):
            raise Failure("neither old nor new after the next edit: "
                          f"{[n for n in {*old, *new, *end} if end.get(n) != new.get(n)]}")
    return len(trees), len(mixed), len(drawn)


def cases(chosen):
    for verb in verbs():
        if chosen and verb not in chosen:
            continue
        for arguments in WRITING[verb]:
            yield [], [part.replace("OUT", "out") if part.startswith("OUT") else part
                       for part in arguments]
        for arguments, _ in EDITS.get(verb, []):
            yield [], arguments
        yield from [case for case in PREPARED if case[1][0] == verb]


def is_blind(home, options, chance):
    """A program that syncs no folder leaves mixes, which the model has to find."""
    try:
        judge([], EDITS["set"][1][0], home, options, chance, syncs_folders=False)
    except Failure:
        return False
    return True


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("root")
    parser.add_argument("tenon")
    parser.add_argument("--verbs", default="")
    parser.add_argument("--recoveries", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if not shutil.which("strace"):
        print("skipped: no strace")
        return 77
    chance = random.Random(options.seed)
    failures, total, count = 0, 0, 0
    with tempfile.TemporaryDirectory() as made:
        home = pathlib.Path(made).resolve()
        os.environ["XDG_STATE_HOME"] = str(home / "state")
        if is_blind(home, options, chance):
            print("the model finds nothing where no folder is synced")
            return 1
        for before, arguments in cases([verb for verb in options.verbs.split(",") if verb]):
            count += 1
            try:
                states, mixed, drawn = judge(before, arguments, home, options, chance)
                total += states
                print(f"{' '.join(arguments)}: {states} states, {mixed} by the journal, {drawn} "
                      "recovered", flush=True)
            except Failure as failure:
                failures += 1
                print(f"FAILED {' '.join(arguments)}: {failure}", flush=True)
    print(f"{count} commands, {total} states of power cuts, {failures} commands left something "
          "else than old or new files")
    return 1 if failures or not count else 0


if __name__ == "__main__":
    sys.exit(main())
