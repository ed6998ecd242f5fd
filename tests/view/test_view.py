#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon view` as its pages see it: pages, messages, pose frames, edits, files that change.

Every request and every notice of the tables that the program tells is sent or received here;
notices and answers are held against their schemas.

    test_view.py ROOT TENON
"""

import json
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import urllib.request

import schema
import viewer

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
HAND = ROOT / "examples/inspire_hand"
JOINT = "/inspire_hand/Physics/right_index_1_joint"
STACK = ROOT / "examples/scenes/box_on_box.usda"

if shutil.which("node") is None:  # no page, no viewer
    print("skipped: node is not installed, so there is no page")
    sys.exit(77)


def content_of(folder):
    return {path.relative_to(folder): path.read_bytes()
            for path in folder.rglob("*") if path.is_file()}


def differing(before, folder):
    now = content_of(folder)
    return sorted(str(path) for path in before.keys() | now.keys()
                  if before.get(path) != now.get(path))


def glb_json(data):
    magic, version, size = struct.unpack("<4sII", data[:12])
    assert (magic, version, size) == (b"glTF", 2, len(data))
    length, kind = struct.unpack("<I4s", data[12:20])
    assert kind == b"JSON"
    return json.loads(data[20:20 + length])


def all_prims(asset):
    done = subprocess.run([TENON, "tree", "--json", str(asset)], capture_output=True, text=True,
                          check=True)
    return [row["path"] for row in json.loads(done.stdout)["prims"]]


class Hand(unittest.TestCase):
    """On a copy of the example hand, an asset of the structure 3.0."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.asset = self.folder / "hand" / "inspire_hand.usda"
        shutil.copytree(HAND, self.folder / "hand", ignore=shutil.ignore_patterns("generat*"))
        self.before = content_of(self.folder)

    def tearDown(self):
        shutil.rmtree(self.folder)

    def view(self, *options):
        return viewer.Viewer(TENON, self.asset, *options)

    def test_pages_and_poses(self):
        with self.view() as view, view.client() as client:
            self.assertIn(b"live.js", view.get("")[2])
            self.assertGreater(len(view.get("live.js")[2]), 100_000)
            picture = glb_json(view.get("scene.glb")[2])
            scene = client.wait("scene")
            nodes = [node["extras"]["path"] for node in picture["nodes"]
                     if node.get("extras", {}).get("kind") == "body"]
            self.assertEqual(nodes, scene["bodies"])
            frame = client.next_frame()
            self.assertEqual(len(frame), 1 + 7 * len(scene["bodies"]))
            for at in range(1, len(frame), 7):
                self.assertAlmostEqual(sum(x * x for x in frame[at + 3:at + 7]), 1, 5)
            self.assertIn(JOINT, [joint["path"] for joint in scene["joints"]])

    def test_sliders_move_the_right_link(self):
        with self.view() as view, view.client() as client:
            scene = client.wait("scene")
            joint = next(one for one in scene["joints"] if one["dofs"] and not one["follows"])
            before = client.next_frame()
            dof = joint["dofs"][0]
            wanted = dof["lower"] + 0.3 * (dof["upper"] - dof["lower"])
            client.frames.clear()
            self.assertEqual(client.done("setJoint", joint=joint["path"],
                                         position=[wanted])["position"], [wanted])
            after = client.frames[-1] if client.frames else client.next_frame()
            moved = [scene["bodies"][i] for i in range(len(scene["bodies"]))
                     if max(abs(before[k] - after[k])
                            for k in range(1 + 7 * i, 8 + 7 * i)) > 1e-6]
            facts = client.done("explain", object=joint["path"])["joint"]
            self.assertIn(facts["side1"]["body"], moved)
            self.assertNotIn(facts["side0"]["body"], moved)

    def test_edit_lands_in_the_file_that_owns_the_value(self):
        with self.view() as view, view.client() as client, view.client() as other:
            scene = client.wait("scene")
            joint = next(one for one in scene["joints"] if one["drives"])
            other.wait("scene")
            edited = client.done("set", object=joint["path"] + ".physics:upperLimit", value="33")
            self.assertEqual(edited["edits"][0]["after"], "33")
            self.assertEqual(differing(self.before, self.folder),
                             ["hand/payloads/Physics/physics.usda"])
            self.assertTrue(any(effect["differences"] for effect in edited["physics"]))
            told = other.wait("scene", why="edit")  # the other page hears of it
            self.assertTrue(told["canUndo"])
            self.assertEqual(told["revision"], scene["revision"] + 1)
            limit = next(one for one in told["joints"] if one["path"] == joint["path"])
            self.assertAlmostEqual(limit["dofs"][0]["upper"], 33 * 3.14159265 / 180, 5)
            other.done("undo")
            self.assertEqual(differing(self.before, self.folder), [])
            client.wait("scene", why="undo")
            client.done("redo")
            self.assertEqual(len(differing(self.before, self.folder)), 1)
            client.done("undo")

    def test_read_only(self):
        with self.view("--read-only") as view, view.client() as client:
            self.assertTrue(client.wait("hello")["readOnly"])
            self.assertEqual(client.refused("set", object=JOINT + ".physics:upperLimit",
                                            value="1"), "live.read-only")
            self.assertEqual(differing(self.before, self.folder), [])

    def test_watch(self):
        with self.view("--watch") as view, view.client() as client:
            scene = client.wait("scene")
            file = self.folder / "hand/payloads/Physics/physics.usda"
            text = file.read_text()
            subprocess.run([TENON, "set", str(self.asset),
                            JOINT + ".physics:upperLimit=21"],
                           check=True, capture_output=True)
            self.assertNotEqual(text, file.read_text())
            told = client.wait("scene", why="file")
            self.assertEqual(told["revision"], scene["revision"] + 1)
            root = self.asset.read_text()
            self.asset.write_text("no layer")
            self.assertIn("inspire_hand.usda",
                          client.wait("problem")["problem"]["file"] or "inspire_hand.usda")
            self.asset.write_text(root)
            client.wait("scene", why="file")

    def test_variants_and_engines(self):
        with self.view() as view, view.client() as client:
            scene = client.wait("scene")
            row = next(one for one in scene["variants"] if one["set"] == "Physics")
            self.assertGreater(len(row["options"]), 2)
            for variant in row["options"]:
                client.done("variant", prim=row["prim"], set="Physics", variant=variant)
                told = client.last("scene")
                self.assertEqual(next(one["selection"] for one in told["variants"]
                                      if one["set"] == "Physics"), variant)
            self.assertEqual(differing(self.before, self.folder), [])
            client.done("variant", prim=row["prim"], set="Physics", variant=row["selection"])
            for engine in scene["engines"]:
                if engine["available"]:
                    client.done("engine", engine=engine["name"])
                    self.assertEqual(client.last("scene")["engine"], engine["name"])
                    self.assertTrue(client.last("scene")["simulates"],
                                    client.last("scene")["problem"])
                    client.done("step", count=5)
            self.assertEqual(client.refused("variant", prim=row["prim"], set="Physics",
                                            variant="none such"), "variant.unknown")

    def test_reconnect(self):
        with self.view() as view:
            with view.client() as client:
                joint = next(one["path"] for one in client.wait("scene")["joints"]
                             if one["drives"])
                client.done("setDrive", joint=joint, position=0.2)
                client.done("step", count=50)
                time = client.last("state")["time"]
            with view.client() as again:
                self.assertEqual(again.wait("hello")["client"], 2)
                self.assertAlmostEqual(again.wait("state")["time"], time)

    def test_ends(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.view() as view, view.client() as client:
                client.wait("hello")
                code, said = view.end(number)
                self.assertEqual(code, 0, said)
                with self.assertRaises(viewer.Closed):
                    while True:
                        client.hear()


class Messages(unittest.TestCase):
    """All requests and notices of the tables."""

    def exercise(self, client):
        """Sends every request once at least; -> names of those that were sent."""
        sent = set()

        def do(request, **fields):
            sent.add(request)
            return client.done(request, **fields)

        scene = client.wait("scene")
        body = next(path for path in scene["bodies"])
        do("observe", contacts=True, plots=True)
        do("play")
        client.wait("plots")
        client.wait("contacts")
        client.wait("state", playing=True)
        do("speed", factor=2)
        do("pause")
        do("drag", body=body, anchor=[0, 0, 0], target=[0, 0, 1])
        do("force", body=body, point=[0, 0, 0], force=[0, 0, 1])
        do("step", count=3)
        do("release")
        do("reset")
        do("engine", engine=scene["engine"])
        do("tree")
        do("inspect", prim=body)
        do("where", object=body)
        do("explain", object=body)
        do("findings")
        do("messages")
        return sent, do

    def exercise_panels(self, do, client, driven):
        """The requests of panels; most of what they would write is only told."""
        joint = driven["path"]
        drive = {"joint": joint, "dof": driven["drives"][0]["dof"]}
        pairs = do("pairs", postures=4000, environment=True)["pairs"]
        pair = next(one for one in pairs if one["filtered"] == "no")
        do("filterPairs", filter=[{name: pair[name] for name in ("bodyA", "bodyB")}], dryRun=True)
        do("drives", postures=1)
        do("setLimits", limits=[drive | {"maxEffort": 2}], dryRun=True)
        do("gains")
        do("setGains", **drive, frequency=60, dampingRatio=1)
        do("testDrives", test="step", joints=[joint], period=0.2, amplitude=0.1)
        do("saveGains", dryRun=True)
        do("forgetGains")
        do("cancel")
        do("savePose", name="here")
        kept = do("poses")
        pose = kept["poses"][0]["path"]
        do("goToPose", pose=pose, hold=True)
        do("importPoses", text=kept["file"].replace("here", "there"), dryRun=True)
        do("identifyLogs")
        do("renamePose", pose=pose, name="there", dryRun=True)
        do("removePose", pose=pose, dryRun=True)
        do("undo")
        do("set", object=joint + ".physics:localRot0", value="(2, 0, 0, 0)")
        do("fix", rule="joint.rotation-length", dryRun=True)
        do("undo")

    def test_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            asset = pathlib.Path(folder) / "hand" / "inspire_hand.usda"
            shutil.copytree(HAND, asset.parent)
            with viewer.Viewer(TENON, asset) as view, view.client() as client:
                sent, do = self.exercise(client)
                scene = client.last("scene")
                joint = next(one for one in scene["joints"]
                             if one["drives"] and one["dofs"] and not one["follows"])
                do("setDrive", joint=joint["path"], position=0.1)
                do("setJoint", joint=joint["path"], position=joint["position"])
                do("setEffort", joint=joint["path"], effort=[0.01])
                row = scene["variants"][0]
                do("variant", prim=row["prim"], set=row["set"], variant=row["selection"])
                attribute = joint["path"] + ".physics:upperLimit"
                do("set", object=attribute, value="44")
                do("undo")
                do("redo")
                do("clear", object=attribute)
                told = client.ask("step", count=5000)["error"]["message"]
                self.assertIn("from 0 to 1000", told)
                self.exercise_panels(do, client, joint)
                for request, fields in (("identify", {"stage": "check"}), ("writeIdentified", {})):
                    sent.add(request)  # there is no log: test_identify_page.py does them
                    self.assertEqual(client.refused(request, **fields), "live.refused")
                asset.write_text("no layer")
                client.ask("set", object=attribute, value="45")
                tables = client.done("messages")
        self.assertEqual(sent, {row["name"] for row in tables["requests"]})
        heard = self.check_messages(client, tables)
        told = {row["name"] for row in tables["notices"]}
        self.assertEqual(told - heard, {"problem"})  # test_watch hears it

    def check_messages(self, client, tables):
        """Everything that came is as the tables say; -> the names of the notices."""
        notices = {row["name"]: row["schema"] for row in tables["notices"]}
        results = {row["name"]: row["result"] for row in tables["requests"]}
        for notice in client.notices:
            found = schema.faults(notice, notices[notice["is"]], notice["is"])
            if notice["is"] == "answer":
                found += schema.faults(notice["result"], results[notice["to"]], notice["to"])
            self.assertEqual(found, [])
        return {notice["is"] for notice in client.notices}

    def test_contacts_and_energy(self):
        with viewer.Viewer(TENON, STACK) as view, view.client() as client:
            client.wait("scene")
            client.done("observe", contacts=True, plots=True)
            client.done("step", count=1000)
            contacts = client.last("contacts")
            self.assertGreater(contacts["count"], 0)
            self.assertEqual(len(contacts["rows"]), contacts["count"])
            self.assertGreater(sum(row["force"][k] ** 2 for row in contacts["rows"]
                                   for k in range(3)), 0)
            self.assertGreaterEqual(client.last("plots")["kinetic"], 0)

    def test_everything_can_be_inspected(self):
        with viewer.Viewer(TENON, STACK) as view, view.client() as client:
            for path in all_prims(STACK):
                answer = client.done("inspect", prim=path)
                self.assertEqual(answer["prim"], path)
                for row in answer["all"]:
                    client.done("where", object=f"{path}.{row['name']}")
            self.check_messages(client, client.done("messages"))


class Command(unittest.TestCase):
    def test_what_cannot_be_viewed(self):
        for words, code in ((["none.usda"], 2), ([str(STACK), "--bind", "localhost"], 2),
                            ([str(STACK), "--bind", "192.0.2.1"], 2),
                            ([str(STACK), "--port", "70000"], 2)):
            done = subprocess.run([TENON, "view", *words], capture_output=True, text=True,
                                  check=False, timeout=60)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertTrue(done.stderr)

    def test_every_network_is_told_by_the_addresses_of_this_machine(self):
        with viewer.Viewer(TENON, STACK, "--bind", "0.0.0.0") as view:
            urls = view.answer["urls"]
            self.assertEqual(view.answer["url"], urls[0])
            self.assertEqual(len(set(urls)), len(urls))
            for url in urls:
                self.assertNotIn("0.0.0.0", url)
                with urllib.request.urlopen(url, timeout=60) as page:
                    self.assertEqual(page.status, 200, url)

    def test_text(self):
        with subprocess.Popen([TENON, "view", str(STACK)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as process:
            self.assertRegex(process.stdout.readline(),
                             r"^http:" r"//127\.0\.0\.1:\d+/[0-9a-f]{32}/\n$")
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(60), 0)
            self.assertIn("ssh -L", process.stderr.read())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
