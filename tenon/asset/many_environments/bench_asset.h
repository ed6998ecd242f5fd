// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/asset/many_environments/variation.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/masks.h"
#include "tenon/engines/methods.h"
#include "tenon/open_stage.h"
#include "tenon/physics/readings.h"

/// Many simulations of one asset at a time: how fast, how large, and what became of each.
namespace tenon {

struct BenchOptions {
  OpenOptions open;
  physics::Readings readings;
  dynamics::Masks masks;  ///< links and joints that the runs skip or hold
  std::string engine;     ///< empty: as choose_engine() decides
  std::size_t environments = 1;
  std::size_t threads = 0;         ///< 0: as many as this process may use
  std::optional<double> duration;  ///< [s]; not given: what the stage's time range says, else 5
  double time_step = 0;            ///< [s]; 0: the asset's, else the engine's
  engines::Methods methods{};
  std::size_t steps_per_call = 0;  ///< of each call of Environments::step; 0: all at once
  std::vector<Variation> variations;
  std::uint64_t seed = 0;
};

struct EnvironmentEnd {
  double time = 0;  ///< [s] after the last step that succeeded
  std::optional<Error> failure;
  std::vector<std::vector<double>> numbers;  ///< what each variation drew
};

struct BenchedAsset {
  std::string engine;
  std::string engine_version;
  std::size_t threads = 1;
  double time_step = 0;    ///< [s]
  double duration = 0;     ///< [s]
  std::size_t steps = 0;   ///< of all environments
  std::size_t scenes = 1;  ///< that models were made of: one, or one for each
  double setup_seconds = 0;
  double wall_seconds = 0;                      ///< of all steps
  double cpu_seconds = 0;                       ///< of all steps, over all threads
  std::optional<double> bytes_per_environment;  ///< by what the process grew; none: not told
  std::uint64_t digest = 0;  ///< of all states at the end; the same for any number of threads
  std::vector<EnvironmentEnd> environments;

  std::size_t failed() const;
};

/// Errors: those of tenon::open, make_environments and of variations; Invalid (sim.time-step). An
/// environment that fails is a result.
Result<BenchedAsset> bench_asset(const std::string& path, const BenchOptions& options,
                                 Diagnostics& diagnostics);

/// {"engine", "engineVersion", "environments", "threads", "timeStep" [s], "duration" [s], "steps",
/// "scenes", "setupSeconds", "stepsPerSecond", "stepsPerCpuSecond", "realTimeFactor",
/// "bytesPerEnvironment", "digest", "failed", "variations": names, "each": [{"time" [s], "failure",
/// "numbers"}]}.
answers::Json benched_json(const BenchedAsset& benched, const BenchOptions& options);

}  // namespace tenon
