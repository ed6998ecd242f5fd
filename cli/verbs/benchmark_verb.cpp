// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/simulate.h"
#include "cli/text/benchmark_text.h"
#include "cli/verb.h"
#include "tenon/asset/benchmarking/benchmark_asset.h"
#include "tenon/engines/engines.h"

namespace tenon::cli {
namespace {

struct BenchmarkArguments {
  SimulateArguments run;  ///< the asset, readings, engine and time step
  std::vector<std::string> tests;
  bool list = false;
};

Result<BenchmarkOptions> benchmark_options(const BenchmarkArguments& arguments, Report& report) {
  if (arguments.run.asset.asset.empty()) {
    return Error(ErrorCode::Invalid, "there is no asset to test")
        .with_rule("usage.missing-argument")
        .with_fix("name a file, or give --list");
  }
  BenchmarkOptions options;
  TENON_TRY(options.engine, engine_for(arguments.run.engine, arguments.run.asset.asset, report));
  TENON_TRY(options.readings, chosen_readings(arguments.run.readings));
  options.open = arguments.run.asset.open_options();
  options.time_step = arguments.run.time_step;
  options.tests = arguments.tests;
  return options;
}

int run_benchmark(const Globals& globals, const BenchmarkArguments& arguments) {
  Report report(globals, "benchmark", arguments.run.asset.asset);
  if (arguments.list) {
    Json json = benchmark_tests_json();
    if (!globals.json) {
      print_text(benchmark_tests_text(json));
    }
    return report.finish(kOk, std::move(json));
  }
  auto options = benchmark_options(arguments, report);
  if (!options) {
    return report.fail(options.error());
  }
  RunWatch watch(arguments.run, report);
  options->listener = watch.listener();
  auto benchmarked = benchmark_asset(arguments.run.asset.asset, *options, report.diagnostics);
  if (!benchmarked) {
    return report.fail(benchmarked.error());
  }
  Json json = benchmarked_json(*benchmarked);
  if (!globals.json) {
    print_text(benchmark_text(json));
  }
  return report.finish(benchmarked->interrupted() ? kInterrupted
                       : benchmarked->passed()    ? kOk
                                                  : kNo,
                       std::move(json));
}

constexpr const char* kBenchmarkFooter =
    "The tests are those of NVIDIA's SimReady Benchmark that are files and numbers, with its "
    "thresholds, on the engines of tenon (docs/benchmark.md). Drops need a body that is not fixed "
    "to the world; the others are about joints with a position drive. Where an asset has nothing "
    "that a test is about, it is skipped; blocked says that the engine cannot run it. A line has "
    "the joint that decides; --json has all of them.\n\n"
    "Exit codes: 0 all passed or skipped, 1 a test failed or is blocked, 2 bad input, 4 no such "
    "engine.\n\n"
    "Examples:\n"
    "  tenon benchmark hand.usda                      all tests, on the asset's engine\n"
    "  tenon benchmark hand.usda --engine all         on each engine of this build\n"
    "  tenon benchmark box.usda --tests ground_drop,slope_drop\n"
    "  tenon benchmark --list                         what there is to test";

}  // namespace

void add_benchmark(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "benchmark", "The physics tests of SimReady Benchmark: drops, ranges, limits, gains");
  auto options = std::make_shared<BenchmarkArguments>();
  options->run.asset.add_to(verb);
  verb.option("asset").required(false);
  std::vector<std::string> names = engines::engine_names();
  names.emplace_back("all");
  verb.add_option("--engine", options->run.engine,
                  "The engine, or all of this build; without it that of tenon.toml, else that of "
                  "the selected variant")
      .one_of(names)
      .value_name("NAME");
  verb.add_option("--tests", options->tests, "Tests to run; all by default")
      .one_of(benchmark_test_names())
      .split_at_commas()
      .repeatable()
      .value_name("NAMES");
  verb.add_flag("--list", options->list, "Name the tests and what they are about");
  verb.add_option("--dt", options->run.time_step, {1e-5, 0.1, false, false, "s"},
                  "Time step; without it the asset's, 1/240 s at most")
      .value_name("SECONDS");
  add_readings(verb, options->run.readings);
  verb.add_option("--set", options->run.asset.overrides,
                  "PATH.attr=value, for this run only; may be repeated")
      .repeatable();
  verb.footer(kBenchmarkFooter);
  choose(verb, chosen, [&globals, options] { return run_benchmark(globals, *options); });
}

}  // namespace tenon::cli
