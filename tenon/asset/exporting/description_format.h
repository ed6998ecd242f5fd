// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/result.h"

namespace tenon {

/// What an asset becomes for other programs (docs/ways-out.md).
enum class DescriptionFormat : std::uint8_t {
  Mjcf,
  Urdf,
  Sdf,
  Srdf,
  Ros2Control,  ///< URDF with a <ros2_control> block
  IsaacLab,     ///< Python: an ArticulationCfg
  Mjlab,        ///< Python and MJCF: an EntityCfg
};

/// "mjcf", "urdf", "sdf", "srdf", "ros2_control", "isaaclab", "mjlab".
std::string_view description_format_name(DescriptionFormat format);
/// As people read it: "MJCF" ... "a configuration of Isaac Lab".
std::string_view description_format_title(DescriptionFormat format);
std::vector<std::string> description_format_names();

/// Whether any format is written to files with this ending.
bool is_description(const std::string& output);

/// The format called `name`, or without a name the one of the ending. Errors: Unsupported for an
/// ending that none has; Invalid "convert.format" for a name whose files end otherwise, and for
/// .py without a name, as two have it.
Result<DescriptionFormat> description_format(const std::string& output, const std::string& name);

}  // namespace tenon
