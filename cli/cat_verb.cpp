// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/formats/save_layer.h"
#include "tenon/stage/flatten.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct Options {
  AssetArguments asset;
  std::string output = "-";
  std::string format;
  bool flatten = false;
  bool flatten_layer_stack = false;
};

Result<layer::Layer> read_input(const Options& options, Diagnostics& diagnostics) {
  const bool compose = options.flatten || options.flatten_layer_stack || options.asset.selects();
  if (!compose) {
    TENON_TRY(const layer::LayerPtr layer,
              open_layer(options.asset.asset, options.asset.open_options(), diagnostics));
    return *layer;
  }
  TENON_TRY(const stage::Stage stage,
            open_stage(options.asset.asset, options.asset.open_options(), diagnostics));
  return options.flatten_layer_stack ? stage::flatten_layer_stack(stage) : stage::flatten(stage);
}

/// Gives what a composed scene took back to the system: writing then needs nothing on top of it.
void return_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

Result<formats::LayerFormat> output_format(const Options& options) {
  if (!options.format.empty()) {
    return formats::layer_format_named(options.format);
  }
  return options.output == "-" ? formats::LayerFormat::Text
                               : formats::layer_format_for(options.output);
}

Result<void> write(const Options& options, Diagnostics& diagnostics) {
  TENON_TRY(const formats::LayerFormat format, output_format(options));
  TENON_TRY(layer::Layer layer, read_input(options, diagnostics));
  return_free_memory();
  if (format == formats::LayerFormat::Package) {
    TENON_TRY(const std::string package, pack_layer(std::move(layer), options.asset.asset,
                                                    options.asset.open_options(), diagnostics));
    return write_output(options.output, package);
  }
  TENON_TRY(const std::string bytes, formats::encode_layer(layer, format));
  return write_output(options.output, bytes);
}

int run_cat(const Globals& globals, const Options& options) {
  Report report(globals, "cat", options.asset.asset);
  if (globals.json && options.output == "-") {
    return report.fail(
        Error(ErrorCode::Invalid, "--json and a layer cannot both go to standard output")
            .with_fix("name an output file with -o"));
  }
  if (auto written = write(options, report.diagnostics); !written) {
    return report.fail(written.error());
  }
  return report.finish(kOk, {{"output", options.output}});
}

}  // namespace

void add_cat(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("cat", "Read any layer, write it as text, binary or package");
  auto options = std::make_shared<Options>();
  options->asset.add_to(verb);
  verb.add_option("-o,--output", options->output, "Where to write; - is standard output");
  verb.add_flag("-f,--flatten", options->flatten, "Compose first and write one layer");
  verb.add_flag("--flatten-layer-stack,--flattenLayerStack", options->flatten_layer_stack,
                "Merge the sublayers, keep references and the like");
  verb.add_option("--format,--usdFormat", options->format, "usda, usdc or usdz");
  verb.footer(
      "Examples:\n  tenon cat geometry.usdc\n  tenon cat hand.usda --flatten -o flat.usdc\n"
      "A package (-o hand.usdz) takes in all layers and textures that it needs.\n"
      "Selecting with --mask, --load, --mute-layer or --physics composes, too.");
  choose(verb, chosen, [&globals, options] { return run_cat(globals, *options); });
}

}  // namespace tenon::cli
