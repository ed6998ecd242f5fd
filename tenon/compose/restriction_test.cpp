// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// From which depth on nodes do not contribute: it decides about variants of ancestors.
#include <gtest/gtest.h>

#include "tenon/compose/cache/index_cache.h"
#include "tenon/compose/node_graph.h"
#include "tenon/formats/text/reader.h"

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
  Diagnostics diagnostics;
  auto layer = formats::read_text(R"(#usda 1.0
(
    relocates = { </C/y>: </C/r> }
)
def "A" (references = [</B>, </_d>]) {
}
def "B" (variantSets = "w") {
    def "_k" (references = </C>) {
        def "x" (inherits = </B/_k/y>) {
        }
    }
    variantSet "w" = {
        "b" (references = </C>) {
        }
    }
}
def "C" {
    def "_k" {
        def "y" {
        }
    }
}
def "_d" (
    references = </_e>
    variants = { string w = "b" }
) {
}
def "_e" {
    def "x" (
        inherits = </_e/_k>
        instanceable = true
    ) {
    }
}
)",
                                  "root", diagnostics);
  ASSERT_TRUE(layer);
  const LayerOpener opener = [](const std::string& path,
                                const layer::Layer&) -> Result<layer::LayerPtr> {
    return Error(ErrorCode::NotFound, "no " + path);
  };
  IndexCache cache(std::make_shared<const layer::Layer>(*std::move(layer)), nullptr, opener, {});
  std::string specs;
  for (const Opinion& opinion : cache.index(Path::from("/A/x/x")).opinions) {
    specs += opinion.path.str() + " ";
  }
  EXPECT_EQ(specs, "/B/_k/x /C/_k/y ");
}

}  // namespace
}  // namespace tenon::compose
