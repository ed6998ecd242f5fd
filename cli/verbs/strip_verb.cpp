// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Stripping composes nothing: every layer that the asset leads to is stripped by itself, so that
// the physics of variants that are not selected goes as well. Layers outside of the folders of the
// asset stay; those among them that hold physics are errors. Muting composes the asset, since only
// that tells which flags are on, and switches them off in one layer: a new one over the asset, or
// the root layer.
#include <cstdio>
#include <filesystem>

#include "cli/asset_copy.h"
#include "cli/missing_input.h"
#include "cli/output.h"
#include "cli/output_place.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset_policy.h"
#include "tenon/bake/mute_layer.h"
#include "tenon/base/file_finding.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/formats/save_layer.h"
#include "tenon/physics/strip.h"
#include "tenon/tenon.h"

namespace tenon::cli {
namespace {

struct StripArguments {
  AssetArguments asset;
  std::string output;
  bool in_place = false;
  bool mute = false;
};

struct Stripped {
  physics::StripCounts counts;
  Json layers = Json::array();
  bool is_whole = true;  ///< no layer is missing
};

/// A folder is claimed by nothing but the files in it.
Result<void> claim(const StripArguments& options, Outputs& outputs) {
  return options.in_place || names_folder(options.output)
             ? Result<void>()
             : outputs.claim(OutputKind::Layer, options.output);
}

/// Physics in layers that do not belong to the asset stays, which is no success.
void report_outside(const AssetLayers& asset, const StripArguments& options, Report& report) {
  report.diagnostics.append(asset.refused());
  for (const std::string& identifier : asset.outside()) {
    Diagnostics ignored;
    const auto layer = open_layer(identifier, options.asset.open_options(), ignored);
    if (!layer) {
      continue;
    }
    layer::Layer copy = **layer;
    if (physics::strip_physics(copy).total() != 0) {
      report.diagnostics.add(
          file_finding(Severity::Error, bytes::kOutsideRule,
                       "the layer @" + identifier +
                           "@ lies outside of the folders of the asset; its physics "
                           "stays",
                       options.asset.asset, 0,
                       "if it belongs to the asset, give --allow-read " +
                           std::filesystem::path(bytes::split_package_path(identifier).package)
                               .parent_path()
                               .string()));
    }
  }
}

Result<Stripped> strip(const StripArguments& options, Report& report) {
  TENON_TRY(AssetLayers asset,
            AssetLayers::open(options.asset.asset, options.asset.open_options()));
  report_outside(asset, options, report);
  Stripped result;
  result.is_whole = asset.is_whole();
  for (AssetLayer& part : asset.layers()) {
    layer::Layer edited = *part.layer;
    const physics::StripCounts counts = physics::strip_physics(edited);
    if (counts.total() == 0) {
      continue;
    }
    result.counts.prims += counts.prims;
    result.counts.api_schemas += counts.api_schemas;
    result.counts.properties += counts.properties;
    result.counts.metadata += counts.metadata;
    result.layers.push_back({{"file", shown_path(part.layer->identifier())},
                             {"prims", counts.prims},
                             {"apiSchemas", counts.api_schemas},
                             {"properties", counts.properties},
                             {"metadata", counts.metadata}});
    part.edited = std::make_shared<layer::Layer>(std::move(edited));
  }
  Outputs outputs = options.in_place ? Outputs::in_place() : Outputs();
  TENON_TRY(const std::vector<std::string> written,
            options.in_place ? asset.put_in_place(outputs) : asset.put_to(options.output, outputs));
  TENON_CHECK(outputs.commit());
  for (const std::string& file : asset.without_layout()) {
    report.note("comments and layout of " + shown_path(file) + " are not kept");
  }
  report.note("took out " + std::to_string(result.counts.prims) + " prims, " +
              std::to_string(result.counts.api_schemas) + " API schemas, " +
              std::to_string(result.counts.properties) + " properties; wrote " +
              std::to_string(written.size()) + (written.size() == 1 ? " layer" : " layers"));
  return result;
}

int run_strip(Report& report, const StripArguments& options) {
  Outputs outputs;
  if (auto claimed = claim(options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  const auto stripped = edit_files(report, [&] { return strip(options, report); });
  if (!stripped) {
    return report.fail(stripped.error());
  }
  if (!stripped->is_whole) {
    add_missing_input(options.asset.asset, options.asset.open_options(), report);
  }
  return report.finish(left_out(report.diagnostics) ? kNo : kOk,
                       {{"prims", stripped->counts.prims},
                        {"apiSchemas", stripped->counts.api_schemas},
                        {"properties", stripped->counts.properties},
                        {"metadata", stripped->counts.metadata},
                        {"layers", stripped->layers}});
}

Result<void> write_muted(const layer::Layer& layer, bool in_place, const std::string& output) {
  Outputs outputs = in_place ? Outputs::in_place() : Outputs();
  if (in_place) {
    TENON_CHECK(put_edited(layer, layer.identifier(), outputs));
    return outputs.commit();
  }
  formats::LayerFormat format = formats::LayerFormat::Text;
  if (output != "-") {
    TENON_TRY(format, formats::layer_format_for(output));
  }
  TENON_TRY(std::string contents, formats::encode_layer(layer, format));
  outputs.put_beside(output, std::move(contents));
  return outputs.commit();
}

Result<bake::MuteCounts> mute(const StripArguments& options, Report& report) {
  TENON_TRY(const stage::Stage stage,
            open_stage(options.asset.asset, options.asset.open_options(), report.diagnostics));
  const std::string output = root_output(options.output, stage.root_layer());
  std::error_code ignored;
  if (std::filesystem::equivalent(stage.root_layer().identifier(), output, ignored)) {
    return Error(ErrorCode::Invalid, "the layer over the asset would replace the asset")
        .in_file(output)
        .with_rule("output.is-input")
        .with_fix("name another place, or give --in-place");
  }
  layer::Layer layer =
      options.in_place ? stage.root_layer() : layer_over(stage.root_layer(), output);
  const bake::MuteCounts counts = bake::mute_physics(stage, layer, report.diagnostics);
  TENON_CHECK(write_muted(layer, options.in_place, output));
  return counts;
}

int run_mute(Report& report, const StripArguments& options) {
  Outputs outputs;
  if (auto claimed = claim(options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  const auto counts = edit_files(report, [&] { return mute(options, report); });
  if (!counts) {
    return report.fail(counts.error());
  }
  report.note("switched off " + std::to_string(counts->bodies) + " bodies, " +
              std::to_string(counts->colliders) + " colliders, " + std::to_string(counts->joints) +
              " joints");
  return report.finish(counts->out_of_reach == 0 ? kOk : kNo,
                       {{"bodies", counts->bodies},
                        {"colliders", counts->colliders},
                        {"joints", counts->joints},
                        {"outOfReach", counts->out_of_reach}});
}

}  // namespace

void add_strip(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand(
      "strip", "Take all physics out of an asset, or mute it, and leave the rest as it is");
  auto options = std::make_shared<StripArguments>();
  options->asset.add_to(verb);
  verb.add_option(
      "-o,--output", options->output,
      "Write the asset without physics here, \"-\" for standard output; layers below it "
      "that hold physics come into a folder beside it. A folder takes all of them");
  verb.add_flag("--in-place", options->in_place,
                "Change the asset's own layers; comments and layout of text stay");
  verb.add_flag("--mute", options->mute,
                "Delete nothing: switch bodies, colliders and joints off by their enable flags, "
                "in a layer over the asset (-o) or in its root layer (--in-place)");
  verb.footer(
      "Examples:\n  tenon strip hand.usda -o visual.usda\n"
      "  tenon strip hand.usda -o bare                   bare/hand.usda and its layers\n"
      "  tenon strip hand.usda --in-place\n"
      "  tenon strip hand.usda --mute -o muted.usda");
  choose(verb, chosen, [&globals, options] {
    Report report(globals, "strip", options->asset.asset);
    if (options->output.empty() != options->in_place) {
      return report.fail(Error(ErrorCode::Invalid, "say where to write the result")
                             .with_fix("give either -o FILE, -o FOLDER or --in-place"));
    }
    if (options->output == "-") {
      report.speak_as_text();  // standard output is the layer's
    }
    return options->mute ? run_mute(report, *options) : run_strip(report, *options);
  });
}

}  // namespace tenon::cli
