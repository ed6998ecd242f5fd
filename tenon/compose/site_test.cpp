// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/site.h"

#include <gtest/gtest.h>

#include "tenon/compose/test_scene.h"

namespace tenon::compose {
namespace {

std::string specs_with(const std::string& references) {
  TestScene scene({{"root", R"((expressionVariables = { string NAME = "ref.usda" })
def "A" ()" + references + R"() {})"},
                   {"ref.usda", R"(def "B" {} def "C" {})"}});
  return scene.specs("/A");
}

TEST(Site, FollowsAnAssetOnceThatOneListNamesInTwoWays) {
  EXPECT_EQ(specs_with("references = [@ref.usda@</B>, @./ref.usda@</B>]"), "root/A, ref.usda/B");
  EXPECT_EQ(specs_with("references = [@./ref.usda@</B>, @`\"${NAME}\"`@</B>]"),
            "root/A, ref.usda/B");
  EXPECT_EQ(specs_with("prepend references = @ref.usda@</B>\n"
                       "append references = @./ref.usda@</B>"),
            "root/A, ref.usda/B");
  EXPECT_EQ(specs_with("payload = [@ref.usda@</B>, @./ref.usda@</B>]"), "root/A, ref.usda/B");
}

TEST(Site, FollowsAnAssetAgainToAnotherPrimOrAtAnotherTime) {
  EXPECT_EQ(specs_with("references = [@ref.usda@</B>, @./ref.usda@</C>]"),
            "root/A, ref.usda/B, ref.usda/C");
  EXPECT_EQ(specs_with("references = [@ref.usda@</B>, @./ref.usda@</B> (offset = 1)]"),
            "root/A, ref.usda/B, ref.usda/B");
}

}  // namespace
}  // namespace tenon::compose
