// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/asset/check_asset.h"
#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/settings/settings.h"

namespace tenon {

/// The settings files of several assets, each read once.
class AssetSettings {
 public:
  /// Errors: those of settings::read_settings.
  static Result<AssetSettings> read(const std::vector<std::string>& assets,
                                    const bytes::Files& files);

  /// Null where the asset has none.
  const settings::Settings* of(const std::string& asset) const;

 private:
  std::map<std::string, settings::Settings> by_file_;
  std::map<std::string, std::string> files_;  // by asset
};

/// The options with what the settings say where the options say nothing.
CheckOptions with_settings(CheckOptions options, const settings::Settings* settings);

/// What skips the rule: nothing where `rules.only` names it. May be null.
const settings::SkippedRule* skips(const settings::Settings* settings,
                                   const check::Selection& rules, const std::string& rule);

}  // namespace tenon
