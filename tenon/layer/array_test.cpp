// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/array.h"

#include <gtest/gtest.h>

#include "tenon/layer/field_values.h"

namespace tenon::layer {
namespace {

TEST(NumberArray, CopiesShareTheirElements) {
  const Array<float> array{1, 2, 3};
  const Array<float> copy = array;
  EXPECT_EQ(copy.data(), array.data());
  EXPECT_EQ(copy, (Array<float>{1, 2, 3}));
  EXPECT_FALSE(copy == (Array<float>{1, 2, 4}));
  EXPECT_FALSE(copy == (Array<float>{1, 2}));
  EXPECT_EQ(copy.back(), 3);
  const Value value(array);
  EXPECT_EQ(value.get<Array<float>>()->data(), array.data());
  EXPECT_EQ(value.size(), 3u);
}

TEST(NumberArray, TakesLongVectorsOver) {
  std::vector<double> numbers(5000, 0.5);
  const double* const place = numbers.data();
  const Array<double> array(std::move(numbers));
  EXPECT_EQ(array.data(), place);
  EXPECT_EQ(array.size(), 5000u);
  const Array<double> few(std::vector<double>{1, 2});
  EXPECT_EQ(few, (Array<double>{1, 2}));
}

TEST(NumberArray, BorrowsMemoryThatStaysAlive) {
  auto owner = std::make_shared<std::vector<int>>(std::vector<int>{4, 5, 6});
  const std::weak_ptr<std::vector<int>> watch = owner;
  Value value(Array<int>::borrow(std::span<const int>(*owner).subspan(1), owner));
  EXPECT_EQ(value.get<Array<int>>()->data(), owner->data() + 1);
  owner.reset();
  ASSERT_FALSE(watch.expired());
  EXPECT_EQ(value, Value(std::vector<int>{5, 6}));
  value = Value();
  EXPECT_TRUE(watch.expired());
}

TEST(NumberArray, EmptyOnesAreEqualHoweverTheyAreMade) {
  const Value made{Array<float>()};
  EXPECT_TRUE(made.is_array());
  EXPECT_EQ(made.size(), 0u);
  EXPECT_EQ(made, Value(std::vector<float>()));
  EXPECT_EQ(made, Value(Array<float>::borrow({}, nullptr)));
  EXPECT_NE(made, Value(std::vector<float>{1}));
  EXPECT_NE(made, Value(std::vector<double>()));
  ASSERT_NE(made.get<Array<float>>(), nullptr);
  EXPECT_TRUE(made.get<Array<float>>()->empty());
}

}  // namespace
}  // namespace tenon::layer
