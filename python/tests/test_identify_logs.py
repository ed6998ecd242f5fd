#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Logs of robots: each format says the same, what is wrong is told with file, row and column, units
and signs are checked. No wheel is needed.

TENON_EXTRAS=1: a library that is missing is a failure.
"""

import importlib.util
import io
import json
import math
import os
import pathlib
import shutil
import tempfile
import unittest

import numpy as np

if importlib.util.find_spec("tenon_usd") is None:
    import sweep_source  # noqa: F401
from tenon_usd.errors import MissingError  # noqa: E402
from tenon_usd.identify.channels import Reading  # noqa: E402
from tenon_usd.identify.joints import AssetJoint  # noqa: E402
from tenon_usd.identify.log import LogError  # noqa: E402
from tenon_usd.identify.log_files import read_log  # noqa: E402

JOINTS = (AssetJoint("/arm/shoulder", "/arm/shoulder", "rotZ", True, -2.0, 2.0, 6.0, 10.0,
                     has_drive=True, stiffness=50.0),
          AssetJoint("/arm/rail", "/arm/rail", "transX", False, -0.5, 0.5, 1.0))
TIMES = np.arange(0, 4, 0.01)


def turned(times):
    return 0.8 * np.sin(3 * times) + 0.3 * np.sin(11 * times + 1)


def slid(times):
    return 0.1 * np.sin(2 * times)


def speed(of, times):
    return (of(times + 1e-5) - of(times - 1e-5)) / 2e-5


def needs(*names):
    missing = [name for name in names if importlib.util.find_spec(name) is None]
    if missing and os.environ.get("TENON_EXTRAS"):
        raise AssertionError(f"missing: {missing}")
    return unittest.skipIf(missing, f"not installed: {missing}")


class Files(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tenon-logs-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def csv(self, head, columns, name="log.csv"):
        rows = [",".join("" if value is None else repr(float(value)) for value in row)
                for row in zip(*columns, strict=True)]
        return self.text("\n".join([head, *rows]) + "\n", name)

    def text(self, text, name="log.csv"):
        (self.folder / name).write_text(text, encoding="utf-8")
        return self.folder / name

    def refused(self, path, rule, line=None, **how):
        with self.assertRaises(LogError) as caught:
            read_log(path, JOINTS, Reading(**how))
        error = caught.exception
        self.assertEqual(error.rule, rule, str(error))
        if line is not None:
            self.assertEqual(error.line, line, str(error))
        if error.file:
            self.assertIn(str(error.file), str(error))
        self.assertTrue(error.fix, str(error))
        return error

    def usual(self):
        return self.csv("time,shoulder.position,shoulder.velocity,shoulder.command,rail.position",
                        [TIMES, turned(TIMES - 0.02), speed(turned, TIMES - 0.02), turned(TIMES),
                         slid(TIMES)])


class Tables(Files):
    def same(self, log):
        self.assertEqual(log.joints, ("/arm/shoulder", "/arm/rail"))
        np.testing.assert_allclose(log.position[:, 0], turned(TIMES - 0.02), atol=1e-6)
        np.testing.assert_allclose(log.position[:, 1], slid(TIMES), atol=1e-6)
        np.testing.assert_allclose(log.velocity[:, 0], speed(turned, TIMES - 0.02), atol=1e-5)
        self.assertTrue(np.all(np.isnan(log.velocity[:, 1])))
        np.testing.assert_allclose(log.command_position[:, 0], turned(TIMES), atol=1e-6)
        self.assertIsNone(log.effort)

    def test_names_of_columns(self):
        self.same(read_log(self.usual(), JOINTS)[0])
        for names in ("t,pos_shoulder,shoulder_vel,shoulder_cmd_pos,rail",
                      "time [s];/arm/shoulder.position;/arm/shoulder.velocity;"
                      "/arm/shoulder.target_position;/arm/rail.position",
                      "seconds,q_shoulder,dq_shoulder,desired.q.shoulder,state.rail.pos",
                      "stamp,observation.state.shoulder.pos,shoulder/qd,action.shoulder.pos,"
                      "RAIL.position"):
            text = self.usual().read_text().split("\n", 1)
            separator = ";" if ";" in names else ","
            path = self.text("# a comment\n\n" + names + "\n" + text[1].replace(",", separator))
            if "/arm/shoulder.position" in names:  # as `tenon sim` writes them: degrees
                self.same(read_log(path, JOINTS, Reading(units=("rad", "m")))[0])
                continue
            self.same(read_log(path, JOINTS)[0])

    def test_times_of_clocks_lose_no_digit(self):
        start = 1_700_000_000_000_000_000
        stamps = start + np.round(TIMES * 1e9).astype(np.int64)
        rows = [f"{stamp},{place!r}" for stamp, place in zip(stamps, turned(TIMES).tolist(),
                                                            strict=True)]
        log, _ = read_log(self.text("stamp_ns,shoulder\n" + "\n".join(rows) + "\n"), JOINTS)
        np.testing.assert_allclose(log.times, TIMES, atol=1e-9)
        log, _ = read_log(self.csv("time_ms,shoulder", [TIMES * 1e3, turned(TIMES)]), JOINTS)
        np.testing.assert_allclose(log.times, TIMES, atol=1e-12)

    def test_mapped_names_units_and_signs(self):
        path = self.csv("time,j1.pos,col7", [TIMES, -np.degrees(turned(TIMES)),
                                             np.degrees(turned(TIMES))])
        log, _ = read_log(path, JOINTS, Reading(
            mapping={"j1": "shoulder", "col7": "shoulder.command_position"}, units=("deg",),
            signs={"shoulder.position": -1.0}))
        np.testing.assert_allclose(log.position[:, 0], turned(TIMES), atol=1e-12)
        np.testing.assert_allclose(log.command_position[:, 0], turned(TIMES), atol=1e-12)
        path = self.csv("time,shoulder_pos_deg,rail_mm", [TIMES, np.degrees(turned(TIMES)),
                                                         1000 * slid(TIMES)])
        log, _ = read_log(path, JOINTS)
        np.testing.assert_allclose(log.position, np.stack([turned(TIMES), slid(TIMES)], 1),
                                   atol=1e-12)

    def test_commands_of_another_table_hold(self):
        path = self.csv("time,shoulder.position", [TIMES, turned(TIMES)])
        commands = self.csv("time,/arm/shoulder.target,/arm/shoulder.effort",
                            [[0, 1, 2.5], [10, 20, 30], [0.1, None, 0.3]], "commands.csv")
        log, _ = read_log(path, JOINTS, Reading(commands=commands, check=False))
        np.testing.assert_allclose(np.degrees(log.command_position[[0, 99, 100, 249, 250], 0]),
                                   [10, 10, 20, 20, 30])
        np.testing.assert_allclose(log.command_effort[[0, 150, 300], 0], [0.1, 0.1, 0.3])
        late = self.csv("time,/arm/shoulder.target", [[1, 2], [10, 20]], "late.csv")
        log, notes = read_log(path, JOINTS, Reading(commands=late, check=False))
        self.assertEqual((log.times[0], notes[0].rule), (1.0, "log.no-command"))
        other = self.csv("time,/arm/shoulder.target", [[100, 101], [1, 2]], "other.csv")
        self.refused(path, "log.clock", commands=other)

    def test_archives(self):
        path = self.folder / "log.npz"
        nothing = np.full(len(TIMES), np.nan)
        np.savez(path, time=TIMES, joints=["shoulder", "rail"],
                 position=np.stack([turned(TIMES - 0.02), slid(TIMES)], 1),
                 velocity=np.stack([speed(turned, TIMES - 0.02), nothing], 1),
                 command_position=np.stack([turned(TIMES), nothing], 1))
        self.same(read_log(path, JOINTS)[0])
        np.savez(path, time=TIMES, joints=["shoulder"], position=turned(TIMES))
        self.refused(path, "log.unknown-channel")
        np.savez(path, time=TIMES, joints=["shoulder", "rail", "more"],
                 position=np.stack([turned(TIMES), slid(TIMES)], 1))
        self.refused(path, "log.ragged")
        np.savez(path, time=TIMES, position=np.array([{}], dtype=object))
        self.refused(path, "log.damaged")


class Refused(Files):
    def test_rows(self):
        lines = self.usual().read_text().split("\n")
        for change, rule, line in (
                (lambda rows: rows[50].rsplit(",", 1)[0], "log.ragged", 51),
                (lambda rows: rows[50] + ",1", "log.ragged", 51),
                (lambda rows: rows[50].replace(",", ",x", 1), "log.number", 51),
                (lambda rows: rows[49], "log.repeated-row", 51),
                (lambda rows: "0.485" + rows[50][rows[50].index(","):], "log.time-order", 52),
                (lambda rows: "0.1" + rows[50][rows[50].index(","):], "log.time-order", 51),
                (lambda rows: "nan" + rows[50][rows[50].index(","):], "log.time", 51),
                (lambda rows: rows[50].split(",")[0] + ",nan,0,0,0", "log.not-finite", 51),
                (lambda rows: rows[50].split(",")[0] + ",,0,0,0", "log.not-finite", 51),
                (lambda rows: rows[50].split(",")[0] + ",inf,0,0,0", "log.not-finite", 51)):
            rows = list(lines)
            rows[50] = change(rows)
            if line == 52:  # a time that is too late makes the next one go back
                rows[50] = "0.515" + rows[50][rows[50].index(","):]
            error = self.refused(self.text("\n".join(rows)), rule, line)
            self.assertIn(":" + str(line), str(error))
        gone = self.text("\n".join(lines[:50] + lines[90:]))
        self.refused(gone, "log.gap", 51)
        log, notes = read_log(gone, JOINTS, Reading(allow_gaps=True))
        self.assertEqual([note.rule for note in notes], ["log.gap"])
        rows = list(lines)
        rows[50] = rows[50].split(",")[0] + ",,0,0,0"
        log, notes = read_log(self.text("\n".join(rows)), JOINTS, Reading(allow_gaps=True))
        self.assertEqual((len(log), notes[0].rule), (len(TIMES) - 1, "log.not-finite"))

    def test_columns(self):
        place = [TIMES, turned(TIMES)]
        self.refused(self.csv("time,elbow.position", place), "log.unknown-channel", 1)
        error = self.refused(self.csv("time,shoulder.temperature", place), "log.unknown-channel")
        self.assertEqual(error.channel, "shoulder.temperature")
        self.refused(self.csv("when,shoulder", place), "log.no-time", 1)
        self.refused(self.csv("time,time", place), "log.columns", 1)
        self.refused(self.csv("time,", place), "log.columns", 1)
        both = [TIMES, turned(TIMES), turned(TIMES)]
        self.refused(self.csv("time,shoulder,shoulder.pos", both), "log.twice")
        path = self.csv("time,shoulder,battery", both)
        self.refused(path, "log.unknown-channel", 1)
        _, notes = read_log(path, JOINTS, Reading(ignore=("bat.*",)))
        self.assertEqual(notes[0].rule, "log.ignored")
        self.refused(path, "log.ignore", ignore=("(a+)+$",))
        self.refused(path, "log.joint", mapping={"battery": "elbow"}, ignore=("bat.*",))
        self.refused(path, "log.unknown-channel", mapping={"gone": "shoulder"})
        self.refused(self.csv("time,shoulder.velocity", place), "log.no-joint")
        self.refused(self.text(""), "log.empty")
        self.refused(self.text("time,shoulder\n"), "log.samples")
        self.refused(self.text("x", "log.xyz"), "log.format")
        self.refused(self.folder, "log.format")
        self.assertRaises(FileNotFoundError, read_log, self.folder / "none.csv", JOINTS)

    def test_numbers_that_are_none_of_the_asset(self):
        place, moves = turned(TIMES), speed(turned, TIMES)
        for columns, rule, fix in (
                ({"shoulder": np.degrees(place)}, "log.units", "--units deg"),
                ({"rail": 1000 * slid(TIMES)}, "log.units", "--units mm"),
                ({"shoulder": place, "shoulder.vel": np.degrees(moves)}, "log.units", ""),
                ({"shoulder": place, "shoulder.vel": -moves}, "log.sign", "--sign shoulder"),
                ({"shoulder": -place, "shoulder.cmd": place}, "log.sign", "--sign shoulder"),
                ({"shoulder": place, "shoulder.cmd": np.degrees(place)}, "log.units", ""),
                ({"shoulder": place + 2.5}, "log.range", "another joint"),
                ({"rail": place}, "log.range", "another joint")):
            path = self.csv(",".join(["time", *columns]), [TIMES, *columns.values()])
            error = self.refused(path, rule)
            self.assertIn(fix, error.fix)
            read_log(path, JOINTS, Reading(check=False))
        # A joint that only shakes tells no sign.
        read_log(self.csv("time,shoulder,shoulder.vel", [TIMES, 0.004 * place, -0.004 * moves]),
                 JOINTS)
        # Nearly at a limit, and a little beyond: as encoders have it.
        path = self.csv("time,shoulder", [TIMES, 2.03 * np.sin(TIMES)])
        read_log(path, JOINTS)
        _, notes = read_log(self.csv("time,shoulder", [TIMES, place]), JOINTS,
                            Reading(units=("deg",)))
        self.assertEqual([note.rule for note in notes], ["log.units"])

    def mutated(self, contents, count, seed):
        random = np.random.default_rng(seed)
        for _ in range(count):
            data = bytearray(contents)
            for _ in range(int(random.integers(1, 5))):
                at = int(random.integers(len(data)))
                how = random.integers(4)
                if how == 0:
                    data[at] ^= 1 << int(random.integers(8))
                elif how == 1:
                    del data[at:at + int(random.integers(1, 200))]
                elif how == 2:
                    data[at:at] = bytes(random.integers(0, 256, 8, dtype=np.uint8))
                else:
                    del data[at:]
                if not data:
                    break
            yield bytes(data)

    def survives(self, path, contents, count):
        """Read, or refused with a place: nothing else comes out. -> how many were refused."""
        refused = 0
        for number, data in enumerate(self.mutated(contents, count, 5)):
            path.write_bytes(data)
            try:
                read_log(path, JOINTS)
            except LogError as error:
                refused += 1
                self.assertTrue(error.rule.startswith("log."), error)
                self.assertTrue(error.file, f"{number}: {error}")
            except Exception as error:  # noqa: BLE001
                self.fail(f"file {number} raises {error!r}")
        return refused

    def test_damaged_tables(self):
        path = self.usual()
        self.assertGreater(self.survives(path, path.read_bytes()[:6000], 150), 100)

    def test_damaged_archives(self):
        path = self.folder / "log.npz"
        for save in (np.savez, np.savez_compressed):
            save(path, time=TIMES[:50], joints=["shoulder"], position=turned(TIMES[:50])[:, None])
            self.assertGreater(self.survives(path, path.read_bytes(), 100), 30)

    @needs("pyarrow")
    def test_damaged_parquet(self):
        import pyarrow
        import pyarrow.parquet
        path = self.folder / "log.parquet"
        table = pyarrow.table({"time": TIMES[:50], "shoulder.position": turned(TIMES[:50])})
        pyarrow.parquet.write_table(table, path)
        self.assertGreater(self.survives(path, path.read_bytes(), 150), 50)


class Columns(Files):
    @needs("pyarrow")
    def test_parquet_and_lerobot(self):
        import pyarrow
        import pyarrow.parquet
        path = self.folder / "log.parquet"
        pyarrow.parquet.write_table(pyarrow.table({
            "timestamp": TIMES, "shoulder.pos": turned(TIMES), "name": ["x"] * len(TIMES)}), path)
        log, _ = read_log(path, JOINTS)
        np.testing.assert_array_equal(log.position[:, 0], turned(TIMES))

        def episode(number):
            states = np.stack([turned(TIMES), slid(TIMES)], 1) * (1 - 0.1 * number)
            return {"timestamp": TIMES.astype(np.float32), "observation.state": list(states),
                    "action": list(states), "frame_index": np.arange(len(TIMES)),
                    "episode_index": np.full(len(TIMES), number),
                    "index": np.arange(len(TIMES)), "task_index": np.zeros(len(TIMES))}
        names = {"dtype": "float32", "shape": [2], "names": ["shoulder.pos", "rail.pos"]}
        for version, where in (("v2.1", "data/chunk-{episode_chunk:03d}/episode_"
                                "{episode_index:06d}.parquet"),
                               ("v3.0", "data/chunk-{chunk_index:03d}/file-{file_index:03d}"
                                ".parquet")):
            folder = self.folder / version
            (folder / "meta").mkdir(parents=True)
            (folder / "data/chunk-000").mkdir(parents=True)
            (folder / "meta/info.json").write_text(json.dumps({
                "codebase_version": version, "total_episodes": 2, "chunks_size": 1000,
                "data_path": where, "fps": 100,
                "features": {"observation.state": names, "action": names,
                             "timestamp": {"dtype": "float32", "shape": [1], "names": None}}}))
            both = [pyarrow.table(episode(number)) for number in (0, 1)]
            if version == "v2.1":
                for number, table in enumerate(both):
                    pyarrow.parquet.write_table(table, folder / "data/chunk-000" /
                                                f"episode_{number:06d}.parquet")
            else:
                pyarrow.parquet.write_table(pyarrow.concat_tables(both),
                                            folder / "data/chunk-000/file-000.parquet")
            self.refused(folder, "log.episodes")
            self.refused(folder, "log.episodes", episode=2)
            log, _ = read_log(folder, JOINTS, Reading(episode=1))
            np.testing.assert_allclose(log.position[:, 0], 0.9 * turned(TIMES), atol=1e-6)
            np.testing.assert_allclose(log.command_position[:, 1], 0.9 * slid(TIMES), atol=1e-6)
            self.assertEqual(log.row(0), 1 if version == "v2.1" else len(TIMES) + 1)
            (folder / "meta/info.json").write_text("{")
            self.refused(folder, "log.damaged")

    @unittest.skipIf(importlib.util.find_spec("mcap"), "mcap is installed")
    def test_without_mcap_it_says_what_to_install(self):
        (self.folder / "log.mcap").write_bytes(b"")
        with self.assertRaisesRegex(MissingError, r"tenon-usd\[bags\]"):
            read_log(self.folder / "log.mcap", JOINTS)

    @unittest.skipIf(importlib.util.find_spec("rosbags"), "rosbags is installed")
    def test_without_rosbags_it_says_what_to_install(self):
        (self.folder / "metadata.yaml").write_text("")
        with self.assertRaisesRegex(MissingError, r"tenon-usd\[bags\]"):
            read_log(self.folder, JOINTS)


STAMP = 1_700_000_000_000_000_000


class Ros(Files):
    def stamps(self):
        return [STAMP + round(float(time) * 1e9) for time in TIMES]

    def same(self, log):
        np.testing.assert_allclose(log.times, TIMES, atol=1e-9)
        np.testing.assert_allclose(log.position[:, 0], turned(TIMES), atol=1e-12)
        np.testing.assert_allclose(log.velocity[:, 1], speed(slid, TIMES), atol=1e-6)

    @needs("mcap")
    def test_mcap_with_json(self):
        from mcap.writer import Writer
        sink = io.BytesIO()
        writer = Writer(sink)
        writer.start()
        schema = writer.register_schema("sensor_msgs/msg/JointState", "jsonschema", b"{}")
        states = writer.register_channel("/joint_states", "json", schema)
        commands = writer.register_channel("/joint_commands", "json", schema)
        other = writer.register_channel("/rosout", "json", 0)
        for number, stamp in enumerate(self.stamps()):
            time = TIMES[number]
            for channel, message in ((states, {
                    "name": ["shoulder", "rail"], "position": [turned(time), slid(time)],
                    "velocity": [speed(turned, time), speed(slid, time)], "effort": []}),
                    (commands, {"name": ["shoulder"], "position": [turned(time + 0.02)]}),
                    (other, {"text": "hello"})):
                writer.add_message(channel, stamp, json.dumps(message).encode(), stamp, number)
        writer.finish()
        path = self.folder / "log.mcap"
        path.write_bytes(sink.getvalue())
        log, _ = read_log(path, JOINTS)
        self.same(log)
        np.testing.assert_allclose(log.command_position[:, 0], turned(TIMES + 0.02), atol=1e-12)
        path.write_bytes(sink.getvalue()[:len(sink.getvalue()) // 2])
        self.refused(path, "log.damaged")
        self.assertGreater(Refused.survives(self, path, sink.getvalue(), 40), 10)

    mutated = Refused.mutated

    @needs("mcap", "rosbags")
    def test_bags_and_mcap_of_ros(self):
        from mcap.writer import Writer
        from rosbags.rosbag2 import StoragePlugin
        from rosbags.rosbag2 import Writer as BagWriter
        from rosbags.typesys import Stores, get_typestore
        store = get_typestore(Stores.ROS2_HUMBLE)
        types = store.types
        Header, Stamp = types["std_msgs/msg/Header"], types["builtin_interfaces/msg/Time"]
        State = types["sensor_msgs/msg/JointState"]
        Trajectory = types["trajectory_msgs/msg/JointTrajectory"]
        Point = types["trajectory_msgs/msg/JointTrajectoryPoint"]
        Duration = types["builtin_interfaces/msg/Duration"]
        nothing = np.zeros(0)

        def header(stamp):
            return Header(stamp=Stamp(sec=stamp // 10**9, nanosec=stamp % 10**9), frame_id="")

        def state(number, stamp, extra=()):
            time = TIMES[number]
            return State(header=header(stamp), name=["shoulder", "rail", *extra],
                         position=np.array([turned(time), slid(time)]),
                         velocity=np.array([speed(turned, time), speed(slid, time)]),
                         effort=nothing)

        def point(seconds, place):
            return Point(positions=np.array([place]), velocities=nothing, accelerations=nothing,
                         effort=nothing, time_from_start=Duration(
                             sec=int(seconds), nanosec=round(seconds % 1 * 1e9)))
        told = Trajectory(header=header(0), joint_names=["shoulder"],
                          points=[point(0.5, 0.2), point(1.5, 0.6)])

        for plugin in (StoragePlugin.SQLITE3, StoragePlugin.MCAP):
            folder = self.folder / plugin.name
            with BagWriter(folder, version=9, storage_plugin=plugin) as writer:
                states = writer.add_connection("/joint_states", State.__msgtype__,
                                               typestore=store)
                plans = writer.add_connection("/arm/joint_trajectory", Trajectory.__msgtype__,
                                              typestore=store)
                writer.write(plans, STAMP, store.serialize_cdr(told, told.__msgtype__))
                for number, stamp in enumerate(self.stamps()):
                    writer.write(states, stamp + 3_000_000, store.serialize_cdr(
                        state(number, stamp), State.__msgtype__))
            log, _ = read_log(folder, JOINTS)
            self.same(log)  # by the stamps of the headers, not those of the recording
            np.testing.assert_allclose(log.command_position[[60, 100, 150, 300], 0],
                                       [0.24, 0.4, 0.6, 0.6], atol=1e-9)
            self.refused(folder, "log.no-joint", topics=("/other",))

        sink = io.BytesIO()
        writer = Writer(sink)
        writer.start(profile="ros2")
        schema = writer.register_schema("sensor_msgs/msg/JointState", "ros2msg", b"")
        channel = writer.register_channel("/joint_states", "cdr", schema)
        for number, stamp in enumerate(self.stamps()):
            data = store.serialize_cdr(state(number, stamp), State.__msgtype__)
            writer.add_message(channel, stamp, bytes(data), stamp, number)
        writer.finish()
        path = self.folder / "log.mcap"
        path.write_bytes(sink.getvalue())
        self.same(read_log(path, JOINTS)[0])

        folder = self.folder / "ragged"
        with BagWriter(folder, version=9) as writer:
            states = writer.add_connection("/joint_states", State.__msgtype__, typestore=store)
            for number, stamp in enumerate(self.stamps()[:5]):
                writer.write(states, stamp, store.serialize_cdr(
                    state(number, stamp, ["wrist"] if number == 3 else ()), State.__msgtype__))
        self.refused(folder, "log.ragged", 4)


class Faults(Files):
    """What is wrong with a row or a channel is told alike by every reader."""

    #: What is done to samples, and the rule: the row is the 31st sample.
    CASES = (("log.not-finite", lambda times, place: place.__setitem__(30, math.nan)),
             ("log.not-finite", lambda times, place: place.__setitem__(30, math.inf)),
             ("log.gap", lambda times, place: times.__iadd__(np.where(TIMES[:100] > 0.295, 1, 0))),
             ("log.time-order", lambda times, place: times.__setitem__(30, times[29])),
             ("log.time-order", lambda times, place: times.__setitem__(30, times[20])),
             ("log.unknown-channel", None))

    def check(self, write, first_row, rows_of_channels=0):
        """`write(times, place, joint)` gives the path; `first_row` is the row of sample 1."""
        path = write(TIMES[:100], turned(TIMES[:100]), "shoulder")
        self.assertEqual(len(read_log(path, JOINTS)[0]), 100)
        for rule, change in self.CASES:
            times, place = TIMES[:100].copy(), turned(TIMES[:100])
            if change:
                change(times, place)
            with self.subTest(rule, path=path.name):
                path = write(times, place, "shoulder" if change else "elbow")
                error = self.refused(path, rule, first_row + 30 if change else rows_of_channels)
                self.assertTrue(str(error.file).startswith(str(path)))
                self.assertIn(error.channel and ("elbow" if not change else ""), str(error))

    def test_tables(self):
        self.check(lambda times, place, joint: self.csv(f"time,{joint}.position", [times, place]),
                   2, 1)
        self.check(lambda times, place, joint: self.csv(f"time,{joint}.position", [times, place],
                                                        "log.tsv"), 2, 1)

    def test_archives(self):
        path = self.folder / "log.npz"

        def joints(times, place, joint):
            np.savez(path, time=times, joints=[joint], position=place[:, None])
            return path

        def columns(times, place, joint):
            np.savez(path, time=times, columns=[f"{joint}.position"], values=place[:, None])
            return path
        self.check(joints, 1)
        self.check(columns, 1)

    @needs("pyarrow")
    def test_parquet_and_lerobot(self):
        import pyarrow
        import pyarrow.parquet

        def parquet(times, place, joint):
            path = self.folder / "log.parquet"
            pyarrow.parquet.write_table(pyarrow.table({"time": times, f"{joint}.pos": place}), path)
            return path

        def lerobot(times, place, joint):
            folder = self.folder / "set"
            (folder / "meta").mkdir(parents=True, exist_ok=True)
            (folder / "data").mkdir(exist_ok=True)
            (folder / "meta/info.json").write_text(json.dumps({
                "total_episodes": 1, "data_path": "data/file-{episode_index}.parquet",
                "features": {"observation.state": {"names": [f"{joint}.pos"]}}}))
            pyarrow.parquet.write_table(pyarrow.table({
                "timestamp": times, "observation.state": list(place[:, None])}),
                folder / "data/file-0.parquet")
            return folder
        self.check(parquet, 1)
        self.check(lerobot, 1)

    @needs("mcap")
    def test_mcap(self):
        from mcap.writer import Writer

        def mcap(times, place, joint):
            sink = io.BytesIO()
            writer = Writer(sink)
            writer.start()
            channel = writer.register_channel("/joint_states", "json", writer.register_schema(
                "sensor_msgs/msg/JointState", "jsonschema", b"{}"))
            for number, (time, value) in enumerate(zip(times, place, strict=True)):
                stamp = STAMP + round(float(time) * 1e9)
                header = {"stamp": {"sec": stamp // 10**9, "nanosec": stamp % 10**9}}
                writer.add_message(channel, STAMP + number, json.dumps({
                    "header": header, "name": [joint], "position": [value]}).encode(), STAMP)
            writer.finish()
            (self.folder / "log.mcap").write_bytes(sink.getvalue())
            return self.folder / "log.mcap"
        self.check(mcap, 1)

    @needs("rosbags")
    def test_bags(self):
        from rosbags.rosbag2 import Writer
        from rosbags.typesys import Stores, get_typestore
        store = get_typestore(Stores.ROS2_HUMBLE)
        State, Header, Stamp = (store.types[name] for name in (
            "sensor_msgs/msg/JointState", "std_msgs/msg/Header", "builtin_interfaces/msg/Time"))

        def bag(times, place, joint):
            folder = self.folder / "bag"
            shutil.rmtree(folder, ignore_errors=True)
            with Writer(folder, version=9) as writer:
                states = writer.add_connection("/joint_states", State.__msgtype__, typestore=store)
                for number, (time, value) in enumerate(zip(times, place, strict=True)):
                    stamp = STAMP + round(float(time) * 1e9)
                    told = Header(stamp=Stamp(sec=stamp // 10**9, nanosec=stamp % 10**9),
                                  frame_id="")
                    message = State(header=told, name=[joint], position=np.array([value]),
                                    velocity=np.zeros(0), effort=np.zeros(0))
                    writer.write(states, STAMP + number,
                                 store.serialize_cdr(message, State.__msgtype__))
            return folder
        self.check(bag, 1)


if __name__ == "__main__":
    unittest.main()
