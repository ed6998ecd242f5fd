// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/jolt/model.h"
#include "tenon/engines/jolt/run/slow_turns.h"
#include "tenon/engines/jolt/run/step_inputs.h"
#include "tenon/engines/rebuilt_simulation.h"

namespace tenon::engines::jolt {

/// Steps one model. One object belongs to one thread at a time.
class JoltSimulation final : public RebuiltSimulation {
 public:
  /// `scene` must outlive the simulation. Errors are those of build_model.
  static Result<std::unique_ptr<JoltSimulation>> make(const scene::PhysicsScene& scene,
                                                      const SimulationOptions& options,
                                                      Diagnostics& diagnostics);

  BodyState body_state(scene::Index body) const override;
  JointState joint_state(scene::Index joint) const override;
  Energy energy() const override;
  std::size_t contact_count() const override;
  std::size_t dof_count() const override;
  const std::vector<NotMapped>& not_mapped() const override { return model_.not_mapped; }
  std::vector<scene::VendorSetting> settings() const override;
  Vec3d center_of_mass(scene::Index body) const override;
  bool can(Ability ability) const override { return ability != Ability::Work; }
  EngineObjects engine_objects() const override;

 private:
  JoltSimulation(const scene::PhysicsScene& scene, const SimulationOptions& options);

  Result<void> build(Begin begin, Diagnostics& diagnostics) override;
  void begin_outputs() override;
  Result<void> advance(double now) override;
  bool is_bounded(scene::Index body) const override;
  void end_outputs() override;
  NewEvents take_events() override;
  Result<std::unique_ptr<RebuiltSimulation>> another(
      const SimulationOptions& options) const override;
  void take(RebuiltSimulation& other) override;

  Result<void> write_target(scene::Index joint, scene::Index drive) override;
  Result<void> write_gravity() override;
  Result<void> write_parameter(const ParameterKey& key, double value) override;
  Result<void> write_joint_state(scene::Index joint, const JointState& state) override;
  Result<void> write_body_state(scene::Index body, const BodyState& state) override;

  std::vector<Contact> contacts_of_step() const override { return contacts_; }
  std::vector<double> efforts_of_step(scene::Index joint) const override;
  Wrench reaction_of_step(scene::Index joint) const override;
  BodyAcceleration body_acceleration_of_step(scene::Index body) const override;
  std::vector<double> joint_acceleration_of_step(scene::Index joint) const override;

  Result<void> write_joint_parameter(const ParameterKey& key, double value);
  void write_state(scene::Index body, const BodyState& state);
  std::vector<scene::Index> bodies_behind(scene::Index body) const;

  JPH::TempAllocatorMalloc memory_;  ///< of a step
  JPH::JobSystemSingleThreaded jobs_;
  Model model_;
  StepInputs inputs_;
  SlowTurns slow_turns_;
  std::vector<Contact> contacts_;
  PairListener::Inside inside_;             ///< triggers after the last step
  std::vector<scene::Index> breakable_;     ///< joints
  std::vector<BodyState> bodies_at_begin_;  ///< of the last step, where accelerations are asked for
  std::vector<JointState> joints_at_begin_;
};

}  // namespace tenon::engines::jolt
