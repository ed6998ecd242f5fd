// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The iteration of Gilbert, Johnson and Keerthi (1988) for the point of the difference A - B that
// lies nearest to the origin. Each step asks for the farthest point against the nearest one known,
// and takes the nearest point of the simplex of it and those that carried the last one; one point
// alone would creep along where a small solid lies on a large one. A point beyond the origin's
// plane separates the solids.
#include "tenon/check/overlaps/convex_overlap.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace tenon::check {
namespace {

using scene::Shape;
using scene::ShapeKind;

constexpr int kSteps = 400;
constexpr double kTouching = 1e-3;  ///< of the sizes: nearer than that is overlapping

double sign(double x) { return x < 0 ? -1 : 1; }

/// Along the axis and across it, for round shapes.
Vec3d round_point(const Shape& shape, const Vec3d& d) {
  const auto axis = static_cast<std::size_t>(shape.axis);
  const double along = d[axis];
  Vec3d across = d;
  across[axis] = 0;
  const Vec3d out = normalized(across) * shape.radius;
  Vec3d point;
  switch (shape.kind) {
    case ShapeKind::Capsule:
      point = normalized(d) * shape.radius;
      point[axis] += sign(along) * shape.half_height;
      return point;
    case ShapeKind::Cylinder:
      point = out;
      point[axis] = sign(along) * shape.half_height;
      return point;
    default:  // Cone: the apex or the rim of the base
      point[axis] = shape.half_height;
      Vec3d rim = out;
      rim[axis] = -shape.half_height;
      return dot(point, d) > dot(rim, d) ? point : rim;
  }
}

Vec3d local_point(const ConvexSolid& solid, const Vec3d& d) {
  const Shape& shape = *solid.shape;
  const Vec3d& h = shape.half_extents;
  switch (shape.kind) {
    case ShapeKind::Box:
      return {{sign(d[0]) * h[0], sign(d[1]) * h[1], sign(d[2]) * h[2]}};
    case ShapeKind::Sphere:
      return normalized(d) * shape.radius;
    case ShapeKind::Ellipsoid: {
      const Vec3d n = normalized({{d[0] * h[0], d[1] * h[1], d[2] * h[2]}});
      return {{n[0] * h[0], n[1] * h[1], n[2] * h[2]}};
    }
    case ShapeKind::ConvexHull:
      return *std::max_element(
          solid.points->begin(), solid.points->end(),
          [&](const Vec3d& a, const Vec3d& b) { return dot(a, d) < dot(b, d); });
    default:
      return round_point(shape, d);
  }
}

/// The point nearest to the origin of what some corners span, if it lies within them.
std::optional<Vec3d> nearest_within(const std::vector<Vec3d>& corners) {
  std::vector<Vec3d> edges;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    edges.push_back(corners[i] - corners[0]);
  }
  Mat3d gram = Mat3d::identity();
  Vec3d right;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < edges.size(); ++j) {
      gram[i][j] = dot(edges[i], edges[j]);
    }
    right[i] = -dot(edges[i], corners[0]);
  }
  bool solved = true;
  const Vec3d shares = right * inverse(gram, &solved);
  Vec3d point = corners[0];
  double rest = 1;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    solved = solved && shares[i] >= 0;
    rest -= shares[i];
    point += edges[i] * shares[i];
  }
  return solved && rest >= 0 ? std::optional(point) : std::nullopt;
}

/// The point of a simplex nearest to the origin; only the corners that carry it are kept.
Vec3d nearest_in(std::vector<Vec3d>& simplex) {
  std::vector<Vec3d> best{simplex.back()};
  Vec3d nearest = simplex.back();
  for (unsigned chosen = 1; chosen < 1u << simplex.size(); ++chosen) {
    std::vector<Vec3d> corners;
    for (std::size_t i = 0; i < simplex.size(); ++i) {
      if ((chosen >> i & 1u) != 0) {
        corners.push_back(simplex[i]);
      }
    }
    const std::optional<Vec3d> point = corners.size() <= 4 ? nearest_within(corners) : std::nullopt;
    if (point && length(*point) < length(nearest)) {
      nearest = *point;
      best = corners;
    }
  }
  simplex = best;
  return nearest;
}

}  // namespace

bool is_convex(const Shape& shape) {
  return shape.kind != ShapeKind::Plane && shape.kind != ShapeKind::Mesh &&
         shape.kind != ShapeKind::Spheres;
}

Vec3d ConvexSolid::farthest(const Vec3d& direction) const {
  const Vec3d local = local_point(*this, rotate(conjugate(pose.orientation), direction));
  return transform_point(pose, middle + (local - middle) * keep);
}

std::pair<Vec3d, Vec3d> bounds_of(const ConvexSolid& solid) {
  Vec3d low;
  Vec3d high;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec3d d;
    d[i] = 1;
    high[i] = solid.farthest(d)[i];
    low[i] = solid.farthest(-d)[i];
  }
  return {low, high};
}

bool overlap(const ConvexSolid& a, const ConvexSolid& b) {
  Vec3d nearest = transform_point(a.pose, a.middle) - transform_point(b.pose, b.middle);
  const auto [low, high] = bounds_of(a);
  const auto [low_b, high_b] = bounds_of(b);
  const double size = std::fmin(length(high - low), length(high_b - low_b));
  std::vector<Vec3d> simplex{nearest};
  for (int step = 0; step < kSteps; ++step) {
    if (length(nearest) <= kTouching * size) {
      return true;
    }
    const Vec3d next = a.farthest(-nearest) - b.farthest(nearest);
    if (dot(next, nearest) > 0) {
      return false;  // all of A - B lies on one side of a plane through `next`
    }
    simplex.push_back(next);
    const Vec3d nearer = nearest_in(simplex);
    if (!(length(nearer) < length(nearest))) {
      return true;
    }
    nearest = nearer;
  }
  return false;
}

}  // namespace tenon::check
