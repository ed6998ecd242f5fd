// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/physx/run/step_inputs.h"
#include "tenon/engines/physx/run/step_motion.h"

namespace tenon::engines::physx {

/// The outputs that are computed after every step on request.
class StepOutputs {
 public:
  StepOutputs() = default;
  explicit StepOutputs(const Outputs& wanted) : wanted_(wanted) {}

  /// Whether an output is computed from the motion.
  bool follows_motion() const {
    return wanted_.accelerations || wanted_.reactions || wanted_.work || wanted_.efforts;
  }
  /// Before a step; read_caches() must have run.
  void begin(const scene::PhysicsScene& scene, const Model& model);
  /// After it; read_caches() must have run. `now` [s] is its beginning.
  void end(const scene::PhysicsScene& scene, const Model& model, const StepInputs& inputs,
           const Steering& steering, const std::vector<Contact>& contacts, double now);
  /// Energy [J] that came in from outside of steps.
  void add_change(double energy) { work_.changes += energy; }

  const Wrench& reaction(scene::Index joint) const { return reactions_[joint]; }
  const std::vector<double>& efforts(scene::Index joint) const { return efforts_[joint]; }
  BodyAcceleration body_acceleration(scene::Index body, double time_step) const;
  std::vector<double> joint_acceleration(scene::Index joint, double time_step) const;
  const Work& work() const { return work_; }
  bool has_step() const { return has_step_; }

 private:
  void add_work(const StepMotion& step, const StepInputs& inputs, const Steering& steering);
  void add_joint_work(const StepMotion& step, scene::Index joint, const Steering& steering);

  Outputs wanted_;
  Motion before_;
  Motion after_;
  std::vector<Wrench> reactions_;             ///< (joint_count)
  std::vector<std::vector<double>> efforts_;  ///< (joint_count x drive_count)
  Work work_;
  bool has_step_ = false;
};

}  // namespace tenon::engines::physx
