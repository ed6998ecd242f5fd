// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "tenon/dynamics/multibody.h"
#include "tenon/scene/motion/joint_tree.h"

namespace tenon::dynamics {

/// By how much the frame of body1 is away from the nearest place that the joint allows: a rotation
/// vector [rad] and a translation [m], world axes.
scene::Screw frames_apart(const Multibody& multibody, const Posture& posture, Index joint);

/// Moves the coordinates of one joint by what `step` says from `column` on, a ball by a turn about
/// the axes of frame 0.
void move_joint(const scene::JointDofs& dofs, const Eigen::VectorXd& step, std::size_t column,
                std::vector<double>& joint);

/// One Gauss-Newton step of the group's joints toward closed loops. `posture.bodies` are as its
/// joints have them, and are not moved. False where the loops are closed, or as far as they can be.
bool loop_step(const Multibody& multibody, const scene::JointGroup& group, Posture& posture);

}  // namespace tenon::dynamics
