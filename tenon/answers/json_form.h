// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "tenon/answers/json.h"
#include "tenon/scene/fields/scene_fields.h"

/// What the JSON of a scene has beyond the tables. Internal to tenon/answers.
namespace tenon::answers {

/// A key that follows from fields: written for readers, passed over when read.
struct DerivedKey {
  std::string_view name;
  std::string_view type;  ///< of JSON Schema
  std::string_view meaning;
};

template <class T>
inline constexpr std::array<DerivedKey, 0> kDerived{};

template <>
inline constexpr std::array<DerivedKey, 6> kDerived<scene::Collider>{{
    {"points", "integer", "how many the mesh has"},
    {"triangles", "integer", "how many the mesh has"},
    {"lower", "array", "of the bounds of the mesh [m]"},
    {"upper", "array", "of the bounds of the mesh [m]"},
    {"flat", "boolean", "all points of the mesh in one plane"},
    {"pieces", "integer", "how many hulls its convex decomposition has"},
}};
template <>
inline constexpr std::array<DerivedKey, 1> kDerived<scene::Limit>{{
    {"locked", "boolean", "lower is above upper"},
}};
template <>
inline constexpr std::array<DerivedKey, 2> kDerived<scene::Joint>{{
    {"locked", "boolean", "lower is above upper: it does not move"},
    {"mimic", "object", "the first of `mimics`"},
}};
template <>
inline constexpr std::array<DerivedKey, 5> kDerived<scene::TriangleMesh>{{
    {"hash", "string", "of points, triangles and flat"},
    {"pointCount", "integer", "how many there are"},
    {"triangleCount", "integer", "how many there are"},
    {"lower", "array", "of its bounds [m]"},
    {"upper", "array", "of its bounds [m]"},
}};
template <>
inline constexpr std::array<DerivedKey, 3> kDerived<scene::PhysicsScene>{{
    {"schemaVersion", "string", "of this form"},
    {"disabledPairs", "array", "colliders that may not touch, groups expanded"},
    {"animated", "array", "what follows samples, in short"},
}};

/// A field is written although it has its default: it is what the object is about.
template <class T>
bool counts(const T&, const scene::FieldInfo&) {
  return false;
}
inline bool counts(const scene::Shape& shape, const scene::FieldInfo& info) {
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
inline bool counts(const scene::Joint& joint, const scene::FieldInfo& info) {
  using scene::JointKind;
  const bool spherical = joint.kind == JointKind::Spherical;
  if (info.name == "axis") {
    return spherical || joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic;
  }
  return spherical && (info.name == "coneAngle0" || info.name == "coneAngle1");
}
inline bool counts(const scene::TendonWrap& wrap, const scene::FieldInfo& info) {
  const bool pulley = wrap.kind == scene::TendonWrap::Kind::Pulley;
  return pulley ? info.name == "divisor" : info.name == "attachment" || info.name == "radius";
}

}  // namespace tenon::answers
