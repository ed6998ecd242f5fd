// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Hulls come from Qhull (reentrant library), told to triangulate its facets. Qhull cannot work on
// flat input, so flatness is tested first. Where many points lie in one face, as in a disk of
// 100,000 corners, it merges facets in a time that grows with their square (10,000: 1.5 s). Told to
// joggle its input instead (by some 1e-11 of the size) it merges none and takes 0.6 s for those
// 100,000. That tells the corners, and triangles good enough to integrate over: where points lie in
// one plane they may be slivers.
#include "tenon/scene/shapes/convex_hull.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <unordered_map>

#include "tenon/base/limits/physics_limits.h"

namespace tenon::scene {
namespace {

/// Files that Qhull writes its remarks to; they are not read.
std::FILE* nowhere() {
  static std::FILE* const file = std::fopen("/dev/null", "w");
  return file;
}

enum class Facets { Merged, Joggled };

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

std::array<Range, 3> ranges_of(const std::vector<Vec3d>& points) {
  std::array<Range, 3> ranges;
  for (const Vec3d& p : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ranges[axis].add(p[axis]);
    }
  }
  return ranges;
}

Vec3d middle_of(const std::vector<Vec3d>& points) {
  const std::array<Range, 3> ranges = ranges_of(points);
  return {{ranges[0].middle(), ranges[1].middle(), ranges[2].middle()}};
}

class Qhull {
 public:
  /// Refers to the points.
  Qhull(const std::vector<Vec3d>& points, Facets facets) : points_(points) {
    // How far is joggled goes with the largest coordinate.
    const Vec3d middle = facets == Facets::Joggled ? middle_of(points) : Vec3d{};
    coordinates_.reserve(points.size() * 3);
    for (const Vec3d& p : points) {
      const Vec3d from_middle = p - middle;
      coordinates_.insert(coordinates_.end(), from_middle.v.begin(), from_middle.v.end());
    }
    qh_zero(&qh_, nowhere());
    char merged[] = "qhull Qt Pp";
    char joggled[] = "qhull QJ Pp";
    char* options = facets == Facets::Merged ? merged : joggled;
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

  /// The points that are corners, in their order.
  std::vector<Vec3d> corners() {
    std::vector<std::size_t> numbers;
    for (vertexT* vertex = qh_.vertex_list; vertex != nullptr && vertex->next != nullptr;
         vertex = vertex->next) {
      numbers.push_back(number_of(*vertex));
    }
    std::sort(numbers.begin(), numbers.end());
    std::vector<Vec3d> corners;
    for (const std::size_t number : numbers) {
      corners.push_back(points_[number]);
    }
    return corners;
  }

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
    std::array<Vec3d, 3> seen;  // where Qhull has them: joggled, slivers have a side, too
    for (int i = 0; i < 3; ++i) {
      const auto* vertex = static_cast<const vertexT*>(facet->vertices->e[i].p);
      const std::size_t number = number_of(*vertex);
      const auto added = corner_.emplace(number, static_cast<std::int32_t>(mesh.points.size()));
      if (added.second) {
        mesh.points.push_back(points_[number]);
      }
      triangle[static_cast<std::size_t>(i)] = added.first->second;
      seen[static_cast<std::size_t>(i)] = {{vertex->point[0], vertex->point[1], vertex->point[2]}};
    }
    const Vec3d outward{{facet->normal[0], facet->normal[1], facet->normal[2]}};
    if (dot(cross(seen[1] - seen[0], seen[2] - seen[0]), outward) < 0) {
      std::swap(triangle[1], triangle[2]);
    }
    mesh.triangles.push_back(triangle);
  }

  std::size_t number_of(const vertexT& vertex) {
    return static_cast<std::size_t>(std::max(0, qh_pointid(&qh_, vertex.point)));
  }

  const std::vector<Vec3d>& points_;
  qhT qh_{};
  std::vector<double> coordinates_;
  std::unordered_map<std::size_t, std::int32_t> corner_;
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

/// Cells of a grid across the points, to pick the fewest that represent all.
constexpr std::size_t kCells = 40;
constexpr std::size_t kBoxCells = 12;  // kept few: boxes on all their triangles are tried
/// Up to so many points Qhull merges facets: 10 ms at most.
constexpr std::size_t kMergedPoints = 1000;
static_assert(6 * kCells * kCells <= limits::kHullPoints);
static_assert(6 * kBoxCells * kBoxCells <= kMergedPoints);

/// The points that lie outermost along an axis in each column of cells, of all three axes.
std::vector<Vec3d> outermost(const std::vector<Vec3d>& points, std::size_t cells) {
  const std::array<Range, 3> ranges = ranges_of(points);
  const auto cell = [&](const Vec3d& p, std::size_t axis) {
    const double place =
        (p[axis] - ranges[axis].low) / ranges[axis].size() * static_cast<double>(cells);
    const bool inside = place >= 0 && place < static_cast<double>(cells);  // false: NaN, the end
    return inside ? static_cast<std::size_t>(place) : cells - 1;
  };
  constexpr std::size_t kEmpty = static_cast<std::size_t>(-1);
  std::vector<std::size_t> kept(6 * cells * cells, kEmpty);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t column =
          cell(points[i], (axis + 1) % 3) * cells + cell(points[i], (axis + 2) % 3);
      std::size_t& low = kept[2 * (axis * cells * cells + column)];
      std::size_t& high = kept[2 * (axis * cells * cells + column) + 1];
      low = low == kEmpty || points[i][axis] < points[low][axis] ? i : low;
      high = high == kEmpty || points[i][axis] > points[high][axis] ? i : high;
    }
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  std::vector<Vec3d> result;
  for (const std::size_t i : kept) {
    if (i != kEmpty) {
      result.push_back(points[i]);
    }
  }
  return result;
}

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

HullPoints hull_points(const std::vector<Vec3d>& points) {
  if (points.size() <= limits::kHullPoints) {
    return {points, false};
  }
  std::vector<Vec3d> corners;
  if (!is_flat(points)) {
    const auto hull = std::make_unique<Qhull>(points, Facets::Joggled);
    corners = hull->failed() ? corners : hull->corners();
  }
  if (!corners.empty() && corners.size() <= limits::kHullPoints) {
    return {std::move(corners), false};
  }
  return {outermost(corners.empty() ? points : corners, kCells), true};
}

TriangleMesh convex_hull(const std::vector<Vec3d>& points) {
  TriangleMesh flat;
  flat.flat = true;
  if (is_flat(points)) {
    return flat;
  }
  const bool many = points.size() > kMergedPoints;
  const auto hull = std::make_unique<Qhull>(points, many ? Facets::Joggled : Facets::Merged);
  if (hull->failed()) {
    return flat;
  }
  const std::vector<Vec3d> corners = many ? hull->corners() : std::vector<Vec3d>();
  return !many || corners.size() > kMergedPoints ? hull->triangles() : convex_hull(corners);
}

BoundingBox bounding_box(const std::vector<Vec3d>& points) {
  BoundingBox best;
  double volume = INFINITY;
  const TriangleMesh hull = convex_hull(points);
  const std::array<Vec3d, 3> upright{Vec3d{{1, 0, 0}}, Vec3d{{0, 1, 0}}, Vec3d{{0, 0, 1}}};
  volume = fit_box(points, upright, best, volume);
  std::array<Vec3d, 3> best_axes = upright;
  const bool many = hull.points.size() > kMergedPoints;  // slivers have no normals
  const TriangleMesh& tried = many ? convex_hull(outermost(hull.points, kBoxCells)) : hull;
  for (const Vec3i& t : tried.triangles) {
    const Vec3d& a = tried.points[static_cast<std::size_t>(t[0])];
    const Vec3d& b = tried.points[static_cast<std::size_t>(t[1])];
    const Vec3d& c = tried.points[static_cast<std::size_t>(t[2])];
    const Vec3d normal = normalized(cross(b - a, c - a));
    for (const Vec3d& edge : {b - a, c - b, a - c}) {
      std::array<Vec3d, 3> axes;
      axes[2] = normal;
      span_plane(normal, edge, axes[0], axes[1]);
      const double fitted = fit_box(tried.points, axes, best, volume * (1 - 1e-12));
      best_axes = fitted < volume * (1 - 1e-12) ? axes : best_axes;
      volume = fitted;
    }
  }
  if (points.size() > kMergedPoints) {  // those that were not tried are to be held, too
    fit_box(points, best_axes, best, INFINITY);
  }
  return best;
}

// Ritter's start, then shrinking and growing again until it no longer gets smaller.
BoundingBall bounding_ball(const std::vector<Vec3d>& all_points) {
  if (all_points.empty()) {
    return {};
  }
  const TriangleMesh hull = convex_hull(all_points);
  const std::vector<Vec3d>& corners = hull.points.empty() ? all_points : hull.points;
  const bool many = corners.size() > kMergedPoints;
  const std::vector<Vec3d> points = many ? outermost(corners, kCells) : corners;
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
  for (std::size_t i = 0; all_points.size() > kMergedPoints && i < all_points.size(); ++i) {
    hold(all_points[i], best);  // those that were not tried, too
  }
  return best;
}

}  // namespace tenon::scene
