#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares composition with the published composition suites, case by case.

usage: run_composition.py DUMP [CASE...] [-v]

DUMP is the program tests/tools/composition_dump.cpp. Cases are those that conformance/cases.txt of
the folder named by TENON_SHARED_DIR (default: ../shared) lists for the suites aousd_composition
(each through text and binary layers) and openusd_museum. Everything but findings must be equal to
the byte; findings are compared per prim by class. A case whose record is only a parse error of its
root layer, or that REJECTED names, passes when the layer is rejected. Of the one record of a node
graph the nodes are compared: arc, site, parent, whether they count.
Known misses are named in composition_misses.txt beside this folder: one more or one less makes
this fail. The scenes of own_scenes.py are compared with what OpenUSD composes of them. Exit 77: the
published material is absent and OpenUSD is, too.
"""

import collections
import glob
import os
import re
import subprocess
import sys
import tempfile
import types

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.dirname(HERE))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(HERE)), "differential"))
import own_scenes  # noqa: E402  pylint: disable=wrong-import-position
import suite  # noqa: E402  pylint: disable=wrong-import-position

CONFORMANCE = suite.CONFORMANCE
MISSES = os.path.join(os.path.dirname(HERE), "composition_misses.txt")
RULE = "-" * 72 + "\n"

# How the records word a finding -> its class.
CLASSES = (
    (r"Cycle detected:", "arc-cycle"),
    (r"which is a prohibited child", "arc-to-prohibited-child"),
    (r"^Unresolved \w+ prim path", "unresolved-prim-path"),
    (r"^Could not open asset", "invalid-asset-path"),
    (r"^Could not load sublayer", "invalid-sublayer-path"),
    (r"has inconsistent spec types", "inconsistent-property-type"),
    (r"refers to an instance of that class", "invalid-instance-target-path"),
    (r"outside the scope of the", "invalid-external-target-path"),
    (r"is the target of multiple relocations", "invalid-same-target-relocations"),
    (r"conflicts with another relocation", "invalid-conflicting-relocation"),
    (r"is invalid and will be ignored", "invalid-authored-relocation"),
    (r"has an invalid opinion at the relocation source", "opinion-at-relocation-source"),
    (r"^Sublayer hierarchy with root layer", "sublayer-cycle"),
    (r"have the same owner", "invalid-sublayer-ownership"),
    (r"^Error evaluating expression", "variable-expression-error"),
    (r"must be an absolute prim path", "invalid-prim-path"),
    (r"^Invalid sublayer offset", "invalid-sublayer-offset"),
    (r"^Invalid \w+ offset", "invalid-reference-offset"),
)

# Cases of the museum that are recorded with other settings than all payloads and no session layer.
OPTIONS = {
    "testPcpMuseum_BasicOwner_session": ["--session", "session.usda"],
    "testPcpMuseum_BasicPayload_session": ["--session", "session.usda"],
    "testPcpMuseum_BasicPayloadDiamond": ["--unloaded", "/RootUnloaded"],
    "testPcpMuseum_BasicReference_session": ["--session", "session.usda"],
    "testPcpMuseum_BasicOwner": ["--session", "session.usda"],
    "testPcpMuseum_BasicPayload": ["--session", "session.usda"],
    "testPcpMuseum_BasicReference": ["--session", "session.usda"],
    "testPcpMuseum_ErrorOwner": ["--session", "session.usda"],
    "testPcpMuseum_ExpressionsInSublayers": ["--session", "session.usda"],
    "testPcpMuseum_PayloadsAndAncestralArcs": ["--unloaded", "/Root/UnloadedInheritedPayload"],
    "testPcpMuseum_PayloadsAndAncestralArcs3_refpayloadsonly": [
        "--no-payloads", "--loaded", "/ReferencePayloadedModel",
        "--loaded", "/InternalReferencePayloadedModel"],
    "testPcpMuseum_TimeCodesPerSecond_root_24tcps_12fps_session_48tcps": [
        "--session", "session_48tcps.usda"],
    "testPcpMuseum_TimeCodesPerSecond_root_48tcps_session_24fps": ["--session", "session_24fps.usda"],
    "testPcpMuseum_TimeCodesPerSecond_root_12fps_session_24fps": ["--session", "session_24fps.usda"],
    "testPcpMuseum_TimeCodesPerSecond_root_12fps_session": ["--session", "session.usda"],
}


# Records made before variants in paths of arcs and relocates became a parse error, which
# usd-core 26.11 reports: these root layers must be rejected.
REJECTED = {"testPcpMuseum_BasicInherits", "testPcpMuseum_ErrorRelocateWithVariantSelection",
            "testPcpMuseum_SubrootReferenceAndVariants"}


class Case:
    """One comparison: a root layer and what is recorded of it."""

    def __init__(self, name, root, record, options=(), renamed=False):
        self.name = name
        self.root = root
        self.record = record
        self.options = list(options)
        self.renamed = renamed  # layers got longer names after the record was made


def read(path):
    with open(path, encoding="utf-8", errors="replace", newline="") as file:
        return file.read().replace("\r\n", "\n")


def aousd_case(name, folder, binary):
    layer = "session.usd" if name.endswith("_session") else "root.usd"
    root = os.path.join(folder, layer) if binary else os.path.join(folder, "usda", layer)
    record = os.path.join(folder, "pcp.txt")
    if not os.path.exists(record):
        return None
    text = read(record)
    if binary and not os.path.exists(root):
        return None  # its text cannot be parsed, so there is no binary form
    return Case(f"{name} {'binary' if binary else 'text'}", root, text)


def baseline(name, folder, kind):
    """The record for caches in USD mode: of several that of the case, not a legacy one."""
    found = glob.glob(os.path.join(folder, "baseline", f"composition{kind}_*.txt"))
    found = [path for path in sorted(found) if "_Legacy" not in path]
    exact = [path for path in found if name.endswith(path.rsplit("composition" + kind, 1)[1][:-4])]
    for_usd = [path for path in found if path.endswith("_usd.txt")]
    best = for_usd or exact or found
    return best[0] if best else None


def museum_case(name, folder):
    result = baseline(name, folder, "Results")
    if result is None:
        return None
    text = read(result)
    loading = re.search(r"Loading @(.*?)@\n\n-", text)
    if loading is None:
        return None
    root = os.path.join(folder, loading.group(1))
    errors = baseline(name, folder, "Errors")
    text += "" if errors is None else "\n" + read(errors)
    options = OPTIONS.get(name, [])
    if "--session" in options:
        options = ["--session", os.path.join(os.path.dirname(root), options[1])]
    return Case(name, root, text, options, renamed=True)


def find_cases(wanted):
    cases = []
    if not suite.HAS_PUBLISHED:
        return cases
    with open(os.path.join(CONFORMANCE, "cases.txt"), encoding="utf-8") as file:
        for line in file:
            fields = line.rstrip("\n").split("\t")
            if line.startswith("#") or len(fields) < 3:
                continue
            source, name, folder = fields[0], fields[1], os.path.join(CONFORMANCE, fields[2])
            if source == "aousd_composition":
                cases += [aousd_case(name, folder, False), aousd_case(name, folder, True)]
            elif source == "openusd_museum":
                cases.append(museum_case(name, folder))
    cases = [case for case in cases if case is not None]
    return [case for case in cases if not wanted or any(w in case.name for w in wanted)]


def class_of(line):
    for pattern, name in CLASSES:
        if re.search(pattern, line):
            return name
    return None


def split(text):
    """-> (blocks of the dump, {heading of findings: counted classes})."""
    text = re.sub(r"^Loading .*?\n\n(?=-)", "", text, flags=re.S | re.M)
    text = re.sub(r"\n-{80}\nWarning: .*?(?=\n-{72}\n|\nERROR|\Z)", "", text, flags=re.S)
    text = re.sub(r"^ERROR: Unexpected.*", "", text, flags=re.S | re.M)
    blocks, findings = [], {}
    for block in text.split(RULE):
        if not block.strip():
            continue
        heading, _, rest = block.partition("\n")
        if not heading.startswith("Errors while"):
            blocks.append(block.rstrip("\n"))
            continue
        found = collections.Counter()
        for line in rest.split("\n"):
            name = line[8:].split(" ")[0] if line.startswith("compose.") else class_of(line)
            if name:
                found[name] += 1
        findings[heading] = findings.get(heading, collections.Counter()) + found
    return blocks, findings


def unpadded(text):
    """Columns one blank apart: their width depends on the names of layers."""
    return re.sub(r"(?<=\S) {2,}", " ", text)


def recorded_nodes(record):
    """[arc, layer, path, parent, whether it has specs that count] of each node of a graph."""
    nodes = []
    for text in re.split(r"^Node \d+:$", record, flags=re.M)[1:]:
        facts = dict(re.findall(r"^ +([A-Z][\w ]*?): +(\S.*)$", text, flags=re.M))
        layer = re.search(r"([^/@]+)@", facts["Source layer stack"]).group(1)
        counts = facts["Contribute specs"] == "TRUE" and facts["Has specs"] == "TRUE"
        nodes.append([facts["Type"], layer, facts["Source path"].strip("<>"),
                      facts["Parent node"], counts])
    return nodes


def dumped_nodes(text, prim):
    """The same of one prim from the dump of all nodes."""
    block = text.split(f"\n== {prim}\n", 1)[-1].split("\n== ", 1)[0]
    nodes, above = [], []
    for line in block.split("\n"):
        words = line.split()
        if len(words) < 3 or words[0] in ("spec", "children", "properties", "selected"):
            break
        depth = (len(line) - len(line.lstrip())) // 2
        above = above[:depth] + [len(nodes)]
        counts = not {"inert", "culled", "no-specs"} & set(words[3:])
        nodes.append([*words[:3], str(above[depth - 1]) if depth else "NONE", counts])
    return nodes


def compare_graph(dump, case):
    process = subprocess.run([dump, case.root, "--nodes", *case.options], capture_output=True,
                             text=True, timeout=120, check=False)
    prim = re.search(r"Results for composing <(.*?)>", case.record).group(1)
    recorded, dumped = recorded_nodes(case.record), dumped_nodes(process.stdout, prim)
    if recorded == dumped:
        return ""
    return f"recorded {recorded}\ndumped {dumped}"


def compare(dump, case):
    """What differs, an empty string when nothing does."""
    if "\nNode 0:\n" in case.record:
        return compare_graph(dump, case)
    is_rejected = case.name in REJECTED or "Traceback" in case.record or \
        "Results for composing" not in case.record
    process = subprocess.run([dump, case.root, *case.options], capture_output=True, timeout=120,
                             check=False)
    if process.returncode != 0:
        message = process.stderr.decode("utf-8", "replace").strip().split("\n")[-1]
        return "" if is_rejected and process.returncode == 3 else f"not dumped: {message}"
    if is_rejected:
        return "accepted, though it must be rejected"
    record, own = case.record, process.stdout.decode("utf-8", "replace")
    if case.renamed:
        record, own = unpadded(record), unpadded(own)
    blocks, findings = split(record)
    own_blocks, own_findings = split(own)
    for counts in findings.values():  # the record asks twice for each property and notes both
        counts["inconsistent-property-type"] //= 2
    for block, own_block in zip(blocks, own_blocks):
        if block != own_block:
            return f"--- recorded\n{block}\n--- composed\n{own_block}"
    if len(blocks) != len(own_blocks):
        return f"{len(blocks)} prims are recorded, {len(own_blocks)} were composed"
    for heading in sorted(set(findings) | set(own_findings)):
        recorded = +findings.get(heading, collections.Counter())
        composed = own_findings.get(heading, collections.Counter())
        if recorded != composed:
            return f"{heading}: recorded {dict(recorded)}, composed {dict(composed)}"
    return ""


def label_of(case):
    if case.renamed:
        return "museum of OpenUSD: composition"
    return f"AOUSD composition through {case.name.rsplit(' ', 1)[1]} layers"


def compare_own(dump):
    """Scenes of this project; -> exit code."""
    try:
        import pxr  # noqa: F401  pylint: disable=unused-import,import-outside-toplevel
    except ImportError:
        if not suite.HAS_PUBLISHED:
            suite.skip("no OpenUSD modules in this Python")
        return 0
    import compose_random  # pylint: disable=import-outside-toplevel

    results = suite.Results("own_composition")
    with tempfile.TemporaryDirectory() as folder:
        judge = compose_random.Judge(types.SimpleNamespace(dump=dump), folder)
        for name, files in own_scenes.SCENES.items():
            inside = os.path.join(folder, name)
            os.mkdir(inside)
            for file_name, text in files.items():
                with open(os.path.join(inside, file_name), "w", encoding="utf-8") as file:
                    file.write(text)
            found = judge.compare(inside, {})
            results.add("scenes of this project: composition, against OpenUSD", name,
                        None if found.kind == "equal" else f"{found.kind} {found.text}")
    return results.finish(is_whole=False)


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "-v"]
    own = compare_own(arguments[0]) if not arguments[1:] else 0
    results = suite.Results("composition", MISSES)
    for case in sorted(find_cases(arguments[1:]), key=label_of):
        difference = compare(arguments[0], case)
        results.add(label_of(case), case.name, difference)
        if difference and "-v" in sys.argv:
            print(f"{case.name}: {difference}")
    return own | results.finish(is_whole=not arguments[1:] and suite.HAS_PUBLISHED)


if __name__ == "__main__":
    sys.exit(main())
