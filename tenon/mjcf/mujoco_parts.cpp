// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {

using robot::Index;

namespace {

using Range = std::array<double, 2>;

std::optional<Range> range_of(bool limited, const double* range) {
  return limited ? std::optional<Range>({range[0], range[1]}) : std::nullopt;
}

/// The schema's token; empty for kinds that it does not have.
std::string token_of(std::span<const char* const> tokens, int kind) {
  const auto at = static_cast<std::size_t>(kind);
  return kind >= 0 && at < tokens.size() ? tokens[at] : "";
}

constexpr const char* kGainTokens[] = {"fixed", "affine", "muscle"};
constexpr const char* kBiasTokens[] = {"none", "affine", "muscle"};
constexpr const char* kDynamicsTokens[] = {"none", "integrator", "filter", "filterexact", "muscle"};
static_assert(mjGAIN_MUSCLE == 2 && mjBIAS_MUSCLE == 2 && mjDYN_MUSCLE == 4);

}  // namespace

/// False for what is about other things than a joint of one axis, a ball or a tendon, or of a kind
/// that the schema does not have.
bool MjcfReader::read_motor(int number) {
  const auto at = static_cast<std::size_t>(number);
  const auto target = static_cast<std::size_t>(std::max(0, model_.actuator_trnid[2 * at]));
  robot::MujocoActuator actuator;
  if (model_.actuator_trntype[at] == mjTRN_JOINT) {
    actuator.target = joint_of_joint_[target];
    const robot::Joint& joint = robot_.joints[actuator.target];
    if (!joint.has_one_axis() && joint.kind != robot::JointKind::Ball) {
      return false;
    }
  } else if (model_.actuator_trntype[at] == mjTRN_TENDON && tendon_of_tendon_[target]) {
    actuator.kind = robot::MujocoActuator::Target::Tendon;
    actuator.target = *tendon_of_tendon_[target];
  } else {
    return false;
  }
  actuator.name = unique_name(mjOBJ_ACTUATOR, number, "actuator");
  actuator.gain_type = token_of(kGainTokens, model_.actuator_gaintype[at]);
  actuator.bias_type = token_of(kBiasTokens, model_.actuator_biastype[at]);
  actuator.dyn_type = token_of(kDynamicsTokens, model_.actuator_dyntype[at]);
  if (actuator.gain_type.empty() || actuator.bias_type.empty() || actuator.dyn_type.empty()) {
    return false;
  }
  const auto numbers = [at](const double* table, std::size_t count) {
    return std::vector<double>(table + count * at, table + count * (at + 1));
  };
  actuator.gain = numbers(model_.actuator_gainprm, mjNGAIN);
  actuator.bias = numbers(model_.actuator_biasprm, mjNBIAS);
  actuator.dynamics = numbers(model_.actuator_dynprm, mjNDYN);
  std::copy_n(model_.actuator_gear + 6 * at, 6, actuator.gear.begin());
  actuator.force_range =
      range_of(model_.actuator_forcelimited[at] != 0, model_.actuator_forcerange + 2 * at);
  actuator.activation_range =
      range_of(model_.actuator_actlimited[at] != 0, model_.actuator_actrange + 2 * at);
  const auto input = static_cast<std::size_t>(model_.actuator_ctrladr[at]);
  actuator.control_range =
      range_of(model_.actuator_ctrllimited[input] != 0, model_.actuator_ctrlrange + 2 * input);
  robot_.mujoco.actuators.push_back(std::move(actuator));
  motors_.push_back(number);
  return true;
}

/// In the order of the actuators' prims: those of drives by joint, then the others.
std::vector<double> MjcfReader::controls_of(int key) const {
  const double* controls =
      model_.key_ctrl + static_cast<std::size_t>(key) * static_cast<std::size_t>(model_.nu);
  std::vector<std::pair<Index, double>> of_drives;
  for (int i = 0; i < model_.nactuator; ++i) {
    const std::optional<Index> joint = drive_of_actuator_[static_cast<std::size_t>(i)];
    if (joint && !robot_.joints[*joint].mimic) {
      of_drives.emplace_back(*joint, control_of(i, controls[model_.actuator_ctrladr[i]]));
    }
  }
  std::sort(of_drives.begin(), of_drives.end());
  std::vector<double> ordered;
  for (const auto& [joint, control] : of_drives) {
    ordered.push_back(control);
  }
  for (const int motor : motors_) {
    ordered.push_back(controls[model_.actuator_ctrladr[motor]]);
  }
  return ordered;
}

/// Of the actuators that are there.
std::vector<double> MjcfReader::activations_of(int key) const {
  const double* row =
      model_.key_act + static_cast<std::size_t>(key) * static_cast<std::size_t>(model_.na);
  std::vector<double> result;
  for (const int motor : motors_) {
    const int count = model_.actuator_actnum[motor];
    for (int i = 0; i < count; ++i) {
      result.push_back(row[model_.actuator_actadr[motor] + i]);
    }
  }
  return result;
}

/// Hinges and slides count from where the bodies stand as written.
void MjcfReader::read_keyframes() {
  for (int key = 0; key < model_.nkey; ++key) {
    const auto at = static_cast<std::size_t>(key);
    const auto row = [at](const double* table, auto count) {
      const auto size = static_cast<std::size_t>(count);
      return std::vector<double>(table + size * at, table + size * (at + 1));
    };
    robot::MujocoKeyframe frame;
    frame.name = unique_name(mjOBJ_KEY, key, "keyframe");
    frame.positions = row(model_.key_qpos, model_.nq);
    frame.velocities = row(model_.key_qvel, model_.nv);
    frame.activations = activations_of(key);
    frame.controls = controls_of(key);
    if (model_.key_time[at] != 0) {
      report("mjcf.left-out", "the time of keyframe \"" + frame.name + "\" is left out");
    }
    for (int joint = 0; joint < model_.njnt; ++joint) {
      const int type = model_.jnt_type[joint];
      const auto coordinate = static_cast<std::size_t>(model_.jnt_qposadr[joint]);
      if (type == mjJNT_HINGE || type == mjJNT_SLIDE) {
        frame.positions[coordinate] -= model_.qpos0[coordinate];
      }
    }
    robot_.mujoco.keyframes.push_back(std::move(frame));
  }
}

}  // namespace tenon::mjcf
