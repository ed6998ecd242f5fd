// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/shell_word.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

TEST(ShellWord, QuotesWhatAShellWouldSplitOrExpand) {
  EXPECT_EQ(shell_word("/World/a.physics:mass=0.5"), "/World/a.physics:mass=0.5");
  EXPECT_EQ(shell_word("my robot.urdf"), "'my robot.urdf'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word("$HOME"), "'$HOME'");
  EXPECT_EQ(shell_word("~/a"), "'~/a'");
  EXPECT_EQ(shell_word("a(1).usda"), "'a(1).usda'");
  EXPECT_EQ(shell_word("b\xc3\xa4r.usda"), "b\xc3\xa4r.usda");
  EXPECT_EQ(shell_word(""), "''");
}

}  // namespace
}  // namespace tenon
