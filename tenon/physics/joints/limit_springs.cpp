// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// How bounds of joints give way or rebound, by PhysX's schemas. Stiffness and damping about an axis
// are per radian, unlike those of drives (asked of PhysX by experiment).
#include <algorithm>
#include <cmath>

#include "tenon/physics/joints/joint_limits.h"
#include "tenon/physics/read_state.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::physics {
namespace {

/// "angular" and "linear" name the own axis of joints with one; else the axis' own name counts.
std::optional<Dof> limited_dof(const Joint& joint, Token instance) {
  const std::optional<Dof> named = dof_of(instance.view());
  if (joint.kind == JointKind::Revolute || joint.kind == JointKind::Prismatic) {
    const Token own(joint.kind == JointKind::Revolute ? "angular" : "linear");
    return instance == own || named == joint.dof() ? std::optional(joint.dof()) : std::nullopt;
  }
  if (joint.kind == JointKind::Distance) {
    return named == Dof::Distance ? named : std::nullopt;
  }
  return joint.kind == JointKind::D6 ? named : std::nullopt;
}

class SpringReader {
 public:
  SpringReader(ReadState& state, Index joint)
      : state_(state), joint_(state.scene.joints[joint]), found_(state.prim_of_joint(joint)) {}

  void run() {
    if (found_.roles.has(Api::PhysxLimit)) {
      for (const Token& instance : found_.prim.api_instances("PhysxLimitAPI")) {
        read_limit(instance);
      }
    }
    if (found_.roles.has(Api::PhysxDistanceJoint)) {
      read_distance();
    }
    std::stable_sort(joint_.limit_springs.begin(), joint_.limit_springs.end(),
                     [](const LimitSpring& a, const LimitSpring& b) { return a.dof < b.dof; });
  }

 private:
  double number(Token name) const {
    const double value = state_.values.authored_number(found_.prim, name).value_or(0);
    if (!(value >= 0) || !std::isfinite(value)) {
      state_.report(found_.prim, name, Severity::Error, "joint.negative-setting",
                    name.str() + " is negative or infinite; it is treated as unauthored",
                    "author a finite value that is not negative");
      return 0;
    }
    return value;
  }

  void add(const LimitSpring& spring) {
    const bool says = spring.stiffness > 0 || spring.restitution > 0;
    if (says && std::none_of(joint_.limit_springs.begin(), joint_.limit_springs.end(),
                             [&](const LimitSpring& s) { return s.dof == spring.dof; })) {
      joint_.limit_springs.push_back(spring);
    }
  }

  void read_limit(Token instance) {
    const std::optional<Dof> dof = limited_dof(joint_, instance);
    if (!dof) {
      state_.not_read(found_.prim, "PhysxLimitAPI:" + instance.str(),
                      "the joint has no bounds of that name that could give way");
      return;
    }
    const std::string prefix = "physxLimit:" + instance.str() + ":";
    const bool turns = is_angular(*dof);
    const double gain = turns ? state_.units.torque() : state_.units.mass;
    LimitSpring spring;
    spring.dof = *dof;
    spring.stiffness = number(prefix + "stiffness") * gain;
    spring.damping = number(prefix + "damping") * gain;
    spring.restitution = std::min(1.0, number(prefix + "restitution"));
    spring.bounce_threshold =
        number(prefix + "bounceThreshold") * (turns ? 1 : state_.units.length);
    add(spring);
  }

  void read_distance() {
    const std::string prefix = "physxPhysicsDistanceJoint:";
    if (joint_.kind != JointKind::Distance) {
      state_.not_read(found_.prim, "PhysxPhysicsDistanceJointAPI",
                      "the joint is not a distance joint");
      return;
    }
    if (!state_.values.authored_flag(found_.prim, Token(prefix + "springEnabled"))
             .value_or(false)) {
      return;
    }
    LimitSpring spring;
    spring.dof = Dof::Distance;
    spring.stiffness = number(prefix + "springStiffness") * state_.units.mass;
    spring.damping = number(prefix + "springDamping") * state_.units.mass;
    add(spring);
  }

  ReadState& state_;
  Joint& joint_;
  const PhysicsPrim& found_;
};

}  // namespace

void read_limit_springs(ReadState& state) {
  for (Index i = 0; i < state.scene.joints.size(); ++i) {
    const Roles& roles = state.prim_of_joint(i).roles;
    if (roles.has(Api::PhysxLimit) || roles.has(Api::PhysxDistanceJoint)) {
      SpringReader(state, i).run();
    }
  }
}

}  // namespace tenon::physics
