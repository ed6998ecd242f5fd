// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/engines/mujoco/model.h"
#include "tenon/engines/simulation_values.h"

namespace tenon::engines::mujoco {

/// Where MuJoCo holds what one joint carries.
struct JointCarriers {
  scene::Index joint = 0;
  int child = -1;  ///< MuJoCo body that hangs on it in the tree, else -1
  bool reversed = false;
  std::vector<int> equalities;
  int tendon_max = -1;  ///< bounds of the distance
  int tendon_min = -1;
  int cone = -1;   ///< tendon that bounds the tilt
  double arm = 0;  ///< [m] of the two points of a loop hinge, and of the tips of a cone
};

/// Those of all joints (joint_count).
std::vector<JointCarriers> find_carriers(const scene::PhysicsScene& scene, const Model& model);

/// What body 0 exerts on body 1 through the joint in the step that was just made: about the origin
/// of frame 1, world axes. mj_rnePostConstraint must have run, and derive_motion() not yet: poses
/// are those of the beginning of the step.
Wrench joint_reaction(const scene::PhysicsScene& scene, const Model& model,
                      const JointCarriers& carriers);

}  // namespace tenon::engines::mujoco
