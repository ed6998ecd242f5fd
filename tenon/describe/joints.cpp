// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A joint of a scene locks and limits any of six directions; one of a robot is of a kind that has
// one axis, a plane, a ball, or nothing held at all. What fits a kind becomes it, with its numbers;
// everything else floats. Numbers that the scene has as floats, or not at all, come from attributes
// that converting a description has left on the prim.
#include "tenon/describe/joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "tenon/math/mimic_law.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::describe {

using robot::JointKind;

namespace {

/// An open end beside a closed one; URDF cannot express infinity [rad or m].
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

/// `axis` is set to that of the kind, in the joint frame.
JointKind kind_of(SceneSource& source, const scene::Joint& joint, Vec3d& axis) {
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
        source.left_out(joint.path, "the ball has a cone");
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
  source.left_out(joint.path, "the joint has several axes: it becomes floating, with limits");
  return JointKind::Floating;
}

void take_numbers(SceneSource& source, const scene::Joint& described, robot::Joint& joint) {
  if (!joint.has_one_axis()) {
    return;
  }
  joint.damping = described.damping;
  joint.friction = described.friction;
  joint.velocity_limit = described.velocity_limit;
  if (std::isfinite(described.lower) || std::isfinite(described.upper)) {
    joint.limit = robot::Limit{std::isfinite(described.lower) ? described.lower : -kFar,
                               std::isfinite(described.upper) ? described.upper : kFar};
  }
  for (const scene::Drive& drive : described.drives) {
    if (drive.stiffness != 0 || drive.damping != 0) {
      source.left_out(described.path, "the drive has gains");
    }
    joint.effort_limit = std::min(joint.effort_limit, drive.max_force);
  }
  if (source.is_sdf()) {
    joint.armature = described.armature;
    joint.stiffness = described.stiffness;
    joint.spring_reference = described.spring_reference;
    return;
  }
  if (described.armature != 0) {
    source.left_out(described.path, "the joint has an armature");
  }
  if (described.stiffness != 0) {
    source.left_out(described.path, "the joint has a spring of its own");
  }
}

/// Numbers of a description that no schema holds; convert_robot keeps them so.
void take_description(const stage::Stage& stage, Path path, robot::Joint& joint) {
  const stage::Prim prim = stage.prim(path);
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

/// `leader`: of the robot, where it has that joint.
void add_mimic(SceneSource& source, const scene::Joint& described, const scene::Mimic& mimic,
               std::optional<robot::Index> leader, robot::Joint& joint) {
  const scene::Joint& leading = source.scene().joints[mimic.leader];
  if (!has_one_dof(described) || !has_one_dof(leading)) {
    source.left_out(described.path, std::string(dof_name(mimic.dof)) + " follows " +
                                        std::string(dof_name(mimic.leader_dof)) + " of <" +
                                        leading.path.str() +
                                        ">: joints of several axes follow none");
    return;
  }
  if (!leader || !joint.has_one_axis() || !mimic_is_linear(mimic)) {
    source.left_out(described.path, "the joint follows another by a law that is not linear");
    return;
  }
  joint.mimic = robot::Mimic{*leader, mimic.multiplier, mimic.offset, {}, {}};
  if (mimic.natural_frequency != 0) {
    source.left_out(described.path, "the joint follows another by a spring");
  }
}

}  // namespace

robot::Joint read_joint(SceneSource& source, const scene::Joint& described) {
  robot::Joint joint;
  joint.name = source.name_of(described.path, "joint");
  Vec3d axis;
  joint.kind = kind_of(source, described, axis);
  if (joint.has_one_axis() || joint.kind == JointKind::Planar) {
    joint.axis = axis;
  }
  take_numbers(source, described, joint);
  take_description(source.stage(), described.path, joint);
  return joint;
}

void add_mimics(SceneSource& source, const std::vector<std::optional<robot::Index>>& joint_of,
                std::vector<robot::Joint>& joints) {
  for (std::size_t i = 0; i < joint_of.size(); ++i) {
    const scene::Joint& described = source.scene().joints[i];
    for (const scene::Mimic& mimic : described.mimics) {
      if (joint_of[i]) {
        add_mimic(source, described, mimic, joint_of[mimic.leader], joints[*joint_of[i]]);
      }
    }
  }
}

}  // namespace tenon::describe
