// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/physx/model.h"
#include "tenon/engines/physx/run/fixed_tendons.h"
#include "tenon/engines/steering.h"

namespace tenon::engines::physx {

/// The inputs of PhysX before every step: drives, bodies and colliders that follow the asset's
/// samples, forces on bodies and coordinates. Nothing in most scenes.
class StepInputs {
 public:
  StepInputs() = default;
  explicit StepInputs(const scene::PhysicsScene& scene);

  /// `now` [s] is the beginning of the step.
  void before_step(Model& model, const Steering& steering, double now);
  /// The drives of a joint with what the user has set of them, written at once.
  void steer_drive(scene::Index joint, Model& model, const Steering& steering, double now);
  /// One drive with what samples and the user say of it.
  scene::Drive drive_now(scene::Index joint, scene::Index drive, const Steering& steering,
                         double now) const;
  /// A joint with what samples and the user say of its drives, springs and friction.
  scene::Joint joint_now(scene::Index joint, const Steering& steering, double now) const;

  // What was given for the last step.

  /// Forces and torques from outside, at the centres of mass (body_count).
  const std::vector<Wrench>& applied() const { return applied_; }
  /// Efforts of joints that are no coordinates, on body 1 about frame 1 (joint_count).
  const std::vector<Wrench>& joint_pushes() const { return joint_pushes_; }

 private:
  void follow_drive_tracks(Model& model, const Steering& steering, double now);
  void move_bodies(const Model& model, const Steering& steering, double at) const;
  void push_bodies(const Model& model, const Steering& steering);
  void push_coordinates(Model& model, const Steering& steering);
  void push_constraint(const Model& model, scene::Index joint, const std::vector<double>& efforts);
  void push(const Model& model, scene::Index body, const Wrench& wrench) const;
  void apply(const Model& model, scene::Index body, const Wrench& wrench);

  const scene::PhysicsScene* scene_ = nullptr;
  std::vector<scene::Index> tracked_;  ///< joints whose drives follow samples, ascending
  std::vector<scene::Index> pushed_;
  FixedTendons tendons_;
  std::vector<Wrench> applied_;
  std::vector<Wrench> joint_pushes_;
  bool has_pushes_ = false;  ///< something of the two lists above is not 0
  bool has_forces_ = false;  ///< forces of coordinates hold until they are set again
};

}  // namespace tenon::engines::physx
