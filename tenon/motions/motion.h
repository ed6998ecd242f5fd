// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tenon/bake/commands/commands.h"
#include "tenon/bake/run_simulation.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/function.h"
#include "tenon/base/result.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// Motions of one asset, as several engines make them, beside each other.
namespace tenon::motions {

/// Makes the simulation of a scene on the engine of that name.
using MakeSimulation = Function<Result<std::unique_ptr<engines::Simulation>>(
    const std::string& engine, const scene::PhysicsScene& scene,
    const engines::SimulationOptions& options, Diagnostics& diagnostics)>;

/// The simulation of one engine.
struct Setup {
  std::string name;  ///< for people, where engines are not told apart by theirs
  std::string engine;
  scene::PhysicsScene scene;
  engines::SimulationOptions options{};
};

/// Options that are the same for every engine.
struct MotionPlan {
  MakeSimulation make;
  double duration = 5;  ///< [s]
  double frames_per_second = 60;
  /// Commands for a scene and its simulation; may be empty.
  Function<Result<bake::Commands>(const scene::PhysicsScene& scene,
                                  const engines::Simulation& simulation)>
      commands;
  /// As RunOptions::go_on; may be empty.
  Function<bool(double seconds)> go_on;
};

/// The result.
struct Motion {
  bake::Run run;
  double time_step = 0;       ///< [s]
  bool has_contacts = false;  ///< the engine tells them
  std::vector<engines::NotMapped> not_mapped;
  std::vector<engines::Event> events;
  double wall_seconds = 0;  ///< of all steps
};

/// Errors: those of making the simulation and of the commands. A run that failed on its way is a
/// result (Run::failure).
Result<Motion> run_motion(const Setup& setup, const MotionPlan& plan, Diagnostics& diagnostics);

}  // namespace tenon::motions
