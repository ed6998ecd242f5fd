# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Small scenes of this project about values at times, and the values that the rules give: defaults,
samples between and outside of their times, blocks, offsets of arcs, and clips with their times,
gaps and orders. run_values.py asks tenon for them and, where its modules are there, OpenUSD too."""

HEADER = "#usda 1.0\n"


def samples(name, pairs):
    inside = "".join(f"        {time}: {value},\n" for time, value in pairs)
    return f"    double {name}.timeSamples = {{\n{inside}    }}\n"


def model(inside, metadata="", name="Model"):
    head = f" (\n{metadata})" if metadata else ""
    return f'def "{name}"{head}\n{{\n{inside}}}\n'


def clips(name, fields):
    """The metadata of a clip set."""
    inside = "".join(f"            {field}\n" for field in fields)
    return f"    clips = {{\n        dictionary {name} = {{\n{inside}        }}\n    }}\n"


MANIFEST = HEADER + model("    double size\n    double local\n")
RAMP = HEADER + model(samples("size", [(0, 0), (10, 100)]))
STEEP = HEADER + model(samples("size", [(0, 1000), (10, 2000)]))

SCENES = {
    "defaults": {"entry.usda": HEADER + model("    double a = 4\n    double b\n"
                                              "    double c = None\n")},
    "samples": {"entry.usda": HEADER + model(
        "    double a = 1\n" + samples("a", [(2, 10), (4, 30), (8, 30)]) +
        samples("gap", [(0, 1), (5, "None"), (9, 3)]) +
        "    token word.timeSamples = {\n        1: \"x\",\n        3: \"y\",\n    }\n")},
    "offset": {
        "entry.usda": HEADER + "(\n    subLayers = [\n"
                               "        @weak.usda@ (offset = 10; scale = 2)\n    ]\n)\n",
        "weak.usda": HEADER + model(samples("a", [(0, 0), (5, 50)]))},
    "reference_offset": {
        "entry.usda": HEADER + model("", "    references = @ref.usda@</Model> (offset = -1)\n"),
        "ref.usda": HEADER + model(samples("a", [(1, 7), (2, 9)]))},
    "stronger_default": {
        "entry.usda": HEADER + "(\n    subLayers = [@weak.usda@]\n)\n" +
                      model("    double a = 5\n"),
        "weak.usda": HEADER + model(samples("a", [(0, 0), (5, 50)]))},
    "clip_plain": {
        "entry.usda": HEADER + model("    double size\n", clips("default", [
            "asset[] assetPaths = [@ramp.usda@]", 'string primPath = "/Model"',
            "asset manifestAssetPath = @manifest.usda@", "double2[] active = [(0, 0)]",
            "double2[] times = [(0, 0), (10, 10)]"])),
        "ramp.usda": RAMP, "manifest.usda": MANIFEST},
    "clip_stretched": {
        "entry.usda": HEADER + model("    double size\n", clips("default", [
            "asset[] assetPaths = [@ramp.usda@]", 'string primPath = "/Model"',
            "asset manifestAssetPath = @manifest.usda@", "double2[] active = [(0, 0)]",
            "double2[] times = [(0, 0), (20, 10), (40, 0)]"])),
        "ramp.usda": RAMP, "manifest.usda": MANIFEST},
    "clip_two": {
        "entry.usda": HEADER + model("    double size\n", clips("default", [
            "asset[] assetPaths = [@ramp.usda@, @steep.usda@]", 'string primPath = "/Model"',
            "asset manifestAssetPath = @manifest.usda@", "double2[] active = [(0, 0), (10, 1)]",
            "double2[] times = [(0, 0), (10, 10), (10, 0), (20, 10)]"])),
        "ramp.usda": RAMP, "steep.usda": STEEP, "manifest.usda": MANIFEST},
    "clip_order": {
        "entry.usda": HEADER + model(
            "    double size\n", "    clipSets = [\"b\", \"a\"]\n    clips = {\n" + "".join(
            f"        dictionary {name} = {{\n            asset[] assetPaths = [@{file}@]\n"
            '            string primPath = "/Model"\n'
            "            asset manifestAssetPath = @manifest.usda@\n"
            "            double2[] active = [(0, 0)]\n"
            "            double2[] times = [(0, 0), (10, 10)]\n        }\n"
            for name, file in (("a", "ramp.usda"), ("b", "steep.usda"))) + "    }\n"),
        "ramp.usda": RAMP, "steep.usda": STEEP, "manifest.usda": MANIFEST},
    "clip_below_local": {
        "entry.usda": HEADER + model(samples("local", [(0, 3), (10, 4)]), clips("default", [
            "asset[] assetPaths = [@ramp.usda@]", 'string primPath = "/Model"',
            "asset manifestAssetPath = @manifest.usda@", "double2[] active = [(0, 0)]"])),
        "ramp.usda": HEADER + model(samples("local", [(0, 90)])), "manifest.usda": MANIFEST},
}

# Scene, attribute, {time: value}; None: there is none.
EXPECTED = (
    ("defaults", "/Model.a", {"default": 4.0, "3": 4.0}),
    ("defaults", "/Model.b", {"default": None, "3": None}),
    ("defaults", "/Model.c", {"default": None}),
    ("samples", "/Model.a",
     {"default": 1.0, "0": 10.0, "2": 10.0, "3": 20.0, "4": 30.0, "7": 30.0, "100": 30.0}),
    ("samples", "/Model.gap", {"0": 1.0, "2": 1.0, "5": None, "7": None, "9": 3.0}),
    ("offset", "/Model.a", {"10": 0.0, "15": 25.0, "20": 50.0}),
    ("reference_offset", "/Model.a", {"0": 7.0, "0.5": 8.0, "1": 9.0}),
    ("stronger_default", "/Model.a", {"default": 5.0, "3": 5.0}),
    ("clip_plain", "/Model.size", {"0": 0.0, "5": 50.0, "10": 100.0, "12": 100.0}),
    ("clip_stretched", "/Model.size", {"10": 50.0, "20": 100.0, "30": 50.0}),
    ("clip_two", "/Model.size", {"5": 50.0, "10": 1000.0, "15": 1500.0}),
    ("clip_order", "/Model.size", {"0": 1000.0, "5": 1500.0}),
    ("clip_below_local", "/Model.local", {"0": 3.0, "5": 3.5}),
)
