// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace tenon {

/// Names that are given once. The same calls give the same names.
class UniqueNames {
 public:
  /// `wanted`, with "_1", "_2" and so on behind it where that is taken.
  std::string make(const std::string& wanted) {
    std::string name = wanted;
    while (!taken_.insert(name).second) {
      name = wanted + "_" + std::to_string(++last_[wanted]);
    }
    return name;
  }
  void take(const std::string& name) { taken_.insert(name); }
  bool is_taken(const std::string& name) const { return taken_.contains(name); }

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::size_t> last_;  // number behind a name
};

}  // namespace tenon
