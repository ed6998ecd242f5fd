// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/files.h"

/// tenon.toml, the settings file of a repository of assets: defaults of commands, and rules that
/// are skipped there. It has no paths and no limits, so it never lets more be read or run.
namespace tenon::settings {

inline constexpr std::string_view kFileName = "tenon.toml";

/// A rule whose findings are counted, not reported.
struct SkippedRule {
  std::string rule;    ///< as check::rules() has it
  std::string reason;  ///< never empty
};

struct Settings {
  std::string file;     ///< absolute path
  std::string engine;   ///< of simulations; empty: not set
  std::string names;    ///< of files and scopes that are made; empty: not set
  std::string profile;  ///< of checks; empty: not set
  std::vector<SkippedRule> skip;

  /// Null where the rule, also by a former id, is not skipped.
  const SkippedRule* skipped(std::string_view rule) const;
};

/// The settings file of an asset: the nearest one in its folder or above, up to the folder that has
/// `.git`, also one that is no file or a symbolic link to nothing. Without such a folder only the
/// asset's own is looked at. Nothing where there is none.
std::optional<std::string> find_settings(const std::string& asset, const bytes::Files& files);

/// `file` is absolute, its folder without symbolic links, as find_settings gives it.
/// Errors: those of opening the file; Limit (file.too-large) above limits::kSettingsBytes; Invalid
/// (settings.outside) for a symbolic link that leads out of the folder that has `.git`, or where
/// there is none out of its own; Parse (settings.syntax) for bad TOML; Invalid
/// (settings.unknown-key, settings.type, settings.value) with every fault in `further`; Missing
/// (settings.missing) in a build without a TOML parser.
Result<Settings> read_settings(const std::string& file, const bytes::Files& files);

/// Both: the settings that hold for an asset, nothing where it has none.
Result<std::optional<Settings>> settings_of(const std::string& asset, const bytes::Files& files);

}  // namespace tenon::settings
