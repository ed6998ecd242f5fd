// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>

#include "tenon/check/subject.h"
#include "tenon/math/angle.h"
#include "tenon/scene/physics_scene.h"
#include "tenon/scene/start_coordinate.h"

namespace tenon::check {

/// Joints that actuators of MuJoCo's and Newton's schemas name.
std::set<Path> actuated_joints(const Subject& subject);

using scene::coordinate_from_poses;
using scene::start_coordinate;

inline bool has_one_axis(const scene::Joint& joint) {
  return joint.kind == scene::JointKind::Revolute || joint.kind == scene::JointKind::Prismatic;
}
/// What a coordinate counts in, in the asset, for one rad or m: degrees, or lengths of the stage.
inline double coordinate_unit(const scene::PhysicsScene& scene, const scene::Joint& joint) {
  return joint.kind == scene::JointKind::Revolute ? kDegreesPerRadian : 1 / scene.meters_per_unit;
}

}  // namespace tenon::check
