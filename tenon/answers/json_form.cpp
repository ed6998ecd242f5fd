// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/json_form.h"

#include "tenon/scene/physics_scene.h"

namespace tenon::answers {
namespace {

constexpr DerivedKey kColliderKeys[] = {
    {"points", "integer", "how many the mesh has"},
    {"triangles", "integer", "how many the mesh has"},
    {"lower", "array", "of the bounds of the mesh [m]"},
    {"upper", "array", "of the bounds of the mesh [m]"},
    {"flat", "boolean", "all points of the mesh in one plane"},
    {"pieces", "integer", "how many hulls its convex decomposition has"},
};
constexpr DerivedKey kLimitKeys[] = {
    {"locked", "boolean", "lower is above upper"},
};
constexpr DerivedKey kJointKeys[] = {
    {"locked", "boolean", "lower is above upper: it does not move"},
    {"mimic", "object", "the first of `mimics`"},
};
constexpr DerivedKey kTriangleMeshKeys[] = {
    {"hash", "string", "of points, triangles and flat"},
    {"pointCount", "integer", "how many there are"},
    {"triangleCount", "integer", "how many there are"},
    {"lower", "array", "of its bounds [m]"},
    {"upper", "array", "of its bounds [m]"},
};
constexpr DerivedKey kPhysicsSceneKeys[] = {
    {"schemaVersion", "string", "of this form"},
    {"disabledPairs", "array", "colliders that may not touch, groups expanded"},
    {"disabledPairsCut", "boolean", "there are more of them than a million, which are not listed"},
    {"animated", "array", "what follows samples, in short"},
};

bool shape_counts(const scene::Shape& shape, const scene::FieldInfo& info) {
  using scene::ShapeKind;
  switch (shape.kind) {
    case ShapeKind::Box:
    case ShapeKind::Ellipsoid:
      return info.name == "halfExtents";
    case ShapeKind::Sphere:
      return info.name == "radius";
    case ShapeKind::Capsule:
    case ShapeKind::Cylinder:
    case ShapeKind::Cone:
      return info.name == "radius" || info.name == "halfHeight" || info.name == "axis";
    case ShapeKind::Plane:
      return info.name == "axis";
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh:
      return info.name == "mesh";
    case ShapeKind::Spheres:
      return info.name == "centers" || info.name == "radii";
  }
  return false;
}
bool joint_counts(const scene::Joint& joint, const scene::FieldInfo& info) {
  using scene::JointKind;
  const bool spherical = joint.kind == JointKind::Spherical;
  if (info.name == "axis") {
    return spherical || joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic;
  }
  return spherical && (info.name == "coneAngle0" || info.name == "coneAngle1");
}
bool wrap_counts(const scene::TendonWrap& wrap, const scene::FieldInfo& info) {
  const bool pulley = wrap.kind == scene::TendonWrap::Kind::Pulley;
  return pulley ? info.name == "divisor" : info.name == "attachment" || info.name == "radius";
}

}  // namespace

std::span<const DerivedKey> derived_keys(const scene::DataType& type) {
  if (type.is_a<scene::Collider>()) {
    return kColliderKeys;
  }
  if (type.is_a<scene::Limit>()) {
    return kLimitKeys;
  }
  if (type.is_a<scene::Joint>()) {
    return kJointKeys;
  }
  if (type.is_a<scene::TriangleMesh>()) {
    return kTriangleMeshKeys;
  }
  if (type.is_a<scene::PhysicsScene>()) {
    return kPhysicsSceneKeys;
  }
  return {};
}

bool counts(scene::DataView of, const scene::FieldInfo& info) {
  if (const auto* shape = of.get_if<scene::Shape>()) {
    return shape_counts(*shape, info);
  }
  if (const auto* joint = of.get_if<scene::Joint>()) {
    return joint_counts(*joint, info);
  }
  const auto* wrap = of.get_if<scene::TendonWrap>();
  return wrap != nullptr && wrap_counts(*wrap, info);
}

}  // namespace tenon::answers
