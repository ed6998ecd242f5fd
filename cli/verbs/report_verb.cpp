// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>
#include <vector>

#include "cli/report.h"
#include "cli/simulate.h"
#include "cli/verb.h"
#include "tenon/asset/viewing/report_asset.h"
#include "tenon/asset/viewing/viewing_json.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

constexpr double kReportFrames = 30;  // per second, as players of pictures have them

struct ReportArguments {
  SimulateArguments simulate;
  std::string output;
  std::size_t triangles = 0;
  bool no_colliders = false;
  bool compare = false;
  std::vector<std::string> engines;
};

Result<ReportOptions> options_of(const ReportArguments& arguments, Report& report) {
  ReportOptions options;
  TENON_TRY(options.run, simulation_options(arguments.simulate, report));
  options.triangles = arguments.triangles;
  options.colliders = !arguments.no_colliders;
  if (arguments.compare || !arguments.engines.empty()) {
    options.compared = arguments.engines;
  }
  return options;
}

Result<void> claim_page(const Globals& globals, const ReportArguments& arguments,
                        Outputs& outputs) {
  if (globals.json && arguments.output == "-") {
    return Error(ErrorCode::Invalid, "--json and a page cannot both go to standard output")
        .with_fix("name an output file with -o");
  }
  return outputs.claim(OutputKind::Page, arguments.output);
}

int run_report(const Globals& globals, const ReportArguments& arguments) {
  Report report(globals, "report", arguments.simulate.asset.asset);
  Outputs outputs;
  if (auto claimed = claim_page(globals, arguments, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  auto options = options_of(arguments, report);
  if (!options) {
    return report.fail(options.error());
  }
  RunWatch watch(arguments.simulate, report);
  options->run.listener = watch.listener();
  auto made = report_asset(arguments.simulate.asset.asset, *options, report.diagnostics);
  if (!made) {
    return report.fail(made.error());
  }
  if (made->interrupted) {
    return report.finish(kInterrupted);
  }
  Json answer = report_json(*made, arguments.output);
  const std::size_t size = made->html.size();
  outputs.put(arguments.output, std::move(made->html));
  if (auto written = outputs.commit(); !written) {
    return report.fail(written.error());
  }
  if (arguments.output != "-") {
    report.note(shown_path(arguments.output) + ": " + std::to_string((size + 999) / 1000) +
                " kB, " + counted(made->triangles, "triangle") + ", " +
                counted(made->frames, "frame") + "; open it in a browser");
  }
  return report.finish(kOk, std::move(answer));
}

constexpr const char* kReportFooter =
    "The page is one file that needs nothing else, the network included, and opens by a double "
    "click: what the asset is, what tenon check finds, masses, joints, and a picture to turn, with "
    "the motion to play. An asset that cannot be simulated is shown without motion.\n\n"
    "Examples:\n"
    "  tenon report hand.usda -o hand.html\n"
    "  tenon report hand.usda -o hand.html --duration 10 --simplify 30000    a smaller file\n"
    "  tenon report hand.usda -o hand.html --duration 0                      without motion\n"
    "  tenon report hand.usda -o hand.html --compare                         all engines beside "
    "each other";

}  // namespace

void add_report(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "report", "One page for browsers: findings, masses, joints, a picture with its motion");
  auto options = std::make_shared<ReportArguments>();
  options->simulate.frames_per_second = kReportFrames;
  options->simulate.add_to(verb);
  options->simulate.add_commands_to(verb);
  verb.option("asset").file_only().description("A .usd, .usda, .usdc or .usdz file");
  verb.add_option("-o,--output", options->output, "The page to write: .html").required();
  verb.add_option("--simplify", options->triangles, {1, 1e9, false, true, ""},
                  "Draw about so many triangles at most")
      .value_name("TRIANGLES");
  verb.add_flag("--no-colliders", options->no_colliders, "Leave the shapes of colliders out");
  verb.add_flag("--compare", options->compare,
                "Also the motion on all engines of this build, as tenon compare has it");
  verb.add_option("--engines", options->engines,
                  "The same for these engines: ENGINE or ENGINE:VARIANT")
      .split_at_commas()
      .repeatable()
      .value_name("NAMES");
  verb.footer(kReportFooter);
  choose(verb, chosen, [&globals, options] { return run_report(globals, *options); });
}

}  // namespace tenon::cli
