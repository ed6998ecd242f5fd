// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/math/transform.h"

namespace tenon::bake {

/// World poses of all bodies at several times.
struct PoseRecording {
  std::vector<double> times;  ///< [s] from the start, ascending (frame_count)
  std::vector<Pose> poses;  ///< X_WB (frame_count x body_count), row-major, bodies as in the scene
  std::size_t body_count = 0;

  std::size_t frame_count() const { return times.size(); }
  const Pose& pose(std::size_t frame, std::size_t body) const {
    return poses[frame * body_count + body];
  }
};

}  // namespace tenon::bake
