#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""`tenon pairs` of published robots beside Pinocchio and Coal, which know nothing of tenon.

    pairs_beside.py ROOT TENON [COUNT]

COUNT robots (20 without it), an even choice of the URDF files in build/robots, which
tests/convert/ten_robots.py makes, are converted by tenon, and `tenon pairs` draws 20,000 postures
of each. Pinocchio reads the URDF itself, with the hulls that Coal makes of its meshes, and looks at
500 postures of its own. Good when no pair of links that tenon calls "always" is apart in one of
these, and when tenon finds every pair that Coal finds more than 1 mm deep: where it did not draw
such a posture, the URDF is made to stand in it and tenon is asked again. Other differences are
named and counted.
"""

import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(sys.argv[1]).absolute()
TENON = str(pathlib.Path(sys.argv[2]).absolute())
COUNT = int(sys.argv[3]) if len(sys.argv) > 3 else 20
ROBOTS = ROOT / "build/robots"
SHARE = ROBOTS / "cmeel.prefix/share"
SAMPLES, OWN_SAMPLES = 20_000, 500
DEEP = 1e-3      # [m] of a pair that must not be missed
APART = 1e-5     # [m] by which a pair that always touches may seem to be apart
FAR = 2e-3       # [m] between depths that are told apart, where both are less deep than half a hull

try:
    import coal
    import numpy as np
    import pinocchio
except ImportError as missing:
    print(f"skipped: {missing} (tests/dynamics/requirements-pinocchio.txt)")
    sys.exit(77)


class Skipped(Exception):
    """A robot that cannot be compared, and why."""


def tenon(*arguments):
    done = subprocess.run([TENON, *map(str, arguments), "--json"], capture_output=True, text=True,
                          check=False)
    try:
        answer = json.loads(done.stdout)
    except json.JSONDecodeError as error:
        raise Skipped(done.stderr.strip()[-200:]) from error
    if done.returncode > 1:
        errors = [one["message"] for one in answer["diagnostics"] if one["severity"] == "error"]
        raise Skipped((errors or ["no error is told"])[0])
    return answer


def chosen():
    """The robots that have meshes or shapes to collide with: an even choice, then the others."""
    files = [path for path in sorted(ROBOTS.rglob("*.urdf"))
             if path.read_text(errors="replace").count("<collision") > 2]
    step = max(1, len(files) // COUNT)
    return files[::step] + [path for i, path in enumerate(files) if i % step]


def parsed(source):
    """The elements of a URDF, whose prefixes nobody may have declared."""
    text = re.sub(r"<(/?)\w+:", r"<\1", source.read_text(errors="replace"))
    text = re.sub(r"\sxmlns:\w+=(\"[^\"]*\"|'[^']*')|(?<=\s)\w+:(?=\w+=)", "", text)
    try:
        return xml.etree.ElementTree.fromstring(re.sub(r"^\s*<\?xml[^>]*>", "", text))
    except xml.etree.ElementTree.ParseError as error:
        raise Skipped(f"Python does not parse it: {error}") from error


class Pinocchios:
    """A robot as Pinocchio reads it."""

    def __init__(self, source):
        self.source = source
        folders = [str(SHARE), str(SHARE / "example-robot-data"), str(ROBOTS)]
        folders += [str(parent) for parent in source.parents if ROBOTS in parent.parents]
        try:
            self.model = pinocchio.buildModelFromUrdf(str(source))
            self.shapes = pinocchio.buildGeomFromUrdf(
                self.model, str(source), pinocchio.GeometryType.COLLISION, package_dirs=folders)
        except (ValueError, RuntimeError) as error:
            raise Skipped("Pinocchio: " + " ".join(str(error).split())[:160]) from error
        self.links = []
        for shape in self.shapes.geometryObjects:
            mesh = shape.geometry
            if isinstance(mesh, coal.BVHModelBase):
                mesh.buildConvexHull(True, "Qt")
                if mesh.convex is None:
                    raise Skipped(f"Coal makes no hull of {shape.name}")
                shape.geometry = mesh.convex
            # As a name of USD.
            self.links.append(re.sub(r"\W", "_", self.model.frames[shape.parentFrame].name))
        self.pairs = []  # of links, for each pair of shapes
        for a, first in enumerate(self.links):
            for b in range(a + 1, len(self.links)):
                if first != self.links[b]:
                    self.shapes.addCollisionPair(pinocchio.CollisionPair(a, b))
                    self.pairs.append(tuple(sorted((first, self.links[b]))))
        if not self.pairs:
            raise Skipped("it has no two links with shapes")
        self.data = self.model.createData()
        self.shape_data = self.shapes.createData()
        for request in self.shape_data.collisionRequests:
            request.enable_contact = True
        self.bounds, self.followers = self.joints()

    def joints(self):
        """{joint: (lower, upper)} of the joints that are drawn, {follower: (leader, by, plus)}."""
        bounds, followers = {}, {}
        for joint in parsed(self.source).findall("joint"):
            kind, limit, mimic = joint.get("type"), joint.find("limit"), joint.find("mimic")
            name = joint.get("name")
            if mimic is not None:
                followers[name] = (mimic.get("joint"), float(mimic.get("multiplier", 1)),
                                   float(mimic.get("offset", 0)))
            elif kind == "continuous":
                bounds[name] = (-np.pi, np.pi)
            elif kind in ("revolute", "prismatic") and limit is not None:
                bounds[name] = (float(limit.get("lower", 0)), float(limit.get("upper", 0)))
            elif kind in ("floating", "planar", "ball"):
                raise Skipped(f"the joint {name} is {kind}")
        return bounds, followers

    def draw(self, chance):
        """Values of joints within the limits, and Pinocchio's posture of them."""
        values = {name: chance.uniform(low, high) if high > low else low
                  for name, (low, high) in self.bounds.items()}
        for _ in self.followers:  # one may follow another
            for name, (leader, factor, offset) in self.followers.items():
                if leader in values:
                    values[name] = factor * values[leader] + offset
        posture = pinocchio.neutral(self.model)
        for index in range(1, self.model.njoints):
            joint, value = self.model.joints[index], values.get(self.model.names[index], 0.0)
            if joint.nq == 2:
                posture[joint.idx_q:joint.idx_q + 2] = np.cos(value), np.sin(value)
            elif joint.nq == 1:
                posture[joint.idx_q] = value
        return values, posture

    def look(self, number):
        """{links: [postures in which they touch, greatest depth [m], some in which they do not,
        values of the joints at the greatest depth]}"""
        found = {pair: [0, 0.0, [], {}] for pair in self.pairs}
        chance = random.Random(number)
        for _ in range(OWN_SAMPLES):
            values, posture = self.draw(chance)
            pinocchio.computeCollisions(self.model, self.data, self.shapes, self.shape_data,
                                        posture, False)
            depths = {}
            for pair, result in zip(self.pairs, self.shape_data.collisionResults):
                depth = -result.getContact(0).penetration_depth if result.isCollision() else 0.0
                depths[pair] = max(depths.get(pair, 0.0), depth)
            for pair, depth in depths.items():
                one = found[pair]
                one[0] += depth > 1e-6
                if depth > one[1]:
                    one[1], one[3] = depth, values
                if depth <= 1e-6 and len(one[2]) < 5:
                    one[2].append(posture)
        return found

    def apart(self, links, postures):
        """How far two links are apart at most in some postures [m]."""
        most = 0.0
        for posture in postures:
            pinocchio.updateGeometryPlacements(self.model, self.data, self.shapes,
                                               self.shape_data, posture)
            distances = [pinocchio.computeDistance(self.shapes, self.shape_data, i).min_distance
                         for i, pair in enumerate(self.pairs) if pair == links]
            most = max(most, min(distances))
        return most


def posed(source, values):
    """The URDF with its joints at zero where `values` have them, and meshes by whole paths."""
    robot = parsed(source)
    for mesh in robot.iter("mesh"):
        name = mesh.get("filename", "")
        package, _, rest = name.removeprefix("package://").partition("/")
        places = [SHARE / package / rest, SHARE / "example-robot-data" / package / rest]
        places += [parent.parent / package / rest for parent in source.parents
                   if parent.name == package]
        if not name.startswith("package://"):
            places = [source.parent / name.removeprefix("file://")]
        mesh.set("filename", str(next((place for place in places if place.exists()), name)))
    for joint in robot.findall("joint"):
        value, kind = values.get(joint.get("name"), 0.0), joint.get("type")
        origin, axis = joint.find("origin"), joint.find("axis")
        numbers = {"xyz": "0 0 0", "rpy": "0 0 0"} | dict(origin.attrib if origin is not None
                                                          else {})
        place = np.array([float(word) for word in numbers["xyz"].split()])
        turn = pinocchio.rpy.rpyToMatrix(*[float(word) for word in numbers["rpy"].split()])
        along = np.array([float(word) for word in (axis.get("xyz") if axis is not None
                                                   else "1 0 0").split()])
        along = along / (np.linalg.norm(along) or 1)
        if kind == "prismatic":
            place = place + turn @ along * value
        elif kind != "fixed":
            turn = turn @ pinocchio.exp3(along * value)
        for name in ("origin", "mimic"):
            for part in joint.findall(name):
                joint.remove(part)
        for limit in joint.findall("limit"):  # about where it stands
            limit.attrib |= {"lower": "-0.001", "upper": "0.001"}
        xml.etree.ElementTree.SubElement(joint, "origin", {
            "xyz": " ".join(map(repr, place.tolist())),
            "rpy": " ".join(map(repr, pinocchio.rpy.matrixToRpy(turn).tolist()))})
    return xml.etree.ElementTree.tostring(robot, encoding="unicode")


def depth_in(source, values, links, work):
    """How deep tenon finds two links in one another in a posture [m]."""
    (work / "posed.urdf").write_text(posed(source, values))
    tenon("convert", work / "posed.urdf", work / "posed.usda", "--force", "--allow-read", ROBOTS)
    answer = tenon("pairs", work / "posed.usda", "--sample", 0, "--all")
    return next((pair["startDepth"] or 0.0 for pair in answer["pairs"]
                 if links == names_of(pair)), 0.0)


def names_of(pair):
    return tuple(sorted(pair[side].rsplit("/", 1)[1] for side in ("bodyA", "bodyB")))


def word(touching, of):
    return ("never" if touching == 0 else "always" if touching == of
            else "often" if 2 * touching >= of else "sometimes")


class Faults:
    """What differs on one robot."""

    def __init__(self, source, work):
        self.source, self.work = source, work
        self.wrong, self.different = [], []

    def never_here(self, links, touching, depth, values):
        """Coal finds two links deep in one another, and tenon drew no posture in which they are."""
        here = depth_in(self.source, values, links, self.work)
        text = (f"{' and '.join(links)}: {depth * 1e3:.2f} mm deep in {touching} of {OWN_SAMPLES} "
                f"postures, {here * 1e3:.2f} mm in the same one here")
        if abs(here - depth) <= max(FAR, 0.1 * depth):
            self.different.append(f"{text}, which was not drawn")
        else:
            self.wrong.append(f"{text}: missed")

    def no_pair(self, links, known, depth):
        if depth <= DEEP:
            return
        names = " and ".join(links)
        if set(links) <= known:
            self.wrong.append(f"{names}: {depth * 1e3:.2f} mm deep, no pair of tenon")
        else:
            self.different.append(f"{names}: tenon has them as one body, or without shapes")

    def kinds(self, links, kind, other, depth, own_depth):
        names = " and ".join(links)
        if kind != other and "never" not in (kind, other):
            self.different.append(f"{names}: {kind} here, {other} in Coal")
        elif kind == "always" and abs(depth - own_depth) > max(FAR, 0.1 * own_depth):
            self.different.append(f"{names}: {depth * 1e3:.1f} mm here, "
                                  f"{own_depth * 1e3:.1f} mm in Coal")


def compare(source, work, number):
    """-> faults, joints that are drawn, pairs, "always" pairs"""
    own = Pinocchios(source)
    asset = work / "robot.usda"
    tenon("convert", source, asset, "--force")
    answer = tenon("pairs", asset, "--sample", SAMPLES, "--seed", number, "--all")
    pairs = {names_of(pair): pair for pair in answer["pairs"]}
    faults, always = Faults(source, work), 0
    known = {link for pair in pairs for link in pair}
    for links, (touching, depth, free, values) in sorted(own.look(number).items()):
        pair = pairs.get(links)
        if pair is None:
            faults.no_pair(links, known, depth)
            continue
        kind = pair["class"] or "never"
        always += kind == "always"
        if kind == "always" and free and (apart := own.apart(links, free)) > APART:
            faults.wrong.append(f"{' and '.join(links)}: always touch, and are "
                                f"{apart * 1e3:.3f} mm apart")
        if depth > DEEP and kind == "never" and pair["startDepth"] is None:
            faults.never_here(links, touching, depth, values)
        faults.kinds(links, kind, word(touching, OWN_SAMPLES), pair["depth"], depth)
    return faults, len(own.bounds), len(pairs), always


def main():
    files = chosen()
    if not files:
        print("skipped: there are no published robots in build/robots")
        return 77
    compared = faults = differences = pairs = always = 0
    for number, source in enumerate(files):
        name = source.relative_to(ROBOTS)
        with tempfile.TemporaryDirectory() as folder:
            try:
                found, drawn, count, constant = compare(source, pathlib.Path(folder), number)
            except Skipped as why:
                print(f"not compared: {name}: {why}")
                continue
        print(f"{name.name}: {drawn} joints, {count} pairs, {constant} always, "
              f"{len(found.wrong)} wrong, {len(found.different)} different", flush=True)
        for line in found.wrong:
            print("  wrong: " + line)
        for line in found.different:
            print("  different: " + line)
        compared += 1
        faults += len(found.wrong)
        differences += len(found.different)
        pairs += count
        always += constant
        if compared == COUNT:
            break
    print(f"{compared} robots, {pairs} pairs, {always} always: {faults} wrong (falsely always, or "
          f"missed deeper than 1 mm), {differences} other differences")
    return 0 if faults == 0 and compared >= COUNT else 1


if __name__ == "__main__":
    sys.exit(main())
