// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/edit/stage_editor.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/layout.h"

/// Edits of prims in every file that defines them. Internal to the wiring.
namespace tenon {

struct AllFiles {
  const structure::RolesOfFiles& roles;
  std::vector<std::shared_ptr<const stage::Stage>> stages;  ///< under all selections
  /// Under variants that are not selected; there to find what depends on a prim alone.
  std::vector<std::shared_ptr<const stage::Stage>> other_variants;
  std::function<edit::StageEditor*(const std::string& layer)> editor_of;
  Diagnostics& diagnostics;
};

struct EditedSpecs {
  std::vector<EditedPlace> places;  ///< one for each file, and for each list that lost a target
  std::set<Path> dependents;        ///< prims composed of the edited one, with what followed
};

/// Makes the edit, and lets what depends on the prim follow. Errors: those of prim_sites.h,
/// spec_edits.h and dependent_edits.h; NotFound (edit.no-spec) where no own file defines it.
Result<EditedSpecs> edit_in_all_files(const AllFiles& files, const AssetEdit& edit);

/// The file of an engine whose variant the edit removes, which goes with it; empty where none does.
/// Errors: Invalid (edit.in-use) where the file has opinions.
Result<std::string> file_that_goes(const AllFiles& files, const AssetEdit& edit);

/// Looks whether the scene is as asked. Errors: Invalid (edit.hidden).
Result<void> check_done_in_all_files(const stage::Stage& stage, const AssetEdit& edit);

}  // namespace tenon
