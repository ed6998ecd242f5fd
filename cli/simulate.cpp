// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Stage, scene and simulation lie on the heap in one result, because the simulation refers to the
// scene. The states that a run would record are counted before its first step and bounded by
// kRecordedStates, since they all stay in memory. An interrupt only raises a counter, which the run
// asks for every few steps. A run that is interrupted or becomes unstable is still a result, with
// the recording up to there; only what could not begin is an error.
#include "cli/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>

#include "cli/progress.h"
#include "cli/reading_options.h"
#include "tenon/asset/physics_options.h"
#include "tenon/bake/write_time_samples.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/base/text/text_number.h"
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

double duration_of(const SimulateArguments& arguments, const scene::PhysicsScene& scene) {
  if (arguments.duration) {
    return *arguments.duration;
  }
  const double authored =
      (scene.end_time_code - scene.start_time_code) / scene.time_codes_per_second;
  return authored > 0 && std::isfinite(authored) ? authored : 5.0;
}

/// Refuses what would take no step although time is to pass, and records that no memory holds.
Result<void> check_run(const bake::RunOptions& run, double step, const scene::PhysicsScene& scene) {
  if (run.duration > 0 && run.duration < step * (1 - 1e-9)) {
    return Error(ErrorCode::Invalid, "a time step of " + shortest(step) + " s is longer than the " +
                                         shortest(run.duration) + " s to simulate")
        .with_rule("sim.time-step")
        .with_fix("give a smaller --dt or a longer --duration");
  }
  const double states = (run.duration * run.frames_per_second + 2) *
                        static_cast<double>(scene.bodies.size() + scene.joints.size());
  if (states > static_cast<double>(limits::kRecordedStates)) {
    return Error(ErrorCode::Limit, "the run would record " + shortest(std::floor(states)) +
                                       " states of bodies and joints; the limit is " +
                                       std::to_string(limits::kRecordedStates))
        .with_rule("sim.record-too-long")
        .with_fix("give a lower --fps or a shorter --duration");
  }
  return {};
}

/// MuJoCo prepares a model in a time that grows with the square of its bodies: 10,000 that are free
/// took 15.7 s on the machine of the benchmarks. Who has to wait for it is told before.
void announce_setup(const SimulateArguments& arguments, const scene::PhysicsScene& scene,
                    Report& report) {
  constexpr double kSecondsPerPair = 1.5e-7;
  constexpr double kWorthTelling = 2;  // [s]
  const auto bodies = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                    [](const scene::Body& body) { return !body.kinematic; });
  const double seconds = kSecondsPerPair * std::pow(static_cast<double>(bodies), 2);
  if (arguments.engine != "mujoco" || seconds < kWorthTelling) {
    return;
  }
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = "sim.slow-setup";
  finding.message = "setting up " + grouped_digits(static_cast<std::size_t>(bodies)) +
                    " bodies on MuJoCo takes about " + std::to_string(std::llround(seconds)) +
                    " s; the time grows with the square of their number";
  finding.fix = "simulate a part of the scene with --mask";
  if (report.json()) {
    report.diagnostics.add(std::move(finding));
  } else if (!report.quiet()) {
    say_aside(diagnostic_line(std::move(finding), use_color(report.globals())));
  }
}

}  // namespace

void SimulateArguments::add_to(const Command& verb) {
  asset.add_with_standard_input_to(verb);
  verb.add_option("--engine", engine, "The engine; PhysX and Jolt are not built yet")
      .one_of({"mujoco", "physx", "jolt"})
      .value_name("NAME");
  verb.add_option("--duration", duration, {0, 1e6, false, false, "s"},
                  "Time to simulate; without it the stage's time range, else 5 s")
      .value_name("SECONDS");
  verb.add_option("--dt", time_step, {1e-9, 10, false, false, "s"},
                  "Time step; without it the asset's, else 0.002 s")
      .value_name("SECONDS");
  verb.add_option("--fps", frames_per_second, {0, 1e5, true, false, "per second"},
                  "Frames of logs and baked layers");
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
  Simulated result;
  TENON_TRY(const physics::Readings readings, chosen_readings(arguments.readings));
  const OpenOptions open = with_readings(arguments.asset.open_options(), readings);
  Progress progress(report.globals(), "reading " + shown_path(arguments.asset.asset));
  TENON_TRY(stage::Stage stage, open_stage(arguments.asset.asset, open, report.diagnostics));
  result.stage = std::make_unique<stage::Stage>(std::move(stage));
  result.scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(*result.stage, read_options(readings), report.diagnostics));
  announce_setup(arguments, *result.scene, report);
  progress.next("building the model of " + std::to_string(result.scene->bodies.size()) + " bodies");
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
  TENON_CHECK(check_run(run, result.simulation->time_step(), *result.scene));
  progress.next("simulating");
  run.go_on = [&](double seconds) {
    progress.at(seconds, run.duration, "s");
    return interrupt_count == 0;
  };
  const auto previous = std::signal(SIGINT, count_interrupt);
  const auto start = Clock::now();
  result.run = bake::run_simulation(*result.simulation, *result.scene, run);
  result.wall_seconds = seconds_since(start);
  std::signal(SIGINT, previous);
  if (result.run.failure) {
    report.diagnostics.add(result.run.failure->diagnostic());
  }
  return result;
}

Result<void> put_bake(const Simulated& simulated, const SimulateArguments& arguments,
                      const std::string& output, Outputs& outputs, Report& report) {
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
  formats::LayerFormat format = formats::LayerFormat::Text;
  if (output != "-") {
    TENON_TRY(format, formats::layer_format_for(output));
  }
  TENON_TRY(std::string contents, formats::encode_layer(layer, format));
  outputs.put(output, std::move(contents));
  return {};
}

}  // namespace tenon::cli
