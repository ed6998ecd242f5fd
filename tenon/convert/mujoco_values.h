// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tenon/convert/layer_builder.h"
#include "tenon/robot/mujoco_parts.h"
#include "tenon/robot/robot_model.h"

/// Internal to this folder.
namespace tenon::convert {

/// Writes a range of MuJoCo's, if there is one: its ends as `name`:max and `name`:min, and that
/// `limited` is "true".
void write_range(LayerBuilder& builder, Path prim, const char* type, const std::string& name,
                 const char* limited, const std::optional<std::array<double, 2>>& range);

/// Writes settings as properties "mjc:<name>" of `schema`.
void write_settings(LayerBuilder& builder, Path prim, const char* schema,
                    const std::vector<robot::MujocoSetting>& settings);

}  // namespace tenon::convert
