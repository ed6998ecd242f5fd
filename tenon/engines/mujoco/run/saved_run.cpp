// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/saved_run.h"

#include <algorithm>
#include <cstddef>

#include "tenon/engines/mujoco/contact_filter.h"
#include "tenon/engines/mujoco/error_hook.h"
#include "tenon/engines/mujoco/run/coupled_drives.h"

namespace tenon::engines::mujoco {

std::vector<double> integration_state(const mjModel& m, const mjData& d) {
  std::vector<double> state(static_cast<std::size_t>(mj_stateSize(&m, mjSTATE_INTEGRATION)));
  mj_getState(&m, &d, state.data(), mjSTATE_INTEGRATION);
  return state;
}

std::vector<int> sleeping_trees(const mjModel& m, const mjData& d) {
  return {d.tree_asleep, d.tree_asleep + m.ntree};
}

bool is_sound_sleep(const std::vector<int>& asleep) {
  const auto count = static_cast<int>(asleep.size());
  std::vector<char> pointed_at(asleep.size(), 0);
  for (const int next : asleep) {
    if (next < 0) {
      if (next < -(1 + mjMINAWAKE)) {
        return false;
      }
      continue;
    }
    if (next >= count || asleep[static_cast<std::size_t>(next)] < 0 ||
        pointed_at[static_cast<std::size_t>(next)] != 0) {
      return false;
    }
    pointed_at[static_cast<std::size_t>(next)] = 1;
  }
  return true;
}

// mj_forward derives what can be read before the next step; what it writes into the state is put
// back.
Result<void> write_state(const Model& model, const std::vector<double>& state,
                         const std::vector<int>& asleep) {
  const mjModel* m = model.model.get();
  mjData* d = model.data.get();
  const FilterScope filter(model.filter);
  return guarded([&] {
    mj_setState(m, d, state.data(), mjSTATE_INTEGRATION);
    std::copy(asleep.begin(), asleep.end(), d->tree_asleep);
    forward(model);
    mj_setState(m, d, state.data(), mjSTATE_INTEGRATION);
    std::copy(asleep.begin(), asleep.end(), d->tree_asleep);
  });
}

}  // namespace tenon::engines::mujoco
