# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The scene and the random edits of edit_stage.py."""

import random

LAYERS = {
    "root.usda": """#usda 1.0
(
    defaultPrim = "A"
    subLayers = [
        @./sub.usda@ (offset = 10; scale = 2)
    ]
)
def Xform "A"
{
    double size = 1
    def "B"
    {
        rel r = </A>
    }
}
class "K"
{
    custom int fromClass = 1
    def "B"
    {
    }
}
def "R" (
    references = @./ref.usda@</Model> (offset = 3)
)
{
}
def "I" (
    instanceable = true
    references = @./ref.usda@</Model>
)
{
}
""",
    "more.usda": """#usda 1.0
over "A"
{
}
""",
    "sub.usda": """#usda 1.0
over "A"
{
    custom float3 weak = (1, 2, 3)
    def Scope "C"
    {
        custom float x = 1
    }
}
""",
    "ref.usda": """#usda 1.0
(
    defaultPrim = "Model"
)
def Xform "Model" (
    prepend variantSets = "look"
    variants = {
        string look = "red"
    }
)
{
    custom double v = 3
    def Sphere "Part"
    {
        double radius = 2
    }
    variantSet "look" = {
        "red" {
            over "Part"
            {
                custom int red = 1
            }
        }
        "blue" {
        }
    }
}
""",
}
FILES = ("root.usda", "sub.usda", "ref.usda", "more.usda")
PATHS = ("/A", "/A/B", "/A/C", "/A/B/D", "/K", "/K/B", "/R", "/R/Part", "/I", "/I/Part", "/N",
         "/N/B", "/N/1x", "/A/B/D/E")
# OpenUSD takes a name for an attribute where a schema or a weaker layer has a relationship, and
# the other way round; tenon refuses. Such names are not tried.
ATTRIBUTES = ("x", "y", "ns:z", "size", "weak", "v", "radius", "visibility", "fromClass", "1bad")
RELATIONSHIPS = ("r", "q", "ns:rel", "proxyPrim", "1bad")
VALUES = {
    "bool": ("true", "false"), "int": ("3", "-7"), "uint": ("9",), "int64": ("-5000000000",),
    "uint64": ("5000000000",), "uchar": ("200",), "half": ("0.5",), "float": ("1.25", "-2"),
    "double": ("0.1", "2"), "string": ('"a b"', '"line\\nbreak"'), "token": ('"tok"',),
    "asset": ("@./a.png@",), "timecode": ("12",), "float2": ("(1, 2)",), "int3": ("(1, 2, 3)",),
    "double3": ("(0.5, 1, 2)",), "color3f": ("(1, 0, 0)",), "half4": ("(1, 2, 3, 4)",),
    "quatf": ("(1, 0, 0, 0)",), "matrix2d": ("( (1, 0), (0, 1) )",),
    "float[]": ("[1, 2, 3]", "[]"), "token[]": ('["a", "b"]',), "point3f[]": ("[(1, 2, 3)]",),
    "timecode[]": ("[1, 2]",), "texCoord2f[]": ("[(0, 1)]",), "string[]": ('["x"]',),
    "quath[]": ("[(1, 0, 0, 0)]",), "matrix4d": (
        "( (1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (5, 6, 7, 1) )",),
}
FIELDS = (("active", "bool"), ("instanceable", "bool"), ("hidden", "bool"), ("kind", "token"),
          ("documentation", "string"), ("comment", "string"), ("displayName", "string"),
          ("active", "string"), ("nonsense", "int"), ("upAxis", "token"),
          ("displayGroup", "string"))
SCHEMAS = ("PhysicsRigidBodyAPI", "PhysicsMassAPI", "PhysicsDriveAPI:angular", "PhysicsDriveAPI",
           "NoSuchAPI", "CollectionAPI:plants", "PhysicsMassAPI:x")
POSITIONS = ("front_prepend", "back_prepend", "front_append", "back_append")


class Script:
    """Edits made from a seed."""

    def __init__(self, seed, count):
        self.random = random.Random(seed)
        makers = [getattr(self, name) for name in sorted(dir(self)) if name.startswith("make_")]
        weights = [3 if m.__name__ in ("make_define", "make_set", "make_attribute") else 1
                   for m in makers]
        self.edits = [maker() for maker in self.random.choices(makers, weights, k=count)]

    def one(self, items):
        return self.random.choice(items)

    def prim(self):
        return self.one(PATHS)

    def attribute(self):
        return self.prim() + "." + self.one(ATTRIBUTES)

    def relationship(self):
        return self.prim() + "." + self.one(RELATIONSHIPS)

    def property(self):
        return self.one((self.attribute, self.relationship))()

    def typed(self):
        type_name = self.one(sorted(VALUES))
        return {"type": type_name, "text": self.one(VALUES[type_name])}

    def time(self):
        return self.one((None, None, 0.0, 1.0, 24.0))

    def list_edit(self, op, path, items):
        kind = self.one(("add", "add", "add", "remove", "set", "clear"))
        count = {"add": 1, "remove": 1, "set": self.one((0, 1, 2)), "clear": 0}[kind]
        chosen = self.random.sample(items, count)
        return {"op": op, "path": path, "edit": kind, "items": chosen,
                "position": self.one(POSITIONS)}

    def make_define(self):
        return {"op": "define", "path": self.prim(), "type": self.one(("", "Xform", "Sphere"))}

    def make_override(self):
        return {"op": self.one(("override", "override", "class")), "path": self.prim()}

    def make_remove(self):
        return {"op": "remove", "path": self.prim()}

    def make_type_name(self):
        return {"op": "type_name", "path": self.prim(), "type": self.one(("Cube", "Xform"))}

    def make_reorder(self):
        op, names = self.one((("reorder_children", ["C", "B"]), ("reorder_properties", ["y", "x"])))
        return {"op": op, "path": self.prim(), "names": names}

    def make_metadata(self):
        field, kind = self.one(FIELDS)
        path = self.one((self.prim(), self.property(), "/"))
        return {"op": "metadata", "path": path, "field": field, "type": kind,
                "text": self.one(VALUES[kind])}

    def make_metadata_key(self):
        return {"op": "metadata", "path": self.one((self.prim(), self.property())),
                "field": "customData", "key": self.one(("a", "b:c", "b:d")),
                "type": "int", "text": self.one(VALUES["int"])}

    def make_clear_metadata(self):
        field, key = self.one((("active", ""), ("customData", "b:c"), ("customData", ""),
                               ("documentation", "")))
        path = self.one((self.prim(), self.property()))
        return {"op": "clear_metadata", "path": path, "field": field, "key": key}

    def make_schema(self):
        op = self.one(("apply_api", "remove_api", "add_schema", "remove_schema"))
        return {"op": op, "path": self.prim(), "schema": self.one(SCHEMAS)}

    def make_attribute(self):
        return {"op": "attribute", "path": self.attribute(), "type": self.one(sorted(VALUES)),
                "custom": self.one((True, False)), "uniform": self.one((True, False, False))}

    def make_relationship(self):
        return {"op": "relationship", "path": self.relationship(),
                "custom": self.one((True, False))}

    def make_remove_property(self):
        return {"op": "remove_property", "path": self.property()}

    def make_set(self):
        return {"op": "set", "path": self.attribute(), "time": self.time(), **self.typed()}

    def make_set_fitting(self):
        name, kind = self.one((("size", "double"), ("weak", "float3"), ("radius", "double"),
                               ("v", "double"), ("fromClass", "int")))
        text = "(4, 5, 6)" if kind == "float3" else "4"
        return {"op": "set", "path": self.prim() + "." + name, "time": self.time(), "type": kind,
                "text": text}

    def make_clear_value(self):
        op = self.one(("clear_value", "clear_values", "block"))
        return {"op": op, "path": self.property(), "time": self.time()}

    def make_targets(self):
        targets = ["/A", "/A/B", "/A/B.r", "/N", "/R/Part"]
        op, path = self.one((("targets", self.relationship()), ("connections", self.attribute())))
        return self.list_edit(op, path, targets)

    def make_references(self):
        arcs = [{"asset": "./ref.usda"}, {"asset": "./ref.usda", "prim": "/Model/Part"},
                {"prim": "/K"}, {"prim": "/K/B", "offset": 2.0}, {"asset": "./missing.usda"}]
        return self.list_edit(self.one(("references", "payloads")), self.prim(), arcs)

    def make_classes(self):
        op = self.one(("inherits", "specializes"))
        return self.list_edit(op, self.prim(), ["/K", "/K/B", "/Gone"])

    def make_sublayer(self):
        if self.one((True, False)):
            return {"op": "remove_sublayer", "index": self.one((0, 1))}
        return {"op": "insert_sublayer", "index": self.one((0, 1)),
                "asset": self.one(("./sub.usda", "./more.usda")), "offset": self.one((0.0, 5.0))}

    def make_variant(self):
        return {"op": self.one(("variant", "variant_set", "select", "select", "unselect")),
                "path": self.prim(), "set": self.one(("look", "size")),
                "variant": self.one(("red", "blue", "big")), "position": self.one(POSITIONS)}

    def make_target(self):
        kind = self.one(("root", "root", "sub", "variant", "variant", "arc"))
        if kind == "variant":
            return {"op": "target_variant", "path": self.prim(), "set": self.one(("look", "size")),
                    "variant": self.one(("red", "big"))}
        if kind == "arc":
            return {"op": "target_arc", "path": self.one(("/R", "/R/Part", "/A/B")),
                    "layer": "ref.usda"}
        return {"op": "target_layer", "layer": kind + ".usda"}
