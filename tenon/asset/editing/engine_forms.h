// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/result.h"

/// Internal to the wiring.
namespace tenon {

/// `edits` with those that say the same to engines that have a form of their own for it, as the
/// asset is under the variants of "Physics": opinions on the same property in the file of an
/// engine, gains and force range of MuJoCo's actuators on a driven joint, PhysX's and MuJoCo's
/// schemas of a mimic that is given as Newton's. No form is added where the asset has none. Errors:
/// those of opening the asset; Invalid together with a file or an engine in `options`.
Result<std::vector<AssetEdit>> with_engine_forms(const std::string& asset,
                                                 std::vector<AssetEdit> edits,
                                                 const EditOptions& options);

}  // namespace tenon
