#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every library that the programs are made of is installed with its licence.

usage: licences.py BUILD_OF_THE_PRESET_RELEASE

Which libraries there are is asked of the build: the headers that were included, the files that were
linked. Debian says which package owns each; of each package the licence must be there word by word.
Libraries fetched into build/_deps bring theirs. Exit 0: all there; 1: some are not; 77: no build,
or no Debian.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys

import installed

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DOCUMENT = os.path.join(ROOT, "docs/dependencies.md")
# Of the C library and the kernel only the interface is used, and not shipped.
INTERFACES = re.compile(r"^(libc6|libc6-dev|linux-libc-dev|libcrypt-dev)$")
SHARED = re.compile(r"\.so(\.[0-9]+)*$")
FETCHED = re.compile(r"(?:build/_deps|tenon/engines)/([a-z]+)-[^/]*/")


def lines_of(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode and not done.stdout:
        sys.exit(f"{' '.join(command)}: {done.stderr.strip()}")
    return done.stdout.split("\n")


def files_used(build):
    """Headers and libraries that stand outside of this project."""
    used = set()
    for line in lines_of("ninja", "-C", build, "-t", "deps"):
        # What libraries load themselves is in the lists of newer linkers.
        if line.startswith("    ") and not SHARED.search(line.strip()):
            used.add(os.path.realpath(os.path.join(build, line.strip())))
    for program in ("bin/tenon", "all"):
        for line in lines_of("ninja", "-C", build, "-t", "commands", program):
            for word in shlex.split(line):
                if (word.endswith(".a") or SHARED.search(word)) and os.path.isabs(word):
                    used.add(os.path.realpath(word))
    own = (ROOT + "/", os.path.realpath(build) + "/")
    # A compiler that does not escape spaces in its lists leaves pieces of this project's own path.
    return {path for path in used
            if os.path.isfile(path) and (not path.startswith(own) or FETCHED.search(path))}


def packages_of(paths):
    """{package: one of its files}; files that no package owns are an error of their own."""
    owners, orphans = {}, set(paths)
    ordered = sorted(paths)
    for start in range(0, len(ordered), 500):
        for line in lines_of("dpkg-query", "-S", *ordered[start:start + 500]):
            names, _, path = line.rpartition(": ")
            if path in orphans:
                orphans.discard(path)
                for name in names.split(", "):
                    owners.setdefault(name.split(":")[0], path)
    return owners, sorted(orphans)


def installed_texts(prefix):
    """{text: its path} of all that is installed as documentation."""
    texts = {}
    for folder, _, names in os.walk(os.path.join(prefix, "share/doc/tenon")):
        for name in names:
            with open(os.path.join(folder, name), encoding="utf-8", errors="replace") as file:
                texts[file.read()] = os.path.relpath(os.path.join(folder, name), prefix)
    return texts


def faults_of(build, prefix):
    used = files_used(build)
    fetched = {found[1] for found in map(FETCHED.search, used) if found}
    owners, orphans = packages_of({path for path in used if not FETCHED.search(path)})
    texts = installed_texts(prefix)
    for path in orphans:
        yield f"{path}: used by the build, and of no package; say where its licence is"
    for package, path in sorted(owners.items()):
        if INTERFACES.match(package):
            continue
        licence = f"/usr/share/doc/{package}/copyright"
        with open(licence, encoding="utf-8", errors="replace") as file:
            if file.read() not in texts:
                yield (f"{package}: used by the build ({path}) and its licence {licence} is not "
                       "installed; see cmake/licences.cmake")
    for name in sorted(fetched):
        if not os.path.isdir(os.path.join(prefix, "share/doc/tenon", name)):
            yield f"{name}: fetched into build/_deps and its licence is not installed"
    with open(DOCUMENT, encoding="utf-8") as file:
        document = re.sub(r"[^a-z0-9+]", "", file.read().lower())
    for name in sorted(os.listdir(os.path.join(prefix, "share/doc/tenon"))):
        is_library = os.path.isdir(os.path.join(prefix, "share/doc/tenon", name))
        if is_library and re.sub(r"[^a-z0-9+]", "", name) not in document:
            yield f"{name}: its licence is installed, docs/dependencies.md does not name it"


def main():
    build = installed.release_build()
    if shutil.which("dpkg-query") is None:
        print("skipped: no dpkg-query here, which knows whose file is whose")
        return installed.SKIPPED
    with installed.install(build) as prefix:
        faults = list(faults_of(build, prefix))
        for fault in faults:
            print(fault)
        print(f"{len(installed_texts(prefix))} texts installed, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
