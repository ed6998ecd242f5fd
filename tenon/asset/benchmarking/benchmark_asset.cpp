// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each engine opens the asset for itself, under the variant that is its own. The drops come first:
// the tests of joints hold roots that float in the same scene.
#include "tenon/asset/benchmarking/benchmark_asset.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tenon/asset/benchmarking/benchmark_run.h"
#include "tenon/asset/physics_options.h"
#include "tenon/asset/simulating/engine_choice.h"
#include "tenon/make_simulation.h"
#include "tenon/physics/read_physics.h"

namespace tenon {
namespace {

constexpr double kBenchmarkGravity = 9.81;           // [m/s^2]
constexpr double kLargestBenchmarkStep = 1.0 / 240;  // [s]

void set_gravity(scene::PhysicsScene& scene) {
  for (scene::Scene& one : scene.scenes) {
    one.gravity = scene.up * -kBenchmarkGravity;
  }
  scene.gravity_tracks.clear();
  scene.scene_tracks.clear();
}

Result<void> run_benchmark_tests(const std::vector<std::string>& wanted, BenchmarkRun& run,
                                 std::vector<BenchmarkResult>& results) {
  const std::vector<std::string> names = benchmark_test_names();
  std::vector<BenchmarkTest> of_joints;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto test = static_cast<BenchmarkTest>(i);
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), names[i]) == wanted.end()) {
      continue;
    }
    if (test > BenchmarkTest::SlopeDrop) {
      of_joints.push_back(test);
      continue;
    }
    if (run.listener->next_part) {
      run.listener->next_part(names[i]);
    }
    auto result = run_drop(run, test);
    if (!result && result.error().code() == ErrorCode::Missing) {
      return std::move(result).error();
    }
    if (run.interrupted) {
      return {};
    }
    results.push_back(result ? std::move(*result) : blocked_test(test, result.error()));
  }
  auto joints = run_joint_tests(run, of_joints);
  if (joints) {
    std::move(joints->begin(), joints->end(), std::back_inserter(results));
    return {};
  }
  if (joints.error().code() == ErrorCode::Missing) {
    return std::move(joints).error();
  }
  for (const BenchmarkTest test : of_joints) {
    results.push_back(blocked_test(test, joints.error()));
  }
  return {};
}

/// What is found in the asset goes to `findings`, what the engine finds to `diagnostics`.
Result<BenchmarkedEngine> benchmark_engine(const std::string& path, const std::string& name,
                                           const BenchmarkOptions& options,
                                           const stage::Stage& stage, Diagnostics& findings,
                                           Diagnostics& diagnostics) {
  BenchmarkedEngine engine;
  engine.engine = name;
  engine.version = engine_info(name).version;
  OpenOptions open = with_readings(options.open, options.readings);
  engine.variant = select_own_variant(name, stage, open);
  TENON_TRY(const stage::Stage own, tenon::open(path, open, findings));
  BenchmarkRun run;
  run.scene = physics::read_physics(own, read_options(options.readings), findings);
  if (run.scene.bodies.empty()) {
    return Error(ErrorCode::NotFound, "the asset has no rigid body: nothing can fall or move")
        .with_rule("benchmark.no-body")
        .with_fix("make its prims bodies: tenon add ASSET PRIM=body,collider");
  }
  set_gravity(run.scene);
  const double asked = run.scene.scenes.front().time_step.value_or(0);
  run.time_step = options.time_step > 0 ? options.time_step
                  : asked > 0           ? std::min(asked, kLargestBenchmarkStep)
                                        : kLargestBenchmarkStep;
  engine.time_step = run.time_step;
  run.listener = &options.listener;
  Diagnostics found;
  run.make = [&](const scene::PhysicsScene& of, const engines::SimulationOptions& simulation) {
    Diagnostics all;  // of the scenes of other tests the same
    auto made = make_simulation(name, of, simulation, all);
    found = found.empty() ? all : found;
    return made;
  };
  TENON_CHECK(run_benchmark_tests(options.tests, run, engine.results));
  engine.interrupted = run.interrupted;
  for (const Diagnostic& finding : found) {
    if (finding.severity != Severity::Info) {
      diagnostics.add(finding);
    }
  }
  return engine;
}

}  // namespace

bool BenchmarkedAsset::passed() const {
  return std::all_of(engines.begin(), engines.end(), [](const BenchmarkedEngine& engine) {
    return std::all_of(engine.results.begin(), engine.results.end(), [](const auto& result) {
      return result.verdict == BenchmarkVerdict::Pass ||
             result.verdict == BenchmarkVerdict::Skipped;
    });
  });
}

bool BenchmarkedAsset::interrupted() const {
  return std::any_of(engines.begin(), engines.end(),
                     [](const BenchmarkedEngine& engine) { return engine.interrupted; });
}

Result<BenchmarkedAsset> benchmark_asset(const std::string& path, const BenchmarkOptions& options,
                                         Diagnostics& diagnostics) {
  Diagnostics again;  // findings that the first engine, which opens the asset for itself, tells
  TENON_TRY(const stage::Stage stage,
            tenon::open(path, with_readings(options.open, options.readings), again));
  TENON_TRY(const auto names, chosen_engines(options.engine, stage, diagnostics));
  BenchmarkedAsset benchmarked;
  for (const std::string& name : names) {
    if (!benchmarked.interrupted()) {
      Diagnostics& findings = benchmarked.engines.empty() ? diagnostics : again;
      TENON_TRY(BenchmarkedEngine engine,
                benchmark_engine(path, name, options, stage, findings, diagnostics));
      benchmarked.engines.push_back(std::move(engine));
    }
  }
  return benchmarked;
}

}  // namespace tenon
