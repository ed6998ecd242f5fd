// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/run/breaking.h"
#include "tenon/engines/mujoco/run/moving_bounds.h"
#include "tenon/engines/mujoco/run/step_inputs.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/timeline/timeline.h"

namespace tenon::engines::mujoco {

/// Steps one model. Reading the state brings MuJoCo's derived poses up to date on first use after a
/// step, so one object belongs to one thread at a time.
class MujocoSimulation final : public Simulation {
 public:
  /// `scene` must outlive the simulation. Errors are those of build_model.
  static Result<std::unique_ptr<MujocoSimulation>> make(const scene::PhysicsScene& scene,
                                                        const SimulationOptions& options,
                                                        Diagnostics& diagnostics);

  Result<void> step() override;
  double time() const override;
  double time_step() const override;
  BodyState body_state(scene::Index body) const override;
  JointState joint_state(scene::Index joint) const override;
  Energy energy() const override;
  std::size_t contact_count() const override;
  std::size_t dof_count() const override;
  const std::vector<NotMapped>& not_mapped() const override { return not_mapped_; }
  const std::vector<Event>& events() const override { return events_; }

  /// The engine's own objects, for tests and benchmarks.
  const mjModel& engine_model() const { return *model_.model; }
  const mjData& engine_data() const { return *model_.data; }

 private:
  MujocoSimulation(const scene::PhysicsScene& scene, std::unique_ptr<scene::Timeline> timeline,
                   Model model);
  void connect();
  Result<void> follow_changes();
  Result<void> rebuild();
  Result<void> break_joints();
  void advance();
  Result<void> check() const;
  Error unstable(int warning) const;
  void bring_up_to_date() const;

  std::unique_ptr<scene::Timeline> timeline_;  ///< where the scene may change, else null
  const scene::PhysicsScene* scene_;           ///< as it is now: the timeline's, or what was given
  Model model_;
  std::vector<NotMapped> not_mapped_;  ///< of the first model
  std::vector<Event> events_;
  StepInputs inputs_;
  MovingBounds bounds_;
  Breaking breaking_;
  mutable bool stale_ = true;
};

}  // namespace tenon::engines::mujoco
