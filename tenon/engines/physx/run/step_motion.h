// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tenon/engines/physx/model.h"

namespace tenon::engines::physx {

/// How bodies and joints stood and moved at one time.
struct Motion {
  std::vector<BodyState> bodies;   ///< (body_count)
  std::vector<JointState> joints;  ///< (joint_count)
};
/// read_caches() must have run.
Motion read_motion(const scene::PhysicsScene& scene, const Model& model);

/// One step from its beginning to its end, and the known forces of it.
struct StepMotion {
  const scene::PhysicsScene& scene;
  const Model& model;
  const Motion& before;
  const Motion& after;
  const std::vector<Contact>& contacts;
  std::span<const Wrench> applied;       ///< on bodies from outside, at their centres (body_count)
  std::span<const Wrench> joint_pushes;  ///< efforts on body 1 about frame 1 (joint_count)
  std::span<const Vec3d> gravity;        ///< (scene_count) [m/s^2]

  bool moves_freely(scene::Index body) const { return !scene.bodies[body].kinematic; }
  /// The centre of mass where the step begins.
  Vec3d center(scene::Index body) const;
  /// Mean velocity during the step of the point of a body, or of the world, that is at `point`
  /// where the step begins.
  Vec3d mean_velocity(const std::optional<scene::Index>& body, const Vec3d& point) const;
  Vec3d mean_turn(const std::optional<scene::Index>& body) const;
  /// Origin of frame 1 of a joint where the step begins.
  Vec3d joint_origin(scene::Index joint) const;
};

/// What each body needed beside its weight, what was applied, its damping and its contacts to move
/// as it did: a wrench about the origin of the world (body_count).
std::vector<Wrench> unexplained_wrenches(const StepMotion& step);

/// What body 0 exerts on body 1 through each joint: force and torque about the origin of frame 1
/// (joint_count).
std::vector<Wrench> joint_reactions(const StepMotion& step);

/// What the damping of a body exerts at its centre of mass.
Wrench damping_wrench(const StepMotion& step, scene::Index body);

}  // namespace tenon::engines::physx
