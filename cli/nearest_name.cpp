// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/nearest_name.h"

#include <algorithm>

#include "tenon/base/text/nearest_name.h"

namespace tenon::cli {
namespace {

constexpr std::size_t kLongestName = 64;  // nobody mistypes more; the table stays small

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](char c) { return lower(c); });
  return result;
}

}  // namespace

std::string nearest_name(std::string_view text, const std::vector<std::string>& names) {
  if (text.empty() || text.size() > kLongestName) {
    return {};
  }
  const std::string typed = lower(text);
  const std::size_t allowed = typed.size() < 3 ? 1 : 1 + typed.size() / 4;
  std::string nearest;
  std::size_t least = allowed + 1;
  for (const std::string& name : names) {
    const std::string candidate = lower(name);
    const bool begun = typed.size() >= 2 && candidate.starts_with(typed);
    const std::size_t distance = begun ? 1 : edit_distance(typed, candidate);
    if (distance < least && distance < std::max(typed.size(), candidate.size())) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

std::string did_you_mean(std::string_view text, const std::vector<std::string>& names,
                         const std::string& otherwise) {
  const std::string nearest = nearest_name(text, names);
  return nearest.empty() ? otherwise : "did you mean \"" + nearest + "\"?";
}

}  // namespace tenon::cli
