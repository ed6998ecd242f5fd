// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A table of commands as text, cell by cell, so that every error has its line and column. Numbers
// become SI while they are read.
#include "tenon/bake/commands/commands_from_csv.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "tenon/bake/commands/command_names.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/text_number.h"

namespace tenon::bake {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && is_space(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

/// Cells of a text one by one, with their place.
class CommandText {
 public:
  explicit CommandText(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xEF\xBB\xBF")) {
      rest_.remove_prefix(3);
    }
  }

  /// Goes to the next line that is not empty; false at the end.
  bool next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      row_ = rest_.substr(0, end);
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_;
      at_ = 0;
      if (!trimmed(row_).empty()) {
        return true;
      }
    }
    return false;
  }
  bool has_cell() const { return at_ <= row_.size(); }
  std::string_view next_cell() {
    const std::size_t end = std::min(row_.find(',', at_), row_.size());
    const std::string_view cell = row_.substr(at_, end - at_);
    column_ = static_cast<std::uint32_t>(at_ + 1);
    at_ = end + 1;
    return trimmed(cell);
  }
  Error error(ErrorCode code, std::string message, std::string fix) const {
    return place(
        Error(code, std::move(message)).with_rule("sim.commands").with_fix(std::move(fix)));
  }
  /// `error` at the cell.
  Error place(Error error) const { return std::move(error).at(line_, column_); }

 private:
  std::string_view rest_;
  std::string_view row_;
  std::size_t at_ = 0;  ///< in row_, behind its end when there are no more cells
  std::uint32_t line_ = 0;
  std::uint32_t column_ = 1;
};

Result<std::vector<CommandColumn>> read_header(CommandText& text, const CommandNames& names) {
  if (!text.next_line()) {
    return text.error(ErrorCode::Parse, "there is no header", "begin with a line \"time,...\"");
  }
  if (const std::string_view first = text.next_cell(); first != "time") {
    return text.error(ErrorCode::Parse,
                      "the first column is " + shown_name(first) + ", not \"time\"",
                      "begin with a line \"time,...\"");
  }
  std::vector<CommandColumn> columns;
  std::set<std::string_view> seen;
  while (text.has_cell()) {
    const std::string_view name = text.next_cell();
    auto column = names.find(name);
    if (!column) {
      return text.place(std::move(column).error());
    }
    if (!seen.insert(name).second) {
      return text.error(ErrorCode::Parse, "the column " + shown_name(name) + " is there twice",
                        "leave one out");
    }
    columns.push_back(*column);
  }
  return columns;
}

/// A number of units, as SI.
Result<double> read_number(const CommandText& text, std::string_view cell, double unit = 1) {
  const std::optional<double> number = parse_double(cell);
  if (!number || !std::isfinite(*number * unit)) {
    return text.error(ErrorCode::Parse, shown_name(cell) + " is not a finite number",
                      "write a number, or nothing where what held goes on");
  }
  return *number * unit;
}

Result<void> read_time(CommandText& text, Commands& commands) {
  TENON_TRY(const double time, read_number(text, text.next_cell()));
  if (!commands.times.empty() && time <= commands.times.back()) {
    return text.error(ErrorCode::Parse,
                      "time " + shortest(time) + " s does not come after " +
                          shortest(commands.times.back()) + " s of the row before",
                      "sort the rows by time, each time once");
  }
  commands.times.push_back(time);
  return {};
}

Result<void> read_row(CommandText& text, const std::vector<double>& units, Commands& commands) {
  TENON_CHECK(read_time(text, commands));
  std::size_t count = 0;
  while (text.has_cell() && count <= units.size()) {
    const std::string_view cell = text.next_cell();
    if (count == units.size()) {
      ++count;
    } else if (cell.empty()) {
      commands.values.push_back(std::numeric_limits<double>::quiet_NaN());
      ++count;
    } else {
      TENON_TRY(const double number, read_number(text, cell, units[count++]));
      commands.values.push_back(number);
    }
  }
  if (count != units.size()) {
    return text.error(
        ErrorCode::Parse,
        std::string(count < units.size() ? "fewer" : "more") + " cells than the header has",
        "give each row " + std::to_string(units.size() + 1) + " cells");
  }
  if (commands.values.size() + commands.times.size() > limits::kCommandValues) {
    return text.error(
        ErrorCode::Limit,
        "more than " + std::to_string(limits::kCommandValues) + " numbers of commands",
        "give a file for each part of the run, with --state-out and --state-in between");
  }
  return {};
}

}  // namespace

Result<Commands> commands_from_csv(std::string_view csv, const scene::PhysicsScene& scene,
                                   const engines::Simulation& simulation) {
  const CommandNames names(scene, simulation);
  CommandText text(csv);
  Commands commands;
  TENON_TRY(commands.columns, read_header(text, names));
  std::vector<double> units;
  for (const CommandColumn& column : commands.columns) {
    units.push_back(names.unit_of(column));
  }
  while (text.next_line()) {
    TENON_CHECK(read_row(text, units, commands));
  }
  return commands;
}

}  // namespace tenon::bake
