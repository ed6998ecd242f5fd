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
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "tenon/asset/layers/relative_path.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset/poses/start_pose.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/bake/write_time_samples.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/files.h"
#include "tenon/make_simulation.h"
#include "tenon/physics/read_physics.h"
#include "tenon/watches/report_faults.h"

namespace tenon {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// How many values of the size of a state a frame has.
double values_of_frame(const scene::PhysicsScene& scene, const engines::Outputs& outputs) {
  const auto bodies = static_cast<double>(scene.bodies.size());
  const auto joints = static_cast<double>(scene.joints.size());
  return (bodies + joints) * (outputs.accelerations ? 2 : 1) +
         joints * ((outputs.reactions ? 1 : 0) + (outputs.efforts ? 1 : 0)) +
         (outputs.sensors ? static_cast<double>(scene.sensors.size()) : 0);
}

/// Refuses what would take no step although time is to pass, and records that no memory holds.
Result<void> check_run(const bake::RunOptions& run, const engines::Simulation& simulation,
                       const scene::PhysicsScene& scene) {
  const double step = simulation.time_step();
  if (run.duration > 0 && run.duration < step * (1 - 1e-9)) {
    return Error(ErrorCode::Invalid, "a time step of " + shortest(step) + " s is longer than the " +
                                         shortest(run.duration) + " s to simulate")
        .with_rule("sim.time-step")
        .with_fix("give a smaller --dt or a longer --duration");
  }
  const double states =
      (run.duration * run.frames_per_second + 2) * values_of_frame(scene, *run.outputs);
  return check_recorded_states(states);
}

/// Announces that an engine is about to build its model, which may take long.
void announce_setup(const SimulateAssetOptions& options, const std::string& engine,
                    const scene::PhysicsScene& scene, Diagnostics& diagnostics) {
  constexpr double kWorthTelling = 2;  // [s]
  const auto bodies = std::count_if(scene.bodies.begin(), scene.bodies.end(),
                                    [](const scene::Body& body) { return !body.kinematic; });
  const double seconds =
      engine_info(engine).set_up_per_pair * std::pow(static_cast<double>(bodies), 2);
  if (seconds < kWorthTelling) {
    return;
  }
  Diagnostic finding;
  finding.severity = Severity::Warning;
  finding.rule = "sim.slow-setup";
  finding.message = "setting up " + grouped_digits(static_cast<std::size_t>(bodies)) +
                    " bodies on " + engine + " takes about " +
                    std::to_string(std::llround(seconds)) +
                    " s; the time grows with the square of their number";
  finding.fix = "simulate it with --engine physx or jolt, or a part of it with --mask";
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

/// Hands findings on. A drive that pushes away from its target is nothing to simulate: the first
/// finding that says so is the error instead.
Result<void> hand_on(const Diagnostics& found, Diagnostics& diagnostics) {
  Result<void> all_well;
  for (const Diagnostic& finding : found) {
    if (all_well && finding.rule == "drive.negative-gain") {
      all_well = Error(ErrorCode::Invalid, finding);
    } else {
      diagnostics.add(finding);
    }
  }
  return all_well;
}

Result<SimulatedAsset> read_scene(const std::string& path, const SimulateAssetOptions& options,
                                  Diagnostics& diagnostics) {
  SimulatedAsset read;
  const OpenOptions open = with_readings(options.open, options.readings);
  TENON_TRY(stage::Stage stage, tenon::open(path, open, diagnostics));
  read.stage = std::make_unique<stage::Stage>(std::move(stage));
  Diagnostics found;
  read.scene = std::make_unique<scene::PhysicsScene>(
      physics::read_physics(*read.stage, read_options(options.readings), found));
  TENON_CHECK(hand_on(found, diagnostics));
  TENON_CHECK(start_at(*read.stage, *read.scene, options.pose));
  TENON_CHECK(dynamics::apply_masks(options.masks, *read.scene, diagnostics));
  return read;
}

Result<void> build_model(const SimulateAssetOptions& options, SimulatedAsset& asset,
                         Diagnostics& diagnostics) {
  engines::SimulationOptions simulation;
  simulation.time_step = options.time_step;
  simulation.outputs = options.outputs;
  simulation.methods = options.methods;
  TENON_TRY(asset.simulation, make_simulation(asset.engine, *asset.scene, simulation, diagnostics));
  asset.engine_version = engine_info(asset.engine).version;
  return {};
}

/// All of a file that the run is steered by; at most `limit` bytes.
Result<std::shared_ptr<const bytes::FileBytes>> read_whole(const std::string& path,
                                                           const SimulateAssetOptions& options,
                                                           std::uint64_t limit) {
  bytes::FileRules rules;
  rules.max_bytes = limit;
  return options.open.files->open(path, rules);
}

Result<void> begin_from_state(const SimulateAssetOptions& options, SimulatedAsset& asset) {
  if (!options.state_in.empty()) {
    TENON_TRY(const auto file, read_whole(options.state_in, options, limits::kStateBytes));
    if (auto restored = asset.simulation->restore_state(file->text()); !restored) {
      return std::move(restored)
          .error()
          .in_file(options.state_in)
          .with_fix(
              "give a state that --state-out wrote of this asset, with the same variants, values "
              "and time step");
    }
  }
  asset.state_in = options.state_in;
  asset.begin = asset.simulation->time();
  return {};
}

Result<void> read_commands(const SimulateAssetOptions& options, SimulatedAsset& asset) {
  if (options.commands.empty()) {
    return {};
  }
  TENON_TRY(const auto file, read_whole(options.commands, options, limits::kCommandBytes));
  auto commands = bake::read_commands(file, *asset.scene, *asset.simulation);
  if (!commands) {
    return std::move(commands).error().in_file(options.commands);
  }
  asset.commands = *std::move(commands);
  asset.commands_file = options.commands;
  return {};
}

/// What the run is asked for, of an asset that is ready.
bake::RunOptions run_options(const SimulateAssetOptions& options, const SimulatedAsset& asset) {
  bake::RunOptions run;
  run.duration = run_duration(options.duration, *asset.scene);
  run.frames_per_second = options.frames_per_second;
  run.outputs = options.outputs;
  run.commands = asset.commands ? &*asset.commands : nullptr;
  run.until_rest = options.until_rest;
  if (options.listener.go_on) {
    run.go_on = [&options, begin = asset.begin, duration = run.duration](double seconds) {
      return options.listener.go_on(seconds - begin, duration);
    };
  }
  return run;
}

/// A mean of measurements before, or a reading that is held, is no part of a saved state.
bool remembers(const scene::Sensor& sensor, double time_step) {
  return sensor.enabled && (sensor.period > time_step || sensor.acceleration_width > 1 ||
                            sensor.velocity_width > 1 || sensor.orientation_width > 1);
}

/// What a log with sensors lacks.
void tell_sensors(const SimulateAssetOptions& options, const SimulatedAsset& asset,
                  Diagnostics& diagnostics) {
  const std::vector<scene::Sensor>& sensors = asset.scene->sensors;
  const double step = asset.simulation->time_step();
  Diagnostic finding;
  finding.severity = Severity::Warning;
  if (std::none_of(sensors.begin(), sensors.end(),
                   [](const scene::Sensor& sensor) { return sensor.enabled; })) {
    finding.rule = "sim.no-sensors";
    finding.message = "the log is to have sensors, and the asset has none that measure";
    finding.fix = "author IsaacContactSensor or IsaacImuSensor prims, or tenon:sensor";
  } else if (!options.state_in.empty() &&
             std::any_of(sensors.begin(), sensors.end(),
                         [step](const scene::Sensor& sensor) { return remembers(sensor, step); })) {
    finding.rule = "sim.sensors-anew";
    finding.message =
        "means and periods of sensors restart where the run is continued: a saved state has no "
        "measurements";
  }
  if (!finding.rule.empty()) {
    diagnostics.add(std::move(finding));
  }
}

void report_end(const SimulateAssetOptions& options, const SimulatedAsset& asset,
                Diagnostics& diagnostics) {
  const bake::Run& run = asset.run;
  watches::report_faults(*asset.scene, run.faults, run.events, diagnostics);
  if (asset.commands && !run.failure && !run.interrupted) {
    bake::tell_rows_outside(*asset.commands, run.time, diagnostics);
  }
  if (run.failure) {
    diagnostics.add(run.failure->diagnostic());
  } else if (options.until_rest && !run.rest_since && !run.interrupted) {
    Diagnostic finding;
    finding.severity = Severity::Warning;
    finding.rule = "sim.not-at-rest";
    finding.message =
        "not everything was at rest when the run ended at " + shortest(run.time) + " s";
    finding.fix = "give a longer --duration";
    diagnostics.add(std::move(finding));
  }
}

}  // namespace

double run_duration(const std::optional<double>& asked, const scene::PhysicsScene& scene) {
  if (asked) {
    return *asked;
  }
  const double authored =
      (scene.end_time_code - scene.start_time_code) / scene.time_codes_per_second;
  return authored > 0 && std::isfinite(authored) ? authored : 5.0;
}

Result<void> check_recorded_states(double states) {
  if (states > static_cast<double>(limits::kRecordedStates)) {
    return Error(ErrorCode::Limit, "the run would record " + shortest(std::floor(states)) +
                                       " states of bodies and joints; the limit is " +
                                       std::to_string(limits::kRecordedStates))
        .with_rule("sim.record-too-long")
        .with_fix("give a lower --fps or a shorter --duration");
  }
  return {};
}

Result<SimulatedAsset> simulate_asset(const std::string& path, const SimulateAssetOptions& options,
                                      Diagnostics& diagnostics) {
  TENON_TRY(SimulatedAsset asset, read_scene(path, options, diagnostics));
  asset.engine = choose_engine(options.engine, *asset.stage, diagnostics);
  announce_setup(options, asset.engine, *asset.scene, diagnostics);
  tell_next(options,
            "building the model of " + std::to_string(asset.scene->bodies.size()) + " bodies");
  TENON_CHECK(build_model(options, asset, diagnostics));
  TENON_CHECK(begin_from_state(options, asset));
  TENON_CHECK(read_commands(options, asset));
  if (options.outputs.sensors) {
    tell_sensors(options, asset, diagnostics);
  }
  asset.until_rest = options.until_rest.has_value();
  const bake::RunOptions run = run_options(options, asset);
  TENON_CHECK(check_run(run, *asset.simulation, *asset.scene));
  tell_next(options, "simulating");
  const auto start = Clock::now();
  asset.run = bake::run_simulation(*asset.simulation, *asset.scene, run);
  asset.wall_seconds = seconds_since(start);
  report_end(options, asset, diagnostics);
  return asset;
}

Result<std::string> end_state(const SimulatedAsset& simulated) {
  if (simulated.run.failure) {
    return *simulated.run.failure;
  }
  return simulated.simulation->save_state();
}

namespace {

/// Variants of "Physics" that the session layer selects.
std::map<Path, std::map<std::string, std::string>> physics_selections(const stage::Stage& stage) {
  std::map<Path, std::map<std::string, std::string>> found;
  if (stage.session_layer() == nullptr) {
    return found;
  }
  for (const auto& entry : stage.session_layer()->entries()) {
    const auto* selections =
        entry.spec.get<layer::VariantSelections>(layer::fields::variantSelection);
    const auto physics = selections == nullptr ? decltype(selections->items.end())()
                                               : selections->items.find("Physics");
    if (selections == nullptr || physics == selections->items.end()) {
      continue;
    }
    const auto sets = stage.prim(entry.path).variant_set_names();
    if (std::find(sets.begin(), sets.end(), "Physics") != sets.end()) {
      found[entry.path].insert(*physics);
    }
  }
  return found;
}

}  // namespace

layer::Layer motion_layer(const SimulatedAsset& simulated, const std::string& path,
                          const std::string& output, const MotionOptions& options,
                          Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  bake::BakeOptions bake;
  const fs::path folder = fs::path(bytes::absolute_file_path(output)).parent_path();
  bake.uninstance = options.uninstance;
  bake.asset_path = relative_asset_path(bytes::absolute_file_path(path), folder);
  bake.variant_selections = physics_selections(*simulated.stage);
  return bake::write_time_samples(*simulated.stage, *simulated.scene,
                                  simulated.run.recording.poses(), bake, diagnostics);
}

}  // namespace tenon
