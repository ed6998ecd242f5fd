// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/convert/prepare_joints.h"

#include "tenon/base/file_finding.h"

namespace tenon::convert {
namespace {

/// The drives that the options ask for: of joints with one axis that follow no other.
void add_drives(const ConvertOptions& options, robot::RobotModel& model) {
  for (robot::Joint& joint : model.joints) {
    if (!joint.has_one_axis() || joint.mimic) {
      continue;
    }
    const auto own = options.joint_gains.find(joint.name);
    const std::optional<Gains> gains =
        own != options.joint_gains.end() ? std::optional(own->second) : options.gains;
    if (gains) {
      joint.drive.emplace(joint.drive.value_or(robot::Drive{}));
      joint.drive->stiffness = gains->stiffness;
      joint.drive->damping = gains->damping;
    }
  }
}

void report_unknown_gains(const robot::RobotModel& model, const ConvertOptions& options,
                          Diagnostics& diagnostics) {
  for (const auto& [name, gains] : options.joint_gains) {
    bool known = false;
    for (const robot::Joint& joint : model.joints) {
      known = known || joint.name == name;
    }
    if (!known) {
      diagnostics.add(
          file_finding(Severity::Error, "convert.gains",
                       "gains are given for \"" + name + "\", which is not a joint of the robot",
                       model.file, 0, "name a joint as the description does"));
    }
  }
}

bool is_linear(const std::optional<robot::Mimic>& mimic) {
  return mimic && mimic->higher == robot::Mimic{}.higher;
}

/// Joints that follow a follower follow its leader instead: not every engine takes chains. There
/// are no cycles (sanitize_model).
void follow_leaders(robot::RobotModel& model) {
  std::vector<char> done(model.joints.size(), 0);
  std::vector<robot::Index> chain;
  for (robot::Index start = 0; start < model.joints.size(); ++start) {
    for (robot::Index at = start; done[at] == 0; at = model.joints[at].mimic->leader) {
      done[at] = 1;
      if (!is_linear(model.joints[at].mimic)) {
        break;
      }
      chain.push_back(at);
    }
    for (; !chain.empty(); chain.pop_back()) {
      robot::Mimic& mimic = *model.joints[chain.back()].mimic;
      const std::optional<robot::Mimic>& next = model.joints[mimic.leader].mimic;
      if (is_linear(next)) {
        mimic.offset += mimic.multiplier * next->offset;
        mimic.multiplier *= next->multiplier;
        mimic.leader = next->leader;
      }
    }
  }
}

}  // namespace

void prepare_joints(const ConvertOptions& options, robot::RobotModel& model,
                    Diagnostics& diagnostics) {
  report_unknown_gains(model, options, diagnostics);
  add_drives(options, model);
  follow_leaders(model);
}

}  // namespace tenon::convert
