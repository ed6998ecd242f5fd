// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tenon/formats/text/write/value_text.h"
#include "tenon/stage/clips/clip_times.h"
#include "tenon/stage/stage.h"
#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

// A prim /M with attributes x and y and one clip set of the given entries.
std::string root_with(const std::string& entries) {
  return "def \"M\" (\n clips = {\n dictionary default = {\n" + entries +
         "\n}\n}\n)\n{\n double x\n double y\n}\n";
}

std::string clip_of(const std::string& attributes) {
  return "def \"C\"\n{\n" + attributes + "\n}\n";
}

const char* const kTwoClips =
    "asset[] assetPaths = [@a@, @b@]\n string primPath = \"/C\"\n"
    "double2[] active = [(0, 0), (10, 1)]\n";

Attribute attribute(const Stage& stage, const char* name) {
  return stage.prim(Path::from("/M")).attribute(Token(name));
}

double value(const Stage& stage, const char* name, double time) {
  return attribute(stage, name).get_as<double>(time).value_or(-999);
}

std::size_t clip_warnings(const Stage& stage) {
  std::size_t count = 0;
  for (const Diagnostic& found : stage.diagnostics()) {
    count += found.rule.starts_with("clips.") ? 1 : 0;
  }
  return count;
}

TEST(ClipTimes, IsLinearBetweenPairsAndConstantOutside) {
  const ClipTimes times({{10, 5}, {0, 0}});
  EXPECT_EQ(times.to_clip(-1), 0);
  EXPECT_EQ(times.to_clip(4), 2);
  EXPECT_EQ(times.to_clip(11), 5);
  EXPECT_EQ(ClipTimes().to_clip(7), 7);
}

TEST(ClipTimes, TwoPairsOfOneStageTimeAreAJump) {
  const ClipTimes times({{0, 0}, {10, 10}, {10, 0}, {20, 10}});
  EXPECT_EQ(times.to_clip(3), 3);
  EXPECT_EQ(times.to_clip(10), 0);
  EXPECT_NEAR(times.to_clip(10 - kSafeStep), 10, 1e-6);
  EXPECT_EQ(times.to_clip(15), 5);
}

TEST(ValueClips, TheActiveClipGivesTheValue) {
  const Stage stage = open_text({{"root", root_with(kTwoClips)},
                                 {"a", clip_of("double x.timeSamples = { 0: 1, 5: 6 }")},
                                 {"b", clip_of("double x.timeSamples = { 10: 20, 15: 30 }")}});
  EXPECT_EQ(value(stage, "x", 2.5), 3.5);
  EXPECT_EQ(value(stage, "x", 10), 20);
  EXPECT_EQ(value(stage, "x", 12.5), 25);
  EXPECT_EQ(value(stage, "x", 99), 30);
  EXPECT_EQ(value(stage, "x", -1), 1);
  EXPECT_EQ(attribute(stage, "x").value_source(1), ValueSource::ValueClips);
  EXPECT_EQ(attribute(stage, "x").value_source(), ValueSource::None);
  EXPECT_EQ(attribute(stage, "x").time_samples(), (std::vector<double>{0, 5, 10, 15}));
  EXPECT_TRUE(attribute(stage, "x").is_animated());
  EXPECT_EQ(attribute(stage, "y").value_source(1), ValueSource::None);
}

TEST(ClipTimes, AJumpAtTheBeginningHasNothingInFront) {
  const ClipTimes times({{0, 0}, {0, 20}, {10, 30}});
  EXPECT_EQ(times.to_clip(-1), 20);
}

TEST(ValueClips, ABlockInAClipIsNoValue) {
  const std::string entries = std::string(kTwoClips) + "asset manifestAssetPath = @m@\n";
  const Stage stage = open_text({{"root", root_with(entries)},
                                 {"a", clip_of("double x.timeSamples = { 5: None, 8: 1 }")},
                                 {"b", clip_of("")},
                                 {"m", clip_of("double x = 77")}});
  EXPECT_TRUE(attribute(stage, "x").get(0).empty());
  EXPECT_TRUE(attribute(stage, "x").get(6).empty());
  EXPECT_EQ(value(stage, "x", 8), 1);
}

TEST(ValueClips, OpinionsOfTheLayerThatNamesTheClipsAreStronger) {
  std::string root = root_with(kTwoClips);
  root.replace(root.find("double x"), 8, "double x = 7");
  const Stage stage = open_text({{"root", root},
                                 {"a", clip_of("double x.timeSamples = { 0: 1 }")},
                                 {"b", clip_of("double x.timeSamples = { 10: 2 }")}});
  EXPECT_EQ(value(stage, "x", 1), 7);
}

TEST(ValueClips, ClipsAreStrongerThanWeakerLayersAndMoveWithTheirOffset) {
  const std::string weak = "def \"M\"\n{\n double x = 7\n}\n";
  const Stage stage = open_text({{"root", "(\n subLayers = [@s@ (offset = 100)]\n)\n"},
                                 {"s", "(\n subLayers = [@w@]\n)\n" + root_with(kTwoClips)},
                                 {"w", weak},
                                 {"a", clip_of("double x.timeSamples = { 0: 1, 5: 6 }")},
                                 {"b", clip_of("double x.timeSamples = { 10: 20 }")}});
  EXPECT_EQ(attribute(stage, "x").value_source(100), ValueSource::ValueClips);
  // Without `times` a clip's time is that of the layer that names it.
  EXPECT_EQ(attribute(stage, "x").time_samples(), (std::vector<double>{100, 105, 110}));
}

TEST(ValueClips, EditsOfArraysChangeWhatWeakerLayersSay) {
  std::string clips = root_with(kTwoClips);
  clips.replace(clips.find("double x"), 8, "float[] x");
  const Stage stage = open_text(
      {{"root", "(\n subLayers = [@s@, @w@]\n)\n"},
       {"s", clips},
       {"w", "def \"M\"\n{\n float[] x = [50, 60]\n}\n"},
       {"a", clip_of("float[] x.timeSamples = { 0: edit [write 1 to [0]], 2: edit [write 3 to [0]],"
                     " 4: [4, 4] }")},
       {"b", clip_of("float[] x.timeSamples = { 10: edit [append 1] }")}});
  const auto text = [&](double time) {
    return formats::value_text(attribute(stage, "x").get(time));
  };
  EXPECT_EQ(text(0), "[1, 60]");
  EXPECT_EQ(text(1), "[2, 60]");
  EXPECT_EQ(text(3), "[3.5, 32]");
  EXPECT_EQ(text(4), "[4, 4]");
  EXPECT_EQ(text(10), "[50, 60, 1]");
}

TEST(ValueClips, AClipWithoutSamplesGivesTheManifestsDefault) {
  const std::string entries = std::string(kTwoClips) + "asset manifestAssetPath = @m@\n";
  const Texts texts{{"a", clip_of("double x.timeSamples = { 0: 1 }")},
                    {"b", clip_of("")},
                    {"m", clip_of("double x = 77\n double y")},
                    {"root", root_with(entries)}};
  const Stage stage = open_text(texts);
  EXPECT_EQ(value(stage, "x", 12), 77);
  EXPECT_EQ(attribute(stage, "y").value_source(1), ValueSource::ValueClips);
  EXPECT_TRUE(attribute(stage, "y").get(1).empty());
}

TEST(ValueClips, MissingValuesAreInterpolatedWhereThatIsAskedFor) {
  const std::string entries =
      "asset[] assetPaths = [@a@, @b@, @c@]\n string primPath = \"/C\"\n"
      "double2[] active = [(0, 0), (10, 1), (20, 2)]\n bool interpolateMissingClipValues = true\n";
  const Stage stage = open_text({{"root", root_with(entries)},
                                 {"a", clip_of("double x.timeSamples = { 0: 0 }")},
                                 {"b", clip_of("")},
                                 {"c", clip_of("double x.timeSamples = { 20: 20 }")}});
  EXPECT_EQ(value(stage, "x", 15), 15);
  EXPECT_EQ(attribute(stage, "x").time_samples(), (std::vector<double>{0, 20}));
}

TEST(ValueClips, DescendantsLookIntoTheClipsOfTheirAncestors) {
  const std::string root = root_with(kTwoClips);
  const std::string child = " def \"K\"\n {\n  double x\n }\n}\n";
  const std::string clip =
      "def \"C\"\n{\n def \"K\"\n {\n double x.timeSamples = { 0: 4 }\n }\n}\n";
  const Stage stage = open_text(
      {{"root", root.substr(0, root.size() - 2) + child}, {"a", clip}, {"b", clip_of("")}});
  const Attribute x = stage.prim(Path::from("/M/K")).attribute("x");
  EXPECT_EQ(x.get_as<double>(1.0), 4.0);
}

TEST(ValueClips, ATemplateFindsTheFilesThatExist) {
  const std::string entries =
      "string templateAssetPath = \"./clip.##.#.usd\"\n string primPath = \"/C\"\n"
      "double templateStartTime = 1\n double templateEndTime = 3\n double templateStride = 0.5\n";
  const Stage stage =
      open_text({{"root", root_with(entries)},
                 {"./clip.01.0.usd", clip_of("double x.timeSamples = { 1: 10 }")},
                 {"./clip.02.5.usd", clip_of("double x.timeSamples = { 2.5: 25 }")}});
  EXPECT_EQ(attribute(stage, "x").time_samples(), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(value(stage, "x", 2.5), 25);
}

TEST(ValueClips, AnEndlessTemplateIsAWarning) {
  const std::string entries =
      "string templateAssetPath = \"./clip.#.usd\"\n string primPath = \"/C\"\n"
      "double templateStartTime = 0\n double templateEndTime = 1e9\n double templateStride = "
      "1e-9\n";
  const Stage stage = open_text({{"root", root_with(entries)}});
  EXPECT_EQ(clip_warnings(stage), 1u);
  EXPECT_EQ(attribute(stage, "x").value_source(1), ValueSource::None);
}

TEST(ValueClips, AMissingClipIsAWarningOnceAndHasNoSamples) {
  const Stage stage = open_text(
      {{"root", root_with(kTwoClips)}, {"a", clip_of("double x.timeSamples = { 0: 1 }")}});
  EXPECT_TRUE(attribute(stage, "x").get(12).empty());
  EXPECT_EQ(clip_warnings(stage), 1u);
}

TEST(ValueClips, BrokenSetsAreLeftOut) {
  const char* const broken[] = {
      "asset[] assetPaths = [@a@]\n string primPath = \"/C\"\n double2[] active = [(0, 1)]",
      "asset[] assetPaths = [@a@]\n string primPath = \"C\"\n double2[] active = [(0, 0)]",
      "asset[] assetPaths = [@a@]\n string primPath = \"/C\"\n"
      "double2[] active = [(0, 0), (0, 0)]",
      "asset[] assetPaths = [@a@]\n string primPath = \"/C\"\n double2[] active = [(nan, 0)]",
      "asset[] assetPaths = [@a@]\n string primPath = \"/C\"\n double2[] active = [(0, 0)]\n"
      "double2[] times = [(0, 0), (0, 1), (0, 2)]",
  };
  for (const char* const entries : broken) {
    const Stage stage = open_text(
        {{"root", root_with(entries)}, {"a", clip_of("double x.timeSamples = { 0: 1 }")}});
    EXPECT_EQ(attribute(stage, "x").value_source(1), ValueSource::None) << entries;
    EXPECT_EQ(clip_warnings(stage), 1u) << entries;
  }
}

TEST(ValueClips, TimeCodesAreTimesOfTheClip) {
  std::string root = root_with(
      "asset[] assetPaths = [@a@]\n string primPath = \"/C\"\n double2[] active = [(0, 0)]\n"
      "double2[] times = [(100, 0), (110, 10)]");
  root.replace(root.find("double x"), 8, "timecode x");
  const Stage stage =
      open_text({{"root", root}, {"a", clip_of("timecode x.timeSamples = { 0: 3, 10: 13 }")}});
  EXPECT_EQ(attribute(stage, "x").get_as<layer::TimeCode>(105.0)->value, 108);
}

}  // namespace
}  // namespace tenon::stage
