// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/check/check_stage.h"

#include <gtest/gtest.h>

#include "tenon/base/text/nearest_name.h"
#include "tenon/check/overlaps/convex_overlap.h"
#include "tenon/check/rule.h"

namespace tenon::check {
namespace {

Finding finding(const char* rule, const char* file, const char* prim) {
  Finding result;
  result.rule = find_rule(rule);
  result.diagnostic.rule = rule;
  result.diagnostic.file = file;
  result.diagnostic.prim = prim;
  return result;
}

TEST(Rules, AreSortedUniqueAndHavePagesWithTheirFacts) {
  const std::vector<Rule>& all = rules();
  ASSERT_FALSE(all.empty());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_TRUE(i == 0 || all[i - 1].id < all[i].id) << all[i].id;
    const std::string head = "# " + std::string(all[i].id) + "\n\n" + facts_of(all[i]) + "\n\n";
    EXPECT_TRUE(page_of(all[i].id).starts_with(head)) << all[i].id;
    EXPECT_FALSE(title_of(page_of(all[i].id)).empty()) << all[i].id;
    EXPECT_EQ(find_rule(all[i].id), &all[i]);
  }
  EXPECT_EQ(find_rule("mass"), nullptr);
  EXPECT_EQ(find_rule("mimic.circle"), find_rule("mimic.cycle"));
  EXPECT_NE(find_rule("mimic.circle"), nullptr);
  EXPECT_TRUE(page_of("mimic.circle").starts_with("# mimic.cycle\n"));
  EXPECT_TRUE((Selection{{"joint.moves-nothing"}, {}}.takes("joint.no-dynamic-body")));
}

TEST(Rules, OfAFamilyWithoutPagesOfTheirOwnAreExplainedByTheFamilysPage) {
  EXPECT_TRUE(page_of("text.syntax").starts_with("# text\n"));
  EXPECT_TRUE(page_of("nothing.at-all").empty());
}

TEST(Selection, TakesRulesAndFamilies) {
  EXPECT_TRUE(Selection{}.takes("mass.tiny"));
  EXPECT_TRUE((Selection{{"mass"}, {}}.takes("mass.tiny")));
  EXPECT_FALSE((Selection{{"joint"}, {}}.takes("mass.tiny")));
  EXPECT_FALSE((Selection{{"mass"}, {"mass.tiny"}}.takes("mass.tiny")));
  EXPECT_TRUE((Selection{{}, {"mass.ti"}}.takes("mass.tiny")));
}

TEST(MergeVariants, SaysOnceWhatHoldsUnderSeveral) {
  const auto merged = merge_variants({{"a", {finding("mass.tiny", "x", "/P")}},
                                      {"b", {finding("mass.tiny", "y", "/P")}},
                                      {"c", {finding("mass.ratio", "x", "/P")}}});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[0].diagnostic.rule, "mass.ratio");
  EXPECT_EQ(merged[0].variants, (std::vector<std::string>{"c"}));
  EXPECT_EQ(merged[1].variants, (std::vector<std::string>{"a", "b"}));
}

TEST(MergeVariants, NamesNoVariantsWhereAllAgreeAndDropsWhatMustHoldInAll) {
  const auto merged = merge_variants(
      {{"a", {finding("mass.tiny", "x", "/P"), finding("stage.target-missing", "x", "/P")}},
       {"b", {finding("mass.tiny", "x", "/P")}}});
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_TRUE(merged[0].variants.empty());
}

TEST(MergeVariants, APropertyThatAnotherVariantUsesIsNotStray) {
  Finding stray = finding("attribute.api-missing", "x", "/P");
  stray.diagnostic.property = "physics:mass";
  EXPECT_EQ(merge_variants({{"a", {stray}}, {"b", {}}}).size(), 1u);
  EXPECT_TRUE(merge_variants({{"a", {stray}}, {"b", {}, {"/P physics:mass"}}}).empty());
}

TEST(NearestName, FindsSlipsOfThePen) {
  const std::vector<std::string_view> names{"physics:mass", "physics:density", "Xform"};
  EXPECT_EQ(nearest_name("physics:mas", names), "physics:mass");
  EXPECT_EQ(nearest_name("physics:desnity", names), "physics:density");
  EXPECT_EQ(nearest_name("Xfrom", names), "Xform");
  EXPECT_EQ(nearest_name("xform", names), "Xform");
  EXPECT_EQ(nearest_name("physics:mass", names), "");
  EXPECT_EQ(nearest_name("radius", names), "");
}

ConvexSolid solid(const scene::Shape& shape, Vec3d at) {
  return {&shape, nullptr, {at, kIdentityRotation}, {}, 1};
}

TEST(Overlap, OfBoxesAndBallsFollowsTheirDistance) {
  scene::Shape box;
  box.half_extents = {{1, 1, 1}};
  scene::Shape ball;
  ball.kind = scene::ShapeKind::Sphere;
  ball.radius = 0.5;
  const ConvexSolid a = solid(box, {});
  EXPECT_TRUE(overlap(a, solid(ball, {{1.4, 0, 0}})));
  EXPECT_FALSE(overlap(a, solid(ball, {{1.6, 0, 0}})));
  // Beyond the corner: sqrt(3) (x - 1) = 0.5 where they touch.
  EXPECT_TRUE(overlap(a, solid(ball, {{1.27, 1.27, 1.27}})));
  EXPECT_FALSE(overlap(a, solid(ball, {{1.31, 1.31, 1.31}})));
}

TEST(Overlap, OfRoundShapesKnowsTheirAxis) {
  scene::Shape rod;
  rod.kind = scene::ShapeKind::Cylinder;
  rod.radius = 0.1;
  rod.half_height = 2;
  rod.axis = scene::Axis::X;
  scene::Shape cone = rod;
  cone.kind = scene::ShapeKind::Cone;
  cone.axis = scene::Axis::Z;
  EXPECT_TRUE(overlap(solid(rod, {}), solid(rod, {{3.9, 0, 0}})));
  EXPECT_FALSE(overlap(solid(rod, {}), solid(rod, {{0, 0.25, 0}})));
  EXPECT_TRUE(overlap(solid(cone, {}), solid(rod, {{0, 0, 2.05}})));     // at the apex
  EXPECT_FALSE(overlap(solid(cone, {}), solid(rod, {{2.09, 0, 1.8}})));  // beside it
}

}  // namespace
}  // namespace tenon::check
