// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/run/joint_reactions.h"
#include "tenon/engines/steering.h"

namespace tenon::engines::mujoco {

/// The outputs of a step beside the state, computed as far as requested.
class StepOutputs {
 public:
  StepOutputs() = default;
  StepOutputs(const Outputs& wanted, const scene::PhysicsScene& scene, const Model& model);

  /// Before MuJoCo advances; inputs are written.
  void begin(const scene::PhysicsScene& scene, const Model& model);
  /// After it has, before derive_motion().
  Result<void> end(const scene::PhysicsScene& scene, const Steering& steering, const Model& model);
  /// After mj_forward, where no step was made.
  Result<void> at_rest(const scene::PhysicsScene& scene, const Model& model);

  Work work;
  std::vector<Contact> contacts;
  std::vector<double> drive_efforts;        ///< as Model::drives [N, N m]
  std::vector<Wrench> reactions;            ///< (joint_count)
  std::vector<BodyAcceleration> bodies;     ///< (body_count)
  std::vector<JointState> joints_at_begin;  ///< (joint_count)

 private:
  struct Forces {
    std::vector<double> mean_velocity;  ///< of the step; 0 for driven bodies (dof_count)
    std::vector<double> damping;        ///< (dof_count)
    std::vector<double> drives;         ///< (dof_count)
  };
  Forces forces_of_step(const Model& model) const;
  void add_work(const scene::PhysicsScene& scene, const Steering& steering, const Model& model,
                const Forces& forces);
  void add_wrench_work(const scene::PhysicsScene& scene, const Steering& steering,
                       const Model& model, const Forces& forces);
  void read_contacts(const scene::PhysicsScene& scene, const Model& model);
  void read_drives(const Model& model, const Forces& forces);
  Result<void> read_dynamics(const scene::PhysicsScene& scene, const Model& model,
                             const std::vector<double>& acceleration,
                             const std::vector<double>& velocity);

  Outputs wanted_;
  std::vector<JointCarriers> carriers_;
  std::vector<double> position_;   ///< at the beginning (qpos)
  std::vector<double> velocity_;   ///< (dof_count)
  std::vector<char> driven_;       ///< coordinates of bodies that follow poses (dof_count)
  std::vector<int> drive_of_dof_;  ///< how many drives act (dof_count)
};

}  // namespace tenon::engines::mujoco
