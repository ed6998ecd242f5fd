# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Closed low-poly surfaces of the links, in link frames, metres: stacks of rounded-box rings
along Z.

Every surface is a closed manifold whose faces are wound counter-clockwise seen from outside
(right-handed). The visual mesh and the convex-hull collider of a link use the same surface, so
shapes are kept nearly convex.
"""

import math

from . import algebra as la


class Ring:
    """One cross-section at height z: centre (x, y) and half sizes along x and y."""

    def __init__(self, z, x, y, half_x, half_y):
        self.z, self.x, self.y, self.half_x, self.half_y = z, x, y, half_x, half_y

    def shrunk(self, dz, factor):
        return Ring(self.z + dz, self.x, self.y, self.half_x * factor, self.half_y * factor)


class Surface:
    """points, faces (tuples of point indices), and one smooth normal per point."""

    def __init__(self, points, faces):
        self.points, self.faces = points, faces
        self.normals = _normals(points, faces)

    def bounds(self):
        columns = list(zip(*self.points))
        return tuple(map(min, columns)), tuple(map(max, columns))


def _normals(points, faces):
    sums = [(0.0, 0.0, 0.0)] * len(points)
    for face in faces:
        # Newell: twice the area vector of the polygon, so larger faces count for more.
        area = (0.0, 0.0, 0.0)
        for i, j in zip(face, face[1:] + face[:1]):
            area = la.add(area, la.cross(points[i], points[j]))
        for i in face:
            sums[i] = la.add(sums[i], area)
    return [la.normalized(s) for s in sums]


def volume_and_center(surface):
    """Volume and centre of the enclosed solid, by summed tetrahedra over fan triangles."""
    volume, moment = 0.0, (0.0, 0.0, 0.0)
    for face in surface.faces:
        a = surface.points[face[0]]
        for i, j in zip(face[1:], face[2:]):
            b, c = surface.points[i], surface.points[j]
            part = la.dot(a, la.cross(b, c)) / 6
            volume += part
            moment = la.add(moment, la.scale(la.add(la.add(a, b), c), part / 4))
    return volume, la.scale(moment, 1 / volume)


# Superellipse exponent of the sections: 2 is an ellipse, larger is boxier.
ROUNDNESS = 3.2


def _section(ring, sides):
    points = []
    for k in range(sides):
        # Half a step of turn puts flats, not edges, on the four sides.
        angle = 2 * math.pi * (k + 0.5) / sides
        c, s = math.cos(angle), math.sin(angle)
        points.append(
            (
                ring.x + ring.half_x * math.copysign(abs(c) ** (2 / ROUNDNESS), c),
                ring.y + ring.half_y * math.copysign(abs(s) ** (2 / ROUNDNESS), s),
                ring.z,
            )
        )
    return points


def _dome(ring, depth):
    """Rings that round an end off: a quarter ellipse of the given depth beyond the ring,
    outermost last."""
    angles = (math.radians(35), math.radians(62), math.radians(80))
    return [ring.shrunk(depth * math.sin(a), math.cos(a)) for a in angles]


def loft(rings, sides, bottom, top):
    """The surface through the rings (ascending z), rounded off by `bottom` below the first and
    `top` above the last."""
    stack = _dome(rings[0], -bottom)[::-1] + list(rings) + _dome(rings[-1], top)
    points = [p for ring in stack for p in _section(ring, sides)]
    faces = [tuple(reversed(range(sides)))]
    for level in range(len(stack) - 1):
        low, high = level * sides, (level + 1) * sides
        for k in range(sides):
            n = (k + 1) % sides
            faces.append((low + k, low + n, high + n, high + k))
    last = (len(stack) - 1) * sides
    faces.append(tuple(range(last, last + sides)))
    return Surface(points, faces)


def _palm():
    rings = (
        Ring(0.003, 0.000, -0.003, 0.0200, 0.0265),
        Ring(0.030, -0.001, -0.003, 0.0190, 0.0310),
        Ring(0.070, -0.002, -0.003, 0.0170, 0.0370),
        Ring(0.105, -0.002, -0.003, 0.0145, 0.0395),
        Ring(0.124, -0.001, -0.003, 0.0125, 0.0400),
    )
    return loft(rings, 24, 0.003, 0.006)


def _knuckle_link():
    rings = (
        Ring(-0.002, -0.0005, 0, 0.0088, 0.0076),
        Ring(0.014, -0.0020, 0, 0.0086, 0.0074),
        Ring(0.033, 0.0012, 0, 0.0076, 0.0070),
    )
    return loft(rings, 12, 0.0065, 0.006)


def _fingertip(length):
    rings = (
        Ring(-0.001, -0.0010, 0, 0.0070, 0.0070),
        Ring(0.45 * length, -0.0030, 0, 0.0066, 0.0068),
        Ring(length - 0.010, -0.0012, 0, 0.0058, 0.0062),
    )
    return loft(rings, 12, 0.0060, 0.010)


def make_surfaces():
    """Link name -> Surface."""
    surfaces = {
        "r_base_link": _palm(),
        "right_thumb_1": loft(
            (
                Ring(-0.016, 0.001, 0.0045, 0.0085, 0.0105),
                Ring(0.002, 0.001, 0.004, 0.0085, 0.0095),
            ),
            12,
            0.004,
            0.004,
        ),
        "right_thumb_2": loft(
            (
                Ring(-0.002, -0.001, 0, 0.0085, 0.0080),
                Ring(0.026, -0.0035, 0, 0.0085, 0.0078),
                Ring(0.056, -0.001, 0, 0.0076, 0.0076),
            ),
            12,
            0.0065,
            0.0055,
        ),
        "right_thumb_3": loft(
            (
                Ring(-0.001, -0.002, 0, 0.0076, 0.0076),
                Ring(0.012, -0.004, 0, 0.0078, 0.0078),
                Ring(0.0225, -0.001, 0, 0.0072, 0.0076),
            ),
            12,
            0.006,
            0.0055,
        ),
        "right_thumb_4": loft(
            (
                Ring(-0.001, -0.0010, 0, 0.0070, 0.0076),
                Ring(0.009, -0.0015, 0, 0.0068, 0.0076),
                Ring(0.019, -0.0005, 0, 0.0056, 0.0066),
            ),
            12,
            0.0055,
            0.008,
        ),
    }
    for finger, length in (("index", 0.046), ("middle", 0.049), ("ring", 0.046), ("little", 0.038)):
        surfaces[f"right_{finger}_1"] = _knuckle_link()
        surfaces[f"right_{finger}_2"] = _fingertip(length)
    return surfaces
