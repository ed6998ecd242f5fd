// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/run/joint_reactions.h"

namespace tenon::engines::mujoco {

/// Joints of a model that may break (S-93) and what they carry.
class Breaking {
 public:
  struct Broken {
    scene::Index joint = 0;
    double force = 0;   ///< [N]
    double torque = 0;  ///< [N m]
  };

  Breaking() = default;
  /// Joints that are enabled and have a limit of force or torque.
  Breaking(const scene::PhysicsScene& scene, const Model& model);

  bool empty() const { return breakable_.empty(); }
  /// Those that carried more than their limits in the step that was just made. Errors: Invalid
  /// where MuJoCo cannot say what joints carry.
  Result<std::vector<Broken>> broken(const scene::PhysicsScene& scene, const Model& model) const;

 private:
  std::vector<JointCarriers> breakable_;
};

}  // namespace tenon::engines::mujoco
