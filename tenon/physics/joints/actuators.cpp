// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A MuJoCo actuator on a joint: force = gain ctrl + b0 + b1 l + b2 l', with l = gear q, acting as
// gear * force. With fixed gain and affine bias this is a drive:
//   stiffness -b1 gear^2, damping -b2 gear^2, rest at q = -b0 / (b1 gear) for ctrl = 0.
// Numbers are per radian. No control is authored on a stage, so ctrl is 0; where the joint has a
// drive of its own for the axis, its targets are the control and the actuator gives gains and
// limits.
#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/physics/read_state.h"

namespace tenon::physics {
namespace {

struct ActuatorTokens {
  Token target{"mjc:target"};
  Token gain_type{"mjc:gainType"};
  Token bias_type{"mjc:biasType"};
  Token dyn_type{"mjc:dynType"};
  Token gain{"mjc:gainPrm"};
  Token bias{"mjc:biasPrm"};
  Token gear{"mjc:gear"};
  Token force_min{"mjc:forceRange:min"};
  Token force_max{"mjc:forceRange:max"};
};

/// The first three of an array of numbers, floats or doubles.
std::array<double, 3> leading(const stage::Prim& prim, Token name, std::array<double, 3> fallback) {
  const layer::Value value = prim.attribute(name).get();
  if (const auto* wide = value.get<layer::Array<double>>()) {
    for (std::size_t i = 0; i < 3; ++i) {
      fallback[i] = i < wide->size() ? (*wide)[i] : (wide->empty() ? fallback[i] : 0);
    }
  } else if (const auto* narrow = value.get<layer::Array<float>>()) {
    for (std::size_t i = 0; i < 3; ++i) {
      fallback[i] = i < narrow->size() ? static_cast<double>((*narrow)[i])
                                       : (narrow->empty() ? fallback[i] : 0);
    }
  }
  return fallback;
}

class ActuatorReader {
 public:
  explicit ActuatorReader(ReadState& state) : state_(state) {}

  void read(const PhysicsPrim& found) {
    const std::optional<Index> joint = joint_of(found.prim);
    if (!joint) {
      return;
    }
    const Joint& driven = state_.scene.joints[*joint];
    const bool one_axis = driven.kind == JointKind::Revolute || driven.kind == JointKind::Prismatic;
    if (!one_axis) {
      return;  // no drive: one of MuJoCo's own (read_mujoco_actuators)
    }
    const Token gain_type = token(found.prim, tokens_.gain_type, "fixed");
    const Token bias_type = token(found.prim, tokens_.bias_type, "none");
    const Token dyn_type = token(found.prim, tokens_.dyn_type, "none");
    if (!(gain_type == "fixed") || !(bias_type == "affine") || !(dyn_type == "none")) {
      return;  // likewise
    }
    add(found.prim, *joint);
  }

 private:
  Token token(const stage::Prim& prim, Token name, const char* fallback) const {
    return prim.attribute(name).get().get_or<Token>(Token(fallback));
  }

  static bool is_other_target(const stage::Prim& prim) {
    return prim.is_valid() && (prim.type_name() == "MjcTendon" || prim.has_api("IsaacSiteAPI") ||
                               prim.has_api("MjcSiteAPI"));
  }

  std::optional<Index> joint_of(const stage::Prim& prim) {
    const std::vector<Path> targets = prim.relationship(tokens_.target).targets();
    if (targets.size() == 1) {
      const std::uint32_t joint = state_.joint_at(targets.front());
      if (joint != kNone) {
        return joint;
      }
    }
    if (targets.size() == 1 && is_other_target(prim.prim_at(targets.front()))) {
      return std::nullopt;  // likewise
    }
    state_.values.report_target(
        prim, tokens_.target, targets.empty() ? Path() : targets.front(), Severity::Error,
        "actuator.target-missing",
        targets.empty() ? "mjc:target names nothing; the actuator is skipped"
                        : "mjc:target names " + named(targets.front(), RelatedRole::Target) +
                              ", which is not a joint; the actuator is skipped",
        "name one joint in mjc:target");
    return std::nullopt;
  }

  Drive drive_of(const stage::Prim& prim, const Joint& joint) {
    const double gear = leading(prim, tokens_.gear, {1, 0, 0})[0];
    const std::array<double, 3> bias = leading(prim, tokens_.bias, {0, 0, 0});
    const bool angular = is_angular(joint.dof());
    const double unit = angular ? state_.units.torque() : state_.units.mass;
    Drive drive;
    drive.source = prim.path();
    drive.dof = joint.dof();
    drive.stiffness = -bias[1] * gear * gear * unit;
    drive.damping = -bias[2] * gear * gear * unit;
    const double length = angular ? 1 : state_.units.length;
    if (bias[1] != 0 && gear != 0) {
      drive.target_position = -bias[0] / (bias[1] * gear) * length;
    } else if (bias[2] != 0 && gear != 0) {
      drive.target_velocity = -bias[0] / (bias[2] * gear) * length;
    }
    const double force = angular ? state_.units.torque() : state_.units.force();
    read_force_range(prim, std::fabs(gear) * force, drive);
    return drive;
  }

  void read_force_range(const stage::Prim& prim, double unit, Drive& drive) {
    const double low = state_.values.authored_number(prim, tokens_.force_min).value_or(0);
    const double high = state_.values.authored_number(prim, tokens_.force_max).value_or(0);
    if (low >= high) {
      return;  // not limited
    }
    drive.max_force = std::max(std::fabs(low), std::fabs(high)) * unit;
    if (low != -high) {
      state_.not_read(prim, tokens_.force_min.str(),
                      "the force range is not symmetric; the larger side is used for both");
    }
  }

  void add(const stage::Prim& prim, Index index) {
    Joint& joint = state_.scene.joints[index];
    Drive drive = drive_of(prim, joint);
    const auto same = std::find_if(joint.drives.begin(), joint.drives.end(),
                                   [&](const Drive& other) { return other.dof == drive.dof; });
    if (same == joint.drives.end()) {
      joint.drives.push_back(drive);
      return;
    }
    state_.report(prim, Severity::Info, "actuator.replaces-drive",
                  "the actuator's gains and force limit replace those of the drive on " +
                      named(joint.path, RelatedRole::Joint) +
                      "; the drive's targets are its control",
                  "remove one of the two to say which counts");
    drive.target_position = same->target_position;
    drive.target_velocity = same->target_velocity;
    *same = drive;
  }

  ReadState& state_;
  ActuatorTokens tokens_;
};

}  // namespace

void read_actuators(ReadState& state) {
  const auto prims = sorted_prims(
      state.walk, [](const PhysicsPrim& p) { return p.roles.kind == PrimKind::Actuator; });
  ActuatorReader reader(state);
  for (const std::uint32_t i : prims) {
    reader.read(state.walk.prims[i]);
  }
}

}  // namespace tenon::physics
