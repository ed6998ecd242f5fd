// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What is stripped or muted, and how: tenon/asset/layers/strip_asset.h. The outputs are claimed
// before the work and written after it, again where a file changed meanwhile.
#include <cstdio>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/asset/layers/output_place.h"
#include "tenon/asset/layers/strip_asset.h"
#include "tenon/asset/missing_input.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/asset_policy.h"
#include "tenon/base/text/counted.h"
#include "tenon/base/text/shown_path.h"

namespace tenon::cli {
namespace {

struct StripArguments {
  AssetArguments asset;
  std::string output;
  bool in_place = false;
  bool mute = false;
};

StripOptions strip_options(const StripArguments& options) {
  return {
      .open = options.asset.open_options(), .in_place = options.in_place, .output = options.output};
}

/// A folder is claimed by nothing but the files in it.
Result<void> claim(const StripArguments& options, Outputs& outputs) {
  return options.in_place || names_folder(options.output)
             ? Result<void>()
             : outputs.claim(OutputKind::Layer, options.output);
}

Result<void> write(MadeFiles files, const StripArguments& options) {
  Outputs outputs =
      options.in_place ? Outputs::in_place({"strip", options.asset.asset}) : Outputs();
  outputs.put_all(std::move(files));
  return outputs.commit();
}

void note_stripped(const StrippedAsset& asset, std::size_t files, const Report& report) {
  for (const std::string& file : asset.without_layout) {
    report.note("comments and layout of " + shown_path(file) + " are not kept");
  }
  report.note("took out " + counted(asset.counts.prims, "prim") + ", " +
              counted(asset.counts.api_schemas, "API schema") + ", " +
              counted(asset.counts.properties, "property", "properties") + "; wrote " +
              counted(files, "layer"));
}

Result<StrippedAsset> strip(const StripArguments& options, Report& report) {
  TENON_TRY(StrippedAsset asset,
            strip_asset(options.asset.asset, strip_options(options), report.diagnostics));
  const std::size_t files = asset.files.size();
  TENON_CHECK(write(std::move(asset.files), options));
  note_stripped(asset, files, report);
  return asset;
}

Result<bake::MuteCounts> mute(const StripArguments& options, Report& report) {
  TENON_TRY(MutedAsset muted,
            mute_asset(options.asset.asset, strip_options(options), report.diagnostics));
  MadeFiles files;
  files.push_back(std::move(muted.file));
  TENON_CHECK(write(std::move(files), options));
  return muted.counts;
}

int run_strip(Report& report, const StripArguments& options) {
  if (auto whole = options.asset.check_whole("physics goes from whole files, with all variants");
      !whole) {
    return report.fail(whole.error());
  }
  Outputs outputs;
  if (auto claimed = claim(options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  const auto stripped = repeat_edit(report.diagnostics, [&] { return strip(options, report); });
  if (!stripped) {
    return report.fail(stripped.error());
  }
  if (!stripped->is_whole) {
    add_missing_input(options.asset.asset, options.asset.open_options(), report.diagnostics);
  }
  return report.finish(left_out(report.diagnostics) ? kNo : kOk, stripped_json(*stripped));
}

int run_mute(Report& report, const StripArguments& options) {
  Outputs outputs;
  if (auto claimed = claim(options, outputs); !claimed) {
    return report.fail(claimed.error());
  }
  const auto counts = repeat_edit(report.diagnostics, [&] { return mute(options, report); });
  if (!counts) {
    return report.fail(counts.error());
  }
  report.note("switched off " + counted(counts->bodies, "body", "bodies") + ", " +
              counted(counts->colliders, "collider") + ", " + counted(counts->joints, "joint"));
  return report.finish(counts->out_of_reach == 0 ? kOk : kNo, muted_json(*counts));
}

}  // namespace

void add_strip(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("strip", "Remove or mute all physics of an asset");
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
