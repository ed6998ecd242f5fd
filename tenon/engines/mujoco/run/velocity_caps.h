// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// Cuts velocities to the limits of the scene after a step: of joints by the impulse along them
/// that does it, of bodies that move freely by scaling their own velocity.
class VelocityCaps {
 public:
  VelocityCaps() = default;
  VelocityCaps(const scene::PhysicsScene& scene, const Model& model);

  bool empty() const { return dofs_.empty() && bodies_.empty(); }
  void apply(Model& model);

 private:
  struct Coordinate {
    int dof = 0;
    double limit = 0;
  };
  struct FreeBody {
    int dof = 0;
    double linear = 0;
    double angular = 0;
  };
  std::vector<Coordinate> dofs_;
  std::vector<FreeBody> bodies_;
  std::vector<double> unit_;      ///< scratch (dof_count)
  std::vector<double> response_;  ///< scratch (dof_count)
};

}  // namespace tenon::engines::mujoco
