// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/scene/mujoco_parts.h"

/// MuJoCo's options under the names of MjcSceneAPI ("option:iterations", "flag:contact").
namespace tenon::engines::mujoco {

/// Sets the field that the setting names; false where there is none, or not of that many numbers.
bool apply_setting(const scene::VendorSetting& setting, mjOption& option);

/// What steps are made with: the fields that decide it, and what else is not MuJoCo's default.
std::vector<scene::VendorSetting> run_settings(const mjOption& option);

/// The fields that are not MuJoCo's defaults, sorted by name; without gravity and time step. What
/// the schema has no name for goes to `unnamed` in MuJoCo's words.
std::vector<scene::VendorSetting> settings_of(const mjOption& option,
                                              std::vector<std::string>& unnamed);

}  // namespace tenon::engines::mujoco
