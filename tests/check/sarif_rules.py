# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What SARIF 2.1.0 asks of a log, for the objects that tenon writes, and what GitHub asks on top:
which properties an object may have, which it must have, and of which kind each is. A property that
the specification does not name is a fault (only property bags are open)."""

import re

TEXT, COUNT, LIST = "text", "number from 1", "list"
INDEX = "number from 0"
# Object -> property -> (kind or object, whether it must be there). Section 3 of the specification.
OBJECTS = {
    "sarifLog": {"$schema": ("uri", False), "version": (("2.1.0",), True), "runs": ("run[]", True)},
    "run": {"tool": ("tool", True), "columnKind": (("utf16CodeUnits", "unicodeCodePoints"), False),
            "results": ("result[]", False)},
    "tool": {"driver": ("toolComponent", True)},
    "toolComponent": {"name": (TEXT, True), "version": (TEXT, False), "informationUri":
                      ("uri", False), "rules": ("reportingDescriptor[]", False)},
    "reportingDescriptor": {"id": (TEXT, True), "shortDescription": ("multiformatMessageString",
                                                                     False),
                            "help": ("multiformatMessageString", False), "helpUri": ("uri", False),
                            "defaultConfiguration": ("reportingConfiguration", False),
                            "properties": ("bag", False)},
    "multiformatMessageString": {"text": (TEXT, True), "markdown": (TEXT, False)},
    "reportingConfiguration": {"level": (("none", "note", "warning", "error"), False)},
    "result": {"ruleId": (TEXT, False), "ruleIndex": (INDEX, False),
               "level": (("none", "note", "warning", "error"), False), "message": ("message", True),
               "locations": ("location[]", False), "relatedLocations": ("location[]", False),
               "partialFingerprints": ("texts", False),
               "suppressions": ("suppression[]", False), "properties": ("bag", False)},
    "message": {"text": (TEXT, True)},
    "location": {"physicalLocation": ("physicalLocation", False),
                 "logicalLocations": ("logicalLocation[]", False), "message": ("message", False)},
    "physicalLocation": {"artifactLocation": ("artifactLocation", True),
                         "region": ("region", False)},
    "artifactLocation": {"uri": ("uri", True)},
    "region": {"startLine": (COUNT, True), "startColumn": (COUNT, False),
               "endLine": (COUNT, False), "endColumn": (COUNT, False)},
    "logicalLocation": {"fullyQualifiedName": (TEXT, False), "kind": (TEXT, False)},
    "suppression": {"kind": (("inSource", "external"), True),
                    "status": (("accepted", "underReview", "rejected"), False)},
}
# RFC 3986: a reference without blanks, and a percent sign only before two digits.
URI = re.compile(r"(?:[A-Za-z0-9._~:/?#\[\]@!$&'()*+,;=-]|%[0-9A-Fa-f]{2})+$")
GITHUB_RESULTS = 25000


def is_of_kind(value, kind):
    """Whether a value that holds no object of SARIF is one of its kind."""
    if isinstance(kind, tuple):
        return value in kind
    if kind in (COUNT, INDEX):
        return type(value) is int and value >= (kind == COUNT)
    if kind in ("texts", "bag"):
        return isinstance(value, dict) and (kind == "bag" or
                                            all(isinstance(v, str) for v in value.values()))
    return isinstance(value, str) and value != "" and (kind != "uri" or bool(URI.match(value)))


def faults_of_value(value, kind, where):
    if kind in OBJECTS:
        yield from faults_of_object(value, kind, where)
    elif isinstance(kind, str) and kind.endswith("[]"):
        if not isinstance(value, list):
            yield f"{where}: no list"
            return
        for number, each in enumerate(value):
            yield from faults_of_value(each, kind[:-2], f"{where}[{number}]")
    elif not is_of_kind(value, kind):
        yield f"{where}: {value!r} is not of kind {kind}"


def faults_of_object(value, name, where):
    if not isinstance(value, dict):
        yield f"{where}: no {name}"
        return
    rows = OBJECTS[name]
    for key, each in value.items():
        if key not in rows:
            yield f"{where}: a {name} has no property {key}"
        else:
            yield from faults_of_value(each, rows[key][0], f"{where}.{key}")
    for key, (_, must) in rows.items():
        if must and key not in value:
            yield f"{where}: {key} is missing"


def faults_of_run(run, where):
    """What relates one part of a run to another."""
    ids = [rule["id"] for rule in run["tool"]["driver"].get("rules", [])]
    if len(set(ids)) != len(ids):
        yield f"{where}: a rule stands twice"
    if len(run.get("results", [])) > GITHUB_RESULTS:
        yield f"{where}: more than {GITHUB_RESULTS} results"
    for number, result in enumerate(run.get("results", [])):
        index = result.get("ruleIndex", -1)
        if not 0 <= index < len(ids) or ids[index] != result.get("ruleId"):
            yield f"{where}.results[{number}]: rule {index} is not {result.get('ruleId')}"
        for place in result.get("locations", []):
            region = place.get("physicalLocation", {}).get("region", {"startLine": 1})
            start = (region["startLine"], region.get("startColumn", 1))
            end = (region.get("endLine", region["startLine"]), region.get("endColumn", 1 << 30))
            if start > end:  # an empty one is a place between characters
                yield f"{where}.results[{number}]: the region ends before it starts"


def faults(log):
    """Each breach as a line of text; none: the log is one of SARIF 2.1.0."""
    found = list(faults_of_object(log, "sarifLog", "log"))
    for number, run in enumerate(log["runs"] if not found else []):
        found += faults_of_run(run, f"log.runs[{number}]")
    return found
