// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/build/tree_plan.h"

#include "tenon/scene/joint_freedom.h"

namespace tenon::engines::mujoco {
namespace {

using scene::ForestRole;
using scene::Index;
using scene::Joint;
using scene::JointKind;
using scene::PhysicsScene;

JointRole loop_role(const Joint& joint) {
  if (!scene::is_held_by_frames(joint)) {
    return JointRole::Auxiliary;
  }
  switch (joint.kind) {
    case JointKind::Fixed:
      return JointRole::Weld;
    case JointKind::Spherical:
      return JointRole::Connect;
    case JointKind::Revolute:
      return JointRole::Hinge;
    case JointKind::Prismatic:
    case JointKind::Distance:
    case JointKind::D6:
      break;
  }
  return JointRole::Auxiliary;
}

/// The joint holds frames, of which one can move. Distance joints are bounds of their own.
bool holds_frames(const PhysicsScene& scene, const Joint& joint) {
  return joint.kind != JointKind::Distance &&
         !(joint.kind == JointKind::D6 && scene::is_plain(joint)) &&
         (scene.is_dynamic(joint.body0) || scene.is_dynamic(joint.body1));
}

BodyBase base_of(const scene::Body& body, const scene::ForestBody& link) {
  if (link.joint) {
    return BodyBase::Jointed;
  }
  return body.kinematic ? BodyBase::Fixed : BodyBase::Free;
}

JointRole role_of(const PhysicsScene& scene, const Joint& joint, ForestRole role) {
  switch (role) {
    case ForestRole::None:
      break;
    case ForestRole::Tree:
      return JointRole::Tree;
    case ForestRole::Loop:
      return holds_frames(scene, joint) ? loop_role(joint) : JointRole::None;
  }
  return JointRole::None;
}

}  // namespace

TreePlan plan_tree(const PhysicsScene& scene) {
  TreePlan plan;
  plan.forest = scene::joint_forest(scene);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    plan.bases.push_back(base_of(scene.bodies[b], plan.forest.bodies[b]));
  }
  for (const scene::PoseTrack& track : scene.pose_tracks) {
    const bool drives = track.body.has_value() && scene.bodies[*track.body].kinematic &&
                        scene.bodies[*track.body].enabled;
    if (drives && !track.times.empty()) {
      plan.bases[*track.body] = BodyBase::Driven;
    }
  }
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    plan.joints.push_back(role_of(scene, scene.joints[j], plan.forest.joints[j]));
  }
  return plan;
}

}  // namespace tenon::engines::mujoco
