// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/message.h"

#include <string>

#include <gtest/gtest.h>

#include "tenon/base/diagnostics.h"
#include "tenon/base/limits/fault_limits.h"
#include "tenon/base/path.h"

namespace tenon {
namespace {

TEST(Message, KeepsWhatItNames) {
  const Path leader = Path::from("/World/J1");
  const Message message = "the leader " + named(leader, RelatedRole::Joint) + " is disabled";
  EXPECT_EQ(message.text(), "the leader </World/J1> is disabled");
  ASSERT_EQ(message.related().size(), 1u);
  EXPECT_EQ(message.related()[0].path, "/World/J1");
  EXPECT_EQ(message.related()[0].role, RelatedRole::Joint);
}

TEST(Message, NamesEachOnceAndNothingRelative) {
  const Path body = Path::from("/B");
  Message message = named(body, RelatedRole::Body) + " and " + named(body, RelatedRole::Body) +
                    " and " + named(Path::from("C")) + named(Path());
  message.about(body, RelatedRole::Body);
  EXPECT_EQ(message.text(), "</B> and </B> and <C><>");
  EXPECT_EQ(message.related().size(), 1u);
}

TEST(Message, NamesSoManyAtMost) {
  Message message("the collider is in 5,000 groups");
  for (int i = 0; i < 5000; ++i) {
    message.about(Path::from("/G" + std::to_string(i)), RelatedRole::CollisionGroup);
  }
  EXPECT_EQ(message.related().size(), limits::kRelatedPrims);
}

TEST(Message, NamesPathsWithinLayers) {
  const Message message = named(Path::from("/X"), RelatedRole::Prim, "a.usda");
  EXPECT_EQ(message.text(), "@a.usda@</X>");
  ASSERT_EQ(message.related().size(), 1u);
  EXPECT_EQ(message.related()[0].file, "a.usda");
}

TEST(Message, GoesIntoFindings) {
  Diagnostic finding;
  finding.say("names " + named(Path::from("/A"), RelatedRole::Target));
  EXPECT_EQ(finding.message, "names </A>");
  ASSERT_EQ(finding.related.size(), 1u);
  EXPECT_EQ(role_name(finding.related[0].role), "target");
}

}  // namespace
}  // namespace tenon
