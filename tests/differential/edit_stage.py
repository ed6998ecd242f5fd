#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the same random edits of a stage with OpenUSD's Python modules and with tenon.

usage: edit_stage.py PROGRAM [--scripts N] [--seed S] [--edits N] [--keep FOLDER] [-v]

PROGRAM is tests/tools/edit_script.cpp. Per script these must agree: which edits are accepted, the
text of every edited layer, and the text of the flattened stage after the last edit. An edit that
OpenUSD refuses half-way is taken back on its side: tenon does all of an edit or nothing. PROGRAM
also compares the scene that follows its edits with a new one after each of them,
takes all edits back and does them again, and edits the text of each file, which OpenUSD must
read as the edited layer. Exit 77: no OpenUSD.
"""

import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

from edit_scripts import FILES, LAYERS, Script

try:
    from pxr import Sdf, Tf, Usd
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

# Calls that succeed without an effect where the edit target has no place for the path.
MAY_DO_NOTHING = ("define", "override", "class", "clear_metadata", "clear_value", "clear_values")


class Refused(Exception):
    pass


def typed_value(edit):
    """The value that a text layer would give."""
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(f'#usda 1.0\nover "P" {{\n {edit["type"]} x = {edit["text"]}\n}}\n')
    return layer.GetAttributeAtPath("/P.x").default


def needed(thing):
    if not thing:
        raise Refused
    return thing


class Stage:
    """The edits by OpenUSD."""

    def __init__(self, folder):
        self.folder = folder
        self.refusals = []
        self.held = [Sdf.Layer.FindOrOpen(os.path.join(folder, name)) for name in FILES]
        self.stage = Usd.Stage.Open(os.path.join(folder, "root.usda"), load=Usd.Stage.LoadAll)

    def prim(self, path):
        return needed(self.stage.GetPrimAtPath(Sdf.Path(path).GetPrimPath()))

    def attribute(self, path):
        return self.prim(path).GetAttribute(Sdf.Path(path).name)

    def object(self, path):
        path = Sdf.Path(path)
        if path.IsPropertyPath():
            return needed(self.prim(path).GetProperty(path.name))
        return self.prim(path)

    def layers(self):
        return dict(zip(FILES, self.held))

    def run(self, edit):
        """True when accepted; otherwise nothing has changed."""
        saved = {name: layer.ExportToString() for name, layer in self.layers().items()}
        try:
            if "path" in edit and edit["op"] not in MAY_DO_NOTHING:
                needed(self.stage.GetEditTarget().MapToSpecPath(edit["path"]))
            getattr(self, "do_" + edit["op"])(edit)
            return True
        except Exception as refusal:  # pylint: disable=broad-exception-caught
            self.refusals.append(f"{edit}: {refusal}")
            with Sdf.ChangeBlock():
                for name, layer in self.layers().items():
                    if name in saved and layer.ExportToString() != saved[name]:
                        layer.ImportFromString(saved[name])
            return False

    def do_define(self, edit):
        needed(self.stage.DefinePrim(edit["path"], edit["type"]))

    def do_override(self, edit):
        needed(self.stage.OverridePrim(edit["path"]))

    def do_class(self, edit):
        needed(self.stage.CreateClassPrim(edit["path"]))

    def do_remove(self, edit):
        needed(self.stage.RemovePrim(edit["path"]))

    def do_type_name(self, edit):
        needed(self.prim(edit["path"]).SetTypeName(edit["type"]))

    def do_reorder_children(self, edit):
        self.prim(edit["path"]).SetChildrenReorder(edit["names"])

    def do_reorder_properties(self, edit):
        self.prim(edit["path"]).SetPropertyOrder(edit["names"])

    def do_metadata(self, edit):
        value, key = typed_value(edit), edit.get("key", "")
        if edit["path"] == "/":
            needed(self.stage.SetMetadata(edit["field"], value))
        elif key:
            self.object(edit["path"]).SetMetadataByDictKey(edit["field"], key, value)
        else:
            needed(self.object(edit["path"]).SetMetadata(edit["field"], value))

    def do_clear_metadata(self, edit):
        thing = self.object(edit["path"])
        if edit["key"]:
            thing.ClearMetadataByDictKey(edit["field"], edit["key"])
        else:
            needed(thing.ClearMetadata(edit["field"]))

    def do_apply_api(self, edit):
        needed(self.prim(edit["path"]).ApplyAPI(*edit["schema"].split(":")))

    def do_remove_api(self, edit):
        needed(self.prim(edit["path"]).RemoveAPI(*edit["schema"].split(":")))

    def do_add_schema(self, edit):
        needed(self.prim(edit["path"]).AddAppliedSchema(edit["schema"]))

    def do_remove_schema(self, edit):
        needed(self.prim(edit["path"]).RemoveAppliedSchema(edit["schema"]))

    def do_attribute(self, edit):
        variability = Sdf.VariabilityUniform if edit["uniform"] else Sdf.VariabilityVarying
        type_name = Sdf.ValueTypeNames.Find(edit["type"])
        self.prim(edit["path"]).CreateAttribute(Sdf.Path(edit["path"]).name, type_name,
                                                edit["custom"], variability)

    def do_relationship(self, edit):
        name = Sdf.Path(edit["path"]).name
        self.prim(edit["path"]).CreateRelationship(name, edit["custom"])

    def do_remove_property(self, edit):
        needed(self.prim(edit["path"]).RemoveProperty(Sdf.Path(edit["path"]).name))

    def do_set(self, edit):
        attribute = needed(self.attribute(edit["path"]))
        type_name = Sdf.ValueTypeNames.Find(edit["type"])
        if attribute.GetTypeName().type != type_name.type:
            raise Refused  # Python would convert the value
        time = Usd.TimeCode.Default() if edit["time"] is None else edit["time"]
        needed(attribute.Set(typed_value(edit), time))

    def do_clear_value(self, edit):
        time = Usd.TimeCode.Default() if edit["time"] is None else edit["time"]
        needed(needed(self.attribute(edit["path"])).ClearAtTime(time))

    def do_clear_values(self, edit):
        needed(needed(self.attribute(edit["path"])).Clear())

    def do_block(self, edit):
        needed(self.attribute(edit["path"])).Block()

    def edit_list(self, edit, owner, name, items, plural):
        position = self.position(edit)
        if edit["edit"] == "add":
            needed(getattr(owner, "Add" + name)(items[0], position))
        elif edit["edit"] == "remove":
            needed(getattr(owner, "Remove" + name)(items[0]))
        elif edit["edit"] == "set":
            needed(getattr(owner, "Set" + plural)(items))
        elif plural == "Targets":
            needed(owner.ClearTargets(False))
        else:
            needed(getattr(owner, "Clear" + plural)())

    def do_targets(self, edit):
        owner = needed(self.prim(edit["path"]).GetRelationship(Sdf.Path(edit["path"]).name))
        self.edit_list(edit, owner, "Target", edit["items"], "Targets")

    def do_connections(self, edit):
        self.edit_list(edit, needed(self.attribute(edit["path"])), "Connection", edit["items"],
                       "Connections")

    def arcs(self, edit, kind):
        return [kind(item.get("asset", ""), item.get("prim", ""),
                     Sdf.LayerOffset(item.get("offset", 0.0))) for item in edit["items"]]

    def do_references(self, edit):
        owner = self.prim(edit["path"]).GetReferences()
        self.edit_list(edit, owner, "Reference", self.arcs(edit, Sdf.Reference), "References")

    def do_payloads(self, edit):
        owner = self.prim(edit["path"]).GetPayloads()
        self.edit_list(edit, owner, "Payload", self.arcs(edit, Sdf.Payload), "Payloads")

    def do_inherits(self, edit):
        owner = self.prim(edit["path"]).GetInherits()
        self.edit_list(edit, owner, "Inherit", edit["items"], "Inherits")

    def do_specializes(self, edit):
        owner = self.prim(edit["path"]).GetSpecializes()
        self.edit_list(edit, owner, "Specialize", edit["items"], "Specializes")

    def do_insert_sublayer(self, edit):
        layer = self.stage.GetEditTarget().GetLayer()
        if edit["asset"] in layer.subLayerPaths or edit["index"] > len(layer.subLayerPaths):
            raise Refused
        layer.subLayerPaths.insert(edit["index"], edit["asset"])
        layer.subLayerOffsets[edit["index"]] = Sdf.LayerOffset(edit["offset"])

    def do_remove_sublayer(self, edit):
        layer = self.stage.GetEditTarget().GetLayer()
        del layer.subLayerPaths[edit["index"]]

    def do_variant_set(self, edit):
        needed(self.prim(edit["path"]).GetVariantSets().AddVariantSet(
            edit["set"], self.position(edit)))

    def position(self, edit):
        words = edit["position"].split("_")
        return getattr(Usd, f"ListPosition{words[0].title()}Of{words[1].title()}List")

    def do_variant(self, edit):
        variant_set = self.prim(edit["path"]).GetVariantSet(edit["set"])
        needed(variant_set.AddVariant(edit["variant"], self.position(edit)))

    def do_select(self, edit):
        variant_set = self.prim(edit["path"]).GetVariantSet(edit["set"])
        needed(variant_set.SetVariantSelection(edit["variant"]))

    def do_unselect(self, edit):
        needed(self.prim(edit["path"]).GetVariantSet(edit["set"]).ClearVariantSelection())

    def do_target_layer(self, edit):
        layer = needed(Sdf.Layer.Find(os.path.join(self.folder, edit["layer"])))
        self.stage.SetEditTarget(self.stage.GetEditTargetForLocalLayer(layer))

    def do_target_variant(self, edit):
        self.prim(edit["path"])
        target = self.stage.GetEditTarget()
        path = needed(target.MapToSpecPath(edit["path"]))
        path = path.AppendVariantSelection(edit["set"], edit["variant"])
        self.stage.SetEditTarget(
            Usd.EditTarget.ForLocalDirectVariant(target.GetLayer(), path))

    def do_target_arc(self, edit):
        layer = needed(Sdf.Layer.Find(os.path.join(self.folder, edit["layer"])))
        for node in self.nodes(self.prim(edit["path"]).GetPrimIndex().rootNode):
            if layer in node.layerStack.layers and node.parent and not node.isInert:
                self.stage.SetEditTarget(Usd.EditTarget(layer, node))
                return
        raise Refused

    def nodes(self, node):
        yield node
        for child in node.children:
            yield from self.nodes(child)

    def result(self, results, originals):
        texts = {n: layer.ExportToString() for n, layer in self.layers().items()}
        changed = {n: text for n, text in texts.items() if text != originals[n]}
        again = os.path.join(self.folder, "again")
        os.makedirs(again, exist_ok=True)
        for name, text in texts.items():
            with open(os.path.join(again, name), "w", encoding="utf-8") as file:
                file.write(text)
        # Composed anew, too: not every edit brings OpenUSD's stage to the final order of children;
        # text, however, does not say the type of a variant.
        flats = []
        for stage in (self.stage, None):
            try:
                stage = stage or Usd.Stage.Open(os.path.join(again, "root.usda"))
                flat = stage.Flatten(addSourceFileComment=False).ExportToString()
                flats.append(flat.replace(again, self.folder))
            except Tf.ErrorException:
                pass  # specs that contradict each other
        return {"results": results, "layers": changed, "flats": flats,
                "refusals": self.refusals}


def outcome(program, folder, script):
    """(OpenUSD's, tenon's)"""
    stage = Stage(folder)
    originals = {n: layer.ExportToString() for n, layer in stage.layers().items()}
    results = [stage.run(edit) for edit in script.edits]
    want = stage.result(results, originals)
    path = os.path.join(folder, "script.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"root": os.path.join(folder, "root.usda"), "edits": script.edits}, file)
    run = subprocess.run([program, path], capture_output=True, text=True, timeout=120, check=False)
    if run.returncode != 0:
        return want, {"failed": f"{run.returncode} {run.stderr[-400:]}"}
    return want, json.loads(run.stdout)


def lines_that_differ(want, have):
    a, b = want.split("\n"), have.split("\n")
    for i in range(max(len(a), len(b))):
        x, y = (t[i] if i < len(t) else "<end>" for t in (a, b))
        if x != y:
            return f"line {i + 1}: OpenUSD {x.strip()!r}, tenon {y.strip()!r}"
    return ""


def same_flat(text):
    """Names and order of prototypes are OpenUSD's own matter."""
    text = re.sub(r"Flattened_Prototype_\d+", "Flattened_Prototype", text)
    blocks = text.split("\n\nover \"Flattened_Prototype\"")
    last, _, rest = blocks[-1].partition("\n}\n\n")
    return "\n\n".join(sorted(block.rstrip("}\n") for block in [*blocks[:-1], last]) + [rest])


def difference(want, have, script):
    if "failed" in have:
        return have["failed"]
    for i, (x, y) in enumerate(zip(want["results"], have["results"])):
        if x != (y is True):
            return f"edit {i} {json.dumps(script.edits[i])}: OpenUSD {x}, tenon {y}"
    for name in sorted(set(want["layers"]) | set(have["layers"])):
        if name not in have["layers"] or name not in want["layers"]:
            side = "OpenUSD" if name in want["layers"] else "tenon"
            return f"{name} is edited only by {side}"
        if want["layers"][name] != have["layers"][name]:
            return f"{name} {lines_that_differ(want['layers'][name], have['layers'][name])}"
    for name, edited in have["edited"].items():
        layer = Sdf.Layer.CreateAnonymous(".usda")
        if not layer.ImportFromString(edited["text"]):
            return f"{name}: OpenUSD cannot read the edited text"
        if layer.ExportToString() != have["layers"][name]:
            again = lines_that_differ(have["layers"][name], layer.ExportToString())
            return f"{name} edited in its text {again}"
    if "astray" in have:
        return f"the scene that follows the edits is another one after {have['astray']}"
    if not have["history"]:
        return "undo or redo lead elsewhere"
    flats, flat = [same_flat(text) for text in want["flats"]], same_flat(have["flat"])
    if flats and flat not in flats:
        return "stage " + lines_that_differ(flats[-1], flat)
    return ""


def check_script(arguments, seed):
    with tempfile.TemporaryDirectory() as temporary:
        folder = os.path.realpath(temporary)
        if arguments.keep:
            folder = os.path.realpath(os.path.join(arguments.keep, f"script{seed}"))
            os.makedirs(folder, exist_ok=True)
        for name, text in LAYERS.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        script = Script(seed, arguments.edits)
        want, have = outcome(arguments.program, folder, script)
        if arguments.keep:
            for side, result in (("openusd", want), ("tenon", have)):
                with open(os.path.join(folder, side + ".json"), "w", encoding="utf-8") as file:
                    json.dump(result, file, indent=1)
        kept = [edited["kept"] for edited in have.get("edited", {}).values()]
        return difference(want, have, script), sum(want["results"]), kept


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--scripts", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--edits", type=int, default=60)
    parser.add_argument("--keep")
    parser.add_argument("-v", action="store_true")
    arguments = parser.parse_args()
    if not arguments.v:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # OpenUSD's warnings
    different, accepted, kept = 0, 0, []
    for seed in range(arguments.seed, arguments.seed + arguments.scripts):
        found, count, layouts = check_script(arguments, seed)
        accepted += count
        kept += layouts
        if found:
            different += 1
            print(f"script {seed}: {found}")
    print(f"{arguments.scripts - different} scripts equal, {different} differ; "
          f"{accepted} of {arguments.scripts * arguments.edits} edits accepted; "
          f"{sum(kept)} of {len(kept)} edited texts kept their layout")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
