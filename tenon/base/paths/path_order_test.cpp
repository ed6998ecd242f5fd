// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/paths/path_order.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace tenon {
namespace {

/// What path_order() is the fast form of.
std::vector<std::uint32_t> sorted(std::span<const Path> paths) {
  std::vector<std::uint32_t> order(paths.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return paths[a] < paths[b]; });
  return order;
}

/// Names of all lengths around eight bytes, of few letters so that many begin alike.
Token random_name(std::mt19937& random) {
  static const char kLetters[] = "aab_Z";
  std::string name(1 + random() % 12, 'x');
  for (char& letter : name) {
    letter = kLetters[random() % 5];
  }
  return Token(name + (random() % 3 == 0 ? "\xC3\xA4" : ""));
}

Path random_below(Path path, std::mt19937& random) {
  switch (random() % 6) {
    case 0:
      return path.is_prim_or_variant() ? path.variant_selection(random_name(random), "v") : path;
    case 1:
      return path.is_prim_or_variant() ? path.property(random_name(random)) : path;
    case 2:
      return path.kind() == PathKind::Property
                 ? path.target_element(Path::absolute_root().child(random_name(random)))
                 : path;
    case 3:
      return path.is_target() ? path.property(random_name(random)) : path;
    default:
      return path.is_prim_or_root() || path.is_variant_selection() ? path.child(random_name(random))
                                                                   : path;
  }
}

TEST(PathOrder, IsThatOfASortByPath) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    std::vector<Path> paths{Path::absolute_root(), Path()};
    const int count = round * 20;
    for (int i = 0; i < count; ++i) {
      const bool relative = random() % 20 == 0;
      const Path above = relative ? Path::relative_root() : paths[random() % paths.size()];
      paths.push_back(random_below(above.empty() ? Path::absolute_root() : above, random));
    }
    std::shuffle(paths.begin(), paths.end(), random);
    EXPECT_EQ(path_order(paths), sorted(paths)) << round;
    // Parents that are not listed have their place all the same.
    paths.resize(paths.size() / 2);
    EXPECT_EQ(path_order(paths), sorted(paths)) << round;
  }
}

TEST(PathOrder, TakesNoPathsAndDeepOnes) {
  EXPECT_TRUE(path_order({}).empty());
  std::vector<Path> deep{Path::absolute_root()};
  for (int i = 0; i < 20000; ++i) {
    deep.push_back(deep.back().child("a"));
  }
  std::reverse(deep.begin(), deep.end());
  const std::vector<std::uint32_t> order = path_order(deep);
  ASSERT_EQ(order.size(), deep.size());
  EXPECT_EQ(order.front(), 20000u);
  EXPECT_EQ(order.back(), 0u);
}

}  // namespace
}  // namespace tenon
