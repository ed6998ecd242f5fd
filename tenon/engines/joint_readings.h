// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::engines {

/// How a rigid body moves: the velocity of one of its points, and its turn, world axes.
struct RigidMotion {
  Vec3d point;    ///< [m]
  Vec3d linear;   ///< of the point [m/s]
  Vec3d angular;  ///< [rad/s]
  Vec3d velocity_at(const Vec3d& where) const { return linear + cross(angular, where - point); }
};

/// One side of a joint: its frame in the world, and the body that carries it.
struct JointSide {
  Pose frame;
  RigidMotion motion;
};

/// Coordinates and velocities of a joint that no tree holds, from where its two frames stand:
/// angles within one turn. Of distance joints the distance.
JointState joint_state_between(const scene::Joint& joint, const scene::JointDofs& dofs,
                               const JointSide& side0, const JointSide& side1);

}  // namespace tenon::engines
