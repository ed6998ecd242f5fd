// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/targets/target_memo.h"

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

/// Instances within instances, whose relationships lead into their own prototype, into the one
/// around it, and out of both.
const char* const kNested = R"(#usda 1.0
def Xform "World" {
  def "A" (instanceable = true; references = </_outer>) { }
  def "B" (instanceable = true; references = </_outer>) { }
  def "C" (references = </_outer>) { }
  def Scope "Looks" { rel here = </World/A/inner/leaf> }
}
class "_outer" {
  rel own = [</_outer>, </_outer/inner/leaf>]
  def "x" (instanceable = true; references = </_inner>) { }
  def "inner" (instanceable = true; references = </_inner>) { rel lost = </_outer> }
  def "beside" {
    rel own = [</_outer/inner>, </_outer/beside.own>]
    def "deep" { rel own = </_outer/x/leaf> }
  }
}
class "_inner" {
  rel own = </_inner/leaf>
  def "leaf" { rel own = [</_inner>, </_inner/other.own>] }
  def "other" { rel own = </_inner/leaf> (doc = "x") }
}
)";

void expect_same_below(const Prim& prim, TargetMemo& memo, int& found) {
  for (const Prim& child : prim.children()) {
    for (const Token name : child.authored_property_names()) {
      const Relationship relationship = child.relationship(name);
      const std::vector<Path> targets = relationship.targets();
      EXPECT_EQ(memo.targets(relationship), targets) << relationship.path().str();
      found += static_cast<int>(targets.size());
    }
    expect_same_below(child, memo, found);
  }
}

TEST(TargetMemo, AnswersAsRelationshipsDo) {
  const Stage stage = open_text(kNested);
  TargetMemo memo;
  int found = 0;
  for (int round = 0; round < 2; ++round) {
    expect_same_below(stage.pseudo_root(), memo, found);
    for (const Prim& prototype : stage.prototypes()) {
      expect_same_below(prototype, memo, found);
    }
  }
  EXPECT_GT(found, 60);
  EXPECT_TRUE(memo.targets(Relationship()).empty());
  EXPECT_TRUE(memo.targets(stage.prim(Path::from("/World")).relationship("none")).empty());
}

}  // namespace
}  // namespace tenon::stage
