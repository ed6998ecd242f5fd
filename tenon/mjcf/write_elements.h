// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/math/transform.h"
#include "tenon/scene/physics_scene.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// The site of a name, made in a body at a pose in MuJoCo's frame of it [m] where there is none.
mjsSite& named_site(mjSpec& spec, mjsBody* body, const std::string& name, const Pose& pose);

/// What the model calls a joint of one axis or a ball; empty: another joint, or the model has none.
std::string joint_element(mjSpec& spec, const scene::Joint& joint);

}  // namespace tenon::mjcf
