#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares the schema tables with what OpenUSD registers, and with the schema layers of the
vendors' wheels (build/schemas, made by tools/make_oracle.sh; without it only the first is done).

usage: check_schemas.py TENON

core     kind, base, built-in API schemas, the types an API may be applied to, and of each property
         name, type, variability, fallback and allowed tokens; for every schema of OpenUSD
vendor   the same, as the schema layer and its plugInfo.json say
Schemas that a side alone knows are misses, too.
"""

import json
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
REPO = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(REPO, "tests", "conformance"), os.path.join(REPO, "tools")]

import suite  # noqa: E402

try:
    import generate_schema
    import openusd_json
    from pxr import Sdf, Usd
except ImportError:
    suite.skip("no OpenUSD modules in this Python")

WHEELS = os.environ.get("TENON_SCHEMAS_DIR", os.path.join(REPO, "build", "schemas"))


def property_json(spec):
    """A property as `tenon test-runner schemas` prints one."""
    if isinstance(spec, Sdf.RelationshipSpec):
        return {"type": "rel"}
    uniform = spec.variability == Sdf.VariabilityUniform
    found = {"type": str(spec.typeName), "variability": "uniform" if uniform else "varying"}
    if spec.default is not None:
        found["fallback"] = openusd_json.value_json(spec.default)
    if spec.GetInfo("allowedTokens"):
        found["allowedTokens"] = list(spec.GetInfo("allowedTokens"))
    return found


def core_json(name, kind, base, built_in, applies_to):
    registry = Usd.SchemaRegistry()
    definition = registry.FindConcretePrimDefinition(name)
    definition = definition or registry.FindAppliedAPIPrimDefinition(name)
    names = definition.GetPropertyNames() if definition else []
    properties = {prop: property_json(definition.GetSchemaPropertySpec(prop)) for prop in names}
    return {"kind": kind, "base": base, "vendor": False, "builtInApis": built_in,
            "canOnlyApplyTo": applies_to, "properties": properties}


def vendor_json(layers, name, kind, base, built_in, applies_to):
    specs = [layer.GetPrimAtPath("/" + name) for layer in layers]
    spec = next(spec for spec in specs if spec)
    properties = {prop.name: property_json(prop) for prop in spec.properties}
    return {"kind": kind, "base": base, "vendor": True, "builtInApis": built_in,
            "canOnlyApplyTo": applies_to, "properties": properties}


def compare(results, label, expected, actual):
    for name in sorted(set(expected) | set(actual)):
        if name not in expected or name not in actual:
            side = "unknown to tenon" if name in expected else "known to tenon alone"
            results.add(label, name, side)
            continue
        parts = [{key: {"": side[key]} for key in side if key != "properties"} | side["properties"]
                 for side in (expected[name], actual[name])]
        results.add(label, name, openusd_json.difference(*parts))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    run = subprocess.run([sys.argv[1], "test-runner", "schemas"], capture_output=True, check=True)
    own = json.loads(run.stdout)
    results = suite.Results("schemas")
    expected = {row[0]: core_json(*row[:5]) for row in generate_schema.core_schemas()}
    compare(results, "schemas of OpenUSD", expected,
            {name: schema for name, schema in own.items() if not schema["vendor"]})
    if os.path.isdir(WHEELS):
        paths = generate_schema.vendor_layers(WHEELS)
        layers = [Sdf.Layer.FindOrOpen(path) for path in paths]
        rows = generate_schema.vendor_schemas(paths)
        compare(results, "schemas of vendors: newton, mujoco, physx, isaac",
                {row[0]: vendor_json(layers, *row[:5]) for row in rows},
                {name: schema for name, schema in own.items() if schema["vendor"]})
    else:
        print(f"no {WHEELS}: vendors' schemas are not compared")
    sys.exit(results.finish())


if __name__ == "__main__":
    main()
