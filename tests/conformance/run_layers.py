#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The file format tests of the AOUSD core specification: one layer at a time, as JSON.

usage: run_layers.py TENON

text     `tenon test-runner layer` against the published JSON, after the normalisations that
         NORMALISED names for a case, each of which must be needed; and against OpenUSD's layer.
binary   against the facts of binary_facts.py, and against OpenUSD's layer.
package  the root layer of every package of all suites, against OpenUSD's layer.
own      layers of this project as text, as binary layers and packages that OpenUSD makes of them,
         against OpenUSD's layer; these alone where the published material is absent.
Exit 77: OpenUSD's modules are absent.
"""

import json
import os
import re
import subprocess
import sys
import tempfile

import suite
from binary_facts import FACTS

os.environ["PXR_USDC_EMIT_DEPRECATION_WARNINGS"] = "0"  # read when OpenUSD is loaded
try:
    import openusd_json
    from pxr import Sdf, UsdUtils
except ImportError:
    suite.skip("no OpenUSD modules in this Python")

OWN_STEP = 9  # one in so many of the layers of this project
OWN_PACKAGE_STEP = 45

# Where the published JSON differs from what OpenUSD reads from the same text, and why.
REASONS = {
    "header": "its version has more parts or digits than OpenUSD accepts: read with `#usda 1.0`",
    "slash": "the JSON puts `/` between a variant selection and a prim; OpenUSD does not",
    "escapes": "the JSON keeps backslash escapes of strings; OpenUSD expands them",
    "sets": "the JSON has no spec for a variant set that is named but has no variants; OpenUSD has",
    "arcs": "the JSON leaves out the customData of references",
}
NORMALISED = {
    "geometryattributes.usda": ["header"],
    "layermetadata.usda": ["escapes"],
    "primmetadata.usda": ["arcs"],
    "variants.usda": ["slash", "sets"],
}


def layer_json(tenon, path):
    """(layer, None) or (None, message)."""
    run = subprocess.run([tenon, "test-runner", "layer", path], capture_output=True, check=False)
    if run.returncode == 0:
        return json.loads(run.stdout), None
    return None, run.stderr.decode("utf-8", "replace").strip()[-300:] or f"exit {run.returncode}"


def without_arc_data(value):
    if isinstance(value, dict):
        is_arc = {"asset", "path", "layerOffset"} & set(value)
        return {key: without_arc_data(item) for key, item in value.items()
                if not (is_arc and key == "customData")}
    return [without_arc_data(item) for item in value] if isinstance(value, list) else value


def expanded(value):
    if isinstance(value, str):
        return re.sub(r"\\(['\"\\])", r"\1", value)
    if isinstance(value, dict):
        return {key: expanded(item) for key, item in value.items()}
    return [expanded(item) for item in value] if isinstance(value, list) else value


def without_empty_sets(layer):
    """Without variant sets that have no variant."""
    empty = {path for path, fields in layer.items() if path.endswith("=}") and not fields}
    kept = {path: dict(fields) for path, fields in layer.items() if path not in empty}
    for path, fields in kept.items():
        names = [name for name in fields.pop("variantSetChildren", [])
                 if f"{path}{{{name}=}}" not in empty]
        fields.update({"variantSetChildren": names} if names else {})
    return kept


def normalised(expected, actual, names):
    if "slash" in names:
        expected = {re.sub(r"\}/", "}", path): fields for path, fields in expected.items()}
    if "escapes" in names:
        expected = expanded(expected)
    if "sets" in names:
        actual = without_empty_sets(actual)
    if "arcs" in names:
        actual = without_arc_data(actual)
    return expected, actual


def compare_with_record(tenon, name, path, folder):
    with open(os.path.join(os.path.dirname(path), "..", "baseline", name[:-5] + ".json"),
              encoding="utf-8") as file:
        expected = json.load(file)
    names = NORMALISED.get(name, [])
    if "header" in names:
        if layer_json(tenon, path)[0] is not None:
            return "accepted, though OpenUSD rejects its header"
        with open(path, encoding="utf-8") as file:
            _, _, text = file.read().partition("\n")
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write("#usda 1.0\n" + text)
    actual, message = layer_json(tenon, path)
    if actual is None:
        return message
    for unneeded in names:
        rest = [other for other in names if other != unneeded]
        if unneeded != "header" and not openusd_json.difference(
                *normalised(expected, actual, rest)):
            return f"the normalisation `{unneeded}` is not needed"
    return openusd_json.difference(*normalised(expected, actual, names))


def compare_with_openusd(tenon, path):
    actual, message = layer_json(tenon, path)
    try:
        is_package = path.endswith(".usdz")
        layer = (Sdf.Layer.FindOrOpen if is_package else Sdf.Layer.OpenAsAnonymous)(path)
    except Exception:  # pylint: disable=broad-except
        layer = None
    if layer is None or actual is None:
        return None if layer is None and actual is None else message or "OpenUSD rejects it"
    return openusd_json.differs(layer, actual)


def compare_with_facts(tenon, name, path):
    actual, message = layer_json(tenon, path)
    facts = {key: value for key, value in FACTS.items() if key[0] == name}
    if actual is None or not facts:
        return message or "no fact is known about it"
    for (_, spec, field), value in facts.items():
        held = actual.get(spec, {}).get(field, "(none)")
        if not openusd_json.same(value, held):
            return f"<{spec}> {field}: expected {value}, actual {held}"
    return None


def files_below(folder, suffix):
    return sorted(os.path.join(inside, name) for inside, _, names in os.walk(folder)
                  for name in names if name.endswith(suffix))


def compare_own(tenon, folder):
    """Layers of this project; -> exit code."""
    own = suite.Results("own_layers")
    for path in suite.own_layers(OWN_STEP):
        own.add("layers of this project, text: as OpenUSD reads them", suite.own_name(path),
                compare_with_openusd(tenon, path))
        binary = os.path.join(folder, "layer.usdc")
        try:
            Sdf.Layer.OpenAsAnonymous(path).Export(binary)
        except Exception:  # pylint: disable=broad-except
            continue  # no layer: there is no binary form
        own.add("layers of this project, binary: as OpenUSD reads them",
                suite.own_name(path) + " binary", compare_with_openusd(tenon, binary))
    for number, path in enumerate(suite.own_layers(OWN_PACKAGE_STEP)):
        package = os.path.join(folder, f"{number}.usdz")
        try:
            made = UsdUtils.CreateNewUsdzPackage(path, package)
        except Exception:  # pylint: disable=broad-except
            made = False
        if made:
            own.add("packages of layers of this project: as OpenUSD reads them",
                    suite.own_name(path) + " package", compare_with_openusd(tenon, package))
    return own.finish(is_whole=False)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    tenon = sys.argv[1]
    text, binary = suite.Results("aousd_text"), suite.Results("aousd_binary")
    with tempfile.TemporaryDirectory() as folder:
        for name, path in suite.cases("aousd_text"):
            text.add("AOUSD text layers: published JSON", name,
                     compare_with_record(tenon, name, path, folder))
            text.add("AOUSD text layers: as OpenUSD reads them", name,
                     compare_with_openusd(tenon, path))
        code = compare_own(tenon, folder)
    for name, path in suite.cases("aousd_binary"):
        binary.add("AOUSD binary layers: facts", name, compare_with_facts(tenon, name, path))
        binary.add("AOUSD binary layers: as OpenUSD reads them", name,
                   compare_with_openusd(tenon, path))
    packages = suite.Results("packages")
    for path in files_below(suite.CONFORMANCE, ".usdz"):
        packages.add("packages: as OpenUSD reads them", os.path.relpath(path, suite.CONFORMANCE),
                     compare_with_openusd(tenon, path))
    for name, names in sorted(NORMALISED.items()) if suite.HAS_PUBLISHED else ():
        print(f"{name}: " + "; ".join(REASONS[reason] for reason in names))
    for results in (text, binary, packages):
        code |= results.finish(is_whole=suite.HAS_PUBLISHED)
    sys.exit(code)


if __name__ == "__main__":
    main()
