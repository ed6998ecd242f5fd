// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A selection is checked against the composed stage, which knows the prim, the set and the variant,
// before it is authored. In place, on standard output and beside the asset the result is its root
// layer with the selection, and text keeps its layout. In another folder the relative asset paths
// of that layer would lead nowhere, so the result there is a new layer with the asset as sublayer.
#include "tenon/asset/layers/select_variant.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tenon/asset/layers/asset_layers.h"
#include "tenon/base/assignment.h"
#include "tenon/base/text/comma_list.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/files.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/formats/save_layer.h"

namespace tenon {
namespace {

/// Checks that the prim, the set and the variant exist, and says what does exist otherwise.
Result<VariantSelection> find_selection(const stage::Stage& stage, const std::string& prim_path,
                                        const std::pair<std::string, std::string>& assignment) {
  const stage::Prim prim =
      prim_path.empty() ? stage.default_prim() : stage.prim(Path::from(prim_path));
  if (!prim.is_valid()) {
    return Error(ErrorCode::NotFound, prim_path.empty() ? "the layer has no default prim"
                                                        : "there is no prim <" + prim_path + ">")
        .with_fix("name the prim with --prim");
  }
  const auto [set, variant] = assignment;
  const auto sets = prim.variant_set_names();
  if (std::find(sets.begin(), sets.end(), set) == sets.end()) {
    const std::string known = comma_list(sets);
    return Error(ErrorCode::NotFound,
                 "<" + prim.path().str() + "> has no variant set \"" + set + "\"")
        .with_fix(known.empty() ? "tenon variant lists all sets" : "sets there: " + known);
  }
  const auto names = prim.variant_names(set);
  if (std::find(names.begin(), names.end(), variant) == names.end()) {
    return Error(ErrorCode::NotFound,
                 "variant set \"" + set + "\" has no variant \"" + variant + "\"")
        .with_fix("choose one of: " + comma_list(names));
  }
  return VariantSelection{prim.path(), set, variant};
}

Result<layer::Layer> with_selection(layer::Layer layer, const VariantSelection& selection) {
  edit::LayerEditor editor(layer);
  TENON_CHECK(editor.create_prim(selection.prim));
  editor.select_variant(selection.prim, selection.set, selection.variant);
  return layer;
}

/// Asset paths of the root layer lead from there to the same files.
bool keeps_asset_paths(const layer::Layer& root, const std::string& output) {
  namespace fs = std::filesystem;
  return output == "-" || (!bytes::is_in_package(root.identifier()) &&
                           fs::path(bytes::absolute_file_path(output)).parent_path() ==
                               fs::path(root.identifier()).parent_path());
}

}  // namespace

Result<SelectedVariant> select_variant(const std::string& path, const SelectOptions& options,
                                       Diagnostics& diagnostics) {
  TENON_TRY(const stage::Stage stage, tenon::open(path, options.open, diagnostics));
  TENON_TRY(const auto assignment, split_assignment(options.assignment));
  SelectedVariant result;
  TENON_TRY(result.selection, find_selection(stage, options.prim, assignment));
  const layer::Layer& root = stage.root_layer();
  const std::string& output = options.in_place ? root.identifier() : options.output;
  result.file.path = output;
  result.root = root.identifier();
  if (!options.in_place && !keeps_asset_paths(root, output)) {
    result.is_layer_over = true;
    TENON_TRY(const layer::Layer over, with_selection(layer_over(root, output), result.selection));
    TENON_TRY(result.file.contents, new_contents(over, output));
    return result;
  }
  if (options.in_place && bytes::is_in_package(output)) {
    return Error(ErrorCode::Unsupported, "files in a package are not changed in place")
        .in_file(output)
        .with_fix("give -o FILE, or unpack it: tenon zip PACKAGE --extract FOLDER");
  }
  TENON_TRY(const layer::Layer changed, with_selection(root, result.selection));
  TENON_TRY(LayerContents made, edited_contents(changed, output, options.open.files));
  result.file.contents = std::move(made.contents);
  result.kept_layout = made.kept_layout;
  return result;
}

answers::Json selected_json(const VariantSelection& selection) {
  return {{"prim", selection.prim.str()}, {"set", selection.set}, {"selection", selection.variant}};
}

}  // namespace tenon
