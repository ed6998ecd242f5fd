// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/paths/path_numbers.h"

#include <random>
#include <string>
#include <unordered_map>
#include <vector>

#include <gtest/gtest.h>

namespace tenon {
namespace {

/// Things with paths, and the numbers of them.
struct Things {
  std::vector<Path> paths;
  PathNumbers numbers;

  auto path_of() const {
    return [this](std::uint32_t number) { return paths[number - 1]; };
  }
  std::uint32_t find(Path path) const { return numbers.find(path, path_of()); }
  std::uint32_t add(Path path) {
    paths.push_back(path);
    const auto number = static_cast<std::uint32_t>(paths.size());
    numbers.put(path, number, path_of());
    return number;
  }
};

Path child(std::size_t family, std::size_t number) {
  return Path::absolute_root()
      .child(Token("numbered" + std::to_string(family)))
      .child(Token("child" + std::to_string(number)));
}

TEST(PathNumbers, AnswersLikeAMap) {
  Things things;
  std::unordered_map<Path, std::uint32_t> map;
  std::mt19937 random(11);
  for (int i = 0; i < 4000; ++i) {
    Path path = child(random() % 40, random() % 60);
    path = random() % 3 == 0 ? path.property(Token("size")) : path;
    map[path] = things.add(path);  // the last one counts
  }
  for (std::size_t family = 0; family < 41; ++family) {
    for (std::size_t number = 0; number < 60; ++number) {
      const Path path = child(family, number);
      for (const Path each : {path, path.property(Token("size"))}) {
        const auto expected = map.find(each);
        EXPECT_EQ(things.find(each), expected == map.end() ? 0 : expected->second) << each.str();
      }
    }
  }
  EXPECT_EQ(things.find(Path()), 0u);
}

TEST(PathNumbers, HasNothingAtFirst) {
  const Things things;
  EXPECT_EQ(things.find(Path::absolute_root()), 0u);
  EXPECT_EQ(things.find(Path()), 0u);
}

/// A path without a number can be looked up.
TEST(PathNumbers, FindsOrPuts) {
  Things things;
  for (std::size_t i = 0; i < 3000; ++i) {
    const Path path = child(i % 7 * 1000, i % 1500);
    const auto next = static_cast<std::uint32_t>(things.paths.size() + 1);
    const std::uint32_t number = things.numbers.find_or_put(path, next, things.path_of());
    if (number == next) {
      things.paths.push_back(path);
    }
    EXPECT_EQ(things.paths[number - 1], path);
    EXPECT_EQ(things.find(path), number);
  }
}

/// Things that are gone are not found, take no room once the table grows, and may come again.
TEST(PathNumbers, ForgetsWhatIsGone) {
  Things things;
  for (std::size_t i = 0; i < 1000; ++i) {
    const std::uint32_t number = things.add(child(3, i % 4));
    EXPECT_EQ(things.find(child(3, i % 4)), number);
    things.paths[number - 1] = Path();
    EXPECT_EQ(things.find(child(3, i % 4)), 0u);
  }
  EXPECT_EQ(things.find(Path()), 0u);
}

TEST(PathNumbers, KeepsWhatIsThereWhenRoomIsMade) {
  Things things;
  things.add(child(0, 0));
  things.numbers.reserve(10000, things.path_of());
  EXPECT_EQ(things.find(child(0, 0)), 1u);
  EXPECT_EQ(things.find(child(0, 1)), 0u);
  EXPECT_EQ(things.add(child(0, 1)), 2u);
  EXPECT_EQ(things.find(child(0, 1)), 2u);
}

}  // namespace
}  // namespace tenon
