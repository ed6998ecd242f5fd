// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/containers/one_or_many.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace tenon::compose {
namespace {

struct Two {
  std::size_t a = 0;
  std::size_t b = 0;
  bool operator==(const Two&) const = default;
};

void expect_same(const OneOrMany<Two>& list, const std::vector<Two>& vector) {
  EXPECT_EQ(std::vector<Two>(list.begin(), list.end()), vector);
  EXPECT_EQ(list.size(), vector.size());
  EXPECT_EQ(list.empty(), vector.empty());
}

TEST(OneOrMany, HoldsWhatAVectorHolds) {
  std::mt19937 random(3);
  OneOrMany<Two> list;
  std::vector<Two> vector;
  for (std::size_t i = 0; i < 2000; ++i) {
    const std::size_t deed = random() % 8;
    if (deed < 5) {
      list.push_back({i, 2 * i});
      vector.push_back({i, 2 * i});
    } else if (deed == 5) {
      list.clear();
      vector.clear();
    } else if (deed == 6) {
      vector.assign(random() % 4, {i, i});
      list.assign(vector);
    } else {
      OneOrMany<Two> moved = std::move(list);
      list = std::move(moved);
    }
    expect_same(list, vector);
  }
}

TEST(OneOrMany, TakesAnElementOfItsOwn) {
  OneOrMany<Two> list;
  list.push_back({1, 2});
  for (int i = 0; i < 10; ++i) {
    list.push_back(list.front());
  }
  expect_same(list, std::vector<Two>(11, {1, 2}));
}

TEST(OneOrMany, LeavesNothingBehindWhenMoved) {
  for (const std::size_t count : {0u, 1u, 5u}) {
    OneOrMany<Two> list;
    list.assign(std::vector<Two>(count, {7, 8}));
    OneOrMany<Two> other;
    other.assign(std::vector<Two>(3));
    other = std::move(list);
    expect_same(other, std::vector<Two>(count, {7, 8}));
    expect_same(list, {});
  }
}

}  // namespace
}  // namespace tenon::compose
