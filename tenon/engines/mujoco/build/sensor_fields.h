// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/engines/mujoco/mujoco_library.h"
#include "tenon/scene/vendor_setting.h"

namespace tenon::engines::mujoco {

/// The element of a kind of sensor ("framepos"), and back; none: MuJoCo has no such sensor.
std::string sensor_word(mjtSensor kind);
std::optional<mjtSensor> sensor_kind(std::string_view word);

/// MuJoCo's word for a kind of thing ("site", "xbody"), and back. mjOBJ_UNKNOWN: "".
std::string thing_word(mjtObj kind);
mjtObj thing_kind(const std::string& word);

/// MuJoCo's word for the shape of a site ("sphere", "box"), and back; empty, none: it is none.
std::string site_shape_word(int type);
std::optional<mjtGeom> site_shape(std::string_view word);

/// All numbers of a sensor that are not MuJoCo's defaults, by the names that mjsSensor has.
std::vector<scene::VendorSetting> sensor_settings(const mjsSensor& sensor);
/// Sets a number that `sensor_settings` names; false: it has none of that name and length.
bool set_sensor_numbers(mjsSensor& sensor, std::string_view name,
                        const std::vector<double>& numbers);

}  // namespace tenon::engines::mujoco
