// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/jolt/model.h"

namespace tenon::engines::jolt {

/// Jolt ignores a body's rotation in a step where it is a millionth of a radian or less: at steps
/// of 1 ms all that turns slower than 1e-3 rad/s does not move, and drives stop short of their
/// targets. Here such rotations are summed until they are large enough.
class SlowTurns {
 public:
  SlowTurns() = default;
  explicit SlowTurns(const Model& model) : waiting_(model.bodies.size()) {}
  void after_step(const Model& model);

 private:
  std::vector<Vec3d> waiting_;  ///< [rad] world axes (body_count)
};

}  // namespace tenon::engines::jolt
