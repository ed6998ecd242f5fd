// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/diff/layer_difference.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tenon/diff/value_difference.h"
#include "tenon/formats/text/reader.h"
#include "tenon/layer/field_values.h"

namespace tenon::diff {
namespace {

layer::Layer layer_of(const std::string& text) {
  Diagnostics diagnostics;
  auto layer = formats::read_text("#usda 1.0\n" + text, "test.usda", diagnostics);
  EXPECT_TRUE(layer) << (layer ? "" : layer.error().to_string());
  return layer ? *std::move(layer) : layer::Layer("test.usda");
}

std::vector<Difference> differences(const std::string& before, const std::string& after,
                                    double tolerance = 0) {
  return layer_differences(layer_of(before), layer_of(after), {tolerance});
}

TEST(LayerDifference, EqualMeaningInAnotherLayoutIsNoDifference) {
  const auto found =
      differences("def Xform \"A\"\n{\n    double a = 1\n    double b = 2\n}\n",
                  "# a comment\ndef Xform \"A\" {\n  double b = 2\n double a = 1\n}\n");
  EXPECT_TRUE(found.empty());
}

TEST(LayerDifference, AValueIsOneDifferenceWithBothValuesAndLines) {
  const auto found =
      differences("def \"A\"\n{\n    double a = 1\n}\n", "\ndef \"A\"\n{\n    double a = 1.5\n}\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].change, Change::Changed);
  EXPECT_EQ(found[0].path.str(), "/A.a");
  EXPECT_EQ(found[0].field, "default");
  EXPECT_EQ(found[0].before.get_or(0.0), 1);
  EXPECT_EQ(found[0].after.get_or(0.0), 1.5);
  EXPECT_EQ(found[0].largest, 0.5);
  EXPECT_EQ(found[0].before_line, 4u);
  EXPECT_EQ(found[0].after_line, 5u);
}

TEST(LayerDifference, DictionariesAreComparedItemByItemAndAsWholes) {
  const auto count = [](const std::string& before, const std::string& after) {
    const auto prim = [](const std::string& data) {
      return "def \"A\" (\n" + (data.empty() ? "" : "customData = " + data + "\n") + ")\n{\n}\n";
    };
    EXPECT_TRUE(differences(prim(before), prim(before)).empty());
    return differences(prim(before), prim(after)).size();
  };
  EXPECT_EQ(count("{\nint a = 1\nint b = 1\n}", "{\nint a = 1\nint b = 2\n}"), 1u);
  EXPECT_EQ(count("", "{\nint a = 1\nint b = 2\n}"), 2u);
  EXPECT_EQ(count("", "{\n}"), 1u);
  EXPECT_EQ(count("{\ndictionary a = {\n}\n}", "{\nint a = 1\n}"), 1u);
  EXPECT_EQ(count("{\ndictionary a = {\nint b = 1\n}\n}", "{\nint a = 1\n}"), 2u);
  EXPECT_EQ(count("{\nint \"a:b\" = 1\ndictionary a = {\nint b = 2\n}\n}",
                  "{\nint \"a:b\" = 1\ndictionary a = {\nint b = 3\n}\n}"),
            1u);
}

TEST(LayerDifference, NumbersWithinTheToleranceAreEqual) {
  const char* before = "def \"A\"\n{\n    float3[] p = [(1, 2, 3), (1000, 0, 0)]\n}\n";
  const char* after = "def \"A\"\n{\n    float3[] p = [(1, 2, 3), (1000.5, 0, 0)]\n}\n";
  EXPECT_TRUE(differences(before, after, 1e-3).empty());
  const auto found = differences(before, after, 1e-4);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].elements, 2u);
  EXPECT_EQ(found[0].count, 1u);
  EXPECT_EQ(found[0].first, 1u);
  EXPECT_EQ(found[0].largest, 0.5);
}

TEST(LayerDifference, APrimThatWentIsOneDifferenceWithTheNumberOfItsSpecs) {
  const auto found =
      differences("def \"A\"\n{\n    double a\n    def \"B\"\n    {\n    }\n}\ndef \"C\"\n{\n}\n",
                  "def \"C\"\n{\n}\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].change, Change::Removed);
  EXPECT_EQ(found[0].path.str(), "/A");
  EXPECT_EQ(found[0].count, 3u);
}

TEST(LayerDifference, DictionariesSamplesAndSelectionsDifferByKey) {
  const auto found = differences(
      "def \"A\" (\n    customData = {\n        dictionary d = {\n            int x = 1\n"
      "            int y = 2\n        }\n    }\n    variants = {\n        string v = \"a\"\n    }\n"
      ")\n{\n    double t.timeSamples = {\n        0: 1,\n        1: 2,\n    }\n}\n",
      "def \"A\" (\n    customData = {\n        dictionary d = {\n            int x = 1\n"
      "            int y = 3\n        }\n    }\n    variants = {\n        string v = \"b\"\n    }\n"
      ")\n{\n    double t.timeSamples = {\n        0: 1,\n        2: 2,\n    }\n}\n");
  std::vector<std::string> keys;
  for (const Difference& difference : found) {
    keys.push_back(difference.field.str() + " " + difference.key + " " +
                   std::string(change_name(difference.change)));
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"customData d:y changed", "variantSelection v changed",
                                            "timeSamples 1 removed", "timeSamples 2 added"}));
}

TEST(LayerDifference, TheOrderOfPrimsCountsThatOfPropertiesDoesNot) {
  const auto found = differences("def \"A\"\n{\n}\ndef \"B\"\n{\n}\ndef \"C\"\n{\n}\n",
                                 "def \"C\"\n{\n}\ndef \"A\"\n{\n}\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].field, "primChildren");
  EXPECT_EQ(found[1].path.str(), "/B");
  EXPECT_TRUE(
      differences("def \"A\"\n{\n}\ndef \"B\"\n{\n}\n", "def \"A\"\n{\n}\n")[0].field.empty());
}

TEST(ValueDifference, NanEqualsNanAndInfinityOnlyItself) {
  const double nan = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(near(nan, nan, 0));
  EXPECT_FALSE(near(nan, 1, 1));
  EXPECT_TRUE(near(infinite, infinite, 0));
  EXPECT_FALSE(near(infinite, 1e300, 1));
  EXPECT_FALSE(near(1, 1.1, 0.01));
  EXPECT_TRUE(near(100, 101, 0.01));
}

TEST(ValueDifference, TypesAndLengthsCount) {
  EXPECT_FALSE(compare_values(layer::Value(1.0f), layer::Value(1.0), 1).equal);
  const layer::Value two(layer::Array<float>{1, 2});
  const layer::Value three(layer::Array<float>{1, 2, 3});
  const ValueDifference found = compare_values(two, three, 1);
  EXPECT_EQ(found.elements, 3u);
  EXPECT_EQ(found.different, 1u);
  EXPECT_EQ(found.first, 2u);
  EXPECT_FALSE(compare_values(layer::Value(std::int64_t{1} << 60),
                              layer::Value((std::int64_t{1} << 60) + 1), 1)
                   .equal);
}

}  // namespace
}  // namespace tenon::diff
