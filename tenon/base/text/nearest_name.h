// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tenon/base/token.h"

namespace tenon {

/// Letters to insert, delete, exchange or swap with their neighbour to make one of the other. The
/// work is the product of the lengths: bound them first.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name that `name` was most likely meant to be: at most two edits away (one for short names),
/// or different only in capitals; empty when there is none, or when `name` is one of them.
std::string_view nearest_name(std::string_view name, const std::vector<std::string_view>& names);

/// The same for many names against one list: each is looked for once, and no more than a thousand
/// of them, since the search is long.
class NearestNames {
 public:
  /// `names` is called when a name is looked for first.
  explicit NearestNames(std::function<std::vector<std::string_view>()> names)
      : make_names_(std::move(names)) {}
  std::string_view find(Token name);

 private:
  std::function<std::vector<std::string_view>()> make_names_;  ///< empty: they are made
  std::vector<std::string_view> names_;
  std::unordered_map<Token, std::string_view> found_;
};

}  // namespace tenon
