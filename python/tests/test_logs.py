#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""tenon_usd.logs: what `tenon sim -o` writes is read alike from each format, and what is written is
read back, by the libraries of MCAP, Rerun and Arrow where they are installed.

    test_logs.py [TENON]    the program; without it that of the wheel

TENON_EXTRAS=1: a library that is missing is a failure.
"""

import csv
import importlib.util
import io
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest
import zipfile

import numpy as np

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
if PROGRAM is None and importlib.util.find_spec("tenon_usd") is not None:
    import tenon_usd
    PROGRAM = str(pathlib.Path(tenon_usd.__file__).parent / "bin/tenon")
else:
    import sweep_source  # noqa: F401
from tenon_usd import logs  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
GRASP = ROOT / "examples/inspire_hand/grasp.usda"
CAN = "/World/can"
OUTPUTS = "contacts,energy,efforts,reactions,accelerations"


def needs(*names):
    missing = [name for name in names if importlib.util.find_spec(name) is None]
    if missing and os.environ.get("TENON_EXTRAS"):
        raise AssertionError(f"missing: {missing}")
    return unittest.skipIf(missing, f"not installed: {missing}")


class Logs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.runs = pathlib.Path(tempfile.mkdtemp())
        for ending in ("csv", "npz", "jsonl"):
            subprocess.run([PROGRAM, "sim", GRASP, "--duration", "1.2", "--log", OUTPUTS, "-q",
                            "-o", cls.runs / f"run.{ending}"], check=True, capture_output=True)
        cls.log = logs.read(cls.runs / "run.csv")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.runs)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def same(self, one, other, contacts=True):
        np.testing.assert_array_equal(one.time, other.time)
        self.assertEqual(set(one.columns), set(other.columns))
        for name, values in one.columns.items():
            np.testing.assert_array_equal(values, other.columns[name], name)
        for name in one.contacts if contacts else ():
            if name in other.contacts:
                np.testing.assert_array_equal(one.contacts[name], other.contacts[name], name)

    def written(self, ending, **options):
        path = self.folder / f"out.{ending}"
        logs.write(self.log, path, **options)
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith(".")], [])
        return path

    def test_each_format_of_the_program_says_the_same(self):
        self.assertGreater(len(self.log.contacts["time"]), 50)
        for ending in ("npz", "jsonl"):
            self.same(self.log, logs.read(self.runs / f"run.{ending}"))

    def test_parts_of_a_log(self):
        self.assertIn(CAN, self.log.bodies)
        self.assertEqual(self.log.body(CAN, "position").shape, (len(self.log.time), 3))
        np.testing.assert_allclose(
            np.linalg.norm(self.log.body(CAN, "orientation"), axis=1), 1, atol=1e-9)
        self.assertIn("energy.kinetic", self.log.others())
        self.assertNotIn(f"{CAN}.position.x", self.log.others())
        counted = sum(len(self.log.contacts_at(i)) for i in range(len(self.log.time)))
        self.assertEqual(counted, len(self.log.contacts["time"]))

    def test_csv_and_npz_are_read_back(self):
        for ending in ("csv", "npz"):
            back = logs.read(self.written(ending))
            self.same(self.log, back)
            self.same(back, self.log)

    @needs("pyarrow")
    def test_parquet_is_read_back_by_arrow(self):
        import pyarrow.parquet as pq
        path = self.written("parquet")
        table = pq.read_table(path)
        np.testing.assert_array_equal(table[f"{CAN}.position.z"].to_numpy(),
                                      self.log.columns[f"{CAN}.position.z"])
        self.assertEqual(json.loads(table.schema.metadata[b"tenon.units"]), self.log.units)
        self.same(self.log, logs.read(path))

    @needs("mcap")
    def test_mcap_is_read_back_by_its_library(self):
        from mcap.reader import make_reader
        path = self.written("mcap", meters_per_unit=0.01)
        transforms, values, contacts = [], [], 0
        with open(path, "rb") as file:
            for schema, channel, message in make_reader(file).iter_messages():
                text = json.loads(message.data)
                if channel.topic == "/tf":
                    self.assertEqual(schema.name, "foxglove.FrameTransforms")
                    transforms.append((message.log_time, {
                        row["child_frame_id"]: row for row in text["transforms"]}))
                elif channel.topic == "/values":
                    values.append(text)
                else:
                    contacts += len(text["contacts"])
        self.assertEqual(len(transforms), len(self.log.time))
        self.assertEqual(contacts, len(self.log.contacts["time"]))
        for i in (0, len(transforms) - 1):
            stamp, rows = transforms[i]
            self.assertEqual(stamp, round(self.log.time[i] * 1e9))
            self.assertEqual(set(rows), set(self.log.bodies))
            place, turn = rows[CAN]["translation"], rows[CAN]["rotation"]
            np.testing.assert_array_equal([place[axis] for axis in "xyz"],
                                          self.log.body(CAN, "position")[i] * 0.01)
            np.testing.assert_array_equal([turn[axis] for axis in "wxyz"],
                                          self.log.body(CAN, "orientation")[i])
            self.assertEqual(values[i]["energy.kinetic"],
                             self.log.columns["energy.kinetic"][i])

    @needs("rerun", "pyarrow")
    def test_rrd_is_read_back_by_its_library(self):
        import pyarrow
        from rerun.chunk import RrdReader

        def rows_of(batch):
            # Nanoseconds, which Python has no duration of, as numbers.
            columns = [column.cast("int64") if pyarrow.types.is_duration(column.type) else column
                       for column in batch.columns]
            return pyarrow.RecordBatch.from_arrays(columns, names=batch.schema.names).to_pylist()

        path = self.written("rrd")
        found = {}
        for chunk in RrdReader(str(path)).stream():
            batch = chunk.to_record_batch()
            found.setdefault(chunk.entity_path, []).extend(rows_of(batch))
        escaped = CAN.replace("/", "\\/")
        rows = found[f"/bodies/{escaped}"]
        self.assertEqual(len(rows), len(self.log.time))
        for row, place in zip(rows, self.log.body(CAN, "position"), strict=True):
            np.testing.assert_allclose(row["Transform3D:translation"][0], place, rtol=1e-6,
                                       atol=1e-7)
        times = [row["time"] * 1e-9 for row in rows]
        np.testing.assert_allclose(times, self.log.time, atol=1e-6)
        kinetic = [row["Scalars:scalars"][0] for row in found["/values/energy.kinetic"]]
        np.testing.assert_array_equal(kinetic, self.log.columns["energy.kinetic"])
        points = sum(len(row["Points3D:positions"] or []) for row in found["/contacts"])
        self.assertEqual(points, len(self.log.contacts["time"]))

    def test_files_that_are_no_log(self):
        for name, text in (("a.csv", "x,y\n1,2\n"), ("b.csv", ""), ("c.csv", "time,a\n1\n"),
                           ("d.csv", "time,a\n1,b\n"), ("e.jsonl", "{"), ("f.jsonl", "[1]\n"),
                           ("g.npz", "none"), ("h.txt", ""),
                           ("i.jsonl", '{"time": 0}\n{"a": 1}\n')):
            path = self.folder / name
            path.write_text(text)
            with self.subTest(name), self.assertRaises(logs.LogError) as caught:
                logs.read(path)
            self.assertIn(name, str(caught.exception))
        self.assertRaises(OSError, logs.read, self.folder / "gone.csv")

    def test_damaged_and_lying_archives_are_no_log(self):
        whole = (self.runs / "run.npz").read_bytes()
        cut, empty, long = whole[:-100], b"", b'time,"' + b"a" * 200_000 + b'"\n1,2\n'
        bent = bytearray(whole)
        bent[200:400] = bytes(200)
        with np.load(self.runs / "run.npz") as file:
            arrays = {name: file[name] for name in file.files}
        arrays["joint_offsets"] = np.array([0, *[10**9] * (len(arrays["joint_offsets"]) - 1)])
        lying, bomb = io.BytesIO(), io.BytesIO()
        np.savez(lying, **arrays)
        with zipfile.ZipFile(bomb, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("time.npy", bytes(1000))
        said = bytearray(bomb.getvalue())  # of its size in the table of contents
        at = said.rindex(b"PK\x01\x02") + 24
        said[at:at + 4] = (2**32 - 2).to_bytes(4, "little")
        for name, contents in (("cut.npz", cut), ("empty.npz", empty), ("bent.npz", bytes(bent)),
                               ("lying.npz", lying.getvalue()), ("bomb.npz", bytes(said)),
                               ("long.csv", long)):
            path = self.folder / name
            path.write_bytes(contents)
            with self.subTest(name), self.assertRaisesRegex(logs.LogError, name):
                logs.read(path)

    def test_what_cannot_be_read_or_written(self):
        self.assertRaises(logs.LogError, logs.write, self.log, self.folder / "a.xyz")
        self.assertRaises(OSError, logs.write, self.log, self.folder / "no/a.csv")

    def test_the_command(self):
        source, out = self.runs / "run.npz", self.folder / "out.csv"
        self.assertEqual(logs.main([str(source), str(out)]), 0)
        with open(out, newline="") as file:
            self.assertEqual(next(csv.reader(file))[0], "time")
        self.assertEqual(logs.main([str(source), str(source)]), 2)
        self.assertEqual(logs.main([str(self.folder / "gone.csv"), str(out)]), 2)

    @unittest.skipIf(importlib.util.find_spec("mcap"), "mcap is installed")
    def test_a_missing_extra_is_named(self):
        with self.assertRaisesRegex(RuntimeError, r"tenon-usd\[mcap\]"):
            logs.write(self.log, self.folder / "a.mcap")


@unittest.skipIf("sweep_source" in sys.modules, "the wheel is not installed")
class Recorded(unittest.TestCase):
    def test_a_world_is_logged_in_si(self):
        world = tenon_usd.World(GRASP, outputs=["contacts"])
        log = logs.record(world, 1.2, 0.1, contacts=True)
        self.assertEqual(log.units, {"length": "m", "angle": "rad"})
        self.assertEqual(len(log.time), 13)
        np.testing.assert_array_equal(log.body(CAN, "position")[-1],
                                      world.body_poses[0, world.body_names.index(CAN), :3])
        self.assertGreater(len(log.contacts_at(12)), 0)
        self.assertGreater(log.contacts["normalForce"].max(), 0)


if __name__ == "__main__":
    unittest.main()
