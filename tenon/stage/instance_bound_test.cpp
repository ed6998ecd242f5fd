// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

/// `levels` prims; each holds two instances of the one before.
Stage doubling(int levels, StageOptions options = {}) {
  std::string text = "def \"L0\" {\n    def \"leaf\" {}\n}\n";
  for (int level = 1; level <= levels; ++level) {
    const std::string below = std::to_string(level - 1);
    text += "def \"L" + std::to_string(level) + "\" {\n";
    for (const char* name : {"a", "b"}) {
      text += std::string("    def \"") + name + "\" (\n        instanceable = true\n" +
              "        references = </L" + below + ">\n    ) {}\n";
    }
    text += "}\n";
  }
  return open_text(text, std::move(options));
}

std::size_t walked(const Prim& prim) {
  std::size_t count = 1;
  for (const Prim& child : prim.children()) {
    count += walked(child);
  }
  return count;
}

std::size_t findings(const Stage& stage) {
  std::size_t count = 0;
  for (const Diagnostic& found : stage.diagnostics().items()) {
    count += found.rule == "stage.too-many-prims" ? 1 : 0;
  }
  return count;
}

TEST(InstanceBound, LeavesStagesAloneThatAreSmall) {
  const Stage stage = doubling(3);
  // Root; L0 with its leaf; below L1 two leaves with their instances; and so on.
  EXPECT_EQ(walked(stage.pseudo_root()), 1u + 2u + 5u + 11u + 23u);
  EXPECT_EQ(findings(stage), 0u);
}

TEST(InstanceBound, EndsWalksThatDouble) {
  StageOptions options;
  options.max_instanced_prims = 1000;
  options.max_instanced_prims_per_spec = 1;
  const Stage stage = doubling(60, options);
  const std::size_t bound = 1000 + 3 * 60 + 4;
  EXPECT_LE(walked(stage.pseudo_root()), bound);
  EXPECT_GT(walked(stage.pseudo_root()), bound / 4);
  ASSERT_EQ(findings(stage), 1u);
  EXPECT_TRUE(stage.prim(Path::from("/L3/a/b/a/leaf")).is_valid());
}

TEST(InstanceBound, WalksOfWhatIsNotGivenEndToo) {
  EXPECT_EQ(findings(doubling(14)), 0u);
  EXPECT_EQ(findings(doubling(200)), 1u);
}

}  // namespace
}  // namespace tenon::stage
