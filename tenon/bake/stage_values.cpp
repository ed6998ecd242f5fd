// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/bake/stage_values.h"

#include "tenon/math/angle.h"

namespace tenon::bake {
namespace {

/// Which coordinates of the joint are angles, in Dof order of its free axes.
std::vector<bool> angular_axes(const scene::Joint& joint) {
  using scene::Dof;
  using scene::JointKind;
  switch (joint.kind) {
    case JointKind::Revolute:
      return {true};
    case JointKind::Spherical:
      return {true, true, true};
    case JointKind::Prismatic:
    case JointKind::Fixed:
    case JointKind::Distance:
      return {false};
    case JointKind::D6:
      break;
  }
  std::vector<bool> axes;
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ, Dof::RotX, Dof::RotY, Dof::RotZ}) {
    bool free = true;
    for (const scene::Limit& limit : joint.limits) {
      free = free && !(limit.dof == dof && (limit.locked() || limit.lower == limit.upper));
    }
    if (free) {
      axes.push_back(scene::is_angular(dof));
    }
  }
  return axes;
}

}  // namespace

engines::BodyState in_stage_units(const engines::BodyState& state,
                                  const scene::PhysicsScene& scene) {
  engines::BodyState result = state;
  result.pose.position *= 1 / scene.meters_per_unit;
  result.linear_velocity *= 1 / scene.meters_per_unit;
  result.angular_velocity *= kDegreesPerRadian;
  return result;
}

engines::JointState in_stage_units(const engines::JointState& state, const scene::Joint& joint,
                                   const scene::PhysicsScene& scene) {
  engines::JointState result = state;
  const std::vector<bool> angular = angular_axes(joint);
  for (std::size_t i = 0; i < result.position.size(); ++i) {
    const double factor =
        i < angular.size() && angular[i] ? kDegreesPerRadian : 1 / scene.meters_per_unit;
    result.position[i] *= factor;
    if (i < result.velocity.size()) {
      result.velocity[i] *= factor;
    }
  }
  return result;
}

}  // namespace tenon::bake
