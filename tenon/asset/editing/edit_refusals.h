// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/edit/edit_target.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/stage/prim.h"
#include "tenon/stage/sources/opinion_sources.h"

/// What edits of assets are refused for, whichever file they go to. Internal to the wiring.
namespace tenon {

/// NotFound (edit.no-prim).
Error no_prim_in_any_variant(Path prim);

/// Unsupported (edit.in-package) for a layer in a package.
Result<void> check_in_no_package(const std::string& identifier);

/// Whether the object is of the kind that the edit is about.
Result<void> check_object(const AssetEdit& edit);

/// Invalid (edit.prim-exists).
Error already_there(const stage::Prim& prim);

/// Invalid (edit.in-use): an arc of `from` leads to `prim`.
Error used_by_arc(Path from, Path prim);

/// Invalid (edit.hidden): what `file` says now does not count in the scene, which is shown under
/// this selection of "Physics" (none: empty). Names the stronger file.
Error hidden(const stage::Stage& stage, const std::string& shown, const AssetEdit& edit,
             const std::string& file);

/// Where an edit goes at a place of a layer: there, or into the variant that it names. Errors:
/// Invalid for what is not below the prim of the variant (edit.outside-target), and for edits of
/// all files at once.
Result<edit::EditTarget> target_of(edit::StageEditor& editor, const stage::LayerSite& site,
                                   const std::string& layer, const AssetEdit& edit);

/// With the fix that helps where files are edited.
Error with_file_fix(Error error);

}  // namespace tenon
