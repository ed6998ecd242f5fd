// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A robot's shapes have a rigid pose and sizes in metres; prims have any matrix. So the matrix is
// factored (SceneSource::placed): points of meshes are multiplied by the remaining factor, sizes of
// other shapes are scaled by it where their kind allows it, and the others are skipped.
#include "tenon/describe/visual_shapes.h"

#include <cmath>

namespace tenon::describe {

using robot::GeometryKind;

namespace {

double number(const stage::Prim& prim, const char* name) {
  return prim.attribute(Token(name)).get_as<double>().value_or(0);
}

/// Corners of the triangles of faces, fanned; false where a face names no corner.
bool triangulate(const layer::Array<int>& counts, const layer::Array<int>& indices,
                 std::size_t point_count, bool flipped, std::vector<Vec3i>& triangles) {
  std::size_t start = 0;
  for (const int count : counts) {
    if (count < 0 || static_cast<std::size_t>(count) > indices.size() - start) {
      return false;
    }
    const int* face = indices.data() + start;
    for (int k = 0; k < count; ++k) {
      if (face[k] < 0 || static_cast<std::size_t>(face[k]) >= point_count) {
        return false;
      }
    }
    for (int k = 2; k < count; ++k) {
      triangles.push_back(flipped ? Vec3i{{face[0], face[k], face[k - 1]}}
                                  : Vec3i{{face[0], face[k - 1], face[k]}});
    }
    start += static_cast<std::size_t>(count);
  }
  return true;
}

/// The identity up to rounding: points stay as they are, to their last bit.
bool is_identity(const Mat4d& m) {
  const Mat4d one = Mat4d::identity();
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (std::fabs(m[i][j] - one[i][j]) > 1e-12) {
        return false;
      }
    }
  }
  return true;
}

Token axis_of(const stage::Prim& prim) {
  return prim.attribute("axis").get_as<Token>().value_or(Token("Z"));
}

Pose turned_to(Token axis) {
  return {{},
          turn_from_z(axis == "X"   ? scene::Axis::X
                      : axis == "Y" ? scene::Axis::Y
                                    : scene::Axis::Z)};
}

/// Of the corners of the triangles, as they were fanned.
std::vector<Vec2f> texture_coordinates(SceneSource& source, const stage::Prim& prim, bool flipped) {
  const auto st = prim.attribute("primvars:st").get_as<layer::Array<Vec2f>>();
  const auto counts = prim.attribute("faceVertexCounts").get_as<layer::Array<int>>();
  const auto points = prim.attribute("faceVertexIndices").get_as<layer::Array<int>>();
  if (!st) {
    return {};
  }
  const auto indices = prim.attribute("primvars:st:indices").get_as<layer::Array<int>>();
  const Token kind =
      prim.attribute("primvars:st").metadata("interpolation").get_or<Token>(Token("constant"));
  const bool by_point = kind == "vertex" || kind == "varying";
  if (!by_point && !(kind == "faceVarying")) {
    source.left_out(prim.path(), "texture coordinates are neither of points nor of corners");
    return {};
  }
  std::vector<Vec2f> places;
  const auto add = [&](std::size_t corner) {
    auto at = by_point ? static_cast<std::size_t>((*points)[corner]) : corner;
    if (indices) {
      at = at < indices->size() && (*indices)[at] >= 0 ? static_cast<std::size_t>((*indices)[at])
                                                       : st->size();
    }
    places.push_back(at < st->size() ? (*st)[at] : Vec2f{});
  };
  std::size_t start = 0;
  for (const int count : *counts) {
    for (std::size_t k = 2; k < static_cast<std::size_t>(count); ++k) {
      add(start);
      add(start + (flipped ? k : k - 1));
      add(start + (flipped ? k - 1 : k));
    }
    start += static_cast<std::size_t>(count);
  }
  return places;
}

std::optional<VisualShape> read_mesh(SceneSource& source, const stage::Prim& prim,
                                     const Pose& link) {
  const auto points = prim.attribute("points").get_as<layer::Array<Vec3f>>();
  const auto counts = prim.attribute("faceVertexCounts").get_as<layer::Array<int>>();
  const auto indices = prim.attribute("faceVertexIndices").get_as<layer::Array<int>>();
  if (!points || !counts || !indices || points->size() == 0) {
    return std::nullopt;
  }
  robot::MeshFile file;
  const auto [pose, rest] = source.placed(prim);
  const bool exact = is_identity(rest);
  for (const Vec3f& point : *points) {
    file.points.push_back(exact ? point : to_float(transform_point(to_double(point), rest)));
  }
  const bool left = prim.attribute("orientation").get_as<Token>() == Token("leftHanded");
  const bool flipped = left != (determinant(upper_left(rest)) < 0);
  if (!triangulate(*counts, *indices, points->size(), flipped, file.triangles)) {
    return std::nullopt;
  }
  if (source.is_mjcf()) {
    file.texture_coordinates = texture_coordinates(source, prim, flipped);
  }
  VisualShape shape;
  shape.pose = inverse(link) * pose;
  shape.geometry.kind = GeometryKind::Mesh;
  shape.mesh = std::move(file);
  return shape;
}

/// What `size` of a prim is along each of its axes [m].
Vec3d scaled(const Vec3d& scale, double size) {
  return {{std::fabs(scale[0]) * size, std::fabs(scale[1]) * size, std::fabs(scale[2]) * size}};
}

bool is_uniform(const Vec3d& scale) {
  const double size = std::fabs(scale[0]);
  return !(std::fabs(std::fabs(scale[1]) - size) > 1e-9 * size) &&
         !(std::fabs(std::fabs(scale[2]) - size) > 1e-9 * size);
}

/// One without width or length has no end.
robot::Geometry plane_of(const stage::Prim& prim, const Vec3d& scale) {
  robot::Geometry plane;
  plane.kind = GeometryKind::Plane;
  const bool ends =
      prim.attribute("width").has_authored_value() && prim.attribute("length").has_authored_value();
  if (ends && axis_of(prim) == "Z") {
    plane.half_extents = {{std::fabs(scale[0]) * number(prim, "width") / 2,
                           std::fabs(scale[1]) * number(prim, "length") / 2, 0}};
  }
  return plane;
}

/// Of what is round, with radius and height. None for other kinds, and where it is skewed.
std::optional<robot::Geometry> round_of(const stage::Prim& prim, const Vec3d& scale) {
  if (!is_uniform(scale)) {
    return std::nullopt;
  }
  const double size = std::fabs(scale[0]);
  robot::Geometry round;
  round.radius = size * number(prim, "radius");
  round.half_height = size * number(prim, "height") / 2;
  if (prim.is_a("Sphere")) {
    round.kind = GeometryKind::Sphere;
  } else if (prim.is_a("Cylinder")) {
    round.kind = GeometryKind::Cylinder;
  } else if (prim.is_a("Capsule")) {
    round.kind = GeometryKind::Capsule;
  } else {
    return std::nullopt;
  }
  return round;
}

std::optional<robot::Geometry> geometry_of(const SceneSource& source, const stage::Prim& prim,
                                           const Vec3d& scale) {
  robot::Geometry geometry;
  if (prim.is_a("Cube")) {
    geometry.kind = GeometryKind::Box;
    geometry.half_extents = scaled(scale, number(prim, "size")) * 0.5;
    return geometry;
  }
  if ((source.is_mjcf() || source.is_sdf()) && prim.is_a("Plane")) {
    return plane_of(prim, scale);
  }
  if (prim.is_a("Sphere") && (source.is_mjcf() || (source.is_sdf() && !is_uniform(scale)))) {
    geometry.kind = GeometryKind::Ellipsoid;
    geometry.half_extents = scaled(scale, number(prim, "radius"));
    return geometry;
  }
  return round_of(prim, scale);
}

}  // namespace

std::optional<VisualShape> read_visual_shape(SceneSource& source, const stage::Prim& prim,
                                             const Pose& link) {
  if (prim.is_a("Mesh")) {
    return read_mesh(source, prim, link);
  }
  const auto [pose, rest] = source.placed(prim);
  const auto geometry = geometry_of(source, prim, row_scale(rest));
  if (!geometry) {
    return std::nullopt;
  }
  VisualShape shape{*geometry, inverse(link) * pose, std::nullopt};
  const GeometryKind kind = geometry->kind;
  if (kind == GeometryKind::Plane || kind == GeometryKind::Cylinder ||
      kind == GeometryKind::Capsule) {
    shape.pose = shape.pose * turned_to(axis_of(prim));
  }
  return shape;
}

}  // namespace tenon::describe
