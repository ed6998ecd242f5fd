// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tenon/engines/simulation_values.h"
#include "tenon/scene/joint_dofs.h"

/// Forces of the asset and of the user as wrenches on bodies, for engines without coordinates.
namespace tenon::engines {

/// The asset's constant forces at the body's centre of mass, while the body is at `pose`.
Wrench constant_wrench(const scene::Body& body, const Pose& pose);

/// What efforts along a joint's coordinates do to body1: a wrench about the origin of frame 1; to
/// body0 the opposite. Frames in world axes.
Wrench effort_wrench(const scene::Joint& joint, const scene::JointDofs& dofs, const Pose& frame0,
                     const Pose& frame1, std::span<const double> efforts);

}  // namespace tenon::engines
