// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/paths/path_table.h"

#include <random>
#include <string>
#include <unordered_map>

#include <gtest/gtest.h>

namespace tenon {
namespace {

Path numbered(std::size_t family, std::size_t child) {
  return Path::absolute_root()
      .child(Token("family" + std::to_string(family)))
      .child(Token("child" + std::to_string(child)));
}

TEST(PathTable, AnswersLikeAMap) {
  PathTable<unsigned> table;
  std::unordered_map<Path, unsigned> map;
  EXPECT_EQ(table.find(Path::absolute_root()), nullptr);
  std::mt19937 random(7);
  for (unsigned i = 0; i < 5000; ++i) {
    const Path path = numbered(random() % 40, random() % 60);
    table[path] = i;
    map[path] = i;
  }
  EXPECT_EQ(table.size(), map.size());
  for (std::size_t family = 0; family < 41; ++family) {
    for (std::size_t child = 0; child < 60; ++child) {
      const Path path = numbered(family, child);
      const auto expected = map.find(path);
      const unsigned* found = table.find(path);
      ASSERT_EQ(found != nullptr, expected != map.end()) << path.str();
      EXPECT_TRUE(found == nullptr || *found == expected->second) << path.str();
    }
  }
}

}  // namespace
}  // namespace tenon
