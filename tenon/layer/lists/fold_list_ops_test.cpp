// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/lists/fold_list_ops.h"

#include <gtest/gtest.h>

namespace tenon::layer {
namespace {

using Edit = ListOp<int>;
using Items = std::vector<int>;

Edit edit(Items deleted, Items prepended, Items appended) {
  Edit op;
  op.deleted = std::move(deleted);
  op.prepended = std::move(prepended);
  op.appended = std::move(appended);
  return op;
}

// Results as OpenUSD 26.11 gives them.
TEST(FoldListOps, StrongerItemsLeaveTheWeakerLists) {
  const Edit stronger = edit({100, 25}, {50, 75}, {50, 100, 150});
  const Edit weaker = edit({102, 27, 75}, {52, 25, 77}, {52, 102, 50, 152});
  const auto folded = fold(stronger, weaker);
  ASSERT_TRUE(folded.has_value());
  EXPECT_EQ(folded->deleted, (Items{102, 27, 25}));
  EXPECT_EQ(folded->prepended, (Items{75, 52, 77}));
  EXPECT_EQ(folded->appended, (Items{52, 102, 152, 50, 100, 150}));
  EXPECT_FALSE(folded->is_explicit);
}

TEST(FoldListOps, OverNothingAnEditIsReduced) {
  const auto folded = fold(edit({100, 25, 25}, {50, 75, 75}, {50, 100, 150, 50}), Edit());
  ASSERT_TRUE(folded.has_value());
  EXPECT_EQ(*folded, edit({25}, {75}, {100, 150, 50}));
}

TEST(FoldListOps, ExplicitListsEndTheChain) {
  const Edit base = Edit::make_explicit({100, 150, 100});
  EXPECT_EQ(fold(edit({}, {}, {75, 100}), base), Edit::make_explicit({150, 75, 100}));
  EXPECT_EQ(fold(base, edit({}, {}, {75})), Edit::make_explicit({100, 150}));
  EXPECT_EQ(fold(Edit(), Edit::make_explicit({})), Edit::make_explicit({}));
}

TEST(FoldListOps, LegacyEditsDependOnTheListBelow) {
  Edit legacy;
  legacy.added = {1};
  EXPECT_EQ(fold(legacy, Edit()), std::nullopt);
  EXPECT_EQ(fold(Edit(), legacy), std::nullopt);
  EXPECT_EQ(fold(Edit::make_explicit({2}), legacy), Edit::make_explicit({2}));
}

}  // namespace
}  // namespace tenon::layer
