// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/base/token.h"
#include "tenon/edit/layer_editor.h"
#include "tenon/stage/sources/dependent_sites.h"

/// Edits of all specs that one layer has of a prim, those inside of variants included. `prim` is
/// its path there, without variant selections. Each returns the specs that changed. Internal to
/// the wiring.
namespace tenon {

/// Removes them, and takes the prim and all below it out of targets and connections, relocates and
/// the default prim. A list that replaces weaker ones stays, if empty; a relationship that has none
/// any more goes. Errors: Invalid (edit.in-use) where an arc leads there.
Result<std::vector<Path>> remove_prim_specs(edit::LayerEditor& editor, Path prim);

/// Those of the prims that specs of the layer are about or name, texts not included.
std::set<Path> mentioned_prims(const layer::Layer& layer, const std::set<Path>& prims);

/// Renames those of each of the prims, and the prims in all targets, connections and arcs of the
/// layer, not in texts (path_texts.h).
Result<std::vector<Path>> rename_prim_specs(edit::LayerEditor& editor, const std::set<Path>& prims,
                                            Token name);

/// Renames the prim in references and payloads of a prim that lead to it or below it in another
/// file.
std::vector<Path> rename_in_asset_arcs(edit::LayerEditor& editor, const stage::Dependents::Arc& arc,
                                       Token name);

/// Renames the specs of a property of some prims, and the property in all targets, connections and
/// path expressions of the layer.
Result<std::vector<Path>> rename_property_specs(edit::LayerEditor& editor,
                                                const std::set<Path>& prims, Token name, Token now);

/// Removes a variant with all in it, and the set when it was its last one.
Result<std::vector<Path>> remove_variant_specs(edit::LayerEditor& editor, Path prim,
                                               const std::string& set, const std::string& variant);

}  // namespace tenon
