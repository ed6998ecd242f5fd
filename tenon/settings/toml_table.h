// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::settings {

/// A value of TOML as tenon.toml uses it: a text, or the name of another type.
struct TomlValue {
  std::vector<std::string> path;  ///< keys of the tables that it is in, then its own
  std::string type;               ///< "string", "integer", "array", "empty table" and others
  std::string text;               ///< of a string
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  double number = 0;  ///< of an integer or a float
};

/// Every value of a text in TOML, in the order of the text; empty tables too. Paths are at most
/// limits::kSettingsDepth long: the value at that depth has the type "table". Errors: Parse
/// (settings.syntax) with its place; Missing (settings.missing) in a build without toml++.
Result<std::vector<TomlValue>> toml_values(std::string_view text);

}  // namespace tenon::settings
