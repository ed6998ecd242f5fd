// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/start_coordinate.h"

#include <cmath>

namespace tenon::scene {
namespace {

Pose in_world(const PhysicsScene& scene, const std::optional<Index>& body, const Pose& frame) {
  return body ? scene.bodies[*body].pose * frame : frame;
}

}  // namespace

Pose relative_frames(const PhysicsScene& scene, const Joint& joint) {
  return inverse(in_world(scene, joint.body0, joint.frame0)) *
         in_world(scene, joint.body1, joint.frame1);
}

double coordinate_from_poses(const PhysicsScene& scene, const Joint& joint) {
  const Pose relative = relative_frames(scene, joint);
  const auto along = static_cast<std::size_t>(joint.axis);
  if (joint.kind == JointKind::Prismatic) {
    return relative.position[along];
  }
  const Quatd& q = relative.orientation;
  const Vec3d imaginary{{q.x, q.y, q.z}};
  constexpr double kTurn = 6.2831853071795865;
  return std::remainder(2 * std::atan2(imaginary[along], q.w), kTurn);
}

double start_coordinate(const PhysicsScene& scene, const Joint& joint) {
  return joint.initial_position.value_or(coordinate_from_poses(scene, joint));
}

}  // namespace tenon::scene
