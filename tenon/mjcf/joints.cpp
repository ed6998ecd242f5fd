// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/model.h"
#include "tenon/math/inertia.h"
#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {

using engines::mujoco::read_vector;
using robot::Index;
using robot::JointKind;

namespace {

constexpr double kBetween = 1e-6;  // of the body's mass, for links between joints of one body

JointKind kind_of(int type, bool limited) {
  switch (type) {
    case mjJNT_FREE:
      return JointKind::Floating;
    case mjJNT_BALL:
      return JointKind::Ball;
    case mjJNT_SLIDE:
      return JointKind::Prismatic;
    default:
      return limited ? JointKind::Revolute : JointKind::Continuous;
  }
}

}  // namespace

/// Coordinates count from `ref`, where the bodies stand as written.
robot::Joint MjcfReader::joint_of(int number) {
  const auto at = static_cast<std::size_t>(number);
  const auto dof = static_cast<std::size_t>(model_.jnt_dofadr[at]);
  const auto coordinate = static_cast<std::size_t>(model_.jnt_qposadr[at]);
  const bool limited = model_.jnt_limited[at] != 0;
  robot::Joint joint;
  joint.name = unique_name(mjOBJ_JOINT, number, "joint");
  joint.kind = kind_of(model_.jnt_type[at], limited);
  if (joint.kind == JointKind::Floating) {
    return joint;
  }
  joint.frame.position = read_vector(model_.jnt_pos + 3 * at);
  joint.damping = model_.dof_damping[dof];
  joint.friction = model_.dof_frictionloss[dof];
  joint.armature = model_.dof_armature[dof];
  joint.stiffness = model_.jnt_stiffness[at];
  joint.mujoco = softness_of(number);
  if (model_.jnt_margin[at] != 0) {
    report("mjcf.left-out", "the margin of the limit of joint \"" + joint.name + "\" is left out");
  }
  if (model_.jnt_actgravcomp[at] != 0) {
    report("mjcf.left-out",
           "the compensation of gravity by actuators of joint \"" + joint.name + "\" is left out");
  }
  if (joint.kind == JointKind::Ball) {
    if (limited) {
      report("mjcf.left-out",
             "the limit of the ball \"" + joint.name + "\" is left out: it bounds the whole turn");
    }
    return joint;
  }
  joint.axis = read_vector(model_.jnt_axis + 3 * at);
  const double reference = model_.qpos0[coordinate];
  if (limited) {
    joint.limit = robot::Limit{model_.jnt_range[2 * at] - reference,
                               model_.jnt_range[2 * at + 1] - reference};
  }
  if (reference != 0) {
    report("mjcf.reference", "the coordinate of joint \"" + joint.name + "\" counts from its ref");
  }
  joint.spring_reference = model_.qpos_spring[coordinate] - reference;
  if (model_.jnt_actfrclimited[at] != 0) {
    joint.effort_limit = std::max(std::fabs(model_.jnt_actfrcrange[2 * at]),
                                  std::fabs(model_.jnt_actfrcrange[2 * at + 1]));
  }
  return joint;
}

void MjcfReader::add_joints(int body, Index parent, Index link, const Pose& origin) {
  const auto at = static_cast<std::size_t>(body);
  const int count = model_.body_jntnum[at];
  const std::string name = robot_.links[link].name;
  if (count == 0) {
    robot::Joint joint;
    joint.name = name + "_fixed";
    joint.parent = parent;
    joint.child = link;
    joint.origin = origin;
    robot_.joints.push_back(std::move(joint));
    return;
  }
  if (count > 1) {
    report("mjcf.several-joints",
           "the body \"" + name + "\" has " + std::to_string(count) +
               " joints: links with a millionth of its mass are put between",
           Severity::Info);
  }
  Index above = parent;
  for (int i = 0; i < count; ++i) {
    const int number = model_.body_jntadr[at] + i;
    robot::Joint joint = joint_of(number);
    joint.parent = above;
    joint.origin = i == 0 ? origin : Pose{};
    joint.child = link;
    if (i + 1 < count) {
      robot::Link between;
      between.name = name + "_" + joint.name;
      if (robot_.links[link].inertial) {
        robot::Inertial& inertial = between.inertial.emplace(*robot_.links[link].inertial);
        inertial.mass *= kBetween;
        for (std::size_t k = 0; k < 3; ++k) {
          inertial.inertia[k][k] *= kBetween;
        }
      }
      joint.child = static_cast<Index>(robot_.links.size());
      robot_.links.push_back(std::move(between));
    }
    above = joint.child;
    joint_of_joint_[static_cast<std::size_t>(number)] = static_cast<Index>(robot_.joints.size());
    robot_.joints.push_back(std::move(joint));
  }
}

/// force = gain ctrl + b0 + b1 l + b2 l', l = gear q: about a joint a drive
/// (physics/actuators.cpp).
void MjcfReader::read_actuator(int number) {
  const auto at = static_cast<std::size_t>(number);
  const std::string name = unique_name(mjOBJ_ACTUATOR, number, "actuator");
  const bool on_joint = model_.actuator_trntype[at] == mjTRN_JOINT;
  const bool spring = model_.actuator_gaintype[at] == mjGAIN_FIXED &&
                      model_.actuator_biastype[at] == mjBIAS_AFFINE &&
                      model_.actuator_dyntype[at] == mjDYN_NONE;
  if (!on_joint || !spring) {
    if (!read_motor(number)) {
      report("mjcf.left-out",
             "the actuator \"" + name +
                 "\" is about no joint of one axis, ball or tendon, or of a kind of its own; "
                 "it is left out",
             Severity::Warning, line_of(mjOBJ_ACTUATOR, number));
    }
    return;
  }
  const auto target = static_cast<std::size_t>(model_.actuator_trnid[2 * at]);
  robot::Joint& joint = robot_.joints[joint_of_joint_[target]];
  if (!joint.has_one_axis() || joint.drive) {
    report("mjcf.left-out",
           "the actuator \"" + name + "\" is " +
               (joint.drive ? "the second one of its joint" : "about a ball") + "; it is left out",
           Severity::Warning, line_of(mjOBJ_ACTUATOR, number));
    return;
  }
  const double* bias = model_.actuator_biasprm + mjNBIAS * at;
  const double gear = model_.actuator_gear[6 * at];
  robot::Drive& drive = joint.drive.emplace();
  drive.stiffness = 0 - bias[1] * gear * gear;
  drive.damping = 0 - bias[2] * gear * gear;
  drive_of_actuator_[at] = joint_of_joint_[target];
  const auto input = static_cast<std::size_t>(model_.actuator_ctrladr[at]);
  if (model_.actuator_ctrllimited[input] != 0) {
    const double* range = model_.actuator_ctrlrange + 2 * input;
    const double a = control_of(number, range[0]);
    const double b = control_of(number, range[1]);
    drive.control_range = {std::min(a, b), std::max(a, b)};
  }
  if (bias[1] != 0 && gear != 0) {
    const auto coordinate = static_cast<std::size_t>(model_.jnt_qposadr[target]);
    drive.target = -bias[0] / (bias[1] * gear) - model_.qpos0[coordinate];
  }
  if (model_.actuator_forcelimited[at] != 0) {
    const double* range = model_.actuator_forcerange + 2 * at;
    joint.effort_limit = std::min(
        joint.effort_limit, std::fabs(gear) * std::max(std::fabs(range[0]), std::fabs(range[1])));
  }
}

/// What is to be asked of a drive for the effort that `control` makes of its actuator.
double MjcfReader::control_of(int actuator, double control) const {
  const auto at = static_cast<std::size_t>(actuator);
  const double gain = robot_.joints[*drive_of_actuator_[at]].drive->control_gain();
  const double effort =
      model_.actuator_gear[6 * at] * model_.actuator_gainprm[mjNGAIN * at] * control;
  return gain == 0 ? 0 : effort / gain;
}

void MjcfReader::read_actuators() {
  drive_of_actuator_.resize(static_cast<std::size_t>(model_.nactuator));
  for (int i = 0; i < model_.nactuator; ++i) {
    read_actuator(i);
  }
}

/// Joint equalities: q1 - ref1 = a0 + a1 (q2 - ref2) + ...
void MjcfReader::read_equalities() {
  for (int i = 0; i < model_.neq; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::string name = unique_name(mjOBJ_EQUALITY, i, "equality");
    if (model_.eq_active0[at] == 0) {
      report("mjcf.left-out", "the equality \"" + name + "\" is off; it is left out",
             Severity::Warning, line_of(mjOBJ_EQUALITY, i));
      continue;
    }
    if (read_loop(i)) {
      continue;
    }
    if (model_.eq_type[at] != mjEQ_JOINT || model_.eq_obj2id[at] < 0) {
      report("mjcf.left-out",
             "the equality \"" + name +
                 "\" is neither a law of two joints nor holds two bodies; it is left out",
             Severity::Error, line_of(mjOBJ_EQUALITY, i));
      continue;
    }
    const auto follower = static_cast<std::size_t>(model_.eq_obj1id[at]);
    const auto leader = static_cast<std::size_t>(model_.eq_obj2id[at]);
    const double* data = model_.eq_data + mjNEQDATA * at;
    robot::Joint& joint = robot_.joints[joint_of_joint_[follower]];
    joint.mimic =
        robot::Mimic{joint_of_joint_[leader], data[1], data[0], {data[2], data[3], data[4]}, {}};
  }
}

}  // namespace tenon::mjcf
