// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Keys and units are two tables. A number without a unit has the dimension of its key.
#include "tenon/asset/drives/motor_specs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "tenon/base/text/comma_list.h"
#include "tenon/base/text/text_number.h"
#include "tenon/math/angle.h"
#include "tenon/settings/toml_file.h"

namespace tenon {
namespace {

using Dimension = SpecNumber::Dimension;

struct SpecUnit {
  std::string_view name;
  Dimension dimension;
  double size;
};
constexpr double kGravity = 9.80665;  // of kgf [m/s^2]
constexpr std::array kSpecUnits{
    SpecUnit{"N", Dimension::Force, 1},
    SpecUnit{"kgf", Dimension::Force, kGravity},
    SpecUnit{"N m", Dimension::Torque, 1},
    SpecUnit{"Nm", Dimension::Torque, 1},
    SpecUnit{"mN m", Dimension::Torque, 1e-3},
    SpecUnit{"mNm", Dimension::Torque, 1e-3},
    SpecUnit{"N cm", Dimension::Torque, 1e-2},
    SpecUnit{"Ncm", Dimension::Torque, 1e-2},
    SpecUnit{"kgf cm", Dimension::Torque, kGravity * 1e-2},
    SpecUnit{"kg cm", Dimension::Torque, kGravity * 1e-2},
    SpecUnit{"m", Dimension::Length, 1},
    SpecUnit{"cm", Dimension::Length, 1e-2},
    SpecUnit{"mm", Dimension::Length, 1e-3},
    SpecUnit{"m/s", Dimension::Speed, 1},
    SpecUnit{"mm/s", Dimension::Speed, 1e-3},
    SpecUnit{"deg/s", Dimension::TurnRate, kRadians},
    SpecUnit{"rad/s", Dimension::TurnRate, 1},
    SpecUnit{"rpm", Dimension::TurnRate, 2 * kPi / 60},
    SpecUnit{"A", Dimension::Current, 1},
    SpecUnit{"mA", Dimension::Current, 1e-3},
    SpecUnit{"N m/A", Dimension::TorquePerCurrent, 1},
    SpecUnit{"Nm/A", Dimension::TorquePerCurrent, 1},
    SpecUnit{"mN m/A", Dimension::TorquePerCurrent, 1e-3},
    SpecUnit{"mNm/A", Dimension::TorquePerCurrent, 1e-3},
};

struct SpecKey {
  std::string_view name;
  std::optional<SpecNumber> MotorSpec::* number = nullptr;
  double MotorSpec::* factor = nullptr;   // without a dimension, above 0
  std::array<Dimension, 2> dimensions{};  // that a unit may have; the first without one
};
constexpr std::array<Dimension, 2> only(Dimension one) { return {one, one}; }
const std::array kSpecKeys{
    SpecKey{"max_effort", &MotorSpec::max_effort, nullptr, {Dimension::Torque, Dimension::Force}},
    SpecKey{"tip_force", &MotorSpec::tip_force, nullptr, only(Dimension::Force)},
    SpecKey{"lever_arm", &MotorSpec::lever_arm, nullptr, only(Dimension::Length)},
    SpecKey{"tip"},
    SpecKey{"motor_torque", &MotorSpec::motor_torque, nullptr, only(Dimension::Torque)},
    SpecKey{"torque_constant", &MotorSpec::torque_constant, nullptr,
            only(Dimension::TorquePerCurrent)},
    SpecKey{"max_current", &MotorSpec::max_current, nullptr, only(Dimension::Current)},
    SpecKey{"gear_ratio", nullptr, &MotorSpec::gear_ratio},
    SpecKey{"efficiency", nullptr, &MotorSpec::efficiency},
    SpecKey{"chain_factor", nullptr, &MotorSpec::chain_factor},
    SpecKey{"max_speed", &MotorSpec::max_speed, nullptr, {Dimension::TurnRate, Dimension::Speed}},
    SpecKey{"motor_speed", &MotorSpec::motor_speed, nullptr, only(Dimension::TurnRate)},
};

Error spec_error(const settings::TomlValue& value, const char* rule, const std::string& message,
                 const std::string& fix) {
  return Error(ErrorCode::Invalid, message)
      .at(value.line, value.column)
      .with_rule(rule)
      .with_fix(fix);
}

std::string units_of(const SpecKey& key) {
  std::string names;
  for (const SpecUnit& unit : kSpecUnits) {
    if (std::find(key.dimensions.begin(), key.dimensions.end(), unit.dimension) !=
        key.dimensions.end()) {
      names += (names.empty() ? "" : ", ") + std::string(unit.name);
    }
  }
  return names;
}

/// "1.68 N m".
std::optional<SpecNumber> number_with_unit(std::string_view text) {
  const std::size_t end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos) {
    return std::nullopt;
  }
  std::string_view unit = text.substr(end + 1);
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  const std::optional<double> number = parse_double(text.substr(0, end + 1));
  const auto known = std::find_if(kSpecUnits.begin(), kSpecUnits.end(),
                                  [&](const SpecUnit& one) { return one.name == unit; });
  if (!number || known == kSpecUnits.end()) {
    return std::nullopt;
  }
  return SpecNumber{*number * known->size, known->dimension};
}

Result<SpecNumber> spec_number(const settings::TomlValue& value, const SpecKey& key) {
  SpecNumber number{value.number, Dimension::None};
  const std::string name(key.name);
  if (value.type == "string") {
    const std::optional<SpecNumber> read = number_with_unit(value.text);
    if (!read || std::find(key.dimensions.begin(), key.dimensions.end(), read->dimension) ==
                     key.dimensions.end()) {
      return spec_error(value, "drives.value",
                        name + " = \"" + value.text + "\" is no number with one of its units",
                        "write a number and one of " + units_of(key));
    }
    number = *read;
  } else if (value.type != "integer" && value.type != "float") {
    return spec_error(value, "drives.type", name + " is of type " + value.type + ", not a number",
                      "write a number, or a text with its unit: " + units_of(key));
  }
  // Files have single precision: what is larger would be no limit there.
  if (!(number.value > 0 && number.value <= std::numeric_limits<float>::max())) {
    return spec_error(value, "drives.value", name + " has to be a finite number above 0",
                      "give what the data sheet says");
  }
  return number;
}

Result<double> spec_factor(const settings::TomlValue& value, const SpecKey& key) {
  const std::string name(key.name);
  if (value.type != "integer" && value.type != "float") {
    return spec_error(value, "drives.type", name + " is of type " + value.type + ", not a number",
                      "write a number");
  }
  const bool share = key.factor == &MotorSpec::efficiency;
  if (!std::isfinite(value.number) || value.number <= 0 || (share && value.number > 1)) {
    return spec_error(value, "drives.value",
                      name + " = " + shortest(value.number) + " is no such factor",
                      share ? "an efficiency is above 0 and at most 1" : "give a number above 0");
  }
  return value.number;
}

Result<Path> tip_of(const settings::TomlValue& value) {
  auto path = Path::parse(value.type == "string" ? value.text : std::string());
  if (!path || !path->is_absolute()) {
    return spec_error(value, "drives.value", "tip is no path of a prim",
                      "write the path of the prim at the tip, \"/hand/thumb_tip\"");
  }
  return path;
}

std::string listed_keys() { return comma_list(kSpecKeys, &SpecKey::name); }

Result<void> add_spec(const settings::TomlValue& value, std::vector<MotorSpec>& specs) {
  if (value.path.size() != 2) {
    return spec_error(
        value, "drives.unknown-key", "\"" + value.path.front() + "\" is no table of a joint",
        "write a table for each joint or pattern: [thumb_joint], then keys: " + listed_keys());
  }
  const auto key = std::find_if(kSpecKeys.begin(), kSpecKeys.end(),
                                [&](const SpecKey& one) { return one.name == value.path[1]; });
  if (key == kSpecKeys.end()) {
    return spec_error(value, "drives.unknown-key", "unknown key \"" + value.path[1] + "\"",
                      "write one of " + listed_keys());
  }
  if (specs.empty() || specs.back().joints.text() != value.path[0]) {
    auto parsed = NamePattern::parse(value.path[0]);
    if (!parsed) {
      return std::move(parsed).error().at(value.line, value.column);
    }
    specs.push_back(MotorSpec{*std::move(parsed)});
    specs.back().line = value.line;
  }
  MotorSpec& spec = specs.back();
  if (key->number != nullptr) {
    TENON_TRY(spec.*(key->number), spec_number(value, *key));
  } else if (key->factor != nullptr) {
    TENON_TRY(spec.*(key->factor), spec_factor(value, *key));
  } else {
    TENON_TRY(spec.tip, tip_of(value));
  }
  return {};
}

}  // namespace

Result<std::vector<MotorSpec>> read_motor_specs(const std::string& file,
                                                const bytes::Files& files) {
  std::vector<MotorSpec> specs;
  TENON_CHECK(settings::each_toml_value(
      file, files, [&](const settings::TomlValue& value) { return add_spec(value, specs); }));
  return specs;
}

}  // namespace tenon
