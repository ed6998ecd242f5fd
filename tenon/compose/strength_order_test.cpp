// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Strengths of specializes do not always form an order. Where two nodes are compared, the rules
// decide, and not the places that the nodes were linked at.
#include "tenon/compose/strength_order.h"

#include <gtest/gtest.h>

#include "tenon/compose/test_scene.h"

namespace tenon::compose {
namespace {

// The class /_c is implied to the prim from /C/x/_k, and was copied there from /_e/_k before. As
// OpenUSD has it, the implied arc has the stronger origin; it leads to the site that it is implied
// from and so brings no opinions, and it replaces the copy.
TEST(StrengthOrder, ImpliedSpecializeReplacesACopyWithAWeakerOrigin) {
  TestScene scene(R"(
def "C" ( specializes = </_e> ) { def "x" ( specializes = </_e> ) {} }
class "_c" {}
class "_e" { class "_k" ( specializes = [</_e/x>, </_c>] ) {} })");
  EXPECT_EQ(scene.specs("/C/_k/_k"), "root/_e/_k");
  EXPECT_EQ(scene.specs("/C/_k"), "root/_e, root/_e/_k, root/C/x, root/_c");
}

TEST(StrengthOrder, ClassesAreImpliedInTheOrderOfTheRules) {
  TestScene scene(R"(
def "C" { def "x" ( specializes = [</_c>, </C/y>] ) {} }
class "_c" ( specializes = </_d> ) { def "z" ( specializes = [</_c/_k>, </_e>] ) {} }
class "_d" { over "z" { def "x" ( inherits = </_e> ) {} } }
class "_e" { class "_k" ( specializes = </_e/x> ) {} })");
  EXPECT_EQ(scene.specs("/C/x/z/_k/_k"), "");
}

}  // namespace
}  // namespace tenon::compose
