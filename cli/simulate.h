// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/bake/run_simulation.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/stage/stage.h"

/// What `sim` and `bake` share: open, read the physics, run.
namespace tenon::cli {

struct SimulateArguments {
  AssetArguments asset;
  std::vector<std::string> readings;  ///< --reading NAME=VALUE
  bool uninstance = false;  ///< of bake: instances with bodies inside become ordinary prims
  std::string engine = "mujoco";
  std::optional<double> duration;  ///< [s]; not given: what the stage's time range says, else 5
  double time_step = 0;            ///< [s]; 0: the asset's, else the engine's
  double frames_per_second = 60;

  void add_to(const Command& verb);
};

/// A finished run and everything that it was made of; the simulation refers to the scene.
struct Simulated {
  std::unique_ptr<stage::Stage> stage;
  std::unique_ptr<scene::PhysicsScene> scene;
  std::unique_ptr<engines::Simulation> simulation;
  std::string engine_version;
  bake::Run run;
  double wall_seconds = 0;

  bool unstable() const { return run.failure && run.failure->code() == ErrorCode::Unstable; }
  int exit_code() const;
};

/// Runs; progress goes to a terminal's standard error. A run that failed on its way is a result
/// (see Run::failure), one that could not begin is an Error.
Result<Simulated> simulate(const SimulateArguments& arguments, Report& report);

/// Puts the overlay layer that plays the run among the outputs.
Result<void> put_bake(const Simulated& simulated, const SimulateArguments& arguments,
                      const std::string& output, Outputs& outputs, Report& report);

}  // namespace tenon::cli
