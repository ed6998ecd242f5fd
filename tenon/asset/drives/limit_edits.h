// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/asset/drives/drives_asset.h"

/// Internal to the drives of assets.
namespace tenon {

/// What writes `new_effort` and `new_speed` of the drives, in the forms that the asset has of them:
/// the force range of drives and actuators, and the speed limits of Newton's and PhysX's schemas. A
/// speed limit that the asset has in no form becomes newton:velocityLimit, and where "Physics" has
/// a variant "physx" also physxJoint:maxJointVelocity in its file. Errors: those of tenon::open and
/// read_edits.
Result<std::vector<AssetEdit>> limit_edits(const std::string& path, const OpenOptions& open,
                                           const DrivesOfAsset& found);

/// What makes every mimic of PhysX rigid or compliant as `text` says (DrivesOptions::mimic).
/// Errors: those of tenon::open; Invalid (drives.mimic) for text of another form, and NotFound
/// (drives.no-mimic) where the asset has none.
Result<std::vector<AssetEdit>> compliance_edits(const std::string& path, const OpenOptions& open,
                                                const DrivesOfAsset& found,
                                                const std::string& text);

}  // namespace tenon
