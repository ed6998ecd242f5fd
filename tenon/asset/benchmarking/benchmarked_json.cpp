// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>

#include "tenon/answers/or_null.h"
#include "tenon/asset/benchmarking/benchmark_asset.h"

namespace tenon {
namespace {

using answers::finite_or_null;
using answers::Json;
using answers::or_null;

struct BenchmarkWords {
  const char* name;
  const char* what;
};
/// By BenchmarkTest.
constexpr std::array kBenchmarkTests{
    BenchmarkWords{"ground_drop", "falls on flat ground, stays above it and comes to rest"},
    BenchmarkWords{"slope_drop", "falls on a ramp of 45 degrees, slides down and stays above it"},
    BenchmarkWords{"full_range_sweep", "each driven joint goes to both limits and back"},
    BenchmarkWords{"effort_limit", "10 N in 12 directions push no driven joint beyond a limit"},
    BenchmarkWords{"velocity_limit", "no driven joint is faster than its velocity limit"},
    BenchmarkWords{"mimic_joint", "followers move as far as their leaders make them"},
    BenchmarkWords{"drive_gain_validation", "a step of 30 degrees settles without much overshoot"},
};
/// By BenchmarkVerdict.
constexpr std::array kBenchmarkVerdicts{"pass", "fail", "skipped", "blocked"};

std::string verdict_text(BenchmarkVerdict verdict) {
  return kBenchmarkVerdicts[static_cast<std::size_t>(verdict)];
}

Json benchmark_row_json(const BenchmarkRow& row) {
  Json numbers = Json::object();
  for (const auto& [name, value] : row.numbers) {
    numbers[std::string(name)] = finite_or_null(value);
  }
  return {{"prim", or_null(row.prim)},
          {"axis", or_null(std::string(row.axis))},
          {"verdict", verdict_text(row.verdict)},
          {"measure", std::string(row.measure)},
          {"measured", finite_or_null(row.measured)},
          {"threshold", finite_or_null(row.threshold)},
          {"unit", std::string(row.unit)},
          {"reason", or_null(row.reason)},
          {"numbers", std::move(numbers)}};
}

Json benchmarked_engine_json(const BenchmarkedEngine& engine) {
  Json tests = Json::array();
  for (const BenchmarkResult& result : engine.results) {
    Json rows = Json::array();
    for (const BenchmarkRow& row : result.rows) {
      rows.push_back(benchmark_row_json(row));
    }
    tests.push_back({{"test", kBenchmarkTests[static_cast<std::size_t>(result.test)].name},
                     {"verdict", verdict_text(result.verdict)},
                     {"reason", or_null(result.reason)},
                     {"rows", std::move(rows)}});
  }
  return {{"engine", engine.engine},
          {"engineVersion", engine.version},
          {"variant", or_null(engine.variant)},
          {"timeStep", engine.time_step},
          {"tests", std::move(tests)}};
}

}  // namespace

std::vector<std::string> benchmark_test_names() {
  std::vector<std::string> names;
  for (const BenchmarkWords& words : kBenchmarkTests) {
    names.emplace_back(words.name);
  }
  return names;
}

Json benchmarked_json(const BenchmarkedAsset& benchmarked) {
  Json engines = Json::array();
  for (const BenchmarkedEngine& engine : benchmarked.engines) {
    engines.push_back(benchmarked_engine_json(engine));
  }
  return {{"passed", benchmarked.passed()}, {"engines", std::move(engines)}};
}

Json benchmark_tests_json() {
  Json tests = Json::array();
  for (const BenchmarkWords& words : kBenchmarkTests) {
    tests.push_back({{"name", words.name}, {"what", words.what}});
  }
  return {{"tests", std::move(tests)}};
}

}  // namespace tenon
