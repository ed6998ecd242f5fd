// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/layer/layer.h"
#include "tenon/layer/value.h"
#include "tenon/property_value.h"
#include "tenon/stage/prim.h"

/// What prims have beside properties and schemas: arcs, selected variants, the order of what is in
/// them, metadata (of properties, too). Internal to the wiring.
namespace tenon {

/// Whether what the edit needs of the prim is there: a schema that can be applied, variants to
/// select, names to put in order, a sample to take away. Errors: those of edit::check_api; NotFound
/// (edit.no-variant, edit.no-prim, edit.no-property, edit.no-sample), Invalid (edit.type-mismatch),
/// with the name that was probably meant.
Result<void> check_fits(const stage::Prim& prim, const AssetEdit& edit);

/// The spec of a prim or property in a layer says what the edit is about.
bool says(const layer::Layer& layer, const layer::Spec& spec, const AssetEdit& edit);

/// The value of the metadata that the edit names, read by the type of the field; a dictionary with
/// one entry where `key` is given, whose value it is. Errors: Invalid (edit.unknown-metadata with
/// the nearest name, edit.type-mismatch).
Result<layer::Value> read_metadata(const stage::Prim& prim, const AssetEdit& edit);
/// The composed one, at the key; empty where nothing says it.
layer::Value composed_metadata(const stage::Prim& prim, const AssetEdit& edit);
/// The composed one is what was read.
bool has_metadata(const stage::Prim& prim, const AssetEdit& edit, const layer::Value& asked);

/// AddArc, RemoveArc, SelectVariant, OrderChildren, OrderProperties, SetMetadata, ClearMetadata at
/// the editor's target; `spec` is the object there.
Result<void> author_whole_prim(edit::StageEditor& editor, const AssetEdit& edit, Path spec,
                               const PropertyValue& typed);
/// The arc of an edit, last or first among those of its kind.
Result<void> author_arc(edit::StageEditor& editor, Path prim, const AssetArc& arc);

/// How many arcs that `file` gives the prim lead nowhere.
std::size_t lost_arcs(const stage::Stage& stage, Path prim, const std::string& file);
/// Why the last of them does: edit.no-target, with the prim that was probably meant.
Error lost_arc(const stage::Stage& stage, const AssetEdit& edit, const std::string& file);

}  // namespace tenon
