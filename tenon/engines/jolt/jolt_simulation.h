// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/input_log.h"
#include "tenon/engines/jolt/model.h"
#include "tenon/engines/jolt/run/slow_turns.h"
#include "tenon/engines/jolt/run/step_inputs.h"
#include "tenon/engines/simulation.h"
#include "tenon/engines/steering.h"
#include "tenon/engines/watches/energy_bound.h"
#include "tenon/engines/watches/passage_watch.h"
#include "tenon/scene/timeline/timeline.h"

namespace tenon::engines::jolt {

/// Steps one model. One object belongs to one thread at a time.
class JoltSimulation final : public Simulation {
 public:
  /// `scene` must outlive the simulation. Errors are those of build_model.
  static Result<std::unique_ptr<JoltSimulation>> make(const scene::PhysicsScene& scene,
                                                      const SimulationOptions& options,
                                                      Diagnostics& diagnostics);

  Result<void> step() override;
  double time() const override { return static_cast<double>(steps_) * model_.time_step; }
  double time_step() const override { return model_.time_step; }
  BodyState body_state(scene::Index body) const override;
  JointState joint_state(scene::Index joint) const override;
  Energy energy() const override;
  std::size_t contact_count() const override;
  std::size_t dof_count() const override;
  const std::vector<NotMapped>& not_mapped() const override { return model_.not_mapped; }
  std::vector<scene::VendorSetting> settings() const override;
  const std::vector<Event>& events() const override { return events_; }
  Vec3d center_of_mass(scene::Index body) const override;
  bool can(Ability ability) const override;
  EngineObjects engine_objects() const override;
  Vec3d gravity(scene::Index scene) const override;
  const Outputs& outputs() const override { return options_.outputs; }

  Result<void> set_drive_target(scene::Index joint, scene::Index drive,
                                const DriveTarget& target) override;
  Result<void> set_joint_efforts(scene::Index joint, std::span<const double> efforts) override;
  Result<void> set_body_wrench(scene::Index body, const Wrench& wrench) override;
  Result<void> move_kinematic(scene::Index body, const Pose& pose) override;
  Result<void> set_gravity(scene::Index scene, const Vec3d& gravity) override;
  Result<void> set_parameter(const ParameterKey& key, double value) override;
  Result<void> set_joint_state(scene::Index joint, const JointState& state) override;
  Result<void> set_body_state(scene::Index body, const BodyState& state) override;
  Result<void> reset() override;
  Result<std::string> save_state() const override;
  Result<void> restore_state(std::string_view bytes) override;

  Result<std::vector<Contact>> contacts() const override;
  Result<std::vector<double>> drive_efforts(scene::Index joint) const override;
  Result<Wrench> joint_reaction(scene::Index joint) const override;
  Result<BodyAcceleration> body_acceleration(scene::Index body) const override;
  Result<std::vector<double>> joint_acceleration(scene::Index joint) const override;

 private:
  JoltSimulation(const scene::PhysicsScene& scene, const SimulationOptions& options);
  Result<void> begin(double time_step, Diagnostics& diagnostics);
  Result<void> follow_changes();
  Result<void> rebuild();
  Result<void> advance();
  Result<void> check_step() const;
  void take_passages();
  Result<void> break_joints();
  Wrench reaction_of(scene::Index joint) const;
  void keep_velocities();
  Result<void> write_parameter(const ParameterKey& key, double value);
  Result<void> write_joint_parameter(const ParameterKey& key, double value);
  void apply_steering();
  void set_from_outside(Input input);
  StateOwner owner() const;
  void take(JoltSimulation& other);
  void write_state(scene::Index body, const BodyState& state);
  std::vector<scene::Index> bodies_behind(scene::Index body) const;

  const scene::PhysicsScene* asset_;  ///< as it was given
  SimulationOptions options_;
  std::unique_ptr<scene::Timeline> timeline_;  ///< where the scene may change, else null
  const scene::PhysicsScene* scene_;           ///< as it is now: the timeline's, or what was given
  JPH::TempAllocatorMalloc memory_;            ///< of a step
  JPH::JobSystemSingleThreaded jobs_;
  Model model_;
  StepInputs inputs_;
  EnergyBound energy_bound_;
  PassageWatch passages_;
  SlowTurns slow_turns_;
  Steering steering_;
  std::vector<Event> events_;
  std::vector<Contact> contacts_;
  PairListener::Inside inside_;             ///< triggers after the last step
  std::vector<scene::Index> breakable_;     ///< joints
  std::vector<BodyState> bodies_at_begin_;  ///< of the last step, where accelerations are asked for
  std::vector<JointState> joints_at_begin_;
  InputLog log_;
  std::uint64_t steps_ = 0;
};

}  // namespace tenon::engines::jolt
