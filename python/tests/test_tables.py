# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Tables for pandas and Arrow: scenes, masses, logs and results of sweeps, with their units."""

import contextlib
import io
import subprocess
import sys
import unittest

import numpy as np
import pandas as pd
import pyarrow as pa
import support

import tenon_usd as tenon
from tenon_usd import _tenon, logs, sweep, tables
from tenon_usd.sweep.command import main as run_sweep
from tenon_usd.sweep.signals import OF_ALL, OF_BODIES, OF_JOINTS, PARAMETERS
from tenon_usd.sweep.table import UNITS

PLAN = """
asset = "box.usda"
duration = 0.1
chunk = 2

[[vary]]
name = "mass"
value = "bodyMass@/World/BoxActor"
grid = [1, 2, 4]

[[metric]]
name = "height"
of = "position.z@/World/BoxActor"
"""
SCENES = [support.HAND, support.GRASP, *sorted(support.SCENES.glob("*.usd[ac]"))]


def told(field):
    return {key.decode(): text.decode() for key, text in (field.metadata or {}).items()}


class Scenes(unittest.TestCase):
    def test_every_list_of_every_example_is_a_table(self):
        filled = set()
        for path in SCENES:
            scene = tenon.physics(path)
            for name, column in type(scene).COLUMNS.items():
                objects = getattr(scene, name)
                if not column["type"].startswith("List[") or not objects.columns:
                    continue
                table, frame = objects.to_arrow(), objects.to_pandas()
                table.validate(full=True)
                self.assertEqual(table.num_rows, len(objects), name)
                self.assertEqual(table.column_names, list(objects.columns), name)
                if len(objects):
                    filled.add(name)
                    self.assertEqual(len(frame), len(objects), name)
                # The types are those of the fields, whatever there is.
                kind = column["type"][5:-1]
                if hasattr(_tenon, kind):
                    empty = tables.to_arrow(Empty(getattr(_tenon, kind).COLUMNS))
                    self.assertEqual(table.schema, empty.schema, name)
        self.assertLessEqual({"scenes", "bodies", "colliders", "meshes", "materials", "joints"},
                             filled)

    def test_arrow_has_units_and_the_values(self):
        bodies = tenon.physics(support.HAND).bodies
        table = bodies.to_arrow()
        self.assertEqual(table["mass"].to_pylist(), [body.mass for body in bodies])
        self.assertEqual(table["path"].to_pylist(), [body.path for body in bodies])
        np.testing.assert_array_equal(np.array(table["inertia"].to_pylist()),
                                      bodies.column("inertia"))
        self.assertEqual(table.schema.field("inertia").type,
                         pa.list_(pa.list_(pa.float64(), 3), 3))
        self.assertEqual(told(table.schema.field("mass"))["unit"], "kg")
        self.assertEqual(told(table.schema.field("position"))["unit"], "m")
        joints = tenon.physics(support.HAND).joints
        table = joints.to_arrow()
        self.assertEqual(told(table.schema.field("body0"))["refers"], "bodies")
        drives = table.schema.field("drives").type.value_type
        self.assertIn("N m/rad", told(drives.field("stiffness"))["unit"])
        self.assertEqual([[each["stiffness"] for each in row] for row in
                          table["drives"].to_pylist()],
                         [[each.stiffness for each in joint.drives] for joint in joints])

    def test_pandas_has_a_column_for_each_number(self):
        scene = tenon.physics(support.HAND)
        frame = scene.bodies.to_pandas()
        self.assertEqual(frame["mass"].tolist(), [body.mass for body in scene.bodies])
        np.testing.assert_array_equal(frame[["position.x", "position.y", "position.z"]],
                                      scene.bodies.column("position"))
        self.assertEqual(frame["inertia.xy"][2], scene.bodies[2].inertia[0, 1])
        self.assertEqual(frame["orientation.w"][3], scene.bodies[3].orientation[0])
        self.assertEqual(frame.attrs["units"]["inertia.zz"], "kg m^2")
        self.assertNotIn("path", frame.attrs["units"])
        joints = scene.joints.to_pandas()
        driven = joints[joints["drives"].map(len) > 0]
        self.assertGreater(len(driven), 0)
        self.assertIsInstance(driven["drives"].iloc[0][0]["stiffness"], float)


class Empty:
    """A list of a scene with nothing in it."""

    def __init__(self, columns):
        self.columns = columns

    def column(self, name):
        return []


class Masses(support.FilesTestCase):
    def test_the_table_of_masses(self):
        rows = tenon.open(support.HAND).masses()
        self.assertIsInstance(rows, list)
        frame = rows.to_pandas()
        self.assertEqual(frame["path"].tolist(), [row["path"] for row in rows])
        self.assertEqual(frame["resolved.mass"].tolist(), [row["resolved"]["mass"] for row in rows])
        self.assertEqual(frame["resolved.inertia.yz"][1], rows[1]["resolved"]["inertia"][5])
        units = frame.attrs["units"]
        self.assertEqual((units["resolved.mass"], units["resolved.centerOfMass.x"],
                          units["resolved.inertia.xx"]), ("kg", "m", "kg m^2"))
        table = rows.to_arrow()
        self.assertEqual(told(table.schema.field("resolved.mass"))["unit"], "kg")
        self.assertEqual(table["reason.mass"].to_pylist(), [row["reason"]["mass"] for row in rows])

    def test_what_is_not_authored_is_no_number(self):
        row = {"path": "/a", "authored": {"mass": None, "centerOfMass": None}}
        other = {"path": "/b", "authored": {"mass": 2.0, "centerOfMass": [1.0, 2.0, 3.0]}}
        frame = tables.Rows([row, other]).to_pandas()
        self.assertTrue(np.isnan(frame["authored.mass"][0]))
        self.assertEqual(frame["authored.centerOfMass.z"][1], 3.0)
        self.assertNotIn("authored.centerOfMass", frame)
        self.assertEqual(len(tables.Rows().to_pandas()), 0)


class Logs(unittest.TestCase):
    def test_a_log_is_a_table(self):
        world = tenon.World(support.GRASP, outputs=["contacts"])
        log = logs.record(world, 0.1, contacts=True)
        frame = log.to_pandas()
        self.assertEqual(frame["time"].tolist(), log.time.tolist())
        np.testing.assert_array_equal(frame["/World/can.position.z"],
                                      log.body("/World/can", "position")[:, 2])
        units = frame.attrs["units"]
        self.assertEqual(
            [units[name] for name in (
                "time", "/World/can.position.z", "/World/can.linearVelocity.x",
                world.joint_names[0] + ".position", "energy.kinetic")],
            ["s", "m", "m/s", "rad or m", "J"])
        self.assertNotIn("/World/can.orientation.w", units)
        table = log.to_arrow()
        self.assertEqual(told(table.schema.field("energy.kinetic"))["unit"], "J")
        contacts = log.contact_table()
        self.assertGreater(len(contacts), 0)
        self.assertEqual(contacts.to_pandas().attrs["units"]["depth"], "m")

    def test_units_of_logs_of_the_command(self):
        log = logs.Log(np.zeros(1), {"/a.position.x": np.zeros(1)})
        self.assertEqual([log.unit_of(name) for name in (
            "/a.position.x", "/a.position", "/a.angularVelocity.x", "/j.driveEffort.rotX",
            "/j.reactionTorque.y", "work.drives", "/b.orientation.w", "/odd")],
            ["stage unit", "deg or stage unit", "deg/s", "N m or N", "N m", "J", "", ""])


GRIDS = """
asset = "box.usda"
engine = "mujoco"
duration = 0.05
samples = 2
chunk = 4
[[vary]]
name = "pull"
scale = "gravity"
grid = [0.5, 1]
[[vary]]
name = "friction"
scale = "colliderFriction"
grid = [1, 2, 3]
[[vary]]
name = "mass"
scale = "bodyMass"
random = [0.5, 2]
[[metric]]
name = "height"
of = "position.z@/World/BoxActor"
"""


class Sweeps(support.FilesTestCase):
    def swept(self, form):
        self.written("box.usda", (support.SCENES / "box_on_box.usda").read_text())
        plan = self.written("plan.toml", PLAN)
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            code = run_sweep([str(plan), "-o", str(self.folder / form), "--format", form])
        self.assertEqual(code, 0)
        return self.folder / form

    def test_results_are_a_table_in_every_format(self):
        frames = []
        for form in ("parquet", "csv", "npz"):
            folder = self.swept(form)
            frames.append(sweep.read(folder).to_pandas())
            (folder / f"result.{form}").unlink()  # the chunks have the same
            pd.testing.assert_frame_equal(sweep.read(folder).to_pandas(), frames[-1])
            pd.testing.assert_frame_equal(frames[0], frames[-1])
        self.assertEqual(frames[0]["mass"].tolist(), [1, 2, 4])
        self.assertEqual(frames[0].attrs["units"], {"time": "s", "mass": "kg", "height": "m"})
        (folder / "chunks/00000.npz").unlink()
        table = sweep.read(folder).to_arrow()
        self.assertEqual(table["case"].to_pylist(), [2])
        self.assertEqual(told(table.schema.field("height"))["unit"], "m")
        with self.assertRaises(sweep.FolderError):
            sweep.read(self.folder)

    def test_grids_are_dimensions_of_xarray(self):
        import xarray

        self.written("box.usda", (support.SCENES / "box_on_box.usda").read_text())
        plan = self.written("grids.toml", GRIDS)
        folder = self.folder / "grids"
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(run_sweep([str(plan), "-o", str(folder), "--format", "csv"]), 0)
        table = sweep.read(folder)
        data = table.to_xarray()
        self.assertIsInstance(data, xarray.Dataset)
        self.assertEqual(dict(data.sizes), {"pull": 2, "friction": 3, "sample": 2})
        self.assertEqual(data["height"].dims, ("pull", "friction", "sample"))
        self.assertEqual(data["mass"].dims, ("sample",))
        self.assertEqual(data["height"].attrs["units"], "m")
        frame = table.to_pandas()
        for row in frame.itertuples():
            cell = data.sel(pull=row.pull, friction=row.friction).isel(
                sample=row.case % 2)
            self.assertEqual((float(cell["height"]), float(cell["mass"])), (row.height, row.mass))
        (folder / "result.csv").unlink()
        (folder / "chunks/00001.csv").unlink()
        part = sweep.read(folder).to_xarray()["height"].values.reshape(-1)
        np.testing.assert_array_equal(np.isnan(part), [0] * 4 + [1] * 4 + [0] * 4)
        rows = tables.Table({"a": [1.0, 2.0]}, {"a": "kg"}).to_xarray()
        self.assertEqual((rows["a"].dims, rows["a"].attrs), (("row",), {"units": "kg"}))

    def test_units_are_those_of_the_fields(self):
        kinds = {"bodies": _tenon.Body, "colliders": _tenon.Collider, "joints": _tenon.Joint,
                 "drives": _tenon.Drive}
        materials = _tenon.Material.COLUMNS
        for name, (where, field) in PARAMETERS.items():
            column = kinds[where].COLUMNS.get(field) or materials[field]
            self.assertEqual(UNITS[name], column["unit"], name)
        self.assertLessEqual({*OF_BODIES, *OF_JOINTS, *OF_ALL}, set(UNITS))


class Absent(unittest.TestCase):
    def test_what_is_missing_is_said_with_how_to_get_it(self):
        for module, extra, call in (("pandas", "pandas", "to_pandas"),
                                    ("pyarrow", "arrow", "to_arrow")):
            code = (f"import sys; sys.modules[{module!r}] = None\n"
                    "import tenon_usd as tenon\n"
                    f"bodies = tenon.physics({str(support.HAND)!r}).bodies\n"
                    f"try: bodies.{call}()\n"
                    "except tenon.MissingError as error: print(error)")
            done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
            self.assertIn(f"pip install 'tenon-usd[{extra}]'", done.stdout, done.stderr)


if __name__ == "__main__":
    support.main()
