// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What vendors' APIs say about joints: armature, friction, damping, velocity limits. Where several
// speak, PhysX's axis API counts before Newton's, that before MuJoCo's and PhysX's older joint API.
#include <cmath>

#include "tenon/physics/joints/joint_checks.h"
#include "tenon/physics/joints/joint_limits.h"
#include "tenon/physics/read_state.h"
#include "tenon/physics/vendors/mujoco_contacts.h"
#include "tenon/scene/joint_freedom.h"

namespace tenon::physics {
namespace {

struct SettingTokens {
  Token newton_armature{"newton:armature"};
  Token newton_friction{"newton:friction"};
  Token newton_damping{"newton:damping"};
  Token newton_velocity{"newton:velocityLimit"};
  Token mjc_armature{"mjc:armature"};
  Token mjc_friction{"mjc:frictionloss"};
  Token mjc_damping{"mjc:damping"};
  Token mjc_stiffness{"mjc:stiffness"};
  Token mjc_spring_reference{"mjc:springref"};
  Token mjc_reference{"mjc:ref"};
  Token physx_armature{"physxJoint:armature"};
  Token physx_friction{"physxJoint:jointFriction"};
  Token physx_velocity{"physxJoint:maxJointVelocity"};
};

const SettingTokens& setting_tokens() {
  static const SettingTokens tokens;
  return tokens;
}

/// Factors from the stage's units to SI for the joint's one kind of motion.
struct SettingUnits {
  double armature = 1;
  double force = 1;
  double per_velocity = 1;  ///< of damping per degree/s or length/s
  double per_radian = 1;    ///< of damping and stiffness per radian or length
  double velocity = 1;
};

SettingUnits setting_units(const Units& units, bool angular) {
  SettingUnits result;
  result.armature = angular ? units.inertia() : units.mass;
  result.force = angular ? units.torque() : units.force();
  result.per_radian = angular ? units.torque() : units.mass;
  result.per_velocity = angular ? units.torque() / kRadians : units.mass;
  result.velocity = angular ? kRadians : units.length;
  return result;
}

class SettingReader {
 public:
  SettingReader(ReadState& state, Index joint)
      : state_(state),
        joint_(state.scene.joints[joint]),
        found_(state.prim_of_joint(joint)),
        angular_(joint_.kind != JointKind::Prismatic && joint_.kind != JointKind::Distance),
        units_(setting_units(state.units, angular_)) {}

  // Weakest first: what comes later overwrites.
  void run() {
    const SettingTokens& t = setting_tokens();
    const Roles& roles = found_.roles;
    if (roles.has(Api::PhysxJoint)) {
      take(t.physx_armature, units_.armature, joint_.armature);
      take(t.physx_velocity, units_.velocity, joint_.velocity_limit);
      if (number(t.physx_friction).value_or(0) != 0) {
        state_.not_read(found_.prim, t.physx_friction.str(),
                        "a friction coefficient of the older PhysX solver has no counterpart");
      }
    }
    if (roles.has(Api::MjcJoint)) {
      read_mujoco();
    }
    if (roles.has(Api::MjcEqualityConnect) || roles.has(Api::MjcEqualityWeld)) {
      joint_.parts.mujoco_loop = read_mujoco_loop(state_, found_);
    }
    if (roles.has(Api::NewtonJoint) || roles.has(Api::MjcJoint)) {
      take(t.newton_armature, units_.armature, joint_.armature);
      take(t.newton_friction, units_.force, joint_.friction);
      take(t.newton_damping, units_.per_velocity, joint_.damping);
      take(t.newton_velocity, units_.velocity, joint_.velocity_limit);
    }
    if (roles.has(Api::PhysxJointAxis)) {
      read_physx_axis();
    }
    if (roles.has(Api::JointState)) {
      read_state();
    }
  }

 private:
  std::optional<double> number(Token name) const {
    return state_.values.authored_number(found_.prim, name);
  }

  void take(Token name, double unit, double& value) const {
    const std::optional<double> authored = number(name);
    if (!authored) {
      return;
    }
    if (*authored < 0) {
      state_.report(found_.prim, name, Severity::Error, "joint.negative-setting",
                    name.str() + " is negative; it is treated as unauthored",
                    "author a value that is not negative");
      return;
    }
    value = *authored * unit;
  }

  void read_mujoco() {
    const SettingTokens& t = setting_tokens();
    take(t.mjc_armature, units_.armature, joint_.armature);
    take(t.mjc_friction, units_.force, joint_.friction);
    take(t.mjc_damping, units_.per_radian, joint_.damping);
    joint_.parts.mujoco = read_mujoco_softness(state_, found_);
    take(t.mjc_stiffness, units_.per_radian, joint_.stiffness);
    if (const std::optional<double> rest = number(t.mjc_spring_reference)) {
      joint_.spring_reference = *rest * (angular_ ? kRadians : state_.units.length);
    }
    if (number(t.mjc_reference).value_or(0) != 0) {
      state_.not_read(found_.prim, t.mjc_reference.str(),
                      "the coordinate of a joint is 0 where its frames meet");
    }
  }

  /// The instance that names the joint's own axis.
  bool is_own(Token instance) const {
    if (joint_.kind == JointKind::Revolute || joint_.kind == JointKind::Prismatic) {
      return instance == (angular_ ? "angular" : "linear") ||
             dof_of(instance.view()) == joint_.dof();
    }
    return false;
  }

  void read_physx_axis() {
    for (const Token& instance : found_.prim.api_instances("PhysxJointAxisAPI")) {
      const std::string prefix = "physxJointAxis:" + instance.str() + ":";
      if (!is_own(instance)) {
        state_.not_read(found_.prim, "PhysxJointAxisAPI:" + instance.str(),
                        "only the own axis of revolute and prismatic joints is read");
        continue;
      }
      take(prefix + "armature", units_.armature, joint_.armature);
      take(prefix + "maxJointVelocity", units_.velocity, joint_.velocity_limit);
      take(prefix + "dynamicFrictionEffort", units_.force, joint_.friction);
      take(prefix + "viscousFrictionCoefficient", units_.per_velocity, joint_.damping);
      const double at_rest = number(prefix + "staticFrictionEffort").value_or(0);
      if (at_rest * units_.force > joint_.friction) {
        state_.not_read(found_.prim, prefix + "staticFrictionEffort",
                        "friction at rest is that of motion");
      }
    }
  }

  void read_state() {
    for (const Token& instance : found_.prim.api_instances("PhysicsJointStateAPI")) {
      const std::string prefix = "state:" + instance.str() + ":physics:";
      const std::optional<double> position = number(prefix + "position");
      const std::optional<double> velocity = number(prefix + "velocity");
      if (!is_own(instance)) {
        if (position.value_or(0) != 0 || velocity.value_or(0) != 0) {
          state_.not_read(found_.prim, "PhysicsJointStateAPI:" + instance.str(),
                          "only the own axis of revolute and prismatic joints is read");
        }
        continue;
      }
      const double unit = angular_ ? kRadians : state_.units.length;
      if (position) {
        joint_.initial_position = *position * unit;
      }
      if (velocity) {
        joint_.initial_velocity = *velocity * unit;
      }
    }
  }

  ReadState& state_;
  Joint& joint_;
  const PhysicsPrim& found_;
  bool angular_;
  SettingUnits units_;
};

}  // namespace

void read_joint_settings(ReadState& state) {
  constexpr Api kApis[] = {Api::PhysxJoint,      Api::MjcJoint,    Api::MjcEqualityConnect,
                           Api::MjcEqualityWeld, Api::NewtonJoint, Api::PhysxJointAxis,
                           Api::JointState};
  for (Index i = 0; i < state.scene.joints.size(); ++i) {
    const Roles& roles = state.prim_of_joint(i).roles;
    for (const Api api : kApis) {
      if (roles.has(api)) {
        SettingReader(state, i).run();
        break;
      }
    }
    check_joint_start(state, state.prim_of_joint(i).prim, state.scene.joints[i]);
  }
}

}  // namespace tenon::physics
