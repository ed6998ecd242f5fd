// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/flatten/flatten.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/layer/fields.h"
#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

namespace fields = layer::fields;

const layer::TimeSamples& samples_of(const layer::Layer& layer, const char* path) {
  return *layer.find(Path::from(path))->get<layer::TimeSamples>(fields::timeSamples);
}

std::string expression_of(const layer::Layer& layer, const char* path) {
  return layer.find(Path::from(path))->get_or(fields::default_value, layer::PathExpression()).text;
}

// 31 * 0.3 is 9.299999999999999, which is 30.999999999999996 * 0.3, before the sample at 31.
TEST(Flatten, ASampleWhoseTimeIsRoundedKeepsItsValue) {
  const Stage stage = open_text({
      {"root", R"(def "M" (references = @late@</F> (scale = 0.3)) {})"},
      {"late", R"(def "F" { token v.timeSamples = { 1: "inherited", 31: "invisible" }
          timecode t.timeSamples = { 31: 31, 41: None } })"},
  });
  const layer::Layer flat = flatten(stage);
  const layer::TimeSamples& samples = samples_of(flat, "/M.v");
  EXPECT_EQ(samples.times, (std::vector<double>{0.3, 31 * 0.3}));
  EXPECT_EQ(samples.values[0].get_or(Token()), "inherited");
  EXPECT_EQ(samples.values[1].get_or(Token()), "invisible");
  const layer::TimeSamples& times = samples_of(flat, "/M.t");
  EXPECT_EQ(times.values[0].get_or(layer::TimeCode{}).value, 31 * 0.3);
  EXPECT_TRUE(times.values[1].is_block());
}

TEST(Flatten, SamplesStayInOrderWhenTimeIsTurnedAround) {
  const Stage stage = open_text({
      {"root", "(timeCodesPerSecond = -24\nsubLayers = [@sub@])"},
      {"sub", R"(def "A" { double x.timeSamples = { 0: 0, 10: 10 } })"},
  });
  const layer::Layer flat = flatten(stage);
  EXPECT_EQ(samples_of(flat, "/A.x").times, (std::vector<double>{-10, 0}));
  EXPECT_EQ(samples_of(flat, "/A.x").values[0].get_or(0.0), 10);
}

TEST(Flatten, WeakerPathExpressionsAreWrittenOut) {
  const Stage stage = open_text({
      {"root", R"((subLayers = [@weak@])
          over "S" { pathExpression e = "/S/A %_"
              pathExpression s.timeSamples = { 1: "%_ /S/A", 2: "/S/C" } })"},
      {"weak", R"(def "S" { pathExpression e = "/S/B"
              pathExpression s = "/S/B" })"},
  });
  const layer::Layer flat = flatten(stage);
  EXPECT_EQ(expression_of(flat, "/S.e"), "/S/A /S/B");
  const layer::TimeSamples& samples = samples_of(flat, "/S.s");
  EXPECT_EQ(samples.values[0].get_or(layer::PathExpression()).text, "/S/B /S/A");
  EXPECT_EQ(samples.values[1].get_or(layer::PathExpression()).text, "/S/C");
}

// OpenUSD writes the path of its own prototype, which is in no file.
TEST(Flatten, PathExpressionsOfPrototypesNameTheirCopies) {
  const Stage stage = open_text(R"(
def "R" { def "C" { pathExpression e = "/R/C %_"
  pathExpression[] l = ["/R//"] } }
def "A" (instanceable = true; references = </R>) {}
)");
  const layer::Layer flat = flatten(stage);
  EXPECT_EQ(expression_of(flat, "/Flattened_Prototype_1/C.e"), "/Flattened_Prototype_1/C");
  const auto* list = flat.find(Path::from("/Flattened_Prototype_1/C.l"))
                         ->find(fields::default_value)
                         ->get<layer::Array<layer::PathExpression>>();
  ASSERT_NE(list, nullptr);
  EXPECT_EQ((*list)[0].text, "/Flattened_Prototype_1//");
}

}  // namespace
}  // namespace tenon::stage
