// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/shared_library.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(SharedLibrary, TheFirstThatIsThereIsOpened) {
  const SharedLibrary library = SharedLibrary::open({"", "libno_such_library.so", "libc.so.6"});
  ASSERT_TRUE(library) << library.why_not();
  EXPECT_EQ(library.why_not(), "");
  int (*abs_of)(int) = nullptr;
  ASSERT_TRUE(library.find("abs", abs_of));
  EXPECT_EQ(abs_of(-3), 3);
  EXPECT_FALSE(library.find("no_such_function_here", abs_of));
  EXPECT_EQ(abs_of, nullptr);
}

TEST(SharedLibrary, WhatIsWrongWithEachIsTold) {
  const SharedLibrary library = SharedLibrary::open({"libno_such.so", "/no/such/library.so"});
  EXPECT_FALSE(library);
  EXPECT_NE(library.why_not().find("libno_such.so"), std::string::npos);
  EXPECT_NE(library.why_not().find("/no/such/library.so"), std::string::npos);
  void (*none)() = nullptr;
  EXPECT_FALSE(library.find("abs", none));
}

TEST(SharedLibrary, WhatIsOpenIsKnown) {
  EXPECT_TRUE(SharedLibrary::is_open("libc.so.6"));
  EXPECT_FALSE(SharedLibrary::is_open("libno_such_library.so"));
}

TEST(SharedLibrary, CallsThatThereAreNotAreNotRedirected) {
  int other = 0;
  EXPECT_FALSE(SharedLibrary::open({"libno_such.so"}).redirect("abs", &other));
  EXPECT_FALSE(SharedLibrary::open({"libc.so.6"}).redirect("no_such_function_here", &other));
}

TEST(SharedLibrary, ThisCodeIsInAFolder) { EXPECT_TRUE(folder_of_this_code().ends_with('/')); }

}  // namespace
}  // namespace tenon
