// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/result.h"

#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace tenon {
namespace {

Error fault() { return {ErrorCode::Invalid, "no such thing"}; }

Result<std::string> text_or_error(bool good) {
  if (!good) {
    return fault();
  }
  return "text";
}

TEST(Result, HoldsAValueOrAnError) {
  const auto good = text_or_error(true);
  ASSERT_TRUE(good.has_value());
  EXPECT_EQ(*good, "text");
  EXPECT_EQ(good->size(), 4U);
  const auto bad = text_or_error(false);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().message(), "no such thing");
  EXPECT_EQ(bad.value_or("another"), "another");
  EXPECT_EQ(good.value_or("another"), "text");
}

TEST(Result, IsCopiedAndAssignedBothWays) {
  Result<std::string> result = text_or_error(true);
  const Result<std::string> copy = result;
  result = text_or_error(false);
  EXPECT_EQ(copy.value(), "text");
  EXPECT_EQ(result.error().message(), "no such thing");
  result = copy;
  EXPECT_EQ(result.value(), "text");
  Result<std::string>& itself = result;
  result = std::move(itself);
  EXPECT_EQ(result.value(), "text");
}

TEST(Result, HoldsWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(3);
  const std::unique_ptr<int> taken = *std::move(result);
  EXPECT_EQ(*taken, 3);
}

TEST(Result, TakesWhatConvertsToItsValue) {
  const Result<std::shared_ptr<const int>> wider = std::make_shared<int>(3);
  EXPECT_EQ(**wider, 3);
  const Result<double> number = 3;
  EXPECT_EQ(*number, 3.0);
}

TEST(Result, OfNothingTellsTheErrorAlone) {
  const Result<void> good;
  EXPECT_TRUE(good);
  const Result<void> bad = fault();
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().message(), "no such thing");
}

Result<std::size_t> length(bool good) {
  TENON_TRY(const std::string text, text_or_error(good));
  TENON_CHECK(good ? Result<void>() : Result<void>(fault()));
  return text.size();
}

TEST(Result, IsHandedOnByTheMacros) {
  EXPECT_EQ(length(true).value(), 4U);
  EXPECT_EQ(length(false).error().code(), ErrorCode::Invalid);
}

TEST(ResultDeathTest, EndsTheProgramWhereAValueIsTakenForGranted) {
  EXPECT_DEATH((void)text_or_error(false).value(), "");
}

}  // namespace
}  // namespace tenon
