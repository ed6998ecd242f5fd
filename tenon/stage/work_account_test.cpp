// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/work_account.h"

#include <gtest/gtest.h>

#include "tenon/base/limits/work_limits.h"
#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

Stage stage_of(std::size_t max_work) {
  std::string text = "def \"L0\" {\n    def \"leaf\" {}\n}\n";
  for (int level = 1; level <= 12; ++level) {
    const std::string below = std::to_string(level - 1);
    text += "def \"L" + std::to_string(level) + "\" {\n    def \"a\" (\n        references = </L" +
            below + ">\n    ) {}\n    def \"b\" (\n        references = </L" + below +
            ">\n    ) {}\n}\n";
  }
  StageOptions options;
  options.compose.max_work = max_work;
  options.compose.max_work_per_spec = 0;
  return open_text(text, std::move(options));
}

TEST(WorkAccount, RefusesWhatWasNotComposedToItsEnd) {
  const auto spent = WorkAccount().spend(stage_of(100'000));
  ASSERT_FALSE(spent);
  EXPECT_EQ(spent.error().code(), ErrorCode::Limit);
  EXPECT_EQ(spent.error().diagnostic().rule, "compose.work-exceeded");
  EXPECT_TRUE(WorkAccount().spend(stage_of(limits::kComposeWork)));
}

TEST(WorkAccount, AddsUp) {
  const Stage stage = stage_of(limits::kComposeWork);
  ASSERT_GT(stage.work(), 500'000u);
  WorkAccount account;
  std::size_t rounds = 0;
  while (rounds < 10'000 && account.spend(stage)) {
    ++rounds;
  }
  EXPECT_GT(rounds, 1u);
  EXPECT_LT(rounds, 10'000u);
}

}  // namespace
}  // namespace tenon::stage
