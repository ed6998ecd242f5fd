// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/settings/settings.h"

namespace tenon::settings {

enum class KeyType : std::uint8_t {
  Choice,  ///< one of a few names
  Skips,   ///< a table: id of a rule = the reason to skip it
};

/// A key of tenon.toml: help, documentation and messages are made of this table.
struct Key {
  std::string_view name;  ///< with the tables that it is in: "check.profile"
  KeyType type = KeyType::Choice;
  std::string_view about;
  std::string_view instead;                         ///< the option that replaces it
  std::string_view example;                         ///< in TOML
  std::vector<std::string> (*choices)() = nullptr;  ///< of Choice
  std::string Settings::* value = nullptr;          ///< of Choice
};

/// All keys, sorted by name.
const std::vector<Key>& keys();

/// "engine, check.profile": the names of all keys.
std::string key_list();

}  // namespace tenon::settings
