// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/layer/layer.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::structure {

/// The bodies and joints of a robot in the order of its joint forest: each link before those that
/// hang on it; joints to the world and of loops, and those that the scene does not have, come last,
/// in the order of the content. All are paths of the content.
struct KinematicOrder {
  std::vector<Path> links;
  std::vector<Path> joints;
};
/// `scene`: what the content is read as.
KinematicOrder kinematic_order(const layer::Layer& content, const scene::PhysicsScene& scene);

/// Describes the robot as robot tools want it, where the content does not yet: IsaacRobotAPI with
/// the ordered links and joints on the default prim, IsaacLinkAPI and IsaacJointAPI on those that
/// are in the content.
void add_robot_metadata(layer::Layer& content, const KinematicOrder& order);

/// The same for the links and joints alone.
void add_part_apis(layer::Layer& content, const KinematicOrder& order);

}  // namespace tenon::structure
