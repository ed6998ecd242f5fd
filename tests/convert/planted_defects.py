#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Published robots with one defect planted in each: what convert and check name, and where.

    planted_defects.py ROOT TENON

The defects are those that simcheck plants and mjcf-doctor looks for (docs/which-tool.md, "Other
validators of robots"), planted here anew. A defect is named where a rule of the table says what the
sound robot does not: at the line of the part in the URDF, or at its prim and a line of the asset.
One that no file shows changes no finding. The robots are those of ten_robots.py; no file of others
is kept.
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from ten_robots import GYM, ROBOTS, make_packages

ROOT, TENON = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]
CONTROL = "dm_control/"

# Robot, description, a link with mass, collider and visual that a hinge moves, that hinge.
URDFS = (
    ("arm", ROBOTS + "ur_description/urdf/ur5_gripper.urdf", "forearm_link", "elbow_joint"),
    ("arm with gripper", ROBOTS + "panda_description/urdf/panda.urdf", "panda_link4",
     "panda_joint4"),
    ("quadruped", ROBOTS + "solo_description/robots/solo12.urdf", "FL_UPPER_LEG", "FL_HFE"),
    ("hand", ROBOTS + "allegro_hand_description/urdf/allegro_right_hand.urdf", "link_1.0",
     "joint_1.0"),
)
# The same of MJCF: a body with geoms of its own, its hinge.
MJCFS = (
    ("ant", GYM.replace("assets/", "mujoco/assets/") + "ant.xml", "aux_1", "hip_1"),
    ("arm", CONTROL + "third_party/kinova/jaco_arm.xml", "b_3", "joint_3"),
    ("cheetah", CONTROL + "suite/cheetah.xml", "bthigh", "bthigh"),
    ("walker", CONTROL + "suite/walker.xml", "right_thigh", "right_hip"),
)


def numbers(text, otherwise=(0.0, 0.0, 0.0)):
    return [float(word) for word in text.split()] if text else list(otherwise)


def written(values):
    return " ".join(f"{value:.9g}" for value in values)


class Robot:
    """A URDF to edit, with the parts that defects are planted in."""

    def __init__(self, source, link, joint):
        self.source = source
        self.root = xml.etree.ElementTree.parse(source).getroot()
        for mesh in self.root.iter("mesh"):
            mesh.set("filename", self.file_of(mesh.get("filename")))
        self.link = self.root.find(f"link[@name='{link}']")
        self.joint = self.root.find(f"joint[@name='{joint}']")
        self.inertial, self.limit = self.link.find("inertial"), self.joint.find("limit")

    def file_of(self, name):
        """package://PACKAGE/REST is below a folder that is called as the package."""
        package, _, rest = name.removeprefix("package://").partition("/")
        for folder in self.source.parents:
            if (folder / package / rest).is_file():
                return str(folder / package / rest)
        return str(self.source.parent / name)

    @staticmethod
    def move(part, *distances):
        """Adds to the place of a collision, an inertial or a joint [m]."""
        origin = part.find("origin")
        if origin is None:
            origin = xml.etree.ElementTree.SubElement(part, "origin")
        origin.set("xyz", written(at + more for at, more in zip(numbers(origin.get("xyz")),
                                                                distances)))

    def change_moments(self, change):
        inertia = self.inertial.find("inertia")
        for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
            inertia.set(name, f"{change(name, float(inertia.get(name, '0'))):.9g}")

    def scale(self, factor):
        """All shapes and places."""
        for mesh in self.root.iter("mesh"):
            mesh.set("scale", written(v * factor for v in numbers(mesh.get("scale"), (1, 1, 1))))
        for shape in ("box", "sphere", "cylinder", "capsule"):
            for element in self.root.iter(shape):
                for name in {"size", "radius", "length"} & set(element.keys()):
                    element.set(name, written(v * factor for v in numbers(element.get(name))))
        for origin in self.root.iter("origin"):
            origin.set("xyz", written(v * factor for v in numbers(origin.get("xyz"))))

    def multiply_mass(self, factor):
        mass = self.inertial.find("mass")
        mass.set("value", f"{float(mass.get('value')) * factor:.9g}")
        self.change_moments(lambda _, moment: moment * factor)

    def break_triangle(self):
        inertia = self.inertial.find("inertia")
        most = 3 * (float(inertia.get("ixx")) + float(inertia.get("iyy")))
        self.change_moments(lambda name, moment: most if name == "izz" else
                            moment if name[1] == name[2] else 0)

    def change_limits(self, change):
        lower, upper = change(float(self.limit.get("lower")), float(self.limit.get("upper")))
        self.limit.set("lower", f"{lower:.9g}")
        self.limit.set("upper", f"{upper:.9g}")

    def lose_mesh(self):
        mesh = next(self.link.iter("mesh"))
        mesh.set("filename", mesh.get("filename") + ".missing")

    def turn_axis(self, factor):
        axis = self.joint.find("axis")
        axis.set("xyz", written(v * factor for v in numbers(axis.get("xyz"))))

    def remove_colliders(self):
        for collision in self.link.findall("collision"):
            self.link.remove(collision)

    def move_colliders(self, distance):
        for collision in self.link.findall("collision"):
            self.move(collision, distance, 0, 0)

    def slide(self, upper):
        self.joint.set("type", "prismatic")
        self.change_limits(lambda *_: (0, upper))


def zero(*_):
    return 0


# Defect, the parts that findings have to be at, its rules of convert and of check, how it is
# planted. Without rules: no file shows it.
DEFECTS = (
    ("shapes and places in millimetres", "any", "", "mass.density", lambda r: r.scale(1000)),
    ("shapes and places a thousandth", "any", "", "mass.density", lambda r: r.scale(0.001)),
    ("axis reversed", "", "", "", lambda r: r.turn_axis(-1)),
    ("axis of zeros", "joint", "robot.zero-axis", "", lambda r: r.turn_axis(0)),
    ("limits swapped", "joint", "robot.limit-order", "",
     lambda r: r.change_limits(lambda lower, upper: (upper, lower))),
    ("limits in degrees", "joint", "robot.limits-in-degrees", "joint.limits-in-degrees",
     lambda r: r.change_limits(lambda lower, upper: (math.degrees(lower), math.degrees(upper)))),
    ("inertia of zeros", "link", "convert.no-inertia", "", lambda r: r.change_moments(zero)),
    ("inertia that breaks the triangle rule", "link", "robot.inertia-triangle", "",
     lambda r: r.break_triangle()),
    ("a moment below 0", "link", "robot.inertia-not-positive", "",
     lambda r: r.change_moments(lambda name, v: -abs(v) - 1e-6 if name == "ixx" else v)),
    ("mass in grams", "link", "", "mass.density", lambda r: r.multiply_mass(1000)),
    ("mass 0", "link", "convert.no-mass convert.massless", "",
     lambda r: r.inertial.find("mass").set("value", "0")),
    ("no inertial", "link", "convert.no-mass convert.massless", "",
     lambda r: r.link.remove(r.inertial)),
    ("no collider", "link", "", "body.no-collider", lambda r: r.remove_colliders()),
    ("collider beside its visual", "link", "", "collider.away-from-visual",
     lambda r: r.move_colliders(2)),
    ("centre of mass outside", "link", "", "mass.center-outside mass.center-far",
     lambda r: r.move(r.inertial, 0, 0, 1)),
    ("a mesh that is not there", "link", "urdf.mesh-missing", "", lambda r: r.lose_mesh()),
    ("joint inside of its parent", "", "", "", lambda r: r.move(r.joint, 0, 0, -0.05)),
    # Those of isaaclab-robot-doctor that simcheck does not plant.
    ("joint in millimetres", "joint", "", "joint.anchor-far",
     lambda r: r.move(r.joint, 0, 0, 300)),
    ("travel in millimetres", "joint", "", "joint.travel-far", lambda r: r.slide(400)),
)
# What a robot cannot have: limits that are 10 rad for "far" become no round number of degrees; one
# model counts in radians, and one has a total mass to which all masses are scaled.
NOT_IN = {("limits in degrees", "quadruped"), ("range in radians", "arm"),
          ("mass of tonnes", "cheetah")}


def keys(findings):
    return {(f["rule"], f["prim"], f["message"]) for f in findings}


def without(findings, known):
    return [f for f in findings if (f["rule"], f["prim"], f["message"]) not in known]


def planted_in_mjcf(root, body, joint):
    """Defect -> rules of check, how it is planted in this model."""
    def inertial(mass, moment):
        for old in body.findall("inertial"):
            body.remove(old)
        body.insert(0, xml.etree.ElementTree.Element(
            "inertial", pos="0 0 0", mass=str(mass), diaginertia=f"{moment} {moment} {moment}"))
        for compiler in root.findall("compiler"):
            compiler.attrib.pop("inertiafromgeom", None)

    def option():
        found = root.find("option")
        return found if found is not None else xml.etree.ElementTree.SubElement(root, "option")

    def add_servo(**more):
        found = root.find("actuator")
        if found is None:
            found = xml.etree.ElementTree.SubElement(root, "actuator")
        xml.etree.ElementTree.SubElement(found, "position", **more)

    def set_all(elements, **more):
        for element in elements:
            for name, value in more.items():
                element.set(name, value)

    return (
        ("inertia far too small", "mass.inertia-small", lambda: inertial(1, 1e-9)),
        ("inertia far too large", "mass.inertia-large", lambda: inertial(1, 1e3)),
        ("mass of tonnes", "mass.density", lambda: inertial(20000, 100)),
        ("time step 0", "scene.time-step", lambda: option().set("timestep", "0")),
        ("nothing can collide", "body.no-collider",
         lambda: set_all(root.iter("geom"), contype="0", conaffinity="0")),
        ("neighbours collide", "mujoco.parents-collide",
         lambda: xml.etree.ElementTree.SubElement(option(), "flag", filterparent="disable")),
        ("soft contacts", "mujoco.soft-contact",
         lambda: set_all(body.findall("geom"), solref="0.5 1")),
        ("a servo beyond the limits of its joint", "actuator.control-outside-limits",
         lambda: add_servo(name="planted", joint=joint.get("name"), kp="10", ctrllimited="true",
                           ctrlrange="-300 300")),
        ("range in radians", "joint.limits-in-radians",
         lambda: set_all([joint], limited="true", range=f"{-math.pi / 2} {math.pi / 2}")),
        ("gravity upward", "scene.gravity-direction",
         lambda: option().set("gravity", "0 0 9.81")),
    )


class Planted(unittest.TestCase):
    packages = None

    @classmethod
    def setUpClass(cls):
        cls.packages, why = make_packages(ROOT)
        if cls.packages is None:
            raise unittest.SkipTest(f"no robots: {why}")

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.home = pathlib.Path(self.folder.name)

    def tenon(self, *words):
        done = subprocess.run([TENON, *map(str, words), "--json"], capture_output=True, text=True,
                              check=False)
        self.assertIn(done.returncode, (0, 1), done.stdout[-500:] + done.stderr[-500:])
        return json.loads(done.stdout)["diagnostics"]

    def found(self, root, ending):
        """Findings of convert and of check, of a description that is written line by line."""
        source, asset = self.home / f"r.{ending}", self.home / "r.usda"
        source.write_bytes(xml.etree.ElementTree.tostring(root))
        converted = self.tenon("convert", source, asset, "--force", "--allow-read", self.packages,
                               *(["--scene"] if ending == "xml" else []))
        return converted, self.tenon("check", asset)

    def test_defects_of_urdf_are_named(self):
        for robot, file, link, joint in URDFS:
            sound = self.found(Robot(self.packages / file, link, joint).root, "urdf")
            known = [keys(findings) for findings in sound]
            for defect, part, of_convert, of_check, plant in DEFECTS:
                if (defect, robot) in NOT_IN:
                    continue
                with self.subTest(f"{robot}: {defect}"):
                    planted = Robot(self.packages / file, link, joint)
                    plant(planted)
                    found = [without(findings, before)
                             for findings, before in zip(self.found(planted.root, "urdf"), known)]
                    self.told(found[0], of_convert, part, (link, joint), "r.urdf")
                    self.told(found[1], of_check, part, (link, joint), "r.usda")
                    if not of_convert and not of_check:
                        self.assertEqual([f["message"] for f in found[0] + found[1]
                                          if f["severity"] == "error"], [])

    def told(self, found, rules, part, names, file):
        """One of the rules says so at the part, in that file."""
        if not rules:
            return
        name = {"link": names[0], "joint": names[1], "any": None}[part]
        at_part = [f for f in found if f["rule"] in rules.split() and f["file"].endswith(file) and
                   (name is None or self.is_at(f, name, file))]
        self.assertTrue(at_part, f"{rules}: {[(f['rule'], f.get('prim')) for f in found][:8]}")

    def is_at(self, finding, name, file):
        if file == "r.usda":
            return re.sub(r"\W", "_", name) in finding["prim"] and finding["line"] > 0
        lines = (self.home / file).read_text("utf-8").splitlines()
        starts = [i for i, line in enumerate(lines) if f'name="{name}"' in line]
        return any(start < finding["line"] <= start + 60 for start in starts)

    def test_defects_of_mjcf_are_named(self):
        for robot, file, name, hinge in MJCFS:
            known = keys(self.found(self.model(file, name, hinge)[0], "xml")[1])
            for i, (defect, rule, _) in enumerate(planted_in_mjcf(*self.model(file, name, hinge))):
                if (defect, robot) in NOT_IN:
                    continue
                with self.subTest(f"{robot}: {defect}"):
                    model = self.model(file, name, hinge)
                    planted_in_mjcf(*model)[i][2]()
                    found = without(self.found(model[0], "xml")[1], known)
                    named = [f for f in found if f["rule"] == rule]
                    self.assertTrue(named, f"{rule}: {sorted({f['rule'] for f in found})}")
                    self.assertTrue(all(f["line"] for f in named), named[:1])

    def model(self, file, name, hinge):
        """Its root, body and hinge, with the files that it names by absolute paths."""
        source = self.packages / file
        root = xml.etree.ElementTree.parse(source).getroot()
        for include in root.iter("include"):
            include.set("file", str((source.parent / include.get("file")).resolve()))
        compiler = root.find("compiler")
        if compiler is not None and compiler.get("meshdir"):
            compiler.set("meshdir", str((source.parent / compiler.get("meshdir")).resolve()))
        return (root, root.find(f".//body[@name='{name}']"),
                root.find(f".//joint[@name='{hinge}']"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
