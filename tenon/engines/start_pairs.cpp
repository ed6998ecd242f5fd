// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Sweep and prune along the axis on which the middles are farthest apart. The sweep itself has a
// bound: where it is met, nothing is refused.
#include "tenon/engines/start_pairs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/limits/engine_limits.h"

namespace tenon::engines {
namespace {

using scene::Collider;
using scene::Index;
using scene::Shape;
using scene::ShapeKind;

constexpr std::size_t kSweepWork = 200'000'000;  // boxes looked at
constexpr std::size_t kFilterWork = 40;          // of a pair whose filters are looked at

struct Box {
  Vec3d low{{kInfinity, kInfinity, kInfinity}};
  Vec3d high{{-kInfinity, -kInfinity, -kInfinity}};

  void add(const Vec3d& point, double radius = 0) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k] - radius);
      high[k] = std::max(high[k], point[k] + radius);
    }
  }
};

struct PlacedBox {
  Box box;
  Index collider = 0;
};

class StartPairs {
 public:
  explicit StartPairs(const scene::PhysicsScene& scene)
      : scene_(scene),
        of_mesh_(scene.meshes.size()),
        most_(limits::kStartPairs + limits::kStartPairsPerCollider * scene.colliders.size()) {}

  Result<void> check() {
    for (Index i = 0; i < scene_.colliders.size(); ++i) {
      if (scene_.colliders[i].enabled) {
        boxes_.push_back({world_box(scene_.colliders[i]), i});
      }
    }
    if (boxes_.size() * boxes_.size() / 2 <= most_) {
      return {};
    }
    sweep(longest_axis());
    return count_ > most_ ? Result<void>(too_many()) : Result<void>();
  }

 private:
  const Box& mesh_box(Index mesh) {
    std::optional<Box>& box = of_mesh_[mesh];
    if (!box) {
      box.emplace();
      for (const Vec3d& point : scene_.meshes[mesh].points) {
        box->add(point);
      }
    }
    return *box;
  }

  Box local_box(const Shape& shape) {
    Box box;
    switch (shape.kind) {
      case ShapeKind::Plane:
        box.add({}, kInfinity);
        break;
      case ShapeKind::Mesh:
      case ShapeKind::ConvexHull:
        return mesh_box(shape.mesh);
      case ShapeKind::Spheres:
        for (std::size_t i = 0; i < shape.sphere_centers.size(); ++i) {
          box.add(shape.sphere_centers[i], shape.sphere_radii[i]);
        }
        break;
      case ShapeKind::Box:
      case ShapeKind::Ellipsoid:
        box.add(shape.half_extents);
        box.add(-shape.half_extents);
        break;
      default: {
        Vec3d half{{shape.radius, shape.radius, shape.radius}};
        const auto axis = static_cast<std::size_t>(shape.axis);
        const double end = shape.kind == ShapeKind::Capsule ? shape.radius : 0;
        half[axis] = shape.kind == ShapeKind::Sphere ? shape.radius : shape.half_height + end;
        box.add(half);
        box.add(-half);
      }
    }
    return box;
  }

  Box world_box(const Collider& collider) {
    const Box local = local_box(collider.shape);
    const Pose pose =
        collider.body ? scene_.bodies[*collider.body].pose * collider.pose : collider.pose;
    if (!(length(local.high) < kInfinity) || !(length(local.low) < kInfinity)) {
      return collider.shape.kind == ShapeKind::Plane ? local : Box();  // no points: meets nothing
    }
    Box box;
    for (unsigned corner = 0; corner < 8; ++corner) {
      Vec3d point;
      for (std::size_t k = 0; k < 3; ++k) {
        point[k] = (corner >> k & 1u) != 0 ? local.high[k] : local.low[k];
      }
      box.add(pose.position + rotate(pose.orientation, point));
    }
    return box;
  }

  std::size_t longest_axis() const {
    Box middles;
    for (const PlacedBox& placed : boxes_) {
      const Vec3d middle = (placed.box.low + placed.box.high) * 0.5;
      if (is_finite(middle)) {
        middles.add(middle);
      }
    }
    const Vec3d size = middles.high - middles.low;
    return static_cast<std::size_t>(std::max_element(size.v.begin(), size.v.end()) -
                                    size.v.begin());
  }

  bool may_meet(Index a, Index b) const {
    const auto moves = [this](Index collider) {
      return scene_.is_dynamic(scene_.colliders[collider].body);
    };
    return (moves(a) || moves(b)) && scene_.may_meet(a, b);
  }

  void sweep(std::size_t axis) {
    std::sort(boxes_.begin(), boxes_.end(), [axis](const PlacedBox& a, const PlacedBox& b) {
      return a.box.low[axis] < b.box.low[axis];
    });
    std::vector<std::size_t> pairs_of(scene_.colliders.size());
    std::size_t work = 0;
    for (std::size_t i = 0; i < boxes_.size() && count_ <= most_; ++i) {
      const PlacedBox& one = boxes_[i];
      for (std::size_t j = i + 1; j < boxes_.size() && work < kSweepWork; ++j) {
        const PlacedBox& other = boxes_[j];
        if (other.box.low[axis] > one.box.high[axis]) {
          break;
        }
        ++work;
        if (!overlap(one.box, other.box)) {
          continue;
        }
        work += kFilterWork;
        if (may_meet(one.collider, other.collider)) {
          ++count_;
          ++pairs_of[one.collider];
          ++pairs_of[other.collider];
        }
      }
    }
    worst_ =
        static_cast<Index>(std::max_element(pairs_of.begin(), pairs_of.end()) - pairs_of.begin());
  }

  static bool overlap(const Box& a, const Box& b) {
    bool all = true;
    for (std::size_t k = 0; k < 3; ++k) {
      all = all && a.low[k] <= b.high[k] && b.low[k] <= a.high[k];
    }
    return all;
  }

  Error too_many() const {
    return Error(ErrorCode::Limit,
                 "at the start more than " + std::to_string(most_) +
                     " pairs of colliders are inside each other or nearly so (kStartPairs), most "
                     "of them with this one")
        .with_prim(scene_.colliders[worst_].path.str())
        .with_rule("engine.start-pairs")
        .with_fix("move the bodies apart, or let collision groups filter what need not touch");
  }

  const scene::PhysicsScene& scene_;
  std::vector<std::optional<Box>> of_mesh_;
  std::size_t most_;
  std::vector<PlacedBox> boxes_;
  std::size_t count_ = 0;
  Index worst_ = 0;
};

}  // namespace

Result<void> check_start_pairs(const scene::PhysicsScene& scene) {
  return StartPairs(scene).check();
}

}  // namespace tenon::engines
