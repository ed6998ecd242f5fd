// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/maps/map_function.h"

#include <gtest/gtest.h>

namespace tenon::compose {
namespace {

Path path(const char* text) { return *text == '\0' ? Path() : Path::from(text); }

MapFunction map_of(const std::vector<std::pair<const char*, const char*>>& pairs,
                   layer::LayerOffset offset = {}) {
  MapFunction::Pairs result;
  for (const auto& [source, target] : pairs) {
    result.emplace_back(path(source), path(target));
  }
  return MapFunction::make(std::move(result), offset);
}

struct Mapping {
  std::vector<std::pair<const char*, const char*>> pairs;
  const char* source;
  const char* target;  // "" when the source has no image
};

TEST(MapFunction, TakesTheLongestPrefixThatLeadsBack) {
  const Mapping rows[] = {
      {{{"/Model", "/Model_1"}}, "/Model/a.b", "/Model_1/a.b"},
      {{{"/Model", "/Model_1"}}, "/Other", ""},
      {{{"/", "/"}, {"/Class", "/Model"}}, "/Class/x", "/Model/x"},
      {{{"/", "/"}, {"/Class", "/Model"}}, "/Model/x", ""},  // the way back leads to /Class/x
      {{{"/", "/"}, {"/Class", "/Model"}}, "/Else", "/Else"},
      {{{"/A", "/B"}, {"/C", "/B/C"}}, "/A/C", ""},
      {{{"/A", "/A/B"}}, "/A/B", "/A/B/B"},
      {{{"/A", "/B"}, {"/A/x", ""}}, "/A/x/y", ""},  // blocked
      {{{"/A", "/B"}, {"/A/x", "/B/r"}}, "/A/x/y", "/B/r/y"},
      {{{"/A", "/B"}, {"/A/x", "/B/r"}}, "/A/r", ""},
  };
  for (const Mapping& row : rows) {
    const MapFunction map = map_of(row.pairs);
    EXPECT_EQ(map.map_source_to_target(path(row.source)), path(row.target)) << row.source;
    if (*row.target != '\0') {
      EXPECT_EQ(map.map_target_to_source(path(row.target)), path(row.source)) << row.target;
    }
  }
}

TEST(MapFunction, DropsPairsThatSayNothingNew) {
  EXPECT_EQ(map_of({{"/", "/"}, {"/A", "/A"}}), MapFunction::identity());
  EXPECT_EQ(map_of({{"/A", "/B"}, {"/A/x", "/B/x"}}), map_of({{"/A", "/B"}}));
  EXPECT_EQ(map_of({{"/A", "/B"}, {"/C", ""}}), map_of({{"/A", "/B"}}));
  EXPECT_EQ(map_of({{"/A", "/B"}, {"/A/x", "/B/y"}}).pairs().size(), 2u);
}

TEST(MapFunction, ComposesAsIfAppliedInTurn) {
  const MapFunction inner = map_of({{"/Rig", "/Model/Rig"}}, {10, 2});
  const MapFunction outer = map_of({{"/Model", "/World/M"}}, {1, 3});
  const MapFunction both = outer.compose(inner);
  EXPECT_EQ(both.map_source_to_target(path("/Rig/a")), path("/World/M/Rig/a"));
  EXPECT_EQ(both.offset(), (layer::LayerOffset{31, 6}));
  EXPECT_FALSE(both.has_root_identity());
  EXPECT_EQ(both.inverse().map_source_to_target(path("/World/M/Rig/a")), path("/Rig/a"));
}

TEST(MapFunction, IdentityIsNeutral) {
  const MapFunction map = map_of({{"/A", "/B"}}, {2, 1});
  EXPECT_EQ(MapFunction::identity().compose(map), map);
  EXPECT_EQ(map.compose(MapFunction::identity()), map);
  EXPECT_TRUE(MapFunction().is_null());
  EXPECT_TRUE(map.with_root_identity().has_root_identity());
  EXPECT_EQ(map.with_root_identity().without_root_identity(), map);
}

}  // namespace
}  // namespace tenon::compose
