# SPDX-FileCopyrightText: tenon authors
# SPDX-License-Identifier: Apache-2.0
"""Random UsdPhysics scenes as data that can be written as text and taken apart piece by piece:
nested transforms and scales, bodies, colliders, masses, densities, materials, joints with limits
and drives, articulations, collision groups and filtered pairs. One seed, one scene."""

import copy
import random

BODY, COLLISION, MASS = "PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"
SHAPES = ("Cube", "Sphere", "Capsule", "Cylinder", "Cone")
APPROXIMATIONS = ("none", "convexHull", "boundingCube", "boundingSphere", "convexDecomposition",
                  "meshSimplification")
MISSING = "/W/Missing"  # named here and there, never defined
DOFS = ("transX", "transY", "transZ", "rotX", "rotY", "rotZ")


def number(x):
    return repr(float(f"{x:.6g}"))


def vector(values):
    return "(" + ", ".join(number(x) for x in values) + ")"


def token(text):
    return f'"{text}"'


class Prim:
    """A prim: its lines are its attributes by name, its relationships, its APIs."""

    def __init__(self, kind):
        self.kind = kind
        self.apis = []
        self.attributes = {}  # name -> (type, text)
        self.targets = {}  # relationship -> paths

    def set(self, kind, name, text):
        self.attributes[name] = (kind, text)

    def lines(self):
        for name, (kind, text) in self.attributes.items():
            yield f"{kind} {name} = {text}"
        for name, paths in self.targets.items():
            yield f"rel {name} = [" + ", ".join(f"<{path}>" for path in paths) + "]"


class Scene:
    """Prims by path, parents before children, and the stage's metadata."""

    def __init__(self):
        self.metadata = {}
        self.prims = {}

    def add(self, path, kind):
        self.prims[path] = Prim(kind)
        return self.prims[path]

    def text(self):
        head = "".join(f"    {key} = {value}\n" for key, value in self.metadata.items())
        out = [f"#usda 1.0\n(\n{head})\n"]
        open_paths = []
        for path, prim in self.prims.items():
            while open_paths and not path.startswith(open_paths[-1] + "/"):
                open_paths.pop()
                out.append("    " * len(open_paths) + "}\n")
            indent = "    " * len(open_paths)
            kind = f"{prim.kind} " if prim.kind else ""
            apis = ", ".join(token(api) for api in prim.apis)
            meta = f" (\n{indent}    prepend apiSchemas = [{apis}]\n{indent})" if apis else ""
            out.append(f'\n{indent}def {kind}"{path.rsplit("/", 1)[1]}"{meta}\n{indent}{{\n')
            out.extend(f"{indent}    {line}\n" for line in prim.lines())
            open_paths.append(path)
        while open_paths:
            open_paths.pop()
            out.append("    " * len(open_paths) + "}\n")
        return "".join(out)

    def smaller(self):
        """Scenes with one piece less: a subtree, an API, an attribute, a relationship, a target."""
        for path in list(self.prims)[::-1]:
            yield self.without(path)
        for path, prim in self.prims.items():
            for api in prim.apis:
                yield self.changed(path, lambda p, a=api: p.apis.remove(a))
            for name in prim.attributes:
                yield self.changed(path, lambda p, n=name: drop_attribute(p, n))
            for name, paths in prim.targets.items():
                yield self.changed(path, lambda p, n=name: p.targets.pop(n))
                for target in paths if len(paths) > 1 else []:
                    yield self.changed(path, lambda p, n=name, t=target: p.targets[n].remove(t))
        for key in self.metadata:
            result = copy.deepcopy(self)
            del result.metadata[key]
            yield result

    def changed(self, path, change):
        result = copy.deepcopy(self)
        change(result.prims[path])
        return result

    def without(self, root):
        def is_below(path):
            return path == root or path.startswith(root + "/")

        result = copy.deepcopy(self)
        result.prims = {path: p for path, p in result.prims.items() if not is_below(path)}
        for prim in result.prims.values():
            prim.targets = {name: [t for t in paths if not is_below(t)]
                            for name, paths in prim.targets.items()}
            prim.targets = {name: paths for name, paths in prim.targets.items() if paths}
        return result


def drop_attribute(prim, name):
    """A transform op goes with its place in the order."""
    del prim.attributes[name]
    order = prim.attributes.get("xformOpOrder")
    if order and token(name) in order[1]:
        names = [item for item in order[1].strip("[]").split(", ") if item != token(name)]
        prim.attributes["xformOpOrder"] = (order[0], "[" + ", ".join(names) + "]")


class Maker:
    """Fills a scene from one random stream."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.scene = Scene()
        self.bodies, self.colliders, self.groups, self.materials = [], [], [], []

    def chance(self, p):
        return self.random.random() < p

    def span(self, low, high):
        return self.random.uniform(low, high)

    def name(self, parent, letter):
        return f"{parent}/{letter}{len(self.scene.prims)}"

    def make(self):
        pick = self.random.choice
        self.scene.metadata = {"metersPerUnit": pick(["1", "0.01", "0.0254", "2.5"]),
                               "kilogramsPerUnit": pick(["1", "0.001", "0.45"]),
                               "upAxis": token(pick("YZ"))}
        self.scene.add("/W", "Xform")
        self.physics_scene("/W/S")
        for _ in range(self.random.randint(0, 3)):
            self.material()
        parents = ["/W"]
        for _ in range(self.random.randint(0, 3)):
            parents.append(self.xform(pick(parents)))
        for _ in range(self.random.randint(1, 6)):
            self.body(pick(parents + self.bodies[:1] * (2 if self.chance(0.2) else 0)))
        for _ in range(self.random.randint(0, 3)):
            self.collider(pick(parents))
        self.groups_and_pairs()
        for _ in range(self.random.randint(0, 4)):
            self.joint()
        self.articulation(parents)
        if self.chance(0.4):
            self.owners()
        self.put_in_order()
        return self.scene

    def articulation(self, parents):
        if self.chance(0.4):
            path = self.random.choice(parents + self.bodies)
            self.scene.prims[path].apis.append("PhysicsArticulationRootAPI")

    def owners(self):
        """A second scene, and owners: one for bodies that joints connect, any for colliders, whose
        own owner counts where no body is above them."""
        scenes = ("/W/S", "/W/T")
        self.physics_scene(scenes[1])
        island = {path: {path} for path in self.bodies}
        for prim in self.scene.prims.values():
            sides = [path for name in ("physics:body0", "physics:body1")
                     for path in prim.targets.get(name, []) if path in island]
            union = set().union(*(island[path] for path in sides))
            island.update((path, union) for path in union)
        for path in self.bodies:
            if path == min(island[path]) and self.chance(0.7):
                owner = self.random.choice(scenes)
                for link in sorted(island[path]):
                    self.scene.prims[link].targets["physics:simulationOwner"] = [owner]
        for path in self.colliders:
            if path not in self.bodies and self.chance(0.3):
                self.scene.prims[path].targets["physics:simulationOwner"] = \
                    [self.random.choice(scenes)]

    def put_in_order(self):
        """Parents before children and each subtree in one piece."""
        order = {path: tuple(list(self.scene.prims).index(path[:i]) for i in
                             [k for k in range(2, len(path)) if path[k] == "/"] + [len(path)])
                 for path in self.scene.prims}
        self.scene.prims = {path: self.scene.prims[path]
                            for path in sorted(self.scene.prims, key=order.get)}

    def physics_scene(self, path):
        prim = self.scene.add(path, "PhysicsScene")
        if self.chance(0.4):
            prim.set("float", "physics:gravityMagnitude", number(self.span(-20, 20)))
        if self.chance(0.4):
            prim.set("vector3f", "physics:gravityDirection",
                     vector([self.span(-2, 2) for _ in range(3)]))

    def place(self, prim, uniform=True):
        """A stack of transform ops; a scale that is not uniform only where nothing turns below."""
        names = []

        def op(kind, name, text):
            prim.set(kind, f"xformOp:{name}", text)
            names.append(token(f"xformOp:{name}"))

        if self.chance(0.05):
            names.append(token("!resetXformStack!"))
        op("double3", "translate", vector([self.span(-5, 5) for _ in range(3)]))
        if self.chance(0.5):
            op("float3", "rotateXYZ", vector([self.span(-180, 180) for _ in range(3)]))
        elif self.chance(0.3):
            op("quatf", "orient", vector([self.span(-1, 1) for _ in range(4)]))
        if self.chance(0.5):
            factor = self.span(0.3, 3)
            values = [factor] * 3 if uniform else [self.span(0.3, 3) for _ in range(3)]
            if self.chance(0.05):
                values[self.random.randrange(3)] *= -1  # a mirror
            op("float3", "scale", vector(values))
        prim.set("uniform token[]", "xformOpOrder", "[" + ", ".join(names) + "]")

    def xform(self, parent):
        path = self.name(parent, "X")
        self.place(self.scene.add(path, "Xform"), uniform=not self.chance(0.1))
        return path

    def material(self):
        path = self.name("/W", "M")
        prim = self.scene.add(path, "Material")
        prim.apis.append("PhysicsMaterialAPI")
        friction = self.span(0, 1)
        prim.set("float", "physics:staticFriction", number(friction))
        prim.set("float", "physics:dynamicFriction", number(friction * self.span(0, 1)))
        prim.set("float", "physics:restitution", number(self.span(0, 1)))
        if self.chance(0.5):
            prim.set("float", "physics:density", number(self.span(0, 3000)))
        self.materials.append(path)

    def weigh(self, prim, chance):
        if not self.chance(chance):
            return
        prim.apis.append(MASS)
        if self.chance(0.5):
            prim.set("float", "physics:mass", number(self.span(0, 30)))
        if self.chance(0.4):
            prim.set("float", "physics:density", number(self.span(0, 5000)))
        if self.chance(0.3):
            prim.set("point3f", "physics:centerOfMass", vector([self.span(-1, 1) for _ in "xyz"]))
        if self.chance(0.3):
            a, b = self.span(1, 5), self.span(1, 5)
            moments = [a, b, self.span(abs(a - b) + 0.1, a + b)]
            prim.set("float3", "physics:diagonalInertia", vector(moments))
            if self.chance(0.5):
                prim.set("quatf", "physics:principalAxes",
                         vector(self.unit_quaternion()))

    def unit_quaternion(self):
        values = [self.span(-1, 1) for _ in range(4)]
        length = sum(x * x for x in values) ** 0.5 or 1
        return [x / length for x in values]

    def shape(self, prim):
        prim.apis.append(COLLISION)
        if prim.kind == "Mesh":
            self.mesh(prim)
        elif prim.kind == "Cube":
            prim.set("double", "size", number(self.span(0.2, 3)))
        else:
            prim.set("double", "radius", number(self.span(0.1, 2)))
        if prim.kind in ("Capsule", "Cylinder", "Cone"):
            prim.set("double", "height", number(self.span(0.2, 3)))
            prim.set("uniform token", "axis", token(self.random.choice("XYZ")))
        if self.chance(0.1):
            prim.set("bool", "physics:collisionEnabled", "0")
        if self.materials and self.chance(0.5):
            prim.apis.append("MaterialBindingAPI")
            name = "material:binding:physics" if self.chance(0.6) else "material:binding"
            prim.targets[name] = [self.random.choice(self.materials)]

    def mesh(self, prim):
        """A tetrahedron, or a box whose quads are fans of triangles for nobody."""
        size = self.span(0.2, 2)
        if self.chance(0.5):
            points = [(0, 0, 0), (size, 0, 0), (0, size, 0), (0, 0, size)]
            faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
        else:
            points = [(x, y, z) for x in (-size, size) for y in (-size, size)
                      for z in (-size, size)]
            faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4),
                     (1, 5, 7, 3)]
        prim.set("point3f[]", "points", "[" + ", ".join(map(vector, points)) + "]")
        prim.set("int[]", "faceVertexCounts", str([len(face) for face in faces]))
        prim.set("int[]", "faceVertexIndices", str([i for face in faces for i in face]))
        prim.set("uniform token", "subdivisionScheme", token("none"))
        if self.chance(0.7):
            prim.apis.append("PhysicsMeshCollisionAPI")
            prim.set("uniform token", "physics:approximation",
                     token(self.random.choice(APPROXIMATIONS)))

    def body(self, parent):
        kind = self.random.choice(("Xform",) + SHAPES)
        path = self.name(parent, "B")
        prim = self.scene.add(path, kind)
        prim.apis.append(BODY)
        self.place(prim, uniform=kind == "Xform" and not self.chance(0.1))
        self.bodies.append(path)
        if kind != "Xform":
            self.shape(prim)
            self.colliders.append(path)
        self.weigh(prim, 0.6)
        for name, p in (("rigidBodyEnabled", 0.9), ("kinematicEnabled", 0.1),
                        ("startsAsleep", 0.1)):
            if self.chance(0.2):
                qualifier = "uniform bool" if name == "startsAsleep" else "bool"
                prim.set(qualifier, f"physics:{name}", "1" if self.chance(p) else "0")
        for name in ("velocity", "angularVelocity"):
            if self.chance(0.3):
                prim.set("vector3f", f"physics:{name}",
                         vector([self.span(-50, 50) for _ in range(3)]))
        for _ in range(self.random.randint(0, 3)):
            self.collider(path)

    def collider(self, parent):
        path = self.name(parent, "C")
        prim = self.scene.add(path, self.random.choice(SHAPES + ("Mesh",)))
        self.place(prim, uniform=self.chance(0.5))
        self.shape(prim)
        self.weigh(prim, 0.4)
        self.colliders.append(path)

    def groups_and_pairs(self):
        for _ in range(self.random.randint(0, 3) if self.colliders else 0):
            path = self.name("/W", "G")
            prim = self.scene.add(path, "PhysicsCollisionGroup")
            prim.apis.append("CollectionAPI:colliders")
            members = self.random.sample(self.colliders + self.bodies, k=1 + int(self.chance(0.5)))
            prim.targets["collection:colliders:includes"] = list(dict.fromkeys(members))
            self.groups.append(path)
        for path in self.groups:
            prim = self.scene.prims[path]
            if self.chance(0.7):
                prim.targets["physics:filteredGroups"] = [self.random.choice(self.groups)]
            # OpenUSD forgets what merged groups but the first invert (S-80).
            if self.chance(0.3):
                prim.set("string", "physics:mergeGroup", token("m"))
                prim.set("bool", "physics:invertFilteredGroups", "0")
            else:
                prim.set("bool", "physics:invertFilteredGroups", "1" if self.chance(0.3) else "0")
        named = self.bodies + self.colliders
        for path in self.random.sample(named, k=min(len(named), self.random.randint(0, 2))):
            prim = self.scene.prims[path]
            prim.apis.append("PhysicsFilteredPairsAPI")
            prim.targets["physics:filteredPairs"] = [
                self.random.choice([p for p in named if p != path] or [path])]
            if self.chance(0.2):
                prim.targets["physics:filteredPairs"].append(MISSING)

    def joint(self):
        kinds = ("Revolute", "Prismatic", "Spherical", "Fixed", "Distance", "")
        kind = self.random.choice(kinds)
        sides = self.random.sample(self.bodies, k=min(2, len(self.bodies)))
        path = self.name("/W", "J")
        prim = self.scene.add(path, f"Physics{kind}Joint")
        if self.chance(0.3):
            sides = sides[:1]
        elif len(sides) == 2 and self.chance(0.1):
            sides[self.random.randrange(2)] = MISSING
        for side, body in zip(self.random.sample((0, 1), k=len(sides)), sides):
            prim.targets[f"physics:body{side}"] = [body]
        for side in (0, 1):
            if self.chance(0.7):
                prim.set("point3f", f"physics:localPos{side}",
                         vector([self.span(-2, 2) for _ in range(3)]))
            if self.chance(0.5):
                prim.set("quatf", f"physics:localRot{side}", vector(self.unit_quaternion()))
        for name, p in (("jointEnabled", 0.9), ("collisionEnabled", 0.5)):
            if self.chance(0.3):
                prim.set("bool", f"physics:{name}", "1" if self.chance(p) else "0")
        for name in ("breakForce", "breakTorque"):
            if self.chance(0.2):
                prim.set("float", f"physics:{name}", number(self.span(0, 1000)))
        self.joint_details(prim, kind)

    def joint_details(self, prim, kind):
        def maybe(name, low, high, chance=0.6, qualifier="float"):
            if self.chance(chance):
                prim.set(qualifier, name, number(self.span(low, high)))

        if kind in ("Revolute", "Prismatic", "Spherical"):
            prim.set("uniform token", "physics:axis", token(self.random.choice("XYZ")))
        if kind in ("Revolute", "Prismatic"):
            maybe("physics:lowerLimit", -90, 20)
            maybe("physics:upperLimit", -20, 90)
            self.drive(prim, "angular" if kind == "Revolute" else "linear", maybe)
        elif kind == "Spherical":
            maybe("physics:coneAngle0Limit", -10, 90)
            maybe("physics:coneAngle1Limit", -10, 90)
        elif kind == "Distance":
            maybe("physics:minDistance", -1, 3)
            maybe("physics:maxDistance", 3, 9)
        elif kind == "":
            for dof in self.random.sample(DOFS, k=self.random.randint(0, 4)):
                prim.apis.append(f"PhysicsLimitAPI:{dof}")
                maybe(f"limit:{dof}:physics:low", -90, 20)
                maybe(f"limit:{dof}:physics:high", -20, 90)
            self.drive(prim, self.random.choice(DOFS), maybe)

    def drive(self, prim, instance, maybe):
        if not self.chance(0.5):
            return
        prim.apis.append(f"PhysicsDriveAPI:{instance}")
        prefix = f"drive:{instance}:physics:"
        if self.chance(0.3):
            prim.set("uniform token", prefix + "type", token("acceleration"))
        maybe(prefix + "stiffness", 0, 1000)
        maybe(prefix + "damping", 0, 100)
        maybe(prefix + "targetPosition", -90, 90)
        maybe(prefix + "targetVelocity", -90, 90)
        maybe(prefix + "maxForce", 0, 500, 0.4)


def make_scene(seed):
    return Maker(seed).make()
