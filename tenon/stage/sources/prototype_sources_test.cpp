// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

// Options of a stage with instances /A and /B of one class with children x and y.
Stage two_instances(StageOptions options) {
  return open_text(R"(
class "K" { def "x" (payload = </P>) {} def "y" {} }
def "P" { def "p" {} }
def "A" (inherits = </K>; instanceable = true) {}
def "B" (inherits = </K>; instanceable = true) {}
)",
                   std::move(options));
}

TEST(Stage, MasksAndRulesOfLoadingTellInstancesApart) {
  EXPECT_EQ(two_instances({}).prototypes().size(), 1u);
  StageOptions masked;
  masked.mask = {Path::from("/A/x"), Path::from("/B")};
  const Stage some = two_instances(masked);
  EXPECT_EQ(some.prototypes().size(), 2u);
  EXPECT_TRUE(at(some, "/A/x/p").is_valid());
  EXPECT_FALSE(at(some, "/A/y").is_valid());
  EXPECT_TRUE(at(some, "/B/y").is_valid());
  StageOptions unloaded;
  unloaded.compose.unloaded = {Path::from("/B/x")};
  const Stage loads = two_instances(unloaded);
  EXPECT_EQ(loads.prototypes().size(), 2u);
  EXPECT_TRUE(at(loads, "/A/x/p").is_valid());
  EXPECT_FALSE(at(loads, "/B/x/p").is_valid());
  unloaded.compose.unloaded.insert(Path::from("/A"));
  EXPECT_FALSE(at(two_instances(unloaded), "/A/x/p").is_valid());
}

TEST(Stage, APrototypeIsMadeFromTheInstanceThatOpenUsdMeetsFirst) {
  const Stage stage = open_text(R"(
def "A" (inherits = </K>) {}
class "K" {
    def "y" (inherits = </K/C>; instanceable = true) {}
    class "C" { def "z" { rel to = </K/x> } }
}
)");
  EXPECT_EQ(at(stage, "/A/y").prototype(), at(stage, "/K/y").prototype());
  EXPECT_EQ(at(stage, "/A/y/z").relationship("to").targets(), std::vector{Path::from("/K/x")});
}

TEST(Prim, VariantSetsOfSitesWithoutOpinionsCount) {
  const Stage stage = open_text(R"(
class "K" { def "x" {} }
def "A" (inherits = </K>; instanceable = true) { over "x" (variantSets = "v") {
    variantSet "v" = { "a" {} } } }
)");
  EXPECT_EQ(at(stage, "/A/x").variant_set_names(), std::vector<std::string>{"v"});
  EXPECT_EQ(at(stage, "/A/x").variant_names("v"), std::vector<std::string>{"a"});
  EXPECT_EQ(at(stage, "/A/x").spec_stack().size(), 1u);
}

}  // namespace
}  // namespace tenon::stage
