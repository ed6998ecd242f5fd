// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/containers/tag_slots.h"

#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace tenon {
namespace {

/// Things of few tags, so that many share one, are numbered as a map numbers them.
TEST(TagSlots, NumbersLikeAMap) {
  TagSlots slots;
  std::vector<std::uint32_t> things{0};  // by number
  std::map<std::uint32_t, std::uint32_t> known;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const std::uint32_t thing = i * 7919 % 1000;
    const std::uint32_t tag = thing % 90 * 1000003;
    const std::uint32_t number = slots.find_or_make(
        tag, [&](std::uint32_t other) { return things[other] == thing; },
        [&] {
          things.push_back(thing);
          return static_cast<std::uint32_t>(things.size() - 1);
        });
    EXPECT_EQ(known.try_emplace(thing, number).first->second, number);
    EXPECT_EQ(things[number], thing);
  }
  EXPECT_EQ(things.size(), 1001U);
}

}  // namespace
}  // namespace tenon
