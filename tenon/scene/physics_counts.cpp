// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/physics_counts.h"

#include "tenon/scene/joint_forest.h"

namespace tenon::scene {
namespace {

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
  const JointForest forest = joint_forest(scene);
  std::size_t dofs = 0;
  for (const ForestBody& body : forest.bodies) {
    dofs += body.joint ? free_dofs(scene.joints[*body.joint]) : 0u;
  }
  for (const Index root : forest.roots) {
    dofs += forest.bodies[root].fixed ? 0u : 6u;
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
      counts.mimics += joint.mimics.size();
    }
  }
  counts.articulations = scene.articulations.size();
  counts.dofs = count_dofs(scene);
  return counts;
}

}  // namespace tenon::scene
