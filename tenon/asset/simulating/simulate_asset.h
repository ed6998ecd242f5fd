// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tenon/bake/commands/commands.h"
#include "tenon/bake/run_simulation.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/masks.h"
#include "tenon/engines/simulation.h"
#include "tenon/layer/layer.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

/// A run as a value: an asset, the options of the run, and its result.
namespace tenon {

/// Callbacks during the run; each may be empty.
struct SimulationListener {
  Function<void(const std::string& what)> next_part;  ///< "simulating"
  /// A finding about work that will take long, before it begins; without it, it comes with the
  /// others.
  Function<void(const Diagnostic& finding)> announce;
  /// Called regularly, with the simulated time and that of the whole run [s]; false stops it.
  Function<bool(double seconds, double duration)> go_on;
};

struct SimulateAssetOptions {
  OpenOptions open;
  physics::Readings readings;      ///< how the physics is read
  std::vector<std::string> pose;   ///< where it starts (dynamics/posture_text.h); empty: as it is
  dynamics::Masks masks;           ///< links and joints that the run skips or holds
  std::string engine;              ///< empty: as choose_engine() decides (engine_choice.h)
  std::optional<double> duration;  ///< [s]; not given: what the stage's time range says, else 5
  double time_step = 0;            ///< [s]; 0: the asset's, else the engine's
  engines::Methods methods{};      ///< how steps are made
  double frames_per_second = 60;   ///< of the recording
  engines::Outputs outputs;        ///< what the recording has beside states
  std::string commands;            ///< a file of commands (bake/commands/commands.h); empty: none
  std::string state_in;            ///< a file with the saved state to begin from; empty: the start
  std::optional<bake::RestRule> until_rest;  ///< the run ends where everything rests
  SimulationListener listener;
};

/// A finished run and everything that it was made of; the simulation refers to the scene.
struct SimulatedAsset {
  std::unique_ptr<stage::Stage> stage;
  std::unique_ptr<scene::PhysicsScene> scene;
  std::unique_ptr<engines::Simulation> simulation;
  std::string engine;
  std::string engine_version;
  std::string state_in;  ///< as in the options, like the two below
  std::string commands_file;
  bool until_rest = false;
  std::optional<bake::Commands> commands;
  double begin = 0;  ///< [s]; later than 0 where a saved state was the beginning
  bake::Run run;
  double wall_seconds = 0;

  bool unstable() const { return run.failure && run.failure->code() == ErrorCode::Unstable; }
};

/// Opens, reads the physics and runs. A run that failed on its way is a result (see Run::failure)
/// and a finding; one that could not begin is an Error: those of tenon::open and make_simulation,
/// Invalid (sim.time-step, drive.negative-gain), Limit (sim.record-too-long), those of
/// read_commands and of restore_state with their file, those of apply_masks. A run that was to end
/// at rest and did not is a finding, too (sim.not-at-rest).
Result<SimulatedAsset> simulate_asset(const std::string& path, const SimulateAssetOptions& options,
                                      Diagnostics& diagnostics);

/// The requested duration; else that of the stage's time range, else 5 [s].
double run_duration(const std::optional<double>& asked, const scene::PhysicsScene& scene);

/// Refuses a recording of so many states of bodies and joints that no memory holds it: Limit
/// (sim.record-too-long).
Result<void> check_recorded_states(double states);

/// The full state at the end, for SimulateAssetOptions::state_in. Errors: Unsupported where the
/// engine saves none; why the run failed where it did, because nothing could go on from there.
Result<std::string> end_state(const SimulatedAsset& simulated);

struct MotionOptions {
  bool uninstance = false;  ///< instances with moving bodies inside become ordinary prims
};

/// The layer that plays the run over the asset at `path`, for a file at `output` ("-": in the
/// current folder), from where it names the asset. It repeats the variants of "Physics" that ran by
/// the options.
layer::Layer motion_layer(const SimulatedAsset& simulated, const std::string& path,
                          const std::string& output, const MotionOptions& options,
                          Diagnostics& diagnostics);

}  // namespace tenon
