// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/file_bytes.h"
#include "tenon/engines/simulation.h"
#include "tenon/scene/physics_scene.h"

/// Commands to drives and joints over time.
namespace tenon::bake {

enum class CommandKind : std::uint8_t {
  Target,          ///< position target of a drive [m, rad]
  VelocityTarget,  ///< [m/s, rad/s]
  Effort,          ///< along a free degree of freedom of a joint [N, N m], on top of its drives
};

/// What one column sets.
struct CommandColumn {
  CommandKind kind = CommandKind::Target;
  scene::Index joint = 0;
  scene::Index part = 0;  ///< into Joint::drives, of efforts into JointState::position
};

/// A row holds from its time until the next one; before the first, nothing is commanded.
struct Commands {
  std::vector<CommandColumn> columns;
  std::vector<double> times;   ///< [s], ascending (row_count)
  std::vector<double> values;  ///< SI (row_count x column_count), row-major; NaN: as before
};

/// Of a table with commas (commands_from_csv.h) or an archive of NumPy (commands_from_npz.h), told
/// by its first bytes.
Result<Commands> read_commands(const std::shared_ptr<const bytes::FileBytes>& file,
                               const scene::PhysicsScene& scene,
                               const engines::Simulation& simulation);

/// Warnings (sim.commands) about rows of a run that went on until `end` [s]: those before time 0,
/// where no run is, and those after the end, which nothing was given.
void tell_rows_outside(const Commands& commands, double end, Diagnostics& diagnostics);

/// Gives commands to a simulation as its time goes on. Its arguments must outlive it.
class CommandPlayer {
 public:
  CommandPlayer(const Commands& commands, const scene::PhysicsScene& scene,
                engines::Simulation& simulation);

  /// To be called before each step: rows whose time has come take effect. Errors: those of the
  /// simulation.
  Result<void> advance();
  /// All rows have taken effect.
  bool is_done() const { return row_ == commands_.times.size(); }

 private:
  struct DriveSlot {
    scene::Index joint = 0;
    scene::Index drive = 0;
    engines::DriveTarget target;
    bool changed = false;
  };
  struct EffortSlot {
    scene::Index joint = 0;
    std::vector<double> efforts;
    bool changed = false;
  };

  using SlotMap = std::map<std::pair<scene::Index, scene::Index>, std::size_t>;

  std::size_t effort_slot(scene::Index joint, SlotMap& known);
  std::size_t drive_slot(scene::Index joint, scene::Index drive, SlotMap& known);
  void take_row(std::size_t row);
  Result<void> apply();

  const Commands& commands_;
  const scene::PhysicsScene& scene_;
  engines::Simulation& simulation_;
  std::vector<DriveSlot> drives_;
  std::vector<EffortSlot> efforts_;
  std::vector<std::size_t> slots_;  ///< into drives_ or efforts_ (column_count)
  std::size_t row_ = 0;             ///< the next one
};

}  // namespace tenon::bake
