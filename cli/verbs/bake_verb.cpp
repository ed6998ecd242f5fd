// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "cli/report.h"
#include "cli/simulate.h"
#include "cli/verb.h"
#include "tenon/asset/simulating/simulated_json.h"
#include "tenon/asset/viewing/view_asset.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

struct BakeArguments {
  SimulateArguments simulate;
  std::string output;
  std::size_t triangles = 0;
  bool compressed = false;

  bool makes_glb() const { return output.ends_with(".glb"); }
};

Result<void> claim(const Globals& globals, const BakeArguments& options, Outputs& outputs) {
  if (globals.json && options.output == "-") {
    return Error(ErrorCode::Invalid, "--json and a layer cannot both go to standard output")
        .with_fix("name an output file with -o");
  }
  if (!options.makes_glb() && (options.triangles > 0 || options.compressed)) {
    return Error(ErrorCode::Invalid, "--simplify and --compress are of motions in a .glb file")
        .with_fix("name an output file that ends in .glb");
  }
  if (options.makes_glb() && options.simulate.uninstance) {
    return Error(ErrorCode::Invalid,
                 "--uninstance is of layers alone: all bodies of a .glb file move")
        .with_fix("leave it out, or name an output file that ends in .usda, .usdc or .usd");
  }
  return outputs.claim(OutputKind::Motion, options.output);
}

Result<void> put_motion(const SimulatedAsset& simulated, const BakeArguments& options,
                        Outputs& outputs, Report& report) {
  if (!options.makes_glb()) {
    return put_bake(simulated, options.simulate, options.output, outputs, report);
  }
  const ViewFileOptions how{options.triangles, options.compressed, false};
  const AssetArguments& asset = options.simulate.asset;
  TENON_TRY(std::string contents,
            motion_glb(simulated, asset.asset, asset.open_options(), how, report.diagnostics));
  outputs.put(options.output, std::move(contents));
  return {};
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
  auto written = put_motion(*simulated, options, outputs, report);
  written = written ? outputs.commit() : written;
  if (!written) {
    return report.fail(written.error());
  }
  const std::size_t frames = simulated->run.recording.frame_count();
  const std::size_t bodies = simulated->scene->bodies.size();
  if (options.output != "-") {
    report.note(shown_path(options.output) + ": " + counted(frames, "frame") + " of " +
                counted(bodies, "body", "bodies"));
  }
  return report.finish(exit_code_of(*simulated), motion_json(*simulated, options.output));
}

}  // namespace

void add_bake(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "bake",
      "Simulate and write the motion: a layer over the asset, which stays untouched, or a .glb");
  auto options = std::make_shared<BakeArguments>();
  options->simulate.add_to(verb);
  verb.option("asset").file_only().description("A .usd, .usda, .usdc or .usdz file");
  verb.add_option("-o,--output", options->output,
                  "The layer to write: .usda, .usdc or .usd; or .glb, a scene "
                  "with all that is seen, for browsers and other 3D programs")
      .required();
  verb.add_option("--simplify", options->triangles, {1, 1e9, false, true, ""},
                  "About the maximum number of triangles in a .glb")
      .value_name("TRIANGLES");
  verb.add_flag("--compress", options->compressed,
                "A .glb of an eighth of the size, with glTF extensions that not all programs read");
  verb.add_flag("--uninstance", options->simulate.uninstance,
                "Make instances with moving bodies inside editable (instanceable = false)");
  verb.footer(
      "Examples:\n"
      "  tenon bake grasp.usda -o motion.usda --fps 60 --duration 4\n"
      "  tenon bake grasp.usda -o motion.glb --fps 30 --simplify 50000");
  choose(verb, chosen, [&globals, options] { return run_bake(globals, *options); });
}

}  // namespace tenon::cli
