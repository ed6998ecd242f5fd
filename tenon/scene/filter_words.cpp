// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/scene/filter_words.h"

#include <utility>

namespace tenon::scene {

std::set<std::string> pair_words(const Side& side,
                                 const std::vector<std::pair<Index, Index>>& pairs) {
  std::set<std::string> names;
  for (const auto& [a, b] : pairs) {
    std::string first = side.path(List::Colliders, a).str();
    std::string second = side.path(List::Colliders, b).str();
    if (second < first) {
      std::swap(first, second);
    }
    names.insert(first + " and " + second);
  }
  return names;
}

std::set<std::string> group_words(const Side& side) {
  const auto& [members, groups, pair_off, ungrouped_off, pairs, permanent, joints] =
      side.scene.filter;
  std::set<std::string> words;
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (const Index group : members[i]) {
      words.insert(side.path(List::Colliders, static_cast<Index>(i)).str() + " in " +
                   groups[group].str());
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (std::size_t h = 0; h < groups.size(); ++h) {
      if (pair_off[g * groups.size() + h] != 0) {
        words.insert(groups[g].str() + " apart from " + groups[h].str());
      }
    }
    if (ungrouped_off[g] != 0) {
      words.insert(groups[g].str() + " apart from what is in no group");
    }
  }
  return words;
}

std::set<std::string> joint_pair_words(const Side& side) {
  std::set<std::string> words;
  for (const JointPairs& of : side.scene.filter.joint_pairs) {
    for (const std::string& name : pair_words(side, of.pairs)) {
      words.insert(name + " by " + side.path(List::Joints, of.joint).str());
    }
  }
  return words;
}

}  // namespace tenon::scene
