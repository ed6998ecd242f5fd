// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/shapes/gprims.h"

namespace tenon::convert {

using layer::Value;
using robot::GeometryKind;

namespace {

Value box_extent(const Vec3d& half) {
  return Value(std::vector<Vec3f>{to_float(-half), to_float(half)});
}

/// With edges of 1.
Path write_cube(LayerBuilder& builder, Path link, Token name) {
  const Path prim = builder.define(link, name, "Cube");
  builder.set_value(prim, "Cube", "extent", box_extent({{0.5, 0.5, 0.5}}));
  builder.set_number(prim, "Cube", "size", 1);
  return prim;
}

Path write_sphere(LayerBuilder& builder, Path link, Token name, double radius) {
  const Path prim = builder.define(link, name, "Sphere");
  builder.set_value(prim, "Sphere", "extent", box_extent({{radius, radius, radius}}));
  builder.set_number(prim, "Sphere", "radius", radius);
  return prim;
}

/// A cylinder, or a capsule, whose height is that without the caps.
Path write_cylinder(LayerBuilder& builder, Path link, Token name, const robot::Geometry& geometry) {
  const double r = geometry.radius;
  const double h = geometry.half_height;
  const bool capsule = geometry.kind == GeometryKind::Capsule;
  const Token type(capsule ? "Capsule" : "Cylinder");
  const Path prim = builder.define(link, name, type);
  builder.set_value(prim, type, "axis", Value(Token("Z")));
  builder.set_value(prim, type, "extent", box_extent({{r, r, capsule ? h + r : h}}));
  builder.set_number(prim, type, "height", 2 * h);
  builder.set_number(prim, type, "radius", r);
  return prim;
}

Path write_plane(LayerBuilder& builder, Path link, Token name, const Vec3d& half) {
  const Path prim = builder.define(link, name, "Plane");
  builder.set_value(prim, "Plane", "axis", Value(Token("Z")));
  if (half[0] > 0 && half[1] > 0) {
    builder.set_number(prim, "Plane", "width", 2 * half[0]);
    builder.set_number(prim, "Plane", "length", 2 * half[1]);
  }
  return prim;
}

}  // namespace

Path write_gprim(RobotLayer& layer, Path link, Token name, const robot::Geometry& geometry,
                 const Pose& pose) {
  LayerBuilder& builder = layer.builder();
  Path prim;
  Vec3d scale{{1, 1, 1}};
  switch (geometry.kind) {
    case GeometryKind::Box:
      prim = write_cube(builder, link, name);
      scale = geometry.half_extents * 2.0;
      break;
    case GeometryKind::Sphere:
      prim = write_sphere(builder, link, name, geometry.radius);
      break;
    case GeometryKind::Ellipsoid:
      prim = write_sphere(builder, link, name, 1);
      scale = geometry.half_extents;
      break;
    case GeometryKind::Cylinder:
    case GeometryKind::Capsule:
      prim = write_cylinder(builder, link, name, geometry);
      break;
    case GeometryKind::Plane:
      prim = write_plane(builder, link, name, geometry.half_extents);
      break;
    case GeometryKind::Mesh:
      break;
  }
  layer.set_pose(prim, pose, scale);
  return prim;
}

}  // namespace tenon::convert
