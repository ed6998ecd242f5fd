# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A layer as OpenUSD reads it, in the JSON form of `tenon test-runner layer`, and the comparison of
two such layers."""

import math

import numpy
from pxr import Gf, Sdf, Tf, Ts, Vt

LISTS = (("explicit", "explicitItems"), ("delete", "deletedItems"), ("add", "addedItems"),
         ("prepend", "prependedItems"), ("append", "appendedItems"), ("order", "orderedItems"))
# What OpenUSD holds and its Python side cannot hand out, such as text that is not UTF-8: equal to
# anything.
UNREADABLE = object()
ENUMS = {
    Sdf.SpecifierDef: "def", Sdf.SpecifierOver: "over", Sdf.SpecifierClass: "class",
    Sdf.PermissionPublic: "public", Sdf.PermissionPrivate: "private",
    Sdf.VariabilityVarying: "varying", Sdf.VariabilityUniform: "uniform",
}


def offset_json(offset):
    return {"offset": offset.offset, "scale": offset.scale}


def arc_json(arc):
    members = {"asset": arc.assetPath, "path": str(arc.primPath)}
    members = {name: text for name, text in members.items() if text}
    if arc.layerOffset != Sdf.LayerOffset():
        members["layerOffset"] = offset_json(arc.layerOffset)
    if getattr(arc, "customData", None):
        members["customData"] = value_json(arc.customData)
    return members


def list_json(op):
    lists = {name: [value_json(item) for item in getattr(op, items)] for name, items in LISTS}
    return {name: items for name, items in lists.items() if items}


def end_json(end):
    modes = {Ts.ExtrapValueBlock: "none", Ts.ExtrapHeld: "held", Ts.ExtrapLinear: "linear",
             Ts.ExtrapSloped: "sloped", Ts.ExtrapLoopRepeat: "loopRepeat",
             Ts.ExtrapLoopReset: "loopReset", Ts.ExtrapLoopOscillate: "loopOscillate"}
    members = {"mode": modes[end.mode]}
    if end.mode == Ts.ExtrapSloped:
        members["slope"] = end.slope
    return members


def tangent_json(width, slope, algorithm):
    algorithms = {"TangentAlgorithmNone": "none", "TangentAlgorithmCustom": "custom",
                  "TangentAlgorithmAutoEase": "autoEase"}
    return {"width": width, "slope": slope,
            "algorithm": algorithms[str(algorithm).rsplit(".", 1)[-1]]}


def knot_json(knot, hermite):
    modes = {Ts.InterpValueBlock: "none", Ts.InterpHeld: "held", Ts.InterpLinear: "linear",
             Ts.InterpCurve: "curve"}
    members = {"value": knot.GetValue()}
    if knot.IsDualValued():
        members["preValue"] = knot.GetPreValue()
    members["interpolation"] = modes[knot.GetNextInterpolation()]
    widths = (0.0, 0.0) if hermite else (knot.GetPreTanWidth(), knot.GetPostTanWidth())
    members["preTangent"] = tangent_json(widths[0], knot.GetPreTanSlope(),
                                         knot.GetPreTanAlgorithm())
    members["postTangent"] = tangent_json(widths[1], knot.GetPostTanSlope(),
                                          knot.GetPostTanAlgorithm())
    if knot.GetCustomData():
        members["customData"] = value_json(knot.GetCustomData())
    return members


def spline_json(spline):
    hermite = spline.GetCurveType() == Ts.CurveTypeHermite
    members = {"curve": "hermite" if hermite else "bezier",
               "pre": end_json(spline.GetPreExtrapolation()),
               "post": end_json(spline.GetPostExtrapolation())}
    if spline.HasInnerLoops():
        loop = spline.GetInnerLoopParams()
        members["loop"] = {"start": loop.protoStart, "end": loop.protoEnd,
                           "preLoops": loop.numPreLoops, "postLoops": loop.numPostLoops,
                           "valueOffset": loop.valueOffset}
    knots = spline.GetKnots()
    members["knots"] = {repr(float(time)): knot_json(knots[time], hermite) for time in knots}
    return members


def number_json(x):
    if math.isfinite(x):
        return x
    return "nan" if math.isnan(x) else "inf" if x > 0 else "-inf"


def value_json(value):
    if value is None or isinstance(value, (bool, int)):
        return value
    if isinstance(value, float):
        return number_json(value)
    if value in ENUMS if isinstance(value, Tf.Enum) else False:
        return ENUMS[value]
    if isinstance(value, str):
        return value
    if isinstance(value, (Sdf.ValueBlock, Sdf.AnimationBlock)):
        return None
    if isinstance(value, dict):
        return {str(key): value_json(item) for key, item in value.items()}
    return object_json(value)


def edit_text(value):
    """An edit of an array as text layers print it."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.customLayerData = {"x": value}
    return layer.ExportToString().split(" x = ", 1)[1].rsplit("    }\n)", 1)[0].strip()


def object_json(value):
    name = type(value).__name__
    if name.endswith("ArrayEdit"):
        return edit_text(value)
    if isinstance(value, Sdf.AssetPath):
        return value.path
    if isinstance(value, Sdf.TimeCode) or name == "Duration":
        return number_json(float(value))
    if isinstance(value, (Sdf.Reference, Sdf.Payload)):
        return arc_json(value)
    if isinstance(value, Sdf.LayerOffset):
        return offset_json(value)
    if isinstance(value, Ts.Spline):
        return spline_json(value)
    if name.endswith("ListOp"):
        return list_json(value)
    if name.startswith("Quat") and not name.endswith("Array"):
        return [number_json(x) for x in (*value.GetImaginary(), value.GetReal())]
    if isinstance(value, (Sdf.Path, Sdf.PathExpression)):
        return value.GetText() if isinstance(value, Sdf.PathExpression) else str(value)
    if isinstance(value, Sdf.UnregisteredValue):
        return unregistered_json(value.value)
    return [value_json(item) for item in value]


def unregistered_json(value):
    if not isinstance(value, str):
        return value_json(value)
    if value == "None":
        return None
    try:
        return number_json(float(value)) if math.isfinite(float(value)) else value
    except ValueError:
        quoted = len(value) > 1 and value[0] in "\"'" and value[-1] == value[0]
        return value[1:-1] if quoted else value


def times_json(samples):
    return {repr(float(time)): value_json(value) for time, value in samples.items()}


def info_json(layer, spec, key):
    if key == "subLayers":
        return list(layer.subLayerPaths)
    if key == "subLayerOffsets":
        return [offset_json(offset) for offset in layer.subLayerOffsets]
    if key in ("relocates", "layerRelocates"):
        pairs = layer.relocates if key == "layerRelocates" else spec.relocates.items()
        return {str(source): str(target) for source, target in pairs}
    try:
        value = spec.GetInfo(key)
    except UnicodeDecodeError:
        return UNREADABLE
    return times_json(value) if key == "timeSamples" else value_json(value)


def is_default(spec, key, value):
    return ((key == "custom" and value is False)
            or (key == "variability" and (value == "varying"
                                          or isinstance(spec, Sdf.RelationshipSpec)))
            or key in ("connectionChildren", "targetChildren"))


def fields_json(layer, spec, keys):
    values = {key: info_json(layer, spec, key) for key in keys}
    return {key: value for key, value in values.items() if not is_default(spec, key, value)}


def children_json(**lists):
    return {name: names for name, names in lists.items() if names}


def spec_json(layer, spec):
    if isinstance(spec, Sdf.VariantSetSpec):
        return children_json(variantChildren=[v.name for v in spec.variants.values()])
    keys, found = set(spec.ListInfoKeys()), {}
    prim = spec
    if isinstance(spec, Sdf.VariantSpec):
        prim, keys = spec.primSpec, set(spec.primSpec.ListInfoKeys()) - {"specifier"}
    if isinstance(spec, Sdf.PseudoRootSpec):
        keys |= {"subLayers", "subLayerOffsets"} if layer.subLayerPaths else set()
        found = children_json(primChildren=[p.name for p in spec.nameChildren])
    elif isinstance(prim, Sdf.PrimSpec):
        found = children_json(primChildren=[p.name for p in prim.nameChildren],
                              propertyChildren=[p.name for p in prim.properties],
                              variantSetChildren=[v.name for v in prim.variantSets])
    return {**fields_json(layer, prim, keys), **found}


def layer_json(layer):
    """{spec path: {field: value}} of all but target and connection specs."""
    paths = []
    layer.Traverse(Sdf.Path.absoluteRootPath, paths.append)
    result = {}
    for path in paths:
        spec = layer.GetObjectAtPath(path)
        if spec is not None:
            result[str(path)] = spec_json(layer, spec)
    return result


def differs(layer, actual):
    """What differs between OpenUSD's layer and a JSON one. Fields that no schema knows may be in
    OpenUSD's layer though its Python side only tells that they are there."""
    expected = layer_json(layer)
    for path, fields in actual.items():
        spec = layer.GetObjectAtPath(path)
        spec = getattr(spec, "primSpec", spec)
        for name in set(fields) - set(expected.get(path, fields)):
            if spec is not None and spec.HasInfo(name):
                expected[path][name] = UNREADABLE
    return difference(expected, actual)


def single(x):
    return float(numpy.float32(x)) if abs(x) < 3.5e38 else x


def same(expected, actual):
    """Equal, numbers as the same float where `expected` is one."""
    if expected is UNREADABLE:
        return True
    numbers = (int, float)
    if isinstance(expected, bool) or isinstance(actual, bool):
        return expected is actual
    if isinstance(expected, numbers) and isinstance(actual, numbers):
        return expected == actual or single(expected) == expected == single(actual)
    if isinstance(expected, list) and isinstance(actual, list):
        return len(expected) == len(actual) and all(map(same, expected, actual))
    if isinstance(expected, dict) and isinstance(actual, dict):
        return expected.keys() == actual.keys() and all(
            same(value, actual[key]) for key, value in expected.items())
    return expected == actual


def difference(expected, actual):
    """The first spec and field that differ, None when nothing does."""
    for path in sorted(set(expected) | set(actual)):
        if path not in expected or path not in actual:
            return f"<{path}> is in one layer alone: " + (
                "expected" if path in expected else "actual")
        for field in sorted(set(expected[path]) | set(actual[path])):
            a, b = expected[path].get(field, "(none)"), actual[path].get(field, "(none)")
            if not same(a, b):
                return f"<{path}> {field}: expected {str(a)[:200]}, actual {str(b)[:200]}"
    return None
