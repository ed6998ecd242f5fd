// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/report.h"
#include "cli/simulate.h"
#include "cli/verb.h"
#include "tenon/asset/simulating/simulated_json.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

struct BakeArguments {
  SimulateArguments simulate;
  std::string output;
};

Result<void> claim(const Globals& globals, const BakeArguments& options, Outputs& outputs) {
  if (globals.json && options.output == "-") {
    return Error(ErrorCode::Invalid, "--json and a layer cannot both go to standard output")
        .with_fix("name an output file with -o");
  }
  return outputs.claim(OutputKind::Overlay, options.output);
}

int run_bake(const Globals& globals, const BakeArguments& options) {
  Report report(globals, "bake", options.simulate.asset.asset);
  Outputs outputs;
  if (auto claimed = claim(globals, options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  auto simulated = simulate(options.simulate, report);
  if (!simulated) {
    return report.fail(simulated.error());
  }
  if (simulated->run.interrupted) {
    return report.finish(kInterrupted);
  }
  auto written = put_bake(*simulated, options.simulate, options.output, outputs, report);
  written = written ? outputs.commit() : written;
  if (!written) {
    return report.fail(written.error());
  }
  const std::size_t frames = simulated->run.recording.frame_count();
  const std::size_t bodies = simulated->scene->bodies.size();
  if (options.output != "-") {
    report.note(shown_path(options.output) + ": " + std::to_string(frames) + " frames of " +
                std::to_string(bodies) + " bodies");
  }
  return report.finish(exit_code_of(*simulated), motion_json(*simulated, options.output));
}

}  // namespace

void add_bake(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "bake", "Simulate and write the motion into a layer over the asset, which stays untouched");
  auto options = std::make_shared<BakeArguments>();
  options->simulate.add_to(verb);
  verb.option("asset").file_only().description("A .usd, .usda, .usdc or .usdz file");
  verb.add_option("-o,--output", options->output, "The layer to write: .usda, .usdc or .usd")
      .required();
  verb.add_flag("--uninstance", options->simulate.uninstance,
                "Take instances apart that have moving bodies inside (instanceable = false)");
  verb.footer("Example:\n  tenon bake grasp.usda -o motion.usda --fps 60 --duration 4");
  choose(verb, chosen, [&globals, options] { return run_bake(globals, *options); });
}

}  // namespace tenon::cli
