// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/conversion.h"

namespace tenon::convert {

using layer::Value;
using robot::JointKind;
using robot::MujocoActuator;

namespace {

using Range = std::optional<std::array<double, 2>>;

}  // namespace

/// Joints beside the tree: excluded from the articulation, soft as MuJoCo has them.
void Conversion::write_loops() {
  for (const robot::LoopJoint& loop : model_.loops) {
    const bool weld = loop.kind == JointKind::Fixed;
    const Path path = define_joint(loop.name, weld ? "PhysicsFixedJoint" : "PhysicsSphericalJoint");
    for (int side = 0; side < 2; ++side) {
      const auto end = static_cast<std::size_t>(side);
      const LinkPrim& link = links_[loop.links[end]];
      write_side(path, side, links_[link.host].path, link.in_host * loop.frames[end]);
    }
    builder_.set_value(path, "PhysicsJoint", "physics:excludeFromArticulation", Value(true));
    const Token api(weld ? "MjcEqualityWeldAPI" : "MjcEqualityConnectAPI");
    builder_.apply(path, api);
    if (!loop.solimp.empty()) {
      builder_.set_value(path, "MjcEqualityAPI", "mjc:solimp", Value(loop.solimp));
    }
    if (!loop.solref.empty()) {
      builder_.set_value(path, "MjcEqualityAPI", "mjc:solref", Value(loop.solref));
    }
    if (weld && loop.torque_scale != 1) {
      builder_.set_number(path, api, "mjc:torqueScale", loop.torque_scale);
    }
  }
}

void Conversion::write_range(Path prim, const char* type, const std::string& name,
                             const char* limited, const Range& range) {
  if (range) {
    builder_.set_value(prim, type, limited, Value(Token("true")));
    builder_.set_number(prim, type, name + ":max", (*range)[1]);
    builder_.set_number(prim, type, name + ":min", (*range)[0]);
  }
}

void Conversion::write_motor(const MujocoActuator& actuator, Path target) {
  constexpr const char* kType = "MjcActuator";
  const Path path = define_joint(actuator.name, kType);
  const auto set = [&](const char* name, Value value) {
    builder_.set_value(path, kType, name, std::move(value));
  };
  if (actuator.bias_type != "none") {
    set("mjc:biasPrm", Value(actuator.bias));
    set("mjc:biasType", Value(Token(actuator.bias_type)));
  }
  if (actuator.dyn_type != "none") {
    set("mjc:dynPrm", Value(actuator.dynamics));
    set("mjc:dynType", Value(Token(actuator.dyn_type)));
  }
  set("mjc:gainPrm", Value(actuator.gain));
  set("mjc:gainType", Value(Token(actuator.gain_type)));
  set("mjc:gear", Value(std::vector<double>(actuator.gear.begin(), actuator.gear.end())));
  write_range(path, kType, "mjc:actRange", "mjc:actLimited", actuator.activation_range);
  write_range(path, kType, "mjc:ctrlRange", "mjc:ctrlLimited", actuator.control_range);
  write_range(path, kType, "mjc:forceRange", "mjc:forceLimited", actuator.force_range);
  builder_.set_targets(path, kType, "mjc:target", {target});
}

void Conversion::write_mujoco_parts() {
  std::vector<Path> tendons;
  for (const robot::MujocoTendon& tendon : model_.mujoco.tendons) {
    tendons.push_back(write_tendon(tendon));
  }
  for (const MujocoActuator& actuator : model_.mujoco.actuators) {
    const bool joint = actuator.kind == MujocoActuator::Target::Joint;
    const Path target = joint ? joints_[actuator.target] : tendons[actuator.target];
    if (!target.empty()) {
      write_motor(actuator, target);
    }
  }
  for (const robot::MujocoKeyframe& frame : model_.mujoco.keyframes) {
    constexpr const char* kType = "MjcKeyframe";
    const Path path = define_joint(frame.name, kType);
    const auto set = [&](const char* name, const std::vector<double>& values) {
      if (!values.empty()) {
        builder_.set_value(path, kType, name, Value(values));
      }
    };
    set("mjc:act", frame.activations);
    set("mjc:ctrl", frame.controls);
    set("mjc:qpos", frame.positions);
    set("mjc:qvel", frame.velocities);
  }
}

}  // namespace tenon::convert
