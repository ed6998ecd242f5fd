// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/proof/proof.h"

#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tenon/formats/open_layer.h"
#include "tenon/stage/stage.h"
#include "tenon/structure/layer_tree.h"
#include "tenon/structure/proof/content.h"

namespace tenon::structure {
namespace {

layer::Layer layer_of(const std::string& properties) {
  Diagnostics diagnostics;
  const std::string text = "#usda 1.0\ndef \"A\"\n{\n" + properties + "\n}\n";
  auto layer = formats::read_layer(bytes::FileBytes::own(text), "a.usda", diagnostics);
  EXPECT_TRUE(layer.has_value()) << layer.error().to_string();
  return *std::move(layer);
}

bool is_same(const std::string& expected, const std::string& found) {
  return !compare_contents(layer_of(expected), layer_of(found)).has_value();
}

TEST(Proof, NanIsNanAndHidesNothingElse) {
  EXPECT_TRUE(is_same("float[] x = [nan, 1]", "float[] x = [nan, 1]"));
  EXPECT_FALSE(is_same("float[] x = [nan, 1]", "float[] x = [nan, 2]"));
  EXPECT_FALSE(is_same("float[] x = [nan, 1]", "float[] x = [1, nan]"));
  EXPECT_FALSE(is_same("float[] x = [nan, 1]", "float[] x = [nan]"));
  EXPECT_FALSE(is_same("double x = nan", "double x = 1"));
  EXPECT_TRUE(is_same("double3 x = (nan, 0, 1)", "double3 x = (nan, 0, 1)"));
  EXPECT_FALSE(is_same("double3 x = (nan, 0, 1)", "double3 x = (nan, 0, 2)"));
  const std::string samples = "double x.timeSamples = { 0: nan, 1: ";
  EXPECT_TRUE(is_same(samples + "2 }", samples + "2 }"));
  EXPECT_FALSE(is_same(samples + "2 }", samples + "3 }"));
}

/// What an over of the difference makes of `weak` is `strong` again, value by value.
void expect_over_leads_back(const std::string& weak, const std::string& strong) {
  const layer::Layer over = difference(layer_of(weak), layer_of(strong), "over.usda");
  const layer::Spec* spec = over.find(Path::from("/A.x"));
  const bool says_default = spec != nullptr && spec->has(layer::fields::default_value);
  EXPECT_TRUE(says_default) << weak << " to " << strong;
}

TEST(Proof, ADefaultThatHidesSamplesStaysInTheDifference) {
  expect_over_leads_back("double x = 1\ndouble x.timeSamples = { 0: 5 }", "double x = 1");
  expect_over_leads_back("double x = 1\ndouble x.spline = {\n1: 2; post held\n}", "double x = 1");
  const layer::Layer none =
      difference(layer_of("double x = 1"),
                 layer_of("double x = 1\ndouble x.timeSamples = { 0: 5 }"), "over.usda");
  EXPECT_FALSE(none.find(Path::from("/A.x"))->has(layer::fields::default_value));
}

}  // namespace
}  // namespace tenon::structure
