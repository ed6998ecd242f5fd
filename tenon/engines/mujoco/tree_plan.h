// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tenon/physics/physics_scene.h"

/// MuJoCo wants a forest: every body hangs on the world or on one other body. This decides which
/// joints make the forest and how the others are closed, from the neutral scene alone.
namespace tenon::engines::mujoco {

/// How one joint reaches MuJoCo.
enum class JointRole : std::uint8_t {
  None,      ///< disabled, without effect, or not expressible
  Tree,      ///< degrees of freedom between a body and its parent
  Weld,      ///< loop: both frames are held together
  Connect,   ///< loop: both origins are held together
  Hinge,     ///< loop: two points of the axis are held together
  Ghost,     ///< loop: an auxiliary body carries the degrees of freedom and is welded to body1
  Distance,  ///< bounds the distance of the two origins
};

enum class BodyBase : std::uint8_t {
  Free,     ///< six degrees of freedom in the world
  Fixed,    ///< a kinematic body that does not move
  Driven,   ///< a kinematic body that follows a pose track
  Jointed,  ///< hangs on `parent` by `joint`
};

struct BodyPlan {
  BodyBase base = BodyBase::Free;
  std::optional<physics::Index> parent;  ///< of Jointed bodies; none: the world
  physics::Index joint = 0;              ///< of Jointed bodies
  bool reversed = false;                 ///< the body is body0 of `joint`
};

struct TreePlan {
  std::vector<BodyPlan> bodies;       ///< (body_count)
  std::vector<JointRole> joints;      ///< (joint_count)
  std::vector<physics::Index> order;  ///< all bodies, parents before children
  std::size_t depth = 0;              ///< bodies on the longest chain
};

/// Spanning forest over the enabled joints: joints of articulations first, declared loop joints and
/// excluded ones last; among equals, those that are easy to close as a loop come last.
TreePlan plan_tree(const physics::PhysicsScene& scene);

}  // namespace tenon::engines::mujoco
