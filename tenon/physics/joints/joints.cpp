// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "tenon/physics/joints/joint_frames.h"
#include "tenon/physics/joints/joint_limits.h"
#include "tenon/physics/read_state.h"
#include "tenon/scene/about_bodies.h"

namespace tenon::physics {
namespace {

JointKind kind_of(PrimKind kind) {
  switch (kind) {
    case PrimKind::RevoluteJoint:
      return JointKind::Revolute;
    case PrimKind::PrismaticJoint:
      return JointKind::Prismatic;
    case PrimKind::SphericalJoint:
      return JointKind::Spherical;
    case PrimKind::FixedJoint:
      return JointKind::Fixed;
    case PrimKind::DistanceJoint:
      return JointKind::Distance;
    default:
      return JointKind::D6;
  }
}

/// S-94
Axis joint_axis(const ReadState& state, const stage::Prim& prim) {
  const Token axis = state.values.get<Token>(prim, state.tokens.joint_axis).value_or(Token("X"));
  if (axis == "Y") {
    return Axis::Y;
  }
  if (axis == "Z") {
    return Axis::Z;
  }
  if (!(axis == "X")) {
    state.report(prim, state.tokens.joint_axis, Severity::Error, "joint.axis-unknown",
                 "physics:axis is \"" + axis.str() + "\"; X is used instead", "use X, Y or Z");
  }
  return Axis::X;
}

/// S-93: infinite means never; negative is an error.
double break_limit(const ReadState& state, const stage::Prim& prim, Token name, double unit) {
  const double value = state.values.number(prim, name).value_or(kUnlimited);
  if (value < 0) {
    state.report(prim, name, Severity::Error, "joint.negative-break",
                 name.str() + " is " + text_of_float(value) + "; the joint never breaks",
                 "author a positive value, or leave it out");
    return kUnlimited;
  }
  return value * unit;
}

/// S-88, S-21: a joint needs a body, two different ones, of one scene.
bool sides_fit(const ReadState& state, const stage::Prim& prim, const Joint& joint) {
  if (!joint.body0 && !joint.body1) {
    state.report(prim, Severity::Error, "joint.no-body",
                 "neither side of the joint is a rigid body; the joint is skipped",
                 "name a rigid body in physics:body0 or physics:body1");
    return false;
  }
  if (joint.body0 == joint.body1) {
    state.report(prim, state.tokens.body1, Severity::Error, "joint.same-body",
                 "both sides of the joint are the body " +
                     named(state.scene.bodies[*joint.body0].path, RelatedRole::Body) +
                     "; the joint is skipped",
                 "name two bodies");
    return false;
  }
  if (joint.body0 && joint.body1 &&
      state.scene.bodies[*joint.body0].scene != state.scene.bodies[*joint.body1].scene) {
    state.report(
        prim, Severity::Error, "joint.across-scenes",
        about_bodies(state.scene, joint,
                     "the bodies of the joint belong to different scenes; the joint is skipped"),
        "give both bodies the same physics:simulationOwner");
    return false;
  }
  return true;
}

std::optional<Joint> read_joint(const ReadState& state, const PhysicsPrim& found) {
  const std::optional<JointSide> side0 = read_joint_side(state, found, 0);
  const std::optional<JointSide> side1 = read_joint_side(state, found, 1);
  if (!side0 || !side1) {
    return std::nullopt;
  }
  Joint joint;
  joint.path = found.path;
  joint.kind = kind_of(found.roles.kind);
  joint.body0 = side0->body;
  joint.body1 = side1->body;
  joint.target0 = side0->target;
  joint.target1 = side1->target;
  joint.frame0 = side0->frame;
  joint.frame1 = side1->frame;
  if (!sides_fit(state, found.prim, joint)) {
    return std::nullopt;
  }
  const AttributeValues& values = state.values;
  joint.enabled = values.flag(found.prim, state.tokens.joint_enabled, true);
  joint.collision_enabled = values.flag(found.prim, state.tokens.collision_enabled, false);
  joint.exclude_from_articulation = values.flag(found.prim, state.tokens.exclude, false);
  const double per_time = state.units.rate * state.units.rate;
  joint.break_force =
      break_limit(state, found.prim, state.tokens.break_force, state.units.force() * per_time);
  joint.break_torque =
      break_limit(state, found.prim, state.tokens.break_torque, state.units.torque() * per_time);
  const bool has_axis = joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic ||
                        joint.kind == JointKind::Spherical;
  if (has_axis) {
    joint.axis = joint_axis(state, found.prim);
  }
  read_joint_limits(state, found, joint);
  return joint;
}

}  // namespace

void read_joints(ReadState& state) {
  state.joint_of_prim.assign(state.walk.prims.size(), kNone);
  const auto prims =
      sorted_prims(state.walk, [](const PhysicsPrim& p) { return is_joint(p.roles.kind); });
  state.scene.joints.reserve(prims.size());
  for (const std::uint32_t i : prims) {
    std::optional<Joint> joint = read_joint(state, state.walk.prims[i]);
    if (joint) {
      state.joint_of_prim[i] = static_cast<std::uint32_t>(state.scene.joints.size());
      state.joint_prims.push_back(i);
      state.scene.joints.push_back(*std::move(joint));
    }
  }
}

}  // namespace tenon::physics
