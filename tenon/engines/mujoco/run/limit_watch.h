// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// Finds joints that run into a hard limit and are thrown back: MuJoCo's limits are springs with
/// dampers that only push (build/softness.cpp), so that some of the speed is left.
class LimitWatch {
 public:
  struct Rebound {
    scene::Index joint = 0;
    bool angular = true;
    double before = 0;  ///< speed into the limit [rad/s or m/s]
    double after = 0;   ///< speed back
  };

  LimitWatch() = default;
  LimitWatch(const scene::PhysicsScene& scene, const Model& model);

  /// After a step in which limits acted. Each joint is told once.
  std::vector<Rebound> look(const Model& model);

 private:
  struct Watched {
    scene::Index joint = 0;
    bool angular = true;
    bool told = true;   ///< or no hard limit of ours
    double last = -1;   ///< when the limit acted last [s]
    int steps = 0;      ///< for which it acts without a break
    double before = 0;  ///< the largest in these
    double after = 0;
  };
  std::vector<Watched> joints_;  ///< by joint of MuJoCo
};

}  // namespace tenon::engines::mujoco
