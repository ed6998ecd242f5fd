// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/checking/asset_settings.h"

#include <optional>
#include <utility>

namespace tenon {

Result<AssetSettings> AssetSettings::read(const std::vector<std::string>& assets,
                                          const bytes::Files& files) {
  AssetSettings read;
  for (const std::string& asset : assets) {
    const std::optional<std::string> file = settings::find_settings(asset, files);
    if (!file) {
      continue;
    }
    if (!read.by_file_.contains(*file)) {
      TENON_TRY(settings::Settings settings, settings::read_settings(*file, files));
      read.by_file_.emplace(*file, std::move(settings));
    }
    read.files_.emplace(asset, *file);
  }
  return read;
}

const settings::Settings* AssetSettings::of(const std::string& asset) const {
  const auto file = files_.find(asset);
  return file == files_.end() ? nullptr : &by_file_.at(file->second);
}

CheckOptions with_settings(CheckOptions options, const settings::Settings* settings) {
  if (settings != nullptr && options.profile.empty()) {
    options.profile = settings->profile;
  }
  return options;
}

const settings::SkippedRule* skips(const settings::Settings* settings,
                                   const check::Selection& rules, const std::string& rule) {
  const bool asked_for = !rules.only.empty() && rules.takes(rule);
  return settings == nullptr || asked_for ? nullptr : settings->skipped(rule);
}

}  // namespace tenon
