// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/array_edit.h"

#include <random>

#include <gtest/gtest.h>

#include "tenon/base/limits/limits.h"
#include "tenon/layer/field_values.h"

namespace tenon::layer {
namespace {

using Ints = std::vector<std::int32_t>;
using Op = ArrayEditOp;

ArrayEdit edit_of(const std::vector<ArrayEditStep>& steps, Ints literals) {
  ArrayEditBuilder builder;
  for (const ArrayEditStep& step : steps) {
    builder.add(step);
  }
  return builder.finish(Value(std::move(literals)));
}

Ints applied(const ArrayEdit& edit, Ints weaker) {
  const ArrayEdit* const edits[] = {&edit};
  const auto value = apply_array_edits(edits, Value(std::move(weaker)));
  const auto* array = value ? value->get<Array<std::int32_t>>() : nullptr;
  return array == nullptr ? Ints{-1} : Ints(array->begin(), array->end());
}

TEST(ArrayEdit, InstructionsActInOrder) {
  const Ints weaker{1, 2, 3};
  EXPECT_EQ(applied(edit_of({{Op::Write, 0, 1}}, {9}), weaker), (Ints{1, 9, 3}));
  EXPECT_EQ(applied(edit_of({{Op::WriteCopy, -1, 0}}, {}), weaker), (Ints{3, 2, 3}));
  EXPECT_EQ(applied(edit_of({{Op::Insert, 0, 0}, {Op::Insert, 1, kArrayEnd}}, {8, 9}), weaker),
            (Ints{8, 1, 2, 3, 9}));
  EXPECT_EQ(applied(edit_of({{Op::InsertCopy, 0, -1}}, {}), weaker), (Ints{1, 2, 1, 3}));
  EXPECT_EQ(applied(edit_of({{Op::Erase, -3}, {Op::Erase, 0}}, {}), weaker), (Ints{3}));
  EXPECT_EQ(applied(edit_of({{Op::MinSize, 5}}, {}), weaker), (Ints{1, 2, 3, 0, 0}));
  EXPECT_EQ(applied(edit_of({{Op::MinSizeFill, 5, 0}}, {7}), weaker), (Ints{1, 2, 3, 7, 7}));
  EXPECT_EQ(applied(edit_of({{Op::Resize, 1}, {Op::ResizeFill, 2, 0}}, {7}), weaker), (Ints{1, 7}));
  EXPECT_EQ(applied(edit_of({{Op::MaxSize, 2}, {Op::MaxSize, 9}}, {}), weaker), (Ints{1, 2}));
}

TEST(ArrayEdit, IndicesOutsideOfTheArrayDoNothing) {
  const Ints weaker{1, 2};
  EXPECT_EQ(applied(edit_of({{Op::Write, 0, 2}, {Op::Write, 0, -3}}, {9}), weaker), weaker);
  EXPECT_EQ(applied(edit_of({{Op::WriteCopy, 5, 0}, {Op::WriteCopy, 0, 5}}, {}), weaker), weaker);
  EXPECT_EQ(applied(edit_of({{Op::Insert, 0, 3}, {Op::Insert, 0, -3}}, {9}), weaker), weaker);
  EXPECT_EQ(applied(edit_of({{Op::Insert, 0, 2}}, {9}), weaker), (Ints{1, 2, 9}));
  EXPECT_EQ(applied(edit_of({{Op::Erase, 2}, {Op::Erase, kArrayEnd}}, {}), weaker), weaker);
  EXPECT_EQ(applied(edit_of({{Op::Erase, 0}, {Op::InsertCopy, 0, 0}}, {}), {}), Ints{});
}

TEST(ArrayEdit, StrongerEditsActAfterWeakerOnes) {
  const ArrayEdit strong = edit_of({{Op::Erase, 0}}, {});
  const ArrayEdit weak = edit_of({{Op::Insert, 0, 0}, {Op::MinSizeFill, 3, 1}}, {5, 6});
  const ArrayEdit* const edits[] = {&strong, &weak};
  EXPECT_EQ(*apply_array_edits(edits, Value()), Value(Ints{6, 6}));
  EXPECT_FALSE(apply_array_edits(edits, Value(std::vector<float>{1})));
}

TEST(ArrayEdit, GrowthIsBounded) {
  const auto growth = static_cast<std::int64_t>(limits::kArrayEditGrowth);
  const ArrayEdit huge = edit_of({{Op::Resize, growth + 4}}, {});
  const ArrayEdit* const edits[] = {&huge};
  EXPECT_FALSE(apply_array_edits(edits, Value(Ints{1, 2, 3})));
  EXPECT_TRUE(apply_array_edits(edits, Value(Ints{1, 2, 3, 4})));
}

TEST(ArrayEdit, LongEditsGiveWhatOneElementAfterTheOtherGives) {
  std::mt19937 random(5);
  std::vector<ArrayEditStep> steps;
  Ints expected(3000);
  for (std::int32_t i = 0; i < 3000; ++i) {
    expected[static_cast<std::size_t>(i)] = i;
  }
  const Ints weaker = expected;
  Ints literals;
  for (std::int32_t i = 0; i < 5000; ++i) {
    const auto at = static_cast<std::ptrdiff_t>(random() % expected.size());
    if (random() % 3 == 0) {
      steps.push_back({Op::Erase, at});
      expected.erase(expected.begin() + at);
    } else {
      steps.push_back({Op::Insert, i, at});
      expected.insert(expected.begin() + at, 10'000 + i);
    }
    literals.push_back(10'000 + i);
  }
  EXPECT_EQ(applied(edit_of(steps, literals), weaker), expected);
}

TEST(ArrayEdit, IllFormedInstructionsAreFound) {
  const auto with = [](std::vector<std::int64_t> words) {
    return ArrayEdit{Value(Ints{7}), Array<std::int64_t>(std::move(words))};
  };
  const auto run = [](std::int64_t code, std::int64_t count) { return code << 56 | count; };
  EXPECT_TRUE(with({}).is_well_formed());
  EXPECT_TRUE(with({run(0, 1), 0, 5}).is_well_formed());
  EXPECT_FALSE(with({run(0, 1), 0}).is_well_formed());     // an argument is missing
  EXPECT_FALSE(with({run(0, 1), 1, 5}).is_well_formed());  // no such literal
  EXPECT_FALSE(with({run(0, 1), -1, 5}).is_well_formed());
  EXPECT_FALSE(with({run(10, 1), 0, 0}).is_well_formed());  // no such operation
  EXPECT_FALSE(with({-1, 0, 0}).is_well_formed());
  EXPECT_FALSE(with({run(5, 1), -1}).is_well_formed());  // a size below zero
  EXPECT_FALSE(with({run(4, std::int64_t{1} << 55), 1}).is_well_formed());
}

TEST(ArrayEdit, RunsOfOneOperationShareAWord) {
  const ArrayEdit edit = edit_of({{Op::Erase, 1}, {Op::Erase, 2}, {Op::Write, 0, 0}}, {3});
  EXPECT_EQ(edit.instructions.size(), 6u);
  std::vector<std::int64_t> firsts;
  for_each_step(edit, [&](const ArrayEditStep& step) { firsts.push_back(step.first); });
  EXPECT_EQ(firsts, (std::vector<std::int64_t>{1, 2, 0}));
}

}  // namespace
}  // namespace tenon::layer
