// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/values/value_memo.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

/// Two instances of a part with many prims and attributes, more than are remembered, and one that
/// is no instance.
std::string many_values() {
  std::string part;
  for (int prim = 0; prim < 60; ++prim) {
    part += "def Sphere \"s" + std::to_string(prim) +
            "\" {; double radius = " + std::to_string(prim) +
            "; asset image = @part@; double blocked = None; ";
    for (int i = 0; i < 80; ++i) {
      part += "double n" + std::to_string(i) + " = " + std::to_string(100 * prim + i) + "; ";
    }
    part += "}; ";
  }
  return "def \"part\" {; " + part +
         "}; def \"A\" (; instanceable = true; references = </part>) {; };"
         "def \"B\" (; instanceable = true; references = </part>) {; };"
         "def \"C\" (; references = </part>) {; }";
}

TEST(ValueMemo, AnswersAsAttributesDo) {
  const Stage stage = open_text({{"root", many_values()}});
  ValueMemo memo;
  std::size_t found = 0;
  for (int round = 0; round < 2; ++round) {
    std::vector<Prim> pending{stage.pseudo_root()};
    while (!pending.empty()) {
      const Prim prim = pending.back();
      pending.pop_back();
      std::vector<Token> names = prim.property_names();
      names.emplace_back("nobody:has:this");
      for (const Token name : names) {
        const Attribute attribute = prim.attribute(name);
        EXPECT_EQ(memo.value_in_place(attribute), attribute.value_in_place());
        EXPECT_EQ(memo.has_authored_value(attribute), attribute.has_authored_value());
        EXPECT_EQ(memo.has_authored_value(attribute), attribute.has_authored_value());
        EXPECT_EQ(memo.value_in_place(attribute), attribute.value_in_place());
        ++found;
      }
      for (const Prim& child : prim.children()) {
        pending.push_back(child);
      }
    }
  }
  EXPECT_GT(found, 20000u);
  EXPECT_EQ(memo.value_in_place(Attribute()), nullptr);
  EXPECT_FALSE(memo.has_authored_value(Attribute()));
}

}  // namespace
}  // namespace tenon::stage
