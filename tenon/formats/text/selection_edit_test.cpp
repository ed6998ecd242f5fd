// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/selection_edit.h"

#include <gtest/gtest.h>

namespace tenon::formats::text {
namespace {

struct Case {
  const char* name;
  const char* before;
  TextPlace place;
  const char* after;
};

const Case kCases[] = {
    {"an entry is replaced, comments stay",
     "#usda 1.0\ndef \"A\" (\n    variants = {\n        string Physics = \"none\" # ) } {\n    "
     "}\n)\n{\n}\n",
     {2, 1},
     "#usda 1.0\ndef \"A\" (\n    variants = {\n        string Physics = \"mujoco\" # ) } {\n    "
     "}\n)\n{\n}\n"},
    {"another set's entry stays",
     "def Xform \"A\" (\n    variants = {\n        string Look = \"red\"\n    }\n)\n{\n}\n",
     {1, 1},
     "def Xform \"A\" (\n    variants = {\n        string Physics = \"mujoco\"\n        string "
     "Look = "
     "\"red\"\n    }\n)\n{\n}\n"},
    {"a metadata block without selections gets some",
     "def \"A\" (\n    doc = \"\"\"variants = { ( \"\"\"\n    append variantSets = "
     "\"Physics\"\n)\n{\n}\n",
     {1, 1},
     "def \"A\" (\n    variants = {\n        string Physics = \"mujoco\"\n    }\n    doc = "
     "\"\"\"variants = { ( \"\"\"\n    append variantSets = \"Physics\"\n)\n{\n}\n"},
    {"a prim without metadata gets a block",
     "def \"A\"\n{\n}\n",
     {1, 1},
     "def \"A\" (\n    variants = {\n        string Physics = \"mujoco\"\n    }\n)\n{\n}\n"},
};

TEST(SelectionEdit, ChangesOnlyTheSelection) {
  for (const Case& c : kCases) {
    const auto after = with_variant_selection(c.before, c.place, "Physics", "mujoco");
    ASSERT_TRUE(after.has_value()) << c.name;
    EXPECT_EQ(*after, c.after) << c.name;
  }
}

TEST(SelectionEdit, APlaceOutsideTheTextOrWithoutAPrimIsRefused) {
  EXPECT_FALSE(with_variant_selection("def \"A\" {}\n", {9, 1}, "Physics", "x").has_value());
  EXPECT_FALSE(with_variant_selection("( ) {\n}\n", {1, 1}, "Physics", "x").has_value());
  EXPECT_FALSE(with_variant_selection("def \"A\" (\n", {1, 1}, "Physics", "x").has_value());
}

}  // namespace
}  // namespace tenon::formats::text
