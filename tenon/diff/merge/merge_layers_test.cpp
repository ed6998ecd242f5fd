// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/diff/merge/merge_layers.h"

#include <gtest/gtest.h>

#include "tenon/diff/layer_difference.h"
#include "tenon/diff/merge/merge_order.h"
#include "tenon/formats/text/reader.h"
#include "tenon/layer/field_values.h"

namespace tenon::diff {
namespace {

layer::Layer layer_from(const std::string& text) {
  Diagnostics diagnostics;
  auto layer = formats::read_text("#usda 1.0\n" + text, "test.usda", diagnostics);
  EXPECT_TRUE(layer) << (layer ? "" : layer.error().to_string());
  return layer ? *std::move(layer) : layer::Layer("test.usda");
}

MergedLayer merged(const std::string& base, const std::string& edited, const std::string& source,
                   const MergeOptions& options = {}) {
  return merge_layers(layer_from(base), layer_from(edited), layer_from(source), options);
}

/// The merged layer says what `expected` does, with the same order of children.
void expect_layer(const MergedLayer& found, const std::string& expected) {
  const layer::Layer wanted = layer_from(expected);
  for (const Difference& difference : layer_differences(wanted, found.layer)) {
    ADD_FAILURE() << difference.path.str() << " " << difference.field.str();
  }
  for (const layer::Layer::Entry& entry : found.layer.entries()) {
    EXPECT_TRUE(entry.path.empty() || entry.path.is_absolute_root() ||
                found.layer.has(entry.path.parent()))
        << entry.path.str() << " hangs in the air";
  }
}

const char* const kBall = "def Xform \"A\"\n{\n    double m = 1\n    double r = 1\n}\n";

TEST(MergeLayers, ChangesOfBothSidesAreTaken) {
  const MergedLayer found =
      merged(kBall, "def Xform \"A\"\n{\n    double m = 2\n    double r = 1\n}\n",
             "def Xform \"A\"\n{\n    double m = 1\n    double r = 3\n}\n");
  expect_layer(found, "def Xform \"A\"\n{\n    double m = 2\n    double r = 3\n}\n");
  EXPECT_TRUE(found.conflicts.empty());
  EXPECT_EQ(found.edits, 1u);
  EXPECT_EQ(found.changes, 1u);
}

TEST(MergeLayers, TheSameChangeOnBothSidesIsNoConflict) {
  const std::string both = "def Xform \"A\"\n{\n    double m = 2\n}\n";
  const MergedLayer found = merged(kBall, both, both);
  expect_layer(found, both);
  EXPECT_TRUE(found.conflicts.empty());
}

TEST(MergeLayers, WhatBothChangedIsNamedAndTheOptionDecides) {
  const std::string edited = "def Xform \"A\"\n{\n    double m = 2\n    double r = 1\n}\n";
  const std::string source = "def Xform \"A\"\n{\n    double m = 3\n    double r = 1\n}\n";
  for (const Side keep : {Side::Edits, Side::Source}) {
    const MergedLayer found = merged(kBall, edited, source, {keep});
    expect_layer(found, keep == Side::Edits ? edited : source);
    ASSERT_EQ(found.conflicts.size(), 1u);
    EXPECT_EQ(found.conflicts[0].path.str(), "/A.m");
    EXPECT_EQ(found.conflicts[0].field, "default");
    EXPECT_EQ(found.conflicts[0].base.get_or(0.0), 1);
    EXPECT_EQ(found.conflicts[0].edited.get_or(0.0), 2);
    EXPECT_EQ(found.conflicts[0].source.get_or(0.0), 3);
  }
}

TEST(MergeLayers, WhatOneSideRemovedIsGoneWhereTheOtherLeftItAlone) {
  const std::string two = std::string(kBall) + "def Xform \"B\"\n{\n    double m = 1\n}\n";
  expect_layer(merged(two, two, kBall), kBall);
  expect_layer(merged(two, kBall, two), kBall);
}

TEST(MergeLayers, AnEditInWhatTheSourceRemovedIsAConflict) {
  const std::string base = std::string(kBall) +
                           "def Xform \"B\"\n{\n    def Xform \"C\"\n    {\n"
                           "        double m = 1\n    }\n}\n";
  std::string edited = base;
  edited.replace(edited.rfind("= 1"), 3, "= 7");
  const MergedLayer kept = merged(base, edited, kBall);
  expect_layer(kept, edited);
  ASSERT_EQ(kept.conflicts.size(), 1u);
  EXPECT_EQ(kept.conflicts[0].kind, MergeConflict::Kind::RemovedBySource);
  EXPECT_EQ(kept.conflicts[0].path.str(), "/B");
  expect_layer(merged(base, edited, kBall, {Side::Source}), kBall);
}

TEST(MergeLayers, AChangeOfWhatAnEditRemovedIsAConflict) {
  const std::string base = std::string(kBall) + "def Xform \"B\"\n{\n    double m = 1\n}\n";
  std::string source = base;
  source.replace(source.rfind("= 1"), 3, "= 7");
  const MergedLayer kept = merged(base, kBall, source);
  expect_layer(kept, kBall);
  ASSERT_EQ(kept.conflicts.size(), 1u);
  EXPECT_EQ(kept.conflicts[0].kind, MergeConflict::Kind::RemovedByEdit);
  expect_layer(merged(base, kBall, source, {Side::Source}), source);
}

TEST(MergeLayers, WholePrimsStayWithThoseAroundThem) {
  const std::string base = std::string(kBall) +
                           "def Xform \"B\"\n{\n    double x = 1\n"
                           "    def Xform \"C\"\n    {\n    }\n"
                           "    def Xform \"D\"\n    {\n    }\n}\n";
  const MergedLayer found = merged(base, base, kBall, {Side::Edits, {Path::from("/B/C")}});
  expect_layer(found, std::string(kBall) +
                          "def Xform \"B\"\n{\n    double x = 1\n"
                          "    def Xform \"C\"\n    {\n    }\n}\n");
}

TEST(MergeLayers, ListsAndDictionariesAreMergedByTheirItems) {
  const auto prim = [](const std::string& apis, const std::string& data) {
    return "def \"A\" (\n    prepend apiSchemas = [" + apis + "]\n    customData = {\n" + data +
           "    }\n)\n{\n}\n";
  };
  const MergedLayer found = merged(prim("\"X\", \"Y\"", "int a = 1\nint b = 1\n"),
                                   prim("\"X\", \"Y\", \"Mine\"", "int a = 2\nint b = 1\n"),
                                   prim("\"X\", \"Theirs\"", "int a = 1\nint b = 1\nint c = 5\n"));
  expect_layer(found, prim("\"X\", \"Theirs\", \"Mine\"", "int a = 2\nint b = 1\nint c = 5\n"));
  EXPECT_TRUE(found.conflicts.empty());
}

TEST(MergeLayers, VariantsAndSelectionsOfBothSidesStand) {
  const auto prim = [](const std::string& selection, const std::string& variants) {
    return "def \"A\" (\n    variants = {\n        string Physics = \"" + selection +
           "\"\n    }\n    prepend variantSets = \"Physics\"\n)\n{\n    variantSet \"Physics\" = "
           "{\n" +
           variants + "    }\n}\n";
  };
  const std::string none = "        \"none\" {\n        }\n";
  const std::string mine = "        \"newton\" {\n            double x = 1\n        }\n";
  const std::string theirs = "        \"physx\" {\n            double x = 2\n        }\n";
  const MergedLayer found =
      merged(prim("none", none), prim("newton", none + mine), prim("none", none + theirs));
  EXPECT_TRUE(found.conflicts.empty());
  for (const char* path : {"/A{Physics=newton}.x", "/A{Physics=physx}.x", "/A{Physics=none}"}) {
    EXPECT_TRUE(found.layer.has(Path::from(path))) << path;
  }
  EXPECT_EQ(found.layer.children(Path::from("/A{Physics=}"), layer::fields::variantChildren).size(),
            3u);
  EXPECT_EQ(found.layer.find(Path::from("/A"))
                ->get<layer::VariantSelections>(layer::fields::variantSelection)
                ->items.at("Physics"),
            "newton");
}

TEST(MergeLayers, NewChildrenStandWhereTheirSideHasThem) {
  const auto with = [](std::initializer_list<const char*> names) {
    std::string text;
    for (const char* name : names) {
      text += std::string("def \"") + name + "\"\n{\n}\n";
    }
    return text;
  };
  expect_layer(
      merged(with({"a", "b"}), with({"a", "mine", "b"}), with({"first", "a", "b", "last"})),
      with({"first", "a", "mine", "b", "last"}));
  expect_layer(merged(with({"a", "b"}), with({"a", "b"}), with({"b", "a"})), with({"b", "a"}));
}

TEST(MergeLists, KeepWhatEitherAddedAndDropWhatEitherRemoved) {
  using List = std::vector<int>;
  EXPECT_EQ(merged_list<int>({1, 2, 3}, {2, 3, 4}, {1, 2, 5}), (List{2, 5, 4}));
  EXPECT_EQ(merged_list<int>({1, 2}, {2, 1}, {1, 2}), (List{2, 1}));
  EXPECT_EQ(joined_orders<int>({1, 2}, {0, 1, 9, 2, 8}), (List{0, 1, 9, 2, 8}));
}

}  // namespace
}  // namespace tenon::diff
