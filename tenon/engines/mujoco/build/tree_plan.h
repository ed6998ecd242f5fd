// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tenon/scene/joint_forest.h"

/// MuJoCo wants a forest: every body hangs on the world or on one other body. The scene's own is
/// that forest; this decides how bodies without a joint stand and how loops are closed.
namespace tenon::engines::mujoco {

/// How one joint reaches MuJoCo.
enum class JointRole : std::uint8_t {
  None,       ///< disabled, without effect, or not expressible
  Tree,       ///< degrees of freedom between a body and its parent
  Weld,       ///< loop: both frames are held together
  Connect,    ///< loop: both origins are held together
  Hinge,      ///< loop: two points of the axis are held together
  Auxiliary,  ///< loop: an auxiliary body carries the degrees of freedom and is welded to body1
  Distance,   ///< bounds the distance of the two origins
};

enum class BodyBase : std::uint8_t {
  Free,     ///< six degrees of freedom in the world
  Fixed,    ///< a kinematic body that does not move
  Driven,   ///< a kinematic body that follows a pose track
  Jointed,  ///< hangs on its parent by a joint
};

struct TreePlan {
  scene::JointForest forest;
  std::vector<BodyBase> bases;    ///< (body_count)
  std::vector<JointRole> joints;  ///< (joint_count)
};

TreePlan plan_tree(const scene::PhysicsScene& scene);

}  // namespace tenon::engines::mujoco
