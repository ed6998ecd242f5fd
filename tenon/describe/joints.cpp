// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/describe/scene_reader.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::describe {

using robot::Index;
using robot::JointKind;

namespace {

/// Stands for an open end beside a closed one; URDF has no word for infinity [rad or m].
constexpr double kFar = 1e9;

Vec3d unit_vector(std::size_t axis) {
  Vec3d v;
  v[axis] = 1;
  return v;
}

/// The normal of the plane in which a joint slides and turns, where it does just that.
std::optional<std::size_t> plane_normal(const scene::Joint& joint) {
  std::array<bool, 6> locked{};
  for (const scene::Limit& limit : joint.limits) {
    const auto dof = static_cast<std::size_t>(limit.dof);
    if (dof >= locked.size() || !limit.locked()) {
      return std::nullopt;
    }
    locked[dof] = true;
  }
  for (std::size_t normal = 0; normal < 3; ++normal) {
    std::array<bool, 6> wanted{false, false, false, true, true, true};
    wanted[normal] = true;
    wanted[3 + normal] = false;
    if (locked == wanted) {
      return normal;
    }
  }
  return std::nullopt;
}

}  // namespace

JointKind SceneReader::kind_of(const scene::Joint& joint, Vec3d& axis) {
  axis = unit_vector(static_cast<std::size_t>(joint.axis));
  const bool limited = std::isfinite(joint.lower) || std::isfinite(joint.upper);
  switch (joint.kind) {
    case scene::JointKind::Revolute:
    case scene::JointKind::Prismatic:
      if (joint.lower > joint.upper) {
        return JointKind::Fixed;  // locked at zero (S-98)
      }
      if (joint.kind == scene::JointKind::Prismatic) {
        return JointKind::Prismatic;
      }
      return limited ? JointKind::Revolute : JointKind::Continuous;
    case scene::JointKind::Fixed:
      return JointKind::Fixed;
    case scene::JointKind::Spherical:
      if (std::isfinite(joint.cone_angle0) || std::isfinite(joint.cone_angle1)) {
        left_out(joint.path, "the ball has a cone");
      }
      return JointKind::Ball;
    case scene::JointKind::Distance:
      break;
    case scene::JointKind::D6:
      if (const auto normal = plane_normal(joint)) {
        axis = unit_vector(*normal);
        return JointKind::Planar;
      }
      break;
  }
  left_out(joint.path, "the joint has several axes: it becomes floating, with limits");
  return JointKind::Floating;
}

void SceneReader::take_numbers(const scene::Joint& source, robot::Joint& joint) {
  if (!joint.has_one_axis()) {
    return;
  }
  joint.damping = source.damping;
  joint.friction = source.friction;
  joint.velocity_limit = source.velocity_limit;
  if (std::isfinite(source.lower) || std::isfinite(source.upper)) {
    joint.limit = robot::Limit{std::isfinite(source.lower) ? source.lower : -kFar,
                               std::isfinite(source.upper) ? source.upper : kFar};
  }
  for (const scene::Drive& drive : source.drives) {
    if (drive.stiffness != 0 || drive.damping != 0) {
      left_out(source.path, "the drive has gains");
    }
    joint.effort_limit = std::min(joint.effort_limit, drive.max_force);
  }
  if (source.armature != 0) {
    left_out(source.path, "the joint has an armature");
  }
  if (source.stiffness != 0) {
    left_out(source.path, "the joint has a spring of its own");
  }
}

/// Numbers of a description that no schema holds; convert_robot keeps them so.
void SceneReader::take_description(const scene::Joint& source, robot::Joint& joint) {
  const stage::Prim prim = stage_.prim(source.path);
  if (!prim || !joint.has_one_axis()) {
    return;
  }
  const auto number = [&](const char* name) {
    const auto value = prim.attribute(Token(name)).get_as<double>();
    return value && std::isfinite(*value) ? value : std::nullopt;
  };
  const auto effort = number("urdf:limit:effort");
  // The drive's counts where somebody has changed it; else the number before it became a float.
  if (effort && (std::isinf(joint.effort_limit) ||
                 static_cast<float>(*effort) == static_cast<float>(joint.effort_limit))) {
    joint.effort_limit = *effort;
  }
  robot::Calibration calibration{number("urdf:calibration:rising"),
                                 number("urdf:calibration:falling")};
  if (calibration.rising || calibration.falling) {
    joint.calibration = calibration;
  }
  robot::Safety safety;
  safety.soft_lower = number("urdf:safety:softLowerLimit");
  safety.soft_upper = number("urdf:safety:softUpperLimit");
  const auto position_gain = number("urdf:safety:kPosition");
  const auto velocity_gain = number("urdf:safety:kVelocity");
  safety.position_gain = position_gain.value_or(0);
  safety.velocity_gain = velocity_gain.value_or(0);
  if (safety.soft_lower || safety.soft_upper || position_gain || velocity_gain) {
    joint.safety = safety;
  }
}

void SceneReader::add_mimics() {
  for (std::size_t i = 0; i < joint_of_.size(); ++i) {
    for (const scene::Mimic& mimic : scene_.joints[i].mimics) {
      if (joint_of_[i] != kNone) {
        add_mimic(scene_.joints[i], mimic, robot_.joints[joint_of_[i]]);
      }
    }
  }
}

void SceneReader::add_mimic(const scene::Joint& source, const scene::Mimic& mimic,
                            robot::Joint& joint) {
  const std::size_t leader = joint_of_[mimic.leader];
  if (!has_one_dof(source) || !has_one_dof(scene_.joints[mimic.leader])) {
    left_out(source.path, std::string(dof_name(mimic.dof)) + " follows " +
                              std::string(dof_name(mimic.leader_dof)) + " of <" +
                              scene_.joints[mimic.leader].path.str() +
                              ">: joints of several axes follow none");
    return;
  }
  if (leader == kNone || !joint.has_one_axis() || mimic.higher != std::array<double, 3>{}) {
    left_out(source.path, "the joint follows another by a law that is not linear");
    return;
  }
  joint.mimic = robot::Mimic{static_cast<Index>(leader), mimic.multiplier, mimic.offset, {}, 0};
  if (mimic.natural_frequency != 0) {
    left_out(source.path, "the joint follows another by a spring");
  }
}

}  // namespace tenon::describe
