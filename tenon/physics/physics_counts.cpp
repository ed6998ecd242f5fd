// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/physics_counts.h"

#include <numeric>
#include <vector>

namespace tenon::physics {
namespace {

/// Disjoint sets of bodies; the last element is the world.
class Parts {
 public:
  explicit Parts(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) {
      parent_[i] = parent_[parent_[i]];
      i = parent_[i];
    }
    return i;
  }
  /// False when both were in one part already.
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> parent_;
};

bool is_bounded(const Limit& limit) {
  return limit.locked() || limit.lower > -kUnlimited || limit.upper < kUnlimited;
}

std::size_t count_limits(const Joint& joint) {
  std::size_t count = 0;
  const bool has_own = joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic ||
                       joint.kind == JointKind::Distance;
  if (has_own && is_bounded({joint.dof(), joint.lower, joint.upper})) {
    ++count;
  }
  if (joint.kind == JointKind::Spherical) {
    count += joint.cone_angle0 < kUnlimited || joint.cone_angle1 < kUnlimited ? 1u : 0u;
  }
  for (const Limit& limit : joint.limits) {
    count += is_bounded(limit) ? 1u : 0u;
  }
  return count;
}

std::size_t count_dofs(const PhysicsScene& scene) {
  const std::size_t world = scene.bodies.size();
  Parts parts(world + 1);
  std::size_t dofs = 0;
  for (std::size_t i = 0; i < world; ++i) {
    if (scene.bodies[i].kinematic) {
      parts.join(i, world);
    }
  }
  for (const Joint& joint : scene.joints) {
    const bool spans = joint.enabled && joint.kind != JointKind::Distance &&
                       !(joint.kind == JointKind::D6 && free_dofs(joint) == 6);
    if (spans && parts.join(joint.body0.value_or(static_cast<Index>(world)),
                            joint.body1.value_or(static_cast<Index>(world)))) {
      dofs += free_dofs(joint);
    }
  }
  for (std::size_t i = 0; i < world; ++i) {
    dofs += parts.find(i) == i && parts.find(world) != i ? 6u : 0u;
  }
  return dofs;
}

}  // namespace

std::size_t free_dofs(const Joint& joint) {
  switch (joint.kind) {
    case JointKind::Revolute:
    case JointKind::Prismatic:
      return 1;
    case JointKind::Spherical:
      return 3;
    case JointKind::Fixed:
      return 0;
    case JointKind::Distance:
      return 6;
    case JointKind::D6:
      break;
  }
  std::size_t free = 6;
  for (const Limit& limit : joint.limits) {
    const bool fixed = limit.locked() || limit.lower == limit.upper;
    free -= limit.dof != Dof::Distance && fixed ? 1u : 0u;
  }
  return free;
}

PhysicsCounts count_physics(const PhysicsScene& scene) {
  PhysicsCounts counts;
  for (const Scene& s : scene.scenes) {
    counts.scenes += s.path.empty() ? 0u : 1u;
  }
  for (const Body& body : scene.bodies) {
    ++counts.bodies;
    counts.kinematic_bodies += body.kinematic ? 1u : 0u;
    counts.mass += body.kinematic ? 0 : body.mass;
  }
  for (const Collider& collider : scene.colliders) {
    if (collider.enabled) {
      ++counts.colliders;
      counts.static_colliders += collider.body ? 0u : 1u;
    }
  }
  for (const Joint& joint : scene.joints) {
    if (joint.enabled) {
      ++counts.joints[static_cast<std::size_t>(joint.kind)];
      counts.drives += joint.drives.size();
      counts.limits += count_limits(joint);
      counts.mimics += joint.mimic ? 1u : 0u;
    }
  }
  counts.articulations = scene.articulations.size();
  counts.dofs = count_dofs(scene);
  return counts;
}

}  // namespace tenon::physics
