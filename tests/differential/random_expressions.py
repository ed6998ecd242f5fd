# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Random path expressions, texts that are nearly ones, and stages with collections; seeded."""

import random

NAMES = ["a", "b", "c", "ab", "a1", "b_c"]
PROPERTIES = ["x", "y", "a", "ns:x"]
TYPES = ["Xform", "Mesh", "Scope", "Sphere", "", "Unknown"]
KINDS = ["component", "group", "assembly", "model", "subcomponent", "strange"]


def predicate_call(rng):
    # Not "strict=1": OpenUSD looks for an int there where its parser makes an int64.
    strict = rng.choice(["", "", ", strict=true", ", strict=yes"])
    return rng.choice(
        [
            "abstract", "defined", "model", "group", "abstract:false", "defined(isDefined=false)",
            "model(false)", "group:0", "isa:Mesh", "isa:Gprim,Scope", f"isa(Imageable{strict})",
            "specifier:def", "specifier(over, class)", f"kind(model{strict})",
            f"kind(group, component{strict})", "hasAPI:CollectionAPI",
            "hasAPI(CollectionAPI, instanceName=plain)", "variant(v=one)", "variant(v='*o*')",
            "hasAPI:GeomModelAPI", "kind:component", "isa:Xform",
        ]
    )  # fmt: skip


def predicate(rng, depth=0):
    if depth < 2 and rng.random() < 0.4:
        left, right = predicate(rng, depth + 1), predicate(rng, depth + 1)
        return rng.choice(["%s and %s", "%s or %s", "%s %s", "(%s or %s)", "not %s and %s"]) % (
            left, right)  # fmt: skip
    return rng.choice(["", "", "not "]) + predicate_call(rng)


def element(rng, names, is_last=True):
    name = rng.choice(names)
    globs = [name + "*", "*", "?", "[abc]", "[a-b]?", "*[0-9]", "a*"]
    text = rng.choice([name, name, name] + globs)
    if rng.random() < 0.15:
        # OpenUSD reads beyond the path after an element without a name that is not the last.
        return (rng.choice(["", text]) if is_last else text) + "{" + predicate(rng) + "}"
    return text


def pattern(rng):
    if rng.random() < 0.04:
        return rng.choice([".", "..", ".//", "../..", "/", "//", "..//"])
    text = rng.choice(["/", "/", "//", "", ".//", "../", "..//"])
    count = rng.randint(1, 3)
    tail = rng.choice(["", "", "", "//", "." + element(rng, PROPERTIES)])
    for i in range(count):
        text += rng.choice(["/", "/", "//"]) if i else ""
        text += element(rng, NAMES, i + 1 == count and not tail)
    return text + tail


def expression(rng, depth=0, references=()):
    if depth < 3 and rng.random() < 0.55:
        left = expression(rng, depth + 1, references)
        right = expression(rng, depth + 1, references)
        form = rng.choice(["%s %s", "%s + %s", "%s & %s", "%s - %s", "(%s  %s)", "(%s - %s)"])
        return form % (left, right)
    if references and rng.random() < 0.15:
        return rng.choice(references)
    text = pattern(rng)
    return rng.choice([text] * 5 + ["~" + text, "~(" + text + ")"])


def broken(rng, text):
    """The text with a few characters changed; most are no expressions any more."""
    letters = list(text)
    for _ in range(rng.randint(1, 3)):
        at = rng.randrange(len(letters) + 1)
        letter = rng.choice("/.~%_:(){}[]*?+-&= ,\"'!a1")
        letters[at : at + rng.choice([0, 1])] = letter * rng.choice([0, 1, 1, 2])
    return "".join(letters)


def quoted(text):
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def collection(rng, name, paths, collections):
    """Lines of one collection: by rules, by expression or by both."""
    lines = []
    prefix = f"collection:{name}"
    rule = rng.choice([None, "expandPrims", "explicitOnly", "expandPrimsAndProperties"])
    if rule:
        lines.append(f'uniform token {prefix}:expansionRule = "{rule}"')
    if rng.random() < 0.5:
        references = ["%_", "%/none:plain"]
        if name == "other":  # no circles: OpenUSD follows them for ever
            references += ["%:plain", "%/a:plain", "%../a:plain"]
        text = expression(rng, 1, references)
        lines.append(f"uniform pathExpression {prefix}:membershipExpression = {quoted(text)}")
    if rng.random() < 0.5:
        for part, count in (("includes", 3), ("excludes", 2)):
            targets = {rng.choice(paths) for _ in range(rng.randint(0, count))}
            if part == "includes" and rng.random() < 0.3:
                targets.add(rng.choice(collections))
            listed = ", ".join(f"<{t}>" for t in sorted(targets))
            lines.append(f"rel {prefix}:{part} = [{listed}]")
        if rng.random() < 0.3:
            lines.append(f"uniform bool {prefix}:includeRoot = 1")
    return lines


class Scene:
    """A tree of prims, some of them instances of a class, with collections."""

    def __init__(self, rng):
        self.rng = rng
        self.prims = []
        self.tree(rng, "", 0)
        self.paths = [p for p, _ in self.prims]
        self.paths += [f"{p}.{q}" for p, own in self.prims for q in own]
        self.paths += [p + "/in/deep" for p, _ in self.prims[:3]]

    def tree(self, rng, parent, depth):
        for name in rng.sample(NAMES, rng.randint(1, 3 if depth else 4)):
            path = f"{parent}/{name}"
            own = rng.sample(PROPERTIES, rng.randint(0, 2))
            self.prims.append((path, own))
            if depth < 2:
                self.tree(rng, path, depth + 1)

    def prim_head(self, path):
        rng = self.rng
        metadata = []
        if rng.random() < 0.4:
            metadata.append(f'kind = "{rng.choice(KINDS)}"')
        if rng.random() < 0.1:
            metadata.append("active = false")
        apis = ["CollectionAPI:plain", "CollectionAPI:other"] if rng.random() < 0.35 else []
        if rng.random() < 0.2:
            apis.append("GeomModelAPI")
        if apis:
            metadata.append("apiSchemas = [%s]" % ", ".join(f'"{a}"' for a in apis))
        if rng.random() < 0.12:
            metadata.append("instanceable = true\nreferences = </Source>")
        if rng.random() < 0.2:
            metadata.append('variants = {\nstring v = "%s"\n}' % rng.choice(["one", "two", "none"]))
            metadata.append('variantSets = "v"')
        word = rng.choice(["def"] * 7 + ["over", "class"])
        kind = rng.choice(TYPES)
        head = f'{word} {kind} "{path.rsplit("/", 1)[1]}"'
        return head + (" (\n" + "\n".join(metadata) + "\n)" if metadata else ""), apis

    def text(self):
        rng = self.rng
        collections = [f"{p}.collection:{n}" for p, _ in self.prims for n in ("plain", "other")]
        source = "def Scope 'Source' (kind = 'component') {\ndouble x = 1\n"
        source += "def Mesh 'in' {\ndouble y = 1\ndef Xform 'deep' {\n}\n}\n}"
        lines = ["#usda 1.0", source]
        open_paths = []
        for path, own in self.prims:
            while open_paths and not path.startswith(open_paths[-1] + "/"):
                open_paths.pop()
                lines.append("}")
            head, apis = self.prim_head(path)
            lines.append(head + " {")
            open_paths.append(path)
            lines += [f"double {name} = 1" for name in own]
            if "CollectionAPI:plain" in apis:
                for name in ("plain", "other"):
                    lines += collection(rng, name, self.paths, collections)
            if "variantSets" in head:
                lines.append('variantSet "v" = {\n"one" {\n}\n"two" {\n}\n}')
        lines += ["}"] * len(open_paths)
        return "\n".join(lines) + "\n"


def scene_text(seed):
    return Scene(random.Random(seed)).text()
