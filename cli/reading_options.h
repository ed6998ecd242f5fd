// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/verb.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/dynamics/masks.h"
#include "tenon/physics/readings.h"
#include "tenon/stage/stage.h"

namespace tenon::cli {

/// The option --reading NAME=VALUE, which may be repeated.
void add_readings(const Command& verb, std::vector<std::string>& assignments);
/// The option --pose JOINT=VALUE,... or NAME, which may be repeated.
void add_pose(const Command& verb, std::vector<std::string>& pose);
/// The options --deactivate, --bypass and --anchor, which may be repeated.
void add_masks(const Command& verb, dynamics::Masks& masks);
/// Errors: Invalid, with the names and values that there are.
Result<physics::Readings> chosen_readings(const std::vector<std::string>& assignments);
/// An asset whose physics is to be read with --reading.
struct ReadableAsset {
  physics::Readings readings;
  stage::Stage stage;
};
/// Errors: those of chosen_readings and tenon::open.
Result<ReadableAsset> open_with_readings(const AssetArguments& asset,
                                         const std::vector<std::string>& assignments,
                                         Diagnostics& diagnostics);
/// Help of --reading: every name with its values and the tools that use them.
std::string readings_help();

}  // namespace tenon::cli
