// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/values/value_trace.h"

#include <map>

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

/// "root Default wins 2", one per opinion; of clips also the clip's layer.
std::vector<std::string> lines_of(const ValueTrace& trace) {
  static constexpr const char* kKinds[] = {"declares", "fallback", "default",
                                           "samples",  "clips",    "spline"};
  static constexpr const char* kRoles[] = {"wins", "combined", "loses", "declares"};
  static const std::map<OpinionReason, std::string> reasons{
      {OpinionReason::None, ""},
      {OpinionReason::EditsArray, "edits"},
      {OpinionReason::PutIn, "put in"},
      {OpinionReason::BlocksAnimation, "animation block"},
      {OpinionReason::Weaker, "weaker"},
      {OpinionReason::Blocked, "blocked"},
      {OpinionReason::AnimationBlocked, "animation blocked"},
      {OpinionReason::DefaultTime, "default time"},
      {OpinionReason::Empty, "empty"}};
  std::vector<std::string> lines;
  for (const TracedOpinion& one : trace.opinions) {
    std::string line = one.source.layer == nullptr ? "-" : one.source.layer->identifier();
    line += std::string(" ") + kKinds[static_cast<std::size_t>(one.kind)];
    line += one.clip ? " " + one.clip->set + ":" + one.clip->layer : "";
    line += std::string(" ") + kRoles[static_cast<std::size_t>(one.role)];
    const std::string& reason = reasons.at(one.reason);
    line += reason.empty() ? "" : ": " + reason;
    line += one.decided_by ? " by " + std::to_string(*one.decided_by) : "";
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> traced(const Stage& stage, Time time, const char* path = "/A.a") {
  const Path property = Path::from(path);
  const Attribute attribute = stage.prim(property.parent()).attribute(property.name());
  const ValueTrace trace = attribute.trace(time);
  EXPECT_EQ(trace.value, attribute.get(time));
  EXPECT_EQ(trace.source, attribute.value_source(time));
  return lines_of(trace);
}

using Lines = std::vector<std::string>;

TEST(ValueTrace, SamplesDefaultsAndDeclarations) {
  const Stage stage = open_text({{"root",
                                  "(; subLayers = [@declared@, @weak@]; );"
                                  "over \"A\" {; double a = 2; double a.timeSamples = { 0: 5 }; }"},
                                 {"declared", "over \"A\" {; double a; }"},
                                 {"weak", "def \"A\" {; double a = 1; }"}});
  EXPECT_EQ(traced(stage, 0.0),
            (Lines{"root samples wins", "root default loses: weaker by 0",
                   "declared declares declares", "weak default loses: weaker by 0"}));
  EXPECT_EQ(traced(stage, {}),
            (Lines{"root samples loses: default time", "root default wins",
                   "declared declares declares", "weak default loses: weaker by 1"}));
}

TEST(ValueTrace, BlocksHideTheFallbackToo) {
  const Stage stage =
      open_text({{"root", "(; subLayers = [@weak@]; );def Cube \"A\" {; double size = None; }"},
                 {"weak", "over \"A\" {; double size = 1; }"}});
  const Lines expected{"root default wins", "weak default loses: blocked by 0",
                       "- fallback loses: blocked by 0"};
  EXPECT_EQ(traced(stage, {}, "/A.size"), expected);
  EXPECT_EQ(traced(stage, 3.0, "/A.size"), expected);
}

TEST(ValueTrace, AnimationBlocksHideSamplesButNoDefaults) {
  const Stage stage =
      open_text({{"root", "(; subLayers = [@weak@]; );over \"A\" {; double a = AnimationBlock; }"},
                 {"weak", "def \"A\" {; double a = 1; double a.timeSamples = { 0: 5 }; }"}});
  EXPECT_EQ(traced(stage, 0.0),
            (Lines{"root default combined: animation block",
                   "weak samples loses: animation blocked by 0", "weak default wins"}));
}

TEST(ValueTrace, ClipsStandBetweenTheirLayerAndWeakerOnes) {
  const Stage stage =
      open_text({{"root",
                  "(; subLayers = [@weak@]; );def \"A\" (; clips = {; dictionary default = {;"
                  " asset[] assetPaths = [@c0@, @c1@]; string primPath = \"/M\";"
                  " double2[] active = [(0, 0), (10, 1)]; asset manifestAssetPath = @manifest@;"
                  " }; }; );{; double a; }"},
                 {"weak", "over \"A\" {; double a.timeSamples = { 0: 100 }; }"},
                 {"manifest", "over \"M\" {; double a; }"},
                 {"c0", "over \"M\" {; double a.timeSamples = { 0: 5 }; }"},
                 {"c1", "over \"M\" {; double a.timeSamples = { 10: 6 }; }"}});
  EXPECT_EQ(traced(stage, 3.0), (Lines{"root declares declares", "root clips default:c0 wins",
                                       "weak samples loses: weaker by 1"}));
  EXPECT_EQ(traced(stage, 12.0)[1], "root clips default:c1 wins");
  EXPECT_EQ(traced(stage, {}),
            (Lines{"root declares declares", "root clips default: loses: default time",
                   "weak samples loses: default time"}));
  const ValueTrace trace = stage.prim(Path::from("/A")).attribute(Token("a")).trace(12.0);
  EXPECT_EQ(trace.winner()->source.path, Path::from("/A"));
  EXPECT_EQ(trace.winner()->clip->path, Path::from("/M.a"));
  EXPECT_EQ(trace.winner()->clip->time, 12.0);
  EXPECT_EQ(trace.winner()->value->get<layer::TimeSamples>()->times, std::vector<double>{10});
}

TEST(ValueTrace, ArrayEditsAreCombinedDownToAnArray) {
  const Stage stage = open_text(
      {{"root", "(; subLayers = [@mid@, @weak@]; );def \"A\" {; int[] a = edit [append 3]; }"},
       {"mid", "over \"A\" {; int[] a.timeSamples = { 0: [1], 10: edit [append 2] }; }"},
       {"weak", "over \"A\" {; int[] a = [7]; }"}});
  EXPECT_EQ(traced(stage, 0.0), (Lines{"root default combined: edits", "mid samples wins",
                                       "weak default loses: weaker by 1"}));
  EXPECT_EQ(traced(stage, 10.0), (Lines{"root default combined: edits",
                                        "mid samples combined: edits", "weak default wins"}));
  EXPECT_EQ(traced(stage, {}), (Lines{"root default combined: edits",
                                      "mid samples loses: default time", "weak default wins"}));
}

TEST(ValueTrace, WeakerExpressionsArePutIn) {
  const Stage stage = open_text(
      {{"root", "(; subLayers = [@mid@, @weak@]; );def \"A\" {; pathExpression a = \"/B %_\"; }"},
       {"mid", "over \"A\" {; pathExpression a = \"/C\"; }"},
       {"weak", "over \"A\" {; pathExpression a = \"/D\"; }"}});
  EXPECT_EQ(traced(stage, {}), (Lines{"root default wins", "mid default combined: put in",
                                      "weak default loses: weaker by 0"}));
}

TEST(ValueTrace, OffsetsSplinesAndEmptySamples) {
  const Stage stage =
      open_text({{"root",
                  "(; subLayers = [@weak@ (offset = 10)]; );"
                  "over \"A\" {; double a.timeSamples = {; }; }"},
                 {"weak", "def \"A\" {; double a = 4; double a.spline = {; 0: 1,; 10: 2,; }; }"}});
  EXPECT_EQ(traced(stage, 15.0), (Lines{"root samples loses: empty", "weak spline wins",
                                        "weak default loses: weaker by 1"}));
  const ValueTrace trace = stage.prim(Path::from("/A")).attribute(Token("a")).trace(15.0);
  EXPECT_EQ(trace.winner()->source.offset.offset, 10.0);
  EXPECT_EQ(trace.value, layer::Value(1.0));
}

TEST(ValueTrace, NothingSaidIsNoWinner) {
  const Stage stage = open_text({{"root", "def Cube \"A\" {; double a; }"}});
  EXPECT_EQ(traced(stage, {}), (Lines{"root declares declares"}));
  EXPECT_EQ(traced(stage, {}, "/A.size"), (Lines{"- fallback wins"}));
  const ValueTrace trace = stage.prim(Path::from("/A")).attribute(Token("size")).trace();
  EXPECT_EQ(trace.winner()->schema, Token("Cube"));
  EXPECT_EQ(Attribute().trace().winner(), nullptr);
}

}  // namespace
}  // namespace tenon::stage
