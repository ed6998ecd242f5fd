# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""A reader of uncompressed GLB that believes nothing: sizes, offsets, types and ranges are held to
glTF 2.0."""

import json
import struct

SIZES = {5120: ("b", 1), 5121: ("B", 1), 5122: ("h", 2), 5123: ("H", 2), 5125: ("I", 4),
         5126: ("f", 4)}
COUNTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Glb:
    """The JSON and the binary part of a file."""

    def __init__(self, contents):
        magic, version, size = struct.unpack_from("<4sII", contents)
        assert (magic, version, size) == (b"glTF", 2, len(contents)), (magic, version, size)
        length, kind = struct.unpack_from("<I4s", contents, 12)
        assert kind == b"JSON" and length % 4 == 0
        self.json = json.loads(contents[20:20 + length], parse_constant=self.refuse)
        rest = contents[20 + length:]
        self.binary = b""
        if rest:
            length, kind = struct.unpack_from("<I4s", rest)
            assert kind == b"BIN\0" and length == len(rest) - 8 and length % 4 == 0
            self.binary = rest[8:]
        self.nodes = self.json["nodes"]

    @staticmethod
    def refuse(word):
        raise AssertionError(f"{word} is no JSON")

    def values(self, number):
        """The elements of an accessor as tuples, within the bounds that it says."""
        accessor = self.json["accessors"][number]
        view = self.json["bufferViews"][accessor["bufferView"]]
        letter, size = SIZES[accessor["componentType"]]
        count = COUNTS[accessor["type"]]
        stride = view.get("byteStride", size * count)
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        assert start % 4 == 0 and stride >= size * count
        assert stride * (accessor["count"] - 1) + size * count <= view["byteLength"]
        assert view.get("byteOffset", 0) + view["byteLength"] <= len(self.binary)
        found = [struct.unpack_from(f"<{count}{letter}", self.binary, start + i * stride)
                 for i in range(accessor["count"])]
        for k, (least, most) in enumerate(zip(accessor.get("min", []), accessor.get("max", []))):
            assert abs(min(v[k] for v in found) - least) < 1e-6, (number, k)
            assert abs(max(v[k] for v in found) - most) < 1e-6, (number, k)
        return found

    def check(self):
        """Every mesh has corners that are there; every node is below one other at most."""
        for mesh in self.json.get("meshes", []):
            for part in mesh["primitives"]:
                points = self.values(part["attributes"]["POSITION"])
                corners = [corner for (corner,) in self.values(part["indices"])]
                assert len(corners) % 3 == 0 and max(corners) < len(points)
                for name, number in part["attributes"].items():
                    assert len(self.values(number)) == len(points), name
        children = [child for node in self.nodes for child in node.get("children", [])]
        assert len(children) == len(set(children))
        assert all(0 < child < len(self.nodes) for child in children)

    def node_of(self, path, kind="body"):
        """The number of a node by the path and kind in its extras."""
        found = [i for i, node in enumerate(self.nodes)
                 if node.get("extras", {}).get("path") == path and node["extras"]["kind"] == kind]
        assert len(found) == 1, (path, found)
        return found[0]

    def channel(self, node, path):
        """Times and values of a channel of the motion; None where there is none."""
        motion = self.json["animations"][0]
        for channel in motion["channels"]:
            if channel["target"] == {"node": node, "path": path}:
                sampler = motion["samplers"][channel["sampler"]]
                return ([t for (t,) in self.values(sampler["input"])],
                        self.values(sampler["output"]))
        return None
