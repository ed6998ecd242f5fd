// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// What a model's bodies and joints are in a robot, by MuJoCo's numbers.
struct BodyTree {
  std::vector<robot::Link> links;            ///< with sites, without shapes
  std::vector<robot::Joint> joints;          ///< without drives and mimics
  std::vector<robot::Index> link_of_body;    ///< (nbody), into links
  std::vector<robot::Index> joint_of_joint;  ///< (njnt), into joints
};

/// A link for each body, the world first, and a chain of links where a body has several joints.
BodyTree read_bodies(MjcfSource& source);

}  // namespace tenon::mjcf
