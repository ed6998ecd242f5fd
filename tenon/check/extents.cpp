// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/extents.h"

#include <algorithm>
#include <cmath>

#include "tenon/check/overlaps/convex_overlap.h"
#include "tenon/scene/shapes/shape_mass.h"

namespace tenon::check {
namespace {

using scene::Index;

constexpr double kHeaviest = 30000;  ///< [kg/m^3]: osmium has 22590
constexpr double kLightest = 0.5;    ///< [kg/m^3]: air has 1.2

/// The radius of a ball around the shape's origin that holds it; planes have none.
double reach_of(const scene::PhysicsScene& scene, const scene::Shape& shape) {
  using scene::ShapeKind;
  switch (shape.kind) {
    case ShapeKind::Box:
    case ShapeKind::Ellipsoid:
      return length(shape.half_extents);
    case ShapeKind::ConvexHull:
    case ShapeKind::Mesh: {
      double reach = 0;
      for (const Vec3d& p : scene.meshes[shape.mesh].points) {
        reach = std::fmax(reach, length(p));
      }
      return reach;
    }
    case ShapeKind::Spheres: {
      double reach = 0;
      for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
        reach = std::fmax(reach, length(shape.sphere_centers[i]) + shape.sphere_radii[i]);
      }
      return reach;
    }
    case ShapeKind::Plane:
      return 0;
    default:
      return std::hypot(shape.radius, shape.half_height) + shape.radius;
  }
}

/// Low and high corner of points.
std::pair<Vec3d, Vec3d> bounds_of_points(const std::vector<Vec3d>& points, const Pose& pose) {
  std::pair<Vec3d, Vec3d> bounds{{{kInfinity, kInfinity, kInfinity}},
                                 {{-kInfinity, -kInfinity, -kInfinity}}};
  for (const Vec3d& point : points) {
    const Vec3d placed = transform_point(pose, point);
    for (std::size_t i = 0; i < 3; ++i) {
      bounds.first[i] = std::fmin(bounds.first[i], placed[i]);
      bounds.second[i] = std::fmax(bounds.second[i], placed[i]);
    }
  }
  return bounds;
}

std::pair<Vec3d, Vec3d> bounds_of_spheres(const scene::Shape& shape, const Pose& pose) {
  auto bounds = bounds_of_points(shape.sphere_centers, pose);
  double radius = 0;
  for (const double r : shape.sphere_radii) {
    radius = std::fmax(radius, r);
  }
  const Vec3d around{{radius, radius, radius}};
  return {bounds.first - around, bounds.second + around};
}

std::pair<Vec3d, Vec3d> bounds_of_shape(const scene::PhysicsScene& scene, const scene::Shape& shape,
                                        const Pose& pose) {
  using scene::ShapeKind;
  switch (shape.kind) {
    case ShapeKind::Plane:
      return {{{-kInfinity, -kInfinity, -kInfinity}}, {{kInfinity, kInfinity, kInfinity}}};
    case ShapeKind::Mesh:
    case ShapeKind::ConvexHull:
      return bounds_of_points(scene.meshes[shape.mesh].points, pose);
    case ShapeKind::Spheres:
      return bounds_of_spheres(shape, pose);
    default:
      return bounds_of(ConvexSolid{&shape, nullptr, pose, {}, 1});
  }
}

double volume_of(const Subject& subject, Index collider) {
  double& known = subject.known_volumes[collider];
  if (std::isnan(known)) {
    known = scene::shape_integrals(subject.scene.colliders[collider].shape, subject.scene.meshes)
                .volume;
  }
  return known;
}

}  // namespace

Extent extent_of(const Subject& subject, Index body) {
  Extent extent;
  for (const Index i : subject.colliders_of_body[body]) {
    const scene::Collider& collider = subject.scene.colliders[i];
    extent.volume += volume_of(subject, i);
    const double reach = reach_of(subject.scene, collider.shape);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent.low[axis] = std::fmin(extent.low[axis], collider.pose.position[axis] - reach);
      extent.high[axis] = std::fmax(extent.high[axis], collider.pose.position[axis] + reach);
    }
  }
  return extent;
}

std::optional<double> mean_density(const Subject& subject, Index body) {
  const double volume = extent_of(subject, body).volume;
  const scene::Body& found = subject.scene.bodies[body];
  if (!(volume > 0) || found.mass_source == scene::MassSource::Default) {
    return std::nullopt;
  }
  return found.mass / volume;
}

bool is_heavier_than_matter(double density) { return density > kHeaviest; }
bool is_lighter_than_air(double density) { return density < kLightest; }

double thickness_of(const scene::PhysicsScene& scene, const scene::Shape& shape) {
  const auto [low, high] = bounds_of_shape(scene, shape, {});
  const Vec3d size = high - low;
  return std::fmin(size[0], std::fmin(size[1], size[2]));
}

double thickness_of_body(const Subject& subject, Index body) {
  double thickest = 0;
  for (const Index i : subject.colliders_of_body[body]) {
    thickest = std::fmax(thickest, thickness_of(subject.scene, subject.scene.colliders[i].shape));
  }
  return thickest;
}

std::pair<Vec3d, Vec3d> world_bounds(const scene::PhysicsScene& scene,
                                     const scene::Collider& collider) {
  const Pose pose =
      collider.body ? scene.bodies[*collider.body].pose * collider.pose : collider.pose;
  return bounds_of_shape(scene, collider.shape, pose);
}

}  // namespace tenon::check
