#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The documentation as a web site, build/site: the pages of the project, the rules, the reference
of Python and, where `make docs` has made it, that of the C++ headers.

usage: make_site.py

MkDocs with the theme Material (docs/requirements.txt) lives in an environment outside of the clone,
$XDG_CACHE_HOME/tenon or ~/.cache/tenon, made once. A link that leads nowhere is a failure. Exit 0:
made; 1: what is wrong with the pages; 77: the environment could not be made (no network?).
"""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys

import check_links
import python_reference
import source_files

ROOT = source_files.ROOT
SOURCE = os.path.join(ROOT, "build/site_source")
SITE = os.path.join(ROOT, "build/site")
REQUIREMENTS = os.path.join(ROOT, "docs/requirements.txt")
SETTINGS = os.path.join(ROOT, "docs/mkdocs.yml")
SKIPPED = 77
# What a link of a page may show beside pages: small texts and pictures.
SHOWN = (".sh", ".yaml", ".toml", ".svg", ".png", ".webp", ".txt", ".py", ".cpp", ".h", ".usda",
         ".urdf", ".xml")


def mkdocs_of_cache():
    """-> the program, made where it is missing; None where it cannot be."""
    with open(REQUIREMENTS, "rb") as file:
        key = hashlib.sha256(file.read() + sys.version.encode()).hexdigest()[:12]
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    folder = os.path.join(cache, "tenon", f"site-{key}")
    if not os.path.exists(os.path.join(folder, "made")):
        try:
            subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True)
            subprocess.run([os.path.join(folder, "bin/python"), "-m", "pip", "install", "--quiet",
                            "--disable-pip-version-check", "--no-deps", "--only-binary=:all:",
                            "--require-hashes", "-r", REQUIREMENTS], check=True)
        except (OSError, subprocess.CalledProcessError) as error:
            print(f"make_site: no environment with MkDocs: {error}")
            return None
        with open(os.path.join(folder, "made"), "w", encoding="utf-8"):
            pass
    return os.path.join(folder, "bin/mkdocs")


def put(path, text):
    place = os.path.join(SOURCE, path)
    os.makedirs(os.path.dirname(place), exist_ok=True)
    with open(place, "w", encoding="utf-8") as file:
        file.write(text)


def lay_out_page(path, text, pages):
    """A page where it lies in the project; links to files that the site does not have are names."""
    def linked(found):
        link = found["link"]
        place = os.path.normpath(os.path.join(os.path.dirname(path), link.partition("#")[0]))
        if check_links.ELSEWHERE.match(link) or link.startswith("#") or place in pages:
            return found[0]
        readme = os.path.join(place, "README.md")
        if readme in pages:
            return f"[{found['text']}]({os.path.relpath(readme, os.path.dirname(path) or '.')})"
        if os.path.isfile(os.path.join(ROOT, place)) and place.endswith(SHOWN):
            os.makedirs(os.path.dirname(os.path.join(SOURCE, place)), exist_ok=True)
            shutil.copyfile(os.path.join(ROOT, place), os.path.join(SOURCE, place))
            return found[0]
        if not os.path.exists(os.path.join(ROOT, place)):
            return found[0]  # MkDocs tells
        return found["text"] if "`" in found["text"] else f"{found['text']} (`{place}`)"

    put(path, re.sub(r"(?<!!)\[(?P<text>[^\]]+)\]\((?P<link>[^)\s]+)\)", linked, text))


def lay_out(pages):
    shutil.rmtree(SOURCE, ignore_errors=True)
    for path in pages:
        with open(os.path.join(ROOT, path), encoding="utf-8") as file:
            lay_out_page(path, file.read(), pages)
    for path in source_files.project_files(ROOT):
        if path.startswith("docs/") and path.endswith((".svg", ".png", ".webp", ".js")):
            os.makedirs(os.path.dirname(os.path.join(SOURCE, path)), exist_ok=True)
            shutil.copyfile(os.path.join(ROOT, path), os.path.join(SOURCE, path))
    put("python/reference.md", python_reference.reference(ROOT))
    made = os.path.join(ROOT, "build/docs/html")
    text = "# C++, header by header\n\n"
    if os.path.exists(os.path.join(made, "index.html")):
        shutil.copytree(made, os.path.join(SOURCE, "cpp/html"))
        text += "[The reference of the headers](html/index.html), with all classes and functions.\n"
    else:
        text += ("`make docs` makes the reference of the headers, and `make site` then has it "
                 "here.\n")
    put("cpp/index.md", text)


def faults_of_navigation(pages):
    """Pages of docs/ that the site's navigation does not name, and names of pages there are not."""
    with open(SETTINGS, encoding="utf-8") as file:
        named = set(re.findall(r"^ +- [^:]+: (\S+\.md)$", file.read(), re.M))
    for path in pages:
        if path.startswith("docs/") and path.count("/") == 1 and path not in named:
            yield f"docs/mkdocs.yml: {path} is not in the navigation"
    for path in sorted(named - set(pages) - {"python/reference.md", "cpp/index.md"}):
        yield f"docs/mkdocs.yml: there is no {path}"


def rules_that_search_misses(pages):
    """Pages of rules that the index of the site's search does not have."""
    with open(os.path.join(SITE, "search/search_index.json"), encoding="utf-8") as file:
        found = {entry["location"] for entry in json.load(file)["docs"]}
    for path in sorted(pages):
        if path.startswith("docs/rules/") and path[:-len("md")] + "html" not in found \
                and not path.endswith("README.md"):
            yield f"the search of the site does not find {path}"


def main():
    pages = {path for path in source_files.project_files(ROOT) if path.endswith(".md")}
    faults = list(faults_of_navigation(sorted(pages)))
    for fault in faults:
        print(fault)
    if sys.argv[1:] == ["--navigation"] or faults:
        return 1 if faults else 0
    mkdocs = mkdocs_of_cache()
    if mkdocs is None:
        return SKIPPED
    lay_out(pages)
    done = subprocess.run([mkdocs, "build", "--strict", "--clean", "-f", SETTINGS],
                          env={**os.environ, "NO_MKDOCS_2_WARNING": "1",
                               "DISABLE_MKDOCS_2_WARNING": "true"},
                          capture_output=True, text=True, check=False)
    if done.returncode:
        print("\n".join(line for line in (done.stdout + done.stderr).split("\n")
                        if "INFO" not in line))
        return 1
    missed = list(rules_that_search_misses(pages))
    if missed:
        print("\n".join(missed))
        return 1
    count = sum(name.endswith(".html") for _, _, names in os.walk(SITE) for name in names)
    print(f"{len(pages)} pages, {count} in the site: build/site/index.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
