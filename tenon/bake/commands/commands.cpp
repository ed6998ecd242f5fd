// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A row takes effect with the first step that begins at its time, to a millionth of a step, because
// times of steps are sums. A drive has one target of two numbers: where the file has a column for
// one of them, the other is the asset's.
#include "tenon/bake/commands/commands.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tenon/bake/commands/commands_from_csv.h"
#include "tenon/bake/commands/commands_from_npz.h"
#include "tenon/base/text/grouped_digits.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/zip/zip_archive.h"

namespace tenon::bake {

using scene::Index;

Result<Commands> read_commands(const std::shared_ptr<const bytes::FileBytes>& file,
                               const scene::PhysicsScene& scene,
                               const engines::Simulation& simulation) {
  TENON_TRY(Commands commands, bytes::ZipArchive::is_zip(file->text())
                                   ? commands_from_npz(file, scene, simulation)
                                   : commands_from_csv(file->text(), scene, simulation));
  if (std::all_of(commands.values.begin(), commands.values.end(),
                  [](double value) { return std::isnan(value); })) {
    return Error(ErrorCode::Invalid, "the table commands nothing: no row has a number but its time")
        .with_rule("sim.commands")
        .with_fix("give rows with a time and a number below the name of a joint's .target");
  }
  return commands;
}

void tell_rows_outside(const Commands& commands, double end, Diagnostics& diagnostics) {
  const std::vector<double>& times = commands.times;
  const auto tell = [&](std::ptrdiff_t count, const std::string& what, const char* fix) {
    if (count != 0) {
      Diagnostic finding;
      finding.severity = Severity::Warning;
      finding.rule = "sim.commands";
      finding.message = grouped_digits(static_cast<std::size_t>(count)) + " of " +
                        grouped_digits(times.size()) + " rows of commands " + what;
      finding.fix = fix;
      diagnostics.add(std::move(finding));
    }
  };
  const auto start = std::lower_bound(times.begin(), times.end(), 0.0);
  tell(start - times.begin(), "are before time 0, and hold from there like a row of time 0",
       "count the times from 0, where the simulation starts");
  const auto late = std::upper_bound(times.begin(), times.end(), end + 1e-9 * std::abs(end));
  if (late != times.end()) {
    tell(times.end() - late,
         "are not given: the run ends at " + rounded_text(end) + " s, before " +
             rounded_text(*late) + " s",
         "give a longer --duration, or those rows to a run that goes on with --state-in");
  }
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
