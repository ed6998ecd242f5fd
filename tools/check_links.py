#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Every link of a Markdown file of the project leads somewhere: to a file, a folder, or a heading
of a file; every page of docs/ is reached by links from README.md; and files of the project that a
page or a comment cites by their path exist.

Usage: check_links.py [ROOT]. Exit 0: so it is; 1: a line for each link that leads nowhere.
"""

import os
import re
import sys
import urllib.parse

import source_files

FENCE = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
CODE = re.compile(r"`[^`\n]*`")
LINK = re.compile(r"!?\[[^\]\n]*(?:\n[^\]\n]*)?\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.*?) *#*$", re.M)
COMMENT = re.compile(r"(?://|#(?!include))(.*)")
CITED = re.compile(r"(?<![\w/.:$<>{*~-])((?:[\w-]+/)+[\w-]+\.(?:h|cpp|py|md|def|ts|cmake|sh|txt))\b"
                   r"(?![\w/*({])")
CODE_FILES = (".h", ".cpp", ".def", ".ts", ".py", ".cmake", ".sh", ".txt")
ELSEWHERE = re.compile(r"[a-z]+:|#$")


def plain(text):
    """The text with what is code blanked, line by line."""
    text = FENCE.sub(lambda found: "\n" * found[0].count("\n"), text)
    return CODE.sub(lambda found: " " * len(found[0]), text)


def anchor_of(heading):
    """The name of a heading as GitHub and MkDocs make it."""
    words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return re.sub(r"[^\w\- ]", "", words).strip().replace(" ", "-")


def links_of(text):
    """-> [(line, target)]"""
    text = plain(text)
    return [(text.count("\n", 0, found.start()) + 1, found[1]) for found in LINK.finditer(text)]


def cited_faults(root, paths):
    """Paths from the project's root or from tenon/ of which there is no file."""
    folders = {path.partition("/")[0] for path in paths if "/" in path}
    inside = {path.split("/")[1] for path in paths if path.startswith("tenon/")}
    known = set(paths) | {path.removeprefix("tenon/") for path in paths}
    for path in paths:
        is_page = path.endswith(".md")
        if not is_page and not path.endswith(CODE_FILES) or path == "tools/checks_test.py":
            continue
        with open(os.path.join(root, path), encoding="utf-8") as file:
            for line, text in enumerate(file, 1):
                comment = COMMENT.search(text)
                said = text if is_page else comment[1] if comment else ""
                for name in CITED.findall(said):
                    first = name.partition("/")[0]
                    if name not in known and (first in folders or first in inside):
                        yield f"{path}:{line}: there is no {name}"


class Pages:
    def __init__(self, root):
        self.root, self._texts = root, {}

    def text(self, path):
        if path not in self._texts:
            with open(os.path.join(self.root, path), encoding="utf-8") as file:
                self._texts[path] = file.read()
        return self._texts[path]

    def anchors(self, path):
        return {anchor_of(found[1]) for found in HEADING.finditer(FENCE.sub("", self.text(path)))}

    def target(self, path, link):
        """-> (file that a link of `path` means, its heading or "")"""
        name, _, anchor = urllib.parse.unquote(link).partition("#")
        place = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
        return place, anchor


def faults(root, paths):
    pages, reached = Pages(root), {}
    for path in paths:
        reached[path] = set()
        for line, link in links_of(pages.text(path)):
            if ELSEWHERE.match(link):
                continue
            place, anchor = pages.target(path, link)
            if place.startswith("..") or not os.path.exists(os.path.join(root, place)):
                yield f"{path}:{line}: there is no {place}"
                continue
            if anchor and place.endswith(".md") and anchor not in pages.anchors(place):
                yield f"{path}:{line}: {place} has no heading #{anchor}"
            readme = os.path.join(place, "README.md")
            reached[path].add(readme if os.path.exists(os.path.join(root, readme)) else place)
    found, waiting = set(), ["README.md"]
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += reached.get(path, ())
    for path in paths:
        if path.startswith("docs/") and path not in found:
            yield f"{path}:1: no link leads here from README.md"


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else source_files.ROOT
    files = list(source_files.project_files(root))
    paths = [path for path in files if path.endswith(".md")]
    found = [*faults(root, paths), *cited_faults(root, files)]
    for fault in found:
        print(fault)
    print(f"{len(paths)} pages, {len(found)} faults of links")
    return 1 if found or not paths else 0


if __name__ == "__main__":
    sys.exit(main())
