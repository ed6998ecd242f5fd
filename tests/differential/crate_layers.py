# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Compares binary layers with OpenUSD, by the canonical text of what each side reads:
read      every binary layer below the folders, ours against OpenUSD's reader;
written   every text layer, written as a binary layer by us and read by OpenUSD;
versions  some text layers, written by OpenUSD in each version it can write, read by us.
Needs Python with OpenUSD's modules.

usage: crate_layers.py RECRATE [--versions] [FOLDER...]

RECRATE is the program tests/tools/recrate.cpp. Without FOLDER the layers of this project are read,
and the conformance files, scenes and assets of the folder named by TENON_SHARED_DIR (default:
../shared), where that is. Known misses are named in crate_misses.txt: one more or one less makes
this fail.
"""

import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "conformance"))
import suite  # noqa: E402  pylint: disable=wrong-import-position

try:
    from pxr import Sdf
except ImportError:
    suite.skip("no OpenUSD modules in this Python")

SHARED = suite.SHARED
LARGEST = 8_000_000  # bytes
VERSIONS = [f"0.{minor}.0" for minor in range(4, 17)]
BATCH = 50


def layer_files(folders):
    """(binary, text) layers below the folders, sorted."""
    binary, text = [], []
    for folder in folders:
        for directory, _, names in os.walk(folder):
            for name in names:
                path = os.path.join(directory, name)
                if not name.endswith((".usda", ".usd", ".usdc")) or os.path.islink(path):
                    continue
                if os.path.getsize(path) > LARGEST:
                    continue
                with open(path, "rb") as file:
                    head = file.read(8)
                if head == b"PXR-USDC":
                    binary.append(path)
                elif head.startswith(b"#usda"):
                    text.append(path)
    return sorted(binary), sorted(text)


def text_by_openusd(path):
    """What OpenUSD exports, or None when it rejects the file."""
    try:
        layer = Sdf.Layer.OpenAsAnonymous(path)
        return None if layer is None else layer.ExportToString()
    except Exception:  # pylint: disable=broad-except
        return None


def convert(program, what, paths, folder):
    """Runs `program what`; path -> file it made, rejected ones left out."""
    made = {}
    for start in range(0, len(paths), BATCH):
        batch = paths[start : start + BATCH]
        into = os.path.join(folder, str(start))
        os.mkdir(into)
        run = subprocess.run(
            [program, what, into] + batch, capture_output=True, text=True, check=False
        )
        if run.returncode not in (0, 1):
            sys.exit(f"{program} crashed ({run.returncode}):\n{run.stderr[-3000:]}")
        suffix = ".usdc" if what == "crate" else ""
        for i, path in enumerate(batch):
            out = os.path.join(into, str(i)) + suffix
            if os.path.exists(out):
                made[path] = out
    return made


def contents(path):
    with open(path, "rb") as file:
        return file.read().decode("utf-8", "surrogateescape")


def first_difference(expected, actual):
    for number, (a, b) in enumerate(zip(expected.split("\n"), actual.split("\n")), 1):
        if a != b:
            return f"line {number}\n   expected {a[:160]}\n   actual   {b[:160]}"
    return "one text ends early"


def compare(expected, actual):
    """What differs, or None."""
    if expected is None and actual is None:
        return None
    if expected is None or actual is None:
        return "OpenUSD rejects it" if expected is None else "OpenUSD accepts it"
    return None if expected == actual else first_difference(expected, actual)


def read_misses(program, files, folder):
    made = convert(program, "text", files, folder)
    for path in files:
        actual = contents(made[path]) if path in made else None
        yield path, compare(text_by_openusd(path), actual)


def written_misses(program, files, folder):
    """Of the text layers that both sides accept."""
    made = convert(program, "crate", files, folder)
    for path in files:
        expected = text_by_openusd(path)
        if expected is not None and path in made:
            yield path, compare(expected, text_by_openusd(made[path]))


def write_as(version, files, folder):
    """Files written as `version` or, where they need it, a later one; by another process, because
    OpenUSD reads the setting once."""
    script = (
        "import os\nimport sys\nfrom pxr import Sdf\n"
        "for i, path in enumerate(sys.argv[2:]):\n"
        "    out = f'{sys.argv[1]}/{i}.usdc'\n"
        "    try:\n"
        "        layer = Sdf.Layer.OpenAsAnonymous(path)\n"
        "        layer and layer.Export(out)\n"
        "    except Exception:\n"
        "        if os.path.exists(out):\n"
        "            os.remove(out)  # what it could not write it leaves broken\n"
    )
    environment = dict(
        os.environ,
        USD_WRITE_NEW_USDC_FILES_AS_VERSION=version,
        PXR_USDC_EMIT_DEPRECATION_WARNINGS="0",
    )
    subprocess.run(
        [sys.executable, "-c", script, folder] + files,
        env=environment,
        capture_output=True,
        check=False,
    )
    return [os.path.join(folder, f"{i}.usdc") for i in range(len(files))]


def version_misses(program, files, folder):
    for version in VERSIONS:
        into = os.path.join(folder, "as" + version)
        os.makedirs(os.path.join(into, "texts"))
        written = write_as(version, files, into)
        there = [path for path in written if os.path.exists(path)]
        made = convert(program, "text", there, os.path.join(into, "texts"))
        for path, source in zip(written, files):
            if path in there:
                actual = contents(made[path]) if path in made else None
                difference = compare(text_by_openusd(path), actual)
                yield f"{source}@{version}", difference


def run(results, label, name, misses, program, files):
    with tempfile.TemporaryDirectory() as folder:
        for path, difference in misses(program, files, folder):
            results.add(label, f"{name} {os.path.relpath(path, SHARED)}", difference)


def compare_own(program):
    own = suite.Results("own_crate", os.path.join(HERE, "crate_misses.txt"))
    text = suite.own_layers()
    run(own, "layers of this project written as binary ones: as OpenUSD reads both", "written",
        written_misses, program, text)
    run(own, "layers of this project that OpenUSD writes in each version: read alike", "versions",
        version_misses, program, text[::12])
    return own.finish(is_whole=False)


def main():
    arguments = [argument for argument in sys.argv[1:] if not argument.startswith("--")]
    if not arguments:
        sys.exit(__doc__)
    folders = arguments[1:] or [
        os.path.join(SHARED, name) for name in ("conformance", "scenes", "assets")
    ]
    folders = [folder for folder in folders if os.path.isdir(folder)]
    results = suite.Results("crate", os.path.join(HERE, "crate_misses.txt"))
    binary, text = layer_files(folders)
    all_versions = "--versions" in sys.argv
    some = text if all_versions else text[::25]
    program = arguments[0]
    run(results, "binary layers: read as OpenUSD reads them", "read", read_misses, program, binary)
    run(results, "text layers written as binary ones: as OpenUSD reads both", "written",
        written_misses, program, text)
    run(results, "layers that OpenUSD writes in each version, 0.4 to 0.16: read alike", "versions",
        version_misses, program, some)
    is_whole = not arguments[1:] and not all_versions
    code = results.finish(is_whole and suite.HAS_PUBLISHED)
    if not arguments[1:]:
        code |= compare_own(program)
    sys.exit(code)


if __name__ == "__main__":
    main()
