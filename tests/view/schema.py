# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""As much of JSON Schema as the tables of messages use."""

import re

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool}


def is_of(value, name):
    if name == "null":
        return value is None
    if name == "number":
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    if name == "integer":
        return isinstance(value, int) and not isinstance(value, bool)
    return isinstance(value, TYPES[name])


def faults(value, schema, place=""):
    """-> what of `value` the schema does not allow."""
    types = schema.get("type", [])
    types = [types] if isinstance(types, str) else types
    if types and not any(is_of(value, name) for name in types):
        return [f"{place}: {value!r} is none of {types}"]
    found = []
    if "const" in schema and value != schema["const"]:
        found.append(f"{place}: {value!r} is not {schema['const']!r}")
    if isinstance(value, str) and not re.search(schema.get("pattern", ""), value):
        found.append(f"{place}: {value!r} does not match {schema['pattern']}")
    if isinstance(value, list):
        low, high = schema.get("minItems", 0), schema.get("maxItems", len(value))
        if not low <= len(value) <= high:
            found.append(f"{place}: {len(value)} items")
        for index, item in enumerate(value):
            found += faults(item, schema.get("items", {}), f"{place}[{index}]")
    if isinstance(value, dict):
        known = schema.get("properties", {})
        found += [f"{place}: no {name}" for name in schema.get("required", [])
                  if name not in value]
        for name, item in value.items():
            if name in known:
                found += faults(item, known[name], f"{place}.{name}")
            elif schema.get("additionalProperties", True) is False:
                found.append(f"{place}: {name} is not in the schema")
    return found
