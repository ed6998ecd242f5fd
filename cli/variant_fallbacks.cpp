// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/variant_fallbacks.h"

#include <sstream>

#include "cli/verb.h"
#include "tenon/base/assignment.h"

namespace tenon::cli {

Result<std::map<std::string, std::vector<std::string>>> parse_variant_fallbacks(
    const std::string& text) {
  std::map<std::string, std::vector<std::string>> fallbacks;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    TENON_TRY(const auto assignment, split_assignment(part));
    std::istringstream names(assignment.second);
    for (std::string name; std::getline(names, name, '|');) {
      fallbacks[assignment.first].push_back(name);
    }
  }
  return fallbacks;
}

}  // namespace tenon::cli
