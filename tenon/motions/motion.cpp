// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/motions/motion.h"

#include <chrono>
#include <optional>

namespace tenon::motions {

Result<Motion> run_motion(const Setup& setup, const MotionPlan& plan, Diagnostics& diagnostics) {
  engines::SimulationOptions options = setup.options;
  options.outputs.contacts = true;
  auto made = plan.make(setup.engine, setup.scene, options, diagnostics);
  if (!made && made.error().code() == ErrorCode::Unsupported) {
    options.outputs.contacts = false;
    made = plan.make(setup.engine, setup.scene, options, diagnostics);
  }
  if (!made) {
    return made.error();
  }
  engines::Simulation& simulation = **made;
  std::optional<bake::Commands> commands;
  if (plan.commands) {
    TENON_TRY(commands, plan.commands(setup.scene, simulation));
  }
  bake::RunOptions run;
  run.duration = plan.duration;
  run.frames_per_second = plan.frames_per_second;
  run.outputs = options.outputs;
  run.commands = commands ? &*commands : nullptr;
  if (plan.go_on) {
    run.go_on = [&plan](double seconds) { return plan.go_on(seconds); };
  }
  Motion motion;
  motion.time_step = simulation.time_step();
  const auto start = std::chrono::steady_clock::now();
  motion.run = bake::run_simulation(simulation, setup.scene, run);
  motion.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (commands && !motion.run.failure && !motion.run.interrupted) {
    bake::tell_rows_outside(*commands, motion.run.time, diagnostics);
  }
  motion.has_contacts = options.outputs.contacts;
  motion.not_mapped = simulation.not_mapped();
  motion.events = simulation.events();
  return motion;
}

}  // namespace tenon::motions
