// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/twins/twins.h"

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/compose/dump_index.h"
#include "tenon/compose/test_scene.h"

namespace tenon::compose {
namespace {

const char* const kTwins = R"(
def "World" {
  def "R1" (references = @ref@</M>) { }
  def "R2" (references = @ref@</M>) { over "b" { double own } }
  def "R3" (references = @ref@</M>) { def "_K" { double of_class } }
  def "R4" (references = @ref@</M>) { double x }
  def "R5" (references = @ref@</M> (offset = 2)) { }
  def "R6" (references = @ref@</M>
 variants = { string v = "other" }) { }
  def "R7" (references = @ref@</M>) { }
})";

const char* const kTwinRobot = R"(
def "M" (prepend variantSets = "v"
 variants = { string v = "one" }) {
  class "_K" { def "k" { double d } }
  def "a" (inherits = </M/_K>) { def "deep" { double e } }
  def "b" { def "c" (references = </M/b/d>) { }
    def "d" { def "more" { } } }
  variantSet "v" = {
    "one" { over "a" { double of_one } }
    "other" { over "a" { double of_other } }
  } })";

std::map<std::string, std::string> twin_scene() { return {{"root", kTwins}, {"ref", kTwinRobot}}; }

/// Everything that indices hold, asked for level by level, and the work that was counted.
std::string dump_twins(const std::map<std::string, std::string>& texts, bool shares) {
  ComposeOptions options;
  options.shares_twins = shares;
  TestScene scene(texts, options);
  const LayerLabel label = [](const layer::Layer& layer) { return layer.identifier(); };
  std::string text;
  std::vector<Path> open{Path::absolute_root()};
  while (!open.empty()) {
    const PrimIndex& index = scene.cache().index(open.back());
    open.pop_back();
    text += index.path.str() + "\n" + dump_nodes(index, label);
    for (const Token name : index.child_names) {
      scene.cache().child_index(index, name);
      open.push_back(index.path.child(name));
    }
  }
  return text + dump_indices(scene.cache(), label) + std::to_string(scene.cache().work());
}

TEST(Twins, AreComposedAsEachByItself) {
  const std::string shared = dump_twins(twin_scene(), true);
  EXPECT_EQ(shared, dump_twins(twin_scene(), false));
  EXPECT_NE(shared.find("/World/R7/b/c/more"), std::string::npos);
}

TEST(Twins, LookOnlyAtTheRootStack) {
  TestScene scene(twin_scene());
  for (const Token name : scene.at("/World").child_names) {
    scene.cache().child_index(scene.at("/World"), name);
  }
  scene.at("/World/R1/a/k");
  SiteTrace trace;
  EXPECT_EQ(scene.specs("/World/R7/a/k"), "ref/M/_K/k");
  const std::vector<SiteTrace::Look> looks = trace.end();
  EXPECT_FALSE(looks.empty());
  for (const SiteTrace::Look& look : looks) {
    EXPECT_EQ(look.stack, scene.cache().layer_stack().get()) << look.path.str();
  }
}

TEST(Twins, AreToldApartByWhatTheRootStackSays) {
  TestScene scene(twin_scene());
  for (const Token name : scene.at("/World").child_names) {
    scene.cache().child_index(scene.at("/World"), name);
  }
  EXPECT_EQ(scene.specs("/World/R1/b"), "ref/M/b");
  EXPECT_EQ(scene.specs("/World/R2/b"), "root/World/R2/b, ref/M/b");
  EXPECT_EQ(scene.specs("/World/R1/a"), "ref/M/a, ref/M/_K, ref/M{v=one}a");
  EXPECT_EQ(scene.specs("/World/R3/a"), "root/World/R3/_K, ref/M/a, ref/M/_K, ref/M{v=one}a");
  EXPECT_EQ(scene.specs("/World/R6/a"), "ref/M/a, ref/M/_K, ref/M{v=other}a");
  EXPECT_EQ(scene.at("/World/R5/a").opinions()[0].offset, layer::LayerOffset(2, 1));
}

/// Where arcs of the parent lead to prims of the same names, these are others below each twin.
TEST(Twins, MayHaveNamesThatAreMetElsewhere) {
  const std::map<std::string, std::string> texts{{"root", R"(
class "_e" { }
def "C" (specializes = </_e>) {
  def "x" (references = </D>) { }
  def "x2" (references = </D>) { }
  def "x3" (references = </D>) { }
}
def "D" { class "_k" { def "y" { } }
  def "y" (inherits = </D/_k>) { } })"}};
  EXPECT_EQ(dump_twins(texts, true), dump_twins(texts, false));
}

}  // namespace
}  // namespace tenon::compose
