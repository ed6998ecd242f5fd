// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <utility>

#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/answers/variants_json.h"
#include "tenon/asset/layers/select_variant.h"
#include "tenon/asset/repeat_edit.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/open_stage.h"

namespace tenon::cli {
namespace {

struct VariantArguments {
  AssetArguments asset;
  std::string assignment;
  std::string prim;
  std::string output;
  bool in_place = false;
};

void print_variants(const Json& variants) {
  for (const auto& v : variants) {
    print("%s  %s\n", v["prim"].get<std::string>().c_str(), v["set"].get<std::string>().c_str());
    for (const auto& option : v["options"]) {
      print("  %s %s\n", option == v["selection"] ? "*" : " ", option.get<std::string>().c_str());
    }
  }
}

Result<VariantSelection> select(const VariantArguments& options, Report& report) {
  const SelectOptions wanted{.open = options.asset.open_options(),
                             .assignment = options.assignment,
                             .prim = options.prim,
                             .in_place = options.in_place,
                             .output = options.output};
  TENON_TRY(SelectedVariant selected,
            select_variant(options.asset.asset, wanted, report.diagnostics));
  if (selected.is_layer_over) {
    report.note(shown_path(selected.file.path) + " is a layer over " + shown_path(selected.root));
  }
  if (!selected.kept_layout) {
    report.note("comments and layout of " + shown_path(selected.root) + " are not kept");
  }
  Outputs outputs =
      options.in_place ? Outputs::in_place({"variant", options.asset.asset}) : Outputs();
  outputs.put(selected.file.path, std::move(selected.file.contents));
  TENON_CHECK(outputs.commit());
  return selected.selection;
}

int list_variants(Report& report, const VariantArguments& options) {
  auto stage = tenon::open(options.asset.asset, options.asset.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  Json answer = answers::variant_list_json(*stage, options.prim);
  if (!report.json()) {
    print_variants(answer["variants"]);
  }
  return report.finish(kOk, std::move(answer));
}

int run_variant(const Globals& globals, const VariantArguments& options) {
  Report report(globals, "variant", options.asset.asset);
  if (options.assignment.empty()) {
    return list_variants(report, options);
  }
  if (options.output.empty() != options.in_place) {
    return report.fail(Error(ErrorCode::Invalid, "say where to write the selection")
                           .with_fix("give either -o FILE or --in-place"));
  }
  if (options.output == "-" && globals.json) {
    return report.fail(
        Error(ErrorCode::Invalid, "--json and a layer cannot both go to standard output")
            .with_fix("name an output file with -o"));
  }
  Outputs claims;
  if (auto claimed = claims.claim(OutputKind::Layer, options.output); !claimed) {
    return report.fail(claimed.error());
  }
  const auto selection = repeat_edit(report.diagnostics, [&] { return select(options, report); });
  if (!selection) {
    return report.fail(selection.error());
  }
  return report.finish(kOk, selected_json(*selection));
}

}  // namespace

void add_variant(const Command& parent, const Globals& globals, Chosen& chosen) {
  const Command verb = parent.add_subcommand("variant", "List variant sets, or author a selection");
  auto options = std::make_shared<VariantArguments>();
  options->asset.add_to(verb);
  verb.add_option("selection", options->assignment, "SET=VARIANT; without it all sets are listed");
  verb.add_option("--prim", options->prim, "The prim with the set; without it the default prim");
  verb.add_option("-o,--output", options->output, "Write the changed layer here");
  verb.add_flag("--in-place", options->in_place,
                "Change the asset's root layer; comments and layout of text stay");
  verb.footer(
      "Examples:\n  tenon variant hand.usda\n"
      "  tenon variant hand.usda Physics=mujoco --in-place\n"
      "  tenon variant hand.usda Physics=physx -o hand_physx.usda");
  choose(verb, chosen, [&globals, options] { return run_variant(globals, *options); });
}

}  // namespace tenon::cli
