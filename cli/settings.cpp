// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/settings.h"

#include <optional>
#include <utility>

namespace tenon::cli {

Result<settings::Settings> settings_for(const std::string& asset, Report& report) {
  if (report.globals().no_settings || asset == "-") {
    return settings::Settings();
  }
  TENON_TRY(std::optional<settings::Settings> found, settings::settings_of(asset, bytes::Files()));
  if (!found) {
    return settings::Settings();
  }
  report.name_settings(found->file);
  return *std::move(found);
}

Result<std::string> engine_for(const std::string& given, const std::string& asset, Report& report) {
  TENON_TRY(const settings::Settings settings, settings_for(asset, report));
  return given.empty() ? settings.engine : given;
}

Result<std::string> names_for(const std::string& given, const std::string& asset, Report& report) {
  TENON_TRY(const settings::Settings settings, settings_for(asset, report));
  return given.empty() ? settings.names : given;
}

}  // namespace tenon::cli
