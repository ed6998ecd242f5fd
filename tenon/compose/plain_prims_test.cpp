// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/compose/dump_index.h"
#include "tenon/compose/test_scene.h"

namespace tenon::compose {
namespace {

const char* const kPlainSession = R"(over "A" { over "b" { custom double session } })";

const char* const kPlainRoot = R"(
def "A" (kind = "group") {
  custom double x
  rel to = </A/b>
  def "b" { reorder nameChildren = ["d", "c"]
    def "c" {
      double y
      double z }
    def "d" { def "deep" { custom string s } } }
  over "only" { }
  def "from_class" (inherits = </C>) { def "mine" { double m } }
}
class "C" { def "theirs" { } })";

const char* const kPlainSublayer = R"(
over "A" { reorder properties = ["z", "x"]
  custom double z
  def "b" { def "weak" { } def "c" { custom double w } }
  def "sub" { def "below" { double v } } })";

const std::vector<Path>& compared_prims() {
  static const std::vector<Path> paths = [] {
    std::vector<Path> all;
    for (const char* path : {"/A", "/A/b", "/A/b/c", "/A/b/d", "/A/b/d/deep", "/A/b/weak",
                             "/A/only", "/A/sub", "/A/sub/below", "/A/none", "/A/from_class",
                             "/A/from_class/mine", "/A/from_class/theirs"}) {
      all.push_back(Path::from(path));
    }
    return all;
  }();
  return paths;
}

/// Everything that indices hold, of a scene with these metadata of its root layer.
std::string dump_with(const std::string& metadata, bool session, bool sublayer) {
  std::map<std::string, std::string> texts{{"sub", kPlainSublayer}};
  const std::string layers = sublayer ? "subLayers = [@sub@ (offset = 3)]\n" : "";
  texts["root"] = "(" + layers + metadata + ")" + kPlainRoot;
  if (session) {
    texts["session"] = kPlainSession;
  }
  TestScene scene(texts);
  const LayerLabel label = [](const layer::Layer& layer) { return layer.identifier(); };
  std::string text = dump_indices(scene.cache(), label, compared_prims());
  for (const Path path : compared_prims()) {
    text += path.str() + "\n" + dump_nodes(scene.cache().index(path), label);
  }
  return text;
}

/// A relocate, wherever it is, has all prims composed as those with arcs are.
TEST(PlainPrims, AreComposedLikeThoseWithArcs) {
  const std::string relocate = "relocates = { </Elsewhere/x>: </Elsewhere/y> }\n";
  for (const bool session : {false, true}) {
    for (const bool sublayer : {false, true}) {
      const std::string plain = dump_with("doc = \"plain\"\n", session, sublayer);
      EXPECT_EQ(plain, dump_with(relocate, session, sublayer));
      EXPECT_NE(plain.find("deep"), std::string::npos);
    }
  }
}

const char* const kReferencingRoot = R"(
def "A" (references = @ref@</M> (offset = 4)
 variants = { string v = "x" }) {
  over "b" { custom double stronger }
  def "own" { reorder nameChildren = ["n", "m"]
    def "m" { }
    def "n" { } } }
def "B" (references = @ref@</M>
 instanceable = true) { over "b" { custom double ignored } }
over "C" (specializes = </S>
 payload = </P>) { def "s" { } }
def "D" (inherits = </Silent>
 references = @ref@</M>) { }
class "Silent" { }
class "S" { def "s" { def "deep" { double d } } }
def "P" { def "s" { over "deep" { double p }
    def "more" { } } def "p" { def "q" { } } })";

const char* const kReferenced = R"(
def "M" (prepend variantSets = "v"
 variants = { string v = "y" }) {
  class "K" { def "k" { reorder nameChildren = ["two", "one"]
      def "one" { double o }
      def "two" { } } }
  def "b" { double w
    def "c" (inherits = </M/K>) { over "k" { double over_k }
      def "l" { def "last" { } } } }
  variantSet "v" = {
    "x" { over "b" { double of_x
        def "only_x" { def "below" { } } } }
    "y" { def "only_y" { } }
  } })";

/// All prims of a scene of arcs, as its indices hold them.
std::string dump_below_arcs(const std::string& metadata) {
  TestScene scene({{"root", "(" + metadata + ")" + kReferencingRoot},
                   {"session", "over \"A\" { over \"b\" { over \"c\" { double s } } }"},
                   {"ref", kReferenced}});
  const LayerLabel label = [](const layer::Layer& layer) { return layer.identifier(); };
  std::string text = dump_indices(scene.cache(), label);
  std::vector<Path> open{Path::absolute_root()};
  while (!open.empty()) {
    const PrimIndex& index = scene.cache().index(open.back());
    open.pop_back();
    text += index.path.str() + "\n" + dump_nodes(index, label);
    for (const Opinion& opinion : index.opinions()) {
      text += opinion.path.str() + " of node " + std::to_string(opinion.node) + "\n";
    }
    for (const Token name : index.child_names) {
      open.push_back(index.path.child(name));
    }
  }
  return text;
}

TEST(PlainPrims, BelowArcsAreComposedLikeThoseWithArcs) {
  const std::string plain = dump_below_arcs("doc = \"plain\"");
  EXPECT_EQ(plain, dump_below_arcs("relocates = { </Elsewhere/x>: </Elsewhere/y> }"));
  for (const char* path : {"/A/b/c/k/two", "/A/b/only_x/below", "/A/own/n", "/B/b/c/l/last",
                           "/C/s/deep", "/C/s/more", "/C/p/q"}) {
    EXPECT_NE(plain.find(path), std::string::npos) << path;
  }
}

TEST(PlainPrims, LieInOnePieceOfMemory) {
  TestScene scene{std::string(kPlainRoot)};
  const PrimIndex& index = scene.at("/A/b/d");
  EXPECT_NE(index.kept_nodes.like(), nullptr);
  EXPECT_EQ(index.kept_nodes.like(), scene.at("/A/b").kept_nodes.like());
  EXPECT_EQ(index.nodes().front().path, index.path);
  EXPECT_NE(index.kept_opinions.like(), nullptr);
  EXPECT_EQ(index.kept_opinions.like(), scene.at("/A/b").kept_opinions.like());
  EXPECT_EQ(index.own_extras, nullptr);
  EXPECT_EQ(&index.child_names.list(),
            &layer::Layer::children(*index.opinions().front().spec, Token("primChildren")));
  EXPECT_LE(sizeof(PrimIndex), 8 * sizeof(double));
}

}  // namespace
}  // namespace tenon::compose
