// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "cli/report.h"
#include "tenon/base/result.h"
#include "tenon/settings/settings.h"

/// What tenon.toml (tenon/settings/settings.h) says where the command line says nothing.
namespace tenon::cli {

/// The settings of the asset's repository, whose file `report` then names. All are empty where it
/// has none, with --no-settings and for standard input.
Result<settings::Settings> settings_for(const std::string& asset, Report& report);

/// The engine of the command line, else that of the settings; empty where neither names one.
Result<std::string> engine_for(const std::string& given, const std::string& asset, Report& report);

/// --names in the same way.
Result<std::string> names_for(const std::string& given, const std::string& asset, Report& report);

}  // namespace tenon::cli
