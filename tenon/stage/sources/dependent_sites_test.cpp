// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/sources/dependent_sites.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

/// "layer path" of each site.
std::set<std::string> sites_of(const Dependents& dependents) {
  std::set<std::string> texts;
  for (const auto& [layer, path] : dependents.sites) {
    texts.insert(layer + " " + path.str());
  }
  return texts;
}

std::set<std::string> prims_of(const Dependents& dependents) {
  std::set<std::string> texts;
  for (const auto& [prim, sites] : dependents.prims) {
    texts.insert(prim.str());
  }
  return texts;
}

using Names = std::set<std::string>;

TEST(DependentSites, AreBelowArcsAndBelowArcsToThese) {
  const Stage stage = open_text(R"(
class "X" { def "B" { double x = 1 } }
def "Y" (inherits = </X>) { over "B" { double x = 2 } }
def "Z" (references = </Y>) { def "Deep" (specializes = </X>) {} }
def "V" (variants = { string v = "a" }
 prepend variantSets = "v") { variantSet "v" = { "a" (payload = </Y>) {} } }
)");
  const Dependents found = dependents_of(stage, {{"root", Path::from("/X/B")}});
  EXPECT_EQ(sites_of(found), (Names{"root /Y/B", "root /Z/B", "root /Z/Deep/B", "root /V/B"}));
  EXPECT_EQ(prims_of(found), (Names{"/Y/B", "/Z/B", "/Z/Deep/B", "/V/B"}));
}

TEST(DependentSites, HaveTheirPathInEachLayerStack) {
  const Stage stage = open_text({
      {"root", R"(def "A" (references = @middle@</M>) {})"},
      {"middle", R"(def "M" { def "In" (references = @model@</R>) {} })"},
      {"model", R"(def "R" { def "Arm" { def "Hand" {} } })"},
  });
  const Dependents found = dependents_of(stage, {{"model", Path::from("/R/Arm/Hand")}});
  EXPECT_EQ(sites_of(found), (Names{"middle /M/In/Arm/Hand", "root /A/In/Arm/Hand"}));
}

TEST(DependentSites, AClassIsImpliedWhereItsUserIsReferenced) {
  const Stage stage = open_text({
      {"root", R"(class "K" { over "B" { double x = 1 } }
def "A" (references = @model@</R>) {})"},
      {"model", R"(class "K" { def "B" {} }
def "R" (inherits = </K>) {})"},
  });
  const Dependents found = dependents_of(stage, {{"model", Path::from("/K/B")}});
  EXPECT_EQ(sites_of(found), (Names{"model /R/B", "root /A/B", "root /K/B"}));
}

TEST(DependentSites, ProxiesOfInstancesAreNamedEach) {
  const Stage stage = open_text(R"(
def "M" { def "Arm" {} }
def "P" { def "In" (references = </M>) {} }
def "I" (instanceable = true; references = </P>) {}
def "J" (instanceable = true; references = </P>) {}
)");
  const Dependents found = dependents_of(stage, {{"root", Path::from("/M/Arm")}});
  EXPECT_EQ(prims_of(found), (Names{"/P/In/Arm", "/I/In/Arm", "/J/In/Arm"}));
}

TEST(DependentSites, ARelocateKeepsTheNameOfItsTarget) {
  const Stage stage = open_text(R"((relocates = { </R/Arm>: </R/Hand> }
)
def "M" { def "Arm" { def "Tip" {} } }
def "R" (references = </M>) {}
)");
  const Dependents arm = dependents_of(stage, {{"root", Path::from("/M/Arm")}});
  EXPECT_EQ(sites_of(arm), (Names{"root /R/Arm"}));
  const Dependents tip = dependents_of(stage, {{"root", Path::from("/M/Arm/Tip")}});
  EXPECT_TRUE(prims_of(tip).contains("/R/Hand/Tip"));
}

TEST(DependentSites, ArcsOfOtherFilesThatNameThePrimAreFound) {
  const Stage stage = open_text({
      {"root", R"((subLayers = [@sub@])
def "Q" (references = @sub@</A/Arm/Tip>) {}
def "P" (payload = @sub@) {})"},
      {"sub", R"((defaultPrim = "A")
def "A" { def "Arm" { def "Tip" {} } })"},
  });
  const Dependents arm = dependents_of(stage, {{"sub", Path::from("/A/Arm")}});
  ASSERT_EQ(arm.arcs.size(), 1u);
  EXPECT_EQ(arm.arcs[0].from.str(), "/Q");
  EXPECT_EQ(arm.arcs[0].to.str(), "/A/Arm/Tip");
  EXPECT_EQ(arm.arcs[0].prim.str(), "/A/Arm");
  EXPECT_EQ(prims_of(arm), (Names{"/P/Arm"}));
  EXPECT_EQ(dependents_of(stage, {{"sub", Path::from("/A")}}).arcs.size(), 2u);
}

}  // namespace
}  // namespace tenon::stage
