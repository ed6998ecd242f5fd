// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every name that a column could have is put in one table first: what is in the file is then either
// found there or an error that says what is nearest. Numbers become SI while they are read. A row
// takes effect with the first step that begins at its time, to a millionth of a step, because
// times of steps are sums. A drive has one target of two numbers: where the file has a column for
// one of them, the other is the asset's.
#include "tenon/bake/commands.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "tenon/bake/drive_names.h"
#include "tenon/base/limits/run_limits.h"
#include "tenon/base/text/nearest_name.h"
#include "tenon/base/text/text_number.h"
#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

using scene::Index;
using KnownColumns = std::map<std::string, CommandColumn, std::less<>>;

KnownColumns known_columns(const scene::PhysicsScene& scene,
                           const engines::Simulation& simulation) {
  KnownColumns known;
  for (Index j = 0; j < scene.joints.size(); ++j) {
    const scene::Joint& joint = scene.joints[j];
    const std::string path = joint.path.str();
    for (Index k = 0; k < joint.drives.size(); ++k) {
      const std::string label = drive_label(joint, k);
      known[path + ".target" + label] = {CommandKind::Target, j, k};
      known[path + ".velocityTarget" + label] = {CommandKind::VelocityTarget, j, k};
    }
    const std::size_t count = simulation.joint_state(j).position.size();
    for (Index k = 0; k < count; ++k) {
      known[path + ".effort" + part_label(k, count)] = {CommandKind::Effort, j, k};
    }
  }
  return known;
}

/// How many SI units one unit of a column is.
double unit_of(const CommandColumn& column, const scene::PhysicsScene& scene) {
  if (column.kind == CommandKind::Effort) {
    return 1;
  }
  return scene::is_angular(scene.joints[column.joint].drives[column.part].dof)
             ? 1 / kDegreesPerRadian
             : scene.meters_per_unit;
}

std::string shown(std::string_view text) {
  constexpr std::size_t kShown = 100;
  return "\"" + std::string(text.substr(0, kShown)) + (text.size() > kShown ? "..." : "") + "\"";
}

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
    return Error(code, std::move(message))
        .at(line_, column_)
        .with_rule("sim.commands")
        .with_fix(std::move(fix));
  }

 private:
  std::string_view rest_;
  std::string_view row_;
  std::size_t at_ = 0;  ///< in row_, behind its end when there are no more cells
  std::uint32_t line_ = 0;
  std::uint32_t column_ = 1;
};

/// What could be meant: of the joint that the name begins with, where there is one, else of all.
std::string column_fix(std::string_view name, const KnownColumns& known) {
  constexpr std::size_t kLongest = 500;
  const std::string path = std::string(name.substr(0, name.find('.'))) + ".";
  std::vector<std::string_view> names;
  std::string has;
  for (auto at = known.lower_bound(path); at != known.end() && at->first.starts_with(path); ++at) {
    names.push_back(at->first);
    if (has.size() < kLongest) {
      has += (has.empty() ? "" : ", ") + at->first.substr(path.size() - 1);
    }
  }
  if (names.empty()) {
    for (const auto& [column, what] : known) {
      names.push_back(column);
    }
  }
  const std::string_view nearest =
      name.size() > kLongest ? std::string_view() : nearest_name(name, names);
  return !nearest.empty() ? "did you mean " + std::string(nearest) + "?"
         : !has.empty()   ? "this joint has " + has
                          : "name a joint's .target, .velocityTarget or .effort";
}

Result<std::vector<CommandColumn>> read_header(CommandText& text, const KnownColumns& known) {
  if (!text.next_line()) {
    return text.error(ErrorCode::Parse, "there is no header", "begin with a line \"time,...\"");
  }
  if (const std::string_view first = text.next_cell(); first != "time") {
    return text.error(ErrorCode::Parse, "the first column is " + shown(first) + ", not \"time\"",
                      "begin with a line \"time,...\"");
  }
  std::vector<CommandColumn> columns;
  std::set<std::string_view> seen;
  while (text.has_cell()) {
    const std::string_view name = text.next_cell();
    const auto found = known.find(name);
    if (found == known.end()) {
      return text.error(
          ErrorCode::NotFound,
          "the scene has no drive and no degree of freedom for the column " + shown(name),
          column_fix(name, known));
    }
    if (!seen.insert(name).second) {
      return text.error(ErrorCode::Parse, "the column " + shown(name) + " stands twice",
                        "leave one out");
    }
    columns.push_back(found->second);
  }
  return columns;
}

/// A number of units, as SI.
Result<double> read_number(const CommandText& text, std::string_view cell, double unit = 1) {
  const std::optional<double> number = parse_double(cell);
  if (!number || !std::isfinite(*number * unit)) {
    return text.error(ErrorCode::Parse, shown(cell) + " is no finite number",
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
  CommandText text(csv);
  Commands commands;
  TENON_TRY(commands.columns, read_header(text, known_columns(scene, simulation)));
  std::vector<double> units;
  for (const CommandColumn& column : commands.columns) {
    units.push_back(unit_of(column, scene));
  }
  while (text.next_line()) {
    TENON_CHECK(read_row(text, units, commands));
  }
  return commands;
}

CommandPlayer::CommandPlayer(const Commands& commands, const scene::PhysicsScene& scene,
                             engines::Simulation& simulation)
    : commands_(commands), scene_(scene), simulation_(simulation) {
  SlotMap drives;
  SlotMap efforts;
  for (const CommandColumn& column : commands.columns) {
    slots_.push_back(column.kind == CommandKind::Effort
                         ? effort_slot(column.joint, efforts)
                         : drive_slot(column.joint, column.part, drives));
  }
}

std::size_t CommandPlayer::effort_slot(Index joint, SlotMap& known) {
  const auto [at, is_new] = known.try_emplace({joint, 0}, efforts_.size());
  if (is_new) {
    const std::size_t count = simulation_.joint_state(joint).position.size();
    efforts_.push_back({joint, std::vector<double>(count, 0.0)});
  }
  return at->second;
}

std::size_t CommandPlayer::drive_slot(Index joint, Index drive, SlotMap& known) {
  const auto [at, is_new] = known.try_emplace({joint, drive}, drives_.size());
  if (is_new) {
    const scene::Drive& d = scene_.joints[joint].drives[drive];
    drives_.push_back({joint, drive, {d.target_position, d.target_velocity}});
  }
  return at->second;
}

void CommandPlayer::take_row(std::size_t row) {
  const std::size_t width = commands_.columns.size();
  for (std::size_t i = 0; i < width; ++i) {
    const CommandColumn& column = commands_.columns[i];
    const double value = commands_.values[row * width + i];
    if (std::isnan(value)) {
      continue;
    }
    if (column.kind == CommandKind::Effort) {
      efforts_[slots_[i]].efforts[column.part] = value;
      efforts_[slots_[i]].changed = true;
      continue;
    }
    DriveSlot& slot = drives_[slots_[i]];
    (column.kind == CommandKind::Target ? slot.target.position : slot.target.velocity) = value;
    slot.changed = true;
  }
}

Result<void> CommandPlayer::advance() {
  const double now = simulation_.time() + 1e-6 * simulation_.time_step();
  const std::size_t before = row_;
  while (row_ < commands_.times.size() && commands_.times[row_] <= now) {
    take_row(row_++);
  }
  return row_ == before ? Result<void>() : apply();
}

Result<void> CommandPlayer::apply() {
  for (DriveSlot& slot : drives_) {
    if (slot.changed) {
      TENON_CHECK(simulation_.set_drive_target(slot.joint, slot.drive, slot.target));
      slot.changed = false;
    }
  }
  for (EffortSlot& slot : efforts_) {
    if (slot.changed) {
      TENON_CHECK(simulation_.set_joint_efforts(slot.joint, slot.efforts));
      slot.changed = false;
    }
  }
  return {};
}

}  // namespace tenon::bake
