// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How far a body reaches along a direction is how far its convex colliders do, each by its farthest
// point: exact, and no mesh is walked but its hull.
#include "tenon/asset/benchmarking/benchmark_run.h"

#include <algorithm>
#include <utility>

#include "tenon/check/overlaps/convex_overlap.h"
#include "tenon/scene/shapes/convex_hull.h"

namespace tenon {
namespace {

using scene::Index;
using scene::ShapeKind;

/// Shapes whose hull is that of a collider.
std::vector<scene::Shape> convex_parts(const scene::Shape& shape) {
  if (shape.kind == ShapeKind::Plane) {
    return {};
  }
  std::vector<scene::Shape> parts(1, shape);
  if (shape.kind == ShapeKind::Mesh) {
    parts[0].kind = ShapeKind::ConvexHull;
  }
  if (!shape.pieces.empty()) {
    parts.assign(shape.pieces.size(), shape);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].mesh = shape.pieces[i];
    }
  }
  if (shape.kind == ShapeKind::Spheres) {
    parts.assign(shape.sphere_radii.size(), {});
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].kind = ShapeKind::Sphere;
      parts[i].radius = shape.sphere_radii[i];
    }
  }
  return parts;
}

}  // namespace

bool BenchmarkRun::go_on() {
  done += time_step;
  if (listener->go_on && !interrupted) {
    interrupted = !listener->go_on(std::min(done, planned), planned);
  }
  return !interrupted;
}

void Span::add(double value) {
  least = std::min(least, value);
  most = std::max(most, value);
}

Reach::Reach(const scene::PhysicsScene& scene, std::vector<Index> bodies)
    : bodies_(std::move(bodies)), parts_(scene.bodies.size()) {
  for (const scene::Body& body : scene.bodies) {
    centers_.push_back(body.center_of_mass);
  }
  for (const scene::Collider& collider : scene.colliders) {
    const std::vector<scene::Shape> shapes = collider.body && collider.enabled
                                                 ? convex_parts(collider.shape)
                                                 : std::vector<scene::Shape>();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      parts_[*collider.body].push_back({shapes[i], collider.pose, {}});
      Part& part = parts_[*collider.body].back();
      if (collider.shape.kind == ShapeKind::Spheres) {
        part.pose.position = transform_point(collider.pose, collider.shape.sphere_centers[i]);
      }
      if (shapes[i].kind == ShapeKind::ConvexHull) {
        part.points = scene::hull_points(scene.meshes[shapes[i].mesh].points).points;
      }
    }
  }
}

Span Reach::along(Index body, const Pose& pose, const Vec3d& direction) const {
  Span span;
  for (const Part& part : parts_[body]) {
    const check::ConvexSolid solid{&part.shape, &part.points, pose * part.pose, {}, 1};
    span.add(dot(solid.farthest(direction), direction));
    span.add(dot(solid.farthest(-direction), direction));
  }
  if (parts_[body].empty()) {
    span.add(dot(transform_point(pose, centers_[body]), direction));
  }
  return span;
}

Span Reach::along(const std::vector<Pose>& poses, const Vec3d& direction) const {
  Span span;
  for (const Index body : bodies_) {
    const Span one = along(body, poses[body], direction);
    span.add(one.least);
    span.add(one.most);
  }
  return span;
}

double Reach::diagonal(const std::vector<Pose>& poses) const {
  return length(Vec3d{{along(poses, {{1, 0, 0}}).size(), along(poses, {{0, 1, 0}}).size(),
                       along(poses, {{0, 0, 1}}).size()}});
}

std::vector<Pose> poses_of(const engines::Simulation& simulation,
                           const scene::PhysicsScene& scene) {
  std::vector<Pose> poses;
  for (Index body = 0; body < scene.bodies.size(); ++body) {
    poses.push_back(simulation.body_state(body).pose);
  }
  return poses;
}

void judge_row(BenchmarkRow& row, std::string_view measure, double measured, double threshold,
               std::string_view unit, const std::string& reason) {
  row.measure = measure;
  row.measured = measured;
  row.threshold = threshold;
  row.unit = unit;
  if (!(measured <= threshold)) {
    fail_row(row, reason);
  }
}

void fail_row(BenchmarkRow& row, const std::string& reason) {
  row.verdict = BenchmarkVerdict::Fail;
  row.reason = reason;
}

BenchmarkResult skipped_test(BenchmarkTest test, std::string reason) {
  return {test, BenchmarkVerdict::Skipped, std::move(reason), {}};
}

BenchmarkResult blocked_test(BenchmarkTest test, const Error& why) {
  return {test, BenchmarkVerdict::Blocked, why.message(), {}};
}

BenchmarkResult test_result(BenchmarkTest test, std::vector<BenchmarkRow> rows) {
  // What decides comes first: failures, and of equals the nearest to its threshold.
  const auto rank = [](const BenchmarkRow& row) {
    const double share = row.threshold > 0 ? row.measured / row.threshold : 0;
    return std::pair(row.verdict == BenchmarkVerdict::Fail, share);
  };
  std::stable_sort(rows.begin(), rows.end(), [&](const auto& first, const auto& second) {
    return rank(first) > rank(second);
  });
  const BenchmarkVerdict verdict = rows.front().verdict;
  return {test, verdict, "", std::move(rows)};
}

}  // namespace tenon
