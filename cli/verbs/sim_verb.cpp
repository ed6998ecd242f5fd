// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The end state comes as JSON, and the text for people is printed from it, so the two forms say
// the same. Bodies and joints are told in units of the stage, energy in joules. The log and the
// baked layer are written in one commit: after a run that became unstable too, but not after an
// interrupt.
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
#include "tenon/bake/write_log.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/rounded_text.h"

namespace tenon::cli {
namespace {

struct SimArguments {
  SimulateArguments simulate;
  std::string log;
  std::string format;
  bool timing = false;  ///< --timing
  std::string bake;

  bool uses_standard_output() const { return log == "-" || bake == "-"; }
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

void print_state(const Json& state) {
  const std::string rate =
      state.contains("realTimeFactor")
          ? "  " + rounded_text(state["realTimeFactor"].get<double>()) + " times real time"
          : "";
  print("%s %s  %zu steps of %g s = %g s%s%s\n", state["engine"].get<std::string>().c_str(),
        state["engineVersion"].get<std::string>().c_str(), state["steps"].get<std::size_t>(),
        state["dt"].get<double>(), state["time"].get<double>(), rate.c_str(),
        state["unstable"].get<bool>() ? "  UNSTABLE" : "");
  print("energy %.6g J -> %.6g J, %zu contacts\n", state["energy"]["initial"].get<double>(),
        state["energy"]["final"].get<double>(), state["contacts"].get<std::size_t>());
  if (!state["joints"].empty()) {
    print_rows(state["joints"], "joints", "joint positions (degrees or stage units)");
  }
  print_rows(state["bodies"], "bodies", "body positions (stage units)");
  for (const auto& event : state["events"]) {
    print("at %g s  <%s> %s\n", event["time"].get<double>(),
          event["prim"].get<std::string>().c_str(), event["what"].get<std::string>().c_str());
  }
  print_not_mapped(state["notMapped"]);
}

Result<void> claim(const Globals& globals, const SimArguments& options, Outputs& outputs) {
  if (globals.json && options.uses_standard_output()) {
    return Error(ErrorCode::Invalid, "--json and another output both want standard output")
        .with_fix("name an output file");
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
  TENON_CHECK(
      outputs.claim(options.format.empty() ? OutputKind::Log : OutputKind::NamedLog, options.log));
  return outputs.claim(OutputKind::Overlay, options.bake);
}

Result<void> write_outputs(const SimulatedAsset& s, const SimArguments& options, Outputs& outputs,
                           Report& report) {
  if (!options.log.empty()) {
    const std::string kind = !options.format.empty() ? "." + options.format
                             : options.log == "-"    ? ".csv"
                                                     : options.log;
    TENON_TRY(std::string log, bake::log_for(kind, *s.scene, s.run.recording));
    outputs.put(options.log, std::move(log));
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
  auto simulated = simulate(options.simulate, report);
  if (!simulated) {
    return report.fail(simulated.error());
  }
  const Json state = simulated_json(*simulated, options.timing);
  if (!globals.json && !options.uses_standard_output()) {
    print_state(state);
  }
  if (simulated->run.interrupted) {
    return report.finish(kInterrupted, state);
  }
  if (auto written = write_outputs(*simulated, options, outputs, report); !written) {
    report.diagnostics.add(written.error().diagnostic());
    return report.finish(exit_code_of(written.error()), state);
  }
  return report.finish(exit_code_of(*simulated), state);
}

}  // namespace

void add_sim(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("sim", "Simulate the asset on a real engine");
  auto options = std::make_shared<SimArguments>();
  options->simulate.add_to(verb);
  verb.add_option("-o,--output", options->log,
                  "Write a log: .csv, .jsonl or .npz; - is standard output");
  verb.add_option("--format", options->format, "Format of the log: csv (as for -o -), jsonl, npz")
      .one_of({"csv", "jsonl", "npz"});
  verb.add_option("--bake", options->bake, "Also write the motion as a layer over the asset");
  verb.add_flag("--timing", options->timing, "Also say how fast it ran");
  verb.footer(
      "Examples:\n"
      "  tenon sim hand.usda --physics physics --duration 5 -o run.csv\n"
      "  tenon sim door.usda --set /Door/hinge.drive:angular:physics:targetPosition=45 --json");
  choose(verb, chosen, [&globals, options] { return run_sim(globals, *options); });
}

}  // namespace tenon::cli
