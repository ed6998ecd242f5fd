// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/values/compose_array_edits.h"

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/stage/flatten/flatten.h"
#include "tenon/stage/stage.h"

namespace tenon::stage {
namespace {

layer::LayerPtr layer_of(const std::string& name, const std::string& text) {
  Diagnostics diagnostics;
  auto read = formats::read_text("#usda 1.2\n" + text, name, diagnostics);
  EXPECT_TRUE(read) << (read ? "" : read.error().to_string());
  return std::make_shared<const layer::Layer>(read ? *std::move(read) : layer::Layer(name));
}

/// A prim /A with what the given bodies say, strongest first.
Stage stage_of(const std::vector<std::string>& bodies) {
  std::vector<layer::LayerPtr> layers;
  std::string list;
  for (const std::string& body : bodies) {
    const std::string name = "l" + std::to_string(layers.size());
    layers.push_back(layer_of(name, "def \"A\"\n{\n" + body + "\n}\n"));
    list += (list.empty() ? "@" : ", @") + name + "@";
  }
  const auto open = [layers](const std::string& path, const layer::Layer&) {
    return Result<layer::LayerPtr>(layers.at(std::stoul(path.substr(1))));
  };
  auto stage = Stage::open(layer_of("root", "(\n subLayers = [" + list + "]\n)\n"), nullptr, open);
  EXPECT_TRUE(stage);
  return *std::move(stage);
}

std::string value_of(const Stage& stage, Time time) {
  return formats::value_text(stage.prim(Path::from("/A")).attribute(Token("x")).get(time));
}

TEST(ArrayEdits, ABlockBelowThemHoldsUntilTheNextSample) {
  const Stage stage =
      stage_of({"int[] x = edit [append 9]",
                "int[] x.timeSamples = {1: [1], 2: None, 4: edit [append 4]}", "int[] x = [7]"});
  EXPECT_EQ(value_of(stage, 1), "[1, 9]");
  EXPECT_EQ(value_of(stage, 2), "[9]");
  EXPECT_EQ(value_of(stage, 3), "[9]");
  EXPECT_EQ(value_of(stage, 4), "[7, 4, 9]");
}

TEST(ArrayEdits, NothingIsInterpolatedTowardsABlock) {
  const Stage stage = stage_of({"float[] x = edit [write 9 to [1]; resize 2 fill 9]",
                                "float[] x.timeSamples = {0: [0, 0], 2: [4, 0], 4: None}"});
  EXPECT_EQ(value_of(stage, 1), "[2, 9]");
  EXPECT_EQ(value_of(stage, 3), "[4, 9]");
  EXPECT_EQ(value_of(stage, 4), "[9, 9]");
}

TEST(ArrayEdits, AreAppliedWhenAStageIsFlattened) {
  const Stage stage =
      stage_of({"int[] x = edit [append 9]",
                "int[] x.timeSamples = {1: [1], 2: None, 3: edit [append 4]}", "int[] x = [7]"});
  const layer::Layer flat = flatten(stage);
  const layer::Spec* spec = flat.find(Path::from("/A.x"));
  ASSERT_NE(spec, nullptr);
  EXPECT_EQ(formats::value_text(*spec->find(layer::fields::default_value)), "[7, 9]");
  const auto* samples = spec->get<layer::TimeSamples>(layer::fields::timeSamples);
  ASSERT_NE(samples, nullptr);
  EXPECT_EQ(samples->times, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(formats::value_text(samples->values[1]), "[9]");
  EXPECT_EQ(formats::value_text(samples->values[2]), "[7, 4, 9]");
}

}  // namespace
}  // namespace tenon::stage
