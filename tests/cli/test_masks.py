#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""--deactivate, --bypass and --anchor: a masked run is the run of an asset that says so itself.

    test_masks.py ROOT TENON

Each mask is held to an asset that is authored without the part, with a fixed joint or with one to
the world, on every engine of the build; then what refers to masked parts, names, conflicts, and
every verb that simulates.
"""

import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1]).resolve()
TENON = os.path.abspath(sys.argv[2])
sys.path[:0] = [str(ROOT / "tests/engines_beside")]

# pylint: disable=wrong-import-position
from author import body, drive, joint, scene

LINKS = {"base": (0, 0, 1), "upper": (0.3, 0, 1), "fore": (0.9, 0, 1), "tip": (1.3, 0, 1)}
# Joint: kind, sides, where it is.
JOINTS = {
    "root": ("fixed", None, "base", (0, 0, 1)),
    "shoulder": ("revolute", "base", "upper", (0, 0, 1)),
    "elbow": ("revolute", "upper", "fore", (0.6, 0, 1)),
    "wrist": ("revolute", "fore", "tip", (1.2, 0, 1)),
}
ONE = ["--duration", "0.2", "--dt", "0.001"]


def apart(place, link):
    origin = LINKS[link] if link else (0, 0, 0)
    return tuple(round(a - b, 9) for a, b in zip(place, origin))


def arm(joints=None, without=(), more=(), driven=(), lines=None):
    """Four links in a row that swing about Y; `joints` replace rows, None leaves one out."""
    rows = {**JOINTS, **(joints or {})}
    parts = [body(name, at, collides=False, mass=1.0, inertia=(0.01, 0.02, 0.03))
             for name, at in LINKS.items() if name not in without]
    for name, row in rows.items():
        if row is None:
            continue
        kind, body0, body1, at = row
        path = {side: f"/World/{side}" if side else None for side in (body0, body1)}
        parts.append(joint(
            kind, name, path[body0], path[body1], pos0=apart(at, body0), pos1=apart(at, body1),
            axis="Y" if kind == "revolute" else None,
            parts=[drive("angular", stiffness=0.02, damping=0.002, target_position=30.0)]
            if name in driven else [], lines=(lines or {}).get(name, ())))
    return scene(*parts, *more, articulated=True)


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        told = json.loads(subprocess.run([TENON, "doctor", "--json"], capture_output=True,
                                         text=True, check=False).stdout)
        cls.engines = [row["name"] for row in told["engines"] if row["available"]]

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def file(self, text, name="arm.usda"):
        path = self.folder / name
        path.write_text(text)
        return path

    def run_it(self, *words, code=0):
        done = subprocess.run([TENON, *map(str, words)], capture_output=True, text=True,
                              check=False, cwd=self.folder, timeout=120,
                              env={**os.environ, "TENON_CHROMIUM": "/bin/true"})
        if code is not None:
            self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr[-2000:])
        return done

    def answer(self, *words, code=0):
        return json.loads(self.run_it(*words, "--json", code=code).stdout)

    def sim(self, path, engine, *words):
        return self.answer("sim", path, "--engine", engine, *ONE, *words)

    def found(self, answer, rule):
        return {finding["prim"] for finding in answer["diagnostics"] if finding["rule"] == rule}

    def same_motion(self, masked, authored, links, most=1e-9):
        """The links are at the same places in both answers."""
        for link in links:
            a, b = masked["bodies"]["/World/" + link], authored["bodies"]["/World/" + link]
            for key in ("position", "orientation"):
                for x, y in zip(a[key], b[key]):
                    self.assertLessEqual(abs(x - y), most, (link, key, a[key], b[key]))


class AsAuthored(Case):
    """The mask and the asset that says the same, on every engine."""

    def each(self, words, other, links, most=1e-9, asset=None):
        path, told = self.file(asset or arm()), self.file(other, "other.usda")
        for engine in self.engines:
            with self.subTest(engine=engine):
                masked = self.sim(path, engine, *words)
                self.same_motion(masked, self.sim(told, engine), links, most)
                free = self.sim(path, engine)
                self.assertNotEqual(masked["bodies"], free["bodies"])

    def test_joint_deactivated(self):
        self.each(["--deactivate", "elbow"], arm({"elbow": None}), LINKS)

    def test_link_deactivated_with_what_hangs_on_it(self):
        self.each(["--deactivate", "fore"],
                  arm({"elbow": None, "wrist": None}, without=("fore", "tip")), ("base", "upper"))

    def test_joint_bypassed(self):
        fixed = {"elbow": ("fixed", *JOINTS["elbow"][1:])}
        self.each(["--bypass", "elbow"], arm(fixed), LINKS, 1e-6)

    def test_link_bypassed(self):
        hung = {"elbow": None, "wrist": ("revolute", "upper", "tip", JOINTS["wrist"][3])}
        self.each(["--bypass", "fore"], arm(hung, without=("fore",)), ("base", "upper", "tip"),
                  1e-6)

    def test_base_anchored(self):
        self.each(["--anchor", "base"], arm(), LINKS, 1e-7, arm({"root": None}))

    def test_middle_anchored(self):
        path = self.file(arm())
        for engine in self.engines:
            with self.subTest(engine=engine):
                there = self.sim(path, engine, "--anchor", "fore")["bodies"]
                for axis, at in enumerate(LINKS["fore"]):
                    self.assertAlmostEqual(there["/World/fore"]["position"][axis], at, delta=2e-3)
                self.assertLess(there["/World/tip"]["position"][2], 0.99)

    def test_free_body_anchored(self):
        path = self.file(scene(body("Box", (0, 0, 2), mass=1.0),
                               body("Other", (3, 0, 2), mass=1.0)))
        for engine in self.engines:
            there = self.sim(path, engine, "--anchor", "/World/Box")["bodies"]
            self.assertAlmostEqual(there["/World/Box"]["position"][2], 2, 6, engine)
            self.assertLess(there["/World/Other"]["position"][2], 1.9, engine)

    def test_after_a_pose(self):
        """Held where --pose puts it, not where the asset has it."""
        path = self.file(arm())
        for engine in self.engines:
            start = self.answer("sim", path, "--engine", engine, "--duration", "0", "--pose",
                                "elbow=30")["bodies"]
            masked = self.sim(path, engine, "--pose", "elbow=30", "--bypass", "elbow", "--anchor",
                              "upper")["bodies"]
            for link in ("upper", "fore"):
                for axis in range(3):
                    self.assertAlmostEqual(start["/World/" + link]["position"][axis],
                                           masked["/World/" + link]["position"][axis],
                                           delta=2e-3, msg=(engine, link))


class Anchors(Case):
    def test_anchored_twice(self):
        path = self.file(arm())
        answer = self.sim(path, self.engines[0], "--anchor", "base", "--anchor", "/World/base")
        told = [d["message"] for d in answer["diagnostics"] if d["rule"] == "mask.anchored"]
        self.assertEqual(told, ["</World/root> fixes the link to the world already"])
        self.assertEqual(answer["bodies"], self.sim(path, self.engines[0])["bodies"])

    def test_a_rail_holds(self):
        """A joint to the world is held, so that no second one is needed."""
        rail = ("prismatic", None, "base", (0, 0, 1))
        path = self.file(arm({"root": rail}))
        for engine in self.engines:
            answer = self.sim(path, engine, "--anchor", "base")
            place = answer["bodies"]["/World/base"]["position"]
            self.assertAlmostEqual(place[0], 0, 6, engine)
            self.assertNotIn("/World/base/anchor", answer["joints"])

    def test_two_links_of_one_that_floats(self):
        path = self.file(arm({"root": None}))
        for engine in self.engines:
            there = self.sim(path, engine, "--anchor", "base", "--anchor", "tip")["bodies"]
            for link in ("base", "tip"):
                self.assertAlmostEqual(there["/World/" + link]["position"][2], 1, delta=5e-3,
                                       msg=engine)


class Referring(Case):
    """What refers to a part that is masked."""

    def test_follower_is_free(self):
        lines = {"wrist": ['prepend rel newton:mimicJoint = </World/elbow>',
                           "float newton:mimicCoef1 = 1"]}
        text = arm(lines=lines).replace(
            'PhysicsRevoluteJoint "wrist"',
            'PhysicsRevoluteJoint "wrist" (\n    prepend apiSchemas = ["NewtonMimicAPI"]\n)')
        path = self.file(text)
        for engine in self.engines:
            for mask in ("--deactivate", "--bypass"):
                answer = self.sim(path, engine, mask, "elbow")
                self.assertEqual(self.found(answer, "mask.skipped"), {"/World/wrist"},
                                 (engine, mask))
            answer = self.sim(path, engine, "--bypass", "elbow", "--bypass", "wrist")
            self.assertEqual(self.found(answer, "mask.skipped"), set())

    def test_loop(self):
        """A tree joint goes, and the one that closed the loop takes its place."""
        ring = {"closing": ("revolute", "tip", "base", (1.4, 0, 1))}
        path, other = self.file(arm(ring)), self.file(arm({**ring, "shoulder": None}), "o.usda")
        for engine in self.engines:
            with self.subTest(engine=engine):
                masked = self.sim(path, engine, "--deactivate", "shoulder")
                self.same_motion(masked, self.sim(other, engine), LINKS)

    def test_actuator_and_tendon(self):
        more = [
            ('def MjcTendon "cord" {\n    uniform token mjc:type = "fixed"\n'
             "    rel mjc:path = [</World/elbow>, </World/wrist>]\n"
             "    double[] mjc:path:coef = [1, -1]\n    double mjc:stiffness = 5\n}\n"),
            'def MjcActuator "motor" {\n    rel mjc:target = </World/elbow>\n}\n',
        ]
        path = self.file(arm(more=more))
        answer = self.sim(path, "mujoco", "--deactivate", "elbow")
        told = self.found(answer, "mask.skipped")
        self.assertLessEqual({"/World/cord"}, told)
        self.assertFalse(answer["unstable"])

    def test_sensor(self):
        lines = {"elbow": ['custom uniform token tenon:sensor = "joint"']}
        path = self.file(arm(lines=lines))
        for engine in self.engines:
            answer = self.sim(path, engine, "--bypass", "elbow")
            self.assertEqual(self.found(answer, "mask.skipped"), {"/World/elbow"}, engine)

    def test_contacts_go(self):
        """What fell onto a link that is deactivated falls through its place."""
        text = scene(body("Table", (0, 0, 1), ("Cube", 1), mass=9.0),
                     joint("fixed", "Legs", None, "/World/Table", pos0=(0, 0, 1)),
                     body("Ball", (0, 0, 1.8), ("Sphere", 0.1), mass=1.0))
        path = self.file(text)
        for engine in self.engines:
            words = ("sim", path, "--engine", engine, "--duration", "1")
            on = self.answer(*words)["bodies"]["/World/Ball"]["position"][2]
            off = self.answer(*words, "--deactivate", "Table")["bodies"]
            off = off["/World/Ball"]["position"][2]
            self.assertGreater(on, 1.5, engine)
            self.assertLess(off, 0, engine)

    def test_below_a_prim(self):
        path = self.file(arm())
        answer = self.sim(path, self.engines[0], "--deactivate", "/World")
        self.assertEqual(self.found(answer, "mask.deactivated"),
                         {"/World/" + name for name in (*LINKS, *JOINTS)})


class Names(Case):
    def refused(self, rule, *words):
        answer = self.answer("sim", self.file(arm()), *words, code=2)
        [finding] = [d for d in answer["diagnostics"] if d["severity"] == "error"]
        self.assertEqual(finding["rule"], rule, finding)
        return finding

    def test_unknown(self):
        for option in ("--deactivate", "--bypass"):
            self.assertEqual(self.refused("mask.unknown", option, "elbo")["fix"],
                             "did you mean elbow?")
        self.assertEqual(self.refused("mask.unknown", "--anchor", "tipp")["fix"],
                         "did you mean tip?")
        finding = self.refused("mask.unknown", "--anchor", "elbow")
        self.assertIn("--as flat", finding["fix"])
        self.refused("name.bad-pattern", "--anchor", "(")

    def test_conflicts(self):
        for words in (("--deactivate", "fore", "--anchor", "tip"),
                      ("--deactivate", "fore", "--bypass", "wrist"),
                      ("--deactivate", "elbow", "--bypass", "elbow"),
                      ("--bypass", "fore", "--anchor", "fore")):
            self.assertIn("leave one of the two out", self.refused("mask.conflict", *words)["fix"])
        self.file(scene(body("Box", (0, 0, 1), mass=1.0)), "free.usda")
        answer = self.answer("sim", "free.usda", "--bypass", "Box", code=2)
        self.assertEqual(answer["diagnostics"][-1]["rule"], "mask.no-parent")

    def test_expressions_and_what_is_told(self):
        path = self.file(arm(driven=("elbow",)))
        before = hashlib.sha256(path.read_bytes()).hexdigest()
        answer = self.sim(path, self.engines[0], "--bypass", "el.*|wr.*")
        self.assertEqual(self.found(answer, "mask.bypassed"), {"/World/elbow", "/World/wrist"})
        words = ("sim", path, "--duration", "0.01", "--bypass", "elbow")
        self.assertIn("mask.bypassed", self.run_it(*words, "-v").stderr)
        self.assertNotIn("mask.bypassed", self.run_it(*words).stderr)
        self.assertEqual(before, hashlib.sha256(path.read_bytes()).hexdigest())
        self.assertEqual(os.listdir(self.folder), ["arm.usda"])


class Verbs(Case):
    def test_every_verb_that_simulates(self):
        """All verbs with --engine or --engines, or told why not; each takes each mask."""
        table = {verb["name"]: {name for option in verb["options"] for name in option["names"]}
                 for verb in self.answer("help")["verbs"]}
        masks = {"--deactivate", "--bypass", "--anchor"}
        simulates = {name for name, options in table.items()
                     if options & {"--engine", "--engines"} and "--duration" in options}
        other = {"sweep": "a plan of Python", "identify": "fits the whole robot to a log",
                 "test-runner": "answers requests", "pose": "keeps poses"}
        self.assertEqual({name for name in simulates if not masks <= table[name]} - other.keys(),
                         set())
        run = ("--duration", "0.02")
        known = {
            "bake": ("--engine", "mujoco", *run, "-o", "-"),
            "bench": ("--engine", "mujoco", *run, "--envs", "2", "--threads", "1"),
            "compare": ("--engines", "mujoco,mujoco", *run, "--no-reasons"),
            "sim": ("--engine", "mujoco", *run),
            "tune": ("--engine", "mujoco"),
        }
        path = self.file(arm(driven=("elbow",)))
        for verb in sorted(name for name, options in table.items() if masks <= options):
            for option in sorted(masks):
                words = {"record": ("-o", "o.png"), "report": ("-o", "o.html"),
                         "bake": ("-o", "o.usda")}.get(verb, ())
                done = self.run_it(verb, path, *words, option, "for", code=None)
                if "view.no-page" not in done.stderr:  # of builds without one
                    self.assertIn("did you mean fore?", done.stderr, verb)
                    self.assertEqual(done.returncode, 2, verb)
                if verb in known:
                    told = self.answer(verb, path, *known[verb], option, "fore") \
                        if verb != "bake" else None
                    if told:
                        rules = {d["rule"] for d in told["diagnostics"]}
                        self.assertTrue(any(rule.startswith("mask.") for rule in rules),
                                        (verb, option))

    def test_tune_does_not_save(self):
        path = self.file(arm(driven=("elbow",)))
        answer = self.answer("tune", path, "--frequency", "3", "--damping-ratio", "1", "--save",
                             "--anchor", "fore", code=2)
        self.assertEqual(answer["diagnostics"][-1]["rule"], "usage.conflict")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
