// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/simulate.h"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "cli/reading_options.h"
#include "tenon/asset/physics_options.h"
#include "tenon/bake/write_time_samples.h"
#include "tenon/formats/save_layer.h"
#include "tenon/physics/read_physics.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

volatile std::sig_atomic_t interrupt_count = 0;

extern "C" void count_interrupt(int) { interrupt_count = interrupt_count + 1; }

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A line on the terminal, at most ten times a second.
class Progress {
 public:
  Progress(const Report& report, double duration)
      : shown_(stderr_is_terminal() && !report.json() && !report.quiet()), duration_(duration) {}

  void at(double seconds) {
    const double wall = seconds_since(start_);
    if (!shown_ || wall - last_ < 0.1) {
      return;
    }
    last_ = wall;
    const double rate = seconds / wall;
    std::fprintf(stderr, "\r%5.1f %%  %.2f of %.2f s  %.1fx real time  %.0f s left ",
                 100 * seconds / duration_, seconds, duration_, rate,
                 rate > 0 ? (duration_ - seconds) / rate : 0.0);
  }
  void done() const {
    if (shown_ && last_ > 0) {
      std::fprintf(stderr, "\r%70s\r", "");
    }
  }

 private:
  bool shown_;
  double duration_;
  double last_ = 0;
  Clock::time_point start_ = Clock::now();
};

double duration_of(const SimulateArguments& arguments, const physics::PhysicsScene& scene) {
  if (arguments.duration > 0) {
    return arguments.duration;
  }
  const double authored =
      (scene.end_time_code - scene.start_time_code) / scene.time_codes_per_second;
  return authored > 0 && std::isfinite(authored) ? authored : 5.0;
}

Result<void> check_arguments(const SimulateArguments& arguments) {
  const auto fine = [](double number) { return std::isfinite(number) && number >= 0; };
  if (!fine(arguments.duration) || !fine(arguments.time_step) ||
      !fine(arguments.frames_per_second)) {
    return Error(ErrorCode::Invalid, "--duration, --dt and --fps are numbers above zero");
  }
  return {};
}

}  // namespace

void SimulateArguments::add_to(const Command& verb) {
  asset.add_to(verb);
  verb.add_option("--engine", engine, "mujoco (physx and jolt are not built yet)");
  verb.add_option("--duration", duration,
                  "Seconds to simulate; without it the stage's time range, else 5");
  verb.add_option("--dt", time_step, "Time step in seconds; without it the asset's, else 0.002");
  verb.add_option("--fps", frames_per_second, "Frames per second of logs and baked layers");
  add_readings(verb, readings);
  verb.add_option("--set", asset.overrides, "PATH.attr=value, for this run only; may be repeated")
      .repeatable();
}

int Simulated::exit_code() const {
  if (unstable()) {
    return kUnstable;
  }
  if (run.failure) {
    return exit_code_of(*run.failure);
  }
  return run.interrupted ? kInterrupted : kOk;
}

Result<Simulated> simulate(const SimulateArguments& arguments, Report& report) {
  TENON_CHECK(check_arguments(arguments));
  Simulated result;
  TENON_TRY(const physics::Readings readings, chosen_readings(arguments.readings));
  const OpenOptions open = with_readings(arguments.asset.open_options(), readings);
  TENON_TRY(stage::Stage stage, open_stage(arguments.asset.asset, open, report.diagnostics));
  result.stage = std::make_unique<stage::Stage>(std::move(stage));
  result.scene = std::make_unique<physics::PhysicsScene>(
      physics::read_physics(*result.stage, read_options(readings), report.diagnostics));
  engines::SimulationOptions options;
  options.time_step = arguments.time_step;
  TENON_TRY(result.simulation,
            make_simulation(arguments.engine, *result.scene, options, report.diagnostics));
  for (const engines::EngineInfo& engine : list_engines()) {
    if (engine.name == arguments.engine) {
      result.engine_version = engine.version;
    }
  }
  bake::RunOptions run;
  run.duration = duration_of(arguments, *result.scene);
  run.frames_per_second = arguments.frames_per_second;
  Progress progress(report, run.duration);
  run.go_on = [&](double seconds) {
    progress.at(seconds);
    return interrupt_count == 0;
  };
  const auto previous = std::signal(SIGINT, count_interrupt);
  const auto start = Clock::now();
  result.run = bake::run_simulation(*result.simulation, *result.scene, run);
  result.wall_seconds = seconds_since(start);
  std::signal(SIGINT, previous);
  progress.done();
  if (result.run.failure) {
    report.diagnostics.add(result.run.failure->diagnostic());
  }
  return result;
}

Result<void> write_bake(const Simulated& simulated, const SimulateArguments& arguments,
                        const std::string& output, Report& report) {
  namespace fs = std::filesystem;
  bake::BakeOptions options;
  const fs::path folder = output == "-" ? fs::current_path() : fs::absolute(output).parent_path();
  const fs::path asset = fs::absolute(arguments.asset.asset).lexically_normal();
  const std::string relative = asset.lexically_relative(folder.lexically_normal()).generic_string();
  options.uninstance = arguments.uninstance;
  options.asset_path = relative.empty()          ? asset.generic_string()
                       : relative.front() == '.' ? relative
                                                 : "./" + relative;
  if (!arguments.asset.physics.empty()) {
    options.variant_selections["Physics"] = arguments.asset.physics;
  }
  const layer::Layer layer =
      bake::write_time_samples(*simulated.stage, *simulated.scene, simulated.run.recording.poses(),
                               options, report.diagnostics);
  if (output == "-") {
    TENON_TRY(const std::string text, formats::encode_layer(layer, formats::LayerFormat::Text));
    return write_output(output, text);
  }
  return formats::save_layer(layer, output);
}

}  // namespace tenon::cli
