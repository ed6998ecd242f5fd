// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

/// The numbered rules of rigid body physics that messages and accounts name: S-83, M-19, Q-3.
namespace tenon::cli {

/// What the rule with this number says, in a sentence; nothing where there is none. Case does not
/// count.
std::optional<std::string> rule_with_number(std::string_view number);

/// Letter, dash, digits: the form of such a number.
bool is_rule_number(std::string_view text);

/// The table, one line each: number | status | file | rule | ... Made by cmake/rule_numbers.cmake.
std::string_view rule_number_table();

}  // namespace tenon::cli
