// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace tenon {

/// The numbers 0..count-1 in sets without common members; each begins in a set of its own.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : above_(count) {
    std::iota(above_.begin(), above_.end(), std::size_t{0});
  }
  /// The representative of the set of `i`.
  std::size_t find(std::size_t i) {
    while (above_[i] != i) {
      above_[i] = above_[above_[i]];
      i = above_[i];
    }
    return i;
  }
  /// Joins two sets under the representative of the set of `b`. False when they were one already.
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    above_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> above_;  // (count) towards the representative of the set
};

}  // namespace tenon
