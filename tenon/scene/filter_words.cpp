// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Filters in words are equal where the filters are, however their sets and groups are numbered: a
// word for each pair of colliders. Where there were too many, a list of colliders or groups is one
// word with a hash of its paths, and sets that mean the same pairs in another way then differ.
#include "tenon/scene/filter_words.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "tenon/base/content_digest.h"
#include "tenon/scene/filter_sets.h"

namespace tenon::scene {
namespace {

/// So many are told one by one; more by a number for all of them.
constexpr std::size_t kOneByOne = 200'000;

/// Lists of paths as words, whatever their order.
class ListWords {
 public:
  explicit ListWords(const std::vector<Path>& paths) {
    for (const Path path : paths) {
      hashes_.push_back(content_digest(path.str()));
    }
  }

  std::string operator()(const std::vector<Index>& list) const {
    std::uint64_t sum = 0;
    for (const Index i : list) {
      sum += hashes_[i];
    }
    return std::to_string(list.size()) + " (" + std::to_string(sum) + ")";
  }

 private:
  std::vector<std::uint64_t> hashes_;
};

std::vector<Path> collider_paths(const Side& side) {
  std::vector<Path> paths;
  for (Index i = 0; i < side.scene.colliders.size(); ++i) {
    paths.push_back(side.path(List::Colliders, i));
  }
  return paths;
}

std::string both(std::string first, std::string second) {
  if (second < first) {
    std::swap(first, second);
  }
  return first + " and " + second;
}

std::string pair_word(const Side& side, Index a, Index b) {
  return both(side.path(List::Colliders, a).str(), side.path(List::Colliders, b).str());
}

/// Pairs of sets as words.
class SetWords {
 public:
  explicit SetWords(const Side& side)
      : side_(side), members_(members_of_sets(side.scene.filter)), sets_(members_.size()) {}

  void add(const SetPairs& off, const std::string& more, std::set<std::string>& words) {
    std::size_t count = 0;
    for (const auto& [a, b] : off) {
      count += members_[a].size() * members_[b].size();
    }
    for (const auto& [a, b] : off) {
      if (count > kOneByOne) {
        words.insert(both("colliders " + of_set(a), of_set(b)) + more);
      } else {
        add_pairs(members_[a], members_[b], more, words);
      }
    }
  }

 private:
  void add_pairs(const std::vector<Index>& a, const std::vector<Index>& b, const std::string& more,
                 std::set<std::string>& words) const {
    const std::vector<Collider>& colliders = side_.scene.colliders;
    for (const Index i : a) {
      for (const Index j : b) {
        if (colliders[i].body != colliders[j].body) {
          words.insert(pair_word(side_, i, j) + more);
        }
      }
    }
  }
  const std::string& of_set(Index set) {
    if (!lists_) {
      lists_.emplace(collider_paths(side_));
    }
    if (sets_[set].empty()) {
      sets_[set] = (*lists_)(members_[set]);
    }
    return sets_[set];
  }

  const Side& side_;
  std::vector<std::vector<Index>> members_;
  std::vector<std::string> sets_;  // empty: not asked for yet
  std::optional<ListWords> lists_;
};

/// "/A apart from /B".
void add_apart(const std::vector<Path>& groups, const std::vector<char>& pair_off,
               std::set<std::string>& words) {
  const auto count =
      std::count_if(pair_off.begin(), pair_off.end(), [](char off) { return off != 0; });
  const bool one_by_one = static_cast<std::size_t>(count) <= kOneByOne;
  const ListWords lists(one_by_one ? std::vector<Path>() : groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<Index> others;
    for (std::size_t h = 0; h < groups.size(); ++h) {
      if (pair_off[g * groups.size() + h] != 0) {
        others.push_back(static_cast<Index>(h));
      }
    }
    if (!one_by_one) {
      words.insert(groups[g].str() + " apart from groups " + lists(others));
      continue;
    }
    for (const Index h : others) {
      words.insert(groups[g].str() + " apart from " + groups[h].str());
    }
  }
}

}  // namespace

std::optional<std::set<std::string>> disabled_pair_words(const Side& side) {
  const ColliderPairs pairs = side.scene.disabled_pairs();
  if (pairs.is_cut || pairs.pairs.size() > kOneByOne) {
    return std::nullopt;
  }
  std::set<std::string> words;
  for (const auto& [a, b] : pairs.pairs) {
    words.insert(pair_word(side, a, b));
  }
  return words;
}

std::set<std::string> set_pair_words(const Side& side, const SetPairs& off) {
  std::set<std::string> words;
  SetWords(side).add(off, "", words);
  return words;
}

std::set<std::string> group_words(const Side& side) {
  const auto& [members, groups, pair_off, ungrouped_off, sets, off, permanent, joints] =
      side.scene.filter;
  std::set<std::string> words;
  std::vector<std::vector<Index>> of_group(groups.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (const Index group : members[i]) {
      of_group[group].push_back(static_cast<Index>(i));
      ++count;
    }
  }
  const ListWords lists(count > kOneByOne ? collider_paths(side) : std::vector<Path>());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (count > kOneByOne) {
      words.insert("colliders " + lists(of_group[g]) + " in " + groups[g].str());
    } else {
      for (const Index i : of_group[g]) {
        words.insert(side.path(List::Colliders, i).str() + " in " + groups[g].str());
      }
    }
    if (ungrouped_off[g] != 0) {
      words.insert(groups[g].str() + " apart from what is in no group");
    }
  }
  add_apart(groups, pair_off, words);
  return words;
}

std::set<std::string> joint_pair_words(const Side& side) {
  SetWords sets(side);
  std::set<std::string> words;
  for (const JointPairs& of : side.scene.filter.joint_pairs) {
    sets.add(of.sets, " by " + side.path(List::Joints, of.joint).str(), words);
  }
  return words;
}

}  // namespace tenon::scene
