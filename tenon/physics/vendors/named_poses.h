// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/math/transform.h"
#include "tenon/stage/stage.h"

/// Postures of a robot that an asset keeps by name: prims of type IsaacNamedPose (Isaac Sim 6,
/// Robot Schema, "Named Pose").
namespace tenon::physics {

/// One joint of a named pose.
struct NamedPoseJoint {
  Path joint;
  double value = 0;    ///< as authored: degrees, or units of the stage
  bool fixed = false;  ///< inverse kinematics leaves it where it is
};

struct NamedPose {
  Path path;        ///< its last name is the name of the pose
  Path robot;       ///< whose list isaac:robot:namedPoses has it; empty: none has
  Path start_link;  ///< of the chain; empty: not said, like the next
  Path end_link;    ///< what was put to the prim's own place
  bool valid = false;
  /// (the smaller of the counts of targets and values)
  std::vector<NamedPoseJoint> joints;
  std::size_t target_count = 0;  ///< of isaac:robot:pose:joints
  std::size_t value_count = 0;   ///< of isaac:robot:pose:jointValues
  std::optional<Pose> target;    ///< R_T of the end link in the robot's frame, units of the stage
};

/// The list of a robot.
inline constexpr const char* kNamedPosesList = "isaac:robot:namedPoses";

/// All of active and defined prims, in the order of the stage; the first limits::kNamedPoses.
std::vector<NamedPose> named_poses(const stage::Stage& stage);

}  // namespace tenon::physics
