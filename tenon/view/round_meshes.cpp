// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/view/round_meshes.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace tenon::view {
namespace {

constexpr std::uint32_t kAround = 32;  // corners of a circle
constexpr std::uint32_t kRings = 8;    // of a half ball
/// Corners of a square, counter-clockwise.
constexpr Vec2d kSquare[] = {{{-1, -1}}, {{1, -1}}, {{1, 1}}, {{-1, 1}}};

/// A point of the outline that is turned about Z: radius, height, and the normal there.
struct Outline {
  double radius;
  double height;
  double normal_out;  ///< away from Z
  double normal_up;
};

void add_corner(ViewMesh& mesh, const Vec3d& point, const Vec3d& normal) {
  mesh.points.push_back(to_float(point));
  mesh.normals.push_back(to_float(normal));
}

void add_triangle(ViewMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  mesh.corners.insert(mesh.corners.end(), {a, b, c});
}

/// The surface between each point of the outline and the next, from below to above. Pairs of
/// points in one place are an edge: nothing lies between them.
ViewMesh turned(const std::vector<Outline>& outline) {
  ViewMesh mesh;
  for (const Outline& at : outline) {
    for (std::uint32_t i = 0; i <= kAround; ++i) {
      const double angle = 2 * std::numbers::pi * (i % kAround) / kAround;
      const double x = std::cos(angle);
      const double y = std::sin(angle);
      add_corner(mesh, {{at.radius * x, at.radius * y, at.height}},
                 {{at.normal_out * x, at.normal_out * y, at.normal_up}});
    }
  }
  constexpr std::uint32_t kRow = kAround + 1;
  for (std::uint32_t ring = 0; ring + 1 < outline.size(); ++ring) {
    const bool below = outline[ring].radius > 0;
    const bool above = outline[ring + 1].radius > 0;
    const bool edge = outline[ring].radius == outline[ring + 1].radius &&
                      outline[ring].height == outline[ring + 1].height;
    for (std::uint32_t i = 0; i < kAround && !edge; ++i) {
      const std::uint32_t at = ring * kRow + i;
      if (below) {
        add_triangle(mesh, at, at + 1, at + kRow + 1);
      }
      if (above) {
        add_triangle(mesh, at, at + kRow + 1, at + kRow);
      }
    }
  }
  return mesh;
}

/// A quarter circle about (0, height), from `from` to `from` + 90 degrees above the horizon.
void add_quarter(std::vector<Outline>& outline, double radius, double height, double from) {
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    const double angle = from + std::numbers::pi / 2 * ring / kRings;
    const bool pole = (from < 0 && ring == 0) || (from >= 0 && ring == kRings);
    const double out = pole ? 0 : std::cos(angle);
    outline.push_back({radius * out, height + radius * std::sin(angle), out, std::sin(angle)});
  }
}

}  // namespace

ViewMesh box_mesh(const Vec3d& half_extents) {
  ViewMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      const auto first = static_cast<std::uint32_t>(mesh.points.size());
      for (const Vec2d& at : kSquare) {
        Vec3d point;
        Vec3d normal;
        point[axis] = side * half_extents[axis];
        point[u] = side * at[0] * half_extents[u];
        point[v] = at[1] * half_extents[v];
        normal[axis] = side;
        add_corner(mesh, point, normal);
      }
      add_triangle(mesh, first, first + 1, first + 2);
      add_triangle(mesh, first, first + 2, first + 3);
    }
  }
  return mesh;
}

ViewMesh ball_mesh(double radius) { return capsule_mesh(radius, radius, 0); }

ViewMesh frustum_mesh(double bottom_radius, double top_radius, double half_height) {
  const double out = 2 * half_height;
  const double up = bottom_radius - top_radius;
  const double size = std::hypot(out, up);
  const double normal_out = size > 0 ? out / size : 1;
  const double normal_up = size > 0 ? up / size : 0;
  return turned({{0, -half_height, 0, -1},
                 {bottom_radius, -half_height, 0, -1},
                 {bottom_radius, -half_height, normal_out, normal_up},
                 {top_radius, half_height, normal_out, normal_up},
                 {top_radius, half_height, 0, 1},
                 {0, half_height, 0, 1}});
}

ViewMesh capsule_mesh(double bottom_radius, double top_radius, double half_height) {
  std::vector<Outline> outline;
  add_quarter(outline, bottom_radius, -half_height, -std::numbers::pi / 2);
  add_quarter(outline, top_radius, half_height, 0);
  return turned(outline);
}

ViewMesh plane_mesh(double half_width, double half_length) {
  ViewMesh mesh;
  for (const Vec2d& at : kSquare) {
    add_corner(mesh, {{at[0] * half_width, at[1] * half_length, 0}}, {{0, 0, 1}});
  }
  add_triangle(mesh, 0, 1, 2);
  add_triangle(mesh, 0, 2, 3);
  return mesh;
}

Quatd turn_from_z(scene::Axis axis) {
  switch (axis) {
    case scene::Axis::X:
      return {0.5, 0.5, 0.5, 0.5};
    case scene::Axis::Y:
      return {-0.5, -0.5, -0.5, 0.5};
    case scene::Axis::Z:
      break;
  }
  return kIdentityRotation;
}

}  // namespace tenon::view
