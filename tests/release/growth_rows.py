#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A list that a schema gains is a fault of release.growth until growth_properties.py has a row."""

import sys
import unittest

import growth_properties

CORE = growth_properties.GENERATED / "core_schemas.cpp"


class Rows(unittest.TestCase):
    def test_every_list_of_the_schemas_has_a_row(self):
        schemas = growth_properties.read_schemas()
        self.assertEqual(growth_properties.faults(schemas), [])
        self.assertGreater(len({name for schema in schemas for name in schema.lists}), 60)

    def test_a_new_list_is_a_fault(self):
        text = CORE.read_text(encoding="utf-8")
        for name in ("physics:filteredGroups", "physics:filteredPairs"):
            grown = text.replace(f'"{name}"', f'"{name}More"')
            found = growth_properties.faults(growth_properties.read_schemas(core=grown))
            self.assertEqual(found, [f"{name}More: no row in LISTS of growth_properties.py",
                                     f"{name}: a row of LISTS that no schema has"])

    def test_every_list_without_a_reason_is_in_the_scene(self):
        """Those of schemas that no prim can have are in a schema below."""
        schemas = growth_properties.read_schemas()
        text = "".join(growth_properties.prim_with(schema, schema.name, 3) for schema in schemas)
        for name, row in growth_properties.LISTS.items():
            own = name.replace("__INSTANCE_NAME__", "rotX")
            self.assertEqual(f" {own} = [" in text, not isinstance(row, str)
                             or name == "faceVertexIndices", name)


if __name__ == "__main__":
    sys.exit(unittest.main())
