#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Descriptions as people write them: what converts all the same, and what is told.

    odd_descriptions.py ROOT TENON
"""

import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT, TENON = pathlib.Path(sys.argv[1]), sys.argv[2]
INERTIA = '<inertia ixx="{0}" ixy="0" ixz="0" iyy="{1}" iyz="0" izz="{2}"/>'
BODY = '<inertial><mass value="1"/>' + INERTIA.format(0.01, 0.01, 0.01) + "</inertial>"
BOX = '<geometry><box size="0.1 0.1 0.1"/></geometry>'


def joint(name, parent, child, lower=-1, upper=1, kind="revolute", more=""):
    return (f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
            f'<axis xyz="1 0 0"/><limit lower="{lower}" upper="{upper}" effort="5" velocity="2"/>'
            f"{more}</joint>")


class Robots(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_tenon(self, *words):
        done = subprocess.run([TENON, *map(str, words), "--json"], capture_output=True, text=True,
                              check=False)
        return done.returncode, json.loads(done.stdout)

    def convert(self, body, *options):
        """The exit code and the findings; the asset is r.usda."""
        source = self.folder / "r.urdf"
        source.write_text(f'<robot name="r">\n{body}\n</robot>\n', encoding="utf-8")
        code, answer = self.run_tenon("convert", source, self.folder / "r.usda", "--force",
                                      *options)
        return code, answer.get("diagnostics", [])

    def scene(self):
        code, scene = self.run_tenon("physics", self.folder / "r.usda")
        self.assertEqual(code, 0, scene)
        return scene

    def told(self, findings, rule):
        return [finding for finding in findings if finding["rule"] == rule]

    def body(self, name):
        [body] = [b for b in self.scene()["bodies"] if b["path"].endswith("/" + name)]
        return body

    def joint(self, name):
        [found] = [j for j in self.scene()["joints"] if j["path"].endswith("/" + name)]
        return found


class SlenderBodies(Robots):
    """A principal moment of 0 is lifted, and the others stay as they are."""

    def moments(self, *given):
        link = ('<link name="arm"><inertial><mass value="0.3"/>' + INERTIA.format(*given) +
                "</inertial></link>")
        code, findings = self.convert(f'<link name="base">{BODY}</link>' + link +
                                      joint("j", "base", "arm"))
        self.assertEqual(code, 0, findings)
        return self.body("arm")["inertia"][::4], self.told(findings, "robot.inertia-not-positive")

    def test_a_rod_keeps_its_moments(self):
        moments, told = self.moments(0.004, 0.004, 0)
        for is_now, wanted in zip(moments, (0.004, 0.004, 4e-6)):
            self.assertAlmostEqual(is_now, wanted, delta=1e-9)
        [finding] = told
        self.assertEqual(finding["severity"], "warning")
        self.assertIn("4e-06 kg m^2 is used for it, the others stay", finding["message"])

    def test_it_gets_what_a_body_with_the_others_has_at_least(self):
        moments, _ = self.moments(0.004, 0, 0.003)
        for is_now, wanted in zip(moments, (0.004, 0.001, 0.003)):
            self.assertAlmostEqual(is_now, wanted, delta=1e-9)

    def test_a_single_moment_says_nothing_of_the_body(self):
        moments, [finding] = self.moments(0, 0, 0.006)
        for is_now in moments:
            self.assertAlmostEqual(is_now, 0.002, delta=1e-9)
        self.assertIn("moments that are not above 0; the mean of the three is used for each",
                      finding["message"])


class Degrees(Robots):
    """Limits of a hinge in degrees by mistake: told by convert and by check."""

    def limits(self, lower, upper, kind="revolute"):
        code, findings = self.convert(f'<link name="a">{BODY}</link><link name="b">{BODY}</link>' +
                                      joint("j", "a", "b", lower, upper, kind))
        self.assertEqual(code, 0)
        _, checked = self.run_tenon("check", self.folder / "r.usda")
        return (self.told(findings, "robot.limits-in-degrees"),
                self.told(checked["diagnostics"], "joint.limits-in-degrees"))

    def test_are_told(self):
        for lower, upper in ((-90, 90), (0, 135), (-30, 110), (-180, 180)):
            converted, checked = self.limits(lower, upper)
            with self.subTest(upper):
                [finding], [later] = converted, checked
                self.assertEqual(finding["severity"], "warning")
                self.assertEqual(later["severity"], "warning")
                self.assertIn('of joint "j" are radians, and look like degrees',
                              finding["message"])
                self.assertIn(f"{math.radians(upper):.6g}", finding["fix"])
                self.assertIn(f"{upper:.6g} if those degrees were meant", later["fix"])
                self.assertEqual(finding["line"], 2)

    def test_others_are_not(self):
        for lower, upper, kind in ((-math.pi, math.pi, "revolute"), (-6.28, 6.28, "revolute"),
                                   (-9.42, 9.42, "revolute"), (-31.4, 31.4, "revolute"),
                                   (-10, 10, "revolute"),
                                   (-1000, 1000, "revolute"), (0, 90, "prismatic")):
            with self.subTest(upper):
                self.assertEqual(self.limits(lower, upper, kind), ([], []))


class BadNumbers(Robots):
    LINK = f'<link name="l">{{0}}<visual>{BOX}<material name="grey"/></visual></link>'

    def test_a_bad_colour_costs_the_colour(self):
        for rgba in ("0.15 0.15 0.15 0 1", "red", "1 0 0", ""):
            code, findings = self.convert(
                f'<material name="grey"><color rgba="{rgba}"/></material>\n' +
                self.LINK.format(BODY))
            with self.subTest(rgba):
                self.assertEqual(code, 0, findings)
                [finding] = self.told(findings, "urdf.color")
                self.assertEqual((finding["severity"], finding["line"]), ("warning", 2))
                self.assertIn("the material has no colour", finding["message"])
                self.assertEqual(self.told(findings, "urdf.material-missing"), [])

    def test_xacro_in_a_colour_is_still_refused(self):
        code, findings = self.convert('<material name="grey"><color rgba="${c}"/></material>' +
                                      self.LINK.format(BODY))
        self.assertEqual(code, 2, findings)

    def test_commas_of_inertials_and_shapes_are_told(self):
        inertial = BODY.replace("<inertial>", '<inertial><origin xyz="0.1, 0.2, 0.3"/>')
        code, findings = self.convert("\n" + self.LINK.format(inertial))
        self.assertEqual(code, 0, findings)
        [finding] = self.told(findings, "urdf.comma")
        self.assertEqual((finding["severity"], finding["line"]), ("warning", 3))
        self.assertIn("ROS's reader skips the whole <inertial>", finding["message"])
        for is_now, wanted in zip(self.body("l")["centerOfMass"], (0.1, 0.2, 0.3)):
            self.assertAlmostEqual(is_now, wanted, delta=1e-6)
        code, findings = self.convert(
            self.LINK.format(BODY).replace('"0.1 0.1 0.1"', '"0.1,0.1,0.1"'))
        self.assertEqual((code, len(self.told(findings, "urdf.comma"))), (0, 1), findings)

    def test_commas_of_joints_and_decimal_commas_are_refused(self):
        two = f'<link name="a">{BODY}</link><link name="b">{BODY}</link>'
        for body in (two + joint("j", "a", "b", more='<origin xyz="0, 0 1"/>'),
                     two.replace("<inertial>", '<inertial><origin xyz="0,5 1"/>', 1) +
                     joint("j", "a", "b")):
            code, findings = self.convert(body)
            self.assertEqual(code, 2, findings)


class Inertials(Robots):
    def test_a_mass_without_inertia_is_a_warning(self):
        for inertia in ("", INERTIA.format(0, 0, 0)):
            code, findings = self.convert('<link name="l"><inertial><mass value="2"/>' + inertia +
                                          f"</inertial><collision>{BOX}</collision></link>")
            self.assertEqual(code, 0)
            [finding] = self.told(findings, "convert.no-inertia")
            self.assertEqual((finding["severity"], finding["line"]), ("warning", 2))
            self.assertIn("engines take that of its colliders", finding["message"])
            self.assertEqual(self.told(findings, "urdf.missing"), [])

    def test_without_colliders_too(self):
        code, findings = self.convert('<link name="l"><inertial><mass value="2"/></inertial>'
                                      "</link>")
        self.assertEqual(code, 0)
        [finding] = self.told(findings, "convert.no-inertia")
        self.assertIn("no colliders to take one of", finding["message"])


class Markers(Robots):
    """A visual that nobody can see is no fault; one of which something is missing is."""

    def test_of_no_size_are_infos(self):
        for shape in ('box size="0 0 0"', 'sphere radius="0"', 'cylinder radius="0" length="1"'):
            code, findings = self.convert(f'<link name="l">{BODY}<visual><geometry><{shape}/>'
                                          "</geometry></visual></link>")
            with self.subTest(shape):
                self.assertEqual(code, 0, findings)
                [finding] = self.told(findings, "robot.bad-size")
                self.assertEqual(finding["severity"], "info")

    def test_flat_visuals_and_colliders_are_errors(self):
        for use, shape in (("visual", 'box size="1 1 0"'), ("collision", 'box size="0 0 0"'),
                           ("visual", 'box size="0 0 -1"')):
            code, findings = self.convert(f'<link name="l">{BODY}<{use}><geometry><{shape}/>'
                                          f"</geometry></{use}></link>")
            with self.subTest(shape):
                self.assertEqual(code, 1, findings)


class Followers(Robots):
    """The effort of a joint that follows another one is its drive's maxForce, without gains."""

    BODY = (f'<link name="a">{BODY}</link><link name="b">{BODY}</link><link name="c">{BODY}</link>'
            + joint("lead", "a", "b") +
            joint("follow", "b", "c", more='<mimic joint="lead" multiplier="0.5"/>'))

    def test_is_written_and_drives_nothing(self):
        code, findings = self.convert(self.BODY, "--gains", "100,10", "--fix-base")
        self.assertEqual(code, 0, findings)
        [drive] = self.joint("follow")["drives"]
        self.assertEqual((drive["stiffness"], drive["damping"], drive["maxForce"]), (0, 0, 5))
        text = (self.folder / "r.usda").read_text(encoding="utf-8")
        self.assertEqual(text.count("def MjcActuator"), 1)
        _, checked = self.run_tenon("check", self.folder / "r.usda")
        rules = [finding["rule"] for finding in checked["diagnostics"]]
        for rule in ("drive.on-mimic", "drive.no-effect"):
            self.assertNotIn(rule, rules)

    def test_moves_as_without_it(self):
        self.convert(self.BODY, "--gains", "100,10", "--fix-base")
        runs = []
        for extra in ([], ["--clear"]):
            if extra:
                code, answer = self.run_tenon(
                    "set", self.folder / "r.usda", *extra,
                    "/r/Physics/follow.drive:angular:physics:maxForce")
                self.assertEqual(code, 0, answer)
            for engine in ("mujoco", "physx", "jolt"):
                code, answer = self.run_tenon("sim", self.folder / "r.usda", "--engine", engine,
                                              "--duration", "0.2", "-o", self.folder / "log.csv")
                self.assertEqual(code, 0, answer)
                rows = (self.folder / "log.csv").read_text().splitlines()
                columns = rows[0].split(",")
                runs.append([row.split(",")[i] for row in rows[1:] for i, name in enumerate(columns)
                             if name.endswith((".position", ".velocity"))])
        self.assertEqual(runs[:3], runs[3:])

    def test_comes_back(self):
        self.convert(self.BODY)
        code, answer = self.run_tenon("convert", self.folder / "r.usda", self.folder / "b.urdf")
        self.assertEqual(code, 0, answer)
        text = (self.folder / "b.urdf").read_text(encoding="utf-8")
        self.assertEqual(text.count('effort="5"'), 2)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
