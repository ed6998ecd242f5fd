// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/physics/colliders/filters.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace tenon::physics {
namespace {

constexpr Index kA = 0;
constexpr Index kB = 1;
constexpr Index kC = 2;

struct Row {
  const char* name;
  std::vector<AuthoredGroup> groups;
  std::vector<std::pair<Index, Index>>
      off;  // all other pairs, a group with itself included, are on
  std::vector<Index> ungrouped_off;
};

std::vector<Row> rows() {
  return {
      {"E-84 a group that filters itself", {{{kA}, false, ""}}, {{kA, kA}}, {}},
      {"E-85 one side is enough", {{{}, false, ""}, {{kA}, false, ""}}, {{kA, kB}}, {}},
      {"E-86 inverted", {{{kC}, true, ""}, {}, {}}, {{kA, kA}, {kA, kB}}, {kA}},
      {"E-87 inverted without targets", {{{}, true, ""}, {}}, {{kA, kA}, {kA, kB}}, {kA}},
      {"E-88 merged", {{{kC}, false, "m"}, {{}, false, "m"}, {}}, {{kA, kC}, {kB, kC}}, {}},
      {"E-89 merged and inverted",
       {{{kC}, true, "m"}, {{kC}, false, "m"}, {}},
       {{kA, kA}, {kA, kB}, {kB, kB}, {kA, kC}, {kB, kC}},
       {kA, kB}},
      {"E-90 an empty name merges nothing", {{{kC}, false, ""}, {}, {}}, {{kA, kC}}, {}},
  };
}

TEST(Filters, GroupTableFollowsTheRules) {
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.name);
    const GroupTable table = group_table(row.groups);
    const std::size_t count = row.groups.size();
    for (Index i = 0; i < count; ++i) {
      for (Index j = i; j < count; ++j) {
        const bool off =
            std::find(row.off.begin(), row.off.end(), std::pair(i, j)) != row.off.end();
        EXPECT_EQ(table.pair_off[i * count + j] != 0, off) << i << " " << j;
        EXPECT_EQ(table.pair_off[j * count + i] != 0, off) << j << " " << i;
      }
      const bool ungrouped = std::find(row.ungrouped_off.begin(), row.ungrouped_off.end(), i) !=
                             row.ungrouped_off.end();
      EXPECT_EQ(table.ungrouped_off[i] != 0, ungrouped) << i;
    }
  }
}

}  // namespace
}  // namespace tenon::physics
