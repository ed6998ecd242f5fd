// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Without a wish the table of drives is printed; with one the numbers as they would be, and --save
// writes them as one edit of every form that engines have of them. A test runs with what was wished
// for, written or not. An interrupt ends a test; what was found until then is printed.
#include <csignal>
#include <memory>
#include <optional>
#include <utility>

#include "cli/edits_report.h"
#include "cli/output.h"
#include "cli/progress.h"
#include "cli/reading_options.h"
#include "cli/report.h"
#include "cli/settings.h"
#include "cli/simulate.h"
#include "cli/text/tune_text.h"
#include "cli/verb.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/asset/tuning/tuned_json.h"
#include "tenon/engines/engines.h"

namespace tenon::cli {
namespace {

struct TuneArguments {
  SimulateArguments run;  ///< the asset, readings, engine and time step
  std::vector<std::string> joints;
  std::string frequency;
  std::optional<double> damping_ratio;
  std::string gains;
  bool save = false;
  bool force = false;
  std::string test;
  std::vector<std::string> sequence;
  std::optional<double> period;
  std::optional<double> amplitude;  ///< [%]
  std::size_t seed = 1;
  bool adversarial = false;
  std::string output;
  bool search = false;
  std::string overshoot = "1";
  double settle = 0.2;  ///< [s]
  std::vector<std::string> payloads;
  std::string at;
  std::size_t poses = 0;
};

Error conflict(const std::string& message, const std::string& fix) {
  return Error(ErrorCode::Invalid, message).with_rule("usage.conflict").with_fix(fix);
}

Result<void> check_tune_words(const TuneArguments& arguments) {
  const bool wished = !arguments.frequency.empty() || arguments.damping_ratio.has_value() ||
                      !arguments.gains.empty() || arguments.search;
  if (arguments.save && !wished) {
    return conflict("there is nothing to save",
                    "give --frequency and --damping-ratio, --gains, or --search");
  }
  if (arguments.payloads.empty() != arguments.at.empty()) {
    return conflict("a payload needs a place, and a place a payload",
                    "give both --payload and --at");
  }
  const AssetArguments& asset = arguments.run.asset;
  if (arguments.save && (!asset.overrides.empty() || !asset.mask.empty() || !asset.load.empty() ||
                         !asset.muted.empty())) {
    return conflict("--save writes the files of the asset, not a selection of it",
                    "leave --set, --mask, --load and --mute-layer out");
  }
  if (arguments.save && !arguments.run.masks.empty()) {
    return conflict("--save writes gains of the whole asset, and a part of it is masked",
                    "leave --deactivate, --bypass and --anchor out");
  }
  if (arguments.test.empty() && !arguments.sequence.empty()) {
    return conflict("--sequence says how a test runs, and there is none", "give --test, too");
  }
  return {};
}

Result<TuneOptions> tune_options(const TuneArguments& arguments, Report& report) {
  TENON_CHECK(check_tune_words(arguments));
  TuneOptions options;
  options.engine = arguments.run.engine;
  if (options.engine.empty()) {
    TENON_TRY(options.engine, engine_for("", arguments.run.asset.asset, report));
  }
  TENON_TRY(options.readings, chosen_readings(arguments.run.readings));
  options.open = arguments.run.asset.open_options();
  options.masks = arguments.run.masks;
  options.time_step = arguments.run.time_step;
  options.joints = arguments.joints;
  options.gains_file = arguments.gains;
  options.force = arguments.force;
  options.sequence = arguments.sequence;
  options.wish.damping_ratio = arguments.damping_ratio;
  if (!arguments.frequency.empty()) {
    TENON_TRY(options.wish.frequency, frequency_named(arguments.frequency));
  }
  if (arguments.search) {
    SearchRequest& search = options.search.emplace();
    TENON_TRY(search.goal.overshoot, overshoot_named(arguments.overshoot));
    TENON_TRY(search.payloads, payloads_named(arguments.payloads));
    search.goal.settling = arguments.settle;
    search.at = arguments.at;
    search.poses = arguments.poses;
    search.seed = arguments.seed;
  }
  options.test = tuning::test_named(arguments.test);
  options.test_options.duration = arguments.run.duration;
  options.test_options.period = arguments.period;
  options.test_options.seed = arguments.seed;
  options.test_options.adversarial = arguments.adversarial;
  if (arguments.amplitude) {
    options.test_options.amplitude = *arguments.amplitude / 100;
  }
  return options;
}

int code_of(const TunedAsset& tuned) {
  using tuning::Verdict;
  return tuned.interrupted()                                       ? kInterrupted
         : tuned.has(Verdict::Unstable)                            ? kUnstable
         : tuned.has(Verdict::Fail) || tuned.has(Verdict::Blocked) ? kNo
         : tuned.search && !tuned.search->all_met()                ? kNo
                                                                   : kOk;
}

Result<void> write_tuned(const TuneArguments& arguments, const TunedAsset& tuned, const Json& json,
                         Outputs& outputs) {
  const std::string& path = arguments.output;
  if (path.empty()) {
    return {};
  }
  outputs.put(path, path.ends_with(".csv")    ? tuned_csv(tuned)
                    : path.ends_with(".json") ? answers::printed(json)
                                              : tuned_html(arguments.run.asset.asset, tuned));
  return outputs.commit();
}

/// Writes the gains, all as one edit. Reading and writing are repeated where a file changed.
Result<EditedAsset> save(const TuneArguments& arguments, const TunedAsset& tuned, Report& report,
                         std::vector<AssetEdit>& edits) {
  const std::string& asset = arguments.run.asset.asset;
  EditOptions options;
  select_physics(arguments.run.asset.physics, options.open);
  arguments.run.asset.files.apply_to(options.open);
  return repeat_edit(report.diagnostics, [&]() -> Result<EditedAsset> {
    TENON_TRY(edits, read_edits(asset, tuned.request, options));
    TENON_TRY(EditedAsset edited, edit_asset(asset, edits, options, report.diagnostics));
    if (edited.without_effect.empty()) {
      TENON_CHECK(write_edits(edited.files, {"tune", asset}));
    }
    return edited;
  });
}

int save_and_finish(const TuneArguments& arguments, const TunedAsset& tuned, Report& report) {
  std::vector<AssetEdit> edits;
  const auto edited = save(arguments, tuned, report, edits);
  if (!edited) {
    return report.fail(edited.error());
  }
  if (!report.json()) {
    const int saved = finish_edits(report, edits, *edited, false, EditLines::OfPrims);
    return saved == kOk ? code_of(tuned) : saved;
  }
  const int code = edited->without_effect.empty() ? code_of(tuned) : kNo;
  return report.finish(code, tuned_json(tuned, edits, *edited));
}

int run_tune(const Globals& globals, const TuneArguments& arguments) {
  Report report(globals, "tune", arguments.run.asset.asset);
  Outputs outputs;
  if (auto claimed = outputs.claim(OutputKind::Comparison, arguments.output); !claimed) {
    return report.fail(claimed.error());
  }
  auto options = tune_options(arguments, report);
  if (!options) {
    return report.fail(options.error());
  }
  RunWatch watch(arguments.run, report);
  options->listener = watch.listener();
  auto tuned = tune_asset(arguments.run.asset.asset, *options, report.diagnostics);
  if (!tuned) {
    return report.fail(tuned.error());
  }
  Json json = tuned_json(*tuned);
  if (auto written = write_tuned(arguments, *tuned, json, outputs); !written) {
    return report.fail(written.error());
  }
  if (!globals.json) {
    print_text(tune_text(json, arguments.save));
  }
  if (arguments.save && !tuned->request.drive.empty() && !tuned->interrupted()) {
    return save_and_finish(arguments, *tuned, report);
  }
  return report.finish(code_of(*tuned), std::move(json));
}

constexpr const char* kTuneFooter =
    "A drive with a stiffness is a mass on a spring: its natural frequency is sqrt(stiffness / "
    "inertia), its damping ratio damping / (2 sqrt(stiffness inertia)). The inertia is what the "
    "joint moves while all others stand still, with armature, and with what mimics and loops tie "
    "to "
    "it; of acceleration drives it is 1. What the joint damps by itself is taken off.\n\n"
    "A file of gains has a table for each joint or pattern:\n"
    "  [\"thumb.*\"]\n"
    "  frequency = 10         Hz, or \"62.8 rad/s\"\n"
    "  damping_ratio = 1\n"
    "or stiffness and damping [N m/rad, N m s/rad; N/m, N s/m].\n\n"
    "Tests: snap (to both limits and home: pass, fail or blocked, and why), step (overshoot, rise, "
    "settling), sine (lag, gain, errors), stress (random targets, the largest stable ones), steps "
    "(the step with other time steps). Joints are tested one after the other; each --sequence is a "
    "group that moves together.\n\n"
    "A search (NLopt) tries gains on the engines: the softest with which a step of each joint, the "
    "others held, meets the goal with every payload and at every pose. Gains that miss it are not "
    "saved.\n\n"
    "Exit codes: 0, 1 a test failed or was blocked, or a goal is missed, 2 bad input, 3 "
    "unstable, 4 without NLopt.\n\n"
    "Examples:\n"
    "  tenon tune hand.usda                                 the drives as they are\n"
    "  tenon tune hand.usda --frequency 10 --damping-ratio 1          what that would change\n"
    "  tenon tune hand.usda --frequency 10 --damping-ratio 1 --save   and change it\n"
    "  tenon tune hand.usda --search --overshoot 1% --settle 0.2      gains for a goal\n"
    "  tenon tune hand.usda --test step --period 0.5\n"
    "  tenon tune hand.usda --test snap --joints 'thumb.*' -o snap.html";

void add_wish_options(const Command& verb, TuneArguments& options) {
  verb.add_option("--joints", options.joints,
                  "Name, path, or regular expression for the whole of either; may be repeated; "
                  "without it all")
      .repeatable()
      .value_name("PATTERN");
  verb.add_option("--frequency", options.frequency,
                  "Natural frequency to give them: 10, 10Hz or 62.8rad/s")
      .value_name("FREQUENCY");
  verb.add_option("--damping-ratio", options.damping_ratio, {0, 1e6, false, false, ""},
                  "Damping ratio to give them: 1 is critical")
      .value_name("RATIO");
  verb.add_option("--gains", options.gains, "Gains of single joints, TOML")
      .file_only()
      .value_name("FILE");
  verb.add_flag("--save", options.save, "Write what was asked for; without it nothing is written");
  verb.add_flag("--force", options.force, "Also what is unstable with these time steps")
      .only_with({"--frequency", "--damping-ratio", "--gains"});
}

void add_test_options(const Command& verb, TuneArguments& options) {
  verb.add_option("--test", options.test, "Run a test of the drives: snap by default, or another")
      .one_of(tuning::test_names())
      .value_name("TEST");
  verb.add_option("--sequence", options.sequence,
                  "A pattern of joints that move together; groups run in the order of these")
      .repeatable()
      .value_name("PATTERN");
  verb.add_option("--period", options.period, {1e-3, 1e4, false, false, "s"},
                  "Period of a sine, or the time that a step is watched; without it 2 s")
      .value_name("SECONDS")
      .only_with({"--test=step", "--test=sine", "--test=steps"});
  verb.add_option(
          "--amplitude", options.amplitude, {1e-6, 100, false, false, "%"},
          "Size of steps and sines in per cent of the range; without it 10, of the random walk "
          "of stress in each step 1")
      .value_name("PERCENT")
      .only_with({"--test=step", "--test=sine", "--test=stress", "--test=steps", "--search"});
  verb.add_option("--duration", options.run.duration, {1e-3, 1e5, false, false, "s"},
                  "Duration of sine and stress; without it 4 periods, 10 s")
      .value_name("SECONDS")
      .only_with({"--test=sine", "--test=stress"});
  verb.add_option("--seed", options.seed, {0, 1e15, false, true, ""},
                  "Seed of stress, and of the poses of a search")
      .value_name("NUMBER")
      .only_with({"--test=stress", "--poses"});
  verb.add_flag("--adversarial", options.adversarial,
                "Stress: every 10 steps each joint to a random limit")
      .only_with({"--test=stress"});
}

void add_search_options(const Command& verb, TuneArguments& options) {
  verb.add_flag("--search", options.search,
                "Search the softest gains with which steps meet --overshoot and --settle")
      .not_with({"--frequency", "--damping-ratio", "--gains"});
  verb.add_option("--overshoot", options.overshoot,
                  "Maximum overshoot for --search, such as 5%; without it 1 %")
      .value_name("PERCENT")
      .only_with({"--search"});
  verb.add_option("--settle", options.settle, {1e-3, 100, false, false, "s"},
                  "Settling time (within 2 % of the step) for --search; without it 0.2 s")
      .value_name("SECONDS")
      .only_with({"--search"});
  verb.add_option("--payload", options.payloads,
                  "Point masses [kg] at --at that --search tries, such as 0,0.5")
      .split_at_commas()
      .value_name("MASSES")
      .only_with({"--search"});
  verb.add_option("--at", options.at, "Place of the payloads: a link, or a prim below one")
      .value_name("PRIM")
      .only_with({"--search"});
  verb.add_option("--poses", options.poses, {0, 63, false, true, ""},
                  "Number of drawn poses that --search tries, too")
      .value_name("COUNT")
      .only_with({"--search"});
}

}  // namespace

void add_tune(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "tune", "Gains of drives as frequency and damping ratio: show, set and test them");
  auto options = std::make_shared<TuneArguments>();
  options->run.asset.add_to(verb);
  add_wish_options(verb, *options);
  std::vector<std::string> names = engines::engine_names();
  names.emplace_back("all");
  verb.add_option("--engine", options->run.engine,
                  "The engine, or all of this build; without it that of tenon.toml, else that of "
                  "the selected variant")
      .one_of(names)
      .value_name("NAME");
  add_test_options(verb, *options);
  add_search_options(verb, *options);
  verb.add_option("--dt", options->run.time_step, {1e-9, 10, false, false, "s"},
                  "Time step; without it the asset's, else 0.002 s")
      .value_name("SECONDS");
  add_readings(verb, options->run.readings);
  add_masks(verb, options->run.masks);
  verb.add_option("--set", options->run.asset.overrides,
                  "PATH.attr=value, for this run only; may be repeated")
      .repeatable();
  verb.add_option("-o,--output", options->output,
                  "Write a report: .html (tables and plots, one file), .json or .csv")
      .value_name("FILE");
  verb.footer(kTuneFooter);
  choose(verb, chosen, [&globals, options] { return run_tune(globals, *options); });
}

}  // namespace tenon::cli
