# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Packages (.usdz) in both directions: what tenon packs OpenUSD composes like the files it was
packed from, what OpenUSD packs tenon composes like OpenUSD, and both reject the same broken ones.

usage: packages.py TENON

Also: data at multiples of 64 bytes, nothing compressed, the root layer first, every texture found.
Exit 77: no OpenUSD.
"""

import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zipfile

try:
    from pxr import Sdf, Usd, UsdShade, UsdUtils
except ImportError:
    print("skipped: no OpenUSD modules in this Python")
    sys.exit(77)

FILES = {
    "asset/root.usda": """#usda 1.0
# kept
(
    defaultPrim = "A"
    subLayers = [@./sub/look.usda@, @../shared/base.usda@]
)
def "A" (
    references = [@sub/part.usda@</Part>, @./nested.usdz@, @./nested.usdz[deep/inner.usda]@</Inner>]
    variantSets = "v"
    variants = { string v = "x" }
)
{
    asset near = @./tex/a.png@
    asset[] many = [@tex/a.png@, @../shared/b.png@, @missing.png@]
    asset tiles = @./tex/wall.<UDIM>.png@
    asset outside = @../shared/udim/floor.<UDIM>.png@
    asset moving.timeSamples = { 1: @./tex/a.png@, 2: @./tex/c.png@ }
    variantSet "v" = {
        "x" (payload = @./sub/variant.usdc@) {
        }
    }
}
def "Clipped" (
    clips = {
        dictionary default = {
            asset[] assetPaths = [@./clips/c.001.usda@]
            asset manifestAssetPath = @./clips/manifest.usda@
            string primPath = "/C"
            double2[] active = [(1, 0)]
            double2[] times = [(1, 1)]
        }
        dictionary more = {
            string templateAssetPath = "./clips/c.###.usda"
            string primPath = "/C"
            double templateStartTime = 1
            double templateEndTime = 2
            double templateStride = 1
        }
    }
)
{
    double x
}
""",
    "asset/sub/look.usda": """#usda 1.0
over "A"
{
    asset up = @../tex/c.png@
}
""",
    "asset/sub/part.usda": """#usda 1.0
def "Part" (payload = @./deep.usda@</Deep>)
{
    asset own = @p.png@
}
""",
    "asset/sub/deep.usda": '#usda 1.0\ndef "Deep"\n{\n    int deep = 1\n}\n',
    "asset/sub/variant.usda": '#usda 1.0\n(\n    defaultPrim = "V"\n)\ndef "V"\n{\n'
                              '    asset out = @../../shared/b.png@\n}\n',
    "asset/clips/manifest.usda": '#usda 1.0\nover "C"\n{\n    double x\n}\n',
    "asset/clips/c.001.usda": '#usda 1.0\nover "C"\n{\n    double x.timeSamples = { 1: 5, }\n}\n',
    "asset/clips/c.002.usda": '#usda 1.0\nover "C"\n{\n    double x.timeSamples = { 2: 7, }\n}\n',
    "shared/base.usda": '#usda 1.0\nover "A"\n{\n    asset based = @./b.png@\n}\n',
}
PNG = b"\x89PNG\r\n\x1a\n"  # as much of an image as is looked at
IMAGES = ("asset/tex/a.png", "asset/tex/c.png", "asset/tex/wall.1001.png",
          "asset/tex/wall.1002.png", "asset/sub/p.png", "shared/b.png",
          "shared/udim/floor.1001.png", "shared/udim/floor.1011.png")


def write_files(folder):
    for name, text in FILES.items():
        put(os.path.join(folder, name), text.encode())
    for name in IMAGES:
        put(os.path.join(folder, name), PNG + name.encode())
    layer = Sdf.Layer.FindOrOpen(os.path.join(folder, "asset/sub/variant.usda"))
    layer.Export(os.path.join(folder, "asset/sub/variant.usdc"))
    inside = {"root.usda": '#usda 1.0\n(\n    defaultPrim = "N"\n)\ndef "N" (\n'
                           '    references = @./deep/inner.usda@</Inner>\n)\n{\n}\n',
              "deep/inner.usda": '#usda 1.0\ndef "Inner"\n{\n    asset t = @../t.png@\n}\n',
              "t.png": PNG + b"t"}
    for name, text in inside.items():
        put(os.path.join(folder, "nest", name), text if name == "t.png" else text.encode())
    here = os.getcwd()
    os.chdir(os.path.join(folder, "nest"))
    with Sdf.ZipFileWriter.CreateNew(os.path.join(folder, "asset/nested.usdz")) as writer:
        for name in inside:
            writer.AddFile(name)
    os.chdir(here)


def put(path, contents):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(contents)


def contents_of(path):
    """What an asset path that has been resolved leads to."""
    match = re.match(r"(.*?\.usdz)\[(.*)\]$", path)
    if not match:
        with open(path, "rb") as file:
            return file.read()
    package, inner = match.groups()
    with zipfile.ZipFile(package) as archive:
        name, _, rest = inner.partition("[")
        data = archive.read(name)
    if rest:  # in a package in the package
        with tempfile.NamedTemporaryFile(suffix=".usdz") as file:
            file.write(data)
            file.flush()
            return contents_of(file.name + "[" + rest)
    return data


def meaning(stage):
    """Values of all attributes; assets by what they lead to."""
    result = {}
    for prim in stage.Traverse():
        result[str(prim.GetPath())] = str(prim.GetTypeName())
        for attribute in prim.GetAttributes():
            stack = attribute.GetPropertyStack(Usd.TimeCode.Default())
            layer = stack[0].layer if stack else None
            for time in (Usd.TimeCode.Default(), 1.0, 2.0):
                value = attribute.Get(time)
                if isinstance(value, Sdf.AssetPath):
                    value = asset_meaning(value, layer)
                elif value is not None and "Asset" in type(value).__name__:
                    value = [asset_meaning(item, layer) for item in value]
                result[f"{attribute.GetPath()} {time}"] = repr(value)
    return result


def asset_meaning(asset, layer):
    if "<UDIM>" in asset.path:
        path = UsdShade.UdimUtils.ResolveUdimPath(asset.path, layer) or asset.path
        tiles = UsdShade.UdimUtils.ResolveUdimTilePaths(path, layer)
        return [contents_of(tile) for tile, _ in tiles]
    return contents_of(asset.resolvedPath) if asset.resolvedPath else "missing " + asset.path


def check_layout(path):
    """Faults of the zip file."""
    with zipfile.ZipFile(path) as archive, open(path, "rb") as file:
        for info in archive.infolist():
            file.seek(info.header_offset)
            header = file.read(30)
            start = info.header_offset + 30 + sum(struct.unpack("<HH", header[26:30]))
            if start % 64 or info.compress_type:
                yield f"{info.filename} is not stored at a multiple of 64 bytes"
        if archive.testzip():
            yield "checksums differ"


def differences(want, have):
    for key in sorted(want.keys() | have.keys()):
        if want.get(key) != have.get(key):
            yield f"{key}: expected {want.get(key)}, found {have.get(key)}"


def check_ours(tenon, folder):
    """What tenon packs; a fault a line."""
    root, package = os.path.join(folder, "asset/root.usda"), os.path.join(folder, "away/ours.usdz")
    os.makedirs(os.path.dirname(package), exist_ok=True)
    shared = ["--allow-read", os.path.join(folder, "shared")]
    run = subprocess.run([tenon, "cat", root, "-o", package, *shared], capture_output=True,
                         text=True, check=False)
    if run.returncode != 1:  # a texture is missing
        yield f"tenon cat: {run.returncode} {run.stderr}"
        return
    if "missing.png" not in run.stderr:
        yield "the missing texture is not reported: " + run.stderr
    yield from check_layout(package)
    want = meaning(Usd.Stage.Open(root))
    away = shutil.move(package, tempfile.mkdtemp(dir=folder))
    with zipfile.ZipFile(away) as archive:
        if archive.namelist()[0] != "root.usda":
            yield f"first is {archive.namelist()[0]}"
        if b"# kept" not in archive.read("root.usda"):
            yield "comments of a rewritten layer are lost"
    shutil.move(os.path.join(folder, "asset"), os.path.join(folder, "hidden"))
    shutil.move(os.path.join(folder, "shared"), os.path.join(folder, "hidden2"))
    yield from differences(want, meaning(Usd.Stage.Open(away)))
    shutil.move(os.path.join(folder, "hidden"), os.path.join(folder, "asset"))
    shutil.move(os.path.join(folder, "hidden2"), os.path.join(folder, "shared"))
    again = os.path.join(folder, "again.usdz")
    subprocess.run([tenon, "cat", away, "-o", again], capture_output=True, check=False)
    yield from (f"packed again: {line}"
                for line in differences(want, meaning(Usd.Stage.Open(again))))
    flat = os.path.join(folder, "flat.usdz")
    subprocess.run([tenon, "cat", root, "--flatten", "-o", flat, *shared], capture_output=True,
                   check=False)
    found = differences(want, meaning(Usd.Stage.Open(flat)))
    # Values of clips are not flattened.
    yield from (f"flattened: {line}" for line in found if not line.startswith("/Clipped.x"))


def check_theirs(tenon, folder):
    """What OpenUSD packs, read by tenon: the same flattened stage. Also as the first and only file
    of a package, which is then what that opens."""
    package, outer = (os.path.join(folder, name) for name in ("theirs.usdz", "outer.usdz"))
    UsdUtils.CreateNewUsdzPackage(os.path.join(folder, "asset/root.usda"), package)
    with Sdf.ZipFileWriter.CreateNew(outer) as writer:
        writer.AddFile(package, "deep/theirs.usdz")
    for path in (package, outer):
        run = subprocess.run([tenon, "cat", path, "--flatten"], capture_output=True, text=True,
                             check=False)
        want = Usd.Stage.Open(path).Flatten(addSourceFileComment=False).ExportToString()
        # Clips are a matter of their own; the prim with them comes last.
        want, have = (text.partition('def "Clipped"')[0] for text in (want, run.stdout))
        # OpenUSD anchors relative paths that lead to no file, such as those of tiles, when it
        # flattens.
        want, have = ([line for line in text.strip().split("\n") if "<UDIM>" not in line]
                      for text in (want, have))
        if run.returncode or want != have:
            yield f"{path}: {next(((a, b) for a, b in zip(want, have) if a != b), run.stderr)}"


def broken_packages(folder):
    """Name -> bytes."""
    with open(os.path.join(folder, "asset/nested.usdz"), "rb") as file:
        good = file.read()
    central = good.find(b"PK\x01\x02")
    encrypted = bytearray(good)
    encrypted[central + 8] = encrypted[6] = 1
    yield "encrypted", bytes(encrypted)
    yield "cut", good[:100]  # OpenUSD does without a table of contents, tenon does not
    yield "empty", b"PK\x05\x06" + bytes(18)
    path = os.path.join(folder, "deflated.usdz")
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("root.usda", "#usda 1.0\n" + "# x\n" * 1000)
    with open(path, "rb") as file:
        yield "compressed", file.read()
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("a.png", "PNG")
    with open(path, "rb") as file:
        yield "without a layer", file.read()


def check_broken(tenon, folder):
    for name, contents in broken_packages(folder):
        path = os.path.join(folder, name.replace(" ", "_") + "_bad.usdz")
        put(path, contents)
        run = subprocess.run([tenon, "tree", path], capture_output=True, text=True, check=False)
        try:
            Usd.Stage.Open(path)
            accepted = True
        except Exception:  # pylint: disable=broad-exception-caught
            accepted = False
        if accepted != (run.returncode == 0):
            yield f"{name}: OpenUSD {'accepts' if accepted else 'rejects'} it, {run.stderr}"
        if run.returncode not in (0, 1, 2, 3) or (run.returncode and not run.stderr.strip()):
            yield f"{name}: ended with {run.returncode} and no message"


def main():
    tenon = os.path.abspath(sys.argv[1])
    os.environ.pop("PXR_AR_DEFAULT_SEARCH_PATH", None)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # OpenUSD's warnings
    faults = []
    with tempfile.TemporaryDirectory() as temporary:
        folder = os.path.realpath(temporary)
        write_files(folder)
        for check in (check_ours, check_theirs, check_broken):
            found = list(check(tenon, folder))
            print(f"{check.__name__}: {len(found)} faults")
            faults += found
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
