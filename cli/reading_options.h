// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cli/command_line.h"
#include "tenon/base/result.h"
#include "tenon/physics/readings.h"

namespace tenon::cli {

/// The option --reading NAME=VALUE, which may be repeated.
void add_readings(const Command& verb, std::vector<std::string>& assignments);
/// Errors: Invalid, with the names and values that there are.
Result<physics::Readings> chosen_readings(const std::vector<std::string>& assignments);
/// Help of --reading: every name with its values and who reads how.
std::string readings_help();

}  // namespace tenon::cli
