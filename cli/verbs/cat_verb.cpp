// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cli/output.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/answers/diagnostic_json.h"
#include "tenon/asset/layers/copy_layer.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/asset_policy.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/formats/save_layer.h"

namespace tenon::cli {
namespace {

struct CatArguments {
  AssetArguments asset;
  std::string output = "-";
  std::string format;
  bool flatten = false;
  bool flatten_layer_stack = false;
  bool in_place = false;
};

CopyForm form_of(const CatArguments& options) {
  if (options.flatten_layer_stack) {
    return CopyForm::FlattenedLayerStack;
  }
  return options.flatten || options.asset.selects() ? CopyForm::Flattened : CopyForm::AsItIs;
}

/// Gives what a composed scene took back to the system: writing then needs nothing on top of it.
void return_free_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

Result<formats::LayerFormat> output_format(const CatArguments& options) {
  if (!options.format.empty()) {
    return formats::layer_format_named(options.format);
  }
  return options.output == "-" ? formats::LayerFormat::Text
                               : formats::layer_format_for(options.output);
}

/// The name and the format, before the work. A format that is asked for may have a name that says
/// nothing about formats.
Result<formats::LayerFormat> claim(const CatArguments& options, Outputs& outputs) {
  TENON_TRY(const formats::LayerFormat format, output_format(options));
  if (options.output != "-") {
    TENON_CHECK(check_layer_name(options.output, format));
  }
  const OutputKind kind = options.format.empty() ? OutputKind::Layer : OutputKind::NamedFormat;
  TENON_CHECK(outputs.claim(kind, options.output));
  return format;
}

Result<void> write(const CatArguments& options, Diagnostics& diagnostics) {
  Outputs outputs = options.in_place ? Outputs::in_place({"cat", options.output}) : Outputs();
  TENON_TRY(const formats::LayerFormat format, claim(options, outputs));
  const std::string& asset = options.asset.asset;
  const OpenOptions open = options.asset.open_options();
  TENON_TRY(layer::Layer layer, copy_layer(asset, open, form_of(options), diagnostics));
  std::error_code error;
  if (std::filesystem::exists(options.output, error)) {
    note_named_layers(layer, open);
  }
  return_free_memory();
  TENON_TRY(std::string contents,
            copied_contents(std::move(layer), format, asset, open, diagnostics));
  outputs.put(options.output, std::move(contents));
  return outputs.commit();
}

int run_cat(const Globals& globals, const CatArguments& options) {
  Report report(globals, "cat", options.asset.asset);
  if (globals.json && options.output == "-") {
    return report.fail(
        Error(ErrorCode::Invalid, "--json and a layer cannot both go to standard output")
            .with_fix("name an output file with -o"));
  }
  const Progress progress(globals, "reading and writing " + shown_path(options.asset.asset));
  const auto written =
      repeat_edit(report.diagnostics, [&] { return write(options, report.diagnostics); });
  if (!written) {
    return report.fail(written.error());
  }
  const bool package = bytes::is_package_name(options.output) || options.format == "usdz";
  return report.finish(package && left_out(report.diagnostics) ? kNo : kOk,
                       answers::output_json(options.output));
}

}  // namespace

void add_cat(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb =
      parent.add_subcommand("cat", "Read any layer, write it as text, binary or package");
  auto options = std::make_shared<CatArguments>();
  options->asset.add_with_standard_input_to(verb);
  verb.add_option("-o,--output", options->output, "Where to write; - is standard output")
      .value_name("FILE");
  verb.add_flag("--in-place", options->in_place, "The output may be a file that is read")
      .only_with({"--output"});
  verb.add_flag("-f,--flatten", options->flatten, "Compose first and write one layer")
      .not_with({"--flatten-layer-stack"});
  verb.add_flag("--flattenLayerStack,--flatten-layer-stack", options->flatten_layer_stack,
                "Merge the sublayers, keep references and the like");
  verb.add_option("--usdFormat,--format", options->format, "usda, usdc or usdz")
      .one_of({"usda", "usdc", "usdz"});
  verb.footer(
      "Examples:\n  tenon cat geometry.usdc\n  tenon cat hand.usda --flatten -o flat.usdc\n"
      "A package (-o hand.usdz) takes in all layers and textures that it needs.\n"
      "Selecting with --mask, --load, --unloaded, --mute-layer or --physics composes, too.");
  choose(verb, chosen, [&globals, options] { return run_cat(globals, *options); });
}

}  // namespace tenon::cli
