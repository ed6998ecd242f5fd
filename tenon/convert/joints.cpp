// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Joints of robots turn or slide about any axis; those of UsdPhysics about X, Y or Z of a frame
// in both bodies. So the frame is rotated until one of them is the axis, by exact quaternions where
// that can be. Mimics and actuators are written when all joints have their prims, for they refer to
// them.
#include "tenon/convert/joints.h"

#include <algorithm>
#include <cmath>

#include "tenon/convert/joint_schemas.h"
#include "tenon/math/shortest_turn.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;
using robot::JointKind;

constexpr double kAxisNoise = 1e-12;
constexpr double kNearlyOpposite = 1e-6;

/// Half turns about a coordinate axis have exact quaternions; for an axis along -x, -y or -z the
/// frame is turned by one of them. What tools leave beside a 1 by their rounding does not count.
AxisTurn axis_turn(const Vec3d& axis) {
  constexpr const char* kTokens[] = {"X", "Y", "Z"};
  // About y, z and x: each turns the axis with its number to its opposite.
  const Quatd half_turns[] = {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}};
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::fabs(axis[(i + 1) % 3]) < kAxisNoise && std::fabs(axis[(i + 2) % 3]) < kAxisNoise) {
      return {kTokens[i], axis[i] < 0 ? half_turns[i] : kIdentityRotation};
    }
  }
  const Vec3d x{{1, 0, 0}};
  if (1 + axis[0] < kNearlyOpposite) {  // else nothing but rounding would be left of this
    return {"X", shortest_turn(-x, axis) * half_turns[0]};
  }
  return {"X", shortest_turn(x, axis)};
}

void write_side(LayerBuilder& builder, Path joint, int side, Path body, const Pose& frame) {
  const Token type("PhysicsJoint");
  const std::string end = std::to_string(side);
  if (!body.empty()) {
    builder.set_targets(joint, type, "physics:body" + end, {body});
  }
  builder.set_vector(joint, type, "physics:localPos" + end, without_noise(frame.position));
  builder.set_rotation(joint, type, "physics:localRot" + end, frame.orientation);
}

const char* joint_type(JointKind kind) {
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

namespace {

/// The joint's frame in the child link, axis included.
Pose joint_frame(const robot::Joint& joint) {
  Pose frame = joint.frame;
  if (joint.has_one_axis() || joint.kind == JointKind::Planar) {
    frame.orientation = frame.orientation * axis_turn(joint.axis).rotation;
  }
  return frame;
}

/// What may move: one axis, all rotations, or of a planar joint what is not locked.
void write_dofs(LayerBuilder& builder, Path path, const robot::Joint& joint,
                const ConvertOptions& options) {
  const std::string axis = axis_turn(joint.axis).token;
  if (joint.has_one_axis()) {
    builder.set_value(path, joint_type(joint.kind), "physics:axis", Value(Token(axis)));
    JointPrinter(builder, path, joint, axis, options).print();
  } else if (joint.kind == JointKind::Ball) {
    JointPrinter(builder, path, joint, axis, options).print_passive();
  } else if (joint.kind == JointKind::Planar) {
    for (const std::string other : {"X", "Y", "Z"}) {
      // A lower limit above the upper one locks (UsdPhysics).
      const Token api("PhysicsLimitAPI:" + ((other == axis ? "trans" : "rot") + other));
      const std::string prefix = "limit:" + api.str().substr(16) + ":physics:";
      builder.apply(path, api);
      builder.set_number(path, api, prefix + "high", -1);
      builder.set_number(path, api, prefix + "low", 1);
    }
  }
}

/// Whether a joint is one on the stage; if not, that is reported.
bool has_prim(const Source& source, const LinkPrims& links, const robot::Joint& joint,
              RobotLayer& layer) {
  const LinkPrim& child = links[joint.child];
  if (child.role == LinkRole::Frame) {
    layer.report(joint.place, Severity::Info, "convert.frame",
                 "the link \"" + source.model.links[joint.child].name +
                     "\" has no mass: it is a frame of \"" + source.model.links[child.host].name +
                     "\", without a body and a joint",
                 "");
    return false;
  }
  if (joint.kind == JointKind::Floating) {
    layer.report(joint.place, Severity::Info, "convert.floating",
                 "the joint \"" + joint.name + "\" lets everything move: no joint is written", "");
    return false;
  }
  return true;
}

Path write_joint(const Source& source, const LinkPrims& links, const robot::Joint& joint,
                 PhysicsScope& physics) {
  if (!has_prim(source, links, joint, physics.layer())) {
    return {};
  }
  const Path path = physics.define(joint.name, joint_type(joint.kind));
  const Pose frame = joint_frame(joint);
  write_side(physics.builder(), path, 0, links.host(joint.parent).path,
             links[joint.parent].in_host * joint.origin * frame);
  write_side(physics.builder(), path, 1, links[joint.child].path, frame);
  write_dofs(physics.builder(), path, joint, source.options);
  return path;
}

/// Neither a joint nor an option says that the root moves.
bool may_stand(const Source& source) {
  const std::vector<robot::Joint>& joints = source.model.joints;
  const bool moves = std::any_of(joints.begin(), joints.end(), [](const auto& joint) {
    return joint.kind == JointKind::Floating || joint.kind == JointKind::Planar;
  });
  return !source.options.float_base && !moves;
}

/// Robots whose root is called so stand somewhere, unless a joint says that they do not.
bool stands_by_its_name(const Source& source) {
  const std::string& name = source.model.links[source.tree.root].name;
  return may_stand(source) && (name == "world" || name == "base_link");
}

/// `place` is that of the root in the world.
Path write_fixed_base(Path root, const Pose& place, PhysicsScope& physics) {
  const Path path = physics.define("fixed_base", "PhysicsFixedJoint");
  write_side(physics.builder(), path, 0, {}, place);
  write_side(physics.builder(), path, 1, root, {});
  return path;
}

/// What a joint follows, or what drives it.
void write_motion(const Source& source, const robot::Joint& joint, Path path, JointPrims& prims,
                  PhysicsScope& physics) {
  JointPrinter printer(physics.builder(), path, joint, axis_turn(joint.axis).token, source.options);
  if (joint.mimic) {
    const robot::Joint& leader = source.model.joints[joint.mimic->leader];
    printer.print_mimic(leader, prims.joints[joint.mimic->leader], axis_turn(leader.axis).token);
  } else if (joint.drive) {
    const std::string& own = joint.drive->name;
    const Token name = physics.free_name(own.empty() ? joint.name + "_actuator" : own);
    printer.print_actuator(physics.path(), name);
    physics.layer().show_name(physics.path().child(name), own);
    prims.actuators.emplace(own, physics.path().child(name));
  }
}

}  // namespace

JointPrims write_joints(const Source& source, const LinkPrims& links, PhysicsScope& physics) {
  const std::vector<robot::Joint>& joints = source.model.joints;
  const LinkPrim& root = links[source.tree.root];
  JointPrims prims;
  const bool by_name = !source.options.fix_base && stands_by_its_name(source);
  if (root.role == LinkRole::Body && (source.options.fix_base || by_name)) {
    prims.base = write_fixed_base(root.path, root.in_robot, physics);
    if (by_name) {
      const robot::Link& link = source.model.links[source.tree.root];
      physics.layer().report(
          link.place, Severity::Info, "convert.fixed-root",
          "the root \"" + link.name + "\" is held in the world, as its name says",
          "convert with --float-base where the robot is free to move");
    }
  }
  if (root.role == LinkRole::Body && !prims.base && may_stand(source)) {
    physics.layer().report(source.model.links[source.tree.root].place, Severity::Info,
                           "convert.free-root",
                           "the root \"" + source.model.links[source.tree.root].name +
                               "\" is free to move: it falls unless something holds it",
                           "convert with --fix-base to hold it in the world");
  }
  for (const robot::Joint& joint : joints) {
    prims.joints.push_back(write_joint(source, links, joint, physics));
  }
  for (Index i = 0; i < joints.size(); ++i) {
    if (!prims.joints[i].empty() && joints[i].has_one_axis()) {
      write_motion(source, joints[i], prims.joints[i], prims, physics);
    }
  }
  return prims;
}

}  // namespace tenon::convert
