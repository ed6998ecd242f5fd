// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/exporting/pose_values.h"

#include <map>

#include "tenon/math/angle.h"
#include "tenon/physics/vendors/named_poses.h"

namespace tenon {

std::vector<PoseValues> pose_values(const stage::Stage& stage,
                                    const std::vector<JointMotor>& motors, double meters) {
  std::map<Path, std::size_t> place_of;
  for (std::size_t i = 0; i < motors.size(); ++i) {
    if (!motors[i].leader) {
      place_of.emplace(motors[i].path, i);
    }
  }
  std::vector<PoseValues> poses;
  for (const physics::NamedPose& named : physics::named_poses(stage)) {
    PoseValues pose{named.path.name().str(), {}};
    for (const physics::NamedPoseJoint& one : named.joints) {
      const auto at = place_of.find(one.joint);
      if (at != place_of.end()) {
        const double unit = motors[at->second].angular ? kRadians : meters;
        pose.second.emplace_back(at->second, one.value * unit);
      }
    }
    poses.push_back(std::move(pose));
  }
  return poses;
}

}  // namespace tenon
