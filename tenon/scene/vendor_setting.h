// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace tenon::scene {

/// An authored attribute of a vendor's schema that is for that vendor's engine alone. Lengths in
/// metres, masses in kilograms, MuJoCo's angles in radians.
struct VendorSetting {
  /// Without the prefix of the schema: "option:iterations" of mjc:, "solverType" of physxScene:.
  std::string name;
  std::vector<double> numbers;  ///< one for each component; flags 0 or 1
  std::string token;            ///< of settings that are words
};

}  // namespace tenon::scene
