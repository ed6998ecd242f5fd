// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/robot/kinematic_tree.h"

namespace tenon::robot {

/// The model with each link that a fixed joint holds merged into the link that holds it: mass,
/// centre of mass and inertia are summed (parallel axes), shapes moved, joints hung on the link
/// that remains. `tree` is that of `model`.
RobotModel merge_fixed(const RobotModel& model, const KinematicTree& tree);

/// The inertial of two rigidly joined parts, both in the same link frame.
Inertial sum_inertials(const Inertial& a, const Inertial& b);

/// An inertial seen from another frame: `pose` is that of its link frame there.
Inertial placed(const Inertial& inertial, const Pose& pose);

}  // namespace tenon::robot
