# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The verbs as functions, beside what the program in the wheel prints."""

import json
import math
import os
import re
import shutil
import subprocess
import sysconfig
import unittest.mock

import support

import tenon_usd as tenon

ROBOT = support.ROOT / "examples/cpp/robots/arm.urdf"
PROGRAM = os.path.join(sysconfig.get_path("scripts"), "tenon")


def printed(*arguments):
    """The program's answer as JSON, without what stands around every answer."""
    own = {name: value for name, value in os.environ.items()
           if name not in ("LD_PRELOAD", "PYTHONPATH")}  # of python/tests/sanitized.sh
    done = subprocess.run([PROGRAM, *map(str, arguments), "--json"], capture_output=True, env=own)
    answer = json.loads(done.stdout)
    for key in ("tool", "version", "schema", "asset", "ok", "diagnostics"):
        answer.pop(key, None)
    return answer


class Answers(support.FilesTestCase):
    def test_answers_are_those_of_the_program(self):
        stage = tenon.open(support.HAND)
        hand = os.path.relpath(support.HAND)  # the program prints paths as they are given
        self.assertEqual(tenon.info(support.HAND), printed("info", hand))
        self.assertEqual({"prims": stage.tree()}, printed("tree", hand))
        for place in ("/inspire_hand/Geometry/right_base_link",
                      "/inspire_hand/Physics/right_index_1_joint.physics:upperLimit"):
            if place.partition(".")[0] not in stage:
                place = stage.physics().bodies[0].path
            self.assertEqual(tenon.explain(support.HAND, place),
                             printed("explain", hand, place))
            self.assertEqual(tenon.where(support.HAND, place, variants=True),
                             printed("where", hand, place, "--variants"))
        masses = {row["path"]: row["resolved"]["mass"] for row in stage.masses()}
        self.assertEqual(masses, {body.path: body.mass for body in stage.physics().bodies})
        self.assertEqual(len(stage.kinematic_tree()["links"]), len(masses))
        with self.assertRaises(tenon.NotFoundError):
            stage.explain("/nothing")
        with self.assertRaises(tenon.NotFoundError):
            stage.where("/inspire_hand.nothing")

    def test_checks(self):
        path = self.copied_hand()
        self.assertEqual(tenon.check(path)["summary"]["errors"], 0)
        bad = self.written("bad.usda", """#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W"
{
    def Cube "box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 1
        float3 physics:diagonalInertia = (1, 1, 100)
    }
}
""")
        findings = tenon.check(bad)["diagnostics"]
        inertia = [row for row in findings if row["rule"].startswith("mass.")]
        self.assertTrue(inertia, findings)
        self.assertEqual(os.path.abspath(inertia[0]["file"]), str(bad))
        self.assertEqual(inertia[0]["prim"], "/W/box")
        names = [row["rule"] for row in tenon.rules()]
        self.assertIn(inertia[0]["rule"], names)
        self.assertIn(inertia[0]["rule"], tenon.rule(inertia[0]["rule"]))
        with self.assertRaises(KeyError):
            tenon.rule("no.such-rule")

    def test_suggestions_are_written_where_they_are_asked_for(self):
        path = self.written("typed.usda", """#usda 1.0
(
    defaultPrim = "W"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "W"
{
    def Cube "box" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    )
    {
        vector3f velocity = (1, 0, 0)
    }
}
""")
        with self.assertRaises(tenon.Error) as raised:
            tenon.check(path, suggested=True)
        self.assertEqual(raised.exception.fix, "give fix=True, too")
        def rules(answer):
            return [row["rule"] for row in answer["diagnostics"]]
        self.assertIn("attribute.unprefixed", rules(tenon.check(path, fix=True)))
        self.assertIn("vector3f velocity", path.read_text())
        answer = tenon.check(path, fix=True, suggested=True)
        self.assertNotIn("attribute.unprefixed", rules(tenon.check(path)))
        self.assertIn("vector3f physics:velocity", path.read_text())
        self.assertEqual(len(answer["corrected"]), 1)

    def test_differences(self):
        path = self.copied_hand()
        other = self.folder / "other"
        shutil.copytree(path.parent, other)
        self.assertTrue(tenon.diff(path, other / path.name, mode="physics")["equal"])
        stage = tenon.open(other / path.name)
        joint = stage.physics().joints[3].path
        stage[joint]["physics:upperLimit"] = 5.0
        stage.save()
        answer = tenon.diff(path, other / path.name, mode="physics")
        self.assertFalse(answer["equal"])
        self.assertIn(joint, [row["path"] for row in answer["differences"]])
        with self.assertRaises(ValueError):
            tenon.diff(path, path, mode="nothing")

    def test_engines_are_compared(self):
        answer = tenon.compare(support.SCENES / "box_on_box.usda", ["mujoco", "jolt"],
                               duration=0.2, reasons=False, bounds="10m")
        self.assertEqual([row["engine"] for row in answer["engines"]], ["mujoco", "jolt"])
        self.assertEqual(len(answer["pairs"]), 1)
        self.assertEqual(answer["exceeded"], [])


class Tuning(support.FilesTestCase):
    JOINT = "right_index_1_joint"

    def test_gains_are_those_of_the_program(self):
        path = self.copied_hand()
        name = os.path.relpath(path)
        told = tenon.tune(path, joints=[self.JOINT], frequency=8, damping_ratio=1)
        told.pop("diagnostics")
        self.assertEqual(told, printed("tune", name, "--joints", self.JOINT, "--frequency", 8,
                                       "--damping-ratio", 1))
        saved = tenon.tune(path, joints=[self.JOINT], frequency=8, damping_ratio=1, save=True)
        self.assertTrue(saved["written"])
        rows = {row["joint"]: row for row in tenon.tune(path, joints=[self.JOINT])["drives"]}
        row = rows[f"/inspire_hand/Physics/{self.JOINT}"]
        self.assertAlmostEqual(row["frequencyHz"], 8, 5)
        result = tenon.tune(path, joints=[self.JOINT], test="snap", engine="mujoco",
                            time_step=0.002)["engines"][0]["results"]
        self.assertEqual([one["verdict"] for one in result], ["pass"])

    def test_what_makes_no_sense_is_refused(self):
        for wrong in ({"save": True}, {"frequency": 0}, {"masses": [1.0]}, {"search": True,
                      "frequency": 1}, {"test": "snip"}, {"time_step": -1}):
            with self.assertRaises((ValueError, tenon.InvalidError), msg=wrong):
                tenon.tune(support.HAND, **wrong)
        for wrong in ({"gap": 0.1}, {"save": True}, {"budget": 8, "approximation": "hull"},
                      {"approximation": "hulls"}):
            with self.assertRaises((ValueError, tenon.InvalidError), msg=wrong):
                tenon.colliders(support.HAND, **wrong)

    def test_a_search_is_that_of_the_program(self):
        libraries = {row["name"]: row["available"] for row in tenon.doctor()["libraries"]}
        if not libraries["nlopt"]:
            self.skipTest("no NLopt here: apt-get install libnlopt0")
        found = tenon.tune(support.HAND, joints=[self.JOINT], search=True, settle=0.3,
                           overshoot=0.05, engine="mujoco")
        found.pop("diagnostics")
        self.assertEqual(found, printed("tune", os.path.relpath(support.HAND), "--joints",
                                        self.JOINT, "--search", "--settle", 0.3, "--overshoot",
                                        "5%", "--engine", "mujoco"))
        self.assertEqual(len(found["search"]["drives"].table()), 1)

    def test_colliders_are_chosen_and_written(self):
        path = self.copied_hand()
        told = tenon.colliders(path, "mujoco", budget=64)
        told.pop("diagnostics")
        name = os.path.relpath(path)
        self.assertEqual(told, printed("colliders", name, "--engine", "mujoco", "--budget", 64))
        rows = told["engines"][0]["colliders"]
        self.assertEqual(len(rows.table()), len(rows))
        saved = tenon.colliders(path, "mujoco", budget=64, save=True)
        self.assertEqual(saved["written"], bool(told["request"]))


class Poses(support.FilesTestCase):
    def test_pose_is_found_saved_and_listed_as_by_the_program(self):
        path = self.copied_hand()
        self.assertEqual(tenon.poses(path), [])
        before = tenon.pose(path, "right_index_1_joint=40")
        self.assertNotIn("reach", before)
        saved = tenon.pose(path, "right_index_1_joint=40", save="bent")
        self.assertTrue(saved["written"])
        self.assertEqual(saved["joints"], before["joints"])
        self.assertEqual([row["name"] for row in tenon.poses(path)], ["bent"])
        name = os.path.relpath(path)
        self.assertEqual({"poses": tenon.poses(path)}, printed("pose", name))
        # Back to the link's place, from the start.
        scene = tenon.physics(path)
        link = "/inspire_hand/right_index_2"
        number = [body.path for body in scene.bodies].index(link)
        place = tenon.Dynamics(scene, "right_index_1_joint=40").body_positions[number]
        found = tenon.pose(path, ik={link: place})
        self.assertTrue(found["reach"]["reached"])
        angle = {row["joint"]: row["value"] for row in found["joints"]}
        self.assertAlmostEqual(angle["/inspire_hand/Physics/right_index_1_joint"],
                               math.radians(40), 3)
        far = tenon.pose(path, ik={link: (9, 9, 9)}, save="far")
        self.assertFalse(far["reach"]["reached"])
        self.assertNotIn("written", far)
        self.assertEqual([row["name"] for row in tenon.poses(path)], ["bent"])
        with self.assertRaises(tenon.NotFoundError):
            tenon.pose(path, "bend")

    def test_poses_are_renamed_removed_and_exchanged_as_by_the_program(self):
        path, file = self.copied_hand(), self.folder / "poses.json"
        def names():
            return [row["name"] for row in tenon.poses(path)]
        tenon.pose(path, "right_index_1_joint=40", save="bent")
        self.assertEqual([row["name"] for row in tenon.poses(path, export=file)], ["bent"])
        again = self.folder / "again.json"
        printed("pose", path, "--export", again)
        self.assertEqual(file.read_bytes(), again.read_bytes())
        self.assertTrue(tenon.edit_poses(path, rename={"bent": "hook"})["written"])
        self.assertEqual(names(), ["hook"])
        self.assertTrue(tenon.edit_poses(path, import_=file)["written"])
        self.assertEqual(sorted(names()), ["bent", "hook"])
        self.assertTrue(tenon.edit_poses(path, remove=["bent", "hook"])["written"])
        self.assertEqual(names(), [])
        with self.assertRaises(tenon.NotFoundError):
            tenon.edit_poses(path, remove=["hook"])
        for wrong in ({}, {"rename": {"a": "b"}, "remove": ["c"]}):
            with self.assertRaisesRegex(ValueError, "one of rename, remove and import_"):
                tenon.edit_poses(path, **wrong)
        with self.assertRaises(tenon.Error):  # what was read is never written over
            tenon.poses(path, export=path)

    def test_checks_of_some_rules(self):
        def rules(**how):
            return {row["rule"] for row in tenon.check(support.HAND, **how)["diagnostics"]}
        found = rules()
        family = sorted(found)[0].partition(".")[0]
        of_it = {rule for rule in found if rule.startswith(family + ".")}
        self.assertEqual(rules(only=[family]), of_it)
        self.assertEqual(rules(skip=[family]), found - of_it)
        self.assertEqual(rules(for_=["physx"]) - found, {"portability.soft-mimic"})
        known = self.folder / "known.json"
        printed("check", support.HAND, "--write-baseline", known)
        summary = tenon.check(support.HAND, baseline=known)["summary"]
        self.assertEqual((summary["warnings"], summary["infos"]), (0, 0))
        with self.assertRaisesRegex(tenon.NotFoundError, r"tenon_usd.rules\(\)"):
            tenon.check(support.HAND, only=["masss"])
        with self.assertRaisesRegex(tenon.InvalidError, "physy.*mujoco"):
            tenon.check(support.HAND, for_=["physy"])
        with self.assertRaisesRegex(TypeError, "only is a list"):
            tenon.check(support.HAND, only="mass")


class Files(support.FilesTestCase):
    def test_robots_go_in_and_out(self):
        answer = tenon.convert(ROBOT, self.folder / "arm", gains=(10, 1))
        self.assertGreater(answer["joints"], 0)
        (interface,) = (self.folder / "arm").glob("*.usda")
        scene = tenon.physics(interface, physics="physics")
        stiffness = {round(drive.stiffness, 4) for joint in scene.joints for drive in joint.drives}
        self.assertEqual(stiffness, {10.0})
        tenon.convert(interface, self.folder / "arm.xml", physics="physics")
        tenon.convert(interface, self.folder / "arm.urdf", physics="physics")
        self.assertIn("<robot", (self.folder / "arm.urdf").read_text())
        answer = tenon.convert(interface, self.folder / "arm.sdf", physics="physics")
        self.assertGreater(answer["links"], 0)
        self.assertIn("sdf.left-out", {row.rule for row in answer["diagnostics"]})
        tenon.convert(interface, self.folder / "arm_cfg.py", format="isaaclab")
        self.assertIn("stiffness=10", (self.folder / "arm_cfg.py").read_text())
        with self.assertRaises(tenon.InvalidError):
            tenon.convert(interface, self.folder / "arm.py")
        with self.assertRaises(tenon.InvalidError):
            tenon.convert(ROBOT, self.folder / "arm.usda", gains="many")

    def test_values_go_to_joints_and_links_by_name(self):
        link = ('<link name="{0}">{1}<collision><geometry><box size="1 1 1"/></geometry>'
                "</collision></link>")
        mass = ('<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" '
                'iyz="0"/></inertial>')
        joint = ('<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/>'
                 '<limit lower="0.5" upper="1.5" effort="9" velocity="9"/></joint>')
        robot = self.folder / "r.urdf"
        robot.write_text('<robot name="r">' + link.format("a", mass) + link.format("b", mass) +
                         link.format("c", "") + joint.format("wrist", "a", "b") +
                         joint.format("elbow", "b", "c") + "</robot>")
        output = self.folder / "r.usda"
        tenon.convert(robot, output, gains={"*": (100, 10), "w.*": (20, 2)}, armature=0.5,
                      friction={"elbow": 0.25}, density=100, start="valid", fix_base=True)
        scene = tenon.physics(output)
        joints = {joint.path.rpartition("/")[2]: joint for joint in scene.joints}
        self.assertAlmostEqual(joints["wrist"].drives[0].stiffness, 20, places=4)
        self.assertAlmostEqual(joints["elbow"].drives[0].stiffness, 100, places=4)
        self.assertEqual([joints[name].armature for name in ("wrist", "elbow")], [0.5, 0.5])
        self.assertEqual([joints[name].friction for name in ("wrist", "elbow")], [0, 0.25])
        self.assertAlmostEqual(joints["wrist"].initial_position, 0.55, places=5)
        masses = {body.path.rpartition("/")[2]: body.mass for body in scene.bodies}
        self.assertAlmostEqual(masses["c"], 100, places=3)
        for wrong, kind in (({"gains": {"wirst": (1, 2)}}, tenon.NotFoundError),
                            ({"collision": {"a": "sphere"}}, tenon.NotFoundError),
                            ({"collision": "box"}, tenon.InvalidError),
                            ({"armature": -1}, tenon.InvalidError),
                            ({"start": "middle"}, ValueError), ({"density": 0}, ValueError)):
            with self.subTest(wrong), self.assertRaises(kind):
                tenon.convert(robot, output, force=True, **wrong)

    def test_nothing_is_written_over_an_input(self):
        robot = self.folder / "arm.urdf"
        shutil.copytree(ROBOT.parent, self.folder, dirs_exist_ok=True)
        before = robot.read_bytes()
        with self.assertRaises(tenon.Error):
            tenon.convert(robot, robot, force=True)
        self.assertEqual(robot.read_bytes(), before)
        edited = self.folder / "out.usda"
        tenon.convert(robot, edited)
        edited.write_text(edited.read_text() + "\n# by hand\n")
        with self.assertRaises(tenon.InvalidError) as caught:
            tenon.convert(robot, edited)
        self.assertEqual(caught.exception.rule, "output.edited")
        tenon.convert(robot, edited, force=True)

    def test_an_asset_follows_its_source_and_keeps_its_edits(self):
        robot = self.folder / "arm.urdf"
        shutil.copytree(ROBOT.parent, self.folder, dirs_exist_ok=True)
        text = robot.read_text()
        upper = re.search(r'<limit [^>]*upper="([^"]*)"', text)[1]
        for output in (self.folder / "arm", self.folder / "one.usda"):
            robot.write_text(text)
            # What is not there is made.
            self.assertNotIn("updated", tenon.convert(robot, output, update=True))
            (interface,) = output.glob("*.usda") if output.is_dir() else (output,)
            stage = tenon.open(interface)
            joint = next(row for row in stage.physics().joints if math.isfinite(row.upper))
            stage[joint.path]["physics:upperLimit"] = 11.0
            stage.save()
            robot.write_text(text.replace('mass value="', 'mass value="1'))
            answer = tenon.convert(robot, output, update=True)["updated"]
            self.assertEqual((answer["edits"], answer["conflicts"]), (1, []), answer)
            self.assertGreater(answer["changes"], 0)
            again = tenon.open(interface)
            self.assertEqual(again[joint.path]["physics:upperLimit"], 11.0)
            self.assertGreater(sum(body.mass for body in again.physics().bodies),
                               sum(body.mass for body in stage.physics().bodies))
            # Both changed the same: nothing is written, or one of them decides.
            robot.write_text(text.replace(f'upper="{upper}"', 'upper="0.25"'))
            before = interface.read_bytes()
            with self.assertRaises(tenon.InvalidError) as caught:
                tenon.convert(robot, output, update=True, conflicts="fail")
            self.assertEqual(caught.exception.rule, "update.conflict")
            self.assertIn(joint.path, [row.prim for row in caught.exception.diagnostics])
            self.assertEqual(interface.read_bytes(), before)
            answer = tenon.convert(robot, output, update=True, conflicts="source")["updated"]
            self.assertEqual([row["kept"] for row in answer["conflicts"]], ["source"])
            self.assertNotEqual(tenon.open(interface)[joint.path]["physics:upperLimit"], 11.0)
        with self.assertRaises(ValueError):
            tenon.convert(robot, output, update=True, conflicts="mine")
        with self.assertRaises(tenon.UnsupportedError):
            tenon.convert(robot, self.folder / "arm.usdz", update=True)
        with self.assertRaises(tenon.UnsupportedError):
            tenon.convert(interface, self.folder / "out.urdf", update=True)

    def test_a_structure_follows_its_asset(self):
        path, output = self.copied_hand(), self.folder / "again"
        tenon.structure(path, output)
        answer = tenon.structure(path, output, update=True)["updated"]
        self.assertEqual((answer["files"], answer["edits"]), ([], 0))
        with self.assertRaises(ValueError):
            tenon.structure(path, update=True)

    def test_an_asset_is_structured(self):
        path = self.copied_hand()
        dry = tenon.structure(path)
        answer = tenon.structure(path, self.folder / "structured")
        self.assertEqual(dry["files"], answer["files"])
        self.assertTrue((self.folder / "structured" / answer["interface"]).exists())
        with self.assertRaises(tenon.InvalidError):
            tenon.structure(path, path.parent)

    def test_forms_of_assets(self):
        path = self.copied_hand()
        files = [row["file"] for row in tenon.structure(path, names="tutorial")["files"]]
        self.assertNotEqual(files, [row["file"] for row in tenon.structure(path)["files"]])
        tenon.structure(path, self.folder / "flat", links="flat", schema="both",
                        robot_type="End Effector")
        prim = tenon.open(self.folder / "flat/inspire_hand.usda").default_prim
        self.assertEqual(prim["isaac:robotType"], "End Effector")
        for wrong in ({"links": "round"}, {"schema": "old"}, {"names": "mine"}):
            with self.assertRaisesRegex(ValueError, f"{[*wrong][0]} is '.*expected"):
                tenon.structure(path, **wrong)
        with self.assertRaisesRegex(tenon.InvalidError, "kind of robot"):
            tenon.structure(path, robot_type="Toaster")

        def prims(**how):
            tenon.convert(ROBOT, self.folder / "arm.usda", force=True, **how)
            return {prim.path for prim in tenon.open(self.folder / "arm.usda").prims}
        self.assertNotEqual(prims(flat=True), prims())
        tenon.convert(ROBOT, self.folder / "tutorial", names="tutorial", gains=(100, 10))
        with self.assertRaisesRegex(tenon.InvalidError, "files of a folder"):
            prims(names="tutorial")
        with self.assertRaisesRegex(tenon.InvalidError, "flat is about assets that are made"):
            tenon.convert(path, self.folder / "hand.urdf", flat=True)

    def test_new_files(self):
        path = self.folder / "new.usda"
        stage = tenon.new(path, time_codes_per_second=60, start_time_code=1, end_time_code=120)
        self.assertEqual([stage.metadata(name) for name in (
            "timeCodesPerSecond", "startTimeCode", "endTimeCode")], [60, 1, 120])
        with self.assertRaisesRegex(tenon.FileError, "force=True"):
            tenon.new(path)
        self.assertEqual(tenon.new(path, up_axis="Y", force=True).metadata("upAxis"), "Y")
        for wrong in ({"up_axis": "X"}, {"meters_per_unit": 0}, {"kilograms_per_unit": -1},
                      {"time_codes_per_second": 0}, {"end_time_code": 1e300}):
            with self.assertRaisesRegex(ValueError, f"{[*wrong][0]} is .*expected"):
                tenon.new(self.folder / "other.usda", **wrong)
        self.assertFalse((self.folder / "other.usda").exists())

    def test_what_was_saved_is_undone(self):
        path, joint = self.copied_hand(), "/inspire_hand/Physics/right_index_1_joint"
        with unittest.mock.patch.dict(os.environ, XDG_STATE_HOME=str(self.folder / "state")):
            stage = tenon.open(path)
            stage[joint]["physics:upperLimit"] = 60
            stage.save()
            with self.assertRaises(tenon.NotFoundError) as caught:
                tenon.undo(path)
            self.assertEqual(caught.exception.rule, "undo.none")
            stage[joint]["physics:upperLimit"] = 50
            stage.save(undoable=True)
            (file,) = tenon.undo(path, dry_run=True)["files"]
            self.assertRegex(file["diff"], r"-.*upperLimit = 50\n\+.*upperLimit = 60\n")
            self.assertEqual(tenon.open(path)[joint]["physics:upperLimit"], 50)
            self.assertEqual(tenon.undo(path)["verb"], "Stage.save()")
            self.assertEqual(tenon.open(path)[joint]["physics:upperLimit"], 60)
            printed("set", path, f"{joint}.physics:upperLimit=40")
            tenon.undo(path)
            stage = tenon.open(path)
            self.assertEqual(stage[joint]["physics:upperLimit"], 60)
            stage[joint]["physics:upperLimit"] = 30
            stage.save(undoable=True)
            self.assertEqual(printed("undo", path)["verb"], "Stage.save()")

    def test_composition_may_take_more(self):
        found = tenon.open(support.HAND, max_work=1).diagnostics
        self.assertEqual(found[0].rule, "compose.work-exceeded")
        self.assertIn("allow more with max_work=", found[0].fix)  # an argument that there is
        self.assertFalse(tenon.open(support.HAND, max_work=10**9).diagnostics)
        with self.assertRaisesRegex(ValueError, "max_work is 0"):
            tenon.open(support.HAND, max_work=0)

    def test_what_is_there(self):
        self.assertEqual({row["name"] for row in tenon.engines()}, {"jolt", "mujoco", "physx"})
        self.assertTrue(all(row["available"] for row in tenon.doctor()["engines"]))


if __name__ == "__main__":
    support.main()
