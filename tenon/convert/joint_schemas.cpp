// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each number is written by every schema of the wanted generation that can hold it, in that
// schema's unit. NewtonJointAPI, PhysxJointAxisAPI and MjcJointAPI are applied only where they have
// a number to hold. PhysX's gearing and offset have the opposite sign of Newton's coefficients.
// Powers of a mimic above the first have no place in NewtonMimicAPI and are written by MuJoCo's
// schema beside it. A follower gets no actuator, and a drive without gains for its limit of effort
// alone, as Isaac Sim's importer gives it one.
#include "tenon/convert/joint_schemas.h"

#include <cmath>

#include "tenon/convert/prepare_joints.h"
#include "tenon/math/mimic_law.h"

namespace tenon::convert {

using layer::Value;

namespace {

/// The softness of the tutorial's mimics: natural frequency [rad/s], share of critical damping.
constexpr double kTutorialFrequency = 25;
constexpr double kTutorialDampingRatio = 0.005;

}  // namespace

void JointPrinter::print() {
  print_limits();
  print_drive();
  print_state(start_of(joint_, nullptr, start_));
  if (current()) {
    print_newton();
    print_physx_axis();
  }
  if (legacy()) {
    print_physx_joint();
  }
  print_mujoco();
  print_description();
  if (tutorial_) {
    print_tutorial();
  }
}

void JointPrinter::print_passive() {
  if (current()) {
    print_newton();
  }
  print_mujoco();
}

void JointPrinter::print_limits() {
  if (!joint_.limit) {
    return;
  }
  const Token type(angular() ? "PhysicsRevoluteJoint" : "PhysicsPrismaticJoint");
  builder_.set_number(path_, type, "physics:lowerLimit", position(joint_.limit->lower));
  builder_.set_number(path_, type, "physics:upperLimit", position(joint_.limit->upper));
}

/// A joint gets a drive where there are gains or a limit of effort. What follows another joint is
/// not driven: its drive says the effort.
void JointPrinter::print_drive() {
  const robot::Drive drive = joint_.mimic ? robot::Drive{} : joint_.drive.value_or(robot::Drive{});
  const bool driven = joint_.drive && !joint_.mimic;
  if (!driven && std::isinf(joint_.effort_limit)) {
    return;
  }
  const std::string instance = angular() ? "angular" : "linear";
  const Token api("PhysicsDriveAPI:" + instance);
  const std::string prefix = "drive:" + instance + ":physics:";
  builder_.apply(path_, api);
  builder_.set_number(path_, api, prefix + "damping", gain(drive.damping));
  if (std::isfinite(joint_.effort_limit)) {
    builder_.set_number(path_, api, prefix + "maxForce", joint_.effort_limit);
  }
  builder_.set_number(path_, api, prefix + "stiffness", gain(drive.stiffness));
  if (drive.target != 0) {
    builder_.set_number(path_, api, prefix + "targetPosition", position(drive.target));
  }
  builder_.set_value(path_, api, prefix + "type", Value(Token("force")));
}

void JointPrinter::print_state(double position) {
  const std::string instance = angular() ? "angular" : "linear";
  const Token api("PhysicsJointStateAPI:" + instance);
  builder_.apply(path_, api);
  builder_.set_number(path_, api, "state:" + instance + ":physics:position",
                      position == 0 ? 0 : this->position(position));
  builder_.set_number(path_, api, "state:" + instance + ":physics:velocity", 0);
}

void JointPrinter::print_newton() {
  const auto set = [&](const char* name, bool needed, double value) {
    if (needed) {
      builder_.apply(path_, "NewtonJointAPI");
      builder_.set_number(path_, "NewtonJointAPI", name, value);
    }
  };
  set("newton:armature", joint_.armature != 0, joint_.armature);
  set("newton:damping", joint_.damping != 0, gain(joint_.damping));
  set("newton:friction", joint_.friction != 0, joint_.friction);
  set("newton:velocityLimit", std::isfinite(joint_.velocity_limit),
      velocity(joint_.velocity_limit));
}

void JointPrinter::print_physx_axis() {
  const std::string instance = angular() ? "angular" : "linear";
  const Token api("PhysxJointAxisAPI:" + instance);
  const std::string prefix = "physxJointAxis:" + instance + ":";
  const auto set = [&](const char* name, bool needed, double value) {
    if (needed) {
      builder_.apply(path_, api);
      builder_.set_number(path_, api, prefix + name, value);
    }
  };
  set("armature", joint_.armature != 0, joint_.armature);
  set("dynamicFrictionEffort", joint_.friction != 0, joint_.friction);
  set("maxJointVelocity", std::isfinite(joint_.velocity_limit), velocity(joint_.velocity_limit));
  set("staticFrictionEffort", joint_.friction != 0, joint_.friction);
  set("viscousFrictionCoefficient", joint_.damping != 0, gain(joint_.damping));
}

/// Its jointFriction is a coefficient without unit: no friction in N m can be said there.
void JointPrinter::print_physx_joint() {
  builder_.apply(path_, "PhysxJointAPI");
  if (joint_.armature != 0) {
    builder_.set_number(path_, "PhysxJointAPI", "physxJoint:armature", joint_.armature);
  }
  if (std::isfinite(joint_.velocity_limit)) {
    builder_.set_number(path_, "PhysxJointAPI", "physxJoint:maxJointVelocity",
                        velocity(joint_.velocity_limit));
  }
}

/// Damping and stiffness per radian, the rest position in degrees, as MuJoCo's reader has them.
void JointPrinter::print_mujoco() {
  const auto set = [&](const char* name, bool needed, double value) {
    if (needed) {
      builder_.apply(path_, "MjcJointAPI");
      builder_.set_number(path_, "MjcJointAPI", name, value);
    }
  };
  if (legacy()) {
    set("mjc:armature", joint_.armature != 0, joint_.armature);
    set("mjc:damping", joint_.damping != 0, joint_.damping);
    set("mjc:frictionloss", joint_.friction != 0, joint_.friction);
  }
  const auto list = [&](const char* name, const std::vector<double>& values) {
    if (!values.empty()) {
      builder_.apply(path_, "MjcJointAPI");
      builder_.set_value(path_, "MjcJointAPI", name, Value(values));
    }
  };
  list("mjc:solimpfriction", joint_.mujoco.solimp_friction);
  list("mjc:solimplimit", joint_.mujoco.solimp_limit);
  list("mjc:solreffriction", joint_.mujoco.solref_friction);
  list("mjc:solreflimit", joint_.mujoco.solref_limit);
  set("mjc:springref", joint_.stiffness != 0 && joint_.spring_reference != 0,
      position(joint_.spring_reference));
  set("mjc:stiffness", joint_.stiffness != 0, joint_.stiffness);
}

/// What the description says and no schema holds, in its own units: SI, radians.
void JointPrinter::print_description() {
  const auto set = [&](const char* name, std::optional<double> value) {
    if (value && std::isfinite(*value)) {
      builder_.set_custom(path_, name, "double", Value(*value));
    }
  };
  if (joint_.calibration) {
    set("urdf:calibration:falling", joint_.calibration->falling);
    set("urdf:calibration:rising", joint_.calibration->rising);
  }
  if (!tutorial_) {
    set("urdf:limit:effort", joint_.effort_limit);
  }
  if (joint_.safety) {
    set("urdf:safety:kPosition", joint_.safety->position_gain);
    set("urdf:safety:kVelocity", joint_.safety->velocity_gain);
    set("urdf:safety:softLowerLimit", joint_.safety->soft_lower);
    set("urdf:safety:softUpperLimit", joint_.safety->soft_upper);
  }
}

/// Limits as floats, and places for what people say of the joint.
void JointPrinter::print_tutorial() {
  const auto limit = [&](const char* name, double value) {
    if (std::isfinite(value)) {
      builder_.set_custom(path_, name, "float", Value(static_cast<float>(value)));
    }
  };
  limit("urdf:limit:effort", joint_.effort_limit);
  limit("urdf:limit:velocity", joint_.velocity_limit);
  struct Row {
    const char* name;
    const char* shown;
  };
  constexpr Row kRows[] = {{"isaac:actuator", "Actuator"},
                           {"isaac:NameOverride", "Joint Name Override"},
                           {"isaac:physics:DofOffsetOpOrder", "Dof Offset Op Order"}};
  for (const Row& row : kRows) {
    builder_.declare_of(path_, "IsaacJointAPI", row.name);
    builder_.set_property_metadata(path_.property(row.name), layer::fields::displayName,
                                   Value(std::string(row.shown)));
  }
}

void JointPrinter::print_mimic(const robot::Joint& leader, Path leader_path,
                               const std::string& leader_axis) {
  const robot::Mimic& mimic = *joint_.mimic;
  // Layer units of the follower for one of the leader: where one turns and the other slides, they
  // differ.
  const double unit = position(1) / robot::JointPosition::from_si(1, leader.motion()).in_layer();
  const double multiplier = mimic.multiplier * unit;
  const double offset = position(mimic.offset);
  const bool linear = mimic_is_linear(mimic);
  if (const double start = start_of(joint_, &leader, start_); start != 0) {
    print_state(start);
  }
  if (current()) {
    const Token api("NewtonMimicAPI");
    builder_.apply(path_, api);
    builder_.set_number(path_, api, "newton:mimicCoef0", offset);
    builder_.set_number(path_, api, "newton:mimicCoef1", multiplier);
    builder_.set_targets(path_, api, "newton:mimicJoint", {leader_path});
  }
  if (legacy()) {
    const std::string instance = "rot" + axis_;
    const Token api("PhysxMimicJointAPI:" + instance);
    const std::string prefix = "physxMimicJoint:" + instance + ":";
    builder_.apply(path_, api);
    if (tutorial_) {
      builder_.set_number(path_, api, prefix + "dampingRatio", kTutorialDampingRatio);
      builder_.set_number(path_, api, prefix + "naturalFrequency", kTutorialFrequency);
    }
    builder_.set_number(path_, api, prefix + "gearing", -multiplier);
    builder_.set_number(path_, api, prefix + "offset", -offset);
    builder_.set_targets(path_, api, prefix + "referenceJoint", {leader_path});
    builder_.set_value(path_, api, prefix + "referenceJointAxis",
                       Value(Token("rot" + leader_axis)));
  }
  if (legacy() || !linear) {
    const Token api("MjcEqualityJointAPI");
    builder_.apply(path_, api);
    if (legacy()) {
      builder_.set_number(path_, api, "mjc:coef0", mimic.offset);
      builder_.set_number(path_, api, "mjc:coef1", mimic.multiplier);
      builder_.set_relationship(path_, "mjc:target", {leader_path});
    }
    const char* const names[] = {"mjc:coef2", "mjc:coef3", "mjc:coef4"};
    for (std::size_t i = 0; !linear && i < 3; ++i) {
      builder_.set_number(path_, api, names[i], mimic.higher[i]);
    }
  }
}

void JointPrinter::print_actuator(Path scope, Token name) {
  if (!joint_.drive || joint_.mimic) {
    return;
  }
  const Token type("MjcActuator");
  const Path prim = builder_.define(scope, name, type);
  const robot::Drive& drive = *joint_.drive;
  const double at_zero = drive.target == 0 ? 0 : drive.stiffness * drive.target;
  builder_.set_value(prim, type, "mjc:biasPrm",
                     Value(std::vector<double>{at_zero, 0 - drive.stiffness, 0 - drive.damping}));
  builder_.set_value(prim, type, "mjc:biasType", Value(Token("affine")));
  if (drive.control_range) {
    builder_.set_value(prim, type, "mjc:ctrlLimited", Value(Token("true")));
    builder_.set_number(prim, type, "mjc:ctrlRange:max", (*drive.control_range)[1]);
    builder_.set_number(prim, type, "mjc:ctrlRange:min", (*drive.control_range)[0]);
  }
  if (std::isfinite(joint_.effort_limit)) {
    builder_.set_number(prim, type, "mjc:forceRange:max", joint_.effort_limit);
    builder_.set_number(prim, type, "mjc:forceRange:min", -joint_.effort_limit);
  }
  builder_.set_value(prim, type, "mjc:gainPrm", Value(std::vector<double>{drive.control_gain()}));
  builder_.set_value(prim, type, "mjc:gainType", Value(Token("fixed")));
  builder_.set_targets(prim, type, "mjc:target", {path_});
}

}  // namespace tenon::convert
