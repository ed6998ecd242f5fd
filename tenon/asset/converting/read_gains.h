// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/bytes/files.h"
#include "tenon/convert/convert_robot.h"

namespace tenon {

/// Puts the drives' gains into `options`: `text` is "K,D" for all joints, "REGEX=K,D" for those
/// whose whole name a regular expression matches (convert/rules/name_rule.h), or the name of a JSON
/// file {"joint": [K, D], "*": [K, D]}, in N m/rad and N m s/rad (N/m and N s/m). Errors: Invalid.
Result<void> read_gains(const std::string& text, const bytes::Files& files,
                        convert::ConvertOptions& options);

/// Rules of the options as texts, each "VALUE" for all or "REGEX=VALUE".
struct RuleTexts {
  std::vector<std::string> gains;      ///< as read_gains has them
  std::vector<std::string> armature;   ///< [kg m^2 or kg]
  std::vector<std::string> friction;   ///< [N m or N]
  std::vector<std::string> collision;  ///< hull, decomposition, sphere or none; by link
};

/// Puts all of them into `options`. Errors: Invalid, for a text that is no rule.
Result<void> read_rules(const RuleTexts& texts, const bytes::Files& files,
                        convert::ConvertOptions& options);

}  // namespace tenon
