// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/stage/prim.h"

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

/// With the fix that helps where files are edited.
Error with_file_fix(Error error);

}  // namespace tenon
