// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/engines/physx/model.h"

/// What acts along the coordinates of joints, as PhysX's drives and, where they have no room for
/// it, as forces before each step.
namespace tenon::engines::physx {

/// Some drive of the joint acts along the coordinate.
bool is_driven(const scene::Joint& joint, scene::Dof dof);
/// The joint has a spring or damper of its own beside drives.
inline bool has_spring(const scene::Joint& joint) {
  return joint.stiffness != 0 || joint.damping != 0;
}
/// The joint's spring and damper act beside the drive along the coordinate.
bool acts_beside_drive(const scene::Joint& joint, const JointMap& map, scene::Dof dof);
/// What a drive exerts in a step that begins at `position` and ends with `velocity`; none for a
/// drive by acceleration.
std::optional<double> drive_effort(const scene::Joint& joint, const JointMap& map,
                                   const scene::Drive& drive, double position, double velocity,
                                   double time_step);

/// Before each step of a joint that has `beside`: PhysX's drive is as the step needs it. What acts
/// on the coordinate besides, as a force.
double prepare_spring(JointMap& map, const JointState& state, double effort, double time_step);

/// Gives PhysX all drives of a joint, gains and targets, and the map what they have no room for.
void write_drives(const scene::Joint& joint, JointMap& map, double time_step);

}  // namespace tenon::engines::physx
