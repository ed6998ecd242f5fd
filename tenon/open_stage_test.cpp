// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/open_stage.h"

#include <gtest/gtest.h>

namespace tenon {
namespace {

OpenOptions in_memory(const std::string& text) {
  OpenOptions options;
  options.files =
      bytes::Files::in_memory({{"/a.usda", bytes::FileBytes::own("#usda 1.0\n" + text)}});
  return options;
}

TEST(Open, TheStageHasWhatOpeningFound) {
  const OpenOptions options = in_memory("def \"A\" (references = @missing.usda@)\n{\n}\n");
  const auto stage = tenon::open("/a.usda", options);
  ASSERT_TRUE(stage);
  EXPECT_TRUE(stage->prim(Path::from("/A")).is_valid());
  EXPECT_FALSE(stage->diagnostics().empty());

  Diagnostics collected;
  ASSERT_TRUE(tenon::open("/a.usda", options, collected));
  EXPECT_EQ(stage->diagnostics().items(), collected.items());
}

TEST(Open, AFileThatIsNotThereIsAnError) {
  const auto stage = tenon::open("/b.usda", in_memory(""));
  ASSERT_FALSE(stage);
  EXPECT_EQ(stage.error().code(), ErrorCode::NotFound);
}

}  // namespace
}  // namespace tenon
