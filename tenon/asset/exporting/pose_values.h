// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tenon/asset/exporting/joint_motors.h"
#include "tenon/stage/stage.h"

namespace tenon {

/// A named pose of an asset: coordinates of joints by place in a list of motors [rad or m].
using PoseValues = std::pair<std::string, std::vector<std::pair<std::size_t, double>>>;

/// The named poses, without joints that follow others or are not in `motors`. `meters` is the
/// length of a unit of the stage.
std::vector<PoseValues> pose_values(const stage::Stage& stage,
                                    const std::vector<JointMotor>& motors, double meters);

}  // namespace tenon
