// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/function.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace tenon {
namespace {

int twice(int number) { return 2 * number; }

TEST(Function, CallsWhatItWasMadeOf) {
  int added = 3;
  const Function<int(int)> lambda = [added](int number) { return number + added; };
  EXPECT_EQ(lambda(4), 7);
  const Function<int(int)> function = twice;
  EXPECT_EQ(function(4), 8);
  const Function<int(int)> pointer = &twice;
  EXPECT_EQ(pointer(4), 8);
}

TEST(Function, IsEmptyWhereThereIsNothingToCall) {
  EXPECT_FALSE(Function<void()>());
  EXPECT_FALSE(Function<void()>(nullptr));
  EXPECT_FALSE(Function<void()>(std::function<void()>()));
  EXPECT_FALSE(Function<int()>(Function<short()>()));
  EXPECT_FALSE(Function<int(int)>(static_cast<int (*)(int)>(nullptr)));
  EXPECT_TRUE(Function<void()>([] {}));
}

TEST(Function, CopiesShareWhatTheyCall) {
  Function<int()> counter = [count = 0]() mutable { return ++count; };
  const Function<int()> copy = counter;
  EXPECT_EQ(counter(), 1);
  EXPECT_EQ(copy(), 2);
  counter = nullptr;
  EXPECT_EQ(copy(), 3);
}

TEST(Function, HandsArgumentsOnWithoutACopy) {
  const Function<std::string(std::unique_ptr<std::string>, std::string&)> join =
      [](std::unique_ptr<std::string> first, std::string& second) { return *first + second; };
  std::string second = "b";
  EXPECT_EQ(join(std::make_unique<std::string>("a"), second), "ab");
}

TEST(Function, AnswersWithWhatConverts) {
  const Function<double()> number = [] { return 3; };
  EXPECT_EQ(number(), 3.0);
  const Function<void()> nothing = [] { return 3; };
  nothing();
}

}  // namespace
}  // namespace tenon
