// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/bake/output_recording.h"
#include "tenon/bake/pose_recording.h"
#include "tenon/engines/simulation.h"

namespace tenon::bake {

/// States of all bodies and joints at several times; what logs are made of.
struct StateRecording {
  std::vector<double> times;                ///< [s] from the start, ascending (frame_count)
  std::vector<engines::BodyState> bodies;   ///< (frame_count x body_count), row-major
  std::vector<engines::JointState> joints;  ///< (frame_count x joint_count), row-major
  std::size_t body_count = 0;
  std::size_t joint_count = 0;
  OutputRecording outputs;  ///< of the same frames

  std::size_t frame_count() const { return times.size(); }
  const engines::BodyState& body(std::size_t frame, std::size_t i) const {
    return bodies[frame * body_count + i];
  }
  const engines::JointState& joint(std::size_t frame, std::size_t i) const {
    return joints[frame * joint_count + i];
  }
  PoseRecording poses() const;
};

}  // namespace tenon::bake
