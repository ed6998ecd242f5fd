# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""The hand as numbers: links, frames, masses, joints, drives and mimic laws, in metres, kilograms
and degrees.

Sources of the figures
- Total mass 0.540 kg, joint count, the thumb's 75 degree swing and its place (0.01696, 0.02045,
  0.0667), the speeds 107 and 260 deg/s, the law "right_thumb_4 = 0.7508 * right_thumb_3 - 0.1
  deg": public data of the RH56DFX hand.
- Joint places and axes, limits, efforts, link masses, centres of mass and inertia tensors: the
  URDF that Unitree publishes for the same hand (unitree_ros, BSD-3). Its link masses sum to
  0.19179 kg (motors and screws are left out), so every mass and inertia is multiplied by 0.540 /
  0.19179 = 2.816.
- Shapes, frames, gains, armature, friction and the grasp are this project's own.

Frames. The base frame B has its origin at the wrist, +Z along the stretched fingers, +X out of
the palm, +Y towards the thumb's side. Every moving link but right_thumb_1 has its origin at its
joint, +Z along the bone, +Y along the flexion axis and +X towards the side it bends to, so that a
positive angle closes the hand. right_thumb_1 keeps the axes of B and turns about -Z, so that a
positive angle swings the thumb from the side to the front of the palm.
"""

import math

from . import algebra as la

TOTAL_MASS = 0.540

FINGERS = ("index", "middle", "ring", "little")
BASE = "r_base_link"
THUMBS = ("right_thumb_1", "right_thumb_2", "right_thumb_3", "right_thumb_4")

# The URDF's base frame U seen from B: B.x = -U.x, B.y = -U.z, B.z = -U.y.
B_FROM_U = ((-1, 0, 0), (0, 0, -1), (0, -1, 0))

# Mass, centre of mass and inertia (xx, xy, xz, yy, yz, zz) in the URDF's own link frames,
# unscaled.
URDF_INERTIAL = {
    "r_base_link": (
        0.14143,
        (-0.0025264, -0.066047, 0.0019598),
        (1.2281e-4, 2.1711e-6, 1.7709e-6, 8.3832e-5, -1.6551e-6, 7.6663e-5),
    ),
    "right_thumb_1": (
        0.0018869,
        (-0.0048064, 0.0009382, -0.00757),
        (5.816e-8, 1.4539e-8, 4.491e-9, 7.9161e-8, -1.8727e-9, 6.7433e-8),
    ),
    "right_thumb_2": (
        0.0066075,
        (0.021932, 0.012785, -0.0080386),
        (1.5686e-6, -7.8296e-7, 8.9143e-10, 1.7353e-6, -1.0191e-9, 2.786e-6),
    ),
    "right_thumb_3": (
        0.0037847,
        (0.0095544, -0.0016282, -0.0071997),
        (3.6981e-7, -9.8581e-8, -4.7469e-12, 3.2394e-7, 1.0939e-12, 4.6531e-7),
    ),
    "right_thumb_4": (
        0.0033441,
        (0.0092888, 0.0049529, -0.0060033),
        (1.3632e-7, -5.6788e-8, -9.2764e-11, 1.4052e-7, -1.2283e-10, 2.0026e-7),
    ),
    "right_index_1": (
        0.0042403,
        (0.0012259, 0.011942, -0.0060001),
        (6.6232e-7, -1.5775e-8, 1.8515e-12, 2.1146e-7, -5.0828e-12, 6.9398e-7),
    ),
    "right_index_2": (
        0.0045683,
        (0.0019697, 0.019589, -0.005),
        (7.6111e-7, 8.7637e-8, -3.7751e-13, 9.6076e-8, 9.9444e-13, 7.8179e-7),
    ),
    "right_middle_1": (
        0.0042403,
        (0.001297, 0.011934, -0.0060001),
        (6.6211e-7, -1.8461e-8, 1.8002e-12, 2.1167e-7, -6.6808e-12, 6.9397e-7),
    ),
    "right_middle_2": (
        0.0050396,
        (0.001921, 0.020796, -0.005),
        (9.5822e-7, 1.1425e-7, -2.4791e-12, 1.0646e-7, 5.9173e-12, 9.8384e-7),
    ),
    "right_ring_1": (
        0.0042403,
        (0.001297, 0.011934, -0.0060002),
        (6.6211e-7, -1.8461e-8, 1.5793e-12, 2.1167e-7, -6.6868e-12, 6.9397e-7),
    ),
    "right_ring_2": (
        0.0045683,
        (0.0021753, 0.019567, -0.005),
        (7.6286e-7, 8.0635e-8, -6.1562e-13, 9.431e-8, 5.8619e-13, 7.8177e-7),
    ),
    "right_little_1": (
        0.0042403,
        (0.001297, 0.011934, -0.0060001),
        (6.6211e-7, -1.8461e-8, 1.6907e-12, 2.1167e-7, -6.9334e-12, 6.9397e-7),
    ),
    "right_little_2": (
        0.0035996,
        (0.0024748, 0.016203, -0.0050031),
        (4.3913e-7, 4.1418e-8, 3.7168e-11, 7.0247e-8, 5.8613e-11, 4.4867e-7),
    ),
}

# Knuckle place in U and roll of the finger's URDF frame; place of the second joint in that frame.
URDF_FINGER = {
    "index": ((0.00028533, -0.13653, -0.032268), -3.1067, (-0.0026138, 0.032026, -0.001)),
    "middle": ((0.00028533, -0.1371, -0.01295), -math.pi, (-0.0024229, 0.032041, -0.001)),
    "ring": ((0.00028533, -0.13691, 0.0062872), 3.0892, (-0.0024229, 0.032041, -0.001)),
    "little": ((0.00028533, -0.13571, 0.025488), 3.0369, (-0.0024229, 0.032041, -0.001)),
}
# The URDF puts a finger's joint on one side of the finger. The joint is moved along its own axis
# to the middle of the finger, by this much; motion is the same, and shapes become symmetric about
# the link frame.
FINGER_MIDDLE = -0.006
THUMB_MIDDLE = -0.008

THUMB_1_PLACE = (0.01696, 0.02045, 0.0667)
# Each thumb joint in the frame of the one before, URDF frames.
URDF_THUMB_1_RPY = (math.pi / 2, -math.pi / 2, 0.0)
URDF_THUMB_2 = ((-0.0088099, 0.010892, -0.00925), (math.pi / 2, 0.0, 2.8587))
URDF_THUMB_3 = (0.04407, 0.034553, -0.0008)
URDF_THUMB_4 = (0.020248, 0.010156, -0.0012)
# Where the thumb's tip lies, seen from its last joint; own choice, on the line through the centre
# of mass.
THUMB_TIP = (0.0213, 0.0113, 0.0)


class Link:
    """A body: name, parent's name or None, pose in B at zero angles (rotation, place), mass
    properties."""

    def __init__(self, name, parent, rotation, place, urdf_rotation, urdf_place):
        self.name, self.parent = name, parent
        self.rotation, self.place = rotation, place
        self.urdf_rotation, self.urdf_place = urdf_rotation, urdf_place
        self.mass = self.center = self.moments = self.axes = None

    def to_local(self, point_in_base):
        return la.apply(la.transpose(self.rotation), la.sub(point_in_base, self.place))

    def set_inertial(self, factor):
        """Moves the URDF's mass properties into this link's frame; moments become principal
        ones."""
        mass, center, (xx, xy, xz, yy, yz, zz) = URDF_INERTIAL[self.name]
        in_base = la.add(self.urdf_place, la.apply(self.urdf_rotation, center))
        turn = la.multiply(la.transpose(self.rotation), self.urdf_rotation)
        tensor = la.multiply(
            turn, la.multiply(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)), la.transpose(turn))
        )
        self.mass = round(mass * factor, 7)
        self.center = self.to_local(in_base)
        moments, axes = la.eigen(tensor)
        self.moments = la.scale(moments, factor)
        self.axes = la.quaternion(axes)


def _bone_frame(flexion_axis, bone):
    """Rotation whose Y is the flexion axis and whose Z lies along the bone."""
    z, y = la.normalized(bone), la.normalized(flexion_axis)
    return la.from_axes(la.cross(y, z), y, z)


def _finger(finger):
    knuckle_u, roll, second = URDF_FINGER[finger]
    urdf = la.multiply(B_FROM_U, la.from_rpy(roll, 0, 0))
    axis = la.apply(urdf, (0, 0, 1))
    frame = _bone_frame(axis, la.apply(urdf, (0, 1, 0)))
    knuckle = la.apply(B_FROM_U, knuckle_u)
    second_place = la.add(knuckle, la.apply(urdf, second))
    first_name, second_name = f"right_{finger}_1", f"right_{finger}_2"
    middle = la.scale(axis, FINGER_MIDDLE)
    # The second joint's URDF origin stands 1 mm aside along the axis; both links share one centre
    # line here.
    second_middle = la.scale(axis, FINGER_MIDDLE - second[2])
    return (
        Link(first_name, BASE, frame, la.add(knuckle, middle), urdf, knuckle),
        Link(
            second_name, first_name, frame, la.add(second_place, second_middle), urdf, second_place
        ),
    )


def _thumb():
    turn_1 = la.multiply(B_FROM_U, la.from_rpy(*URDF_THUMB_1_RPY))
    place_1 = THUMB_1_PLACE
    turn = la.multiply(turn_1, la.from_rpy(*URDF_THUMB_2[1]))
    place_2 = la.add(place_1, la.apply(turn_1, URDF_THUMB_2[0]))
    place_3 = la.add(place_2, la.apply(turn, URDF_THUMB_3))
    place_4 = la.add(place_3, la.apply(turn, URDF_THUMB_4))
    axis = la.apply(turn, (0, 0, 1))
    links = [
        Link("right_thumb_1", BASE, ((1, 0, 0), (0, 1, 0), (0, 0, 1)), place_1, turn_1, place_1)
    ]
    aside = THUMB_MIDDLE
    steps = ((place_2, URDF_THUMB_3), (place_3, URDF_THUMB_4), (place_4, THUMB_TIP))
    for number, (place, step) in enumerate(steps, 2):
        frame = _bone_frame(axis, la.apply(turn, (step[0], step[1], 0)))
        middle = la.add(place, la.scale(axis, aside))
        links.append(
            Link(f"right_thumb_{number}", f"right_thumb_{number - 1}", frame, middle, turn, place)
        )
        aside -= step[2]
    return links


def mass_factor():
    """What the URDF's masses and inertias are multiplied by."""
    return TOTAL_MASS / sum(values[0] for values in URDF_INERTIAL.values())


def make_links():
    """All links, the base first and every parent before its children; the masses sum to
    TOTAL_MASS."""
    links = [Link(BASE, None, ((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0), B_FROM_U, (0, 0, 0))]
    links += _thumb()
    for finger in FINGERS:
        links += _finger(finger)
    for link in links:
        link.set_inertial(mass_factor())
    # Masses are written with 0.1 mg; the base takes the rounding, so that the sum is TOTAL_MASS
    # to the digit.
    links[0].mass = round(TOTAL_MASS - sum(link.mass for link in links[1:]), 7)
    return links


class Joint:
    """A revolute joint of the link of the same name; law is None or (leader link, factor, offset
    in degrees)."""

    def __init__(self, link, lower, upper, effort, speed, law=None, gains=None):
        self.link, self.name = link, link + "_joint"
        self.lower, self.upper, self.effort, self.speed = lower, upper, effort, speed
        self.law, self.gains = law, gains


DEGREES = 180 / math.pi
FINGER_RANGE = round(1.7 * DEGREES, 3)
# Torque per degree, and torque per degree per second: 2.9 N m/rad and 0.09 N m s/rad. With
# ARMATURE this is an own frequency of about 12 Hz at about critical damping, and 20 degrees of
# error ask for the full effort of 1 N m.
STIFFNESS, DAMPING = 0.05, 0.0015
# kg m^2; what motor and screw add to each joint. Links of 10 g alone would be too light for steps
# of 2 ms.
ARMATURE = 0.0002
FRICTION = 0.002
# Compliance of the mimic chains: rad/s and critical damping. MuJoCo's solref is (1 / (frequency *
# ratio), ratio).
MIMIC_FREQUENCY, MIMIC_RATIO = 100.0, 1.0
THUMB_SPEED, FINGER_SPEED = 107.0, 260.0

# A follower's limits must hold all that its law can ask of it. The URDF lets right_thumb_3 end at
# 0.8 rad although 1.6 * 0.6 rad = 0.96 rad are asked; it ends at 56 degrees here. Followers also
# get 1 degree of room below zero.
JOINTS = (
    Joint("right_thumb_1", 0.0, 75.0, 1.0, THUMB_SPEED, gains=(STIFFNESS, DAMPING)),
    Joint(
        "right_thumb_2", 0.0, round(0.6 * DEGREES, 3), 1.0, FINGER_SPEED, gains=(STIFFNESS, DAMPING)
    ),
    Joint("right_thumb_3", -1.0, 56.0, 1.0, FINGER_SPEED, law=("right_thumb_2", 1.6, 0.0)),
    Joint(
        "right_thumb_4",
        -1.0,
        round(1.2 * DEGREES, 3),
        1.0,
        FINGER_SPEED,
        law=("right_thumb_3", 0.7508, -0.1),
    ),
) + tuple(
    joint
    for finger in FINGERS
    for joint in (
        Joint(
            f"right_{finger}_1", 0.0, FINGER_RANGE, 1.0, FINGER_SPEED, gains=(STIFFNESS, DAMPING)
        ),
        Joint(
            f"right_{finger}_2",
            -1.0,
            FINGER_RANGE + 1.0,
            1.0,
            FINGER_SPEED,
            law=(f"right_{finger}_1", 1.0, 0.0),
        ),
    )
)


# Pairs that are no parent and child but overlap somewhere in the joint ranges; they never
# collide.
FILTERED = {
    "r_base_link": ("right_thumb_2",),
    "right_thumb_1": ("right_thumb_3",),
    "right_thumb_2": ("right_thumb_4",),
}

# Joint axis Z of the joint frame, seen from the link: -Z of right_thumb_1, +Y of every other
# link.
_THUMB_SWING = ((1, 0, 0), (0, -1, 0), (0, 0, -1))
_FLEXION = ((1, 0, 0), (0, 0, 1), (0, -1, 0))


def joint_frames(link, parent):
    """((place, quaternion) in the parent, (place, quaternion) in the link) of the link's
    joint."""
    axis_frame = _THUMB_SWING if link.name == "right_thumb_1" else _FLEXION
    relative = la.multiply(la.transpose(parent.rotation), link.rotation)
    return (
        (parent.to_local(link.place), la.quaternion(la.multiply(relative, axis_frame))),
        ((0.0, 0.0, 0.0), la.quaternion(axis_frame)),
    )
