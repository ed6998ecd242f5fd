// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <utility>

namespace tenon {

/// "a, b, c": the items, or of each what `text` returns, a function or a member.
template <typename Items, typename Text = std::identity>
std::string comma_list(const Items& items, Text text = {}) {
  std::string list;
  const char* separator = "";
  for (const auto& item : items) {
    list += std::exchange(separator, ", ");
    list += std::invoke(text, item);
  }
  return list;
}

}  // namespace tenon
