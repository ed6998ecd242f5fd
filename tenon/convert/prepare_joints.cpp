// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What the options add to joints before they are written: drives, leaders without a leader, and
// where they start. A start moves the child link about the frame of the joint and leaves the frame.
#include "tenon/convert/prepare_joints.h"

#include <cmath>
#include <string>

#include "tenon/base/file_finding.h"
#include "tenon/base/text/rounded_text.h"
#include "tenon/math/mimic_law.h"

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

/// Joints that follow a follower follow its leader instead: not every engine takes chains. There
/// are no cycles (sanitize_model).
void follow_leaders(robot::RobotModel& model) {
  std::vector<char> done(model.joints.size(), 0);
  std::vector<robot::Index> chain;
  for (robot::Index start = 0; start < model.joints.size(); ++start) {
    for (robot::Index at = start; done[at] == 0; at = model.joints[at].mimic->leader) {
      done[at] = 1;
      const std::optional<robot::Mimic>& mimic = model.joints[at].mimic;
      if (!mimic || !mimic_is_linear(*mimic)) {
        break;
      }
      chain.push_back(at);
    }
    for (; !chain.empty(); chain.pop_back()) {
      robot::Mimic& mimic = *model.joints[chain.back()].mimic;
      const std::optional<robot::Mimic>& next = model.joints[mimic.leader].mimic;
      if (next && mimic_is_linear(*next)) {
        mimic.offset += mimic.multiplier * next->offset;
        mimic.multiplier *= next->multiplier;
        mimic.leader = next->leader;
      }
    }
  }
}

constexpr double kSlack = 1e-6;  // of limits that are rounded [rad or m]

bool excludes(const robot::Joint& joint, double position) {
  return joint.has_one_axis() && joint.limit && joint.limit->lower <= joint.limit->upper &&
         (position < joint.limit->lower - kSlack || position > joint.limit->upper + kSlack);
}

/// A twentieth of the range inside of the limit that is nearest to 0.
double inside_of(const robot::Limit& limit) {
  constexpr double kInside = 0.05;
  const double range = limit.upper - limit.lower;
  const double inside = std::isfinite(range) ? kInside * range : 0;
  return limit.lower > 0 ? limit.lower + inside : limit.upper - inside;
}

void place_starts(const ConvertOptions& options, robot::RobotModel& model,
                  Diagnostics& diagnostics) {
  for (robot::Joint& joint : model.joints) {
    if (joint.mimic || !excludes(joint, 0)) {
      continue;
    }
    const double start = start_of(joint, nullptr, options.start);
    if (joint.drive && excludes(joint, joint.drive->target)) {
      joint.drive->target = start;
    }
    if (options.start == StartPose::Zero) {
      const bool turns = joint.kind != robot::JointKind::Prismatic;
      const double unit = turns ? 180 / M_PI : 1;
      const std::string name = turns ? " degrees" : " m";
      diagnostics.add(file_finding(
          Severity::Warning, "convert.outside-limits",
          "the limits of joint \"" + joint.name + "\", " + rounded_text(joint.limit->lower * unit) +
              " to " + rounded_text(joint.limit->upper * unit) + name +
              ", exclude 0, where the description has it: simulations begin by pushing it in",
          model.file, joint.place.line,
          "convert with --start valid to start it at " +
              rounded_text(inside_of(*joint.limit) * unit) + name));
    }
  }
}

}  // namespace

double start_of(const robot::Joint& joint, const robot::Joint* leader, StartPose pose) {
  if (pose == StartPose::Zero) {
    return 0;
  }
  if (joint.mimic && leader != nullptr) {
    const double start = start_of(*leader, nullptr, pose);
    return start == 0 ? 0 : mimic_position(*joint.mimic, start);
  }
  return excludes(joint, 0) ? inside_of(*joint.limit) : 0;
}

Pose start_in_parent(const robot::RobotModel& model, const robot::Joint& joint, StartPose pose) {
  const robot::Joint* leader = joint.mimic ? &model.joints[joint.mimic->leader] : nullptr;
  const double start = joint.has_one_axis() ? start_of(joint, leader, pose) : 0;
  if (start == 0) {
    return joint.origin;
  }
  Pose moved;
  if (joint.motion() == robot::Motion::Linear) {
    moved.position = joint.axis * start;
  } else {
    moved.orientation = rotation_about(joint.axis, start);
  }
  return joint.origin * joint.frame * moved * inverse(joint.frame);
}

void prepare_joints(const ConvertOptions& options, robot::RobotModel& model,
                    Diagnostics& diagnostics) {
  report_unknown_gains(model, options, diagnostics);
  add_drives(options, model);
  follow_leaders(model);
  place_starts(options, model, diagnostics);
}

}  // namespace tenon::convert
