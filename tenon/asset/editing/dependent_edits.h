// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <vector>

#include "tenon/asset/editing/all_file_edits.h"
#include "tenon/asset/editing/prim_sites.h"
#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/stage/sources/dependent_sites.h"

/// Edits of what is composed of a prim that is renamed or removed. Internal to the wiring.
namespace tenon {

/// Under all selections, the variants that are not selected included. Errors: Invalid
/// (edit.prim-exists) where a dependent cannot have the new name, (edit.in-use) where an arc of
/// another file leads to a prim that is to go.
Result<stage::Dependents> dependents_in(const AllFiles& files, const PrimSites& sites,
                                        const AssetEdit& edit);

/// Lets their specs, and what names them, follow: a place for each spec, and those of the prims
/// that something was said about. Errors: Invalid (edit.in-use) where a layer cannot be edited, and
/// those of spec_edits.h.
Result<EditedSpecs> edit_dependents(const AllFiles& files, const stage::Dependents& dependents,
                                    const AssetEdit& edit);

/// Looks whether the scene has none of `prims` any more, dependents as they were: what was said
/// about them would be split. Errors: Invalid (edit.in-use).
Result<void> check_dependents_followed(const stage::Stage& stage, const std::set<Path>& prims);

}  // namespace tenon
