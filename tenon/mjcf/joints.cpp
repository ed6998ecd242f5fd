// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/joints.h"

#include <algorithm>
#include <cmath>

#include "tenon/engines/mujoco/model.h"
#include "tenon/mjcf/softness.h"

namespace tenon::mjcf {

using engines::mujoco::read_vector;
using robot::JointKind;

namespace {

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

/// Axis, limits, rest position and effort of a joint with one axis.
void take_axis(MjcfSource& source, int number, robot::Joint& joint) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(number);
  const auto coordinate = static_cast<std::size_t>(model.jnt_qposadr[at]);
  joint.axis = read_vector(model.jnt_axis + 3 * at);
  const double reference = model.qpos0[coordinate];
  if (model.jnt_limited[at] != 0) {
    joint.limit =
        robot::Limit{model.jnt_range[2 * at] - reference, model.jnt_range[2 * at + 1] - reference};
  }
  if (reference != 0) {
    source.report(Severity::Warning, "mjcf.reference",
                  "the coordinate of joint \"" + joint.name + "\" counts from its ref");
  }
  joint.spring_reference = model.qpos_spring[coordinate] - reference;
  if (model.jnt_actfrclimited[at] != 0) {
    joint.effort_limit = std::max(std::fabs(model.jnt_actfrcrange[2 * at]),
                                  std::fabs(model.jnt_actfrcrange[2 * at + 1]));
  }
}

}  // namespace

robot::Joint read_joint(MjcfSource& source, int number) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(number);
  const auto dof = static_cast<std::size_t>(model.jnt_dofadr[at]);
  const bool limited = model.jnt_limited[at] != 0;
  robot::Joint joint;
  joint.name = source.name(mjOBJ_JOINT, number, "joint");
  joint.kind = kind_of(model.jnt_type[at], limited);
  if (joint.kind == JointKind::Floating) {
    return joint;
  }
  joint.frame.position = read_vector(model.jnt_pos + 3 * at);
  joint.damping = model.dof_damping[dof];
  joint.friction = model.dof_frictionloss[dof];
  joint.armature = model.dof_armature[dof];
  joint.stiffness = model.jnt_stiffness[at];
  joint.mujoco = softness_of(model, number);
  if (model.jnt_margin[at] != 0) {
    source.left_out("the margin of the limit of joint \"" + joint.name + "\" is skipped");
  }
  if (model.jnt_actgravcomp[at] != 0) {
    source.left_out("the compensation of gravity by actuators of joint \"" + joint.name +
                    "\" is skipped");
  }
  if (joint.kind == JointKind::Ball) {
    if (limited) {
      source.left_out("the limit of the ball \"" + joint.name +
                      "\" is skipped: it bounds the total rotation");
    }
    return joint;
  }
  take_axis(source, number, joint);
  return joint;
}

}  // namespace tenon::mjcf
