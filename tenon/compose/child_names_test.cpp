// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/compose/test_scene.h"

namespace tenon::compose {
namespace {

// /_d/z is reached over /_e/y/z, whose parent node has no opinions and was culled above: OpenUSD
// 26.11 composes no names below culled nodes, though the opinions there count.
TEST(ChildNames, ListsNoPropertiesOfWhatStandsBelowACulledNode) {
  TestScene scene(R"(
over "B" { def "y" { over "z" ( references = </_c> ) {} } }
class "_c" ( specializes = </_d> ) {}
class "_d" ( specializes = </_e> ) { over "z" { double a = 60
} }
class "_e" { def "y" { over "z" ( inherits = </_e/z> ) {} } })");
  EXPECT_EQ(scene.specs("/B/y/z/y/z"), "root/_d/z, root/_e/y/z");
  EXPECT_EQ(scene.properties("/B/y/z/y/z"), "");
  EXPECT_EQ(scene.properties("/_d/z"), "a");
}

}  // namespace
}  // namespace tenon::compose
