// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/asset/tuning/gain_wishes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "tenon/base/text/text_number.h"
#include "tenon/math/angle.h"
#include "tenon/settings/toml_file.h"

namespace tenon {
namespace {

constexpr double kMostHertz = 1e9;  ///< beyond it, gains have no place in single precision

struct WishKey {
  std::string_view name;
  std::optional<double> GainWish::* member;
};

constexpr std::array kWishKeys{
    WishKey{"frequency", &GainWish::frequency},
    WishKey{"damping_ratio", &GainWish::damping_ratio},
    WishKey{"stiffness", &GainWish::stiffness},
    WishKey{"damping", &GainWish::damping},
};

Error wish_error(const settings::TomlValue& value, const char* rule, const std::string& message,
                 const char* fix) {
  return Error(ErrorCode::Invalid, message)
      .at(value.line, value.column)
      .with_rule(rule)
      .with_fix(fix);
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && text.front() == ' ') {
    text.remove_prefix(1);
  }
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text;
}

Result<double> wish_number(const settings::TomlValue& value, std::string_view key) {
  const bool is_frequency = key == "frequency";
  if (is_frequency && value.type == "string") {
    auto frequency = frequency_named(value.text);
    return frequency ? std::move(frequency)
                     : std::move(frequency).error().at(value.line, value.column);
  }
  if (value.type != "integer" && value.type != "float") {
    return wish_error(value, "tune.type",
                      std::string(key) + " is of type " + value.type + ", not a number",
                      "write a number; a frequency may be a text with its unit, \"10 Hz\"");
  }
  const double most = is_frequency ? kMostHertz : std::numeric_limits<float>::max();
  if (!(value.number >= 0 && value.number <= most) || (is_frequency && value.number == 0)) {
    return wish_error(value, "tune.value",
                      std::string(key) + " = " + shortest(value.number) + " is no such number",
                      "give a finite number, 0 or more; of frequencies above 0, up to 1e9 Hz");
  }
  return is_frequency ? value.number * 2 * kPi : value.number;
}

Result<void> add_wish(const settings::TomlValue& value, std::vector<PatternWish>& wishes) {
  constexpr const char* kForm =
      "write a table for each joint or pattern: [thumb_joint], then frequency = 10 and "
      "damping_ratio = 1, or stiffness and damping";
  if (value.path.size() != 2) {
    return wish_error(value, "tune.unknown-key",
                      "\"" + value.path.front() + "\" is no table of a joint", kForm);
  }
  const auto key = std::find_if(kWishKeys.begin(), kWishKeys.end(),
                                [&](const WishKey& one) { return one.name == value.path[1]; });
  if (key == kWishKeys.end()) {
    return wish_error(value, "tune.unknown-key", "unknown key \"" + value.path[1] + "\"",
                      "write frequency, damping_ratio, stiffness or damping");
  }
  TENON_TRY(const double number, wish_number(value, key->name));
  const std::string& pattern = value.path[0];
  if (wishes.empty() || wishes.back().joints.text() != pattern) {
    auto parsed = NamePattern::parse(pattern);
    if (!parsed) {
      return std::move(parsed).error().at(value.line, value.column);
    }
    wishes.push_back({*std::move(parsed), {}, value.line});
  }
  GainWish& wish = wishes.back().wish;
  wish.*(key->member) = number;
  if ((wish.frequency && wish.stiffness) || (wish.damping_ratio && wish.damping)) {
    return wish_error(value, "tune.value",
                      "a frequency and a stiffness, or a ratio and a damping, say the same twice",
                      "leave one of both out");
  }
  return {};
}

}  // namespace

Result<double> frequency_named(const std::string& text) {
  std::string_view number = without_blanks(text);
  double unit = 2 * kPi;
  for (const auto& [name, radians] : {std::pair<std::string_view, double>{"Hz", 2 * kPi},
                                      std::pair<std::string_view, double>{"rad/s", 1.0}}) {
    if (number.ends_with(name)) {
      number = without_blanks(number.substr(0, number.size() - name.size()));
      unit = radians;
      break;
    }
  }
  const auto value = parse_double(number);
  if (!value || !(*value > 0 && *value * unit <= kMostHertz * 2 * kPi)) {
    return Error(ErrorCode::Invalid, "\"" + text + "\" is not a frequency above 0, up to 1e9 Hz")
        .with_rule("usage.value")
        .with_fix("write 10, 10Hz or 62.8rad/s");
  }
  return *value * unit;
}

Result<std::vector<PatternWish>> read_gain_file(const std::string& file,
                                                const bytes::Files& files) {
  std::vector<PatternWish> wishes;
  TENON_CHECK(settings::each_toml_value(
      file, files, [&](const settings::TomlValue& value) { return add_wish(value, wishes); }));
  return wishes;
}

}  // namespace tenon
