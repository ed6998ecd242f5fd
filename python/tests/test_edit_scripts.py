# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Random edits by Python and the same by usd-core's pxr: the composed stage is the same.

Each edit goes to the root layer on both sides. What tenon refuses (a schema that does not fit, a
name that is taken, an opinion that would not count) pxr does not get; most are not refused. Blocks
that raise, and blocks that are undone, are nothing to pxr.
"""

import importlib.util
import random
import unittest
import warnings

import support

import tenon_usd as tenon

SCRIPTS, EDITS, LEAST = 24, 40, 0.5
ROOT = '''#usda 1.0
(
    defaultPrim = "A"
    subLayers = [@./sub.usda@ (offset = 10; scale = 2)]
)
def Xform "A"
{
    custom double m = 0
    def Cube "B"
    {
        custom double x = 1
        custom double y = 2
    }
    def Sphere "C"
    {
    }
    def Xform "D"
    {
    }
}
def Scope "K"
{
    custom int k = 1
}
'''
SUB = '''#usda 1.0
over "A"
{
    over "B"
    {
        custom double x.timeSamples = { 0: 1, 5: 2 }
        custom string s = "weak"
    }
}
'''
REF = '''#usda 1.0
(
    defaultPrim = "M"
)
def Sphere "M" (
    kind = "component"
    customData = {
        int a = 1
    }
)
{
    double radius.timeSamples = { 0: 2, 8: 4 }
    def Xform "N"
    {
    }
}
'''
PRIMS = ("/A", "/A/B", "/A/C", "/A/D", "/K")
TEXTS = ("documentation", "displayName", "comment")
VARIANTS = ("red", "blue")


class Pxr:
    """The same edits, by pxr."""

    def __init__(self, path):
        from pxr import Gf, Sdf, Usd

        self.Gf, self.Sdf, self.Usd = Gf, Sdf, Usd
        self.stage = Usd.Stage.Open(str(path))

    def prim(self, path):
        return self.stage.GetPrimAtPath(path)

    def set(self, path, name, value, time):
        when = self.Usd.TimeCode.Default() if time is None else self.Usd.TimeCode(time)
        attribute = self.prim(path).GetAttribute(name)
        if not attribute:
            attribute = self.prim(path).CreateAttribute(name, self.Sdf.ValueTypeNames.Double)
        attribute.Set(value, when)

    def clear_sample(self, path, name, time):
        self.prim(path).GetAttribute(name).ClearAtTime(time)

    def metadata(self, path, field, value, key):
        if key:
            self.prim(path).SetMetadataByDictKey(field, key, value)
        else:
            self.prim(path).SetMetadata(field, value)

    def clear_metadata(self, path, field):
        self.prim(path).ClearMetadata(field)

    def of_property(self, path, name, value):
        self.prim(path).GetAttribute(name).SetMetadata("documentation", value)

    def define(self, path, kind):
        self.stage.DefinePrim(path, kind)

    def rename(self, path, name):
        editor = self.Usd.NamespaceEditor(self.stage)
        editor.RenamePrim(self.prim(path), name)
        assert editor.ApplyEdits()

    def remove(self, path):
        self.stage.RemovePrim(path)

    def variant(self, path, variant):
        self.prim(path).GetVariantSets().AddVariantSet("look").AddVariant(variant)

    def select(self, path, variant):
        found = self.prim(path).GetVariantSet("look")
        found.ClearVariantSelection() if variant is None else found.SetVariantSelection(variant)

    def inside(self, path, variant, name, value):
        found = self.prim(path).GetVariantSets().AddVariantSet("look")
        found.AddVariant(variant)
        session = self.stage.GetSessionLayer()
        with self.Usd.EditContext(self.stage, session):
            found.SetVariantSelection(variant)
        root = self.stage.GetRootLayer()
        place = self.Sdf.Path(path).AppendVariantSelection("look", variant)
        with self.Usd.EditContext(self.stage,
                                  self.Usd.EditTarget.ForLocalDirectVariant(root, place)):
            self.set(path, name, value, None)
        session.Clear()

    def arc(self, path, kind, file, prim, offset, scale, first):
        where = (self.Usd.ListPositionFrontOfPrependList if first
                 else self.Usd.ListPositionBackOfPrependList)
        arcs = getattr(self.prim(path), "GetReferences" if kind == "reference" else "GetPayloads")()
        move = self.Sdf.LayerOffset(offset, scale)
        add = arcs.AddReference if kind == "reference" else arcs.AddPayload
        add("./" + file, prim or self.Sdf.Path(), move, position=where)

    def inherit(self, path, to):
        self.prim(path).GetInherits().AddInherit(to)

    def order(self, path, names):
        self.prim(path).SetChildrenReorder(names)

    def api(self, path, name, on):
        schema = self.prim(path)
        schema.AddAppliedSchema(name) if on else schema.RemoveAppliedSchema(name)

    def type_name(self, path, kind):
        self.prim(path).SetTypeName(kind)

    def connect(self, path, name, to):
        self.prim(path).GetAttribute(name).SetConnections([to])

    def flat(self):
        return self.stage.Flatten().ExportToString()


class Tenon:
    """The same by tenon_usd."""

    def __init__(self, path):
        self.folder = path.parent
        self.stage = tenon.open(path)
        self.layer = {"layer": path.name}

    def set(self, path, name, value, time):
        self.stage[path].set(name, value, time=time, type_name="double", **self.layer)

    def clear_sample(self, path, name, time):
        self.stage[path].clear(name, time=time, **self.layer)

    def metadata(self, path, field, value, key):
        self.stage[path].set_metadata(field, value, key=key, **self.layer)

    def clear_metadata(self, path, field):
        self.stage[path].clear_metadata(field, **self.layer)

    def of_property(self, path, name, value):
        self.stage[path].set_metadata("documentation", value, property=name, **self.layer)

    def define(self, path, kind):
        self.stage.define(path, kind)

    def rename(self, path, name):
        self.stage[path].rename(name)

    def remove(self, path):
        self.stage[path].remove()

    def variant(self, path, variant):
        self.stage[path].add_variant("look", variant)

    def select(self, path, variant):
        self.stage[path].select_variant("look", variant, **self.layer)

    def inside(self, path, variant, name, value):
        with self.stage.in_variant(path, "look", variant):
            self.set(path, name, value, None)

    def arc(self, path, kind, file, prim, offset, scale, first):
        call = getattr(self.stage[path], f"add_{kind}")
        call(self.folder / file, prim, offset=offset, scale=scale, first=first, **self.layer)

    def inherit(self, path, to):
        self.stage[path].add_inherit(to, **self.layer)

    def order(self, path, names):
        self.stage[path].reorder(names, **self.layer)

    def api(self, path, name, on):
        self.stage[path].apply(name) if on else self.stage[path].unapply(name)

    def type_name(self, path, kind):
        self.stage[path].set_type(kind, **self.layer)

    def connect(self, path, name, to):
        self.stage[path].connect(name, to, **self.layer)

    def flat(self):
        return self.stage.flatten()


class Script:
    """Edits of a seed: calls and their arguments."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        makers = [getattr(self, name) for name in sorted(dir(self)) if name.startswith("make_")]
        self.edits = [maker() for maker in self.random.choices(makers, k=EDITS)]

    def one(self, *items):
        return self.random.choice(items)

    def prim(self):
        return self.one(*PRIMS)

    def make_set(self):
        return "set", self.prim(), self.one("x", "y", "z"), self.one(1.5, -2.0), None

    def make_sample(self):
        time = float(self.one(0, 10, 24))
        prim = self.one("/A/B", self.prim())
        return "set", prim, self.one("x", "y"), self.one(0.5, 8.0), time

    def make_clear_sample(self):
        return "clear_sample", "/A/B", self.one("x", "y"), float(self.one(0, 10, 24))

    def make_metadata(self):
        field, value = self.one(*((text, self.one("a b", 'q"q\n')) for text in TEXTS),
                                ("kind", "group"), ("hidden", True), ("active", True),
                                ("instanceable", False), ("customData", {"u": 2, "v": {"w": "x"}}))
        return "metadata", self.prim(), field, value, ""

    def make_key(self):
        field, key = self.one("customData", "assetInfo"), self.one("a", "b:c", "b:d")
        return "metadata", self.prim(), field, self.one(3, 0.25, "t"), key

    def make_clear_metadata(self):
        return "clear_metadata", self.prim(), self.one("customData", "kind", *TEXTS)

    def make_of_property(self):
        return "of_property", "/A/B", self.one("x", "y"), self.one("u", "w")

    def make_define(self):
        path = self.one("/A", "/K") + "/" + self.one("N1", "N2")
        return "define", path, self.one("Xform", "Cube", "")

    def make_rename(self):
        return "rename", self.one("/A", "/K") + "/" + self.one("N1", "N2"), self.one("N2", "N3")

    def make_remove(self):
        return "remove", self.one("/A", "/K") + "/" + self.one("N1", "N2", "N3")

    def make_variant(self):
        return "variant", self.prim(), self.one(*VARIANTS)

    def make_select(self):
        return "select", self.prim(), self.one(*VARIANTS, None)

    def make_inside(self):
        return "inside", self.prim(), self.one(*VARIANTS), self.one("z", "t"), self.one(4.0, 6.0)

    def make_arc(self):
        prim, kind = self.one("/A/C", "/A/D", "/K"), self.one("reference", "payload")
        inside, offset, scale = self.one(None, "/M", "/M/N"), self.one(0.0, 7.0), self.one(1.0, 2.0)
        return "arc", prim, kind, "ref.usda", inside, offset, scale, self.one(True, False)

    def make_inherit(self):
        return "inherit", self.one("/A/C", "/A/D"), "/K"

    def make_order(self):
        names = ["B", "C", "D"]
        self.random.shuffle(names)
        return "order", "/A", names

    def make_api(self):
        return "api", self.prim(), self.one("PhysicsMassAPI", "PhysicsRigidBodyAPI",
                                            "PhysicsCollisionAPI"), self.one(True, True, False)

    def make_type_name(self):
        return "type_name", self.prim(), self.one("Cube", "Sphere", "Xform")

    def make_connect(self):
        return "connect", "/A/B", self.one("x", "y"), self.one("/K.k", "/A/B.x")


@unittest.skipUnless(importlib.util.find_spec("pxr"), "no pxr")
class EditScripts(support.FilesTestCase):
    def sides(self, seed):
        made = []
        for side in (Pxr, Tenon):
            folder = self.folder / f"{seed}{side.__name__}"
            folder.mkdir()
            for name, text in (("sub.usda", SUB), ("ref.usda", REF), ("root.usda", ROOT)):
                (folder / name).write_text(text)
            made.append(side(folder / "root.usda"))
        return made

    def plain(self, text):
        """Without what tells where it was made, and lists of schemas with nothing in them: what
        tenon applied and takes away it does not mention any more."""
        from pxr import Sdf

        layer = Sdf.Layer.CreateAnonymous(".usda")
        self.assertTrue(layer.ImportFromString(text))
        layer.pseudoRoot.ClearInfo("documentation")

        def visit(path):
            spec = layer.GetPrimAtPath(path) if path.IsPrimPath() else None
            if spec and not spec.GetInfo("apiSchemas").GetAppliedItems():
                spec.ClearInfo("apiSchemas")

        layer.Traverse("/", visit)
        return layer.ExportToString()

    def run_script(self, seed):
        theirs, ours = self.sides(seed)
        chance, done = random.Random(seed + 1000), []
        for number, (call, *given) in enumerate(Script(seed).edits):
            fate = chance.random()
            try:
                with ours.stage.edits():
                    getattr(ours, call)(*given)
                    if fate < 0.15:
                        ours.set("/A", "m", number + 1.0, None)
                    if fate < 0.07:
                        raise ZeroDivisionError
            except (tenon.Error, ZeroDivisionError):
                continue
            if fate < 0.15:
                self.assertTrue(ours.stage.undo())
                continue
            done.append((call, *given))
            getattr(theirs, call)(*given)
            if number % 8 == 7:
                self.assertEqual(self.plain(ours.flat()), self.plain(theirs.flat()), done)
        self.assertEqual(self.plain(ours.flat()), self.plain(theirs.flat()), done)
        ours.stage.save()
        again = tenon.open(ours.folder / "root.usda").flatten()
        self.assertEqual(self.plain(again), self.plain(theirs.flat()))
        return {call for call, *_ in done}, len(done)

    def test_the_composed_stage_is_the_same(self):
        calls, count = set(), 0
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            for seed in range(SCRIPTS):
                with self.subTest(seed=seed):
                    made, edits = self.run_script(seed)
                    calls |= made
                    count += edits
        self.assertGreater(count, LEAST * SCRIPTS * EDITS)
        self.assertEqual(calls, {name for name in vars(Tenon)
                                 if not name.startswith("_")} - {"flat"})


if __name__ == "__main__":
    support.main()
