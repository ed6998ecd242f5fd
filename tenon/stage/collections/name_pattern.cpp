// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/collections/name_pattern.h"

#include <cstddef>

namespace tenon::stage {
namespace {

// '[' set ']' at the head of `pattern`: whether `c` is in it, and its length (0: no set).
struct SetMatch {
  bool matches = false;
  std::size_t length = 0;
};

SetMatch match_set(std::string_view pattern, char c) {
  const std::size_t end = pattern.find(']', 1);
  if (pattern.empty() || pattern[0] != '[' || end == std::string_view::npos) {
    return {};
  }
  SetMatch result{false, end + 1};
  for (std::size_t i = 1; i < end; ++i) {
    if (i + 2 < end && pattern[i + 1] == '-') {
      result.matches = result.matches || (pattern[i] <= c && c <= pattern[i + 2]);
      i += 2;
    } else {
      result.matches = result.matches || pattern[i] == c;
    }
  }
  return result;
}

}  // namespace

// Greedy with one point to come back to.
bool name_matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (n < name.size()) {
    const char head = p < pattern.size() ? pattern[p] : '\0';
    const SetMatch set = match_set(pattern.substr(p), name[n]);
    const bool one = set.length > 0 ? set.matches : head == '?' || head == name[n];
    if (head == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && one) {
      p += set.length > 0 ? set.length : 1;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') {
    ++p;
  }
  return p == pattern.size();
}

}  // namespace tenon::stage
