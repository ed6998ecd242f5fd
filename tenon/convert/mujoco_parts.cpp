// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/mujoco_parts.h"

#include "tenon/convert/mujoco_values.h"
#include "tenon/convert/tendon_writer.h"

namespace tenon::convert {

using layer::Value;
using robot::MujocoActuator;

namespace {

Path write_motor(PhysicsScope& physics, const MujocoActuator& actuator, Path target) {
  constexpr const char* kType = "MjcActuator";
  LayerBuilder& builder = physics.builder();
  const Path path = physics.define(actuator.name, kType);
  const auto set = [&](const char* name, Value value) {
    builder.set_value(path, kType, name, std::move(value));
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
  write_range(builder, path, kType, "mjc:actRange", "mjc:actLimited", actuator.activation_range);
  write_range(builder, path, kType, "mjc:ctrlRange", "mjc:ctrlLimited", actuator.control_range);
  write_range(builder, path, kType, "mjc:forceRange", "mjc:forceLimited", actuator.force_range);
  builder.set_targets(path, kType, "mjc:target", {target});
  return path;
}

void write_keyframe(PhysicsScope& physics, const robot::MujocoKeyframe& frame) {
  constexpr const char* kType = "MjcKeyframe";
  const Path path = physics.define(frame.name, kType);
  const auto set = [&](const char* name, const std::vector<double>& values) {
    if (!values.empty()) {
      physics.builder().set_value(path, kType, name, Value(values));
    }
  };
  set("mjc:act", frame.activations);
  set("mjc:ctrl", frame.controls);
  set("mjc:qpos", frame.positions);
  set("mjc:qvel", frame.velocities);
}

}  // namespace

MujocoPrims write_mujoco_parts(const robot::MujocoParts& parts, const JointPrims& joints,
                               const ShapePrims& shapes, PhysicsScope& physics) {
  MujocoPrims prims;
  TendonWriter writer(joints.joints, shapes, physics);
  std::vector<Path> tendons;
  for (const robot::MujocoTendon& tendon : parts.tendons) {
    tendons.push_back(writer.write(tendon));
    prims.tendons.emplace(tendon.name, tendons.back());
  }
  for (const MujocoActuator& actuator : parts.actuators) {
    const bool joint = actuator.kind == MujocoActuator::Target::Joint;
    const Path target = joint ? joints.joints[actuator.target] : tendons[actuator.target];
    if (!target.empty()) {
      prims.actuators.emplace(actuator.name, write_motor(physics, actuator, target));
    }
  }
  for (const robot::MujocoKeyframe& frame : parts.keyframes) {
    write_keyframe(physics, frame);
  }
  return prims;
}

}  // namespace tenon::convert
