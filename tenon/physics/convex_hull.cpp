// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Hulls come from Qhull (reentrant library), told to triangulate its facets. Qhull cannot work on
// flat input, so flatness is tested first.
#include "tenon/physics/convex_hull.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <unordered_map>

namespace tenon::physics {
namespace {

/// Files that Qhull writes its remarks to; nobody reads them.
std::FILE* nowhere() {
  static std::FILE* const file = std::fopen("/dev/null", "w");
  return file;
}

class Qhull {
 public:
  explicit Qhull(const std::vector<Vec3d>& points) {
    coordinates_.reserve(points.size() * 3);
    for (const Vec3d& p : points) {
      coordinates_.insert(coordinates_.end(), p.v.begin(), p.v.end());
    }
    qh_zero(&qh_, nowhere());
    char options[] = "qhull Qt Pp";
    failed_ = qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), coordinates_.data(), False,
                           options, nullptr, nowhere()) != 0;
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() {
    qh_freeqhull(&qh_, !qh_ALL);
    int kept = 0;
    int total = 0;
    qh_memfreeshort(&qh_, &kept, &total);
  }

  bool failed() const { return failed_; }

  TriangleMesh triangles() {
    TriangleMesh mesh;
    for (facetT* facet = qh_.facet_list; facet != nullptr && facet->next != nullptr;
         facet = facet->next) {
      add_facet(facet, mesh);
    }
    return mesh;
  }

 private:
  void add_facet(facetT* facet, TriangleMesh& mesh) {
    if (qh_setsize(&qh_, facet->vertices) != 3) {
      return;
    }
    Vec3i triangle;
    for (int i = 0; i < 3; ++i) {
      auto* vertex = static_cast<vertexT*>(facet->vertices->e[i].p);
      const int id = qh_pointid(&qh_, vertex->point);
      const auto added = corner_.emplace(id, static_cast<std::int32_t>(mesh.points.size()));
      if (added.second) {
        mesh.points.push_back({{vertex->point[0], vertex->point[1], vertex->point[2]}});
      }
      triangle[static_cast<std::size_t>(i)] = added.first->second;
    }
    const Vec3d& a = mesh.points[static_cast<std::size_t>(triangle[0])];
    const Vec3d& b = mesh.points[static_cast<std::size_t>(triangle[1])];
    const Vec3d& c = mesh.points[static_cast<std::size_t>(triangle[2])];
    const Vec3d outward{{facet->normal[0], facet->normal[1], facet->normal[2]}};
    if (dot(cross(b - a, c - a), outward) < 0) {
      std::swap(triangle[1], triangle[2]);
    }
    mesh.triangles.push_back(triangle);
  }

  qhT qh_{};
  std::vector<double> coordinates_;
  std::unordered_map<int, std::int32_t> corner_;
  bool failed_ = false;
};

/// The first of those that are farthest.
Vec3d farthest_from(const std::vector<Vec3d>& points, const Vec3d& from) {
  const Vec3d* farthest = points.data();
  double largest = dot(*farthest - from, *farthest - from);
  for (const Vec3d& point : points) {
    const Vec3d off = point - from;
    const double square = dot(off, off);
    if (largest < square) {
      largest = square;
      farthest = &point;
    }
  }
  return *farthest;
}

/// Unit vectors across `normal`, right-handed with it.
void span_plane(const Vec3d& normal, const Vec3d& along, Vec3d& u, Vec3d& v) {
  u = normalized(along - normal * dot(along, normal));
  v = cross(normal, u);
}

struct Range {
  double low = INFINITY;
  double high = -INFINITY;
  void add(double x) {
    low = std::fmin(low, x);
    high = std::fmax(high, x);
  }
  double size() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

/// The box with the axes (u, v, n) around the points.
double fit_box(const std::vector<Vec3d>& points, const std::array<Vec3d, 3>& axes,
               BoundingBox& best, double best_volume) {
  std::array<Range, 3> ranges;
  for (const Vec3d& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      ranges[i].add(dot(p, axes[i]));
    }
  }
  const double volume = ranges[0].size() * ranges[1].size() * ranges[2].size();
  if (volume >= best_volume) {
    return best_volume;
  }
  Mat3d rows;
  best.pose.position = {};
  for (std::size_t i = 0; i < 3; ++i) {
    rows[i] = axes[i].v;
    best.half_extents[i] = ranges[i].size() / 2;
    best.pose.position += axes[i] * ranges[i].middle();
  }
  best.pose.orientation = rotation_of(rows);
  return volume;
}

/// Grows `ball` to hold `p`, moving it as little as possible.
bool hold(const Vec3d& p, BoundingBall& ball) {
  const double distance = length(p - ball.center);
  if (distance <= ball.radius) {
    return false;
  }
  const double radius = (ball.radius + distance) / 2;
  ball.center += (p - ball.center) * ((radius - ball.radius) / distance);
  ball.radius = radius;
  return true;
}

}  // namespace

bool is_flat(const std::vector<Vec3d>& points) {
  if (points.size() < 4) {
    return true;
  }
  const Vec3d a = points.front();
  const Vec3d b = farthest_from(points, a);
  const double extent = length(b - a);
  const Vec3d along = normalized(b - a);
  Vec3d side;
  double side_length = 0;
  for (const Vec3d& p : points) {
    const Vec3d off = (p - a) - along * dot(p - a, along);
    if (length(off) > side_length) {
      side_length = length(off);
      side = off;
    }
  }
  if (side_length <= 1e-9 * extent) {
    return true;
  }
  const Vec3d normal = cross(along, normalized(side));
  return std::all_of(points.begin(), points.end(), [&](const Vec3d& p) {
    return std::fabs(dot(p - a, normal)) <= 1e-9 * extent;
  });
}

TriangleMesh convex_hull(const std::vector<Vec3d>& points) {
  TriangleMesh flat;
  flat.flat = true;
  if (is_flat(points)) {
    return flat;
  }
  const auto hull = std::make_unique<Qhull>(points);
  return hull->failed() ? flat : hull->triangles();
}

BoundingBox bounding_box(const std::vector<Vec3d>& points) {
  BoundingBox best;
  double volume = INFINITY;
  const TriangleMesh hull = convex_hull(points);
  const std::array<Vec3d, 3> upright{Vec3d{{1, 0, 0}}, Vec3d{{0, 1, 0}}, Vec3d{{0, 0, 1}}};
  volume = fit_box(points, upright, best, volume);
  for (const Vec3i& t : hull.triangles) {
    const Vec3d& a = hull.points[static_cast<std::size_t>(t[0])];
    const Vec3d& b = hull.points[static_cast<std::size_t>(t[1])];
    const Vec3d& c = hull.points[static_cast<std::size_t>(t[2])];
    const Vec3d normal = normalized(cross(b - a, c - a));
    for (const Vec3d& edge : {b - a, c - b, a - c}) {
      std::array<Vec3d, 3> axes;
      axes[2] = normal;
      span_plane(normal, edge, axes[0], axes[1]);
      volume = fit_box(hull.points, axes, best, volume * (1 - 1e-12));
    }
  }
  return best;
}

// Ritter's start, then shrinking and growing again until it no longer gets smaller.
BoundingBall bounding_ball(const std::vector<Vec3d>& all_points) {
  if (all_points.empty()) {
    return {};
  }
  const TriangleMesh hull = convex_hull(all_points);
  const std::vector<Vec3d>& points = hull.flat ? all_points : hull.points;
  const Vec3d a = farthest_from(points, points.front());
  const Vec3d b = farthest_from(points, a);
  BoundingBall best{(a + b) * 0.5, length(b - a) / 2};
  for (const Vec3d& p : points) {
    hold(p, best);
  }
  BoundingBall trial = best;
  for (int round = 0; round < 2000; ++round) {
    // Frank-Wolfe steps of the smallest-ball problem: toward the farthest point, ever smaller.
    const Vec3d far = farthest_from(points, trial.center);
    trial.center += (far - trial.center) * (1.0 / (round + 2));
    const double radius = length(farthest_from(points, trial.center) - trial.center);
    if (radius < best.radius) {
      best = {trial.center, radius};
    }
  }
  return best;
}

}  // namespace tenon::physics
