// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/sources/opinion_sources.h"

#include <map>

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

// The shape of a structured robot: a base, and physics in a payload of a variant.
const std::map<std::string, std::string>& robot() {
  static const std::map<std::string, std::string> texts{
      {"root",
       "def \"r\" (\n    prepend references = @base@\n    variants = {\n        string P = \"on\"\n"
       "    }\n    append variantSets = \"P\"\n)\n{\n    variantSet \"P\" = {\n        \"on\" (\n"
       "            prepend payload = @engine@\n        ) {\n        }\n    }\n}\n"},
      {"base",
       "(\n    defaultPrim = \"r\"\n)\ndef \"r\"\n{\n    def \"link\" (\n"
       "        instanceable = true\n        prepend references = @shapes@</S>\n    )\n    {\n"
       "        double mass = 1\n    }\n}\n"},
      {"engine",
       "(\n    defaultPrim = \"r\"\n    subLayers = [@physics@]\n)\nover \"r\"\n{\n"
       "    over \"link\"\n    {\n        over \"mesh\"\n        {\n            double size = 9\n"
       "        }\n    }\n}\n"},
      {"physics",
       "(\n    defaultPrim = \"r\"\n)\nover \"r\"\n{\n    over \"link\"\n    {\n"
       "        double mass = 2\n    }\n}\n"},
      {"shapes", "def \"S\"\n{\n    def \"mesh\"\n    {\n        double size = 3\n    }\n}\n"},
  };
  return texts;
}

TEST(OpinionSources, StrongestFirstWithTheWayThere) {
  const Stage stage = open_text(robot());
  const auto sources = opinion_sources(stage, Path::from("/r/link"), Token("mass"));
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources[0].layer->identifier(), "physics");
  EXPECT_EQ(sources[0].stack, "engine");
  ASSERT_EQ(sources[0].arcs.size(), 2u);
  EXPECT_EQ(sources[0].arcs[0].kind, compose::ArcKind::Variant);
  EXPECT_EQ(sources[0].arcs[0].to.str(), "/r{P=on}");
  EXPECT_EQ(sources[0].arcs[0].from.str(), "/r");
  EXPECT_EQ(sources[0].arcs[1].kind, compose::ArcKind::Payload);
  EXPECT_EQ(sources[0].arcs[1].layer, "root");
  EXPECT_EQ(sources[0].arcs[1].line, 11u);
  EXPECT_EQ(sources[0].arcs[1].to_layer, "engine");
  EXPECT_EQ(sources[1].layer->identifier(), "base");
  EXPECT_EQ(sources[1].arcs[0].kind, compose::ArcKind::Reference);
}

TEST(OpinionSources, OpinionsBelowAnInstanceAreIgnoredAndFound) {
  const Stage stage = open_text(robot());
  const Path mesh = Path::from("/r/link/mesh");
  const auto sources = opinion_sources(stage, mesh, Token("size"));
  ASSERT_EQ(sources.size(), 1u);
  EXPECT_EQ(sources[0].layer->identifier(), "shapes");
  EXPECT_EQ(sources[0].path.str(), "/S/mesh.size");
  const auto ignored = ignored_below_instance(stage, mesh, Token("size"));
  ASSERT_EQ(ignored.size(), 1u);
  EXPECT_EQ(ignored[0].layer->identifier(), "engine");
  EXPECT_EQ(ignored[0].path.str(), "/r/link/mesh.size");
  EXPECT_TRUE(ignored_below_instance(stage, Path::from("/r/link"), Token("mass")).empty());
}

TEST(OpinionSources, ALayerHasAPlaceForWhatItDoesNotSayYet) {
  const Stage stage = open_text(robot());
  const auto place = [&](const char* prim, const char* layer) {
    const auto site = site_in_layer(stage, Path::from(prim), layer);
    return site ? site->path.str() : std::string("none");
  };
  EXPECT_EQ(place("/r/link", "engine"), "/r/link");
  EXPECT_EQ(place("/r/link", "root"), "/r/link");
  EXPECT_EQ(place("/r", "base"), "/r");
  EXPECT_EQ(place("/r/link", "shapes"), "/S");
  EXPECT_EQ(place("/r/link/mesh", "shapes"), "/S/mesh");
  EXPECT_EQ(place("/r/link/mesh", "physics"), "none");
  EXPECT_EQ(place("/r/link", "nowhere"), "none");
}

TEST(OpinionSources, NoPrimHasNone) {
  const Stage stage = open_text(robot());
  EXPECT_TRUE(opinion_sources(stage, Path::from("/nowhere")).empty());
  EXPECT_TRUE(ignored_below_instance(stage, Path::from("/nowhere")).empty());
}

}  // namespace
}  // namespace tenon::stage
