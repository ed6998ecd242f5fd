// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// MuJoCo's actuators push with force = gain ctrl + b0 + b1 l + b2 l', where l = gear q. About a
// joint that is a drive, a spring and a damper (physics/joints/actuators.cpp); everything else is
// kept in MuJoCo's words.
#include "tenon/mjcf/actuators.h"

#include <algorithm>
#include <cmath>
#include <span>

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

/// What an actuator is about, where that is a joint of one axis, a ball or a tendon.
struct MotorTarget {
  robot::MujocoActuator::Target kind = robot::MujocoActuator::Target::Joint;
  Index index = 0;
};

std::optional<MotorTarget> target_of(const mjModel& model, const BodyTree& tree,
                                     const Tendons& tendons, std::size_t actuator) {
  const auto target = static_cast<std::size_t>(std::max(0, model.actuator_trnid[2 * actuator]));
  const int kind = model.actuator_trntype[actuator];
  if (kind == mjTRN_JOINT) {
    const Index index = tree.joint_of_joint[target];
    const robot::Joint& joint = tree.joints[index];
    if (joint.has_one_axis() || joint.kind == robot::JointKind::Ball) {
      return MotorTarget{robot::MujocoActuator::Target::Joint, index};
    }
  } else if (kind == mjTRN_TENDON && tendons.of_number[target]) {
    return MotorTarget{robot::MujocoActuator::Target::Tendon, *tendons.of_number[target]};
  }
  return std::nullopt;
}

/// None for what is about other things, or of a kind that the schema does not have.
std::optional<robot::MujocoActuator> read_motor(const MjcfSource& source, const BodyTree& tree,
                                                const Tendons& tendons, int number) {
  const mjModel& model = source.model();
  const auto at = static_cast<std::size_t>(number);
  const std::optional<MotorTarget> target = target_of(model, tree, tendons, at);
  robot::MujocoActuator actuator;
  if (!target) {
    return std::nullopt;
  }
  actuator.kind = target->kind;
  actuator.target = target->index;
  actuator.name = source.name(mjOBJ_ACTUATOR, number, "actuator");
  actuator.gain_type = token_of(kGainTokens, model.actuator_gaintype[at]);
  actuator.bias_type = token_of(kBiasTokens, model.actuator_biastype[at]);
  actuator.dyn_type = token_of(kDynamicsTokens, model.actuator_dyntype[at]);
  if (actuator.gain_type.empty() || actuator.bias_type.empty() || actuator.dyn_type.empty()) {
    return std::nullopt;
  }
  const auto numbers = [at](const double* table, std::size_t count) {
    return std::vector<double>(table + count * at, table + count * (at + 1));
  };
  actuator.gain = numbers(model.actuator_gainprm, mjNGAIN);
  actuator.bias = numbers(model.actuator_biasprm, mjNBIAS);
  actuator.dynamics = numbers(model.actuator_dynprm, mjNDYN);
  std::copy_n(model.actuator_gear + 6 * at, 6, actuator.gear.begin());
  actuator.force_range =
      range_of(model.actuator_forcelimited[at] != 0, model.actuator_forcerange + 2 * at);
  actuator.activation_range =
      range_of(model.actuator_actlimited[at] != 0, model.actuator_actrange + 2 * at);
  const auto input = static_cast<std::size_t>(model.actuator_ctrladr[at]);
  actuator.control_range =
      range_of(model.actuator_ctrllimited[input] != 0, model.actuator_ctrlrange + 2 * input);
  return actuator;
}

bool is_spring(const mjModel& model, std::size_t actuator) {
  return model.actuator_trntype[actuator] == mjTRN_JOINT &&
         model.actuator_gaintype[actuator] == mjGAIN_FIXED &&
         model.actuator_biastype[actuator] == mjBIAS_AFFINE &&
         model.actuator_dyntype[actuator] == mjDYN_NONE;
}

JointDrive read_drive(const mjModel& model, const BodyTree& tree, int number) {
  const auto at = static_cast<std::size_t>(number);
  const auto target = static_cast<std::size_t>(model.actuator_trnid[2 * at]);
  const double* bias = model.actuator_biasprm + mjNBIAS * at;
  const double gear = model.actuator_gear[6 * at];
  JointDrive found;
  found.joint = tree.joint_of_joint[target];
  found.effort_of_control = gear * model.actuator_gainprm[mjNGAIN * at];
  robot::Drive& drive = found.drive;
  drive.stiffness = 0 - bias[1] * gear * gear;
  drive.damping = 0 - bias[2] * gear * gear;
  const auto input = static_cast<std::size_t>(model.actuator_ctrladr[at]);
  if (model.actuator_ctrllimited[input] != 0) {
    const double* range = model.actuator_ctrlrange + 2 * input;
    const double a = found.asked_for(range[0]);
    const double b = found.asked_for(range[1]);
    drive.control_range = {std::min(a, b), std::max(a, b)};
  }
  if (bias[1] != 0 && gear != 0) {
    const auto coordinate = static_cast<std::size_t>(model.jnt_qposadr[target]);
    drive.target = -bias[0] / (bias[1] * gear) - model.qpos0[coordinate];
  }
  if (model.actuator_forcelimited[at] != 0) {
    const double* range = model.actuator_forcerange + 2 * at;
    found.effort_limit = std::fabs(gear) * std::max(std::fabs(range[0]), std::fabs(range[1]));
  }
  return found;
}

/// Reads the actuators of a model one by one.
class ActuatorReader {
 public:
  ActuatorReader(MjcfSource& source, const BodyTree& tree, const Tendons& tendons)
      : source_(source), tree_(tree), tendons_(tendons), has_drive_(tree.joints.size(), false) {}

  Actuators run() {
    const int count = static_cast<int>(source_.model().nactuator);
    found_.drives.resize(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
      if (is_spring(source_.model(), static_cast<std::size_t>(i))) {
        add_drive(i);
      } else {
        add_motor(i);
      }
    }
    return std::move(found_);
  }

 private:
  void left_out(int number, const std::string& why) {
    source_.left_out("the actuator \"" + source_.name(mjOBJ_ACTUATOR, number, "actuator") +
                         "\" is " + why + "; it is skipped",
                     source_.line_of(mjOBJ_ACTUATOR, number));
  }

  void add_motor(int number) {
    auto motor = read_motor(source_, tree_, tendons_, number);
    if (!motor) {
      left_out(number, "about no joint of one axis, ball or tendon, or of a kind of its own");
      return;
    }
    found_.motors.push_back(std::move(*motor));
    found_.motor_numbers.push_back(number);
  }

  void add_drive(int number) {
    JointDrive drive = read_drive(source_.model(), tree_, number);
    drive.drive.name = source_.written_name(mjOBJ_ACTUATOR, number);
    if (has_drive_[drive.joint] || !tree_.joints[drive.joint].has_one_axis()) {
      left_out(number, has_drive_[drive.joint] ? "the second one of its joint" : "about a ball");
      return;
    }
    has_drive_[drive.joint] = true;
    found_.drives[static_cast<std::size_t>(number)] = drive;
  }

  MjcfSource& source_;
  const BodyTree& tree_;
  const Tendons& tendons_;
  std::vector<bool> has_drive_;  // (joint_count)
  Actuators found_;
};

}  // namespace

double JointDrive::asked_for(double control) const {
  const double gain = drive.control_gain();
  return gain == 0 ? 0 : effort_of_control * control / gain;
}

Actuators read_actuators(MjcfSource& source, const BodyTree& tree, const Tendons& tendons) {
  return ActuatorReader(source, tree, tendons).run();
}

void attach_drives(const Actuators& actuators, std::vector<robot::Joint>& joints) {
  for (const std::optional<JointDrive>& found : actuators.drives) {
    if (found) {
      robot::Joint& joint = joints[found->joint];
      joint.drive = found->drive;
      joint.effort_limit = std::min(joint.effort_limit, found->effort_limit);
    }
  }
}

}  // namespace tenon::mjcf
