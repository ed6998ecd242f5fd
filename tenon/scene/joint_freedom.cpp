// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/joint_freedom.h"

#include <cmath>

#include "tenon/scene/fields/enum_names.h"

namespace tenon::scene {
namespace {

constexpr double kSameAngle = 1e-9;  // of two cone angles that are one [rad]

}  // namespace

bool has_one_dof(const Joint& joint) {
  return joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic ||
         joint.kind == JointKind::Distance;
}

std::optional<Dof> dof_of(std::string_view token) { return named<Dof>(token); }

Limit limit_of(const Joint& joint, Dof dof) {
  if (has_one_dof(joint) && joint.dof() == dof) {
    return {dof, joint.lower, joint.upper};
  }
  for (const Limit& limit : joint.limits) {
    if (limit.dof == dof) {
      return limit;
    }
  }
  return {dof, -kUnlimited, kUnlimited};
}

bool is_locked(const Joint& joint, Dof dof) {
  const Limit limit = limit_of(joint, dof);
  if (limit.locked() || limit.lower == limit.upper) {
    return true;
  }
  switch (joint.kind) {
    case JointKind::Revolute:
    case JointKind::Prismatic:
      return joint.dof() != dof;
    case JointKind::Spherical:
      return !is_angular(dof);
    case JointKind::Fixed:
      return true;
    case JointKind::Distance:
    case JointKind::D6:
      return false;
  }
  return false;
}

bool is_reducible(const Joint& joint) {
  if (joint.kind == JointKind::Distance) {
    return false;
  }
  if (joint.kind != JointKind::D6) {
    return true;
  }
  int free = 0;
  for (const Dof dof : {Dof::TransX, Dof::TransY, Dof::TransZ}) {
    free += is_locked(joint, dof) ? 0 : 1;
  }
  return free <= 1;
}

bool is_plain(const Joint& joint) {
  return joint.drives.empty() && joint.mimics.empty() && joint.limits.empty() &&
         joint.armature == 0 && joint.friction == 0 && joint.damping == 0 && joint.stiffness == 0;
}

bool can_break(const Joint& joint) {
  return joint.break_force < kUnlimited || joint.break_torque < kUnlimited;
}

double circular_cone(const Joint& joint) {
  const bool circular = joint.kind == JointKind::Spherical && joint.cone_angle0 < kUnlimited &&
                        std::fabs(joint.cone_angle0 - joint.cone_angle1) < kSameAngle;
  return circular ? joint.cone_angle0 : kUnlimited;
}

bool is_held_by_frames(const Joint& joint) {
  const bool open_cone = joint.cone_angle0 == kUnlimited && joint.cone_angle1 == kUnlimited;
  switch (joint.kind) {
    case JointKind::Fixed:
      return true;
    case JointKind::Spherical:
      return is_plain(joint) && (open_cone || circular_cone(joint) < kUnlimited);
    case JointKind::Revolute:
      return is_plain(joint) && joint.lower == -kUnlimited && joint.upper == kUnlimited;
    case JointKind::Prismatic:
    case JointKind::Distance:
    case JointKind::D6:
      return false;
  }
  return false;
}

Joint fixed_in_place_of(const Joint& joint) {
  Joint fixed;
  fixed.path = joint.path;
  fixed.kind = JointKind::Fixed;
  fixed.body0 = joint.body0;
  fixed.body1 = joint.body1;
  fixed.target0 = joint.target0;
  fixed.target1 = joint.target1;
  fixed.frame0 = joint.frame0;
  fixed.frame1 = joint.frame1;
  fixed.collision_enabled = joint.collision_enabled;
  fixed.exclude_from_articulation = joint.exclude_from_articulation;
  fixed.articulation = joint.articulation;
  return fixed;
}

}  // namespace tenon::scene
