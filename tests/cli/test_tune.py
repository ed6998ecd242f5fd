#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon tune`: the table, wishes and files of them, what is saved, tests with planted faults.

    test_tune.py ROOT TENON

Responses by closed forms are in tests/tuning/test_responses.py.
"""

import csv
import html.parser
import json
import math
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]).absolute(), str(pathlib.Path(sys.argv[2]).absolute())
sys.path.insert(0, str(ROOT / "tests/tuning"))
import scenes
from author import body, drive, joint, scene

HAND = ROOT / "examples/inspire_hand"


def tenon(*words, cwd=None):
    return subprocess.run([TENON, *map(str, words)], capture_output=True, text=True, check=False,
                          cwd=cwd)


ENGINES = [row["name"] for row in json.loads(tenon("doctor", "--json").stdout)["engines"]
           if row["available"]]


def limited(law="force", stiffness=50.0, damping=5.0, limits=(-60, 60), lines=(), apis=(),
            **more):
    """A wheel of 0.5 kg m2 between limits."""
    return scene(
        scenes.wheel("A", (0, 0, 3), 0.5),
        joint("revolute", "J", None, "/World/A", (0, 0, 3), axis="Y", limits=limits,
              parts=[drive("angular", law, stiffness * math.pi / 180, damping * math.pi / 180,
                           **more)], lines=lines, apis=apis),
        gravity=scenes.WEIGHTLESS, articulated=True)


def blocked_by_itself():
    """A finger that slides through its neighbour, as it may, and then meets the base."""
    return scene(
        body("Base", (0, 0, 1), ("Cube", 0.2), mass=5.0, inertia=(0.1,) * 3),
        joint("fixed", "Hold", None, "/World/Base", (0, 0, 1)),
        body("Link", (0.4, 0, 1), ("Cube", 0.1), mass=1.0, inertia=(0.01,) * 3),
        joint("fixed", "Grip", "/World/Base", "/World/Link", (0.4, 0, 0)),
        body("Finger", (0.8, 0, 1), ("Cube", 0.1), mass=1.0, inertia=(0.01,) * 3),
        joint("prismatic", "Slide", "/World/Link", "/World/Finger", (0.4, 0, 0), axis="X",
              limits=(-0.8, 0.1), parts=[drive("linear", "force", 400.0, 40.0, max_force=100.0)]),
        gravity=scenes.WEIGHTLESS, articulated=True)


def elbow():
    """0.1 kg m2 and 2 kg 0.2 m below an axis; 0.4 m below it 0.5 kg on an arm of 0.1 m, which
    starts 60 degrees below its lower limit."""
    return scene(
        body("A", (0, 0, 3), collides=False, mass=2.0, inertia=(0.1,) * 3),
        joint("revolute", "J", None, "/World/A", (0, 0, 3.2), (0, 0, 0.2), axis="Y",
              limits=(-60, 60), parts=[drive("angular", "force", 0.2, 0.01)]),
        body("B", (0, 0, 2.7), collides=False, mass=0.5, inertia=(0.01,) * 3),
        joint("revolute", "K", "/World/A", "/World/B", (0, 0, -0.2), (0, 0, 0.1), axis="Y",
              limits=(60, 120), parts=[drive("angular", "force", 0.1, 0.005)]),
        articulated=True)


class Tune(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def json(self, *words, code=0):
        done = tenon("tune", *words, "--json")
        self.assertEqual(done.returncode, code, done.stderr + done.stdout[-3000:])
        return json.loads(done.stdout)

    def drive_of(self, *words):
        return self.json(*words)["drives"][0]

    # ---- the table

    def test_the_table_is_of_closed_forms(self):
        row = self.drive_of(self.write("a.usda", limited()))
        self.assertAlmostEqual(row["inertia"], 0.5, 9)
        self.assertAlmostEqual(row["frequency"], 10, 5)
        self.assertAlmostEqual(row["dampingRatio"], 0.5, 6)
        self.assertAlmostEqual(row["frequencyHz"], 10 / (2 * math.pi), 6)
        self.assertAlmostEqual(row["authored"]["stiffness"], 50 * math.pi / 180, 6)
        self.assertEqual(row["regime"], "underdamped")
        text = tenon("tune", self.folder / "a.usda").stdout
        self.assertIn("frequency [Hz]", text)
        self.assertIn("underdamped", text)

    def test_stiffness_and_damping_are_both_per_degree(self):
        """A damping per radian would be 57.3 times too large."""
        path = self.write("a.usda", limited())
        tuned = self.drive_of(path, "--frequency", "5rad/s", "--damping-ratio", "1")["to"]
        self.assertAlmostEqual(tuned["stiffness"], 0.5 * 25, 5)
        self.assertAlmostEqual(tuned["damping"], 2 * 0.5 * 5, 5)
        for name in ("stiffness", "damping"):
            self.assertAlmostEqual(tuned["authored"][name] * 180 / math.pi, tuned[name], 5)

    def test_a_start_outside_of_limits_is_put_inside(self):
        path = self.write("a.usda", elbow())
        inertia = 0.1 + 2 * 0.2 ** 2 + 0.01 + 0.5 * (0.4 ** 2 + 0.1 ** 2 + 0.4 * 0.1)
        rows = self.json(path)["drives"]
        self.assertAlmostEqual({row["joint"]: row["inertia"] for row in rows}["/World/J"], inertia,
                               6)
        done = self.json(path, "--joints", "K", "--test", "step", "--frequency", "5",
                         "--damping-ratio", "1", "--dt", "0.001", "--engine", "all",
                         code=1)  # gravity keeps it from the target
        for engine in done["engines"]:
            at = engine["results"][0]["step"]
            self.assertNotIn("joint-limits", at["causes"], (engine["engine"], at))
        told = json.loads(tenon("drives", path, "--json").stdout)["drives"]
        self.assertAlmostEqual({row["joint"]: row["weightAt"] for row in told}["/World/K"],
                               math.pi / 3, 6)

    def test_units_of_the_stage_cancel(self):
        """Centimetres and grams: the same wheel, the same response."""
        text = limited().replace("metersPerUnit = 1", "metersPerUnit = 0.01")
        text = text.replace("kilogramsPerUnit = 1", "kilogramsPerUnit = 0.001")
        path = self.write("a.usda", text)
        self.json(path, "--frequency", "7", "--damping-ratio", "0.4", "--save")
        row = self.drive_of(path)
        self.assertAlmostEqual(row["frequencyHz"], 7, 5)
        self.assertAlmostEqual(row["dampingRatio"], 0.4, 6)
        self.assertAlmostEqual(row["inertia"] / (0.5 * 1e-7), 1, 5)

    def test_of_acceleration_drives_the_inertia_is_one(self):
        path = self.write("a.usda", limited("acceleration"))
        row = self.drive_of(path)
        self.assertEqual(row["type"], "acceleration")
        self.assertAlmostEqual(row["frequency"], math.sqrt(50), 5)
        self.assertAlmostEqual(row["dampingRatio"], 5 / (2 * math.sqrt(50)), 6)

    def test_what_the_joint_damps_itself_is_taken_off(self):
        own = 2.0  # [N m s/rad]
        passive = {"apis": ["MjcJointAPI"], "lines": [f"double mjc:damping = {own}"]}
        path = self.write("a.usda", limited(**passive))
        row = self.drive_of(path)
        self.assertAlmostEqual(row["passive"]["damping"], own, 6)
        tuned = self.drive_of(path, "--frequency", "10rad/s", "--damping-ratio", "1")
        self.assertAlmostEqual(tuned["to"]["damping"], 2 * 0.5 * 10 - own, 4)
        least = self.drive_of(path, "--frequency", "1rad/s", "--damping-ratio", "0.1")
        self.assertEqual(least["to"]["damping"], 0)
        self.assertIn("own damping of 2 N m s/rad is more than asked for", least["notes"][0])

    def test_what_cannot_be_tuned_is_listed(self):
        path = self.write("a.usda", scenes.mimic_chain())
        rows = {row["joint"].split("/")[-1]: row for row in
                self.json(path, "--frequency", "3", "--damping-ratio", "1")["drives"]}
        self.assertEqual(rows["J1"]["whyNot"], "it follows J0 (mimic)")
        self.assertIsNone(rows["J1"]["to"])
        self.assertAlmostEqual(rows["J0"]["inertia"], 0.5 * 5.25, 6)
        self.assertNotIn("Hold", rows)

    # ---- wishes

    def test_a_dry_run_writes_nothing(self):
        path = self.write("a.usda", limited())
        before = path.read_bytes()
        done = tenon("tune", path, "--frequency", "3", "--damping-ratio", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("1.5915 -> 3", done.stdout)
        self.assertIn("nothing is written", done.stdout)
        self.assertEqual(path.read_bytes(), before)

    def test_units_of_frequencies(self):
        path = self.write("a.usda", limited())
        for text, hertz in (("3", 3), ("3Hz", 3), ("3 Hz", 3), ("6.283185307179586rad/s", 1)):
            row = self.drive_of(path, "--frequency", text, "--damping-ratio", "1")
            self.assertAlmostEqual(row["to"]["frequencyHz"], hertz, 5)
        for text in ("0", "-1", "3 kHz", "inf", ""):
            done = tenon("tune", path, "--frequency=" + text, "--damping-ratio", "1")
            self.assertEqual(done.returncode, 2, text)

    def test_half_a_wish_keeps_the_other_half(self):
        path = self.write("a.usda", limited())
        row = self.drive_of(path, "--frequency", "3")["to"]
        self.assertAlmostEqual(row["dampingRatio"], 0.5, 6)
        row = self.drive_of(path, "--damping-ratio", "2")["to"]
        self.assertAlmostEqual(row["frequency"], 10, 5)
        self.assertAlmostEqual(row["dampingRatio"], 2, 6)
        none = self.write("n.usda", limited(stiffness=0.0, damping=0.0))
        done = tenon("tune", none, "--frequency", "3")
        self.assertEqual(done.returncode, 2)
        self.assertIn("tune.no-ratio", done.stderr)

    def test_velocity_drives_are_left_alone(self):
        path = self.write("a.usda", limited(stiffness=0.0))
        wish = ("--frequency", "3", "--damping-ratio", "1")
        row = self.drive_of(path, *wish)
        self.assertIsNone(row["to"])
        self.assertIn("follows velocities", row["notes"][0])
        self.assertAlmostEqual(
            self.drive_of(path, *wish, "--joints", "J")["to"]["frequencyHz"], 3, 5)

    def test_an_unknown_joint(self):
        path = self.write("a.usda", limited())
        for pattern in ("K", "/World/K", "J.+"):
            done = tenon("tune", path, "--joints", pattern)
            self.assertEqual(done.returncode, 2)
            self.assertIn(f'no joint is "{pattern}"', done.stderr)
            self.assertIn("[tune.no-joint]", done.stderr)
        self.assertEqual(tenon("tune", path, "--joints", "J(").returncode, 2)
        for pattern in ("J", "/World/J", ".*", "[A-J]"):
            self.assertEqual(len(self.json(path, "--joints", pattern)["drives"]), 1)

    def test_a_file_of_gains(self):
        path = self.write("a.usda", limited())
        gains = self.write("g.toml", '["J|K"]\nfrequency = 4\ndamping_ratio = 0.7\n')
        row = self.drive_of(path, "--gains", gains)["to"]
        self.assertAlmostEqual(row["frequencyHz"], 4, 5)
        self.assertAlmostEqual(row["dampingRatio"], 0.7, 6)
        gains.write_text('[J]\nfrequency = "10 rad/s"\ndamping = 3.5\n')
        row = self.drive_of(path, "--gains", gains)["to"]
        self.assertAlmostEqual(row["frequency"], 10, 5)
        self.assertAlmostEqual(row["damping"], 3.5, 5)
        gains.write_text('[".*"]\nstiffness = 8\ndamping = 2\n[J]\nstiffness = 12.5\n')
        row = self.drive_of(path, "--gains", gains)["to"]
        self.assertAlmostEqual(row["frequency"], 5, 5)
        self.assertAlmostEqual(row["damping"], 2, 5)

    def test_bad_files_of_gains_name_the_line(self):
        path = self.write("a.usda", limited())
        for text, line, what in (
                ("[J]\nfrequency = 4\nzeta = 1\n", 3, 'unknown key "zeta"'),
                ("[J]\nfrequency = 4\n[elbow]\nfrequency = 2\n", 4, 'no joint is "elbow"'),
                ("[J]\nfrequency = true\n", 2, "of type boolean"),
                ('[J]\nfrequency = "4 kHz"\n', 2, "is not a frequency"),
                ("[J]\nfrequency = 1e300\n", 2, "no such number"),
                ("[J]\nfrequency = 1\nfrequency = 2\n", 3, "leave one of the two out"),
                ("[J]\ndamping_ratio = -1\n", 2, "no such number"),
                ("[J]\nstiffness = nan\n", 2, "no such number"),
                ("[J]\nfrequency = 4\nstiffness = 3\n", 3, "the same twice"),
                ("frequency = 4\n", 1, "is no table of a joint"),
                ("[J.K]\nfrequency = 4\n", 2, "is no table of a joint"),
                ('["J("]\nfrequency = 4\n', 2, "J("),
                ("[J\n", 1, "bad TOML")):
            gains = self.write("g.toml", text)
            done = tenon("tune", path, "--gains", gains)
            self.assertEqual(done.returncode, 2, text)
            self.assertIn(f"g.toml:{line}", done.stderr, text)
            self.assertIn(what, done.stderr, text)
        self.assertEqual(tenon("tune", path, "--gains", self.folder / "no.toml").returncode, 2)
        gains = self.write("g.toml", "[J]\n" + "# long\n" * 10000)
        self.assertEqual(tenon("tune", path, "--gains", gains).returncode, 2)

    def test_usage(self):
        path = self.write("a.usda", limited())
        for words in (("--save",), ("--sequence", "J"), ("--test", "jump"), ("--engine", "bullet"),
                      ("--frequency", "3", "--save", "--set", "/World/J.physics:axis=X")):
            self.assertEqual(tenon("tune", path, *words).returncode, 2, words)

    # ---- what is saved

    def test_saved_numbers_come_back_in_all_forms_of_the_engines(self):
        shutil.copytree(HAND, self.folder / "hand")
        hand = self.folder / "hand/inspire_hand.usda"
        joints = ("--joints", "right_(thumb_1|index_1)_.*")
        wish = ("--frequency", "8.5", "--damping-ratio", "0.9", *joints)
        saved = self.json(hand, *wish, "--save")
        self.assertTrue(saved["written"])
        self.assertEqual(len(saved["request"]), 2)
        files = {pathlib.Path(each["file"]).name for each in saved["files"]}
        self.assertEqual(files, {"physics.usda", "mujoco.usda"})
        for variant in ("physics", "physx", "mujoco"):
            rows = [row for row in self.json(hand, "--physics", variant, *joints)["drives"]
                    if row["type"]]
            self.assertEqual(len(rows), 2)
            for row in rows:
                self.assertLess(abs(row["frequencyHz"] / 8.5 - 1), 1e-6, variant)
                self.assertLess(abs(row["dampingRatio"] / 0.9 - 1), 1e-6, variant)
        again = self.json(hand, *wish, "--save")
        self.assertEqual(again["request"], [])
        self.assertEqual(tenon("undo", hand).returncode, 0)
        for path in HAND.rglob("*.usda"):
            self.assertEqual((self.folder / "hand" / path.relative_to(HAND)).read_bytes(),
                             path.read_bytes(), path)

    # ---- tests

    def results(self, path, *words, code=0):
        told = self.json(path, *words, "--engine", "all", code=code)
        self.assertEqual([each["engine"] for each in told["engines"]], sorted(ENGINES))
        for engine in told["engines"]:
            yield engine["engine"], engine["results"][0]

    def test_snap_passes(self):
        path = self.write("a.usda", limited(damping=10.0))
        for engine, result in self.results(path, "--test", "snap"):
            self.assertEqual(result["verdict"], "pass", (engine, result))
            targets = [limit["target"] for limit in result["limits"]]
            self.assertAlmostEqual(targets[0], -math.pi / 3, 5)
            self.assertAlmostEqual(targets[1], math.pi / 3, 5)
            self.assertLess(max(limit["settlingTime"] for limit in result["limits"]), 2)

    def test_a_weak_drive_is_told(self):
        """0.005 N m turn 0.5 kg m2 by half a radian in ten seconds, too late to stop there."""
        path = self.write("a.usda", limited(max_force=0.005))
        for engine, result in self.results(path, "--test", "snap", code=1):
            self.assertIn(result["verdict"], ("fail", "blocked"), engine)
            reasons = " ".join(result["reasons"])
            self.assertIn("at its maxForce of 0.005 N m for", reasons, engine)
            self.assertIn("maxForce is too small", reasons, engine)

    def test_a_velocity_limit_is_told(self):
        path = self.write("a.usda", limited(damping=10.0, apis=["PhysxJointAPI"], lines=[
            "float physxJoint:maxJointVelocity = 2"]))
        for engine, result in self.results(path, "--test", "snap", code=1):
            self.assertEqual(result["verdict"], "fail", engine)
            self.assertIn("the velocity limit of 0.03491 rad/s: it passes without",
                          " ".join(result["reasons"]), engine)

    def test_self_collision_is_told(self):
        path = self.write("a.usda", blocked_by_itself())
        for engine, result in self.results(path, "--test", "snap", code=1):
            self.assertEqual(result["verdict"], "blocked", (engine, result))
            self.assertIn("self-collision: it passes without", " ".join(result["reasons"]), engine)
            # Between the faces of finger and base there is nothing at 0.15 m from the base.
            self.assertAlmostEqual(result["limits"][0]["at"], -0.65, 1, engine)

    def test_the_weight_is_told(self):
        arm = scene(
            body("A", (0, 0, 3), collides=False, mass=2.0, inertia=(0.1,) * 3),
            joint("prismatic", "J", None, "/World/A", (0, 0, 3), axis="Z", limits=(-1, 1),
                  parts=[drive("linear", "force", 100.0, 30.0)]))
        for engine, result in self.results(self.write("a.usda", arm), "--test", "snap", code=1):
            self.assertEqual(result["verdict"], "blocked", engine)
            self.assertIn("the weight that it carries", " ".join(result["reasons"]), engine)
            self.assertIn("0.196 m away", " ".join(result["reasons"]), engine)  # m g / k

    def test_step_is_by_the_form(self):
        path = self.write("a.usda", limited())
        for engine, result in self.results(path, "--test", "step", "--dt", "0.001"):
            step = result["step"]
            self.assertAlmostEqual(step["form"]["overshoot"], math.exp(-math.pi / math.sqrt(3)), 6)
            self.assertLess(abs(step["overshoot"] / step["form"]["overshoot"] - 1), 0.05, engine)
            self.assertLess(abs(step["riseTime"] / step["form"]["riseTime"] - 1), 0.02, engine)

    def test_sine_lags_by_the_form(self):
        """Position targets alone: K / (K - m w^2 + i w D)."""
        path = self.write("a.usda", limited())
        w = 2 * math.pi
        form = 50 / complex(50 - 0.5 * w * w, 5 * w)
        for engine, result in self.results(path, "--test", "sine", "--period", "1", "--duration",
                                           "6", "--dt", "0.0005"):
            sine = result["sine"]
            self.assertAlmostEqual(sine["gain"], abs(form), 1, engine)
            self.assertAlmostEqual(sine["lag"], -math.atan2(form.imag, form.real) / w, 2, engine)

    def test_stress_has_a_seed(self):
        path = self.write("a.usda", limited())
        words = (path, "--test", "stress", "--duration", "1", "--engine", ENGINES[0])
        first, second = (self.json(*words, "--seed", "5") for _ in range(2))
        self.assertEqual(first, second)
        self.assertNotEqual(first, self.json(*words, "--seed", "6"))
        self.assertEqual(first["engines"][0]["seed"], 5)
        self.assertGreater(first["engines"][0]["results"][0]["stress"]["largestStableSigma"], 0)
        self.json(*words, "--adversarial")

    def test_steps_come_closer(self):
        path = self.write("a.usda", limited())
        for engine, result in self.results(path, "--test", "steps", "--period", "1"):
            gaps = [row["gap"] for row in result["steps"]]
            self.assertEqual(len(gaps), 6)
            self.assertEqual(sorted(gaps, reverse=True), gaps, engine)
            self.assertEqual([row["timeStep"] for row in result["steps"]],
                             [0.008, 0.004, 0.002, 0.001, 0.0005, 0.00025])

    def test_what_is_unstable_is_refused_and_told(self):
        text = limited().replace('def PhysicsScene "PhysicsScene"', 'def PhysicsScene '
                                 '"PhysicsScene" (prepend apiSchemas = ["MjcSceneAPI"])')
        text = text.replace("float physics:gravityMagnitude = 0",
                            'float physics:gravityMagnitude = 0\n        uniform token '
                            'mjc:option:integrator = "euler"')
        path = self.write("a.usda", text)
        wish = ("--frequency", "1000rad/s", "--damping-ratio", "1", "--engine", "mujoco")
        done = tenon("tune", path, *wish, "--dt", "0.001")
        self.assertEqual(done.returncode, 2)  # 0.828 of omega dt
        self.assertIn("hold up to 131.8 Hz", done.stderr)
        self.assertIn("[tune.unstable]", done.stderr)
        self.assertEqual(tenon("tune", path, *wish, "--dt", "0.0005").returncode, 0)
        forced = tenon("tune", path, *wish, "--dt", "0.001", "--force", "--test", "step")
        self.assertEqual(forced.returncode, 3, forced.stderr + forced.stdout)
        self.assertIn("unstable", forced.stdout)

    def test_a_coarse_step_is_told(self):
        path = self.write("a.usda", limited())
        row = self.drive_of(path, "--frequency", "100", "--damping-ratio", "1", "--dt", "0.002")
        self.assertIn("under-sampled: omega*dt = 1.26 > 0.5", row["notes"][0])

    def test_groups_run_in_sequence(self):
        path = self.write("a.usda", scenes.mimic_chain())
        told = self.json(path, "--frequency", "5", "--damping-ratio", "1", "--test", "step",
                         "--sequence", "J.")
        verdicts = {each["joint"][-2:]: each["verdict"] for each in told["engines"][0]["results"]}
        self.assertEqual(list(verdicts), ["J0"])

    def test_reports(self):
        path = self.write("a.usda", limited())
        words = ("tune", path, "--test", "step", "--period", "0.5", "--engine", "all", "-o")
        for ending in ("html", "csv", "json"):
            done = tenon(*words, self.folder / f"r.{ending}")
            self.assertIn(done.returncode, (0, 1), done.stderr)
        rows = list(csv.DictReader((self.folder / "r.csv").read_text().splitlines()))
        self.assertEqual([row["engine"] for row in rows], sorted(ENGINES))
        self.assertGreater(float(rows[0]["overshoot"]), 0.1)
        told = json.loads((self.folder / "r.json").read_text())
        self.assertEqual(len(told["engines"]), len(ENGINES))

        class Page(html.parser.HTMLParser):
            tags = []

            def handle_starttag(self, tag, attributes):
                self.tags.append(tag)

        Page().feed((self.folder / "r.html").read_text())
        self.assertEqual(Page.tags.count("svg"), 3)
        self.assertNotIn("script", Page.tags)
        # command and each engine; each engine's velocities; efforts, which have no bound here
        self.assertEqual(Page.tags.count("polyline"), 1 + 3 * len(ENGINES))
        self.assertEqual(tenon(*words, self.folder / "r.txt").returncode, 2)

    def test_an_interrupt_ends_a_test(self):
        path = self.write("a.usda", limited())
        process = subprocess.Popen([TENON, "tune", path, "--test", "stress", "--duration", "10000",
                                    "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(2)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        self.assertIn("engines", json.loads(out))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
