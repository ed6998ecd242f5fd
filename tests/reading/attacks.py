# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Assets that name files of other people: nothing of these reaches an output.

    attacks.py TENON [--list]

Each attack is a verb, a place in an asset that names a file, and a way to write its path. The files
lie beside the asset's folder and hold marks, as text or as numbers. After each run no file that it
wrote and nothing that it said holds a mark, it ended by itself and soon, and it did not call an
output whole that lacks something. Layers from elsewhere may be composed, but not unsaid, and
--sandbox keeps them out, too.
"""

import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile

from hostile_assets import (ARCS, KINDS, LAYER, MARK, MODEL_KINDS, MODELS, NUMBER, OBJ, OWN_OBJ,
                            ROBOTS, VALUES, folders, painted, png, secrets, shown, template,
                            texture, preview)

TENON = os.path.abspath(sys.argv[1])
MARKS = (MARK.encode(), b"0.739146", struct.pack("<f", NUMBER))
SAID = ("read.outside", "read.wrong-kind", "read.unreadable", "layer.outside", "guard.outside")
SECONDS = 10


# Verbs: arguments behind the asset, and what they write.
COLLECT = {
    "structure": ["structure", "ASSET", "-o", "OUT/made"],
    "zip": ["zip", "ASSET", "-o", "OUT/made.usdz"],
    "cat to a package": ["cat", "ASSET", "-o", "OUT/made.usdz"],
    "flatten to a package": ["cat", "ASSET", "--flatten", "-o", "OUT/made.usdz"],
}
COPY = {  # files of layers, as they are
    "zip": COLLECT["zip"],
    "cat to a package": COLLECT["cat to a package"],
    "strip": ["strip", "ASSET", "-o", "OUT/made.usda"],
}
COMPOSE = {  # what layers say
    "structure": COLLECT["structure"],
    "flatten": ["cat", "ASSET", "--flatten", "-o", "OUT/made.usda"],
    "to MJCF": ["convert", "ASSET", "OUT/made.xml"],
    "to URDF": ["convert", "ASSET", "OUT/made.urdf"],
}
NAME_ONLY = {
    "flatten": COMPOSE["flatten"],
    "cat": ["cat", "ASSET"],
    "variant": ["variant", "ASSET", "--json"],
    "diff": ["diff", "ASSET", "OWN", "--composed"],
    "to URDF": COMPOSE["to URDF"],
    "bake": ["bake", "ASSET", "-o", "OUT/made.usda", "--duration", "0.01"],
    "info": ["info", "ASSET", "--json"],
    "dump": ["dump", "ASSET"],
}

# What is no file of anybody, or none that ends: the path of a special file.
def pipe(folder):
    os.mkfifo(folder / "pipe.png")
    return "./pipe.png"


def sparse(folder):
    with open(folder / "huge.png", "wb") as file:
        file.write(png()[:8])
        file.truncate(1 << 40)
    return "./huge.png"


def sub_folder(folder):
    (folder / "folder.png").mkdir()
    return "./folder.png"


def own_text(folder):
    (folder / "passwords.png").write_text(MARK)
    return "./passwords.png"


def own_document(folder):
    with zipfile.ZipFile(folder / "letter.docx", "w") as archive:
        archive.writestr("[Content_Types].xml", MARK)
    return "./letter.docx"


SPECIAL = {
    "pipe": pipe, "huge file": sparse, "folder": sub_folder, "own text": own_text,
    "own document": own_document,
    "device without end": lambda folder: "/dev/zero",
    "terminal": lambda folder: "/dev/tty",
    "environment": lambda folder: "/proc/self/environ",
    "memory": lambda folder: "/proc/self/mem",
    "passwords": lambda folder: "/etc/passwd",
}


class Attack:
    """One run: the files of the asset, the arguments, and whether the mark may show, named."""

    def __init__(self, name, make, arguments, composed=False, harmless=False):
        self.name, self.make, self.arguments = name, make, arguments
        self.composed = composed  # layers from elsewhere may be read, and have to be named
        self.harmless = harmless  # nothing is copied: there may be nothing to say

    def run(self, folder):
        place = folder / "asset"
        place.mkdir()
        (place / "sub").mkdir()
        (folder / "out").mkdir()
        (folder / "secret").mkdir()
        for name, contents in secrets().items():
            target = folder / "secret" / name
            target.write_bytes(contents if isinstance(contents, bytes) else contents.encode())
        with zipfile.ZipFile(folder / "secret/p.usdz", "w") as archive:
            archive.writestr("root.usda", LAYER)
            archive.writestr("s.png", png())
        (place / "own.usda").write_text('#usda 1.0\n(\n    defaultPrim = "S"\n)\ndef "S"\n{\n}\n')
        files = self.make(place)
        for name, contents in files.items():
            (place / name).write_bytes(
                contents if isinstance(contents, bytes) else contents.encode())
        asset = str(place / next(iter(files)))
        words = [word.replace("OUT", str(folder / "out")).replace("ASSET", asset).replace(
            "OWN", str(place / "own.usda")).replace("FOLDER", str(place))
            for word in self.arguments]
        try:
            done = subprocess.run([TENON, *words], capture_output=True, check=False, cwd=place,
                                  timeout=SECONDS, stdin=subprocess.DEVNULL,
                                  env={**os.environ, "TOKEN": MARK})
        except subprocess.TimeoutExpired:
            return ["takes longer than it may"]
        return list(self.faults(done, folder / "out"))

    def faults(self, done, out):
        said = done.stderr.decode(errors="replace")
        if done.returncode not in (0, 1, 2):
            yield f"ended with {done.returncode}: {said[-300:]}"
        if done.returncode and not done.stderr.strip() and not done.stdout.strip():
            yield f"ended with {done.returncode} and no word"
        told = [word for word in SAID if f"[{word}]" in said or f'"{word}"' in done.stdout.decode(
            errors="replace")]
        if self.composed:
            if "read.outside-layer" not in said and not told and done.returncode == 0:
                yield f"read a layer from elsewhere and did not name it: {said[-300:]}"
            return
        shows = self.marked(done, out)
        if shows:
            yield f"the mark is in {', '.join(shows)}"
        if done.returncode == 0 and not told and not self.harmless:
            yield f"called its output whole: {said[-300:]}"

    @staticmethod
    def marked(done, out):
        """Where the mark shows."""
        shows = [str(path.relative_to(out)) for path in sorted(out.rglob("*"))
                 if path.is_file() and any(mark in path.read_bytes() for mark in MARKS)]
        shows += [name for name, text in (("stdout", done.stdout), ("stderr", done.stderr))
                  if any(mark in text for mark in MARKS)]
        return shows


def usd_attacks():
    kinds = list(KINDS)
    turn = 0
    for place, (secret, text) in VALUES.items():
        for verb, arguments in COLLECT.items():
            # Every place with every verb, the ways to write a path in turn; textures in all.
            wanted = kinds if place == "texture" else [kinds[turn % len(kinds)]]
            turn += 1
            for kind in wanted:
                if "[" in secret and kind == "link":
                    continue
                yield Attack(f"{verb}: {place}, {kind}",
                             lambda folder, k=kind, s=secret, t=text: {
                                 "a.usda": t(KINDS[k](folder, s))}, arguments,
                             # What attributes do not have, structured assets do not take along.
                             harmless=verb == "structure" and place in ("metadata", "asset info"))
    yield Attack("to MJCF: texture of a surface", lambda folder: {
        "a.usda": preview(KINDS["link"](folder, "s.png"))}, COMPOSE["to MJCF"])
    for verb, arguments in NAME_ONLY.items():
        yield Attack(f"{verb}: texture", lambda folder: {
            "a.usda": texture(KINDS["relative"](folder, "s.png"))}, arguments, harmless=True)


def arc_attacks():
    kinds = list(KINDS)
    turn = 0
    for place, text in ARCS.items():
        for verb, arguments in COPY.items():
            kind = kinds[turn % len(kinds)]
            turn += 1

            def make(folder, k=kind, t=text):
                return {"a.usda": t(KINDS[k](folder, "s.usda"))}
            # An expression is not followed, clips are no layers that could be stripped.
            harmless = place == "expression" or verb == "strip" and "clips" in place
            yield Attack(f"{verb}: {place}, {kind}", make, arguments, harmless=harmless)
        for verb, arguments in COMPOSE.items():
            kind = kinds[turn % len(kinds)]
            turn += 1

            def make_composed(folder, k=kind, t=text):
                return {"a.usda": t(KINDS[k](folder, "s.usda"))}
            if "clips" not in place:
                yield Attack(f"{verb}: {place}, {kind}", make_composed, arguments, composed=True)
            yield Attack(f"{verb} in a sandbox: {place}, {kind}", make_composed,
                         [*arguments, "--sandbox", "FOLDER"], harmless=True)
    for verb in ("zip", "cat to a package"):
        yield Attack(f"{verb}: template of clips",
                     lambda folder: {"a.usda": template("../secret")}, COPY[verb])
        yield Attack(f"{verb}: text as a layer", lambda folder: {
            "a.usda": ARCS["reference"]("../secret/s.txt")}, COPY[verb])
        yield Attack(f"{verb}: own text as a layer", lambda folder: {
            "a.usda": ARCS["reference"]("./notes.txt"), "notes.txt": MARK}, COPY[verb])


def robot_attacks():
    ways = {**KINDS, "package": lambda folder, name: f"package://asset/../secret/{name}",
            "package upward": lambda folder, name: f"package://secret/{name}",
            "package without a name":
                lambda folder, name: f"package://{(folder / '../secret').resolve()}/{name}",
            "model without a name":
                lambda folder, name: f"model://{(folder / '../secret').resolve()}/{name}",
            "package of a dot": lambda folder, name: f"package://./../secret/{name}",
            "package of dots": lambda folder, name: f"package://../secret/{name}"}
    kinds = list(ways)
    outputs = ["OUT/made.usda", "OUT/made", "OUT/made.usdz"]
    turn = 0
    for place, (secret, files) in ROBOTS.items():
        in_mesh = place.split()[0] in ("OBJ", "DAE", "glTF", "GLB")
        own = [kind for kind in kinds
               if not in_mesh or kind in ("relative", "absolute", "down and up", "link")]
        wanted = own if place in ("URDF mesh", "URDF texture") else [own[(turn + i) % len(own)]
                                                                      for i in range(2)]
        for kind in wanted:
            turn += 1
            yield Attack(f"convert: {place}, {kind}",
                         lambda folder, k=kind, s=secret, f=files: f(ways[k](folder, s)),
                         ["convert", "ASSET", outputs[turn % 3]])
    for place, (secret, files) in MODELS.items():
        for kind in MODEL_KINDS:
            turn += 1
            yield Attack(f"convert: {place}, {kind}",
                         lambda folder, k=kind, s=secret, f=files: f(KINDS[k](folder, s)),
                         ["convert", "ASSET", outputs[turn % 3]])
    for place in folders(""):
        for kind in ("relative", "absolute", "linked folder"):
            yield Attack(f"convert: {place}, {kind}",
                         lambda folder, k=kind, p=place: {
                             "r.xml": folders(KINDS[k](folder, "x")[:-2])[p]},
                         ["convert", "ASSET", "OUT/made.usda"])
    for place in ("URDF mesh", "URDF texture", "OBJ image"):
        secret, files = ROBOTS[place]
        yield Attack(f"convert in a sandbox: {place}",
                     lambda folder, s=secret, f=files: f(f"../secret/{s}"),
                     ["convert", "ASSET", "OUT/made.usda", "--sandbox", "FOLDER"])


def special_attacks():
    for kind, make in SPECIAL.items():
        for verb in ("structure", "zip"):
            yield Attack(f"{verb}: {kind}", lambda folder, m=make: {"a.usda": texture(m(folder))},
                         COLLECT[verb], # What is no regular file counts as missing.
                         harmless=kind in ("pipe", "folder", "terminal", "device without end"))
        yield Attack(f"convert: {kind}", lambda folder, m=make: {
            "r.urdf": painted(m(folder)), "own.obj": OWN_OBJ},
            ["convert", "ASSET", "OUT/made"])
    yield Attack("flatten: pipe as a layer",
                 lambda folder: {"a.usda": ARCS["reference"](pipe(folder))},
                 COMPOSE["flatten"], harmless=True)
    yield Attack("zip: a link for the asset's own layer", lambda folder: {
        "a.usda": ARCS["sublayer"](KINDS["link"](folder, "s.usda"))}, COLLECT["zip"])
    # Of a Python package the folders of robots' parts belong to its robots, and nothing around it.
    for kind, mesh, top in (
            ("data of the package", "robots/hands/left/data/s.obj", "__init__.py"),
            ("no folder of the package", "../secret/s.obj", "__init__.py"),
            ("meshes beside the package", "../other/hands/left/meshes/s.obj", "__init__.py"),
            ("no __init__.py above", "robots/hands/left/meshes/s.obj", "readme.txt")):
        yield Attack(f"convert: {kind}",
                     lambda folder, m=mesh, t=top: robot_of_a_python_package(folder, m, t),
                     ["convert", "ASSET", "OUT/made.usda"])
    # A name without ./ is looked up in the working directory, which is nothing of the asset's.
    for verb in ("zip", "structure"):
        yield Attack(f"{verb}: search in the working directory", lambda folder: {
            "sub/a.usda": texture("mine.png"), "mine.png": png()}, COLLECT[verb],
            harmless=verb == "structure")


# What people do: the file is wanted, and comes along without a complaint.
def own_picture(folder):
    (folder / "own.png").write_bytes(png())
    return folder / "own.png"


def robot_of_a_package(folder):
    """urdf/ and meshes/ side by side, as ROS has it, without a package.xml."""
    for name, contents in (("urdf/r.urdf", shown("../meshes/own.obj")), ("meshes/own.obj", OBJ)):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(contents)
    return {"urdf/r.urdf": shown("../meshes/own.obj")}


def robot_of_a_python_package(folder, mesh="robots/hands/left/meshes/own.obj", top="__init__.py"):
    """Robots of a Python package share the meshes of a hand, further down than ROS has them."""
    package = folder.parent / "lib"  # the folder of the others is called "asset"
    robot = shown(os.path.relpath(mesh, "robots/humanoid/one"))
    for name, contents in (("robots/humanoid/one/r.urdf", robot), (mesh, OBJ), (top, ""),
                           ("robots/hands/__init__.py", "")):
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(contents)
    return {"../lib/robots/humanoid/one/r.urdf": robot}


HONEST = [
    ("structure: own texture", lambda folder: {"a.usda": texture(f"./{own_picture(folder).name}")},
     COLLECT["structure"]),
    ("structure: own texture, file URI",
     lambda folder: {"a.usda": texture(f"file://{own_picture(folder)}")}, COLLECT["structure"]),
    ("structure: texture of an allowed folder",
     lambda folder: {"a.usda": texture("../secret/s.png")},
     [*COLLECT["structure"], "--allow-read", "FOLDER/../secret"]),
    ("structure: texture of a sandbox", lambda folder: {"a.usda": texture("../secret/s.png")},
     [*COLLECT["structure"], "--sandbox", "FOLDER", "--sandbox", "FOLDER/../secret"]),
    ("zip: own texture", lambda folder: {"a.usda": texture(f"./{own_picture(folder).name}")},
     COLLECT["zip"]),
    ("zip: layer of an allowed folder",
     lambda folder: {"a.usda": ARCS["reference"]("../secret/s.usda")},
     [*COLLECT["zip"], "--allow-read", "FOLDER/../secret"]),
    ("zip: search path", lambda folder: {"a.usda": ARCS["reference"]("s.usda")},
     [*COLLECT["zip"], "--search-path", "FOLDER/../secret"]),
    ("convert: meshes beside urdf", robot_of_a_package, ["convert", "ASSET", "OUT/made.usda"]),
    ("convert: meshes of another robot of a Python package", robot_of_a_python_package,
     ["convert", "ASSET", "OUT/made.usda"]),
    ("convert: given package", lambda folder: {"r.urdf": shown("package://p/s.obj")},
     ["convert", "ASSET", "OUT/made.usda", "--package", "p=FOLDER/../secret"]),
    ("convert: texture of an allowed file", lambda folder: {
        "r.urdf": painted("../secret/s.png"), "own.obj": OWN_OBJ},
     ["convert", "ASSET", "OUT/made", "--allow-read", "FOLDER/../secret/s.png"]),
]


class Honest(Attack):
    """A run whose output has the mark, and that has nothing to complain of."""

    def __init__(self, name, make, arguments):
        super().__init__("honest, " + name, make, arguments)

    def faults(self, done, out):
        said = done.stderr.decode(errors="replace")
        if done.returncode != 0 or any(f"[{word}]" in said for word in SAID):
            yield f"ended with {done.returncode}: {said[-300:]}"
        if not any(mark in path.read_bytes() for path in out.rglob("*") if path.is_file()
                   for mark in MARKS):
            yield "what was wanted is not in the output"


def main():
    attacks = [*usd_attacks(), *arc_attacks(), *robot_attacks(), *special_attacks()]
    attacks += [Honest(*one) for one in HONEST]
    if "--list" in sys.argv:
        print("\n".join(attack.name for attack in attacks))
        return 0
    only = sys.argv[sys.argv.index("--only") + 1] if "--only" in sys.argv else ""
    faults = 0
    ran = 0
    top = pathlib.Path(os.path.realpath(tempfile.mkdtemp()))
    try:
        for number, attack in enumerate(attacks):
            if only not in attack.name:
                continue
            ran += 1
            folder = top / str(number)
            folder.mkdir()
            for fault in attack.run(folder):
                faults += 1
                print(f"{attack.name}: {fault}")
            shutil.rmtree(folder)
    finally:
        shutil.rmtree(top, ignore_errors=True)
    print(f"{ran} attacks and honest uses, {faults} faults")
    return 1 if faults or ran == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
