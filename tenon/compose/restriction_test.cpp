// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// From which depth on nodes do not contribute: it decides about variants of ancestors.
#include <gtest/gtest.h>

#include "tenon/compose/node_graph.h"
#include "tenon/compose/test_scene.h"

namespace tenon::compose {
namespace {

TEST(Restriction, CullingDoesNotReleaseTheAncestorsOfANode) {
  LayerStack stack;
  MapPool maps;
  WorkMeter work;
  NodeGraph graph(maps, work);
  graph.reset({&stack, Path::from("/A")});
  Arc arc;
  arc.kind = ArcKind::Specialize;
  arc.parent = arc.origin = 0;
  arc.map_to_parent = maps.identity();
  const NodeId node = graph.insert_child({&stack, Path::from("/B")}, arc);
  graph.set_inert(node, true);
  graph.descend(Path::from("/A/x"));
  graph.descend(Path::from("/A/x/y"));
  graph.set_culled(node);
  EXPECT_EQ(graph[node].restriction_depth, 1);
}

TEST(Restriction, WhatARelocateLeavesOutGetsNoVariantsOfItsAncestors) {
  TestScene scene(R"((relocates = { </C/y>: </C/r> })
def "A" ( references = [</B>, </_d>] ) {}
def "B" ( variantSets = "w" ) {
    def "_k" ( references = </C> ) { def "x" ( inherits = </B/_k/y> ) {} }
    variantSet "w" = { "b" ( references = </C> ) {} }
}
def "C" { def "_k" { def "y" {} } }
def "_d" ( references = </_e>
    variants = { string w = "b" } ) {}
def "_e" { def "x" ( inherits = </_e/_k>
    instanceable = true ) {} })");
  EXPECT_EQ(scene.specs("/A/x/x"), "root/B/_k/x, root/C/_k/y");
}

// Below an instance the variant that a node is in contributes nothing: as OpenUSD has it, the sets
// of its ancestors are decided once more, and wrong selections of them told.
TEST(Restriction, SetsAroundAVariantThatContributesNothingAreDecidedAgain) {
  ComposeOptions options;
  options.variant_fallbacks = {{"v", {"c"}}, {"w", {"c"}}};
  TestScene scene({{"root", R"(
class "_c" { def "y" ( instanceable = true
    variants = { string w = "`${SEL}`" } ) {} }
def "C" ( variantSets = ["v", "w"] ) { variantSet "v" = { "c" ( references = </_c/y> ) {
    over "y" ( references = </B> ) {} } } }
def "B" { def "x" ( inherits = </B/z> ) {} })"}},
                  options);
  EXPECT_EQ(scene.specs("/C/y/x"), "root/B/x");
  EXPECT_EQ(scene.errors("/C/y/x"), "variable-expression-error");
}

}  // namespace
}  // namespace tenon::compose
