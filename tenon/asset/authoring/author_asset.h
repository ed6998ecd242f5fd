// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tenon/asset/authoring/add_edits.h"
#include "tenon/asset/edit_asset.h"
#include "tenon/asset/made_file.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"

/// Scenes made of kinds (kinds.h): new files, and prims added, removed and renamed.
namespace tenon {

struct NewAsset {
  std::string up_axis = "Z";
  double meters_per_unit = 1;
  double kilograms_per_unit = 1;
  std::string default_prim = "World";
  std::optional<double> time_codes_per_second;
  std::optional<double> start_time_code;
  std::optional<double> end_time_code;
};

/// A file with the units and an empty Xform as its default prim, in the format of its name. Errors:
/// Invalid (edit.bad-name).
Result<MadeFile> new_asset(const std::string& file, const NewAsset& wanted);

/// The edited asset, and the edits that its places refer to.
struct AuthoredAsset {
  std::vector<AssetEdit> edits;
  EditedAsset asset;
};

/// Each edit goes to the file that owns it, is verified, and its effect on the physics is reported,
/// as in edit_asset. No file is touched. Errors: those of add_edits, remove_edits and edit_asset.
Result<AuthoredAsset> add_to_asset(const std::string& path, const AuthoringRequest& request,
                                   const EditOptions& options, Diagnostics& diagnostics);
Result<AuthoredAsset> remove_from_asset(const std::string& path, const AuthoringRequest& request,
                                        const EditOptions& options, Diagnostics& diagnostics);
/// Renames a prim or a property in all files of the asset, with all that names it there.
Result<AuthoredAsset> rename_in_asset(const std::string& path, const std::string& object,
                                      const std::string& name, const EditOptions& options,
                                      Diagnostics& diagnostics);

}  // namespace tenon
