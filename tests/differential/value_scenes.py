# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Random scenes about values: every type but path expressions, opinions of every kind in
layers that are stacked, referenced and moved in time, metadata that merges, and value clips. Same
seed, same files.
"""

import os

NUMBERS = ("half", "float", "double")
VECTOR_ELEMENTS = {"h": "half", "f": "float", "d": "double", "i": "int"}
ROLES = ("point3", "normal3", "vector3", "color3", "color4", "texCoord2", "texCoord3")
SCALARS = ["bool", "uchar", "int", "uint", "int64", "uint64", "half", "float", "double", "string",
           "token", "asset", "timecode"]
SCALARS += [f"{name}{n}" for name in ("int", "half", "float", "double") for n in (2, 3, 4)]
SCALARS += [f"{role}{letter}" for role in ROLES for letter in "hfd"]
SCALARS += ["matrix2d", "matrix3d", "matrix4d", "frame4d", "quath", "quatf", "quatd"]
WITHOUT_VALUES = ("opaque", "group")
SPLINE_TYPES = ("float", "double")


class Scene:
    """Writes one scene's layers into a folder."""

    def __init__(self, random, folder):
        self.random, self.folder = random, folder
        self.attributes = []  # (name, type), the same in all layers

    def chance(self, probability):
        return self.random.random() < probability

    def number(self):
        random = self.random
        return random.choice((0, 1, -1, 0.5, 2.25, random.randint(-50, 50),
                              round(random.uniform(-20, 20), 3)))

    def whole(self, low, high):
        return self.random.choice((0, low, high, self.random.randint(max(low, -99), min(high, 99))))

    def vector(self, element, count):
        if element == "int":
            return "(" + ", ".join(str(self.whole(-99, 99)) for _ in range(count)) + ")"
        return "(" + ", ".join(str(self.number()) for _ in range(count)) + ")"

    def rotation(self):
        axis = [self.random.uniform(-1, 1) for _ in range(4)]
        length = sum(x * x for x in axis) ** 0.5 or 1
        return "(" + ", ".join(f"{x / length:.6f}" for x in axis) + ")"

    def text(self):
        return self.random.choice(("a", "b c", "\u00e4", "x:y", "", "long text"))

    def asset(self):
        return self.random.choice(("@a.usda@", "@./sub/b.usda@", "@missing.png@",
                                   '@`"${NAME}.usda"`@', "@`'./sub/${LEAF}.usda'`@", "@@"))

    def scalar(self, kind):
        random = self.random
        if kind == "bool":
            return random.choice(("true", "false"))
        limits = {"uchar": (0, 255), "int": (-2**31, 2**31 - 1), "uint": (0, 2**32 - 1),
                  "int64": (-2**63, 2**63 - 1), "uint64": (0, 2**64 - 1)}
        if kind in limits:
            return str(self.whole(*limits[kind]))
        simple = {"string": lambda: f'"{self.text()}"', "token": lambda: f'"{self.text()}"',
                  "asset": self.asset}
        if kind in simple:
            return simple[kind]()
        if kind in NUMBERS or kind == "timecode":
            return str(self.number())
        if kind.startswith("quat"):
            return self.rotation()
        if kind.startswith(("matrix", "frame")):
            size = int(kind.rstrip("d")[-1])
            return "(" + ", ".join(self.vector("double", size) for _ in range(size)) + ")"
        letter = kind[-1]
        element = VECTOR_ELEMENTS.get(letter) or kind.rstrip("234")
        return self.vector(element, int(kind.rstrip("hfdi")[-1]))

    def value(self, kind, size=None):
        if not kind.endswith("[]"):
            return self.scalar(kind)
        count = self.random.randint(0, 3) if size is None else size
        return "[" + ", ".join(self.scalar(kind[:-2]) for _ in range(count)) + "]"

    def samples(self, kind, times=None):
        random = self.random
        times = times or sorted({random.choice((0, 1, 2, 5, 10, 12.5, -3, 5.0000001))
                                 for _ in range(random.randint(1, 5))})
        size = random.choice((None, 2, 3))
        rows = [f"{t}: {'None' if self.chance(0.15) else self.value(kind, size)}" for t in times]
        return "{ " + ", ".join(rows) + " }"

    def spline(self):
        random = self.random
        rows = ["bezier," if self.chance(0.5) else "hermite,"]
        for side in ("pre", "post"):
            if self.chance(0.4):
                rows.append(f"{side}: {random.choice(('held', 'linear', 'sloped(2)'))},")
        for time in sorted(random.sample(range(0, 20), random.randint(1, 4))):
            mode = random.choice(("held", "linear", "curve (1, 0.5)"))
            if mode.startswith("curve") and rows[0] == "hermite,":
                mode = "curve (0.5)"
            rows.append(f"{time}: {self.number()}; post {mode},")
        return "{\n" + "\n".join(rows) + "\n}"

    def dictionary(self, depth=0):
        """Entries of a dictionary; names repeat across layers so that they merge."""
        rows = []
        for name in ("a", "b", "c", "d"):
            if not self.chance(0.5):
                continue
            kind = self.random.choice(("int", "double", "string", "token[]", "asset", "timecode",
                                       "asset[]", "timecode[]", "float3", "bool"))
            if depth < 2 and self.chance(0.4):
                rows.append(f"dictionary {name} = {{\n{self.dictionary(depth + 1)}\n}}")
            else:
                rows.append(f"{kind} {name} = {self.value(kind)}")
        return "\n".join(rows)

    def list_edit(self, name, items):
        random = self.random
        edit = random.choice(("", "prepend ", "append ", "delete ", "add ", "reorder "))
        some = random.sample(items, random.randint(1, len(items)))
        return f"{edit}{name} = [{', '.join(some)}]"

    def property_metadata(self):
        random = self.random
        rows = []
        choices = (
            lambda: f'doc = "{self.text()}"', lambda: f'displayName = "{self.text()}"',
            lambda: f'displayGroup = "{self.text()}"', lambda: f"hidden = {self.scalar('bool')}",
            lambda: f"customData = {{\n{self.dictionary()}\n}}", lambda: f'"{self.text()}"',
            lambda: f"assetInfo = {{\n{self.dictionary()}\n}}", lambda: 'colorSpace = "raw"',
            lambda: 'allowedTokens = ["a", "b"]', lambda: 'permission = private')
        for choice in random.sample(choices[:-1], random.randint(0, 3)):
            rows.append(choice())
        comments = [row for row in rows if row.startswith('"')]
        rows = comments + [row for row in rows if not row.startswith('"')]
        return "" if not rows else " (\n" + "\n".join(rows) + "\n)"

    def prim_metadata(self):
        random = self.random
        choices = (
            lambda: f'doc = "{self.text()}"', lambda: f"hidden = {self.scalar('bool')}",
            lambda: f'kind = "{random.choice(("component", "group", "assembly", "odd"))}"',
            lambda: f"customData = {{\n{self.dictionary()}\n}}",
            lambda: f"assetInfo = {{\n{self.dictionary()}\n}}",
            lambda: f'displayName = "{self.text()}"',
            lambda: self.list_edit("apiSchemas", ['"AAPI"', '"BAPI"', '"CAPI"']),
            lambda: f'unknown = "{self.text()}"', lambda: "active = true")
        return [choice() for choice in random.sample(choices, random.randint(0, 4))]

    def attribute(self, name, kind):
        """One layer's opinions on an attribute, as lines."""
        random = self.random
        custom = random.choice(("", "", "custom "))
        uniform = random.choice(("", "", "", "uniform "))
        head = f"{custom}{uniform}{kind} {name}"
        metadata = self.property_metadata() if self.chance(0.3) else ""
        value = ""
        if kind not in WITHOUT_VALUES and self.chance(0.6):
            value = " = None" if self.chance(0.15) else f" = {self.value(kind)}"
            if self.chance(0.08):
                value = " = AnimationBlock"
        rows = [head + value + metadata]
        if kind not in WITHOUT_VALUES and self.chance(0.35):
            rows.append(f"{uniform}{kind} {name}.timeSamples = {self.samples(kind)}")
        elif kind in SPLINE_TYPES and self.chance(0.3):
            rows.append(f"{uniform}{kind} {name}.spline = {self.spline()}")
        if self.chance(0.15):
            targets = ["</A.t0>", "</A/B.t1>", "</A/B>", "</C.x>"]
            edit = self.list_edit(f"{uniform}{kind} {name}.connect", targets)
            rows.append(edit)
        return "\n".join(rows)

    def relationship(self, name):
        targets = ["</A>", "</A/B>", "</A.r0>", "</A/B.r1>", "</A.t0>", "</C>"]
        return self.list_edit(f"rel {name}", targets)

    def body(self, prim):
        rows = [self.attribute(name, kind) for name, kind in self.attributes if self.chance(0.6)]
        rows += [self.relationship(f"r{i}") for i in range(2) if self.chance(0.5)]
        if self.chance(0.15):
            rows.append('reorder properties = ["t1", "r0", "t0"]')
        if prim == "A" and self.chance(0.1):
            rows.append('reorder nameChildren = ["Z", "B"]')
        return "\n".join(rows)

    def prim(self, name, arcs, inner=""):
        specifier = self.random.choice(("def", "def", "over", "class"))
        kind = self.random.choice(("", "", "Scope ", "Xform "))
        rows = self.prim_metadata() + arcs
        metadata = " (\n" + "\n".join(rows) + "\n)" if rows else ""
        return f'{specifier} {kind}"{name}"{metadata}\n{{\n{self.body(name)}\n{inner}\n}}\n'

    def layer(self, name, metadata, arcs):
        inner = self.prim("B", []) if self.chance(0.7) else ""
        inner += self.prim("Z", []) if self.chance(0.3) else ""
        text = "#usda 1.0\n(\n" + "\n".join(metadata) + "\n)\n" + self.prim("A", arcs, inner)
        if self.chance(0.5):
            text += self.prim("C", [])
        self.write(name, text)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def offset(self):
        random = self.random
        if self.chance(0.4):
            return ""
        return f" (offset = {random.choice((10, -2.5, 100))}; scale = {random.choice((1, 2, 0.5))})"

    def layer_metadata(self, sublayers):
        rows = []
        if sublayers:
            listed = ", ".join(f"@{name}@{self.offset()}" for name in sublayers)
            rows.append(f"subLayers = [{listed}]")
        if self.chance(0.3):
            rows.append(f"timeCodesPerSecond = {self.random.choice((12, 24, 48))}")
        if self.chance(0.3):
            rows.append(f"customLayerData = {{\n{self.dictionary()}\n}}")
        if self.chance(0.5):
            rows.append('expressionVariables = {\nstring NAME = "a"\nstring LEAF = "b"\n}')
        return rows

    def make(self):
        """Writes root.usda over weak.usda, which may reference other.usda over deep.usda."""
        random = self.random
        kinds = random.sample(SCALARS + list(WITHOUT_VALUES), 7)
        kinds += [f"{kind}[]" for kind in random.sample(SCALARS, 5)]
        self.attributes = [(f"t{i}", kind) for i, kind in enumerate(kinds)]
        self.write("a.usda", "#usda 1.0\n")
        self.write("sub/b.usda", "#usda 1.0\n")
        reference = f"prepend references = @sub/other.usda@</A>{self.offset()}"
        inherit = "prepend inherits = </C>"
        for name, sublayers, arcs in (("root.usda", ["weak.usda"], [reference, inherit]),
                                      ("weak.usda", [], [reference]),
                                      ("sub/other.usda", ["deep.usda"], []),
                                      ("sub/deep.usda", [], [inherit])):
            chosen = [arc for arc in arcs if name == "root.usda" or self.chance(0.4)]
            self.layer(name, self.layer_metadata(sublayers), chosen)
        return os.path.join(self.folder, "root.usda")


class ClipScene(Scene):
    """Value clips: sets, templates, jumps, manifests, offsets."""

    KINDS = ("double", "float3", "int", "asset", "timecode", "double[]", "quatf", "token", "half")

    def pairs(self, rows):
        return "[" + ", ".join(f"({a}, {b})" for a, b in rows) + "]"

    def times(self):
        random = self.random
        rows = [(t, random.choice((t, t * 2, 10 - t, 5, 0)))
                for t in sorted(random.sample(range(-2, 30), random.randint(1, 5)))]
        if self.chance(0.4):
            at = random.choice(rows)[0]
            rows.append((at, random.choice((0, 3, 10))))
        if self.chance(0.2):
            random.shuffle(rows)
        return rows

    def explicit_clips(self, clips):
        random = self.random
        rows = [f"asset[] assetPaths = [{', '.join(f'@./{name}@' for name in clips)}]"]
        starts = sorted(random.sample(range(-3, 25), random.randint(1, 4)))
        active = [(start, random.randrange(len(clips))) for start in starts]
        rows.append(f"double2[] active = {self.pairs(active)}")
        if self.chance(0.6):
            rows.append(f"double2[] times = {self.pairs(self.times())}")
        return rows

    def template_clips(self):
        random = self.random
        rows = ['string templateAssetPath = "./t.###.usda"']
        start = random.choice((0, 1, 2))
        stride = random.choice((1, 2, 0.5, 3))
        rows.append(f"double templateStartTime = {start}")
        rows.append(f"double templateEndTime = {random.choice((start, start + 6, 9))}")
        rows.append(f"double templateStride = {stride}")
        if self.chance(0.4):
            rows.append(f"double templateActiveOffset = {random.choice((0.25, -0.5, 0.5))}")
        return rows

    def clip_set(self, name, clips):
        rows = self.template_clips() if self.chance(0.35) else self.explicit_clips(clips)
        if self.chance(0.9):
            rows.append('string primPath = "/K"')
        if self.chance(0.5):
            rows.append("asset manifestAssetPath = @./manifest.usda@")
        if self.chance(0.4):
            rows.append(f"bool interpolateMissingClipValues = {self.scalar('bool')}")
        rows = [row for row in rows if self.chance(0.97)]
        return f"dictionary {name} = {{\n" + "\n".join(rows) + "\n}\n"

    def clip_metadata(self, clips):
        names = self.random.sample(("default", "one", "two"), self.random.choice((1, 1, 2)))
        rows = ["clips = {\n" + "".join(self.clip_set(name, clips) for name in names) + "}"]
        if self.chance(0.3):
            rows.append(self.list_edit("clipSets", ['"one"', '"two"', '"default"']))
        return rows

    def clip_prim(self, specifier, name, rows, inner=""):
        return f'{specifier} "{name}"\n{{\n' + "\n".join(rows) + f"\n{inner}}}\n"

    def clip_layer(self, name):
        rows, below = [], []
        for attribute, kind in self.attributes:
            for target in (rows, below):
                if self.chance(0.65):
                    times = sorted(self.random.sample(range(-2, 14), self.random.randint(1, 4)))
                    uniform = "uniform " if self.chance(0.05) else ""
                    samples = self.samples(kind, times)
                    target.append(f"{uniform}{kind} {attribute}.timeSamples = {samples}")
        inner = self.clip_prim("over", "B", below)
        self.write(name, "#usda 1.0\n" + self.clip_prim("def", "K", rows, inner))

    def manifest(self):
        rows = [f"{kind} {name}" + (f" = {self.value(kind)}" if self.chance(0.3) else "")
                for name, kind in self.attributes if self.chance(0.8)]
        inner = self.clip_prim("over", "B", rows)
        self.write("manifest.usda", "#usda 1.0\n" + self.clip_prim("def", "K", rows, inner))

    def local(self, share):
        rows = []
        for name, kind in self.attributes:
            text = f"{kind} {name}"
            if self.chance(share):
                text += " = None" if self.chance(0.2) else f" = {self.value(kind)}"
            rows.append(text)
            if self.chance(share / 3):
                rows.append(f"{kind} {name}.timeSamples = {self.samples(kind)}")
        return "\n".join(rows)

    def host(self, name, sublayers, arcs, clips, declares):
        rows = list(arcs)
        if clips and self.chance(0.7):
            rows += self.clip_metadata(clips)
        listed = ", ".join(f"@{layer}@{self.offset()}" for layer in sublayers)
        head = f"(\nsubLayers = [{listed}]\n)\n" if sublayers else ""
        metadata = " (\n" + "\n".join(rows) + "\n)" if rows else ""
        below = self.clip_metadata(clips) if clips and self.chance(0.15) else []
        inner_metadata = " (\n" + "\n".join(below) + "\n)" if below else ""
        share = 0.2 if declares else 0.1
        inner = f'def "B"{inner_metadata}\n{{\n{self.local(share)}\n}}\n' if declares else ""
        own = self.local(share) if declares or self.chance(0.3) else ""
        self.write(name, f'#usda 1.0\n{head}def "A"{metadata}\n{{\n{own}\n{inner}}}\n')

    def make(self):
        self.attributes = [(f"t{i}", kind) for i, kind in
                           enumerate(self.random.sample(self.KINDS, 4))]
        self.write("a.usda", "#usda 1.0\n")
        self.write("sub/b.usda", "#usda 1.0\n")
        clips = ["clip0.usda", "clip1.usda", "clip2.usda"]
        templates = [f"t.{i:03}.usda" for i in self.random.sample(range(0, 9), 5)]
        for name in clips + templates:
            self.clip_layer(name)
        self.manifest()
        if self.chance(0.15):
            clips.append("absent.usda")
        reference = f"prepend references = @other.usda@</A>{self.offset()}"
        self.host("root.usda", ["weak.usda"], [reference] if self.chance(0.8) else [], clips, False)
        self.host("weak.usda", [], [], clips, self.chance(0.5))
        self.host("other.usda", ["deep.usda"], [], clips, True)
        self.host("deep.usda", [], [], clips, self.chance(0.5))
        return os.path.join(self.folder, "root.usda")
