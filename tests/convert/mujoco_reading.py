# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A robot's numbers as MuJoCo's own reader has them, beside those of a `tenon physics --json`.

Everything in SI units and radians, frames in the world where all coordinates are 0.
"""

import math
import re
import xml.etree.ElementTree

import mujoco
import numpy

FLOAT = 4e-7  # relative rounding of floats, through degrees and a turned frame


def legal(name):
    """The prim name that a name of the description becomes."""
    name = re.sub(r"[^A-Za-z0-9_]", "_", name)
    return "_" + name if name[:1].isdigit() else name


def rotation(q):
    w, x, y, z = q
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def about(axis, angle):
    half = numpy.zeros(4)
    half[0], half[1 + "xyz".index(axis)] = math.cos(angle / 2), math.sin(angle / 2)
    return rotation(half)


def impossible_inertia(link):
    """The tensor in the link's axes where no body has such a one; a sphere's stands in for it."""
    element = link.find("inertial/inertia")
    tensor = numpy.array([[float(element.get("i" + "".join(sorted(a + b)))) for b in "xyz"]
                          for a in "xyz"])
    moments = numpy.linalg.eigvalsh(tensor)
    if moments[0] > 1e-14 and moments[0] + moments[1] >= moments[2] * (1 + 1e-9):
        return None
    for a, b in ("xx", "yy", "zz", "xy", "xz", "yz"):
        element.set(f"i{a}{b}", "1" if a == b else "0")
    origin = link.find("inertial/origin")
    roll, pitch, yaw = map(float, (origin.get("rpy") if origin is not None and origin.get("rpy")
                                   else "0 0 0").split())
    if moments[0] <= 1e-9 * abs(sum(moments)):
        return numpy.eye(3) * max(0, sum(moments) / 3)  # what the converter says that it takes
    turn = about("z", yaw) @ about("y", pitch) @ about("x", roll)
    return turn @ tensor @ turn.T


def urdf_physics(path):
    """The URDF for MuJoCo, without shapes: inertias are explicit, meshes are none of its matter.

    -> text, names of links that give no mass, mimics by joint, inertias that MuJoCo refuses.
    """
    robot = xml.etree.ElementTree.parse(path).getroot()
    bare, mimics, refused = set(), {}, {}
    for link in robot.findall("link"):
        for name in ("visual", "collision"):
            for shape in link.findall(name):
                link.remove(shape)
        mass = link.find("inertial/mass")
        if mass is None or float(mass.get("value")) == 0:
            bare.add(link.get("name"))
        elif (tensor := impossible_inertia(link)) is not None:
            refused[link.get("name")] = tensor
    for joint in robot.findall("joint"):
        if joint.get("type") == "continuous" and joint.find("limit") is not None:
            for end in ("lower", "upper"):  # MuJoCo heeds them, URDF does not
                joint.find("limit").attrib.pop(end, None)
        mimic = joint.find("mimic")
        if mimic is not None:
            law = (mimic.get("joint"), float(mimic.get("multiplier", "1")),
                                         float(mimic.get("offset", "0")))
            joint.remove(mimic)
            if robot.find(f"joint[@name='{law[0]}']") is not None:
                mimics[joint.get("name")] = law
    for other in [child for child in robot if child.tag not in ("link", "joint")]:
        robot.remove(other)
    settings = xml.etree.ElementTree.SubElement(robot, "mujoco")
    xml.etree.ElementTree.SubElement(settings, "compiler", {
        "fusestatic": "false", "inertiafromgeom": "false", "balanceinertia": "false",
        "boundmass": "1e-12", "boundinertia": "1e-14"})
    return xml.etree.ElementTree.tostring(robot, encoding="unicode"), bare, mimics, refused


FAR = 1e8  # what is farther is no end: MuJoCo drops such limits, and URDF has no endless slides


def open_end(value, infinity):
    """JSON has no word for infinity."""
    return infinity if value is None or isinstance(value, str) or abs(value) >= FAR else value


def read_again(read, *arguments):
    """What MuJoCo reads. It refuses a good number where errno was set by something else meanwhile,
    as happens in threads and more often on a busy machine; read once more, the number is good."""
    for _ in range(40):
        try:
            return read(*arguments)
        except ValueError as error:
            if "unknown error in attribute" not in str(error):
                raise
    return read(*arguments)


class Reading:
    """A description in MuJoCo's words."""

    def __init__(self, path):
        self.urdf = path.suffix == ".urdf"
        if self.urdf:
            text, self.bare, self.mimics, self.refused = urdf_physics(path)
            self.spec = read_again(mujoco.MjSpec.from_string, text)
        else:
            self.bare, self.mimics, self.refused = set(), None, {}
            self.spec = read_again(mujoco.MjSpec.from_file, str(path))
        self.spec.compiler.fusestatic = False
        self.spec.compiler.discardvisual = False
        self.model = self.spec.compile()
        self.data = mujoco.MjData(self.model)
        mujoco.mj_kinematics(self.model, self.data)
        if self.mimics is None:
            self.mimics = self.joint_equalities()

    def joint_equalities(self):
        model, laws = self.model, {}
        for i in range(model.neq):
            if (model.eq_type[i] == mujoco.mjtEq.mjEQ_JOINT and model.eq_active0[i] and
                    model.eq_obj2id[i] >= 0):
                data = model.eq_data[i]
                laws[model.joint(model.eq_obj1id[i]).name] = (
                    model.joint(model.eq_obj2id[i]).name, data[1], data[0])
        return laws


class Comparison:
    """Faults of one robot, and how many numbers were held to each other."""

    unsaid = ()  # numbers of joints that the description cannot give
    shift = 0  # of the description in the world [m]
    tolerance = FLOAT

    def __init__(self, name, reading, scene):
        self.name, self.reading, self.scene = name, reading, scene
        self.faults, self.compared = [], 0
        self.bodies = {body["path"].rsplit("/", 1)[1]: body for body in scene["bodies"]}
        self.by_path = {body["path"]: body for body in scene["bodies"]}
        self.joints = {joint["path"].rsplit("/", 1)[1]: joint for joint in scene["joints"]}

    def near(self, what, found, wanted, scale=None):
        found = numpy.array([float(x) for x in numpy.ravel(found)])
        wanted = numpy.array([float(x) for x in numpy.ravel(wanted)])
        if scale is None:
            scale = max(1, float(numpy.max(numpy.abs(wanted[numpy.isfinite(wanted)]), initial=0)))
        self.compared += 1
        with numpy.errstate(invalid="ignore"):
            good = (found == wanted) | (numpy.abs(found - wanted) <= self.tolerance * scale)
        if not good.all():
            self.faults.append(f"{self.name}: {what}: {found.tolist()}, MuJoCo {wanted.tolist()}")

    def run(self):
        model = self.reading.model
        for number in range(1, model.nbody):
            self.compare_body(number)
        for number in range(model.njnt):
            self.compare_joint(number)
        for name, law in self.reading.mimics.items():
            self.compare_mimic(name, law)
        known = {legal(joint) for joint in self.reading.mimics}
        for name, joint in self.joints.items():
            if joint["mimic"] and name not in known:
                self.faults.append(f"{self.name}: {name} follows a joint that it should not")
        return self

    def compare_body(self, number):
        model, data = self.reading.model, self.reading.data
        name = model.body(number).name or f"body_{number}"
        if name in self.reading.bare or model.body_mass[number] == 0:
            return
        body = self.bodies.get(legal(name))
        if body is None:
            self.faults.append(f"{self.name}: no body {name}")
            return
        mass = model.body_mass[number]
        self.near(f"{name}: mass", body["mass"], mass, mass)
        self.near(f"{name}: centre", body["centerOfMass"], model.body_ipos[number])
        self.near(f"{name}: position", body["position"], data.xpos[number])
        self.near(f"{name}: orientation", rotation(body["orientation"]),
                  rotation(data.xquat[number]))
        axes = rotation(model.body_iquat[number])
        inertia = axes @ numpy.diag(model.body_inertia[number]) @ axes.T
        inertia = self.reading.refused.get(name, inertia)
        if inertia.any():  # else it is computed from the colliders, and listed
            self.near(f"{name}: inertia", body["inertia"], inertia,
                      numpy.max(numpy.abs(inertia)))

    def compare_joint(self, number):
        model, data = self.reading.model, self.reading.data
        kind = mujoco.mjtJoint(int(model.jnt_type[number]))
        name = model.joint(number).name or f"joint_{number}"
        if kind == mujoco.mjtJoint.mjJNT_FREE:
            return
        joint = self.joints.get(legal(name))
        if joint is None:
            self.faults.append(f"{self.name}: no joint {name}")
            return
        wanted = {mujoco.mjtJoint.mjJNT_HINGE: "revolute", mujoco.mjtJoint.mjJNT_SLIDE: "prismatic",
                  mujoco.mjtJoint.mjJNT_BALL: "spherical"}[kind]
        if joint["type"] != wanted:
            self.faults.append(f"{self.name}: {name} is {joint['type']}, MuJoCo has {wanted}")
            return
        body = self.by_path[joint["body1"]]
        turn, frame = rotation(body["orientation"]), joint["frame1"]
        self.near(f"{name}: anchor", numpy.array(body["position"]) + turn @ frame["position"],
                  data.xanchor[number] + self.shift)
        if wanted == "spherical":
            return
        axis = (turn @ rotation(frame["orientation"]))[:, "xyz".index(joint["axis"].lower())]
        self.near(f"{name}: axis", axis, data.xaxis[number])
        self.compare_dof(name, joint, number)

    def compare_dof(self, name, joint, number):
        model = self.reading.model
        dof, start = model.jnt_dofadr[number], model.qpos0[model.jnt_qposadr[number]]
        limits = [-math.inf, math.inf]
        if model.jnt_limited[number]:
            limits = [end if abs(end) < FAR else math.copysign(math.inf, end)
                      for end in model.jnt_range[number] - start]
        self.near(f"{name}: limits", [open_end(joint["lower"], -math.inf),
                                      open_end(joint["upper"], math.inf)], limits)
        for word, wanted in (("damping", model.dof_damping[dof]),
                             ("friction", model.dof_frictionloss[dof]),
                             ("armature", model.dof_armature[dof]),
                             ("stiffness", model.jnt_stiffness[number])):
            if word in self.unsaid:
                continue
            self.near(f"{name}: {word}", joint[word], numpy.ravel(wanted)[0])

    def compare_mimic(self, name, law):
        joint = self.joints.get(legal(name))
        if joint is None or not joint["mimic"]:
            self.faults.append(f"{self.name}: {name} follows nothing")
            return
        leader, multiplier, offset = law
        # A joint that follows a follower follows its leader.
        while leader in self.reading.mimics:
            leader, m, o = self.reading.mimics[leader]
            multiplier, offset = multiplier * m, offset + multiplier * o
        path, m, o = self.law(joint["mimic"])
        if path != legal(leader):
            self.faults.append(f"{self.name}: {name} follows {path}, not {leader}")
        self.near(f"{name}: law", [m, o], [multiplier, offset])

    def law(self, mimic):
        """-> name of the first leader, multiplier, offset."""
        leader = mimic["leader"].rsplit("/", 1)[1]
        above = self.joints[leader]["mimic"]
        if not above:
            return leader, mimic["multiplier"], mimic["offset"]
        leader, m, o = self.law(above)
        return leader, mimic["multiplier"] * m, mimic["offset"] + mimic["multiplier"] * o


class WorldComparison(Comparison):
    """Of a description whose link frames may stand at joints: centres of mass in the world.

    What descriptions have no word for is not compared.
    """

    unsaid = ("armature", "stiffness")
    tolerance = 3e-6  # bodies of such assets stand where their joints say, but for rounding

    def __init__(self, name, reading, scene):
        super().__init__(name, reading, scene)
        # A description begins at the root; where that stands in the world it cannot say.
        root = self.bodies.get(legal(reading.model.body(1).name))
        carried = {joint["body1"] for joint in scene["joints"]}
        self.shift = numpy.zeros(3)
        if root is not None and root["path"] not in carried:
            self.shift = numpy.array(root["position"]) - reading.data.xpos[1]

    def compare_body(self, number):
        model, data = self.reading.model, self.reading.data
        body = self.bodies.get(legal(model.body(number).name))
        if body is None or model.body_mass[number] == 0:
            return  # a frame
        turn = rotation(body["orientation"])
        self.near(f"{body['path']}: mass", body["mass"], model.body_mass[number], body["mass"])
        self.near(f"{body['path']}: centre",
                  numpy.array(body["position"]) + turn @ body["centerOfMass"],
                  data.xipos[number] + self.shift)
        axes = rotation(model.body_iquat[number])
        inertia = axes @ numpy.diag(model.body_inertia[number]) @ axes.T
        inertia = self.reading.refused.get(model.body(number).name, inertia)
        self.near(f"{body['path']}: inertia", body["inertia"], inertia,
                  numpy.max(numpy.abs(inertia)))
