// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/base/text/name_pattern.h"
#include "tenon/bytes/files.h"

namespace tenon {

/// A number with the dimension that its unit says.
struct SpecNumber {
  enum class Dimension : unsigned char {
    None,
    Force,
    Torque,
    Length,
    Speed,
    TurnRate,
    Current,
    TorquePerCurrent
  };
  double value = 0;  ///< SI; of Dimension::None as it is written
  Dimension dimension = Dimension::None;
};

/// What a data sheet says of the motors of some joints. Efforts are in N m of joints that turn, in
/// N of joints that slide.
struct MotorSpec {
  NamePattern joints;
  std::uint32_t line = 0;
  std::optional<SpecNumber> max_effort{};    ///< of the joint itself
  std::optional<SpecNumber> tip_force{};     ///< [N], with lever_arm or tip
  std::optional<SpecNumber> lever_arm{};     ///< [m]
  std::optional<Path> tip{};                 ///< a prim: the lever arm is its distance to the axis
  std::optional<SpecNumber> motor_torque{};  ///< [N m], with gear_ratio
  std::optional<SpecNumber> torque_constant{};  ///< [N m/A], with max_current
  std::optional<SpecNumber> max_current{};      ///< [A]
  double gear_ratio = 1;                        ///< motor speed to joint speed
  double efficiency = 1;                        ///< of the gear
  double chain_factor = 1;  ///< joints that share the effort at the tip: of a mimic chain
  std::optional<SpecNumber> max_speed{};    ///< of the joint; without unit degrees/s or m/s
  std::optional<SpecNumber> motor_speed{};  ///< [rad/s], with gear_ratio
};

/// A file of them, TOML: a table for each path, name or regular expression of joints. Numbers are
/// SI, speeds that turn degrees/s; texts name their unit: "1.68 N m", "84 mm", "260 deg/s".
/// Errors: those of opening the file and of settings::toml_values; Limit above
/// limits::kSettingsBytes; Invalid (drives.unknown-key, drives.type, drives.value) with the line.
Result<std::vector<MotorSpec>> read_motor_specs(const std::string& file, const bytes::Files& files);

}  // namespace tenon
