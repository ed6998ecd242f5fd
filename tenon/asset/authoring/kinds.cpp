// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rows are in the order in which a scene is made: prims, what lights and shows them, physics,
// joints, and what is put on prims that are there. An option is described once; which property it
// sets is the affair of each kind.
#include "tenon/asset/authoring/kinds.h"

#include <algorithm>

#include "tenon/base/token.h"
#include "tenon/schema/registry.h"

namespace tenon {
namespace {

using Options = std::vector<KindOption>;

constexpr std::string_view kPose[] = {"at", "rotate", "scale"};

std::vector<AuthoringKind> shape_kinds() {
  const KindOption radius{"radius", "radius"};
  const KindOption height{"height", "height"};
  const KindOption axis{"axis", "axis"};
  const KindOption width{"width", "width"};
  const KindOption length{"length", "length"};
  return {
      {.name = "xform", .about = "a prim with a place, for others below it", .type = "Xform"},
      {.name = "scope", .about = "a prim without a place, for others below it", .type = "Scope"},
      {.name = "cube", .about = "a box", .type = "Cube", .options = {{"size", "size"}}},
      {.name = "sphere", .about = "a ball", .type = "Sphere", .options = {radius}},
      {.name = "cylinder",
       .about = "a cylinder",
       .type = "Cylinder",
       .options = {radius, height, axis}},
      {.name = "capsule",
       .about = "a cylinder with round ends",
       .type = "Capsule",
       .options = {radius, height, axis}},
      {.name = "cone", .about = "a cone", .type = "Cone", .options = {radius, height, axis}},
      {.name = "plane",
       .about = "a flat rectangle, to physics without an end",
       .type = "Plane",
       .options = {width, length, axis}},
      {.name = "mesh",
       .about = "the shape in a mesh file: .stl, .obj, .ply, .dae, .gltf or .glb",
       .type = "Mesh",
       .options = {{"file", ""}, {"file-meters", ""}, {"file-up", ""}},
       .needs = {"file"}},
      {.name = "ground",
       .about = "a ground plane across the up axis: a collider",
       .type = "Plane",
       .apis = {"PhysicsCollisionAPI"},
       .options = {width, length}},
      {.name = "reference",
       .about = "a prim with what another file has",
       .type = "Xform",
       .options = {{"file", ""}, {"prim", ""}},
       .rests = true,
       .needs = {"file"}},
      {.name = "payload",
       .about = "the same, loaded on demand",
       .type = "Xform",
       .options = {{"file", ""}, {"prim", ""}},
       .rests = true,
       .needs = {"file"}},
  };
}

std::vector<AuthoringKind> look_kinds() {
  const KindOption intensity{"intensity", "inputs:intensity"};
  const KindOption color{"color", "inputs:color"};
  const KindOption radius{"radius", "inputs:radius"};
  const KindOption width{"width", "inputs:width"};
  const KindOption height{"height", "inputs:height"};
  return {
      {.name = "distant-light",
       .about = "light from far away, like the sun",
       .type = "DistantLight",
       .options = {intensity, color, {"angle", "inputs:angle"}}},
      {.name = "dome-light",
       .about = "light from all around",
       .type = "DomeLight",
       .options = {intensity, color, {"texture", "inputs:texture:file"}}},
      {.name = "sphere-light",
       .about = "a shining ball",
       .type = "SphereLight",
       .options = {intensity, color, radius}},
      {.name = "disk-light",
       .about = "a shining disk",
       .type = "DiskLight",
       .options = {intensity, color, radius}},
      {.name = "rect-light",
       .about = "a shining rectangle",
       .type = "RectLight",
       .options = {intensity, color, width, height}},
      {.name = "camera",
       .about = "a camera, which looks along its -Z",
       .type = "Camera",
       .options = {{"focal-length", "focalLength"}}},
  };
}

std::vector<AuthoringKind> physics_prim_kinds() {
  return {
      {.name = "scene",
       .about = "gravity, for the bodies of the asset",
       .type = "PhysicsScene",
       .options = {{"gravity-direction", "physics:gravityDirection"},
                   {"gravity-magnitude", "physics:gravityMagnitude"}},
       .rests = true},
      {.name = "material",
       .about = "a material with friction and restitution; a binding brings it to colliders",
       .type = "Material",
       .apis = {"PhysicsMaterialAPI"},
       .options = {{"static-friction", "physics:staticFriction"},
                   {"dynamic-friction", "physics:dynamicFriction"},
                   {"restitution", "physics:restitution"},
                   {"density", "physics:density"}},
       .rests = true},
      {.name = "physics-material",
       .about = "friction and restitution of a material that is there",
       .apis = {"PhysicsMaterialAPI"},
       .options = {{"static-friction", "physics:staticFriction"},
                   {"dynamic-friction", "physics:dynamicFriction"},
                   {"restitution", "physics:restitution"},
                   {"density", "physics:density"}},
       .on = "Material",
       .rests = true},
      {.name = "collision-group",
       .about = "colliders that do not touch those of other groups, or their own",
       .type = "PhysicsCollisionGroup",
       .options = {{"members", "collection:colliders:includes"},
                   {"filtered", "physics:filteredGroups"}},
       .rests = true},
  };
}

AuthoringKind joint_kind(std::string_view name, std::string_view about, std::string_view type,
                         const Options& more) {
  AuthoringKind kind{.name = name, .about = about, .type = type};
  kind.options = {{"body0", "physics:body0"},
                  {"body1", "physics:body1"},
                  {"at", ""},
                  {"break-force", "physics:breakForce"},
                  {"break-torque", "physics:breakTorque"},
                  {"collide", "physics:collisionEnabled"}};
  kind.options.insert(kind.options.end(), more.begin(), more.end());
  return kind;
}

std::vector<AuthoringKind> joint_kinds() {
  const KindOption axis{"axis", ""};
  const KindOption lower{"lower", "physics:lowerLimit"};
  const KindOption upper{"upper", "physics:upperLimit"};
  return {
      joint_kind("fixed", "a joint without a degree of freedom", "PhysicsFixedJoint", {}),
      joint_kind("revolute", "a hinge", "PhysicsRevoluteJoint", {axis, lower, upper}),
      joint_kind("prismatic", "a slider", "PhysicsPrismaticJoint", {axis, lower, upper}),
      joint_kind(
          "spherical", "a ball joint", "PhysicsSphericalJoint",
          {axis, {"cone0", "physics:coneAngle0Limit"}, {"cone1", "physics:coneAngle1Limit"}}),
      joint_kind("distance", "keeps two points near or apart", "PhysicsDistanceJoint",
                 {{"min", "physics:minDistance"}, {"max", "physics:maxDistance"}}),
      joint_kind("d6", "a joint with six degrees of freedom, which limits take away",
                 "PhysicsJoint", {axis}),
  };
}

std::vector<AuthoringKind> api_kinds() {
  return {
      {.name = "body",
       .about = "a rigid body: the prim and all below it move together",
       .apis = {"PhysicsRigidBodyAPI"},
       .options = {{"velocity", "physics:velocity"},
                   {"angular-velocity", "physics:angularVelocity"},
                   {"kinematic", "physics:kinematicEnabled"},
                   {"asleep", "physics:startsAsleep"}}},
      {.name = "collider",
       .about = "a shape that touches others",
       .apis = {"PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"},
       .options = {{"approximation", "physics:approximation"}}},
      {.name = "mass",
       .about = "mass, density, centre of mass and inertia of a body or a collider",
       .apis = {"PhysicsMassAPI"},
       .options = {{"mass", "physics:mass"},
                   {"density", "physics:density"},
                   {"com", "physics:centerOfMass"},
                   {"inertia", "physics:diagonalInertia"},
                   {"principal-axes", "physics:principalAxes"}}},
      {.name = "articulation",
       .about = "the joints at and below the prim are solved together",
       .apis = {"PhysicsArticulationRootAPI"},
       .rests = true},
      {.name = "binding",
       .about = "the physics material of the colliders at and below the prim",
       .apis = {"MaterialBindingAPI"},
       .options = {{"material", "material:binding:physics"}},
       .needs = {"material"}},
      {.name = "filtered-pair",
       .about = "the prim and another one, with their descendants, never collide",
       .apis = {"PhysicsFilteredPairsAPI"},
       .options = {{"with", "physics:filteredPairs"}}},
  };
}

std::vector<AuthoringKind> joint_api_kinds() {
  return {
      {.name = "limit",
       .about = "how far a degree of freedom of a joint goes",
       .apis = {"PhysicsLimitAPI:*"},
       .options = {{"dof", ""}, {"low", "limit:*:physics:low"}, {"high", "limit:*:physics:high"}},
       .on = "PhysicsJoint"},
      {.name = "drive",
       .about = "what moves a degree of freedom of a joint",
       .apis = {"PhysicsDriveAPI:*"},
       .options = {{"dof", ""},
                   {"stiffness", "drive:*:physics:stiffness"},
                   {"damping", "drive:*:physics:damping"},
                   {"max-force", "drive:*:physics:maxForce"},
                   {"target-position", "drive:*:physics:targetPosition"},
                   {"target-velocity", "drive:*:physics:targetVelocity"},
                   {"drive-type", "drive:*:physics:type"}},
       .on = "PhysicsJoint"},
      {.name = "mimic",
       .about = "a joint follows another: q = offset + multiplier * leader",
       .apis = {"NewtonMimicAPI"},
       .options = {{"leader", "newton:mimicJoint"},
                   {"multiplier", "newton:mimicCoef1"},
                   {"offset", "newton:mimicCoef0"}},
       .on = "PhysicsJoint",
       .needs = {"leader"},
       .also_ends = {"PhysxMimicJointAPI", "MjcEqualityJointAPI"}},
  };
}

std::vector<AuthoringKind> structure_kinds() {
  return {
      {.name = "variant",
       .about = "a variant of a set of the prim, without anything in it",
       .options = {{"variant", ""}},
       .rests = true,
       .needs = {"variant"}},
      {.name = "engine",
       .about = "the file and the variant of --engine, in an asset of the structure 3.0",
       .rests = true},
  };
}

std::vector<AuthoringKind> all_kinds() {
  std::vector<AuthoringKind> kinds;
  for (const auto& part : {shape_kinds(), look_kinds(), physics_prim_kinds(), joint_kinds(),
                           api_kinds(), joint_api_kinds(), structure_kinds()}) {
    kinds.insert(kinds.end(), part.begin(), part.end());
  }
  return kinds;
}

std::vector<AuthoringOption> prim_options() {
  return {
      {"at", "X,Y,Z", "units of length",
       "Position relative to the parent; of joints the point in the world where the bodies meet"},
      {"rotate", "X,Y,Z", "degrees", "Rotation about X, then Y, then Z; or a quaternion W,X,Y,Z"},
      {"scale", "X,Y,Z", "", "Scaled along its axes"},
      {"size", "NUMBER", "units of length", "Edge of a cube"},
      {"radius", "NUMBER", "units of length", "Radius"},
      {"height", "NUMBER", "units of length", "Height, without round ends"},
      {"width", "NUMBER", "units of length", "Width"},
      {"length", "NUMBER", "units of length", "Length"},
      {"axis", "AXIS", "",
       "X, Y or Z; of joints in the world, or a direction X,Y,Z there; without "
       "it X of body1"},
      {"file", "FILE", "", "The file of a reference, a payload or a mesh"},
      {"file-meters", "NUMBER", "", "Metres in a unit of the mesh file; without it 1"},
      {"file-up", "AXIS", "",
       "Up axis of the mesh file: Y or Z; without it Y for .gltf and .glb, else the asset's"},
      {"prim", "PRIM", "", "Prim of that file, instead of its default prim"},
      {"intensity", "NUMBER", "nits", "Brightness of a light"},
      {"color", "R,G,B", "", "Colour of a light"},
      {"angle", "NUMBER", "degrees", "Angular size of a distant light"},
      {"texture", "FILE", "", "Picture of a dome light"},
      {"focal-length", "NUMBER", "tenths of a unit of length", "Of a camera"},
      {"gravity-direction", "X,Y,Z", "", "Direction of gravity; without it down"},
      {"gravity-magnitude", "NUMBER", "units of length / s^2", "Gravity; without it the earth's"},
      {"static-friction", "NUMBER", "", "Friction of what rests"},
      {"dynamic-friction", "NUMBER", "", "Friction of what slides"},
      {"restitution", "NUMBER", "", "Restitution, from 0 (none) to 1"},
  };
}

std::vector<AuthoringOption> joint_options() {
  return {
      {"density", "NUMBER", "units of mass / length^3", "Mass by volume"},
      {"members", "PRIMS", "", "Colliders of a group, or prims above them, with commas between"},
      {"filtered", "PRIMS", "", "Groups that a group does not touch, itself for one"},
      {"body0", "PRIM", "", "First body of a joint; without it the world"},
      {"body1", "PRIM", "", "Second body of a joint"},
      {"lower", "NUMBER", "degrees or units of length", "Lower limit of a joint"},
      {"upper", "NUMBER", "degrees or units of length", "Upper limit of a joint"},
      {"cone0", "NUMBER", "degrees", "Limit of a ball joint about the axis after its own"},
      {"cone1", "NUMBER", "degrees", "The same about the next axis"},
      {"min", "NUMBER", "units of length", "Least distance"},
      {"max", "NUMBER", "units of length", "Greatest distance"},
      {"break-force", "NUMBER", "units of force", "Break force"},
      {"break-torque", "NUMBER", "units of torque", "Break torque"},
      {"collide", "BOOL", "", "Whether the bodies of a joint touch"},
  };
}

std::vector<AuthoringOption> state_options() {
  return {
      {"velocity", "X,Y,Z", "units of length / s", "Velocity at the start"},
      {"angular-velocity", "X,Y,Z", "degrees / s", "Angular velocity at the start"},
      {"kinematic", "BOOL", "", "Moved by its transforms, not by forces"},
      {"asleep", "BOOL", "", "Rests until it is touched"},
      {"approximation", "NAME", "",
       "Collision shape of a mesh: convexHull, convexDecomposition, ..."},
      {"mass", "NUMBER", "kg", "Mass"},
      {"com", "X,Y,Z", "units of length", "Centre of mass, in the prim's space"},
      {"inertia", "X,Y,Z", "units of mass * length^2", "Diagonal of the inertia"},
      {"principal-axes", "W,X,Y,Z", "", "In which the inertia is diagonal"},
      {"material", "PRIM", "", "The material that is bound"},
      {"with", "PRIM", "", "The other prim of a pair"},
      {"dof", "NAME", "",
       "Degree of freedom: transX to rotZ, distance; a hinge or a slider "
       "needs none"},
      {"low", "NUMBER", "degrees or units of length", "Lower end; above the upper one: locked"},
      {"high", "NUMBER", "degrees or units of length", "Upper end"},
      {"stiffness", "NUMBER", "force / unit of position",
       "Stiffness of a drive; per degree where it turns"},
      {"damping", "NUMBER", "force / unit of velocity",
       "Damping of a drive; per degree where it turns"},
      {"max-force", "NUMBER", "units of force or torque", "Maximum drive force or torque"},
      {"target-position", "NUMBER", "degrees or units of length", "Target position of a drive"},
      {"target-velocity", "NUMBER", "the same / s", "Target velocity of a drive"},
      {"drive-type", "NAME", "", "force or acceleration"},
      {"leader", "PRIM", "", "The joint that is followed"},
      {"multiplier", "NUMBER", "", "Factor of the leader's position"},
      {"offset", "NUMBER", "degrees or units of length", "Offset of the follower"},
      {"variant", "SET=NAME", "", "The set and its variant"},
  };
}

std::vector<AuthoringOption> all_options() {
  std::vector<AuthoringOption> options;
  for (const auto& part : {prim_options(), joint_options(), state_options()}) {
    options.insert(options.end(), part.begin(), part.end());
  }
  return options;
}

}  // namespace

bool AuthoringKind::takes_pose() const {
  return makes_prim() &&
         schema::Registry::instance().is_a(Token(std::string(type)), Token("Xformable"));
}

bool AuthoringKind::takes(std::string_view wanted) const {
  const bool pose = std::find(std::begin(kPose), std::end(kPose), wanted) != std::end(kPose);
  return option(wanted) != nullptr || (pose && takes_pose());
}

const KindOption* AuthoringKind::option(std::string_view wanted) const {
  const auto found = std::find_if(options.begin(), options.end(),
                                  [&](const KindOption& one) { return one.name == wanted; });
  return found == options.end() ? nullptr : &*found;
}

const std::vector<AuthoringKind>& authoring_kinds() {
  static const std::vector<AuthoringKind> kinds = all_kinds();
  return kinds;
}

const AuthoringKind* find_kind(std::string_view name) {
  const auto& kinds = authoring_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const AuthoringKind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const AuthoringKind& kind : authoring_kinds()) {
    names.emplace_back(kind.name);
  }
  return names;
}

const std::vector<AuthoringOption>& authoring_options() {
  static const std::vector<AuthoringOption> options = all_options();
  return options;
}

}  // namespace tenon
