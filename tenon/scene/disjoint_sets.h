// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <numeric>
#include <vector>

namespace tenon::scene {

/// The numbers 0..count-1 in sets without common members; each begins in a set of its own.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : above_(count) {
    std::iota(above_.begin(), above_.end(), std::size_t{0});
  }
  /// The member that stands for the whole set of `i`.
  std::size_t find(std::size_t i) {
    while (above_[i] != i) {
      above_[i] = above_[above_[i]];
      i = above_[i];
    }
    return i;
  }
  /// Makes one set of two; the member that stands for the set of `b` stands for it. False when they
  /// were one already.
  bool join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    above_[a] = b;
    return a != b;
  }

 private:
  std::vector<std::size_t> above_;  // (count) towards the member that stands for the set
};

}  // namespace tenon::scene
