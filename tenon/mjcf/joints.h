// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/mjcf/mjcf_source.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::mjcf {

/// A joint by MuJoCo's number, without its place in the tree. Its coordinate counts from `ref`, the
/// pose in which the bodies are written.
robot::Joint read_joint(MjcfSource& source, int number);

}  // namespace tenon::mjcf
