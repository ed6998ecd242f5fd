// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/asset/editing/all_file_edits.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"

/// Units, time codes and the default prim of a stage, which its root layer holds. Internal to the
/// wiring.
namespace tenon {

/// "timeCodesPerSecond", "upAxis", ...: what can be set.
std::vector<std::string> stage_metadata_names();

/// NAME=VALUE of each as an edit. Errors: Invalid (edit.bad-argument), with the nearest name or the
/// values that are allowed.
Result<std::vector<AssetEdit>> stage_metadata_edits(const std::vector<std::string>& texts);

/// Makes the edit in the root layer. That values of the asset keep their numbers while their unit
/// changes goes to `diagnostics` (edit.not-rescaled). Errors: Invalid (edit.no-prim) for a default
/// prim that is not there.
Result<EditedPlace> set_stage_metadata(const AllFiles& files, const AssetEdit& edit,
                                       Diagnostics& diagnostics);

/// Whether the stage has it as asked.
bool has_stage_metadata(const stage::Stage& stage, const AssetEdit& edit);

}  // namespace tenon
