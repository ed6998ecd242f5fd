# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""What can be long in an asset, from the generated tables of schemas: every relationship and every
array of the schemas that are read, and what growth.py makes long or many of it.

A property of the tables that LISTS lacks is a fault of the test, and so is a row of LISTS that the
tables do not have.
"""

import fnmatch
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
GENERATED = ROOT / "tenon/schema/generated"
READ_BY_PHYSICS = ROOT / "tenon/physics/vendors/vendor_attributes.def"
# Of USD's own schemas those of physics, and the ones that shapes and transforms come from.
CORE = re.compile(r"(Physics\w*|CollectionAPI|Mesh|BasisCurves|PointInstancer)")
# Vendors' properties that vendor_attributes.def does not call read, but other verbs follow.
READ_ELSEWHERE = ("isaac:physics:*", "isaac:robot:*", "isaac:actuator", "isaac:changelog")

PROPERTY = re.compile(r'^    \{"([^"]*)", "([^"]*)", ([^,]*), ', re.M)
SCHEMA = re.compile(r'^    \{"([^"]*)", SchemaKind::(\w+), "([^"]*)", "([^"]*)", "([^"]*)", '
                    r"(\d+), (\d+)\}", re.M)


class Schema:
    def __init__(self, name, kind, applies_to, lists):
        self.name, self.kind, self.applies_to, self.lists = name, kind, applies_to, lists


def block(text, name):
    return text.split(name + "[] = {", 1)[1].split("\n};", 1)[0]


def schemas_of(text, is_read):
    """Schemas of a generated table, with the relationships and arrays that `is_read` takes."""
    properties = PROPERTY.findall(block(text, "Properties"))
    indices = [int(number) for number in re.findall(r"\d+", block(text, "PropertyIndices"))]
    for name, kind, _, _, applies_to, first, count in SCHEMA.findall(block(text, "Schemas")):
        lists = {}
        for index in indices[int(first):int(first) + int(count)]:
            own, kind_of_value, flags = properties[index]
            is_list = "kRelationship" in flags or kind_of_value.endswith("[]")
            if is_list and is_read(name, own):
                lists[own] = kind_of_value
        if lists:
            yield Schema(name, kind, applies_to.split(), lists)


def read_schemas(core=None, vendor=None):
    """Those whose lists are read; the texts of the tables may be given instead of the files'."""
    core = core or (GENERATED / "core_schemas.cpp").read_text(encoding="utf-8")
    vendor = vendor or (GENERATED / "vendor_schemas.cpp").read_text(encoding="utf-8")
    rules = re.findall(r'^TENON_READ\("([^"]*)"', READ_BY_PHYSICS.read_text(encoding="utf-8"), re.M)
    patterns = (*rules, *READ_ELSEWHERE)
    found = list(schemas_of(core, lambda schema, _: CORE.fullmatch(schema)))
    found += schemas_of(vendor, lambda _, name: any(fnmatch.fnmatchcase(name, pattern)
                                                    for pattern in patterns))
    return found


def same(i):
    return "1"


def counting(i):
    return str(i)


def first(i):
    return "0"


def target(i):
    return f"</W/t{i}>"


# Property, how its items are written where there are many of them; None: by its type. A text: why
# it is not long in a scene of its own.
LISTS = {
    "accelerations": None,
    "angularVelocities": None,
    "collection:__INSTANCE_NAME__:excludes": target,
    "collection:__INSTANCE_NAME__:includes": target,
    "collection:colliders:excludes": target,
    "collection:colliders:includes": target,
    "cornerIndices": counting,
    "cornerSharpnesses": None,
    "creaseIndices": counting,
    "creaseLengths": lambda i: "2",
    "creaseSharpnesses": None,
    "curveVertexCounts": lambda i: "4",
    "extent": "two values by definition; check says so of others, as of any array",
    "faceVertexCounts": lambda i: "3",
    "faceVertexIndices": "three for each of faceVertexCounts, which growth.py adds",
    "holeIndices": counting,
    "ids": counting,
    "invisibleIds": counting,
    "isaac:actuator": None,
    "isaac:changelog": lambda i: f'"change {i}"',
    "isaac:physics:DofOffsetOpOrder": "operations that isaac-3.0 has for a joint: six names",
    "isaac:physics:robotJoints": target,
    "isaac:physics:robotLinks": target,
    "isaac:robot:namedPoses": target,
    "isaac:robot:pose:endLink": target,
    "isaac:robot:pose:jointFixed": None,
    "isaac:robot:pose:joints": target,
    "isaac:robot:pose:jointValues": None,
    "isaac:robot:pose:startLink": target,
    "mjc:biasPrm": None,
    "mjc:dynPrm": None,
    "mjc:gainPrm": None,
    "mjc:gear": None,
    "mjc:option:actuatorgroupdisable": first,
    "mjc:option:o_friction": None,
    "mjc:option:o_solimp": None,
    "mjc:option:o_solref": None,
    "mjc:path": target,
    "mjc:path:coef": None,
    "mjc:path:divisors": None,
    "mjc:path:indices": counting,
    "mjc:path:segments": first,
    "mjc:refSite": target,
    "mjc:sideSites": target,
    "mjc:sideSites:indices": lambda i: "-1",
    "mjc:sliderSite": target,
    "mjc:solimp": None,
    "mjc:solimpfriction": None,
    "mjc:solimplimit": None,
    "mjc:solref": None,
    "mjc:solreffriction": None,
    "mjc:solreflimit": None,
    "mjc:springlength": None,
    "mjc:target": target,
    "newton:inertia": None,
    "newton:mimicJoint": target,
    "normals": None,
    "orientations": None,
    "orientationsf": None,
    "physics:body0": target,
    "physics:body1": target,
    "physics:filteredGroups": target,
    "physics:filteredPairs": target,
    "physics:hinge": target,
    "physics:hinge0": target,
    "physics:hinge1": target,
    "physics:prismatic": target,
    "physics:simulationOwner": target,
    "physxMimicJoint:__INSTANCE_NAME__:referenceJoint": target,
    "physxTendon:__INSTANCE_NAME__:forceCoefficient": None,
    "physxTendon:__INSTANCE_NAME__:gearing": None,
    "physxTendon:__INSTANCE_NAME__:parentLink": target,
    "points": lambda i: f"({i % 97}, {i % 89}, {i * i % 83})",
    "positions": None,
    "primvars:displayColor": None,
    "primvars:displayOpacity": None,
    "protoIndices": first,
    "prototypes": target,
    "proxyPrim": target,
    "rayDirections": None,
    "rayOrigins": None,
    "scales": None,
    "velocities": None,
    "widths": None,
    "xformOpOrder": "names operations of its prim: 'operations above bodies'",
}

COMPONENTS = {"2": 2, "3": 3, "4": 4}
OF_TYPE = re.compile(r"(?:float|double|half|int|point|vector|normal|color|quat)([234]?)[fdh]?\[\]")


def item(kind_of_value, i):
    """A value of an array of that type."""
    if kind_of_value.startswith("quat"):
        return "(1, 0, 0, 0)"
    size = COMPONENTS.get(OF_TYPE.fullmatch(kind_of_value)[1] if
                          OF_TYPE.fullmatch(kind_of_value) else "", 1)
    return "1" if size == 1 else "(" + ", ".join(str((i + k) % 7 + 1) for k in range(size)) + ")"


def faults(schemas):
    """What the tables have and LISTS lacks, and the other way round."""
    named = {name for schema in schemas for name in schema.lists}
    return ([f"{name}: no row in LISTS of growth_properties.py"
             for name in sorted(named - set(LISTS))]
            + [f"{name}: a row of LISTS that no schema has" for name in sorted(set(LISTS) - named)])


def statement(name, kind_of_value, count):
    """The property with `count` items, as text; nothing for one that LISTS has a reason for."""
    row = LISTS[name]
    if isinstance(row, str):
        return ""
    own = name.replace("__INSTANCE_NAME__", "rotX")
    items = ", ".join(row(i) if row else item(kind_of_value, i) for i in range(count))
    if not kind_of_value:
        return f"        rel {own} = [{items}]\n"
    more = ""
    if name == "faceVertexCounts":
        corners = ", ".join(str((7 * i + k) % count) for i in range(count) for k in (0, 1, 3))
        more = f"        int[] faceVertexIndices = [{corners}]\n"
    return f"        {kind_of_value} {own} = [{items}]\n" + more


# A prim that carries an API, where the schema does not name it.
CARRIERS = {"MjcJointAPI": "PhysicsRevoluteJoint", "MjcEqualityJointAPI": "PhysicsRevoluteJoint",
            "MjcEqualityAPI": "PhysicsFixedJoint", "MjcSceneAPI": "PhysicsScene",
            "PhysxMimicJointAPI": "PhysicsRevoluteJoint", "NewtonMimicAPI": "PhysicsRevoluteJoint",
            "PhysxTendonAxisAPI": "PhysicsRevoluteJoint", "IsaacJointAPI": "PhysicsRevoluteJoint"}


def prim_with(schema, name, count):
    """A prim of the schema, each of whose lists has `count` items; nothing for abstract ones."""
    if schema.kind.startswith("Abstract") or schema.kind == "NonAppliedApi":
        return ""
    own, applied = schema.name, []
    if schema.kind.endswith("ApplyApi"):
        own = CARRIERS.get(schema.name, "Cube")
        applied = [schema.name + (":rotX" if schema.kind == "MultipleApplyApi" else "")]
    if own in ("Cube", "Mesh"):
        applied += ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI"]
    listed = ", ".join(f'"{one}"' for one in dict.fromkeys(applied))
    head = f' (prepend apiSchemas = [{listed}])' if applied else ""
    lists = "".join(statement(*row, count) for row in schema.lists.items())
    return f'    def {own} "{name}"{head}\n    {{\n{lists}    }}\n'
