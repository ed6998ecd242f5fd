// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/paths/path_slots.h"

#include <set>

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(PathSlots, NumbersOfOneSceneLieInTheirOrder) {
  PathSlots places(1024, 5000, 5900);
  std::set<std::size_t> homes;
  for (std::uint32_t number = 5000; number <= 5900; ++number) {
    const std::size_t home = places.home(number);
    EXPECT_LT(home, 1024U);
    EXPECT_TRUE(homes.insert(home).second);
    EXPECT_TRUE(places.note(home, home));
    EXPECT_EQ(places.next(home), (home + 1) % 1024);
  }
  EXPECT_EQ(places.reach(), 1U);
}

TEST(PathSlots, NumbersThatPileUpAreScattered) {
  PathSlots places(1024, 0, 1000);
  EXPECT_TRUE(places.note(1020, 1020));
  EXPECT_TRUE(places.note(1020, 5));  // around the end
  EXPECT_EQ(places.reach(), 10U);
  EXPECT_FALSE(places.note(1020, 100));
  PathSlots others = places.scattered();
  EXPECT_EQ(others.reach(), 0U);
  EXPECT_TRUE(others.note(1020, 100));
  EXPECT_EQ(others.reach(), 105U);
}

TEST(PathSlots, NumbersThatLieFarApartAreScattered) {
  const PathSlots places(64, 10, 10 + 64);
  const PathSlots scattered(64);
  bool differs = false;
  for (std::uint32_t number = 0; number < 64; ++number) {
    EXPECT_EQ(places.home(number), scattered.home(number));
    differs = differs || places.home(number) != number;
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace tenon
