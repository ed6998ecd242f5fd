// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

/// What the program understands, as values: help, manual pages, completions and tests all read the
/// same table, which command_line.cpp makes of the options that parse.
namespace tenon::cli {

/// The numbers that an option takes.
struct NumberRange {
  double least = 0;
  double most = 0;
  bool without_least = false;  ///< `least` itself is too small
  bool whole = false;          ///< whole numbers only
  std::string unit;            ///< "s", or empty

  bool holds(double number) const;
  /// "from 0 to 10 s", "above 0, up to 10 s".
  std::string text() const;
};

struct OptionInfo {
  std::vector<std::string> names;  ///< with their dashes; a positional has one, without
  std::string value;               ///< the placeholder of the value, "FILE"; empty: takes none
  std::string help;
  std::vector<std::string> choices;  ///< when not empty, the only values
  std::optional<NumberRange> range;
  bool positional = false;
  bool required = false;
  bool list = false;            ///< may be given many times
  bool optional_value = false;  ///< the value is optional
  /// Has no effect without one of these: "--vary", or "--test=stress" for a value.
  std::vector<std::string> only_with;
  std::vector<std::string> not_with;  ///< has no effect beside any of these, written the same way

  const std::string& longest_name() const { return names.back(); }
  /// "-o, --output FILE".
  std::string signature() const;
};

/// The headings of verbs, in this order.
inline constexpr const char* kVerbGroups[] = {"Look", "Check and convert", "Edit", "Simulate",
                                              "Show", "The program"};

struct CommandInfo {
  std::string name;
  std::string about;
  std::string group;  ///< of verbs: its heading in the help of the program, one of kVerbGroups
  std::string footer;
  std::vector<OptionInfo> options;  ///< positionals first
  std::vector<CommandInfo> commands;

  const CommandInfo* find(const std::string& verb) const;
};

}  // namespace tenon::cli
