// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/jolt/model.h"
#include "tenon/engines/steering.h"

namespace tenon::engines::jolt {

/// The inputs of Jolt before every step: drives, bodies and colliders that follow the asset's
/// samples, forces on bodies and along coordinates, and the laws of joints.
class StepInputs {
 public:
  StepInputs() = default;
  explicit StepInputs(const scene::PhysicsScene& scene);

  /// `now` [s] is the beginning of the step.
  void before_step(const Model& model, const Steering& steering, double now) const;
  /// The drives of a joint with what samples and the user say of them, written at once.
  void steer_drives(scene::Index joint, const Model& model, const Steering& steering,
                    double now) const;

 private:
  void move_bodies(const Model& model, const Steering& steering, double at) const;
  void push_bodies(const Model& model, const Steering& steering) const;
  void push_coordinates(const Model& model, const Steering& steering) const;
  void push(const Model& model, scene::Index body, const Wrench& wrench) const;

  const scene::PhysicsScene* scene_ = nullptr;
  std::vector<scene::Index> tracked_;     ///< joints whose drives follow samples
  std::vector<scene::Index> pushed_;      ///< bodies with constant forces
  std::vector<scene::Index> kinematics_;  ///< bodies
};

}  // namespace tenon::engines::jolt
