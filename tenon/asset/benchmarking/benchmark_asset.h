// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/simulating/simulate_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"

/// The physics tests of NVIDIA's SimReady Benchmark that are files and numbers, on any engine.
/// docs/benchmark.md says what each does and where its thresholds come from.
namespace tenon {

enum class BenchmarkTest : std::uint8_t {
  GroundDrop,
  SlopeDrop,
  FullRangeSweep,
  EffortLimit,
  VelocityLimit,
  MimicJoint,
  DriveGains,
};
/// As the benchmark calls them, in the order of BenchmarkTest, in which they run: "ground_drop".
std::vector<std::string> benchmark_test_names();

enum class BenchmarkVerdict : std::uint8_t {
  Pass,
  Fail,
  Skipped,  ///< not applicable: the asset has nothing that the test is about
  Blocked,  ///< the engine cannot run it
};

/// What was measured of one joint, or in a drop.
struct BenchmarkRow {
  Path prim;              ///< the joint, or the body that a drop is about; empty: the asset
  std::string_view axis;  ///< of a joint: its degree of freedom
  BenchmarkVerdict verdict = BenchmarkVerdict::Pass;
  std::string_view measure;  ///< what was measured: "peak speed"
  double measured = 0;       ///< in `unit`: SI, radians or per cent
  double threshold = 0;
  std::string_view unit;
  std::string reason;  ///< of a failure: a sentence without an end
  std::vector<std::pair<std::string_view, double>> numbers;  ///< others, SI and radians
};

struct BenchmarkResult {
  BenchmarkTest test = BenchmarkTest::GroundDrop;
  BenchmarkVerdict verdict = BenchmarkVerdict::Skipped;  ///< fail where a row failed
  std::string reason;                                    ///< of skipped and blocked
  std::vector<BenchmarkRow> rows;
};

struct BenchmarkOptions {
  OpenOptions open;
  physics::Readings readings;
  /// "mujoco", "physx", "jolt", "all"; empty: as choose_engine() decides. Each runs with the
  /// variant of "Physics" that is its own, where `open` selects none.
  std::string engine;
  std::vector<std::string> tests;  ///< names; empty: all
  double time_step = 0;            ///< [s]; 0: the asset's, 1/240 s at most
  SimulationListener listener;
};

struct BenchmarkedEngine {
  std::string engine;
  std::string version;
  std::string variant;   ///< of "Physics"; empty: none is selected
  double time_step = 0;  ///< [s]
  std::vector<BenchmarkResult> results;
  bool interrupted = false;
};

struct BenchmarkedAsset {
  std::vector<BenchmarkedEngine> engines;

  /// No test failed or was blocked.
  bool passed() const;
  bool interrupted() const;
};

/// Gravity is 9.81 m/s^2 against the stage's up axis; drops have a ground in place of the asset's
/// static colliders, in tests of joints floating roots are held. What becomes unstable fails.
/// Errors: those of tenon::open; NotFound (benchmark.no-body) for an asset without rigid bodies,
/// Missing (engine.missing) where an engine is not installed. Other errors of an engine block a
/// test.
Result<BenchmarkedAsset> benchmark_asset(const std::string& path, const BenchmarkOptions& options,
                                         Diagnostics& diagnostics);

/// {"passed", "engines": [{"engine", "engineVersion", "variant", "timeStep" [s], "tests": [{"test",
/// "verdict" ("pass", "fail", "skipped", "blocked"), "reason", "rows": [{"prim", "axis", "verdict",
/// "measure", "measured", "threshold", "unit", "reason", "numbers": {...}}]}]}]}, of rows the one
/// that decides first. Null where there is no such number or text.
answers::Json benchmarked_json(const BenchmarkedAsset& benchmarked);

/// {"tests": [{"name", "what"}]} of all tests.
answers::Json benchmark_tests_json();

}  // namespace tenon
