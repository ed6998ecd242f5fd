#!/usr/bin/env python3
# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Instructions of a command when what a file has many of is doubled: at most 2.3 times as many, or
what a library takes itself.

    growth.py PROGRAM [NAME...]

PROGRAM is built with the preset `release`; NAME: only the kinds whose names begin so. Each kind is
a file that a size makes, and a command; the sizes are large enough for what grows with the square
to be seen. Relationships and arrays come from the tables of schemas (growth_properties.py): each
is long in one scene and stands on many prims in another, and one without a row there is a fault.
Exit 77: no valgrind.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import growth_properties

HEAD = '#usda 1.0\n(\n    defaultPrim = "W"\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
BODY = '"PhysicsRigidBodyAPI", "PhysicsCollisionAPI"'


def missing_targets(count):
    """One relationship whose targets do not exist."""
    targets = ", ".join(f"</W/a{i}>" for i in range(count))
    return HEAD + 'def Xform "W"\n{\n    rel r = [' + targets + "]\n}\n"


def wrong_pairs(count):
    """Filtered pairs with what is missing, with what has no collider, and of a prim without one."""
    missing = ", ".join(f"</W/gone{i}>" for i in range(count))
    empty = ", ".join(f"</W/e{i}>" for i in range(count))
    rows = [f'    def Sphere "{name}" (prepend apiSchemas = [{schemas}"PhysicsFilteredPairsAPI"])\n'
            f"    {{\n        rel physics:filteredPairs = [{targets}]\n    }}"
            for name, schemas, targets in (("b", BODY + ", ", f"{missing}, {empty}"),
                                           ("c", "", f"{missing}, {empty}"))]
    rows += [f'    def Xform "e{i}"\n    {{\n    }}' for i in range(count)]
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(rows) + "\n}\n"


def ops_above_bodies(count):
    """As many transform operations on a prim as bodies below it."""
    ops = [f"xformOp:translate:a{i}" for i in range(count)]
    names = ", ".join(f'"{op}"' for op in ops)
    lines = [f"    double3 {op} = (1, 0, 0)" for op in ops]
    lines.append(f"    uniform token[] xformOpOrder = [{names}]")
    for i in range(count):
        lines.append(f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n'
                     f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
                     '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }')
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(lines) + "\n}\n"


def bodies_at_one_place(count):
    spheres = [f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n    }}'
               for i in range(count)]
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(spheres) + "\n}\n"


def pairs_with_the_root(count):
    """Bodies that each name the prim above all of them."""
    schemas = BODY + ', "PhysicsFilteredPairsAPI"'
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(
        f'    def Sphere "b{i}" (prepend apiSchemas = [{schemas}])\n    {{\n'
        f"        rel physics:filteredPairs = </W>\n"
        f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
        '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }'
        for i in range(count)) + "\n}\n"


def group(index, inside):
    return (f'    def PhysicsCollisionGroup "g{index}"'
            ' (prepend apiSchemas = ["CollectionAPI:colliders"])\n'
            f"    {{\n        {inside}\n    }}")


def merged_groups(count):
    """Groups of seven merge names, each with all bodies."""
    groups = [group(i, "rel collection:colliders:includes = </W/all>\n"
                    f'        string physics:mergeGroup = "m{i % 7}"\n'
                    f"        rel physics:filteredGroups = </W/g{(i + 1) % count}>")
              for i in range(count)]
    return (HEAD + 'def Xform "W"\n{\n    def Xform "all"\n    {\n'
            f'        def Cube "b" (prepend apiSchemas = [{BODY}])\n        {{\n        }}\n'
            "    }\n" + "\n".join(groups) + "\n}\n")


def all_in_many_groups(count):
    """As many colliders as groups, each of them in all groups."""
    bodies = [f'    def Cube "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n'
              f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
              '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }'
              for i in range(count)]
    groups = [group(i, "rel collection:colliders:includes = </W>") for i in range(count)]
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(bodies + groups) + "\n}\n"


def collections_of_collections(count):
    """Groups each of which includes the collection of the next one."""
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(
        group(i, f"rel collection:colliders:includes = [</W/g{i + 1}.collection:colliders>]")
        for i in range(count)) + "\n}\n"


def expressions_of_groups(count):
    """Bodies, and half as many groups with an expression that names one pattern many times."""
    expression = " + ".join(["//*b1"] * 20 + ["//b2*"])
    bodies = [f'    def Cube "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n    }}'
              for i in range(count)]
    groups = [group(i, "pathExpression collection:colliders:membershipExpression = "
                    f'"{expression}"') for i in range(count // 2)]
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(bodies + groups) + "\n}\n"


def mimics_of_mimics(count):
    """Joints on one body, each of which follows the next one."""
    rows = []
    for i in range(count):
        follows = f"        rel newton:mimicJoint = </W/j{i + 1}>\n" if i + 1 < count else ""
        rows.append(f'    def Cube "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n    }}\n'
                    f'    def PhysicsRevoluteJoint "j{i}"'
                    ' (prepend apiSchemas = ["NewtonMimicAPI"])\n'
                    "    {\n        rel physics:body0 = </W/a>\n"
                    f"        rel physics:body1 = </W/b{i}>\n{follows}    }}")
    return (HEAD + f'def Xform "W"\n{{\n    def Cube "a" (prepend apiSchemas = [{BODY}])\n'
            "    {\n    }\n" + "\n".join(rows) + "\n}\n")


def long_lists(count):
    """One prim of each schema that is read, with long lists in all that it has."""
    targets = [f'    def Xform "t{i}" (prepend apiSchemas = ["MjcSiteAPI"])\n    {{\n    }}\n'
               for i in range(count)]
    prims = [growth_properties.prim_with(schema, schema.name, count)
             for schema in growth_properties.read_schemas()]
    return HEAD + 'def Xform "W"\n{\n' + "".join(targets + prims) + "}\n"


def prims_of_each_schema(count):
    """Many prims of each schema that is read, with one item in each list."""
    schemas = growth_properties.read_schemas()
    rows = "".join(f'    def Xform "x{i}"\n    {{\n'
                   f"        double3 xformOp:translate = ({9 * i}, 0, 0)\n"
                   '        uniform token[] xformOpOrder = ["xformOp:translate"]\n'
                   + "".join(growth_properties.prim_with(schema, schema.name, 1)
                             for schema in schemas) + "    }\n" for i in range(count))
    return HEAD + 'def Xform "W"\n{\n    def Cube "t0"\n    {\n    }\n' + rows + "}\n"


def composed(count):
    """Children, samples, variants, references to one prim and chains of internal references."""
    samples = ", ".join(f"{i}: {i % 7}" for i in range(count))
    variants = "".join(f'            "v{i}" {{\n                double a = {i}\n            }}\n'
                       for i in range(count + 1))
    referring = "".join(f'    def "r{i}" (references = </W/model>)\n    {{\n'
                        f"        over \"part\"\n        {{\n            double a = {i}\n"
                        "        }\n    }\n" for i in range(count))
    chain = "".join(f'    def "c{i}" (references = </W/c{i + 1}>)\n    {{\n    }}\n'
                    for i in range(min(count, 40)))
    return (HEAD + 'def Xform "W" (\n    variants = {\n        string set = "v0"\n    }\n'
            '    prepend variantSets = "set"\n)\n{\n'
            f"    double sampled.timeSamples = {{ {samples} }}\n"
            f'    variantSet "set" = {{\n{variants}    }}\n'
            '    def "model"\n    {\n        def "part"\n        {\n        }\n    }\n'
            f"{referring}{chain}    def \"c{min(count, 40)}\"\n    {{\n    }}\n}}\n")


def bodies_with_faults(count):
    """Bodies each of which has findings."""
    return HEAD + 'def Xform "W"\n{\n' + "\n".join(
        f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}, "PhysicsMassAPI"])\n    {{\n'
        "        float physics:mass = -1\n        rel r = </W/gone>\n    }"
        for i in range(count)) + "\n}\n"


def plain(count):
    """Attributes for `set` to write to."""
    values = "".join(f"    double v{i} = 0\n" for i in range(count))
    return HEAD + 'def Xform "W"\n{\n    double v = 0\n' + values + "}\n"


def assignments(count):
    return ("/W.v=1", *(f"/W.v{i}=1" for i in range(count)))


def chain(count):
    """Bodies in a row, each connected with the next one."""
    joints = [f'    def PhysicsRevoluteJoint "j{i}"\n    {{\n'
              f"        rel physics:body0 = </W/b{i}>\n"
              f"        rel physics:body1 = </W/b{i + 1}>\n        token physics:axis = \"Z\"\n"
              "        point3f physics:localPos0 = (3, 0, 0)\n    }\n" for i in range(count)]
    bodies = [f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}, "PhysicsMassAPI"])\n    {{\n'
              f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
              '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }\n'
              for i in range(count + 3)]
    return HEAD + 'def Xform "W"\n{\n' + "".join(bodies + joints) + "}\n"


def pairs_beside_neighbours(count):
    return [word for i in range(count + 1) for word in ("--filter", f"/W/b{i},/W/b{i + 2}")]


def masses(count):
    return [f"/W/b{i}.physics:mass=2" for i in range(count + 1)]


def with_one_more(make):
    """Where an empty scene is refused."""
    return lambda count: make(count + 1)


def bodies_of_one_name(count):
    return HEAD + 'def Xform "W"\n{\n' + "".join(
        f'    def Xform "x{i}"\n    {{\n        def Sphere "b" (prepend apiSchemas = [{BODY}])\n'
        "        {\n        }\n    }\n" for i in range(count)) + "}\n"


def bodies_far_below(count):
    """As many transforms above bodies as there are bodies."""
    head = "".join(f'def Xform "x{i}"\n{{\ndouble3 xformOp:translate = (1, 0, 0)\n'
                   'uniform token[] xformOpOrder = ["xformOp:translate"]\n' for i in range(count))
    bodies = "".join(f'def Sphere "b{i}" (prepend apiSchemas = [{BODY}])\n{{\n'
                     f"double3 xformOp:translate = ({3 * i}, 0, 0)\n"
                     'uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
                     for i in range(count))
    return HEAD + 'def Xform "W"\n{\n' + head + bodies + "}\n" * count + "}\n"


def one_edge(count):
    """A mesh whose triangles all share an edge."""
    points = ", ".join(f"(0, {i}, {i * i})" for i in range(count))
    corners = ", ".join(f"0, 1, {i + 2}" for i in range(count))
    return (HEAD + 'def Xform "W"\n{\n    def Mesh "m" (prepend apiSchemas = '
            '["PhysicsCollisionAPI"])\n    {\n'
            f"        point3f[] points = [(0, 0, 0), (1, 0, 0), {points or '(0, 1, 0)'}]\n"
            f"        int[] faceVertexCounts = [{', '.join(['3'] * count)}]\n"
            f"        int[] faceVertexIndices = [{corners}]\n    }}\n}}\n")


def bound_by_collections(count):
    """As many bodies as collections, each of which includes the next one and binds a material."""
    apis = ", ".join(['"MaterialBindingAPI"', *(f'"CollectionAPI:c{i}"' for i in range(count))])
    rows = "".join(f"    rel collection:c{i}:includes = [</W/m>, </W.collection:c{i + 1}>]\n"
                   f"    rel material:binding:collection:c{i} = [</W.collection:c{i}>, </W/m>]\n"
                   for i in range(count))
    bodies = "".join(f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n    }}\n'
                     for i in range(count))
    material = '    def Material "m" (prepend apiSchemas = ["PhysicsMaterialAPI"])\n    {\n    }\n'
    return (HEAD + f'def Xform "W" (prepend apiSchemas = [{apis}])\n{{\n{rows}{material}'
            f"{bodies}}}\n")


def driven_from_one_body(count):
    """Joints with a drive, all on one body."""
    places = "".join(f'    def Sphere "b{i}" (prepend apiSchemas = [{BODY}])\n    {{\n'
                     f"        double3 xformOp:translate = ({3 * i}, 0, 0)\n"
                     '        uniform token[] xformOpOrder = ["xformOp:translate"]\n    }\n'
                     for i in range(count + 1))
    joints = "".join(
        f'    def PhysicsRevoluteJoint "j{i}" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])\n'
        f"    {{\n        rel physics:body0 = </W/b0>\n        rel physics:body1 = </W/b{i}>\n"
        f"        point3f physics:localPos0 = ({3 * i}, 0, 0)\n"
        "        float drive:angular:physics:stiffness = 1\n    }\n"
        for i in range(1, count + 1))
    return HEAD + 'def Xform "W"\n{\n' + places + joints + "}\n"


def missing_packages(count):
    meshes = "".join(f'<visual><geometry><mesh filename="package://p{i}/m.stl"/></geometry>'
                     "</visual>\n" for i in range(count))
    return f'<robot name="r"><link name="b">\n{meshes}</link></robot>\n'


def motors(count):
    return ('<mujoco>\n<worldbody><body name="b"><joint name="j"/><geom size="1"/></body>'
            '</worldbody>\n<actuator>' + '<motor joint="j"/>\n' * count
            + "</actuator></mujoco>\n")


def meshes(count):
    """Meshes below one prim, which each get a prim of their own."""
    return HEAD + 'def Xform "W"\n{\n    def Xform "b"\n    {\n' + "\n".join(
        f'        def Mesh "m{i}"\n        {{\n            int[] faceVertexCounts = [3]\n'
        "            int[] faceVertexIndices = [0, 1, 2]\n"
        "            point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n        }"
        for i in range(count)) + "\n    }\n}\n"


class Kind:
    """`behind` are the words behind the scene's name, or a function that makes them of a size."""

    def __init__(self, name, make, size, verb, behind=(), most=2.3, file="scene.usda"):
        self.name, self.make, self.size, self.verb = name, make, size, verb
        self.behind, self.most, self.file = behind, most, file

    def words(self, count):
        return [self.verb, self.file,
                *(self.behind(count) if callable(self.behind) else self.behind)]


# MuJoCo's lists of a model take the square of its bodies, a small part of it; contacts of all pairs
# took 4 times. Pairs with the root and collections of collections meet kDisabledPairs and
# kCollisionGroupWork at twice the size.
KINDS = (
    Kind("missing targets", missing_targets, 600, "check"),
    Kind("wrong filtered pairs", wrong_pairs, 400, "check"),
    Kind("operations above bodies", ops_above_bodies, 200, "check"),
    Kind("pairs with the root", pairs_with_the_root, 1100, "physics"),
    Kind("pairs with the root, checked", pairs_with_the_root, 300, "check"),
    Kind("groups that merge", merged_groups, 400, "physics", (), 2.6),
    Kind("expressions of groups", expressions_of_groups, 100, "info", (), 4.2),
    Kind("mimics of mimics, as MJCF", mimics_of_mimics, 100, "convert", ("out.xml",), 3.2),
    Kind("bodies at one place, as MJCF", bodies_at_one_place, 150, "convert", ("out.xml",), 3.2),
    Kind("collections of collections", collections_of_collections, 450, "check"),
    Kind("long lists", long_lists, 200, "physics"),
    Kind("long lists, checked", long_lists, 200, "check"),
    Kind("long lists, as MJCF", long_lists, 200, "convert", ("out.xml",)),
    Kind("prims of each schema", prims_of_each_schema, 20, "physics"),
    Kind("prims of each schema, checked", prims_of_each_schema, 20, "check"),
    Kind("what is composed, flattened", composed, 150, "cat", ("--flatten", "-o", "out.usda")),
    Kind("findings", bodies_with_faults, 100, "check"),
    Kind("colliders in many groups", all_in_many_groups, 400, "check", (), 3.2),
    Kind("assignments of one edit", plain, 100, "set", assignments),
    Kind("masses of a chain", chain, 100, "set", masses),
    Kind("pairs with the root, as SRDF", with_one_more(pairs_with_the_root), 100, "convert",
         ("out.srdf",), 4.2),
    Kind("pairs with the root, in another name", pairs_with_the_root, 100, "rename",
         ("/W", "V", "--dry-run"), 4.2),
    Kind("bodies of one name, as URDF", with_one_more(bodies_of_one_name), 300, "convert",
         ("out.urdf",)),
    Kind("bodies far below, baked", with_one_more(bodies_far_below), 60, "bake",
         ("--duration", "0.004", "-o", "out.usda"), 3.2),
    Kind("triangles at one edge, on a page", one_edge, 10000, "report",
         ("--duration", "0", "-o", "out.html")),
    # Collections times bodies, and drives times the bodies that each moves.
    Kind("bindings of collections", bound_by_collections, 60, "physics", (), 4.6),
    Kind("drives on one body", driven_from_one_body, 150, "sim",
         ("--engine", "jolt", "--duration", "0.004"), 3.3),
    Kind("packages that are missing", missing_packages, 200, "convert", ("out.usda",),
         file="scene.urdf"),
    Kind("actuators, in a folder", motors, 300, "convert", ("folder",), file="scene.xml"),
    Kind("meshes of one prim, in a folder", meshes, 1500, "structure", ("-o", "folder")),
    Kind("filtered pairs of a chain", chain, 100, "pairs", pairs_beside_neighbours),
)
COLLECTED = re.compile(r"I +refs: +([\d,]+)")


def instructions(program, folder, words):
    for old in pathlib.Path(folder).glob("out.*"):
        old.unlink()
    tool = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    if shutil.which("setarch"):
        tool = ["setarch", "-R", *tool]
    done = subprocess.run([*tool, program, *words], cwd=folder, capture_output=True, text=True,
                          check=False)
    found = COLLECTED.search(done.stderr)
    if done.returncode not in (0, 1) or not found:
        sys.exit(f"{' '.join(words[:4])}: exit {done.returncode}\n{done.stderr[-1500:]}")
    return int(found[1].replace(",", ""))


def without_symbols(program, folder):
    """The program beside links to what it finds from its own place; valgrind reads all symbols of
    what it starts, which takes longer than a small run."""
    if not shutil.which("strip"):
        return program
    own = pathlib.Path(folder, "bin", "tenon")
    own.parent.mkdir()
    subprocess.run(["strip", "-o", own, program], check=True)
    for beside in pathlib.Path(program).parent.parent.iterdir():
        if beside.name != "bin":
            pathlib.Path(folder, beside.name).symlink_to(beside)
    return str(own)


class Counter:
    """Instructions of a kind at a size; those of an empty scene are counted once for a command."""

    def __init__(self, program):
        self.program, self.empty = program, {}

    def at(self, kind, count):
        words = kind.words(count)
        key = tuple(words)
        if count == 0 and key in self.empty:
            return self.empty[key]
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, kind.file).write_text(kind.make(count), encoding="utf-8")
            found = instructions(self.program, folder, words)
        if count == 0:
            self.empty[key] = found
        return found


def main():
    program = os.path.abspath(sys.argv[1])
    faults = growth_properties.faults(growth_properties.read_schemas())
    for fault in faults:
        print(fault)
    if faults:
        return 1
    if not shutil.which("valgrind") or not os.path.exists(program):
        print("skipped: no valgrind, or no " + program)
        return 77
    with tempfile.TemporaryDirectory() as folder:
        return 1 if too_much(Counter(without_symbols(program, folder)), sys.argv[2:]) else 0


def too_much(counter, names):
    """Whether some kind grows too much, of those whose names begin so."""
    faults = []
    for kind in KINDS:
        if names and not kind.name.startswith(tuple(names)):
            continue
        none, once, twice = [counter.at(kind, count) for count in (0, kind.size, 2 * kind.size)]
        ratio = (twice - none) / (once - none)
        faults.append(ratio > kind.most)
        print(f"{kind.name}: {kind.size:,} {(once - none) / 1e6:.1f} M, twice as many "
              f"{ratio:.2f} times" + ("  TOO MUCH" if ratio > kind.most else ""), flush=True)
    return any(faults)


if __name__ == "__main__":
    sys.exit(main())
