# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A composed stage as OpenUSD sees it, as the JSON that `tenon dump` prints (tenon-stage-dump-1).
Every value is what OpenUSD's Python modules return.

usage: openusd_stage.py FILE [-o OUT] [--session FILE] [--no-payloads] [--builtins] [--stacks]
                        [--xforms] [--full-arrays N]

Exit 0: dumped, 3: OpenUSD does not open the layer.
"""

import argparse
import hashlib
import json
import math
import os
import re
import sys

from pxr import Sdf, Tf, Usd, UsdGeom

EVERYTHING = Usd.TraverseInstanceProxies(Usd.PrimAllPrimsPredicate)
PROTOTYPE = re.compile(r"/__Prototype_\d+")
# What composition and the structure of a layer consist of, and is told elsewhere in the dump.
STRUCTURE = frozenset(
    "apiSchemas connectionChildren connectionPaths custom default inheritPaths layerRelocates "
    "payload primChildren properties propertyChildren references relocates specializes specifier "
    "spline subLayerOffsets subLayers targetChildren targetPaths timeSamples typeName variability "
    "variantChildren variantSelection variantSetChildren variantSetNames".split())
EXACT_INTEGER = 2**53
MOST_BETWEEN = 8  # values between samples
EDGE = 4  # elements of a long array that are shown at its ends


def real(value):
    value = float(value)
    if math.isfinite(value):
        return value
    return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"


def whole(value):
    value = int(value)
    return value if abs(value) <= EXACT_INTEGER else str(value)


class Dumper:
    """Dumps one stage. `options`: stacks, builtins, xforms (flags) and full_arrays (how many
    elements an array may have to be written out)."""

    def __init__(self, stage, options):
        self.stage = stage
        self.options = options
        self.folder = os.path.dirname(os.path.abspath(stage.GetRootLayer().realPath or "."))
        self.prototypes = {}  # path of a prototype -> its name in the dump
        self.transforms = UsdGeom.XformCache()

    # Names

    def layer_name(self, layer):
        """Relative to the folder of the root layer; what is inside a package stays in brackets."""
        if layer.anonymous:
            return "<anon>"
        name = layer.realPath or layer.identifier
        inside = ""
        if name.endswith("]") and "[" in name:
            name, inside = name[:name.index("[")], name[name.index("["):]
        if os.path.isabs(name):
            name = os.path.relpath(name, self.folder).replace(os.sep, "/")
        return name + inside

    def path_name(self, path):
        """With the name of the dump in place of a prototype's number."""
        text = str(path)
        found = PROTOTYPE.match(text)
        if not found:
            return text
        return self.prototypes.get(found.group(), found.group()) + text[found.end():]

    # Values

    def asset(self, value):
        resolved = value.resolvedPath
        if os.path.isabs(resolved):
            resolved = os.path.relpath(resolved, self.folder)
        said = {"$asset": value.path, "resolved": resolved or None}
        evaluated = getattr(value, "evaluatedPath", "")
        return said | ({"evaluated": evaluated} if evaluated not in ("", value.path) else {})

    def expression(self, value):
        text = PROTOTYPE.sub(lambda found: self.prototypes.get(found.group(), found.group()),
                             value.GetText())
        return {"$pathExpression": text}

    def digest(self, array):
        """Of the bytes of the elements or, where they are no numbers, of their JSON."""
        try:
            import numpy  # pylint: disable=import-outside-toplevel

            packed = numpy.asarray(array)
            if packed.dtype.kind not in "OUS":
                return hashlib.sha256(packed.tobytes()).hexdigest()
        except (ImportError, TypeError, ValueError):
            pass
        total = hashlib.sha256()
        for element in array:
            total.update(json.dumps(self.value(element), sort_keys=True).encode() + b"\0")
        return total.hexdigest()

    def array(self, value):
        count = len(value)
        if count <= self.options.full_arrays:
            return [self.value(element) for element in value]
        return {"$array": {"n": count, "sha256": self.digest(value),
                           "head": [self.value(value[i]) for i in range(EDGE)],
                           "tail": [self.value(value[count - EDGE + i]) for i in range(EDGE)]}}

    def list_edit(self, value):
        if value.isExplicit:
            return {"$listop": {"explicit": [self.value(item) for item in value.explicitItems]}}
        lists = {name: getattr(value, name + "Items", [])
                 for name in ("prepended", "appended", "deleted", "ordered", "added")}
        return {"$listop": {name: [self.value(item) for item in items]
                            for name, items in lists.items() if items}}

    def arc(self, value):
        offset = value.layerOffset
        return {"asset": value.assetPath, "path": str(value.primPath),
                "offset": [real(offset.offset), real(offset.scale)]}

    def of_class(self, value):
        """A value of one of OpenUSD's classes that are no plain Python types; None: of none."""
        kinds = (
            (Sdf.AssetPath, self.asset),
            (Sdf.TimeCode, lambda code: real(code.GetValue())),
            (Sdf.Path, self.path_name),
            (Sdf.PathExpression, self.expression),
            ((Sdf.Reference, Sdf.Payload), self.arc),
            (Sdf.LayerOffset, lambda offset: [real(offset.offset), real(offset.scale)]),
            (dict, lambda pairs: {str(key): self.value(pairs[key]) for key in sorted(pairs)}),
        )
        for kind, said in kinds:
            if isinstance(value, kind):
                return said(value)
        return None

    def by_name(self, value):
        """A value of one of OpenUSD's families of classes."""
        name = type(value).__name__
        if name.endswith("Array") or isinstance(value, (list, tuple)):
            return self.array(value)
        if name.startswith("Quat"):
            return [real(value.GetReal()), *map(real, value.GetImaginary())]
        if name.startswith("Matrix"):
            rows, columns = value.dimension
            return [[real(value[i][j]) for j in range(columns)] for i in range(rows)]
        if name.startswith("Vec"):
            return [whole(x) if name.endswith("i") else real(x) for x in value]
        if name.startswith("Range"):
            return {"$range": [real(end) if isinstance(end, float) else self.value(end)
                               for end in (value.min, value.max)]}
        if name.endswith("ListOp"):
            return self.list_edit(value)
        if name == "UnregisteredValue":
            inner = value.value
            return {"$unregistered": inner if isinstance(inner, str) else self.value(inner)}
        if hasattr(value, "displayName"):
            return value.displayName
        return {"$repr": name, "s": str(value)}

    def value(self, value):
        if value is None or isinstance(value, (bool, str)):
            return value
        if isinstance(value, Sdf.ValueBlock) or value is Sdf.ValueBlock:
            return {"$block": True}
        if isinstance(value, int):
            return whole(value)
        if isinstance(value, float):
            return real(value)
        said = self.of_class(value)
        return self.by_name(value) if said is None else said

    def metadata(self, thing):
        found = thing.GetAllAuthoredMetadata()
        return {key: self.value(found[key]) for key in sorted(found) if key not in STRUCTURE}

    # Properties

    def times(self, attribute):
        samples = attribute.GetTimeSamples()

        def at(times):
            return [[real(time), self.value(attribute.Get(time))] for time in times]

        said = {"timeSamples": at(samples)} if samples else {}
        if len(samples) > 1:
            between = [(a + b) / 2 for a, b in zip(samples, samples[1:])][:MOST_BETWEEN]
            said["interpolated"] = at([samples[0] - 1, *between, samples[-1] + 1])
        if attribute.HasSpline():
            spline = attribute.GetSpline()
            said["spline"] = str(spline)
            knots = sorted(spline.GetKnots().keys())
            if knots:
                between = [(a + b) / 2 for a, b in zip(knots, knots[1:])]
                said["splineSamples"] = at([knots[0] - 1, *knots, *between, knots[-1] + 1])
        return said

    def stack(self, specs):
        return [[self.layer_name(spec.layer), str(spec.path)] for spec in specs]

    def rest(self, thing):
        """Metadata and stack of a property."""
        said = {}
        metadata = self.metadata(thing)
        if metadata:
            said["metadata"] = metadata
        if self.options.stacks:
            said["stack"] = self.stack(thing.GetPropertyStack(Usd.TimeCode.Default()))
        return said

    def default(self, attribute, is_blocked):
        if is_blocked:
            return {"$block": True}
        try:
            return self.value(attribute.Get())
        except Exception as error:  # pylint: disable=broad-except
            return {"$error": type(error).__name__}

    def attribute(self, attribute):
        uniform = attribute.GetVariability() == Sdf.VariabilityUniform
        source = attribute.GetResolveInfo(Usd.TimeCode.Default())
        said = {
            "kind": "attribute",
            "type": str(attribute.GetTypeName()),
            "variability": "uniform" if uniform else "varying",
            "custom": attribute.IsCustom(),
            "authored": attribute.IsAuthored(),
            "defaultSource": source.GetSource().displayName,
            "default": self.default(attribute, source.ValueIsBlocked()),
            **self.times(attribute),
        }
        connections = attribute.GetConnections()
        if connections or attribute.HasAuthoredConnections():
            said["connections"] = [self.path_name(path) for path in connections]
        return said | self.rest(attribute)

    def relationship(self, relationship):
        return {
            "kind": "relationship",
            "custom": relationship.IsCustom(),
            "targets": [self.path_name(path) for path in relationship.GetTargets()],
            "forwarded": [self.path_name(path) for path in relationship.GetForwardedTargets()],
            **self.rest(relationship),
        }

    def properties(self, prim):
        said = {}
        for found in prim.GetProperties() if self.options.builtins else \
                prim.GetAuthoredProperties():
            is_attribute = isinstance(found, Usd.Attribute)
            try:
                said[found.GetName()] = (self.attribute if is_attribute
                                         else self.relationship)(found)
            except Tf.ErrorException:
                said[found.GetName()] = {"$error": "Tf.ErrorException"}
        return said

    # Prims

    def prim_metadata(self, prim):
        said = self.metadata(prim)
        for name in ("clips", "clipSets"):  # GetAllAuthoredMetadata skips them
            if prim.HasAuthoredMetadata(name):
                said[name] = self.value(prim.GetMetadata(name))
        return said

    def prototype_of(self, prim):
        """Name of the prototype that an instance or a proxy of one uses; None."""
        if not prim.IsInstance() and prim.IsInstanceProxy():
            prim = prim.GetPrimInPrototype()
        return self.path_name(prim.GetPrototype().GetPath()) if prim.IsInstance() else None

    def variant_sets(self, prim):
        sets = prim.GetVariantSets()
        return {name: {"selection": sets.GetVariantSelection(name),
                       "variants": sorted(sets.GetVariantSet(name).GetVariantNames())}
                for name in sets.GetNames()}

    def prim(self, prim):
        said = {
            "specifier": str(prim.GetSpecifier()).rpartition("Specifier")[2].lower(),
            "type": str(prim.GetTypeName()),
            "active": prim.IsActive(),
            "loaded": prim.IsLoaded(),
            "defined": prim.IsDefined(),
            "abstract": prim.IsAbstract(),
            "model": prim.IsModel(),
            "group": prim.IsGroup(),
            "instance": prim.IsInstance(),
            "instanceProxy": prim.IsInstanceProxy(),
            "appliedSchemas": [str(name) for name in prim.GetAppliedSchemas()],
            "children": [child.GetName() for child in prim.GetFilteredChildren(EVERYTHING)],
        }
        optional = {"prototype": self.prototype_of(prim), "metadata": self.prim_metadata(prim),
                    "variantSets": self.variant_sets(prim)}
        said.update({key: value for key, value in optional.items() if value})
        said["properties"] = self.properties(prim)
        if self.options.stacks:
            said["stack"] = self.stack(prim.GetPrimStack())
        if self.options.xforms and prim.IsA(UsdGeom.Xformable):
            said["localToWorld"] = self.value(self.transforms.GetLocalToWorldTransform(prim))
        return said

    # The stage

    def name_prototypes(self):
        """After the first instance that uses each; -> {name: instances}."""
        users = {}
        for prim in Usd.PrimRange(self.stage.GetPseudoRoot(), EVERYTHING):
            inner = prim.GetPrimInPrototype() if prim.IsInstanceProxy() else prim
            if inner and inner.IsInstance():
                prototype = str(inner.GetPrototype().GetPath())
                users.setdefault(prototype, []).append(str(prim.GetPath()))
        self.prototypes = {path: f"<proto:{min(found)}>" for path, found in users.items()}
        return {self.prototypes[path]: sorted(found) for path, found in users.items()}

    def run(self):
        """The whole dump."""
        stage, root = self.stage, self.stage.GetPseudoRoot()
        users = self.name_prototypes()
        layer = stage.GetRootLayer()
        errors = (type(error).__name__.removeprefix("Error")
                  for error in stage.GetCompositionErrors())
        used = {self.layer_name(each) for each in stage.GetUsedLayers()} - {"<anon>"}
        inside = {self.path_name(prim.GetPath()): self.prim(prim)
                  for prototype in stage.GetPrototypes()
                  for prim in Usd.PrimRange(prototype, Usd.PrimAllPrimsPredicate)}
        return {
            "format": "tenon-stage-dump-1",
            "root": os.path.basename(layer.identifier),
            "defaultPrim": str(layer.defaultPrim or ""),
            "stageMetadata": self.metadata(root),
            "startTimeCode": real(stage.GetStartTimeCode()),
            "endTimeCode": real(stage.GetEndTimeCode()),
            "timeCodesPerSecond": real(stage.GetTimeCodesPerSecond()),
            "framesPerSecond": real(stage.GetFramesPerSecond()),
            "layerStack": [self.layer_name(each) for each in stage.GetLayerStack(False)],
            "usedLayers": sorted(used),
            "compositionErrors": sorted(errors),
            "rootChildren": [prim.GetName() for prim in root.GetFilteredChildren(EVERYTHING)],
            "prims": {str(prim.GetPath()): self.prim(prim)
                      for prim in Usd.PrimRange(root, EVERYTHING) if not prim.IsPseudoRoot()},
            "prototypes": dict(sorted(inside.items())),
            "prototypeInstances": dict(sorted(users.items())),
        }


def open_stage(arguments):
    load = Usd.Stage.LoadNone if arguments.no_payloads else Usd.Stage.LoadAll
    if not arguments.session:
        return Usd.Stage.Open(arguments.file, load)
    root, session = map(Sdf.Layer.FindOrOpen, (arguments.file, arguments.session))
    return Usd.Stage.Open(root, session, load)


def main(words=None):
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("-o", dest="out")
    parser.add_argument("--session")
    for flag in ("--no-payloads", "--builtins", "--stacks", "--xforms"):
        parser.add_argument(flag, action="store_true")
    parser.add_argument("--full-arrays", type=int, default=256)
    arguments = parser.parse_args(words)
    try:
        stage = open_stage(arguments)
    except Tf.ErrorException as error:
        print(f"not opened: {str(error)[:400]}", file=sys.stderr)
        return 3
    text = json.dumps(Dumper(stage, arguments).run(), indent=1, ensure_ascii=False,
                      allow_nan=False)
    if arguments.out:
        with open(arguments.out, "w", encoding="utf-8", errors="surrogateescape") as file:
            file.write(text)
    else:
        sys.stdout.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
