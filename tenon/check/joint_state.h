// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/math/angle.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::check {

/// Coordinate of a revolute or prismatic joint as the poses of its bodies have it [rad or m].
double coordinate_from_poses(const scene::PhysicsScene& scene, const scene::Joint& joint);
inline bool has_one_axis(const scene::Joint& joint) {
  return joint.kind == scene::JointKind::Revolute || joint.kind == scene::JointKind::Prismatic;
}
/// What a coordinate counts in, in the asset, for one rad or m: degrees, or lengths of the stage.
inline double coordinate_unit(const scene::PhysicsScene& scene, const scene::Joint& joint) {
  return joint.kind == scene::JointKind::Revolute ? kDegreesPerRadian : 1 / scene.meters_per_unit;
}
/// The authored start, else that of the poses.
double start_coordinate(const scene::PhysicsScene& scene, const scene::Joint& joint);

}  // namespace tenon::check
