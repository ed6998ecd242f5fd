// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Volume, centre and inertia about the centre at density 1. Plain solids have closed forms. Solids
// of several parts move the inertia of each to the common centre by the parallel axis theorem.
// A solid with radius f(z) about Z is integrated along its axis: volume pi int f^2, inertia about Z
// pi/2 int f^4, across it pi int (f^4/4 + z^2 f^2) before the move to the centre. On each smooth
// piece these are polynomials of degree 4 at most, for which five Gauss-Legendre points are exact.
#include "tenon/scene/shapes/shape_mass.h"

#include <array>
#include <cmath>

#include "tenon/math/angle.h"
#include "tenon/scene/shapes/convex_hull.h"

namespace tenon::scene {

SolidIntegrals sum_of(const std::vector<SolidIntegrals>& parts) {
  SolidIntegrals result;
  for (const SolidIntegrals& part : parts) {
    result.volume += part.volume;
    result.center += part.center * part.volume;
  }
  if (!(result.volume > 0)) {
    return {};
  }
  result.center *= 1 / result.volume;
  for (const SolidIntegrals& part : parts) {
    const Mat3d moved = shift_inertia(part.inertia, part.volume, part.center - result.center);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) {
        result.inertia[i][j] += moved[i][j];
      }
    }
  }
  return result;
}

namespace {

/// M-1
SolidIntegrals box_integrals(const Vec3d& h) {
  SolidIntegrals result;
  result.volume = 8 * h[0] * h[1] * h[2];
  const Vec3d square{{h[0] * h[0], h[1] * h[1], h[2] * h[2]}};
  result.inertia =
      diagonal_matrix(Vec3d{{square[1] + square[2], square[0] + square[2], square[0] + square[1]}} *
                      (result.volume / 3));
  return result;
}

/// M-2
SolidIntegrals ellipsoid_integrals(const Vec3d& r) {
  SolidIntegrals result;
  result.volume = 4.0 / 3 * kPi * r[0] * r[1] * r[2];
  const Vec3d square{{r[0] * r[0], r[1] * r[1], r[2] * r[2]}};
  result.inertia =
      diagonal_matrix(Vec3d{{square[1] + square[2], square[0] + square[2], square[0] + square[1]}} *
                      (result.volume / 5));
  return result;
}

/// Inertia with `along` on one axis and `across` on the others.
Mat3d about_axis(Axis axis, double along, double across) {
  Vec3d diagonal{{across, across, across}};
  diagonal[static_cast<std::size_t>(axis)] = along;
  return diagonal_matrix(diagonal);
}

/// M-3
SolidIntegrals cylinder_integrals(double r, double h, Axis axis) {
  SolidIntegrals result;
  result.volume = kPi * r * r * h;
  result.inertia =
      about_axis(axis, result.volume * r * r / 2, result.volume * (3 * r * r + h * h) / 12);
  return result;
}

/// M-4: apex at +axis, the centre of mass a quarter of the height above the base.
SolidIntegrals cone_integrals(double r, double h, Axis axis) {
  SolidIntegrals result;
  result.volume = kPi * r * r * h / 3;
  result.center[static_cast<std::size_t>(axis)] = -h / 4;
  result.inertia = about_axis(axis, result.volume * r * r * 3 / 10,
                              result.volume * (r * r * 3 / 20 + h * h * 3 / 80));
  return result;
}

/// M-5
SolidIntegrals capsule_integrals(double r, double h, Axis axis) {
  const double cylinder = kPi * r * r * h;
  const double caps = 4.0 / 3 * kPi * r * r * r;
  SolidIntegrals result;
  result.volume = cylinder + caps;
  const double along = cylinder * r * r / 2 + caps * r * r * 2 / 5;
  const double across =
      cylinder * (h * h / 12 + r * r / 4) + caps * (r * r * 2 / 5 + h * h / 4 + h * r * 3 / 8);
  result.inertia = about_axis(axis, along, across);
  return result;
}

/// M-11, M-12
SolidIntegrals spheres_integrals(const Shape& shape) {
  std::vector<SolidIntegrals> parts;
  for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
    const double r = shape.sphere_radii[i];
    parts.push_back(ellipsoid_integrals({{r, r, r}}));
    parts.back().center = shape.sphere_centers[i];
  }
  return sum_of(parts);
}

/// M-10: the sum of the hulls.
SolidIntegrals pieces_integrals(const Shape& shape, const std::vector<TriangleMesh>& meshes) {
  std::vector<SolidIntegrals> parts;
  for (const Index piece : shape.pieces) {
    parts.push_back(mesh_integrals(convex_hull(meshes[piece].points)));
  }
  return sum_of(parts);
}

/// M-8..M-10
SolidIntegrals triangles_integrals(const Shape& shape, const std::vector<TriangleMesh>& meshes,
                                   bool* used_hull) {
  const TriangleMesh& mesh = meshes[shape.mesh];
  if (mesh.flat) {
    return {};
  }
  if (!shape.pieces.empty()) {
    return pieces_integrals(shape, meshes);
  }
  if (shape.kind == ShapeKind::Mesh && is_closed(mesh)) {
    return mesh_integrals(mesh);
  }
  if (used_hull != nullptr) {
    *used_hull = shape.kind == ShapeKind::Mesh;
  }
  return mesh_integrals(convex_hull(mesh.points));
}

/// Radius of the profile at height z.
double profile_radius(const Profile& p, double z) {
  const double h = p.top - p.bottom;
  if (!p.capped) {
    return p.bottom_radius + (p.top_radius - p.bottom_radius) * (z - p.bottom) / h;
  }
  const double s = (p.bottom_radius - p.top_radius) / h;
  const double slope = std::sqrt(1 - s * s);
  const double low = p.bottom + p.bottom_radius * s;
  const double high = p.top + p.top_radius * s;
  const auto ball = [](double r, double d) { return std::sqrt(std::fmax(0, r * r - d * d)); };
  if (z <= low) {
    return ball(p.bottom_radius, z - p.bottom);
  }
  if (z >= high) {
    return ball(p.top_radius, z - p.top);
  }
  const double at = (z - low) / (high - low);
  return (p.bottom_radius + (p.top_radius - p.bottom_radius) * at) * slope;
}

struct ProfileSums {
  double f2 = 0;
  double zf2 = 0;
  double zzf2 = 0;
  double f4 = 0;
};

void add_piece(const Profile& profile, double from, double to, ProfileSums& sums) {
  constexpr std::array<double, 5> kNodes{-0.9061798459386640, -0.5384693101056831, 0,
                                         0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeights{0.2369268850561891, 0.4786286704993665,
                                           0.5688888888888889, 0.4786286704993665,
                                           0.2369268850561891};
  const double half = (to - from) / 2;
  for (std::size_t i = 0; i < kNodes.size(); ++i) {
    const double z = (from + to) / 2 + half * kNodes[i];
    const double f = profile_radius(profile, z);
    const double weight = half * kWeights[i];
    sums.f2 += weight * f * f;
    sums.zf2 += weight * z * f * f;
    sums.zzf2 += weight * z * z * f * f;
    sums.f4 += weight * f * f * f * f;
  }
}

}  // namespace

SolidIntegrals profile_integrals(const Profile& profile) {
  ProfileSums sums;
  if (profile.capped) {
    const double h = profile.top - profile.bottom;
    const double s = (profile.bottom_radius - profile.top_radius) / h;
    const double low = profile.bottom + profile.bottom_radius * s;
    const double high = profile.top + profile.top_radius * s;
    add_piece(profile, profile.bottom - profile.bottom_radius, low, sums);
    add_piece(profile, low, high, sums);
    add_piece(profile, high, profile.top + profile.top_radius, sums);
  } else {
    add_piece(profile, profile.bottom, profile.top, sums);
  }
  SolidIntegrals result;
  result.volume = kPi * sums.f2;
  if (!(result.volume > 0)) {
    return {};
  }
  const double z = sums.zf2 / sums.f2;
  result.center = {{0, 0, z}};
  const double across = kPi * (sums.f4 / 4 + sums.zzf2) - result.volume * z * z;
  result.inertia = diagonal_matrix({{across, across, kPi / 2 * sums.f4}});
  return result;
}

SolidIntegrals shape_integrals(const Shape& shape, const std::vector<TriangleMesh>& meshes,
                               bool* used_hull) {
  const double h = 2 * shape.half_height;
  switch (shape.kind) {
    case ShapeKind::Box:
      return box_integrals(shape.half_extents);
    case ShapeKind::Sphere:
      return ellipsoid_integrals({{shape.radius, shape.radius, shape.radius}});
    case ShapeKind::Ellipsoid:
      return ellipsoid_integrals(shape.half_extents);
    case ShapeKind::Capsule:
      return capsule_integrals(shape.radius, h, shape.axis);
    case ShapeKind::Cylinder:
      return cylinder_integrals(shape.radius, h, shape.axis);
    case ShapeKind::Cone:
      return cone_integrals(shape.radius, h, shape.axis);
    case ShapeKind::Spheres:
      return spheres_integrals(shape);
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh:
      return triangles_integrals(shape, meshes, used_hull);
    case ShapeKind::Plane:
      break;
  }
  return {};
}

}  // namespace tenon::scene
