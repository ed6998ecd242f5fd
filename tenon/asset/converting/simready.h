// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/structure/make/asset_facts.h"
#include "tenon/structure/package.h"

/// What assets get beside their structure when they are made for SimReady.
namespace tenon {

/// Profiles that assets of robots are made for, by the names that `check` has for them.
const std::vector<std::string>& known_target_profiles();
/// Of SimReady, which asks for more than Asset Structure 3.0.
bool is_simready_target(const std::string& profile);

/// The facts that `given` says as NAME=VALUE, by their names in SimReady_Metadata. What is not
/// given follows: the category from the kind of robot, the source from the file that the asset is
/// made of, the date from SOURCE_DATE_EPOCH or the clock, "Q11012", a robot, for what it is.
/// Errors: Invalid for what is no assignment, or of a name that SimReady does not know or that the
/// asset itself tells.
Result<structure::AssetFacts> simready_facts(const std::vector<std::string>& given,
                                             const std::string& robot_type,
                                             const std::string& source);

/// Names what SimReady asks for and nobody said, the kind of robot among it: findings of the rule
/// "profile.unknown".
void name_unknown_facts(const structure::Package& package, Diagnostics& diagnostics);

/// Draws the asset, whose layers are stored, at its start into .thumbs/256x256 of the package.
/// Where that cannot be done, a finding "profile.no-thumbnail" says why. `files`: what `package`
/// leads out to.
Result<void> add_thumbnail(structure::Package& package, const bytes::Files& files,
                           const std::string& folder, Diagnostics& diagnostics);

}  // namespace tenon
