// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/physx/model.h"
#include "tenon/engines/physx/run/step_events.h"
#include "tenon/engines/physx/run/step_inputs.h"
#include "tenon/engines/physx/run/step_outputs.h"
#include "tenon/engines/rebuilt_simulation.h"

namespace tenon::engines::physx {

/// Steps one model. One object belongs to one thread at a time.
class PhysxSimulation final : public RebuiltSimulation {
 public:
  /// `scene` must outlive the simulation. Errors are those of build_model.
  static Result<std::unique_ptr<PhysxSimulation>> make(const scene::PhysicsScene& scene,
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
  bool can(Ability /*ability*/) const override { return true; }
  EngineObjects engine_objects() const override;

 private:
  PhysxSimulation(const scene::PhysicsScene& scene, const SimulationOptions& options);

  Result<void> build(Begin begin, Diagnostics& diagnostics) override;
  void begin_outputs() override;
  Result<void> advance(double now) override;
  bool is_bounded(scene::Index body) const override;
  void end_outputs() override;
  NewEvents take_events() override { return std::move(told_->happened); }
  bool move_bounds() override;
  std::vector<BodyState> states_to_carry() const override;
  Result<std::unique_ptr<RebuiltSimulation>> another(
      const SimulationOptions& options) const override;
  void take(RebuiltSimulation& other) override;

  Result<void> write_target(scene::Index joint, scene::Index drive) override;
  Result<void> write_gravity() override;
  Result<void> write_parameter(const ParameterKey& key, double value) override;
  Result<void> write_joint_state(scene::Index joint, const JointState& state) override;
  Result<void> write_body_state(scene::Index body, const BodyState& state) override;
  void add_change(double energy) override { outputs_.add_change(energy); }

  std::vector<Contact> contacts_of_step() const override { return contacts_; }
  std::vector<double> efforts_of_step(scene::Index joint) const override;
  Wrench reaction_of_step(scene::Index joint) const override;
  BodyAcceleration body_acceleration_of_step(scene::Index body) const override;
  std::vector<double> joint_acceleration_of_step(scene::Index joint) const override;
  Work work_of_run() const override { return outputs_.work(); }

  void step_scenes();
  Result<void> write_joint_parameter(const ParameterKey& key);
  void bring_up_to_date() const;

  std::unique_ptr<StepEvents> told_;  ///< outlives the model, which holds it
  std::unique_ptr<SurfaceMotion> surfaces_;
  Model model_;
  StepInputs inputs_;
  std::vector<Contact> contacts_;
  StepOutputs outputs_;
  mutable bool stale_ = true;  ///< caches are of an earlier step
};

}  // namespace tenon::engines::physx
