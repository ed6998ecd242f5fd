// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The kind of report is told by the ending of its name. A comparison whose runs failed on their way
// is printed and written as far as it goes, and the exit code tells.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/text/compare_text.h"
#include "cli/verb.h"
#include "tenon/asset/comparing_engines/compared_engines_json.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

struct CompareArguments {
  AssetArguments asset;
  std::vector<std::string> readings;
  std::vector<std::string> pose;
  dynamics::Masks masks;
  std::vector<std::string> engines;
  std::optional<double> duration;
  double time_step = 0;
  double frames_per_second = 60;
  std::string commands;
  std::vector<std::string> metrics;
  std::vector<std::string> bounds;
  std::size_t trials = 100;
  bool no_reasons = false;
  bool timing = false;
  std::string output;
};

Result<CompareEnginesOptions> options_of(const CompareArguments& arguments, Report& report) {
  CompareEnginesOptions options;
  TENON_TRY(options.first, engine_for("", arguments.asset.asset, report));
  TENON_TRY(options.readings, chosen_readings(arguments.readings));
  options.pose = arguments.pose;
  options.masks = arguments.masks;
  options.open = arguments.asset.open_options();
  options.engines = arguments.engines;
  options.duration = arguments.duration;
  options.time_step = arguments.time_step;
  options.frames_per_second = arguments.frames_per_second;
  options.commands = arguments.commands;
  options.trials = arguments.no_reasons ? 0 : arguments.trials;
  for (const std::string& text : arguments.bounds) {
    TENON_TRY(const std::vector<GapBound> bounds, gap_bounds(text));
    options.bounds.insert(options.bounds.end(), bounds.begin(), bounds.end());
  }
  return options;
}

/// Removes the metrics that were not requested.
void keep_metrics(const std::vector<std::string>& names, ComparedEngines& compared) {
  if (names.empty()) {
    return;
  }
  for (EnginePair& pair : compared.pairs) {
    std::erase_if(pair.gaps, [&](const motions::Gap& gap) {
      return std::find(names.begin(), names.end(), motions::info_of(gap.metric).name) ==
             names.end();
    });
  }
}

Result<void> write_output(const CompareArguments& arguments, const ComparedEngines& compared,
                          const Json& json, Outputs& outputs) {
  const std::string& path = arguments.output;
  if (path.empty()) {
    return {};
  }
  outputs.put(path, path.ends_with(".csv") ? compared_engines_csv(compared)
                    : path.ends_with(".json")
                        ? answers::printed(json)
                        : compared_engines_html(arguments.asset.asset, compared, arguments.timing));
  return outputs.commit();
}

int code_of(const ComparedEngines& compared) {
  if (const Error* failure = compared.failure()) {
    return failure->code() == ErrorCode::Unstable ? kUnstable : cli::exit_code_of(*failure);
  }
  return compared.interrupted() ? kInterrupted : compared.exceeded.empty() ? kOk : kNo;
}

int run_compare(const Globals& globals, const CompareArguments& arguments) {
  Report report(globals, "compare", arguments.asset.asset);
  Outputs outputs;
  if (auto claimed = outputs.claim(OutputKind::Comparison, arguments.output); !claimed) {
    return report.fail(claimed.error());
  }
  auto options = options_of(arguments, report);
  if (!options) {
    return report.fail(options.error());
  }
  Progress progress(globals, "reading " + shown_path(arguments.asset.asset));
  options->listener.next_part = [&](const std::string& what) { progress.next(what); };
  options->listener.go_on = [&](double seconds, double duration) {
    progress.at(seconds, duration, "s");
    return true;
  };
  auto compared = compare_engines(arguments.asset.asset, *options, report.diagnostics);
  if (!compared) {
    return report.fail(compared.error());
  }
  keep_metrics(arguments.metrics, *compared);
  Json json = compared_engines_json(*compared, arguments.timing);
  if (auto written = write_output(arguments, *compared, json, outputs); !written) {
    return report.fail(written.error());
  }
  if (!globals.json) {
    print_text(compare_text(json));
  }
  return report.finish(code_of(*compared), std::move(json));
}

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const motions::MetricInfo& info : motions::metrics()) {
    names.emplace_back(info.name);
  }
  return names;
}

constexpr const char* kCompareFooter =
    "Each engine gets the variant of \"Physics\" that is its own (physx: physx, mujoco: mujoco, "
    "else physics), unless --physics chooses one for all or ENGINE:VARIANT one for an engine. Why "
    "they differ is measured: each cause (what an engine cannot express, what its layer says "
    "differently, what an engine chose itself, the time step) is taken away in a run of its own, "
    "and its share is what the mean distance of the bodies loses. Exit codes: 0, 1 above a bound "
    "of --fail-above, 3 unstable.\n\n"
    "Examples:\n"
    "  tenon compare hand.usda --duration 5\n"
    "  tenon compare hand.usda --engines mujoco,physx --fail-above 5mm --fail-above 1deg\n"
    "  tenon compare hand.usda --engines mujoco:physics,mujoco:mujoco    two layers on one engine\n"
    "  tenon compare hand.usda --commands grasp.csv -o report.html";

void add_run_options(const Command& verb, CompareArguments& options) {
  verb.add_option("--duration", options.duration, {0, 1e6, false, false, "s"},
                  "Time to simulate; without it the stage's time range, else 5 s")
      .value_name("SECONDS");
  verb.add_option("--dt", options.time_step, {1e-9, 10, false, false, "s"},
                  "Time step of all; without it the asset's, else the engine's")
      .value_name("SECONDS");
  verb.add_option("--fps", options.frames_per_second, {0, 1e5, true, false, "per second"},
                  "Moments at which they are compared");
  verb.add_option("--commands", options.commands,
                  "Drive joints over time by a table, as in tenon sim")
      .file_only()
      .value_name("FILE");
  add_readings(verb, options.readings);
  add_pose(verb, options.pose);
  add_masks(verb, options.masks);
  verb.add_option("--set", options.asset.overrides,
                  "PATH.attr=value, for this run only; may be repeated")
      .repeatable();
}

}  // namespace

void add_compare(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "compare", "The same motion on several engines: how far they are apart, and why");
  auto options = std::make_shared<CompareArguments>();
  options->asset.add_with_standard_input_to(verb);
  verb.add_option("--engines", options->engines,
                  "ENGINE or ENGINE:VARIANT, the first is what the others are compared with; "
                  "without it all of this build (tenon doctor), that of tenon.toml first")
      .split_at_commas()
      .repeatable()
      .value_name("NAMES");
  add_run_options(verb, *options);
  verb.add_option("--metrics", options->metrics, "Metrics to report; all by default")
      .one_of(metric_names())
      .split_at_commas()
      .repeatable()
      .value_name("NAMES");
  verb.add_option(
          "--fail-above", options->bounds,
          "Exit 1 where a gap is larger: 5mm, 1deg (bodies and joints), or NAME=NUMBER of a "
          "metric, with a unit; may be repeated")
      .split_at_commas()
      .repeatable()
      .value_name("BOUND");
  verb.add_option("--trials", options->trials, {1, 1e5, false, true, ""},
                  "Maximum number of causes that are tried")
      .value_name("COUNT")
      .not_with({"--no-reasons"});
  verb.add_flag("--no-reasons", options->no_reasons, "Do not look for reasons");
  verb.add_option("-o,--output", options->output,
                  "Write a report: .html (tables and plots, one file), .json or .csv")
      .value_name("FILE");
  verb.add_flag("--timing", options->timing, "Also say how long a step takes");
  verb.footer(kCompareFooter);
  choose(verb, chosen, [&globals, options] { return run_compare(globals, *options); });
}

}  // namespace tenon::cli
