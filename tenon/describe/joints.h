// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "tenon/describe/scene_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::describe {

/// Name, kind and numbers of a joint, without its place in the tree; its axis is one of the joint
/// frame. Reports what a robot's joint cannot say.
robot::Joint read_joint(SceneSource& source, const scene::Joint& described);

/// Lets joints follow others. `joint_of` has those of the scene (joint_count) as numbers of
/// `joints`, where they are any.
void add_mimics(SceneSource& source, const std::vector<std::optional<robot::Index>>& joint_of,
                std::vector<robot::Joint>& joints);

}  // namespace tenon::describe
