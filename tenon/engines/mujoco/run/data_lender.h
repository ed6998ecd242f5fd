// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// Data that many simulations of one model take turns to step with. What a step computes is then
/// written where the step before it has left the cache warm, and not to as many places as there are
/// simulations. Any thread may call.
class DataLender {
 public:
  /// What was given back last, or new data; nullptr where there is no memory. Its contents are
  /// those of another step.
  DataPtr take(const mjModel& model);
  /// Not after a step that failed.
  void give_back(DataPtr data);

 private:
  std::mutex mutex_;
  std::vector<DataPtr> idle_;
};

}  // namespace tenon::engines::mujoco
