// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A rule is split at its last '=', since names and expressions may have one and values have none.
// What is neither K,D nor a rule with K,D behind it is the name of a file.
#include "tenon/asset/converting/read_gains.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>

#include "tenon/answers/json.h"
#include "tenon/base/limits/reading_limits.h"
#include "tenon/base/text/text_number.h"
#include "tenon/bytes/file_bytes.h"

namespace tenon {
namespace {

using answers::Json;

/// Files have single precision: what is larger would be infinite there.
bool is_gain(double value) { return value >= 0 && value <= std::numeric_limits<float>::max(); }

/// "K,D", both numbers.
std::optional<convert::Gains> gains_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) {
    return std::nullopt;
  }
  const auto stiffness = parse_double(text.substr(0, comma));
  const auto damping = parse_double(text.substr(comma + 1));
  if (!stiffness || !damping || !is_gain(*stiffness) || !is_gain(*damping)) {
    return std::nullopt;
  }
  return convert::Gains{*stiffness, *damping};
}

/// A JSON object: joint -> [K, D], "*" for all others.
Result<void> read_gains_file(const std::string& path, const bytes::Files& files,
                             convert::ConvertOptions& options) {
  const auto fault = [&](const std::string& message) {
    return Error(ErrorCode::Invalid, message)
        .in_file(path)
        .with_fix("write {\"joint\": [K, D], \"*\": [K, D]} in N m/rad and N m s/rad");
  };
  bytes::FileRules rules;
  rules.max_bytes = limits::kJsonFileBytes;
  const auto file = files->open(path, rules);
  if (!file && file.error().code() == ErrorCode::Limit) {
    return file.error();
  }
  if (!file) {
    return fault("the gains \"" + path +
                 "\" are neither two numbers K,D, nor REGEX=K,D, nor a file that can be read");
  }
  TENON_TRY(const Json json, answers::parsed_file((*file)->text(), [&](const std::string& why) {
              return fault("the gains file cannot be read: " + why);
            }));
  if (!json.is_object() || json.empty()) {
    return fault("the gains file is not a JSON object with a joint, or \"*\" for all");
  }
  for (const auto& [name, pair] : json.items()) {
    const bool sound = pair.is_array() && pair.size() == 2 && pair[0].is_number() &&
                       pair[1].is_number() && is_gain(pair[0].get<double>()) &&
                       is_gain(pair[1].get<double>());
    if (!sound) {
      return fault("the gains of \"" + name + "\" are not two finite numbers of 0 or more");
    }
    const convert::Gains gains{pair[0].get<double>(), pair[1].get<double>()};
    if (name == "*") {
      options.gains = gains;
    } else {
      options.joint_gains[name] = gains;
    }
  }
  return {};
}

/// Split at the last '=', which no value has; without one for all.
struct RuleText {
  std::string pattern;
  std::string value;
};

RuleText split_rule(const std::string& text) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0) {
    return {"", text};
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

Error bad_rule(const char* name, const std::string& text, const char* values) {
  return Error(ErrorCode::Invalid, std::string(name) + " \"" + text + "\" is neither VALUE nor " +
                                       "REGEX=VALUE, where VALUE is " + values)
      .with_rule("convert.bad-rule")
      .with_fix(std::string("write for example 'finger_.*=") +
                (values[0] == 'o' ? "decomposition'" : "0.01'"));
}

Result<void> read_numbers(const char* name, const std::vector<std::string>& texts,
                          std::vector<convert::NameRule<double>>& rules) {
  for (const std::string& text : texts) {
    const RuleText rule = split_rule(text);
    const auto value = parse_double(rule.value);
    if (!value || !std::isfinite(*value) || *value < 0) {
      return bad_rule(name, text, "a number, 0 or more");
    }
    rules.push_back({rule.pattern, *value});
  }
  return {};
}

Result<void> read_collision(const std::vector<std::string>& texts,
                            std::vector<convert::NameRule<robot::Approximation>>& rules) {
  using robot::Approximation;
  struct Row {
    std::string_view name;
    Approximation value;
  };
  constexpr Row kRows[] = {{"hull", Approximation::Hull},
                           {"decomposition", Approximation::Decomposition},
                           {"sphere", Approximation::Sphere},
                           {"none", Approximation::None}};
  for (const std::string& text : texts) {
    const RuleText rule = split_rule(text);
    const auto* row = std::find_if(std::begin(kRows), std::end(kRows),
                                   [&](const Row& one) { return one.name == rule.value; });
    if (row == std::end(kRows)) {
      return bad_rule("collision", text, "one of hull, decomposition, sphere, none");
    }
    rules.push_back({rule.pattern, row->value});
  }
  return {};
}

}  // namespace

Result<void> read_gains(const std::string& text, const bytes::Files& files,
                        convert::ConvertOptions& options) {
  if (const auto all = gains_of(text)) {
    options.gains = all;
    return {};
  }
  const RuleText rule = split_rule(text);
  if (const auto some = gains_of(rule.value); some && !rule.pattern.empty()) {
    options.gain_rules.push_back({rule.pattern, *some});
    return {};
  }
  return read_gains_file(text, files, options);
}

Result<void> read_rules(const RuleTexts& texts, const bytes::Files& files,
                        convert::ConvertOptions& options) {
  for (const std::string& text : texts.gains) {
    TENON_CHECK(read_gains(text, files, options));
  }
  TENON_CHECK(read_numbers("armature", texts.armature, options.armature));
  TENON_CHECK(read_numbers("friction", texts.friction, options.friction));
  return read_collision(texts.collision, options.collision);
}

}  // namespace tenon
