// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/engines/scene_timeline.h"
#include "tenon/engines/steered_simulation.h"
#include "tenon/engines/watches/energy_bound.h"
#include "tenon/engines/watches/passage_watch.h"

namespace tenon::engines {

/// What happened in a step beside motion.
struct NewEvents {
  struct Passage {
    scene::Index trigger = 0;  ///< collider
    scene::Index other = 0;    ///< collider
    bool inside = false;       ///< it came in; else it left
  };
  struct Broken {
    scene::Index joint = 0;
    double force = 0;   ///< [N]
    double torque = 0;  ///< [N m]
  };
  std::vector<Passage> passages;
  std::vector<Broken> broken;
};

/// The run of an engine that can be asked for poses and velocities, and can be given new ones, but
/// not for all that it keeps from step to step. Where the scene changes, joints that broke
/// included, the model is rebuilt from the scene as it is now, with the bodies as they are. A
/// saved state is all that was set since the start, and restoring it makes the run again
/// (input_log.h). An engine is derived from this class and has the model.
class RebuiltSimulation : public SteeredSimulation {
 public:
  Result<void> step() final;
  double time() const final { return static_cast<double>(steps_) * time_step_; }
  double time_step() const final { return time_step_; }
  const Outputs& outputs() const final { return options_.outputs; }
  Result<void> reset() final;
  Result<std::string> save_state() const final;
  Result<void> restore_state(std::string_view bytes) final;

 protected:
  /// `scene` must outlive the simulation.
  RebuiltSimulation(const scene::PhysicsScene& scene, const SimulationOptions& options);
  /// At time 0, with steps of `time_step` [s]. Errors: those of build().
  Result<void> begin(double time_step, Diagnostics& diagnostics);

  // ---- what an engine does

  /// The model of `*scene_`, and what follows from it alone. At Begin::Start nothing is left of an
  /// earlier run.
  virtual Result<void> build(Begin begin, Diagnostics& diagnostics) = 0;
  /// Before a step: what outputs compare with.
  virtual void begin_outputs() {}
  /// Gives the engine its inputs and lets it make one step, which begins at `now` [s].
  virtual Result<void> advance(double now) = 0;
  /// A body has a finite pose and finite velocities.
  virtual bool is_bounded(scene::Index body) const = 0;
  /// After a step: contacts and other outputs.
  virtual void end_outputs() {}
  virtual NewEvents take_events() = 0;
  /// Writes bounds of joints that follow samples; false where that takes a new model.
  virtual bool move_bounds() { return false; }
  /// What a new model begins with (body_count).
  virtual std::vector<BodyState> states_to_carry() const;
  /// One of the same scene and engine, at its start.
  virtual Result<std::unique_ptr<RebuiltSimulation>> another(
      const SimulationOptions& options) const = 0;
  /// Takes the run of what another() made.
  virtual void take(RebuiltSimulation& other);

  /// Unstable (rule ENGINE.unstable).
  Error unstable(const std::string& why, const Path& prim) const;
  const scene::PhysicsScene& asset() const { return *asset_; }  ///< as it was given
  const SimulationOptions& options() const { return options_; }
  std::uint64_t steps() const { return steps_; }
  void note(const Input& input) override;

 private:
  Result<void> follow_changes();
  Result<void> note_events();
  Result<void> rebuild();
  void start_watches();
  StateOwner owner() const;

  const scene::PhysicsScene* asset_;  ///< as it was given
  SimulationOptions options_;
  std::unique_ptr<scene::Timeline> timeline_;  ///< where the scene may change, else null
  double time_step_ = 0;
  std::uint64_t steps_ = 0;
  EnergyBound energy_bound_;
  PassageWatch passages_;
  InputLog log_;
};

}  // namespace tenon::engines
