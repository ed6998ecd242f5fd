# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Random scenes of several layers, made from a seed: the same seed, the same text.

A scene is lists and dicts, so that it can be cut down piece by piece:
    scene = {"layers": [layer...], "options": {...}}
    layer = {"name": file name, "meta": [line...], "prims": [prim...]}
    prim = {"head": text, "meta": [line...], "props": [line...], "kids": [prim...],
            "sets": [{"name": set, "variants": [prim...]}...]}

Arcs lead to layers further down the list, or within a layer to roots further down the alphabet;
classes lead to classes further down only. So few scenes have cycles or grow without bound; the
family `cycles` is free of this rule.
"""

import copy
import random

ROOTS = ("A", "B", "C", "D", "E")
CLASSES = ("_c", "_d", "_e")
KIDS = ("x", "y", "z")
SETS = ("v", "w")
VARIANTS = ("a", "b", "c")

# Chances of what a prim or layer has; a family changes some of them.
BASE = {
    "layers": (2, 4), "roots": (1, 3), "kids": 0.5, "depth": 2, "sublayers": 0.5, "offset": 0.25,
    "rate": 0.2, "references": 0.22, "payload": 0.06, "inherits": 0.16, "specializes": 0.08,
    "sets": 0.12, "selection": 0.12, "instanceable": 0.08, "relocates": 0.12, "edits": 0.25,
    "props": 0.7, "samples": 0.25, "targets": 0.3, "meta": 0.2, "expressions": 0.06,
    "session": 0.08, "muted": 0.03, "wild": 0.06, "fallbacks": 0.2, "nested_sets": 0.2,
    "load": 0.1, "internal": 0.3, "subroot": 0.35, "any_order": 0.02, "inactive": 0.02,
    "opinions": 0.5,
}
FAMILIES = {
    "mixed": {},
    "references": {"references": 0.45, "offset": 0.4, "sublayers": 0.6, "sets": 0.04},
    "classes": {"inherits": 0.4, "references": 0.3, "subroot": 0.5, "sets": 0.05},
    "specializes": {"specializes": 0.35, "inherits": 0.15, "references": 0.25, "sets": 0.05},
    "variants": {"sets": 0.35, "selection": 0.35, "nested_sets": 0.4, "fallbacks": 0.5,
                 "references": 0.25},
    "relocates": {"relocates": 0.7, "references": 0.4, "sets": 0.08, "kids": 0.7},
    "instances": {"instanceable": 0.4, "references": 0.45, "sets": 0.12, "selection": 0.2},
    "payloads": {"payload": 0.3, "load": 0.7},
    "values": {"samples": 0.7, "offset": 0.5, "rate": 0.4, "meta": 0.6, "sublayers": 0.8,
               "targets": 0.5},
    "expressions": {"expressions": 0.6, "sets": 0.2, "selection": 0.25, "references": 0.35},
    "edits": {"edits": 0.8, "sublayers": 0.9, "layers": (3, 5), "opinions": 0.8},
    "session": {"session": 1.0, "muted": 0.4, "sets": 0.15},
    "cycles": {"any_order": 0.5, "wild": 0.3, "layers": (1, 3), "roots": (2, 3)},
}
WEIGHTS = {"mixed": 5, "cycles": 1}
# Seeds above this one draw more kinds of things; those up to it stay the scenes that they were.
WIDE_SEEDS = 100_000
WIDE = {
    "relocates": 0.3, "expressions": 0.15, "sets": 0.15, "nested_sets": 0.25, "selection": 0.25,
    "odd_scale": 0.15, "permission": 0.08, "deep_sets": 0.3,
}
EXPRESSIONS = (
    '`"./l${NUMBER}.usda"`', '`if(eq(${SEL}, "a"), "./l1.usda", "./${LAYER}.usda")`',
    '`if(contains(["l1", "l2"], ${LAYER}), "./${LAYER}.usda")`', '`"./${LAYER}.${TYPE}"`',
    '`if(defined("NUMBER", "SEL"), "./l2.usda", "./l1.usda")`', '`at(["./l1.usda"], 1)`',
    '`"./absent${SEL}.usda"`', '`""`', '`None`', "`${SEL`",
)


def family_of(seed):
    names = [name for name in FAMILIES for _ in range(WEIGHTS.get(name, 2))]
    return names[seed % len(names)]


class Generator:
    """Layers are made from the last one to the first, roots from the end of the alphabet on: what
    an arc leads to is known when the arc is made."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.chances = dict(BASE, **FAMILIES[family_of(seed)])
        self.wide = seed > WIDE_SEEDS
        if self.wide:
            self.chances.update({what: max(chance, self.chances.get(what, 0))
                                 for what, chance in WIDE.items()})
        self.count = self.random.randint(*self.chances["layers"])
        self.known = [[] for _ in range(self.count + 1)]  # prim paths of each layer
        self.used = {}  # (path, field) -> items authored so far, for deletes
        self.at = 0  # the layer being made
        self.variants = 0  # around the prim being made

    def has(self, what):
        return self.random.random() < self.chances[what]

    def chance(self, probability):
        return self.random.random() < probability

    def pick(self, items):
        return self.random.choice(items)

    # ----- the scene

    def scene(self):
        layers = [self.layer(i) for i in range(self.count - 1, -1, -1)][::-1]
        options = {}
        if self.has("session"):
            layers.append(self.session_layer())
            options["session"] = layers[-1]["name"]
        if self.has("muted") and self.count > 1:
            options["muted"] = [f"l{self.random.randint(1, self.count - 1)}.usda"]
        if self.has("fallbacks"):
            options["fallbacks"] = {name: self.random.sample(VARIANTS, 2) for name in SETS}
        if self.has("load"):
            options["load"] = self.load_rules()
        return {"layers": layers, "options": options}

    def load_rules(self):
        if self.chance(0.5):
            return {"none": True}
        paths = sorted({self.pick(self.known[0] or ["/A"]) for _ in range(2)})
        return {"none": True, "loaded": paths}

    def session_layer(self):
        self.at = self.count
        layer = {"name": "session.usda", "meta": [], "prims": []}
        if self.has("rate"):
            layer["meta"].append(f"timeCodesPerSecond = {self.pick((24, 48))}")
        for name in sorted(self.random.sample(ROOTS, 2)):
            layer["prims"].append(self.prim(name, "/" + name, 1))
        if self.has("expressions"):
            layer["meta"].append(self.variables())
        return layer

    def layer(self, i):
        self.at = i
        names = sorted(self.random.sample(ROOTS, self.random.randint(*self.chances["roots"])))
        names += sorted(self.random.sample(CLASSES, self.random.randint(0, 2)))
        prims = [self.prim(name, "/" + name, 0) for name in reversed(names)][::-1]
        return {"name": f"l{i}.usda", "meta": self.layer_meta(i, names), "prims": prims}

    def layer_meta(self, i, names):
        meta = []
        deeper = list(range(i + 1, self.count))
        if deeper and self.has("sublayers"):
            # the next one first: what a shrunk stack of layers hides is rarely further down
            count = 2 if len(deeper) > 1 and self.chance(0.35) else 1
            chosen = deeper[:count] if self.chance(0.6) else self.random.sample(deeper, count)
            items = [self.sublayer(j) for j in chosen]
            meta.append(f"subLayers = [{', '.join(items)}]")
            for j in chosen:
                self.known[i] += self.known[j]
        if self.has("rate"):
            meta.append(f"timeCodesPerSecond = {self.pick((24, 48, 12))}")
        if self.has("rate"):
            meta.append(f"framesPerSecond = {self.pick((24, 30))}")
        if self.chance(0.75):
            meta.append(f'defaultPrim = "{self.pick(names)}"')
        if self.has("relocates"):
            pairs = self.relocates(names)
            if pairs:
                meta.append("relocates = {" + ", ".join(pairs) + "}")
        if self.has("expressions"):
            meta.append(self.variables())
        return meta

    def variables(self):
        layer = self.random.randint(0, self.count)  # one too many at times
        names = {"LAYER": f"l{layer}", "SEL": self.pick(VARIANTS)}
        if self.wide:
            names.update({"NUMBER": str(self.random.randint(1, self.count)), "TYPE": "usda"})
        chosen = self.random.sample(sorted(names), self.random.randint(1, 3 if self.wide else 2))
        words = "; ".join(f'string {name} = "{names[name]}"' for name in chosen)
        return f"expressionVariables = {{ {words} }}"

    def sublayer(self, j):
        path = '`"./${LAYER}.usda"`' if self.chance(self.chances["expressions"] / 4) \
            else f"./l{j}.usda"
        return f"@{path}@{self.offset()}"

    def offset(self):
        if not self.has("offset"):
            return ""
        if self.has("wild") and self.chance(0.2):
            return f" (scale = {self.pick((0, -1))})"
        if self.wide and self.has("odd_scale"):
            return f" (offset = {self.pick((0, 3))}; scale = {self.pick((0, -1, -0.5, 1e-3, 1e9))})"
        offset, scale = self.pick((0, 1, 2.5, -3)), self.pick((1, 2, 0.5))
        words = [f"offset = {offset}"] * (offset != 0) + [f"scale = {scale}"] * (scale != 1)
        return f" ({'; '.join(words)})" if words else ""

    def relocates(self, names):
        pairs = {}
        for _ in range(self.random.randint(1, 3)):
            root = self.pick(names)
            source = f"/{root}/{self.pick(KIDS)}"
            if self.chance(0.25):
                source += "/" + self.pick(KIDS)
            target = self.pick((f"/{root}/q", f"/{root}/r", f"/{root}/{self.pick(KIDS)}/q",
                                f"/{root}/{self.pick(KIDS)}"))
            if self.has("wild"):
                target = self.pick((f"/{self.pick(ROOTS)}/q", "/" + self.pick(ROOTS), source))
            wrong = target == source or target.startswith(source + "/")
            if not wrong or self.has("wild"):
                pairs[source] = "" if self.chance(0.08) else target
        return [f"<{source}>: <{target}>" for source, target in pairs.items()]

    # ----- prims

    def prim(self, name, path, depth):
        kind = "class" if name.startswith("_") else self.pick(("def", "def", "over"))
        type_name = self.pick(("", "Xform", "Scope")) if kind != "over" else ""
        head = f'{kind} {type_name} "{name}"'.replace("  ", " ")
        return self.filled({"head": head}, path, depth)

    def filled(self, prim, path, depth, sets=True, scope=None):
        """`path` is where the prim is in namespace; `scope` the variants that it is in."""
        prim.update({"meta": [], "props": [], "kids": [], "sets": []})
        self.add_kids(prim, path, depth)
        if sets and self.has("sets"):
            self.add_sets(prim, path, depth)
        self.add_arcs(prim, path)
        self.add_meta(prim, path)
        self.add_props(prim, path)
        if scope is None:
            self.known[self.at].append(path)
        return prim

    def add_kids(self, prim, path, depth):
        if depth >= self.chances["depth"]:
            return
        names = list(KIDS) + ["_k"] * (depth == 0)
        for name in sorted(names):
            if self.chance(self.chances["kids"] / (1 + depth) * 0.75):
                prim["kids"].append(self.prim(name, f"{path}/{name}", depth + 1))

    def add_sets(self, prim, path, depth):
        names = list(SETS) if self.chance(0.25) else [self.pick(SETS)]
        for name in names:
            self.add_set(prim, path, depth, name)
        word = self.pick(("prepend ", "append ", "", "prepend "))
        prim["meta"].append(word + "variantSets = [" + ", ".join(f'"{n}"' for n in names) + "]")

    def add_set(self, prim, path, depth, name):
        variants = []
        self.variants += 1
        for variant in self.random.sample(VARIANTS, self.random.randint(1, 2)):
            filled = self.filled({"head": f'"{variant}"'}, path, depth + 1, False, variant)
            others = [other for other in SETS if other != name]
            if self.wide and self.variants == 1 and self.has("deep_sets"):
                self.add_kid_with_set(filled, path, depth + 1)
            if self.has("nested_sets"):
                self.add_set(filled, path, depth + 1, others[0])
                filled["meta"].append(f'prepend variantSets = "{others[0]}"')
            variants.append(filled)
        self.variants -= 1
        prim["sets"].append({"name": name, "variants": variants})

    def add_kid_with_set(self, variant, path, depth):
        """A child within a variant that has variants itself."""
        name = self.pick(KIDS)
        if all(f'"{name}"' not in kid["head"] for kid in variant["kids"]):
            kid = self.filled({"head": f'def "{name}"'}, f"{path}/{name}", 2, False, "inner")
            self.add_sets(kid, f"{path}/{name}", depth + 1)
            variant["kids"].append(kid)

    # ----- arcs

    def later(self, root):
        """Names of roots that something below `root` may lead to."""
        if self.has("any_order"):
            return list(ROOTS + CLASSES)
        return [name for name in ROOTS + CLASSES if name > root]

    def path_in(self, layer, roots):
        """A prim path of a layer, mostly one that is there; None when there are no roots."""
        if not roots:
            return None
        paths = [p for p in self.known[layer] if p.split("/")[1] in roots]
        if not self.has("subroot"):
            paths = [p for p in paths if p.count("/") == 1]
        if paths and not self.has("wild"):
            return self.pick(paths)
        path = "/" + self.pick(roots)
        return path + "/" + self.pick(KIDS) if self.has("subroot") else path

    def asset(self, path):
        root = path.split("/")[1]
        deeper = range(self.at + 1, self.count)
        if self.at == self.count:
            deeper = range(1, self.count)
        if self.has("any_order"):
            deeper = range(self.count)
        if self.has("internal") or not deeper:
            target = self.path_in(min(self.at, self.count - 1), self.later(root))
            return target and f"<{target}>{self.offset()}"
        layer = self.pick(deeper)
        name = f"./l{layer}.usda"
        if self.chance(self.chances["expressions"] / 2):
            name = self.pick(('`"./${LAYER}.usda"`', '`if(defined("LAYER"), "l1.usda")`'))
            if self.wide and self.chance(0.7):
                name = self.pick(EXPRESSIONS)
        if self.has("wild") and self.chance(0.2):
            name = "./absent.usda"
        # classes apply wherever they are implied: what they lead to must not lead back
        roots = self.later(root) if root in CLASSES else ROOTS + CLASSES
        if self.chance(0.12) and root not in CLASSES:
            return f"@{name}@{self.offset()}"
        target = self.path_in(layer, roots)
        return target and f"@{name}@<{target}>{self.offset()}"

    def class_path(self, path):
        names = path.split("/")[1:]
        if len(names) > 1 and self.chance(0.6):
            # a sibling further down the alphabet, or a class at the side of some ancestor
            level = self.random.randint(1, len(names) - 1)
            above = "/" + "/".join(names[:level])
            later = [n for n in KIDS + ("_k",) * (level == 1) if n > names[level]]
            if "_k" not in names and self.chance(0.4):
                return "/" + names[0] + "/_k"
            if later:
                return above + "/" + self.pick(later)
        layer = self.random.randint(min(self.at, self.count - 1), self.count - 1)
        classes = [name for name in self.later(names[0]) if name in CLASSES]
        if self.chance(0.5) and classes:
            return "/" + self.pick(classes)
        return self.path_in(layer, self.later(names[0]))

    def add_arcs(self, prim, path):
        def to_class(at):
            target = self.class_path(at)
            return target and f"<{target}>"
        rarer = (1, 0.7, 0.4, 0.3, 0.3)[path.count("/") - 1]  # what is deep multiplies
        for field, make in (("references", self.asset), ("payload", self.asset),
                            ("inherits", to_class), ("specializes", to_class)):
            if self.has(field) and self.chance(rarer):
                self.add_list(prim["meta"], path, field, make)
        if self.has("instanceable"):
            prim["meta"].append(f"instanceable = {self.pick(('true', 'true', 'false'))}")
        if self.has("selection"):
            self.add_selections(prim)

    def add_selections(self, prim):
        words = []
        for name in SETS if self.chance(0.3) else [self.pick(SETS)]:
            variant = self.pick(VARIANTS[:2] + VARIANTS)
            if self.has("expressions"):
                variant = self.pick(("`${SEL}`", "`if(defined('SEL'), ${SEL}, 'b')`"))
            words.append(f'string {name} = "{variant}"')
        prim["meta"].append(f"variants = {{ {'; '.join(words)} }}")

    def add_list(self, lines, path, field, make, prefix=""):
        """List edits of one field: one explicit list or one to three edits."""
        used = self.used.setdefault((path, field), [])
        kinds = ["prepend"]
        if self.has("edits"):
            kinds = self.random.sample(("prepend", "append", "delete"), self.random.randint(1, 3))
            if self.chance(0.2):
                kinds = [""]
        for kind in kinds:
            items = [make(path) for _ in range(1 if self.chance(0.75) else 2)]
            if used and (kind == "delete" or self.has("edits")):
                items = [self.pick(used) if self.chance(0.7) else item for item in items]
            items = [item for item in dict.fromkeys(items) if item]
            if not items:
                continue
            used += items
            lines.append(f"{kind} {prefix}{field} = [{', '.join(items)}]".strip())

    # ----- metadata and properties

    def add_meta(self, prim, path):
        if self.has("inactive"):
            prim["meta"].append("active = false")
        if self.wide and self.has("permission"):
            prim["meta"].append(f"permission = {self.pick(('private', 'private', 'public'))}")
        if not self.has("meta"):
            return
        lines = (
            f'kind = "{self.pick(("component", "group", "subcomponent", "assembly"))}"',
            f'documentation = "{self.at}{path}"',
            f"hidden = {self.pick(('true', 'false'))}",
            f'customData = {{ int {self.pick("ab")} = {self.at}; '
            f'dictionary d = {{ string {self.pick("ab")} = "{self.at}" }} }}',
            f'{self.pick(("prepend ", "append ", "delete ", ""))}apiSchemas = '
            f'["{self.pick(("FirstAPI", "SecondAPI", "ThirdAPI"))}"]',
            f'assetInfo = {{ string name = "{self.at}" }}',
        )
        prim["meta"] += self.random.sample(lines, self.random.randint(1, 2))

    def add_props(self, prim, path):
        if not self.has("props"):
            return
        for add in (self.value, self.samples, self.targets, self.connection, self.odd):
            add(prim, path)

    def value(self, prim, path):
        if self.has("opinions"):
            value = "None" if self.chance(0.04) else str(self.random.randint(0, 99))
            meta = f' (customData = {{ int k{self.pick("ab")} = {self.at} }})' \
                if self.has("meta") else ""
            prim["props"].append(f"double a = {value}{meta}")
        if self.chance(0.15):
            prim["props"].append(f'{self.pick(("custom ", ""))}uniform token b = "{self.at}{path}"')

    def samples(self, prim, _path):
        if not self.has("samples"):
            return
        times = sorted(self.random.sample(range(-5, 40), self.random.randint(1, 4)))
        pairs = ", ".join(f"{t}: {self.random.randint(0, 99)}" for t in times)
        if self.chance(0.08):
            pairs += f", {times[-1] + 1}: None"
        prim["props"].append(f"double t.timeSamples = {{{pairs}}}")
        if self.chance(0.2):
            prim["props"].append(f"timecode tc = {times[0]}")

    def target(self, path):
        root = "/" + path.split("/")[1]
        inside = [p for p in self.known[min(self.at, self.count)] if p.startswith(root)]
        target = self.pick(inside) if inside and self.chance(0.7) else \
            root + "/" + self.pick(KIDS)
        if self.chance(0.12):
            target = "/" + self.pick(ROOTS)
        if self.chance(0.1) and self.variants == 0:
            target = "../" + self.pick(KIDS)
        return target

    def targets(self, prim, path):
        if self.has("targets"):
            def make(at):
                return f"<{self.target(at)}{self.pick(('', '', '.a'))}>"
            self.add_list(prim["props"], path, "to", make, "rel ")

    def connection(self, prim, path):
        if self.has("targets") and self.chance(0.5):
            self.add_list(prim["props"], path, "a.connect",
                          lambda at: f"<{self.target(at)}.{self.pick('at')}>", "double ")

    def odd(self, prim, _path):
        if self.has("wild") and self.chance(0.3):
            prim["props"].append(self.pick(("rel a", "string a = \"odd\"", "rel t")))
            prim["props"] = prim["props"][-1:]


def make_scene(seed):
    return Generator(seed).scene()


# ----- text

def prim_text(prim, indent=""):
    inner = indent + "    "
    text = indent + prim["head"]
    if prim["meta"]:
        text += " (\n" + "".join(f"{inner}{line}\n" for line in prim["meta"]) + indent + ")"
    text += "\n" + indent + "{\n" + "".join(f"{inner}{line}\n" for line in prim["props"])
    text += "".join(prim_text(kid, inner) for kid in prim["kids"])
    for variant_set in prim["sets"]:
        text += f'{inner}variantSet "{variant_set["name"]}" = {{\n'
        text += "".join(prim_text(v, inner + "    ") for v in variant_set["variants"])
        text += inner + "}\n"
    return text + indent + "}\n"


def layer_text(layer):
    text = "#usda 1.0\n"
    if layer["meta"]:
        text += "(\n" + "".join(f"    {line}\n" for line in layer["meta"]) + ")\n"
    return text + "\n" + "".join(prim_text(prim) for prim in layer["prims"])


def texts(scene):
    """{file name: text}"""
    return {layer["name"]: layer_text(layer) for layer in scene["layers"]}


# ----- cutting down

def _lists(scene):
    """Every list whose items a scene can do without, large pieces first."""
    open_prims = []
    yield scene["layers"]
    for layer in scene["layers"]:
        yield layer["prims"]
        open_prims += layer["prims"]
    while open_prims:
        prim = open_prims.pop(0)
        yield prim["sets"]
        yield prim["kids"]
        for variant_set in prim["sets"]:
            yield variant_set["variants"]
            open_prims += variant_set["variants"]
        open_prims += prim["kids"]
        yield prim["props"]
        yield prim["meta"]
    for layer in scene["layers"]:
        yield layer["meta"]


def _sets(scene):
    open_prims = [prim for layer in scene["layers"] for prim in layer["prims"]]
    while open_prims:
        prim = open_prims.pop()
        open_prims += prim["kids"]
        for variant_set in prim["sets"]:
            yield variant_set
            open_prims += variant_set["variants"]


def _cut(scene, k, first, last):
    """A copy without some items of its list number k."""
    cut = copy.deepcopy(scene)
    items = next(items for j, items in enumerate(_lists(cut)) if j == k)
    names = [item["name"] for item in items[first:last] if isinstance(item, dict) and k == 0]
    del items[first:last]
    if cut["options"].get("session") in names:
        del cut["options"]["session"]
    return cut


def _pass(scene, still_differs):
    """Goes once over all lists, from their ends: whole lists, halves, then single items."""
    k = 0
    while k < sum(1 for _ in _lists(scene)):
        items = next(items for j, items in enumerate(_lists(scene)) if j == k)
        size = len(items)
        # the root layer stays, and a set has some variant
        least = 1 if k == 0 or any(items is s["variants"] for s in _sets(scene)) else 0
        step = size - least
        while step >= 1:
            last = len(next(items for j, items in enumerate(_lists(scene)) if j == k))
            while last > least:
                first = max(last - step, least)
                cut = _cut(scene, k, first, last)
                if still_differs(cut):
                    scene = cut
                last = first
            step //= 2
        k += 1
    return scene


def shrink(scene, still_differs):
    """The smallest scene found of which `still_differs` says true."""
    for option in list(scene["options"]):
        cut = copy.deepcopy(scene)
        del cut["options"][option]
        if option != "session" and still_differs(cut):
            scene = cut
    before = None
    while before != scene:
        before = scene
        scene = _pass(scene, still_differs)
    return scene
