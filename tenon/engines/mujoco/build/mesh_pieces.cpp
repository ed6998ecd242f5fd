// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A mesh becomes one hull where it is convex: closed with all points on one side of every triangle,
// or flat with triangles that cover the area of its hull. Else each triangle becomes a thin prism.
// Flat points get the thickness that MuJoCo needs below their upper side, if they have one, so that
// things rest at the same height. A convexity check that would cost too much counts as failed, and
// a mesh of too many triangles becomes its whole hull.
#include "tenon/engines/mujoco/build/mesh_pieces.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tenon/base/limits/limits.h"
#include "tenon/base/limits/physics_limits.h"
#include "tenon/scene/shapes/convex_hull.h"

namespace tenon::engines::mujoco {
namespace {

constexpr double kFlat = 1e-5;  // thickness relative to the size, below it points are flat
constexpr double kAddedThickness = 1e-2;  // of the size
constexpr double kAcross = 0.1;           // cosine above which `up` tells the sides of a plane

struct Plane {
  Vec3d origin;
  Vec3d normal;     // zero: the points lie on a line or in one place
  double size = 0;  // largest distance from the origin
  double thickness = 0;
};

Plane plane_of(const std::vector<Vec3d>& points) {
  Plane plane;
  if (points.empty()) {
    return plane;
  }
  plane.origin = points.front();
  Vec3d far;
  for (const Vec3d& p : points) {
    if (length(p - plane.origin) > plane.size) {
      plane.size = length(p - plane.origin);
      far = p - plane.origin;
    }
  }
  double largest = 0;
  Vec3d widest;
  for (const Vec3d& p : points) {
    const Vec3d area = cross(far, p - plane.origin);
    if (length(area) > largest) {
      largest = length(area);
      widest = area;
    }
  }
  if (largest <= kFlat * plane.size * plane.size) {
    return plane;
  }
  plane.normal = normalized(widest);
  double low = 0;
  double high = 0;
  for (const Vec3d& p : points) {
    low = std::min(low, dot(plane.normal, p - plane.origin));
    high = std::max(high, dot(plane.normal, p - plane.origin));
  }
  plane.thickness = high - low;
  return plane;
}

// Where the added thickness goes: from the points to the points plus `low` and plus `high`.
struct Thickness {
  Vec3d low;
  Vec3d high;
  std::string note;
};

Thickness thickness_of(const Plane& plane, const Vec3d& up) {
  const double side = dot(plane.normal, normalized(up));
  const double amount = kAddedThickness * plane.size;
  if (std::fabs(side) > kAcross) {
    return {plane.normal * (side > 0 ? -amount : amount),
            {},
            "MuJoCo needs volume: the flat mesh got a thickness of 1 % of its size below its upper "
            "side"};
  }
  return {
      plane.normal * (-amount / 2), plane.normal * (amount / 2),
      "MuJoCo needs volume: the flat mesh got a thickness of 1 % of its size, half on each side"};
}

std::vector<Vec3d> thicken(const std::vector<Vec3d>& points, const Thickness& thickness) {
  std::vector<Vec3d> result;
  for (const Vec3d& p : points) {
    result.push_back(p + thickness.low);
    result.push_back(p + thickness.high);
  }
  return result;
}

double double_area(const scene::TriangleMesh& mesh, const Vec3i& t) {
  const Vec3d& a = mesh.points[static_cast<std::size_t>(t[0])];
  return length(cross(mesh.points[static_cast<std::size_t>(t[1])] - a,
                      mesh.points[static_cast<std::size_t>(t[2])] - a));
}

// Twice the area of the convex hull of points in a plane (monotone chain, Andrew 1979).
double double_hull_area(const std::vector<Vec3d>& points, const Plane& plane) {
  const Vec3d helper = std::fabs(plane.normal[0]) < 0.5 ? Vec3d{{1, 0, 0}} : Vec3d{{0, 1, 0}};
  const Vec3d u = normalized(cross(plane.normal, helper));
  const Vec3d w = cross(plane.normal, u);
  std::vector<std::pair<double, double>> flat;
  for (const Vec3d& p : points) {
    flat.emplace_back(dot(p, u), dot(p, w));
  }
  std::sort(flat.begin(), flat.end());
  const auto turn = [](const auto& o, const auto& a, const auto& b) {
    return (a.first - o.first) * (b.second - o.second) -
           (a.second - o.second) * (b.first - o.first);
  };
  double area = 0;
  for (int half = 0; half < 2; ++half) {
    std::vector<std::pair<double, double>> chain;
    for (const auto& p : flat) {
      while (chain.size() >= 2 && turn(chain[chain.size() - 2], chain.back(), p) <= 0) {
        chain.pop_back();
      }
      chain.push_back(p);
    }
    for (std::size_t i = 1; i < chain.size(); ++i) {
      area += chain[i - 1].first * chain[i].second - chain[i].first * chain[i - 1].second;
    }
    std::reverse(flat.begin(), flat.end());
  }
  return std::fabs(area);
}

bool is_convex_polygon(const scene::TriangleMesh& mesh, const Plane& plane) {
  double covered = 0;
  for (const Vec3i& t : mesh.triangles) {
    covered += double_area(mesh, t);
  }
  const double hull = double_hull_area(mesh.points, plane);
  return std::fabs(covered - hull) < 1e-4 * hull;
}

bool every_edge_joins_two(const scene::TriangleMesh& mesh) {
  std::vector<std::pair<int, int>> edges;
  for (const Vec3i& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      edges.push_back(std::minmax({t[i], t[(i + 1) % 3]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    if (i + 1 == edges.size() || edges[i] != edges[i + 1] ||
        (i + 2 < edges.size() && edges[i] == edges[i + 2])) {
      return false;
    }
  }
  return true;
}

// Every point is behind every triangle (either winding); only called for closed meshes.
bool is_convex(const scene::TriangleMesh& mesh, double size) {
  if (mesh.triangles.size() * mesh.points.size() > limits::kConvexityChecks ||
      !every_edge_joins_two(mesh)) {
    return false;
  }
  int side = 0;
  for (const Vec3i& t : mesh.triangles) {
    const Vec3d& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Vec3d normal = normalized(cross(mesh.points[static_cast<std::size_t>(t[1])] - a,
                                          mesh.points[static_cast<std::size_t>(t[2])] - a));
    for (const Vec3d& p : mesh.points) {
      const double height = dot(normal, p - a);
      if (std::fabs(height) > 1e-5 * size) {
        const int this_side = height > 0 ? 1 : -1;
        if (side == -this_side) {
          return false;
        }
        side = this_side;
      }
    }
  }
  return true;
}

std::vector<Vec3d> prism(const scene::TriangleMesh& mesh, const Vec3i& t, const Vec3d& down,
                         double depth) {
  std::vector<Vec3d> result;
  const Vec3d& a = mesh.points[static_cast<std::size_t>(t[0])];
  const Vec3d normal = normalized(cross(mesh.points[static_cast<std::size_t>(t[1])] - a,
                                        mesh.points[static_cast<std::size_t>(t[2])] - a));
  const Vec3d offset = down == Vec3d{} ? normal * -depth : down;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& p = mesh.points[static_cast<std::size_t>(t[i])];
    result.push_back(p);
    result.push_back(p + offset);
  }
  return result;
}

/// One hull of points in space: MuJoCo makes it with Qhull, whose time has no other bound.
MeshPieces one_hull(const std::vector<Vec3d>& points, std::string note) {
  scene::HullPoints hull = scene::hull_points(points);
  if (hull.simplified) {
    note += std::string(note.empty() ? "" : "; ") + "the hull has more than " +
            std::to_string(limits::kHullPoints) +
            " corners (kHullPoints); it goes through the outermost ones";
  }
  return {{std::move(hull.points)}, std::move(note)};
}

}  // namespace

MeshPieces hull_pieces(const std::vector<Vec3d>& points, const Vec3d& up) {
  const Plane plane = plane_of(points);
  if (plane.normal == Vec3d{}) {
    return {{}, "a mesh whose points lie on a line has no surface to touch; skipped"};
  }
  if (plane.thickness > kFlat * plane.size) {
    return one_hull(points, "");
  }
  const Thickness thickness = thickness_of(plane, up);
  return one_hull(thicken(points, thickness), thickness.note);
}

MeshPieces triangle_pieces(const scene::TriangleMesh& mesh, const Vec3d& up) {
  const Plane plane = plane_of(mesh.points);
  if (plane.normal == Vec3d{}) {
    return hull_pieces(mesh.points, up);
  }
  const bool flat = plane.thickness <= kFlat * plane.size;
  if (flat && is_convex_polygon(mesh, plane)) {
    return hull_pieces(mesh.points, up);
  }
  if (!flat && is_convex(mesh, plane.size)) {
    return one_hull(mesh.points, "");
  }
  if (mesh.triangles.size() > limits::kTrianglePieces) {
    return one_hull(
        mesh.points,
        "MuJoCo has no contacts with triangle meshes, and this one has too many triangles to be "
        "split; its convex hull is used");
  }
  MeshPieces result;
  const Thickness thickness = thickness_of(plane, up);
  result.note =
      "MuJoCo has no contacts with triangle meshes: each triangle is a thin convex piece "
      "below its front side";
  for (const Vec3i& t : mesh.triangles) {
    if (double_area(mesh, t) > 1e-12 * plane.size * plane.size) {
      result.hulls.push_back(
          prism(mesh, t, flat ? thickness.low : Vec3d{}, kAddedThickness * plane.size));
    }
  }
  return result;
}

}  // namespace tenon::engines::mujoco
