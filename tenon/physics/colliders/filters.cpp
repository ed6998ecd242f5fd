// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Groups with the same merge name have their members and their filters in common (S-79): what one
// of them says, all say. An inverted group turns off all groups but those that it names itself
// (S-78).
#include "tenon/physics/colliders/filters.h"

#include <map>

namespace tenon::physics {
namespace {

/// Groups that act as one: by merge name, each unnamed group alone.
std::vector<std::vector<Index>> merged(const std::vector<AuthoredGroup>& groups) {
  std::vector<std::vector<Index>> sets;
  std::map<std::string, std::size_t> by_name;
  for (Index i = 0; i < groups.size(); ++i) {
    if (groups[i].merge.empty()) {
      sets.push_back({i});
      continue;
    }
    const auto added = by_name.emplace(groups[i].merge, sets.size());
    if (added.second) {
      sets.emplace_back();
    }
    sets[added.first->second].push_back(i);
  }
  return sets;
}

}  // namespace

GroupTable group_table(const std::vector<AuthoredGroup>& groups, Ungrouped ungrouped) {
  const std::size_t count = groups.size();
  GroupTable table{std::vector<char>(count * count, 0), std::vector<char>(count, 0)};
  const std::vector<std::vector<Index>> sets = merged(groups);
  std::vector<std::size_t> set_of(count, 0);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (const Index i : sets[s]) {
      set_of[i] = s;
    }
  }
  std::vector<char> sets_off(sets.size() * sets.size(), 0);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<char> named(sets.size(), 0);
    for (const Index target : groups[i].filtered) {
      named[set_of[target]] = 1;
    }
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if ((named[s] != 0) != groups[i].inverted) {
        sets_off[set_of[i] * sets.size() + s] = 1;
        sets_off[s * sets.size() + set_of[i]] = 1;
      }
    }
    if (groups[i].inverted && ungrouped == Ungrouped::Off) {
      for (const Index j : sets[set_of[i]]) {
        table.ungrouped_off[j] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      table.pair_off[i * count + j] = sets_off[set_of[i] * sets.size() + set_of[j]];
    }
  }
  return table;
}

}  // namespace tenon::physics
