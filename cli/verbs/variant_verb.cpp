// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A selection is held against the composed stage, which knows the prim, the set and the variant,
// before it is authored. In place, on standard output and beside the asset the result is its root
// layer with the selection, and text keeps its layout. In another folder the relative asset paths
// of that layer would lead nowhere, so the result there is a new layer with the asset as sublayer.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "cli/asset_copy.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/verb.h"
#include "tenon/answers/variants_json.h"
#include "tenon/asset/edited_file.h"
#include "tenon/base/assignment.h"
#include "tenon/base/text/shown_path.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/tenon.h"

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

struct Selection {
  Path prim;
  std::string set;
  std::string variant;
};

/// Checks that the prim, the set and the variant exist, and says what does exist otherwise.
Result<Selection> find_selection(const stage::Stage& stage, const VariantArguments& options) {
  TENON_TRY(auto assignment, split_assignment(options.assignment));
  const stage::Prim prim =
      options.prim.empty() ? stage.default_prim() : stage.prim(Path::from(options.prim));
  if (!prim.is_valid()) {
    return Error(ErrorCode::NotFound, options.prim.empty()
                                          ? "the layer has no default prim"
                                          : "there is no prim <" + options.prim + ">")
        .with_fix("name the prim with --prim");
  }
  const auto [set, variant] = assignment;
  const auto sets = prim.variant_set_names();
  if (std::find(sets.begin(), sets.end(), set) == sets.end()) {
    std::string known;
    for (const std::string& name : sets) {
      known += (known.empty() ? "" : ", ") + name;
    }
    return Error(ErrorCode::NotFound,
                 "<" + prim.path().str() + "> has no variant set \"" + set + "\"")
        .with_fix(known.empty() ? "tenon variant lists all sets" : "sets there: " + known);
  }
  const auto names = prim.variant_names(set);
  if (std::find(names.begin(), names.end(), variant) == names.end()) {
    std::string known;
    for (const std::string& name : names) {
      known += (known.empty() ? "" : ", ") + name;
    }
    return Error(ErrorCode::NotFound,
                 "variant set \"" + set + "\" has no variant \"" + variant + "\"")
        .with_fix("choose one of: " + known);
  }
  return Selection{prim.path(), set, variant};
}

Result<layer::Layer> with_selection(layer::Layer layer, const Selection& selection) {
  edit::LayerEditor editor(layer);
  TENON_CHECK(editor.create_prim(selection.prim));
  editor.select_variant(selection.prim, selection.set, selection.variant);
  return layer;
}

/// The file's text with nothing but what differs changed; nothing for files that are no text.
Result<std::optional<std::string>> edited_text(const layer::Layer& edited, Report& report) {
  TENON_TRY(const auto bytes, bytes::FileBytes::open(edited.identifier()));
  if (formats::format_of(*bytes) != formats::LayerFormat::Text) {
    return std::optional<std::string>();
  }
  TENON_TRY(EditedFile file, edited_file(*bytes, edited));
  if (!file.kept_layout) {
    report.note("comments and layout of " + shown_path(edited.identifier()) + " are not kept");
  }
  return std::optional<std::string>(std::move(file.after));
}

/// The contents of the file to be written.
Result<std::string> with_selection_written(const layer::Layer& layer, const Selection& selection,
                                           const VariantArguments& options, Report& report) {
  namespace fs = std::filesystem;
  const std::string output = options.in_place ? layer.identifier() : options.output;
  const bool same_folder = output != "-" && fs::absolute(output).parent_path().lexically_normal() ==
                                                fs::path(layer.identifier()).parent_path();
  if (!options.in_place && output != "-" && !same_folder) {
    // Relative asset paths would break elsewhere: lay a layer over the asset instead.
    layer::Layer over = layer_over(layer, output);
    report.note(shown_path(output) + " is a layer over " + shown_path(layer.identifier()));
    TENON_TRY(const formats::LayerFormat format, formats::layer_format_for(output));
    TENON_TRY(over, with_selection(std::move(over), selection));
    return formats::encode_layer(over, format);
  }
  TENON_TRY(const layer::Layer changed, with_selection(layer, selection));
  const auto format = formats::layer_format_for(output);
  if (options.in_place || output == "-" || (format && *format == formats::LayerFormat::Text)) {
    TENON_TRY(auto text, edited_text(changed, report));
    if (text) {
      return *std::move(text);
    }
  }
  if (output == "-") {
    return formats::encode_layer(changed, formats::LayerFormat::Text);
  }
  if (options.in_place && bytes::is_in_package(output)) {
    return Error(ErrorCode::Unsupported, "files in a package are not changed in place")
        .in_file(output)
        .with_fix("give -o FILE, or unpack it: tenon zip PACKAGE --extract FOLDER");
  }
  if (options.in_place) {
    return formats::encode_layer(changed, formats::LayerFormat::Crate);
  }
  TENON_TRY(const formats::LayerFormat wanted, format);
  return formats::encode_layer(changed, wanted);
}

Result<Selection> select(const VariantArguments& options, Outputs& outputs, Report& report) {
  TENON_TRY(const stage::Stage stage,
            open_stage(options.asset.asset, options.asset.open_options(), report.diagnostics));
  TENON_TRY(Selection selection, find_selection(stage, options));
  const layer::Layer& layer = stage.root_layer();
  TENON_TRY(std::string contents, with_selection_written(layer, selection, options, report));
  outputs.put(options.in_place ? layer.identifier() : options.output, std::move(contents));
  TENON_CHECK(outputs.commit());
  return selection;
}

int list_variants(Report& report, const VariantArguments& options) {
  auto stage = open_stage(options.asset.asset, options.asset.open_options(), report.diagnostics);
  if (!stage) {
    return report.fail(stage.error());
  }
  const Json variants = answers::variants_json(*stage, options.prim);
  if (!report.json()) {
    print_variants(variants);
  }
  return report.finish(kOk, {{"variants", variants}});
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
  const auto selection = edit_files(report, [&] {
    Outputs outputs = options.in_place ? Outputs::in_place() : Outputs();
    return select(options, outputs, report);
  });
  if (!selection) {
    return report.fail(selection.error());
  }
  return report.finish(kOk, {{"prim", selection->prim.str()},
                             {"set", selection->set},
                             {"selection", selection->variant}});
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
