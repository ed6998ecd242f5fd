#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Files in formats of others that were made to do harm: `tenon convert` says what is wrong with
them, and stays within docs/limits.md.

    test_guard.py ROOT TENON WORKER
"""

import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON, WORKER = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
SANITIZED = b"__asan_init" in pathlib.Path(TENON).read_bytes()
MEGABYTE = 1 << 20


def limit(name):
    """A number of docs/limits.md."""
    text = (ROOT / "docs/limits.md").read_text(encoding="utf-8")
    return int(re.search(rf"`{name}` \| ([\d ]+) \|", text).group(1).replace(" ", ""))


def dae(count="12", nodes=1, faces="0 2 1 0 1 3 0 3 2 1 2 3"):
    node = '<node id="n"><instance_geometry url="#g"/></node>'
    return f"""<COLLADA version="1.4.1"><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="a" count="{count}">0 0 0 1 0 0 0 1 0 0 0 1</float_array>
<technique_common><accessor source="#a" count="4" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices><triangles count="4">
<input semantic="VERTEX" source="#v" offset="0"/><p>{faces}</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s">{"<node>" * nodes}{node}
{"</node>" * nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>"""


def gltf(count=3, buffer='"uri":"data:application/octet-stream;base64,' + "A" * 48 + '"'):
    return json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                       "nodes": [{"mesh": 0}],
                       "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                       "accessors": [{"bufferView": 0, "componentType": 5126, "count": count,
                                      "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
                       "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": ["B"]},
                      ).replace('"B"', '{"byteLength":36,' + buffer + "}")


def urdf(*meshes):
    shapes = "".join(f'<visual><geometry><mesh filename="{name}"/></geometry></visual>'
                     for name in meshes)
    inertial = ('<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" '
                'iyz="0"/></inertial>')
    return f'<robot name="r"><link name="l">{inertial}{shapes}</link></robot>'


def mjcf(inner, body='<body><freejoint/><geom size="1"/></body>'):
    return f"<mujoco>{inner}<worldbody>{body}</worldbody></mujoco>"


def replicated(depth):
    each = '<replicate count="100" offset="1 0 0">'
    return each * depth + '<geom size=".1"/>' + "</replicate>" * depth


# Models that ask for more than there is, each in its own way. What takes time is looked at once.
MODELS = {
    "numbers of each body": mjcf('<size nuser_body="1000000000"/>'),
    "numbers of each geom": mjcf('<size nuser_geom="2000000000"/>'),
    "a height field": mjcf('<asset><hfield name="h" nrow="29000" ncol="31000" size="1 1 1 1"/>'
                           '</asset>', '<geom type="hfield" hfield="h"/>'),
    "a painted texture": mjcf('<asset><texture name="t" type="2d" builtin="flat" width="31000"'
                              ' height="29000"/></asset>'),
    "a painted cube": mjcf('<asset><texture name="t" type="cube" builtin="gradient" width="20000"'
                           ' height="20000"/></asset>'),
    "arena": mjcf('<size memory="100G" njmax="2000000000"/>'),
    "includes itself": mjcf('<include file="model.xml"/>'),
    "nested elements": mjcf("<default>" * 10000 + "</default>" * 10000),
    "copies of copies": mjcf("", replicated(3)),
    "a long file name": mjcf(f'<asset><mesh file="{"x/" * 100000}m.stl"/></asset>'),
}


class Guarded(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, contents):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(contents, encoding="utf-8")
        return path

    def convert(self, path, environment=None):
        """-> exit code, rules and text of its findings"""
        process = subprocess.run(
            [TENON, "convert", str(path), str(self.folder / "out.usda"), "--json"],
            capture_output=True, text=True, check=False, env={**os.environ, **(environment or {})})
        answer = json.loads(process.stdout)
        of_robots = ("convert.free-root", "convert.self-collision")
        found = [d for d in answer["diagnostics"] if d["rule"] not in of_robots]
        return process.returncode, [d["rule"] for d in found], " ".join(d["message"] for d in found)


class Bounds(Guarded):
    """Each bound of docs/limits.md that a file can reach."""

    def test_memory(self):
        for name, text in MODELS.items():
            with self.subTest(name):
                code, rules, message = self.convert(self.write("model.xml", text))
                self.assertEqual(code, 2, message)
                self.assertTrue(rules and message, name)
        used = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
        if not SANITIZED:  # whose own bound looks ten times a second
            self.assertLess(used, limit("kGuardMemoryBase") + 64 * MEGABYTE)

    @unittest.skipIf(SANITIZED, "the sanitizers' own bound on memory says less")
    def test_memory_is_named(self):
        for name in ("a height field", "a painted texture", "numbers of each body"):
            code, rules, message = self.convert(self.write("model.xml", MODELS[name]))
            self.assertEqual((code, rules), (2, ["guard.memory"]), name)
            self.assertIn("kGuardMemoryBase", message)

    def test_time(self):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        code, rules, message = self.convert(
            self.write("model.xml", mjcf('<size nkey="1000000000"/>')))
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertEqual(code, 2)
        spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.assertLess(spent, limit("kGuardSeconds") + 2)
        if not SANITIZED:
            self.assertEqual(rules, ["guard.time"])
            self.assertIn("kGuardSeconds", message)

    @unittest.skipIf(SANITIZED, "slower, and with the same bound on time")
    def test_thousands_of_sensors_are_read_in_time(self):
        """Each is looked up once, not by a walk over all."""
        body = '<worldbody><body><site name="s"/><geom size="1"/></body></worldbody>'
        sensors = '<accelerometer site="s"/>' * 30000
        code, _, message = self.convert(
            self.write("model.xml", mjcf(f"{body}<sensor>{sensors}</sensor>")))
        self.assertEqual(code, 0, message)

    @unittest.skipIf(SANITIZED, "the worker's memory ends first")
    def test_answer(self):
        # 1,600 instances of 10,000 triangles: a small file, a large answer.
        faces = "0 2 1 0 1 3 0 3 2 1 2 3 " * 10000
        text = dae(faces=faces).replace('<triangles count="4">', '<triangles count="40000">')
        node = '<instance_geometry url="#g"/>'
        text = text.replace(node, node * 800)
        self.write("m.dae", text)
        code, rules, message = self.convert(self.write("r.urdf", urdf("m.dae")))
        self.assertEqual((code, rules), (1, ["convert.mesh-unreadable"]))
        self.assertRegex(message, "kGuardReplyBase|kGuardMemoryBase")

    def test_losses(self):
        """Of many bad files the first ones are tried; the good ones before them are kept."""
        names = [f"bad{i}.dae" for i in range(limit("kGuardLosses") + 2)]
        for name in names:
            self.write(name, dae(count="-1"))
        self.write("good.dae", dae())
        code, rules, message = self.convert(self.write("r.urdf", urdf("good.dae", *names)))
        self.assertEqual(code, 1)
        self.assertEqual(rules, ["convert.mesh-unreadable"] * len(names))
        self.assertIn("def Mesh", (self.folder / "out.usda").read_text())
        if "kGuardLosses" not in message:
            self.skipTest("the Assimp of this system refuses such files and breaks on none")
        self.assertEqual(message.count("kGuardLosses"), 2)


class Meshes(Guarded):
    def test_that_are_bad_are_left_out_by_name(self):
        bad = {"negative.dae": dae(count="-1"), "deep.dae": dae(nodes=50000),
               "huge.dae": dae(count="4000000000"), "no.dae": "<COLLADA",
               "index.dae": dae(faces="0 2 1 0 1 99999999 0 3 2 1 2 3"),
               "count.gltf": gltf(count=2000000000), "cut.glb": "glTF\2\0\0\0"}
        for name, text in bad.items():
            with self.subTest(name):
                self.write(name, text)
                self.write("good.dae", dae())
                code, rules, message = self.convert(self.write("r.urdf", urdf(name, "good.dae")))
                self.assertEqual((code, rules), (1, ["convert.mesh-unreadable"]), message)
                self.assertIn(name, message)
                self.assertIn("def Mesh", (self.folder / "out.usda").read_text())

    def test_that_are_good_are_read_though_others_are_bad(self):
        self.write("bad.dae", dae(count="-1"))
        self.write("good.dae", dae())
        self.write("good.gltf", gltf())
        code, rules, message = self.convert(
            self.write("r.urdf", urdf("good.dae", "bad.dae", "good.gltf")))
        self.assertEqual((code, rules), (1, ["convert.mesh-unreadable"]), message)
        self.assertEqual((self.folder / "out.usda").read_text().count("def Mesh"), 2)


class Folders(Guarded):
    def test_files_elsewhere_are_not_read(self):
        """Names are judged before the worker is asked; it is held to the folders besides."""
        self.write("away/numbers.bin", "\0" * 36)
        self.write("robot/m.gltf", gltf(buffer='"uri":"../away/numbers.bin"'))
        code, rules, message = self.convert(self.write("robot/r.urdf", urdf("m.gltf")))
        self.assertEqual(code, 1)
        self.assertIn("read.outside", rules)
        self.assertIn("away/numbers.bin", message)

    def test_no_output_replaces_what_the_worker_found(self):
        """Libraries find files by more names than the one that is written."""
        for name in ("numbers.usda", "gone/numbers.usda", ".\\\\numbers.usda"):
            side = self.write("numbers.usda", "\0" * 36)
            self.write("m.gltf", gltf(buffer=f'"uri":"{name}"'))
            robot = self.write("r.urdf", urdf("m.gltf"))
            process = subprocess.run([TENON, "convert", str(robot), str(side), "--force"],
                                     capture_output=True, text=True, check=False)
            self.assertEqual(process.returncode, 2, name + process.stderr)
            self.assertIn("output.is-input", process.stderr, name)
            self.assertEqual(side.read_bytes(), bytes(36), name)

    def test_links_count_by_where_they_lead(self):
        secret = self.write("away/secret.xml", mjcf(""))
        folder = self.folder / "a/b"
        folder.mkdir(parents=True)
        (folder / "link.xml").symlink_to(secret)
        (folder / "m.xml").write_text(mjcf('<include file="link.xml"/>'))
        code, rules, message = self.convert(folder / "m.xml")
        self.assertEqual(code, 2)
        self.assertIn("read.outside", rules)
        self.assertIn("link.xml", message)

    def test_what_is_no_file_is_not_opened(self):
        os.mkfifo(self.folder / "waits.stl")
        text = mjcf('<asset><mesh name="m" file="waits.stl"/></asset>',
                    '<geom type="mesh" mesh="m"/>')
        code, rules, _ = self.convert(self.write("m.xml", text))
        self.assertEqual(code, 2)
        self.assertIn("guard.outside", rules)


class Program(Guarded):
    def test_is_started_only_where_it_is_needed(self):
        started = self.folder / "started"
        script = self.write("worker.sh", f"#!/bin/sh\ntouch {started}\n")
        script.chmod(0o700)
        shapes = ROOT / "tests/convert/urdf/shapes.urdf"
        self.assertEqual(self.convert(shapes, {"TENON_WORKER": str(script)})[0], 0)
        self.assertFalse(started.exists())
        code, rules, _ = self.convert(self.write("m.xml", mjcf("")), {"TENON_WORKER": str(script)})
        self.assertEqual((code, rules), (2, ["guard.crashed"]))
        self.assertTrue(started.exists())

    def test_that_is_missing_is_named_with_the_file(self):
        nowhere = {"TENON_WORKER": str(self.folder / "none")}
        code, rules, message = self.convert(self.write("m.xml", mjcf("")), nowhere)
        self.assertEqual((code, rules), (4, ["guard.no-worker"]))
        self.assertIn(nowhere["TENON_WORKER"], message)
        self.write("good.dae", dae())
        code, rules, message = self.convert(self.write("r.urdf", urdf("good.dae")), nowhere)
        self.assertEqual((code, rules), (1, ["convert.mesh-unreadable"]))
        self.assertIn("tenon-worker", message)

    def test_is_found_where_it_is_installed(self):
        model, target = self.write("m.xml", mjcf("")), self.folder / "o.usda"
        for place in ("bin", "libexec/tenon"):
            with self.subTest(place):
                prefix = self.folder / place.replace("/", "_")
                for folder in {"bin", place}:
                    (prefix / folder).mkdir(parents=True, exist_ok=True)
                os.symlink(WORKER, prefix / place / "tenon-worker")
                shutil.copy(TENON, prefix / "bin/tenon")
                process = subprocess.run(
                    [prefix / "bin/tenon", "convert", model, target], capture_output=True,
                    text=True, check=False)
                self.assertEqual(process.returncode, 0, process.stderr)

    def test_alone_has_the_libraries_of_others(self):
        """What reads files of strangers by such libraries is not in the program at all."""
        program, worker = pathlib.Path(TENON).read_bytes(), pathlib.Path(WORKER).read_bytes()
        for name in (b"aiImportFileExWithProperties", b"mj_parseXML"):
            self.assertTrue(name in worker, name)
            self.assertFalse(name in program, name)

    def test_leaves_nothing_behind(self):
        (self.folder / "work").mkdir()
        model = self.write("m.xml", mjcf('<size nuser_body="1000000000"/>'))
        subprocess.run([TENON, "convert", model, self.folder / "o.usda"], check=False,
                       capture_output=True, cwd=self.folder / "work")
        self.assertEqual(list((self.folder / "work").iterdir()), [])

    def test_says_what_holds_it(self):
        process = subprocess.run([TENON, "doctor", "--json"], capture_output=True, text=True,
                                 check=False)
        rows = {row["name"]: row for row in json.loads(process.stdout)["libraries"]}
        self.assertTrue(rows["worker"]["available"])
        self.assertIn("no new privileges", rows["worker"]["version"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
