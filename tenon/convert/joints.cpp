// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/convert/conversion.h"
#include "tenon/convert/joint_schemas.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;
using robot::JointKind;

/// Half turns about a coordinate axis have exact quaternions; for an axis along -x, -y or -z the
/// frame is turned by one of them.
AxisTurn axis_turn(const Vec3d& axis) {
  constexpr const char* kTokens[] = {"X", "Y", "Z"};
  // About y, z and x: each turns the axis with its number to its opposite.
  const Quatd half_turns[] = {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    if (axis[(i + 1) % 3] == 0 && axis[(i + 2) % 3] == 0) {
      return {kTokens[i], axis[i] < 0 ? half_turns[i] : kIdentityRotation};
    }
  }
  // The shortest turn of x to the axis.
  const Vec3d x{{1, 0, 0}};
  const Vec3d normal = cross(x, axis);
  return {"X", normalized(Quatd{normal[0], normal[1], normal[2], 1 + dot(x, axis)})};
}

Path Conversion::define_joint(const std::string& wanted, const char* type) {
  const Token name = joint_names_.make(wanted);
  const Path path = builder_.define(joints_scope_, name, type);
  name_prim(path, name, wanted);
  return path;
}

void Conversion::write_side(Path joint, int side, Path body, const Pose& frame) {
  const Token type("PhysicsJoint");
  const std::string end = std::to_string(side);
  if (!body.empty()) {
    builder_.set_targets(joint, type, "physics:body" + end, {body});
  }
  builder_.set_vector(joint, type, "physics:localPos" + end, frame.position);
  builder_.set_rotation(joint, type, "physics:localRot" + end, frame.orientation);
}

namespace {

const char* type_of(JointKind kind) {
  switch (kind) {
    case JointKind::Fixed:
      return "PhysicsFixedJoint";
    case JointKind::Revolute:
    case JointKind::Continuous:
      return "PhysicsRevoluteJoint";
    case JointKind::Prismatic:
      return "PhysicsPrismaticJoint";
    case JointKind::Ball:
      return "PhysicsSphericalJoint";
    case JointKind::Planar:
    case JointKind::Floating:
      break;
  }
  return "PhysicsJoint";
}

}  // namespace

/// The joint's frame in the child link, axis included.
Pose Conversion::joint_frame(const robot::Joint& joint) const {
  Pose frame = joint.frame;
  if (joint.has_one_axis() || joint.kind == JointKind::Planar) {
    frame.orientation = frame.orientation * axis_turn(joint.axis).rotation;
  }
  return frame;
}

/// What may move: one axis, all rotations, or of a planar joint what is not locked.
void Conversion::write_dofs(Path path, const robot::Joint& joint) {
  const std::string axis = axis_turn(joint.axis).token;
  if (joint.has_one_axis()) {
    builder_.set_value(path, type_of(joint.kind), "physics:axis", Value(Token(axis)));
    JointPrinter(builder_, path, joint, axis, options_.schema).print();
  } else if (joint.kind == JointKind::Ball) {
    JointPrinter(builder_, path, joint, axis, options_.schema).print_passive();
  } else if (joint.kind == JointKind::Planar) {
    for (const std::string other : {"X", "Y", "Z"}) {
      // A lower limit above the upper one locks (UsdPhysics).
      const Token api("PhysicsLimitAPI:" + ((other == axis ? "trans" : "rot") + other));
      const std::string prefix = "limit:" + api.str().substr(16) + ":physics:";
      builder_.apply(path, api);
      builder_.set_number(path, api, prefix + "high", -1);
      builder_.set_number(path, api, prefix + "low", 1);
    }
  }
}

Path Conversion::write_joint(const robot::Joint& joint) {
  const LinkPrim& child = links_[joint.child];
  if (child.role == LinkRole::Frame) {
    report(joint.place, Severity::Info, "convert.frame",
           "the link \"" + model_.links[joint.child].name + "\" has no mass: it is a frame of \"" +
               model_.links[child.host].name + "\", without a body and a joint",
           "");
    return {};
  }
  if (joint.kind == JointKind::Floating) {
    report(joint.place, Severity::Info, "convert.floating",
           "the joint \"" + joint.name + "\" lets everything move: no joint is written", "");
    return {};
  }
  const Path path = define_joint(joint.name, type_of(joint.kind));
  const LinkPrim& parent = links_[joint.parent];
  const Pose frame = joint_frame(joint);
  write_side(path, 0, links_[parent.host].path, parent.in_host * joint.origin * frame);
  write_side(path, 1, child.path, frame);
  write_dofs(path, joint);
  return path;
}

Path Conversion::write_fixed_base() {
  const Path path = define_joint("fixed_base", "PhysicsFixedJoint");
  write_side(path, 0, {}, {});
  write_side(path, 1, links_[tree_.root].path, {});
  return path;
}

void Conversion::write_joints() {
  joints_.resize(model_.joints.size());
  if (options_.fix_base && links_[tree_.root].role == LinkRole::Body) {
    base_joint_ = write_fixed_base();
  }
  for (Index i = 0; i < model_.joints.size(); ++i) {
    joints_[i] = write_joint(model_.joints[i]);
  }
  for (Index i = 0; i < model_.joints.size(); ++i) {
    const robot::Joint& joint = model_.joints[i];
    if (joints_[i].empty() || !joint.has_one_axis()) {
      continue;
    }
    JointPrinter printer(builder_, joints_[i], joint, axis_turn(joint.axis).token, options_.schema);
    if (joint.mimic) {
      const robot::Joint& leader = model_.joints[joint.mimic->leader];
      printer.print_mimic(leader, joints_[joint.mimic->leader], axis_turn(leader.axis).token);
    }
    if (joint.drive && !joint.mimic) {
      printer.print_actuator(joints_scope_, joint_names_.make(joint.name + "_actuator"));
    }
  }
}

}  // namespace tenon::convert
