// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Overlaps and contacts are found by sweep and prune: solids sorted by their low x meet only those
// that begin before they end. World boxes come before the exact test. For overlaps the smaller
// solid of a pair is shrunk by a tenth, so that touching and resting contacts are none; for
// contacts each solid is grown, so that small gaps are none. Only convex shapes take part. Exact
// tests have a limit, as a heap of bodies in one place has millions of pairs.
#include "tenon/check/overlaps/overlaps.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tenon/check/overlaps/convex_overlap.h"

namespace tenon::check {
namespace {

using scene::Collider;
using scene::Index;
using scene::ShapeKind;

/// The smaller of two solids may reach this part of its size into the other.
constexpr double kDepth = 0.1;
constexpr double kLargestGap = 0.005;        ///< [m]
constexpr double kLift = 0.02;               ///< of the smaller solid, that one is moved by
constexpr std::size_t kMaxSteps = 50000000;  ///< of the sweep, where most shapes are side by side

Pose world_pose(const scene::PhysicsScene& scene, const Collider& collider) {
  return collider.body ? scene.bodies[*collider.body].pose * collider.pose : collider.pose;
}

Vec3d middle_of(const std::vector<Vec3d>& points) {
  Vec3d low = points.front();
  Vec3d high = low;
  for (const Vec3d& p : points) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::fmin(low[i], p[i]);
      high[i] = std::fmax(high[i], p[i]);
    }
  }
  return (low + high) * 0.5;
}

struct Placed {
  Index collider = 0;
  ConvexSolid solid;
  Vec3d low;
  Vec3d high;

  double size() const { return length(high - low); }
};

Placed placed_solid(const scene::PhysicsScene& scene, Index index) {
  const Collider& collider = scene.colliders[index];
  Placed item;
  item.collider = index;
  item.solid = {&collider.shape, nullptr, world_pose(scene, collider), {}, 1};
  if (collider.shape.kind == ShapeKind::ConvexHull) {
    item.solid.points = &scene.meshes[collider.shape.mesh].points;
    item.solid.middle = middle_of(*item.solid.points);
  }
  std::tie(item.low, item.high) = bounds_of(item.solid);
  return item;
}

/// A little larger, so that it reaches what it touches.
void grow(Placed& item, double gap) {
  const double half = item.size() / 2;
  if (half > 0) {
    item.solid.keep = 1 + std::fmin(gap * half, kLargestGap) / half;
    std::tie(item.low, item.high) = bounds_of(item.solid);
  }
}

/// Each grown by `gap` of its half diagonal.
std::vector<Placed> placed_solids(const scene::PhysicsScene& scene, double gap) {
  std::vector<Placed> placed;
  for (Index i = 0; i < scene.colliders.size(); ++i) {
    if (scene.colliders[i].enabled && is_convex(scene.colliders[i].shape)) {
      placed.push_back(placed_solid(scene, i));
      if (gap > 0) {
        grow(placed.back(), gap);
      }
    }
  }
  std::sort(placed.begin(), placed.end(),
            [](const Placed& a, const Placed& b) { return a.low[0] < b.low[0]; });
  return placed;
}

bool boxes_meet(const Placed& a, const Placed& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.high[i] < b.low[i] || b.high[i] < a.low[i]) {
      return false;
    }
  }
  return true;
}

/// Reaching into each other by more than what rounding and resting contacts explain.
bool reach_into(Placed a, Placed b) {
  (a.size() <= b.size() ? a : b).solid.keep = 1 - kDepth;
  return overlap(a.solid, b.solid);
}

/// The pairs that may collide, whose boxes meet and that are `near`.
template <class Near>
std::vector<ColliderPair> near_pairs(const scene::PhysicsScene& scene,
                                     const std::vector<Placed>& placed, std::size_t most,
                                     Near near) {
  std::vector<ColliderPair> found;
  std::size_t steps = 0;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < placed.size() && found.size() < most; ++i) {
    const Collider& a = scene.colliders[placed[i].collider];
    for (std::size_t j = i + 1; j < placed.size() && placed[j].low[0] <= placed[i].high[0]; ++j) {
      if (pairs >= kAllOverlaps || found.size() >= most || ++steps > kMaxSteps) {
        return found;
      }
      const Collider& b = scene.colliders[placed[j].collider];
      if ((!scene.is_dynamic(a.body) && !scene.is_dynamic(b.body)) ||
          !boxes_meet(placed[i], placed[j]) ||
          !scene.may_collide(placed[i].collider, placed[j].collider)) {
        continue;
      }
      ++pairs;
      if (near(placed[i], placed[j])) {
        const bool in_order = a.path < b.path;
        found.emplace_back(placed[in_order ? i : j].collider, placed[in_order ? j : i].collider);
      }
    }
  }
  return found;
}

/// The farthest point of the solid, shrunk by a tenth, is behind the surface of the plane.
bool is_below(const scene::PhysicsScene& scene, const Collider& plane, Placed item) {
  Vec3d up;
  up[static_cast<std::size_t>(plane.shape.axis)] = 1;
  const Pose pose = world_pose(scene, plane);
  up = rotate(pose.orientation, up);
  item.solid.keep = 1 - kDepth;
  return dot(item.solid.farthest(-up) - pose.position, up) < 0;
}

}  // namespace

std::vector<ColliderPair> overlaps_at_start(const scene::PhysicsScene& scene, std::size_t most) {
  return near_pairs(scene, placed_solids(scene, 0), most, reach_into);
}

std::vector<ColliderPair> below_planes_at_start(const scene::PhysicsScene& scene,
                                                std::size_t most) {
  std::vector<ColliderPair> found;
  std::vector<Placed> placed;
  for (Index i = 0; i < scene.colliders.size(); ++i) {
    const Collider& plane = scene.colliders[i];
    if (!plane.enabled || plane.shape.kind != ShapeKind::Plane || scene.is_dynamic(plane.body)) {
      continue;
    }
    if (placed.empty()) {
      placed = placed_solids(scene, 0);
    }
    for (const Placed& item : placed) {
      if (found.size() < most && scene.is_dynamic(scene.colliders[item.collider].body) &&
          scene.may_collide(i, item.collider) && is_below(scene, plane, item)) {
        found.emplace_back(item.collider, i);
      }
    }
  }
  return found;
}

std::vector<ColliderPair> contacts_at_start(const scene::PhysicsScene& scene, std::size_t most,
                                            double gap) {
  return near_pairs(scene, placed_solids(scene, gap), most,
                    [](const Placed& a, const Placed& b) { return overlap(a.solid, b.solid); });
}

bool rests_on(const scene::PhysicsScene& scene, Index upper, Index lower, const Vec3d& down) {
  Placed above = placed_solid(scene, upper);
  const Placed below = placed_solid(scene, lower);
  const Vec3d lift = down * (-kLift * std::fmin(above.size(), below.size()));
  const Vec3d at = above.solid.pose.position;
  above.solid.pose.position = at - lift;
  const bool presses = overlap(above.solid, below.solid);
  above.solid.pose.position = at + lift;
  return presses && !overlap(above.solid, below.solid);
}

}  // namespace tenon::check
