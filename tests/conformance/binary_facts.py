# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What the binary layers of the AOUSD format tests hold: {(file, path, field): value}."""


def products(n):
    """The n x n matrix of (row + 1) * (column + 1)."""
    return [[float(r * c) for c in range(1, n + 1)] for r in range(1, n + 1)]


def identity(n):
    return [[float(r == c) for c in range(n)] for r in range(n)]


QUATERNION = [4.824, 1.225, 5.247, 3.14]  # i, j, k, real
HALF_QUATERNION = [4.82421875, 1.224609375, 5.24609375, 3.140625]
WORDS = ["Hello/World", "Good/Bye"]
LARGEST_INT, LARGEST_UINT = 2**31 - 1, 2**32 - 1

DEFAULTS = {
    ("assetpath", "single"): WORDS[0], ("assetpath", "array"): WORDS,
    ("double", "single"): 3.1415, ("double", "array:lut"): [-3.1415, 2.7182, 1.618],
    ("double", "array:ints"): [-1, 0, 1],
    ("float", "single"): 3.1415, ("float", "array:lut"): [-3.1415, 2.7182, 1.618],
    ("float", "array:ints"): [-1, 0, 1],
    ("half", "single"): 3.140625, ("half", "array:lut"): [-3.140625, 2.71875, 1.6181640625],
    ("half", "array:ints"): [-1, 0, 1],
    ("int", "single"): -LARGEST_INT,
    ("int", "array"): [-LARGEST_INT, 0, 1, 2, 3, 4, LARGEST_INT],
    ("uint", "single"): LARGEST_UINT, ("uint", "array"): [0, 1, 2, 3, 4, LARGEST_UINT],
    ("uchar", "single"): 255, ("uchar", "array"): [0, 1, 2, 3, 4, 255],
    ("string", "single"): WORDS[0], ("string", "array"): WORDS,
    ("token", "single"): WORDS[0], ("token", "array"): WORDS,
    ("pathexpression", "single"): "/root/Foo",
    ("pathexpression", "array"): ["/root/Spam", "/root/Eggs"],
    ("timecodes", "single"): 11, ("timecodes", "array"): [100.1, 13.1234],
}
for size in (2, 3, 4):
    DEFAULTS[(f"matrix{size}d", "single")] = products(size)
    DEFAULTS[(f"matrix{size}d", "inlined")] = identity(size)
    DEFAULTS[(f"matrix{size}d", "array")] = [products(size), products(size)]
for kind, value in (("d", QUATERNION), ("f", QUATERNION), ("h", HALF_QUATERNION)):
    DEFAULTS[("quat" + kind, "single")] = value
    DEFAULTS[("quat" + kind, "inlined")] = [1, 2, 3, 0]
    DEFAULTS[("quat" + kind, "array")] = [value, [1, 2, 3, 0], value]

FACTS = {(f"gen_{file}.usdc", f"/root.{name}", "default"): value
         for (file, name), value in DEFAULTS.items()}
FACTS.update({
    ("ball.maya.usdc", "/", "defaultPrim"): "Ball",
    ("ball.maya.usdc", "/", "upAxis"): "Y",
    ("ball.maya.usdc", "/Ball", "kind"): "component",
    ("gen_dict.usdc", "/", "customLayerData"): {"Apple": {"preferredIblVersion": 2}},
    ("gen_listops.usdc", "/root", "apiSchemas"): {"explicit": ["MaterialBindingAPI"]},
    ("gen_listops.usdc", "/root", "payload"): {"append": [{"asset": "eggs.usda"}]},
    ("gen_listops.usdc", "/root.foo", "targetPaths"): {"explicit": ["/eggs", "/spam"]},
    ("gen_permissions.usdc", "/Specialize", "permission"): "private",
    ("gen_relocates.usdc", "/", "layerRelocates"): {"/Egg/Foo": "/Egg/Bar"},
    ("gen_splines.usdc", "/MyPrim.myAttr", "typeName"): "double",
    ("gen_timesamples.usdc", "/root.animated", "timeSamples"):
        {**{f"{time}.0": time for time in range(10)}, "11.0": None},
    ("gen_variants.usdc", "/root", "variantSelection"): {"foo": "eggs"},
    ("gen_variants.usdc", "/root", "variantSetNames"): {"prepend": ["foo"]},
    ("gen_variants.usdc", "/root{foo=}", "variantChildren"): ["eggs", "spam"],
})
