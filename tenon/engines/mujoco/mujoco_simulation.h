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
#include "tenon/engines/mujoco/run/data_lender.h"
#include "tenon/engines/mujoco/run/energy_watch.h"
#include "tenon/engines/mujoco/run/limit_watch.h"
#include "tenon/engines/mujoco/run/moving_bounds.h"
#include "tenon/engines/mujoco/run/passage_watch.h"
#include "tenon/engines/mujoco/run/saved_run.h"
#include "tenon/engines/mujoco/run/step_inputs.h"
#include "tenon/engines/mujoco/run/step_outputs.h"
#include "tenon/engines/mujoco/run/triggers.h"
#include "tenon/engines/mujoco/run/velocity_caps.h"
#include "tenon/engines/steered_simulation.h"
#include "tenon/scene/timeline/timeline.h"

namespace tenon::engines::mujoco {

/// Steps one model. Reading the state brings MuJoCo's derived poses up to date on first use after a
/// step, so one object belongs to one thread at a time.
class MujocoSimulation final : public SteeredSimulation {
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
  Vec3d center_of_mass(scene::Index body) const override;
  bool can(Ability /*ability*/) const override { return true; }
  EngineObjects engine_objects() const override;
  const Outputs& outputs() const override { return start_->options.outputs; }

  Result<void> reset() override;
  Result<std::string> save_state() const override;
  Result<void> restore_state(std::string_view bytes) override;

  /// The engine's own objects, for tests and benchmarks.
  const mjModel& engine_model() const { return *model_.model; }
  const mjData& engine_data() const { return *model_.data; }

 private:
  /// What reset() and another() begin with. Shared by all simulations of one model; never written,
  /// except for what they lend each other.
  struct Start {
    const scene::PhysicsScene* scene = nullptr;
    SimulationOptions options;
    ModelMaps maps;
    SharedModel model;
    std::vector<double> state;           ///< mjSTATE_INTEGRATION
    std::vector<int> asleep;             ///< mjData::tree_asleep
    std::unique_ptr<DataLender> lender;  ///< of many, else null
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
  Result<void> write_target(scene::Index joint, scene::Index drive) override;
  Result<void> write_wrench(scene::Index /*body*/) override { return write_gravity(); }
  Result<void> write_pose(scene::Index body) override;
  Result<void> write_gravity() override;
  Result<void> write_parameter(const ParameterKey& key, double value) override;
  Result<void> write_joint_state(scene::Index joint, const JointState& state) override;
  Result<void> write_body_state(scene::Index body, const BodyState& state) override;
  void note(const Input& input) override;
  void add_change(double energy) override { outputs_->work.changes += energy; }

  std::vector<Contact> contacts_of_step() const override { return outputs_->contacts; }
  std::vector<double> efforts_of_step(scene::Index joint) const override;
  Wrench reaction_of_step(scene::Index joint) const override;
  BodyAcceleration body_acceleration_of_step(scene::Index body) const override;
  std::vector<double> joint_acceleration_of_step(scene::Index joint) const override;
  Work work_of_run() const override { return outputs_->work; }

  void connect();
  Result<void> take_step();
  bool may_borrow() const;
  Result<void> take_step_with(DataPtr lent);
  Result<void> apply_steering();
  Result<void> follow_changes();
  Result<void> rebuild(Restart restart);
  Result<void> break_joints();
  Result<void> replay(const SavedRun& run);
  Result<void> check_run(const SavedRun& run) const;
  void note_broken(const Restart& restart);
  void note_rebounds();
  Result<void> watch();
  void bring_up_to_date() const;
  StateOwner owner() const;

  std::shared_ptr<const Start> start_;
  std::unique_ptr<scene::Timeline> timeline_;  ///< where the scene may change, else null
  Model model_;
  std::vector<Restart> history_;
  double advanced_to_ = -1;  ///< [s] the timeline was brought to; < 0: never
  StepInputs inputs_;
  MovingBounds bounds_;
  Breaking breaking_;
  VelocityCaps caps_;
  Triggers triggers_;
  EnergyWatch energy_watch_;
  PassageWatch passages_;
  LimitWatch limits_;
  std::optional<StepOutputs> outputs_;
  std::optional<std::size_t> contact_count_;  ///< of the last step, where that was of lent data
  mutable bool stale_ = true;
};

}  // namespace tenon::engines::mujoco
