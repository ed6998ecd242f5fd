// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "tenon/base/text/counted.h"
#include "tenon/check/subject.h"
#include "tenon/physics/vendors/named_poses.h"
#include "tenon/scene/joint_dofs.h"

namespace tenon::check {
namespace {

constexpr double kPoseSlack = 1e-4;  // [rad or m] beyond a limit, as values are in single precision

const Token kPoseJoints("isaac:robot:pose:joints");
const Token kPoseValues("isaac:robot:pose:jointValues");

template <class Visit>
void each_named_pose(const Subject& subject, Visit visit) {
  for (const physics::NamedPose& pose : physics::named_poses(subject.stage)) {
    visit(pose, subject.stage.prim(pose.path));
  }
}

std::string save_again(const physics::NamedPose& pose) {
  return "save it again: tenon pose ASSET --save " + pose.path.name().str() + " --pose JOINT=VALUE";
}

}  // namespace

void check_pose_joints(const Subject& subject, Reporter& report) {
  each_named_pose(subject, [&](const physics::NamedPose& pose, const stage::Prim& prim) {
    for (const physics::NamedPoseJoint& one : pose.joints) {
      if (!subject.joint_at(one.joint)) {
        report.at_target(prim, kPoseJoints, one.joint,
                         "the pose names " + named(one.joint, RelatedRole::Joint) +
                             ", which is no joint: the pose cannot be taken",
                         save_again(pose));
      }
    }
  });
}

void check_pose_counts(const Subject& subject, Reporter& report) {
  each_named_pose(subject, [&](const physics::NamedPose& pose, const stage::Prim& prim) {
    // A structured asset names the joints where it has them: with its physics.
    const bool is_without_physics = pose.target_count == 0 && subject.scene.joints.empty();
    if (pose.target_count != pose.value_count && !is_without_physics) {
      report.at(prim, kPoseValues,
                "the pose names " + counted(pose.target_count, "joint") + " and has " +
                    counted(pose.value_count, "value"),
                "author a value for each joint, or " + save_again(pose));
    }
  });
}

void check_pose_limits(const Subject& subject, Reporter& report) {
  const auto wanted = scene::wanted_rotations(subject.scene);
  each_named_pose(subject, [&](const physics::NamedPose& pose, const stage::Prim& prim) {
    for (const physics::NamedPoseJoint& one : pose.joints) {
      const auto joint = subject.joint_at(one.joint);
      if (!joint) {
        continue;
      }
      const scene::JointDofs dofs = scene::joint_dofs(subject.scene.joints[*joint], wanted[*joint]);
      if (dofs.ball || dofs.free.size() != 1) {
        continue;
      }
      const scene::FreeDof& dof = dofs.free[0];
      const bool turns = is_angular(dof.dof);
      const double unit = turns ? M_PI / 180 : subject.scene.meters_per_unit;
      const double at = one.value * unit;
      if (at >= dof.lower - kPoseSlack && at <= dof.upper + kPoseSlack) {
        continue;
      }
      report.at(prim, kPoseValues,
                "the pose puts " + named(one.joint, RelatedRole::Joint) + " to " +
                    digits(one.value) + (turns ? " degrees" : "") + ", beyond its limits of " +
                    digits(dof.lower / unit) + " and " + digits(dof.upper / unit),
                save_again(pose));
    }
  });
}

}  // namespace tenon::check
