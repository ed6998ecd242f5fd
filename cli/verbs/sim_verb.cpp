// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The end state comes as JSON, and the text for people is printed from it, so the two forms say
// the same. Bodies and joints are told in units of the stage, energy in joules. The log and the
// baked layer are written in one commit: after a run that became unstable too, but not after an
// interrupt. A saved state is not written of a run that failed.
#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/simulate.h"
#include "cli/verb.h"
#include "tenon/asset/simulating/simulated_json.h"
#include "tenon/bake/record_outputs.h"
#include "tenon/bake/write_log.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/base/text/text_number.h"

namespace tenon::cli {
namespace {

struct SimArguments {
  SimulateArguments simulate;
  std::string log;
  std::string format;
  bool timing = false;  ///< --timing
  std::string bake;
  std::string state_out;  ///< --state-out

  bool uses_standard_output() const { return log == "-" || bake == "-" || state_out == "-"; }
  /// The format of the log as the end of a name: ".csv".
  std::string kind() const { return !format.empty() ? "." + format : log == "-" ? ".csv" : log; }
  /// Contacts go into a table of their own where the log is a table.
  bool has_contact_table() const {
    return kind().ends_with(".csv") &&
           std::find(simulate.log.begin(), simulate.log.end(), "contacts") != simulate.log.end();
  }
};

void print_numbers(const Json& numbers) {
  for (const auto& number : numbers) {
    print(" %10.5g", number.get<double>());
  }
}

constexpr std::size_t kMaxRows = 50;  // more than that nobody reads

/// The position of each, one line each, as long as people can read them all.
void print_rows(const Json& states, const char* what, const char* title) {
  if (states.size() > kMaxRows) {
    print("the positions of %s %s are not listed: --json has them, -o LOG all frames\n",
          grouped_digits(states.size()).c_str(), what);
    return;
  }
  print("%s\n", title);
  for (const auto& [path, state] : states.items()) {
    if (state["position"].is_array() && state["position"].empty()) {
      continue;  // a fixed joint
    }
    print("  %-56s", path.c_str());
    print_numbers(state["position"]);
    print("\n");
  }
}

/// One line per reason, with the first prim and how many more there are.
void print_not_mapped(const Json& items) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const auto& item : items) {
    const std::string reason =
        item["property"].get<std::string>() + ": " + item["why"].get<std::string>();
    auto found = std::find_if(reasons.begin(), reasons.end(),
                              [&](const auto& known) { return known.first == reason; });
    if (found == reasons.end()) {
      found = reasons.insert(reasons.end(), {reason, {}});
    }
    found->second.push_back(item["prim"].get<std::string>());
  }
  for (const auto& [reason, prims] : reasons) {
    const std::string more =
        prims.size() > 1 ? " and " + std::to_string(prims.size() - 1) + " more" : "";
    print("not mapped  %s (<%s>%s)\n", reason.c_str(), prims.front().c_str(), more.c_str());
  }
}

std::string setting_text(const Json& value) {
  if (value.is_string()) {
    return value.get<std::string>();
  }
  std::string text;
  for (const double number :
       value.is_number() ? std::vector{value.get<double>()} : value.get<std::vector<double>>()) {
    text += (text.empty() ? "" : ", ") + shortest(number);
  }
  return text;
}

/// What the steps were made with, a line each.
void print_settings(const Json& settings) {
  print("engine settings\n");
  for (const auto& [name, value] : settings.items()) {
    if (!value.is_object()) {
      print("  %-28s %s\n", name.c_str(), setting_text(value).c_str());
      continue;
    }
    for (const auto& [prim, on] : value.items()) {
      print("  %-28s %s  <%s>\n", name.c_str(), on.get<bool>() ? "on" : "off", prim.c_str());
    }
  }
}

/// What the run was given and asked for, as far as it was.
void print_request(const Json& state) {
  if (state.contains("stateIn")) {
    print("began at %g s from the state in %s\n", state["begin"].get<double>(),
          state["stateIn"].get<std::string>().c_str());
  }
  if (state.contains("commands")) {
    const Json& commands = state["commands"];
    const auto rows = commands["rows"].get<std::size_t>();
    print("commands   %s %s of %s from %s\n", grouped_digits(rows).c_str(),
          noun_for(rows, "row").c_str(),
          counted(commands["columns"].get<std::size_t>(), "column").c_str(),
          commands["file"].get<std::string>().c_str());
  }
  if (state.contains("rest") && state["rest"]["reached"].get<bool>()) {
    print("at rest since %g s\n", state["rest"]["since"].get<double>());
  }
}

void print_state(const Json& state, bool verbose) {
  const std::string rate =
      state.contains("realTimeFactor")
          ? "  " + rounded_text(state["realTimeFactor"].get<double>()) + " times real time"
          : "";
  print("%s %s  %s of %g s = %g s%s%s\n", state["engine"].get<std::string>().c_str(),
        state["engineVersion"].get<std::string>().c_str(),
        counted(state["steps"].get<std::size_t>(), "step").c_str(), state["dt"].get<double>(),
        state["time"].get<double>(), rate.c_str(),
        state["unstable"].get<bool>() ? "  UNSTABLE" : "");
  if (verbose) {
    print_settings(state["engineSettings"]);
  }
  print("energy %.6g J -> %.6g J, %s\n", state["energy"]["initial"].get<double>(),
        state["energy"]["final"].get<double>(),
        counted(state["contacts"].get<std::size_t>(), "contact").c_str());
  if (!state["joints"].empty()) {
    print_rows(state["joints"], "joints", "joint positions (degrees or stage units)");
  }
  print_rows(state["bodies"], "bodies", "body positions (stage units)");
  print_request(state);
  for (const auto& event : state["events"]) {
    print("at %g s  <%s> %s\n", event["time"].get<double>(),
          event["prim"].get<std::string>().c_str(), event["what"].get<std::string>().c_str());
  }
  print_not_mapped(state["notMapped"]);
}

/// Whether --log, -o and --format go together.
Result<void> check_log(const SimArguments& options) {
  if (options.log.empty() && !options.simulate.log.empty()) {
    return Error(ErrorCode::Invalid, "--log adds to a log, and -o names none")
        .with_rule("usage.value")
        .with_fix("name the log with -o");
  }
  if (options.has_contact_table() && !options.log.ends_with(".csv")) {
    return Error(ErrorCode::Invalid,
                 "contacts go into a second table beside the log, which needs a file's name")
        .in_file(options.log)
        .with_rule("usage.value")
        .with_fix("name a log that ends in .csv, or give --format jsonl");
  }
  const std::string wanted = "." + options.format;
  const bool speaks = options.log.ends_with(".csv") || options.log.ends_with(".jsonl") ||
                      options.log.ends_with(".npz");
  if (!options.format.empty() && speaks && !options.log.ends_with(wanted)) {
    return Error(ErrorCode::Invalid, "the name says another format than --format")
        .in_file(options.log)
        .with_rule("output.kind")
        .with_fix("name a file that ends in " + wanted + ", or leave --format out");
  }
  return {};
}

Result<void> claim(const Globals& globals, const SimArguments& options, Outputs& outputs) {
  if (globals.json && options.uses_standard_output()) {
    return Error(ErrorCode::Invalid, "--json and another output both want standard output")
        .with_fix("name an output file");
  }
  TENON_CHECK(check_log(options));
  TENON_CHECK(
      outputs.claim(options.format.empty() ? OutputKind::Log : OutputKind::NamedLog, options.log));
  if (options.has_contact_table()) {
    TENON_CHECK(outputs.claim(OutputKind::Log, bake::contacts_path(options.log)));
  }
  TENON_CHECK(outputs.claim(OutputKind::State, options.state_out));
  return outputs.claim(OutputKind::Overlay, options.bake);
}

Result<void> write_outputs(const SimulatedAsset& s, const SimArguments& options, Outputs& outputs,
                           Report& report) {
  if (!options.log.empty()) {
    TENON_TRY(std::string log, bake::log_for(options.kind(), *s.scene, s.run.recording));
    outputs.put(options.log, std::move(log));
  }
  if (options.has_contact_table()) {
    outputs.put(bake::contacts_path(options.log), bake::contacts_csv(*s.scene, s.run.recording));
  }
  if (!options.state_out.empty() && !s.run.failure) {  // of what failed nothing can go on
    TENON_TRY(std::string state, end_state(s));
    outputs.put(options.state_out, std::move(state));
  }
  if (!options.bake.empty()) {
    TENON_CHECK(put_bake(s, options.simulate, options.bake, outputs, report));
  }
  return outputs.commit();
}

int run_sim(const Globals& globals, const SimArguments& options) {
  Report report(globals, "sim", options.simulate.asset.asset);
  Outputs outputs;
  if (auto claimed = claim(globals, options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  if (!options.bake.empty() && options.simulate.asset.asset == "-") {
    return report.fail(Error(ErrorCode::Invalid,
                             "--bake writes a layer over a file, and the asset "
                             "comes from standard input")
                           .with_rule("usage.value")
                           .with_fix("name the file"));
  }
  SimulateArguments run = options.simulate;
  if (options.log.empty() && options.bake.empty()) {
    run.frames_per_second = 0;  // nobody asks for a recording
  }
  auto simulated = simulate(run, report);
  if (!simulated) {
    return report.fail(simulated.error());
  }
  Json state = simulated_json(*simulated, options.timing);
  if (!globals.json && !options.uses_standard_output()) {
    print_state(state, globals.verbose);
  }
  if (simulated->run.interrupted) {
    return report.finish(kInterrupted, std::move(state));
  }
  if (auto written = write_outputs(*simulated, options, outputs, report); !written) {
    report.diagnostics.add(written.error().diagnostic());
    return report.finish(exit_code_of(written.error()), std::move(state));
  }
  return report.finish(exit_code_of(*simulated), std::move(state));
}

}  // namespace

void add_sim(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("sim", "Simulate the asset on a real engine");
  auto options = std::make_shared<SimArguments>();
  options->simulate.add_to(verb);
  verb.option("--fps").only_with({"--output", "--bake"});
  verb.add_option("-o,--output", options->log,
                  "Write a log: .csv, .jsonl or .npz; - is standard output")
      .value_name("LOG");
  verb.add_option("--format", options->format, "Format of the log: csv (as for -o -), jsonl, npz")
      .one_of({"csv", "jsonl", "npz"})
      .only_with({"--output"});
  verb.add_option(
          "--log", options->simulate.log,
          "Contents of the log beside states; contacts of a .csv log go to NAME.contacts.csv")
      .one_of(bake::log_output_names())
      .split_at_commas()
      .repeatable()
      .value_name("WHAT");
  options->simulate.add_steering_to(verb);
  verb.add_option("--state-out", options->state_out,
                  "Save the full state at the end, for --state-in; not of a run that failed")
      .value_name("FILE");
  verb.add_option("--bake", options->bake, "Also write the motion as a layer over the asset")
      .value_name("LAYER");
  verb.add_flag("--timing", options->timing, "Also say how fast it ran");
  verb.footer(
      "Examples:\n"
      "  tenon sim hand.usda --physics physics --duration 5 -o run.csv\n"
      "  tenon sim hand.usda --commands grasp.csv -o run.jsonl --log contacts,efforts\n"
      "  tenon sim pile.usda --until rest --duration 60 --state-out rest.state\n"
      "  tenon sim pile.usda --state-in rest.state --duration 1 -o run.csv\n"
      "  tenon sim door.usda --set /Door/hinge.drive:angular:physics:targetPosition=45 --json");
  choose(verb, chosen, [&globals, options] { return run_sim(globals, *options); });
}

}  // namespace tenon::cli
