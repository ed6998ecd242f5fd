// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/engines/mujoco/run/data_lender.h"

#include <utility>

#include "tenon/engines/mujoco/error_hook.h"

namespace tenon::engines::mujoco {

DataPtr DataLender::take(const mjModel& model) {
  {
    const std::lock_guard<std::mutex> held(mutex_);
    if (!idle_.empty()) {
      DataPtr last = std::move(idle_.back());
      idle_.pop_back();
      return last;
    }
  }
  mjData* made = nullptr;
  const Result<void> done = guarded_where_open([&] { made = mj_makeData(&model); });
  return DataPtr(done ? made : nullptr);
}

void DataLender::give_back(DataPtr data) {
  const std::lock_guard<std::mutex> held(mutex_);
  idle_.push_back(std::move(data));
}

}  // namespace tenon::engines::mujoco
