// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Rates and memory are those of this run on this machine; what does not depend on them (ends, drawn
// numbers, the digest) is the same in every run. The text shows the first environments that failed.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/progress.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/verb.h"
#include "tenon/asset/many_environments/bench_asset.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/engines/engines.h"

namespace tenon::cli {
namespace {

struct BenchArguments {
  AssetArguments asset;
  std::vector<std::string> readings;
  dynamics::Masks masks;
  std::string engine;
  std::size_t environments = 1;
  std::size_t threads = 0;
  std::optional<double> duration;
  double time_step = 0;
  std::size_t steps_per_call = 0;
  std::size_t seed = 0;
  std::vector<std::string> variations;
};

Result<BenchOptions> options_of(const BenchArguments& arguments, Report& report) {
  BenchOptions options;
  TENON_TRY(options.engine, engine_for(arguments.engine, arguments.asset.asset, report));
  TENON_TRY(options.readings, chosen_readings(arguments.readings));
  options.open = arguments.asset.open_options();
  options.masks = arguments.masks;
  options.environments = arguments.environments;
  options.threads = arguments.threads;
  options.duration = arguments.duration;
  options.time_step = arguments.time_step;
  options.steps_per_call = arguments.steps_per_call;
  options.seed = arguments.seed;
  for (const std::string& text : arguments.variations) {
    TENON_TRY(Variation variation, read_variation(text));
    options.variations.push_back(std::move(variation));
  }
  return options;
}

std::string whole(const Json& number) {
  return number.is_null() ? "?" : grouped_digits(static_cast<std::size_t>(number.get<double>()));
}

void print_bench(const Json& bench) {
  print("%s %s  %s %s on %s, %s s in steps of %s s\n", bench["engine"].get<std::string>().c_str(),
        bench["engineVersion"].get<std::string>().c_str(), whole(bench["environments"]).c_str(),
        noun_for(bench["environments"].get<std::size_t>(), "environment").c_str(),
        counted(bench["threads"].get<std::size_t>(), "thread").c_str(),
        rounded_text(bench["duration"].get<double>()).c_str(),
        rounded_text(bench["timeStep"].get<double>()).c_str());
  print("set up in %s s, %s %s\n", rounded_text(bench["setupSeconds"].get<double>(), 3).c_str(),
        whole(bench["scenes"]).c_str(), bench["scenes"] == 1 ? "scene for all" : "scenes");
  print("%s steps a second, %s a second of CPU; %s times real time in all\n",
        whole(bench["stepsPerSecond"]).c_str(), whole(bench["stepsPerCpuSecond"]).c_str(),
        whole(bench["realTimeFactor"]).c_str());
  if (!bench["bytesPerEnvironment"].is_null()) {
    print("%s KiB of memory an environment\n",
          rounded_text(bench["bytesPerEnvironment"].get<double>() / 1024, 4).c_str());
  }
  print("digest of all states %s\n", bench["digest"].get<std::string>().c_str());
  constexpr std::size_t kShown = 10;
  std::size_t shown = 0;
  for (std::size_t i = 0; i < bench["each"].size() && shown < kShown; ++i) {
    const Json& end = bench["each"][i];
    if (!end["failure"].is_null()) {
      print("environment %zu failed at %s s: %s\n", i,
            rounded_text(end["time"].get<double>()).c_str(),
            end["failure"].get<std::string>().c_str());
      ++shown;
    }
  }
  if (const auto failed = bench["failed"].get<std::size_t>(); failed > shown) {
    print("and %zu more failed; --json lists all\n", failed - shown);
  }
}

int run_bench(const Globals& globals, const BenchArguments& arguments) {
  Report report(globals, "bench", arguments.asset.asset);
  auto options = options_of(arguments, report);
  if (!options) {
    return report.fail(options.error());
  }
  Progress progress(globals, "simulating " + shown_path(arguments.asset.asset));
  const auto benched = bench_asset(arguments.asset.asset, *options, report.diagnostics);
  if (!benched) {
    return report.fail(benched.error());
  }
  Json json = benched_json(*benched, *options);
  if (!globals.json) {
    print_bench(json);
  }
  return report.finish(benched->failed() > 0 ? kUnstable : kOk, std::move(json));
}

constexpr const char* kBenchFooter =
    "--vary gives every environment a number of its own from a range, drawn from --seed, the "
    "number of the environment and that of the option, and nothing else. Factors of bodyMass, "
    "colliderFriction, driveStiffness, driveDamping, driveMaxForce, jointDamping, jointFriction, "
    "jointArmature and gravity, and offsets of jointPosition (m, rad) and bodyPosition (m) share "
    "one model; any other number of tenon physics --json, such as colliders.shape.radius or "
    "joints.upper, is a factor too and gives each environment a model of its own. Exit code 3: an "
    "environment failed.\n\n"
    "Examples:\n"
    "  tenon bench hand.usda --envs 64 --duration 1\n"
    "  tenon bench hand.usda --envs 1024 -j 8 --vary bodyMass=0.8..1.2 --vary gravity=0.9..1.1\n"
    "  tenon bench grasp.usda --envs 16 --vary bodyPosition@/World/can=-0.005..0.005 --json";

}  // namespace

void add_bench(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("bench", "Many simulations at a time: rate, memory, results");
  auto options = std::make_shared<BenchArguments>();
  options->asset.add_with_standard_input_to(verb);
  verb.add_option("--envs", options->environments, {1, 1e6, false, true, ""},
                  "Number of environments")
      .value_name("COUNT");
  verb.add_option("-j,--threads", options->threads, {0, 4096, false, true, ""},
                  "Number of threads; 0 is one for each processor")
      .value_name("COUNT");
  verb.add_option("--engine", options->engine, "The engine; without it as in tenon sim")
      .one_of(engines::engine_names())
      .value_name("NAME");
  verb.add_option("--duration", options->duration, {0, 1e6, false, false, "s"},
                  "Time to simulate; without it the stage's time range, else 5 s")
      .value_name("SECONDS");
  verb.add_option("--dt", options->time_step, {1e-9, 10, false, false, "s"},
                  "Time step; without it the asset's, else 0.002 s")
      .value_name("SECONDS");
  verb.add_option("--steps", options->steps_per_call, {0, 1e9, false, true, ""},
                  "Steps between two meetings of the threads; 0 is all")
      .value_name("COUNT");
  verb.add_option("--vary", options->variations, "NAME=LOW..HIGH or NAME@/path=LOW..HIGH")
      .repeatable()
      .value_name("WHAT");
  verb.add_option("--seed", options->seed, {0, 1e15, false, true, ""},
                  "Seed of the draws of --vary")
      .value_name("NUMBER")
      .only_with({"--vary"});
  add_readings(verb, options->readings);
  add_masks(verb, options->masks);
  verb.add_option("--set", options->asset.overrides,
                  "PATH.attr=value, for this run only; may be repeated")
      .repeatable();
  verb.footer(kBenchFooter);
  choose(verb, chosen, [&globals, options] { return run_bench(globals, *options); });
}

}  // namespace tenon::cli
