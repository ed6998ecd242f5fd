// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/nearest_name.h"

#include <gtest/gtest.h>

namespace tenon::cli {
namespace {

TEST(NearestName, TakesWhatIsNearAndNothingElse) {
  const std::vector<std::string> verbs = {"cat", "check", "convert", "info", "sim", "structure"};
  EXPECT_EQ(nearest_name("inof", verbs), "info");
  EXPECT_EQ(nearest_name("Check", verbs), "check");
  EXPECT_EQ(nearest_name("struct", verbs), "structure");
  EXPECT_EQ(nearest_name("simulate", verbs), "");
  EXPECT_EQ(nearest_name("zzz", verbs), "");
  EXPECT_EQ(nearest_name("", verbs), "");
  EXPECT_EQ(nearest_name(std::string(1000, 'x'), verbs), "");
  EXPECT_EQ(did_you_mean("inof", verbs, "no"), "did you mean \"info\"?");
  EXPECT_EQ(did_you_mean("qqqq", verbs, "no"), "no");
  EXPECT_EQ(verb_advice("simulate", verbs), "did you mean \"sim\"?");
  EXPECT_EQ(verb_advice("Validate", verbs), "did you mean \"check\"?");
  EXPECT_EQ(verb_advice("qqqq", verbs), "`tenon help` lists all verbs");
}

}  // namespace
}  // namespace tenon::cli
