// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Scale belongs to shapes: a shape's sizes are those in metres after the scale of its world matrix
// (S-51..S-57). A sheared matrix has no scale along the shape's own axes: boxes become exact hulls,
// round shapes are approximated (S-56).
#include "tenon/physics/colliders/shapes.h"

#include <array>
#include <cmath>

#include "tenon/physics/world_pose.h"
#include "tenon/scene/shapes/convex_hull.h"

namespace tenon::physics {
namespace {

constexpr double kUniform = 1e-5;  ///< relative difference of scales that still counts as uniform

struct Sizes {
  Vec3d scale;            ///< signed, along the shape's axes, stage units to metres
  std::size_t along = 2;  ///< of the shape's axis
  std::size_t side0 = 0;
  std::size_t side1 = 1;
  double scale_along() const { return std::fabs(scale[along]); }
  double scale_across() const {
    return std::fmax(std::fabs(scale[side0]), std::fabs(scale[side1]));
  }
};

bool is_uniform(double a, double b) {
  return std::fabs(std::fabs(a) - std::fabs(b)) <= kUniform * std::fmax(std::fabs(a), std::fabs(b));
}

Axis shape_axis(const ReadState& state, const stage::Prim& prim) {
  const Token axis = state.values.get<Token>(prim, state.tokens.axis).value_or(Token("Z"));
  if (axis == "X") {
    return Axis::X;
  }
  if (axis == "Y") {
    return Axis::Y;
  }
  if (!(axis == "Z")) {
    state.report(prim, state.tokens.axis, Severity::Error, "collider.axis-unknown",
                 "axis is \"" + axis.str() + "\"; Z is used instead", "use X, Y or Z");
  }
  return Axis::Z;
}

Sizes sizes_for(const ReadState& state, const ShapeSource& source, Axis axis) {
  Sizes sizes;
  sizes.scale = source.parts.scale * state.units.length;
  sizes.along = static_cast<std::size_t>(axis);
  sizes.side0 = (sizes.along + 1) % 3;
  sizes.side1 = (sizes.along + 2) % 3;
  return sizes;
}

void report_shear(const ReadState& state, const ShapeSource& source) {
  if (source.parts.sheared) {
    state.report(source.found.prim, Severity::Warning, "collider.sheared",
                 "a round shape under a rotated non-uniform scale is approximated",
                 "remove the non-uniform scale above it, or use a mesh");
  }
}

/// S-54: round shapes take the larger scale across their axis.
void report_scale_across(const ReadState& state, const ShapeSource& source, const Sizes& sizes) {
  report_shear(state, source);
  if (!is_uniform(sizes.scale[sizes.side0], sizes.scale[sizes.side1])) {
    state.report(source.found.prim, Severity::Warning, "collider.non-uniform-scale",
                 "the scale across the axis is not uniform; the larger one is used",
                 "scale both directions across the axis alike, or use a mesh");
  }
}

/// Turns +axis into -axis where the matrix mirrors along it (S-55).
Quatd flip_of(const Sizes& sizes) {
  if (sizes.scale[sizes.along] >= 0) {
    return kIdentityRotation;
  }
  Vec3d about;
  about[sizes.side0] = 1;
  return rotation_about(about, kPi);
}

double positive(const ReadState& state, const stage::Prim& prim, Token name, double fallback) {
  return std::fabs(state.values.wide_number(prim, name).value_or(fallback));
}

std::optional<ShapeReading> read_cube(ReadState& state, const ShapeSource& source) {
  const double half = positive(state, source.found.prim, state.tokens.size, 2) / 2;  // S-52
  if (source.parts.sheared) {
    std::vector<Vec3d> corners;
    for (unsigned i = 0; i < 8; ++i) {
      const Vec3d corner{{(i & 1u) != 0 ? half : -half, (i & 2u) != 0 ? half : -half,
                          (i & 4u) != 0 ? half : -half}};
      corners.push_back(point_in_frame(corner, source.found.world, source.frame, state.units));
    }
    return hull_shape(state, std::move(corners));
  }
  ShapeReading reading;
  reading.shape.kind = ShapeKind::Box;
  for (std::size_t i = 0; i < 3; ++i) {
    reading.shape.half_extents[i] = half * std::fabs(source.parts.scale[i]) * state.units.length;
  }
  return reading;
}

std::optional<ShapeReading> read_sphere(ReadState& state, const ShapeSource& source) {
  const double radius = positive(state, source.found.prim, state.tokens.radius, 1);
  const Sizes sizes = sizes_for(state, source, Axis::Z);
  ShapeReading reading;
  const bool uniform =
      is_uniform(sizes.scale[0], sizes.scale[1]) && is_uniform(sizes.scale[0], sizes.scale[2]);
  const bool ball = state.readings.stretched_sphere == StretchedSphere::Ball;
  if (uniform || ball) {
    reading.shape.kind = ShapeKind::Sphere;
    reading.shape.radius = radius * std::fmax(sizes.scale_along(), sizes.scale_across());
  }
  if (uniform) {
    return reading;
  }
  // S-53: the image of a ball is an ellipsoid, along the scale's own axes under shear too.
  state.report(source.found.prim, Severity::Warning, "collider.non-uniform-scale",
               "a sphere under a non-uniform scale is an ellipsoid; some engines take a sphere of "
               "the largest radius",
               "scale the sphere uniformly");
  if (ball) {
    return reading;
  }
  reading.shape.kind = ShapeKind::Ellipsoid;
  for (std::size_t i = 0; i < 3; ++i) {
    reading.shape.half_extents[i] = radius * std::fabs(sizes.scale[i]);
  }
  // p = q r S r^-1 u: the semi-axes are the rows of r^-1 turned by u; the frame has u taken out.
  Mat3d axes = transpose(source.parts.scale_orientation);
  if (determinant(axes) < 0) {
    for (double& x : axes[0]) {
      x = -x;
    }
  }
  reading.pose.orientation = rotation_of(axes);
  return reading;
}

std::optional<ShapeReading> read_round(ReadState& state, const ShapeSource& source, ShapeKind kind,
                                       double default_radius, double default_height) {
  const stage::Prim& prim = source.found.prim;
  ShapeReading reading;
  reading.shape.kind = kind;
  reading.shape.axis = shape_axis(state, prim);
  const Sizes sizes = sizes_for(state, source, reading.shape.axis);
  report_scale_across(state, source, sizes);
  reading.shape.radius =
      positive(state, prim, state.tokens.radius, default_radius) * sizes.scale_across();
  reading.shape.half_height =
      positive(state, prim, state.tokens.height, default_height) / 2 * sizes.scale_along();
  if (kind == ShapeKind::Cone) {
    reading.pose.orientation = flip_of(sizes);
  }
  return reading;
}

/// Points on the surface of a solid of revolution about +Z.
std::vector<Vec3d> revolve(const Profile& profile) {
  constexpr int kAround = 48;
  constexpr int kCapRings = 8;
  std::vector<std::pair<double, double>> rings;  // height, radius
  const auto add_cap = [&](double center, double radius, double side) {
    for (int i = 0; i <= kCapRings; ++i) {
      const double angle = kPi / 2 * i / kCapRings;
      rings.emplace_back(center + side * radius * std::sin(angle), radius * std::cos(angle));
    }
  };
  if (profile.capped) {
    add_cap(profile.bottom, profile.bottom_radius, -1);
    add_cap(profile.top, profile.top_radius, 1);
  } else {
    rings = {{profile.bottom, profile.bottom_radius}, {profile.top, profile.top_radius}};
  }
  std::vector<Vec3d> points;
  for (const auto& [z, r] : rings) {
    for (int i = 0; i < (r > 1e-12 ? kAround : 1); ++i) {
      const double angle = 2 * kPi * i / kAround;
      points.push_back({{r * std::cos(angle), r * std::sin(angle), z}});
    }
  }
  return points;
}

/// Rotation that takes +Z to the positive direction of `axis`.
Quatd z_to_axis(Axis axis) {
  if (axis == Axis::X) {
    return rotation_about({{0, 1, 0}}, kPi / 2);
  }
  return axis == Axis::Y ? rotation_about({{1, 0, 0}}, -kPi / 2) : kIdentityRotation;
}

/// Capsule_1 and Cylinder_1: two radii (M-6, M-7). Equal radii are the plain shapes.
std::optional<ShapeReading> read_tapered(ReadState& state, const ShapeSource& source, bool capped) {
  const stage::Prim& prim = source.found.prim;
  const Axis axis = shape_axis(state, prim);
  const Sizes sizes = sizes_for(state, source, axis);
  report_scale_across(state, source, sizes);
  const double fallback = capped ? 0.5 : 1;
  Profile profile;
  profile.capped = capped;
  profile.top_radius =
      positive(state, prim, state.tokens.radius_top, fallback) * sizes.scale_across();
  profile.bottom_radius =
      positive(state, prim, state.tokens.radius_bottom, fallback) * sizes.scale_across();
  const double half =
      positive(state, prim, state.tokens.height, capped ? 1 : 2) / 2 * sizes.scale_along();
  profile.top = half;
  profile.bottom = -half;
  ShapeReading reading;
  if (is_uniform(profile.top_radius, profile.bottom_radius)) {
    reading.shape.kind = capped ? ShapeKind::Capsule : ShapeKind::Cylinder;
    reading.shape.axis = axis;
    reading.shape.radius = profile.top_radius;
    reading.shape.half_height = half;
    return reading;
  }
  if (capped && std::fabs(profile.top_radius - profile.bottom_radius) >= 2 * half) {
    // One ball holds the other.
    const bool top = profile.top_radius > profile.bottom_radius;
    const Quatd turn = flip_of(sizes) * z_to_axis(axis);
    reading.shape.kind = ShapeKind::Sphere;
    reading.shape.radius = top ? profile.top_radius : profile.bottom_radius;
    reading.pose.position = rotate(turn, {{0, 0, top ? half : -half}});
    return reading;
  }
  reading = hull_shape(state, revolve(profile));
  reading.pose.orientation = flip_of(sizes) * z_to_axis(axis);
  reading.integrals = profile_integrals(profile);
  return reading;
}

/// S-75: solid below the plane; scale does not matter, mirrors and rotations do.
std::optional<ShapeReading> read_plane(ReadState& state, const ShapeSource& source) {
  if (source.dynamic) {
    state.report(source.found.prim, Severity::Error, "collider.plane-dynamic",
                 "a plane cannot belong to a body that moves; it does not collide",
                 "use a box, or take the plane out of the body");
    return std::nullopt;
  }
  ShapeReading reading;
  reading.shape.kind = ShapeKind::Plane;
  reading.shape.axis = shape_axis(state, source.found.prim);
  const Sizes sizes = sizes_for(state, source, reading.shape.axis);
  if (!source.parts.sheared) {
    reading.pose.orientation = flip_of(sizes);
    return reading;
  }
  // Normals follow the inverse transpose; in the rigid frame, turned back.
  Vec3d axis;
  axis[sizes.along] = 1;
  const Vec3d normal =
      normalized(rotate(conjugate(source.frame.orientation),
                        axis * transpose(inverse(upper_left(source.found.world)))));
  const Vec3d about = cross(axis, normal);
  const double angle = std::atan2(length(about), dot(axis, normal));
  reading.pose.orientation = rotation_about(normalized(about, {{0, 0, 1}}), angle);
  return reading;
}

}  // namespace

Index add_mesh(ReadState& state, TriangleMesh mesh) {
  state.scene.meshes.push_back(std::move(mesh));
  return static_cast<Index>(state.scene.meshes.size() - 1);
}

ShapeReading hull_shape(ReadState& state, std::vector<Vec3d> points) {
  TriangleMesh hull = convex_hull(points);
  if (hull.flat) {
    hull.points = std::move(points);
  }
  ShapeReading reading;
  reading.shape.kind = ShapeKind::ConvexHull;
  reading.shape.mesh = add_mesh(state, std::move(hull));
  return reading;
}

std::optional<ShapeReading> read_shape(ReadState& state, const ShapeSource& source) {
  switch (source.found.roles.kind) {
    case PrimKind::Cube:
      return read_cube(state, source);
    case PrimKind::Sphere:
      return read_sphere(state, source);
    case PrimKind::Capsule:
      return read_round(state, source, ShapeKind::Capsule, 0.5, 1);
    case PrimKind::Cylinder:
      return read_round(state, source, ShapeKind::Cylinder, 1, 2);
    case PrimKind::Cone:
      return read_round(state, source, ShapeKind::Cone, 1, 2);
    case PrimKind::Capsule1:
      return read_tapered(state, source, true);
    case PrimKind::Cylinder1:
      return read_tapered(state, source, false);
    case PrimKind::Plane:
      return read_plane(state, source);
    case PrimKind::Points:
      return read_points_shape(state, source);
    case PrimKind::Mesh:
      return read_mesh_shape(state, source);
    default:
      break;
  }
  // S-47
  const bool gprim = source.found.roles.kind == PrimKind::OtherGprim;
  state.report(source.found.prim, Severity::Warning, "collider.not-a-shape",
               "PhysicsCollisionAPI is applied to a prim of type \"" +
                   source.found.prim.type_name().str() + "\", which is " +
                   (gprim ? "a shape that does not collide" : "no shape") + "; it does not collide",
               "apply it to a Cube, Sphere, Cylinder, Cone, Capsule, Plane, Points or Mesh",
               api_part("PhysicsCollisionAPI"));
  return std::nullopt;
}

}  // namespace tenon::physics
