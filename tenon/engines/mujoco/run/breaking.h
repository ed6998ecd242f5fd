// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/base/result.h"
#include "tenon/engines/mujoco/model.h"

namespace tenon::engines::mujoco {

/// What a joint carries about its anchor, world axes.
struct JointLoad {
  Vec3d force;   ///< [N]
  Vec3d torque;  ///< [N m]
};

/// Joints of a model that may break (S-93) and what they carry.
class Breaking {
 public:
  struct Broken {
    scene::Index joint = 0;
    JointLoad load;
  };

  Breaking() = default;
  /// Joints that are enabled and have a limit of force or torque.
  Breaking(const scene::PhysicsScene& scene, const Model& model);

  bool empty() const { return breakable_.empty(); }
  /// Those that carried more than their limits in the step that was just made. Errors: Invalid
  /// where MuJoCo cannot say what joints carry.
  Result<std::vector<Broken>> broken(const scene::PhysicsScene& scene, const Model& model) const;

 private:
  /// Something holds or carries a force that may break it.
  struct Breakable {
    scene::Index joint = 0;
    int child = -1;  ///< MuJoCo body that hangs on it in the tree, else -1
    std::vector<int> equalities;
    std::vector<int> tendons;
    int cone = -1;   ///< tendon that bounds the tilt
    double arm = 0;  ///< [m] of the two points of a loop hinge, and of the tips of a cone
  };
  static JointLoad load_on(const scene::PhysicsScene& scene, const Model& model,
                           const Breakable& breakable);
  static JointLoad load_of_cone(const scene::PhysicsScene& scene, const Model& model,
                                const Breakable& breakable);

  std::vector<Breakable> breakable_;
};

}  // namespace tenon::engines::mujoco
