// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "tenon/engines/physx/model.h"

/// What acts along the coordinates of joints, as PhysX's drives and, where they have no room for
/// it, as forces before each step.
namespace tenon::engines::physx {

/// What acts along one coordinate, as the one drive that PhysX has for it.
struct AxisLaw {
  double stiffness = 0;
  double damping = 0;
  double max_force = scene::kUnlimited;
  bool acceleration = false;
  double target_position = 0;
  double target_velocity = 0;
  bool acts() const { return (stiffness != 0 || damping != 0) && max_force != 0; }
};

/// The drive of a joint along a coordinate; without one its passive spring and damper, or its
/// friction as a damper of bounded force.
AxisLaw law_of(const scene::Joint& joint, scene::Dof dof);
/// Some drive of the joint acts along the coordinate.
bool is_driven(const scene::Joint& joint, scene::Dof dof);
/// The joint has a spring or damper of its own beside drives.
inline bool has_spring(const scene::Joint& joint) {
  return joint.stiffness != 0 || joint.damping != 0;
}
/// What of it has no room beside a drive; none: all has.
std::optional<PassiveForce> passive_force(const scene::Joint& joint, scene::Index index,
                                          const JointMap& map);

/// Gives PhysX all drives of a joint, gains and targets.
void write_drives(const scene::Joint& joint, const JointMap& map, double time_step);

}  // namespace tenon::engines::physx
