// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/state_bytes.h"
#include "tenon/engines/steering.h"

namespace tenon::engines::mujoco {

struct BrokenJoint {
  scene::Index joint = 0;
  double force = 0;   ///< [N]
  double torque = 0;  ///< [N m]
};

/// A rebuild of the model in the middle of a run: what another process needs to repeat it.
struct Restart {
  double time = 0;         ///< [s]
  double advanced_to = 0;  ///< [s] of the timeline before; < 0: it was not
  std::vector<BrokenJoint> broken;
  std::vector<scene::Index> driven;  ///< kinematic bodies that can be moved from now on
  std::vector<BodyState> states;     ///< (body_count)
};

/// All that the future of a run depends on, beside the scene and the options.
struct SavedRun {
  DriveTerms drives = DriveTerms::Engine;
  Methods methods;
  double advanced_to = -1;
  std::vector<Restart> history;
  Steering steering;
  std::vector<double> state;   ///< mjSTATE_INTEGRATION
  std::vector<int> asleep;     ///< mjData::tree_asleep (tree_count)
  std::vector<double> factor;  ///< of M, where acceleration drives look at that of the last step
  Work work;
};

std::vector<double> integration_state(const mjModel& m, const mjData& d);
/// mjData::tree_asleep (tree_count).
std::vector<int> sleeping_trees(const mjModel& m, const mjData& d);

/// Whether sleeping trees form cycles and the others count down: MuJoCo follows them unchecked.
bool is_sound_sleep(const std::vector<int>& asleep);

/// Brings fresh data to a state, derived quantities included. Errors: those of MuJoCo.
Result<void> write_state(const Model& model, const std::vector<double>& state,
                         const std::vector<int>& asleep);

}  // namespace tenon::engines::mujoco
