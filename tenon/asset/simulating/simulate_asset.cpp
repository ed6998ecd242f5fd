// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Stage, scene and simulation lie on the heap in one result, because the simulation refers to the
// scene. The states that a run would record are counted before its first step and bounded by
// kRecordedStates, since they all stay in memory. A run that is stopped or becomes unstable is
// still a result, with the recording up to there; only what could not begin is an error.
#include "tenon/asset/simulating/simulate_asset.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "tenon/asset/physics_options.h"
#include "tenon/bake/write_time_samples.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/files.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double duration_of(const SimulateAssetOptions& options, const scene::PhysicsScene& scene) {
  if (options.duration) {
    return *options.duration;
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
void announce_setup(const SimulateAssetOptions& options, const scene::PhysicsScene& scene,
                    Diagnostics& diagnostics) {
  constexpr double kSecondsPerPair = 1.5e-7;
  constexpr double kWorthTelling = 2;  // [s]
  const auto bodies = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                    [](const scene::Body& body) { return !body.kinematic; });
  const double seconds = kSecondsPerPair * std::pow(static_cast<double>(bodies), 2);
  if (options.engine != "mujoco" || seconds < kWorthTelling) {
    return;
  }
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = "sim.slow-setup";
  finding.message = "setting up " + grouped_digits(static_cast<std::size_t>(bodies)) +
                    " bodies on MuJoCo takes about " + std::to_string(std::llround(seconds)) +
                    " s; the time grows with the square of their number";
  finding.fix = "simulate a part of the scene with --mask";
  if (options.listener.announce) {
    options.listener.announce(finding);
  } else {
    diagnostics.add(std::move(finding));
  }
}

void tell_next(const SimulateAssetOptions& options, const std::string& what) {
  if (options.listener.next_part) {
    options.listener.next_part(what);
  }
}

Result<SimulatedAsset> read_scene(const std::string& path, const SimulateAssetOptions& options,
                                  Diagnostics& diagnostics) {
  SimulatedAsset read;
  const OpenOptions open = with_readings(options.open, options.readings);
  TENON_TRY(stage::Stage stage, open_stage(path, open, diagnostics));
  read.stage = std::make_unique<stage::Stage>(std::move(stage));
  read.scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(*read.stage, read_options(options.readings), diagnostics));
  return read;
}

Result<void> build_model(const SimulateAssetOptions& options, SimulatedAsset& asset,
                         Diagnostics& diagnostics) {
  engines::SimulationOptions simulation;
  simulation.time_step = options.time_step;
  TENON_TRY(asset.simulation,
            make_simulation(options.engine, *asset.scene, simulation, diagnostics));
  asset.engine = options.engine;
  for (const engines::EngineInfo& engine : list_engines()) {
    if (engine.name == options.engine) {
      asset.engine_version = engine.version;
    }
  }
  return {};
}

}  // namespace

Result<SimulatedAsset> simulate_asset(const std::string& path, const SimulateAssetOptions& options,
                                      Diagnostics& diagnostics) {
  TENON_TRY(SimulatedAsset asset, read_scene(path, options, diagnostics));
  announce_setup(options, *asset.scene, diagnostics);
  tell_next(options,
            "building the model of " + std::to_string(asset.scene->bodies.size()) + " bodies");
  TENON_CHECK(build_model(options, asset, diagnostics));
  bake::RunOptions run;
  run.duration = duration_of(options, *asset.scene);
  run.frames_per_second = options.frames_per_second;
  TENON_CHECK(check_run(run, asset.simulation->time_step(), *asset.scene));
  tell_next(options, "simulating");
  if (options.listener.go_on) {
    run.go_on = [&](double seconds) { return options.listener.go_on(seconds, run.duration); };
  }
  const auto start = Clock::now();
  asset.run = bake::run_simulation(*asset.simulation, *asset.scene, run);
  asset.wall_seconds = seconds_since(start);
  if (asset.run.failure) {
    diagnostics.add(asset.run.failure->diagnostic());
  }
  return asset;
}

layer::Layer motion_layer(const SimulatedAsset& simulated, const std::string& path,
                          const std::string& output, const MotionOptions& options,
                          Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  bake::BakeOptions bake;
  const fs::path folder = fs::path(bytes::absolute_file_path(output)).parent_path();
  const fs::path asset = bytes::absolute_file_path(path);
  const std::string relative = asset.lexically_relative(folder.lexically_normal()).generic_string();
  bake.uninstance = options.uninstance;
  bake.asset_path = relative.empty()          ? asset.generic_string()
                    : relative.front() == '.' ? relative
                                              : "./" + relative;
  if (!options.physics_variant.empty()) {
    bake.variant_selections["Physics"] = options.physics_variant;
  }
  return bake::write_time_samples(*simulated.stage, *simulated.scene,
                                  simulated.run.recording.poses(), bake, diagnostics);
}

}  // namespace tenon
