// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/mujoco/run/breaking.h"
#include "tenon/engines/mujoco/run/energy_watch.h"
#include "tenon/engines/mujoco/run/moving_bounds.h"
#include "tenon/engines/mujoco/run/passage_watch.h"
#include "tenon/engines/mujoco/run/saved_run.h"
#include "tenon/engines/mujoco/run/step_inputs.h"
#include "tenon/engines/mujoco/run/step_outputs.h"
#include "tenon/engines/mujoco/run/triggers.h"
#include "tenon/engines/mujoco/run/velocity_caps.h"
#include "tenon/engines/simulation.h"
#include "tenon/engines/steering.h"
#include "tenon/scene/timeline/timeline.h"

namespace tenon::engines::mujoco {

/// Steps one model. Reading the state brings MuJoCo's derived poses up to date on first use after a
/// step, so one object belongs to one thread at a time.
class MujocoSimulation final : public Simulation {
 public:
  /// `scene` must outlive the simulation; `how_many` says how many there will be of the model, of
  /// which each then takes less memory. Errors are those of build_model.
  static Result<std::unique_ptr<MujocoSimulation>> make(const scene::PhysicsScene& scene,
                                                        const SimulationOptions& options,
                                                        Diagnostics& diagnostics,
                                                        std::size_t how_many = 1);
  /// Another simulation of the same model, which is not compiled again and shared until one of them
  /// writes into it. At the start.
  Result<std::unique_ptr<MujocoSimulation>> another() const;

  Result<void> step() override;
  double time() const override;
  double time_step() const override;
  BodyState body_state(scene::Index body) const override;
  JointState joint_state(scene::Index joint) const override;
  Energy energy() const override;
  std::size_t contact_count() const override;
  std::size_t dof_count() const override;
  const std::vector<NotMapped>& not_mapped() const override { return start_->maps.not_mapped; }
  std::vector<scene::VendorSetting> settings() const override;
  const std::vector<Event>& events() const override { return events_; }
  Vec3d center_of_mass(scene::Index body) const override;
  bool can(Ability ability) const override;
  EngineObjects engine_objects() const override;
  Vec3d gravity(scene::Index scene) const override;
  const Outputs& outputs() const override { return start_->options.outputs; }

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
  Result<Work> work() const override;

  /// The engine's own objects, for tests and benchmarks.
  const mjModel& engine_model() const { return *model_.model; }
  const mjData& engine_data() const { return *model_.data; }

 private:
  /// What reset() and another() begin with. Shared by all simulations of one model; never written.
  struct Start {
    const scene::PhysicsScene* scene = nullptr;
    SimulationOptions options;
    ModelMaps maps;
    SharedModel model;
    std::vector<double> state;  ///< mjSTATE_INTEGRATION
    std::vector<int> asleep;    ///< mjData::tree_asleep
    std::uint64_t scene_hash() const;
  };
  MujocoSimulation(std::shared_ptr<const Start> start, std::unique_ptr<scene::Timeline> timeline,
                   Model model);
  MujocoSimulation& operator=(MujocoSimulation&&) = default;
  /// One whose model is at the start, with its outputs there.
  static Result<std::unique_ptr<MujocoSimulation>> at_start(
      std::shared_ptr<const Start> start, std::unique_ptr<scene::Timeline> timeline, Model model);
  /// At the start; uses `data` of a simulation of the start's model where there is some.
  static Result<std::unique_ptr<MujocoSimulation>> from_start(std::shared_ptr<const Start> start,
                                                              DataPtr data);
  void connect();
  Result<void> apply_steering();
  Result<void> follow_changes();
  Result<void> rebuild(Restart restart);
  Result<void> break_joints();
  Result<void> drive_body(scene::Index body);
  Result<void> replay(const SavedRun& run);
  Result<void> check_run(const SavedRun& run) const;
  Result<void> write_gravities();
  Result<void> apply_parameter(const ParameterKey& key, double value);
  /// Makes a change from outside and accounts for the energy that it brings.
  template <class Call>
  Result<void> change(const Call& call);
  void note_broken(const Restart& restart);
  Result<void> watch();
  void bring_up_to_date() const;
  StateOwner owner() const;

  std::shared_ptr<const Start> start_;
  std::unique_ptr<scene::Timeline> timeline_;  ///< where the scene may change, else null
  const scene::PhysicsScene* scene_;           ///< as it is now: the timeline's, or what was given
  Model model_;
  std::vector<Event> events_;
  std::vector<Restart> history_;
  double advanced_to_ = -1;  ///< [s] the timeline was brought to; < 0: never
  Steering steering_;
  StepInputs inputs_;
  MovingBounds bounds_;
  Breaking breaking_;
  VelocityCaps caps_;
  Triggers triggers_;
  EnergyWatch energy_watch_;
  PassageWatch passages_;
  std::optional<StepOutputs> outputs_;
  mutable bool stale_ = true;
};

template <class Call>
Result<void> MujocoSimulation::change(const Call& call) {
  if (!outputs().work) {
    return call();
  }
  const double before = energy().total();
  TENON_CHECK(call());
  stale_ = true;
  outputs_->work.changes += energy().total() - before;
  return {};
}

}  // namespace tenon::engines::mujoco
