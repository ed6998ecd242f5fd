// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/compose/cache/index_cache.h"

#include <gtest/gtest.h>

#include "tenon/compose/targets.h"
#include "tenon/compose/test_scene.h"

namespace tenon::compose {
namespace {

using Scene = TestScene;

TEST(IndexCache, OrdersArcsByKind) {
  Scene scene(R"(
def "A" (
    references = </R>
    payload = </P>
    inherits = </I>
    specializes = </S>
    variants = { string v = "a" }
    prepend variantSets = "v"
) { variantSet "v" = { "a" { } } }
def "R" {} def "P" {} class "I" {} class "S" {})");
  EXPECT_EQ(scene.specs("/A"), "root/A, root/I, root/A{v=a}, root/R, root/P, root/S");
  EXPECT_EQ(scene.errors("/A"), "");
}

TEST(IndexCache, MapsTimesOverSublayersAndReferences) {
  Scene scene({{"root", "(subLayers = [@sub@ (offset = 10; scale = 2)])"},
               {"sub", R"(def "A" (references = @ref@ (offset = 1)) {})"},
               {"ref", "(defaultPrim = \"B\"\n timeCodesPerSecond = 48)\ndef \"B\" {}"}});
  const PrimIndex& index = scene.at("/A");
  ASSERT_EQ(index.opinions().size(), 2u);
  EXPECT_EQ(index.opinions()[0].offset, layer::LayerOffset(10, 2));
  EXPECT_EQ(index.opinions()[1].offset, layer::LayerOffset(12, 1));  // 10 + 2 * (1 + t / 2)
}

TEST(IndexCache, NamesWhatReferencesLack) {
  Scene scene({{"root", R"(
def "NoLayer" (references = @absent@</B>) {}
def "NoPrim" (references = @ref@</C>) {}
def "NoDefault" (references = @ref@) {}
def "Backwards" (references = @ref@</B> (scale = -1)) {})"},
               {"ref", "def \"B\" {}"}});
  EXPECT_EQ(scene.errors("/NoLayer"), "invalid-asset-path");
  EXPECT_EQ(scene.errors("/NoPrim"), "unresolved-prim-path");
  EXPECT_EQ(scene.errors("/NoDefault"), "unresolved-prim-path");
  EXPECT_EQ(scene.errors("/Backwards"), "invalid-reference-offset");
  EXPECT_TRUE(scene.at("/Backwards").opinions()[1].offset.is_identity());
  ASSERT_EQ(scene.cache().missing_arcs().size(), 1u);
  EXPECT_EQ(scene.cache().missing_arcs()[0].path, "absent");
}

TEST(IndexCache, IncludesPayloadsByTheNearestRule) {
  const std::map<std::string, std::string> texts = {{"root", R"(
def "A" (payload = </P>) { def "B" (payload = </P>) {} }
def "C" (payload = </P>) {}
class "P" { def "x" {} })"}};
  ComposeOptions options;
  options.unloaded = {Path::from("/A/B"), Path::from("/C")};
  Scene some(texts, options);
  EXPECT_EQ(some.specs("/A"), "root/A, root/P");
  EXPECT_EQ(some.specs("/A/B"), "root/A/B");
  EXPECT_EQ(some.specs("/C"), "root/C");
  EXPECT_TRUE(some.at("/C").has_payloads);
  EXPECT_FALSE(some.at("/C").payload_loaded);
  options = {};
  options.load_payloads = false;
  options.loaded = {Path::from("/A/B")};
  Scene below(texts, options);
  EXPECT_EQ(below.children("/A"), "x B");  // what is above a loaded prim is loaded as well
  EXPECT_EQ(below.specs("/C"), "root/C");
  options.unloaded = {Path::from("/C/x")};
  options.loaded = {Path::from("/C/x/y")};
  Scene hidden(texts, options);
  EXPECT_EQ(hidden.specs("/C"), "root/C");  // not from above one that is not to be loaded
  options = {};
  options.loaded_alone = {Path::from("/A")};
  options.unloaded = {Path::absolute_root()};
  Scene alone(texts, options);
  EXPECT_EQ(alone.children("/A"), "x B");
  EXPECT_EQ(alone.specs("/A/B"), "root/A/B");
  EXPECT_EQ(alone.specs("/C"), "root/C");
}

TEST(IndexCache, ImpliesClassesAcrossReferences) {
  Scene scene({{"root", R"(
def "A" (references = @ref@</M>) { class "K" {} }
class "C" {})"},
               {"ref", R"(
def "M" (inherits = </C>) { class "K" {} def "x" (inherits = </M/K>) {} }
class "C" {})"}});
  EXPECT_EQ(scene.specs("/A"), "root/A, root/C, ref/M, ref/C");
  EXPECT_EQ(scene.specs("/A/x"), "root/A/K, ref/M/x, ref/M/K");
}

TEST(IndexCache, KeepsSpecializesWeakest) {
  Scene scene({{"root", R"(
def "A" (references = @ref@</M>) {}
class "S" {})"},
               {"ref", R"(
def "M" (specializes = </S>
 references = </R>) {}
class "S" (inherits = </C>) {}
class "C" {}
def "R" {})"}});
  EXPECT_EQ(scene.specs("/A"), "root/A, ref/M, ref/R, root/S, ref/S, ref/C");
}

TEST(IndexCache, TakesTheStrongestSelectionOrAFallback) {
  const std::map<std::string, std::string> texts = {{"root", R"(
def "A" (references = </R>
 variants = { string v = "b" }) {}
def "F" (references = </R>) {}
def "R" (prepend variantSets = ["v", "w"]
 variants = { string v = "a" }) {
  variantSet "v" = { "a" (variants = { string w = "x" }) { }
 "b" { def "nested" (prepend variantSets = "v"
 variants = { string v = "in" }) { variantSet "v" = { "in" { def "deep" {} } } } } }
  variantSet "w" = { "x" { def "wx" {} }
 "y" { def "wy" {} } }
})"}};
  ComposeOptions options;
  options.variant_fallbacks["w"] = {"z", "y"};
  Scene scene(texts, options);
  EXPECT_EQ(scene.at("/A").extras().variant_selections.at("v"), "b");
  EXPECT_EQ(scene.at("/A").extras().variant_selections.at("w"), "y");  // no "z" there
  EXPECT_EQ(scene.children("/A"), "wy nested");
  EXPECT_EQ(scene.children("/A/nested"), "deep");
  EXPECT_EQ(scene.at("/F").extras().variant_selections.at("w"),
            "x");  // selected within variant "a"
}

TEST(IndexCache, MovesRelocatedPrims) {
  Scene scene({{"root", R"((relocates = {</A/x>: </A/g/q>, </A/gone>: <>})
def "A" (references = @ref@</M>) { def "g" { over "q" {} } })"},
               {"ref", "def \"M\" { def \"x\" { def \"y\" {} } def \"gone\" {} def \"z\" {} }"}});
  EXPECT_EQ(scene.children("/A"), "z g");
  EXPECT_EQ(scene.specs("/A/g/q"), "root/A/g/q, ref/M/x");
  EXPECT_EQ(scene.specs("/A/g/q/y"), "ref/M/x/y");
  EXPECT_EQ(scene.specs("/A/x"), "");
  EXPECT_EQ(scene.at("/A").extras().prohibited_child_names.size(), 2u);
}

TEST(IndexCache, DropsRelocatesThatContradictThemselves) {
  Scene scene(R"((relocates = {
    </A>: </B>,
    </A/x>: </A/x/y>,
    </A/a>: </A/same>,
    </A/b>: </A/same>,
    </A/c>: </A/d>,
    </A/d>: </A/e>,
})
def "A" {})");
  EXPECT_EQ(scene.stack_errors(),
            "invalid-authored-relocation invalid-authored-relocation "
            "invalid-same-target-relocations invalid-conflicting-relocation "
            "invalid-conflicting-relocation");
  EXPECT_FALSE(scene.cache().layer_stack()->has_relocates());
}

TEST(IndexCache, ReportsOpinionsAtRelocationSources) {
  Scene scene({{"root", R"((relocates = {</A/x>: </A/q>})
def "A" (references = @ref@</M>) { over "x" {} }
def "B" (references = </A/x>) {})"},
               {"ref", "def \"M\" { def \"x\" {} }"}});
  EXPECT_EQ(scene.errors("/A/q"), "opinion-at-relocation-source");
  EXPECT_EQ(scene.specs("/A/q"), "ref/M/x");
  EXPECT_EQ(scene.errors("/B"), "arc-to-prohibited-child");
}

TEST(IndexCache, SharesWhatInstancesBringIn) {
  Scene scene({{"root", R"(
def "A" (references = @ref@</M>
 instanceable = true) { over "x" {} def "own" {} }
def "B" (references = @ref@</M>
 instanceable = true) {}
def "C" (references = @ref@</M> (offset = 1)
 instanceable = true) {}
def "Plain" (instanceable = true) {})"},
               {"ref", "def \"M\" { def \"x\" {} }"}});
  EXPECT_EQ(scene.children("/A"), "x");
  EXPECT_EQ(scene.specs("/A/x"), "ref/M/x");
  EXPECT_EQ(scene.at("/A").extras().instance_key, scene.at("/B").extras().instance_key);
  EXPECT_NE(scene.at("/A").extras().instance_key, scene.at("/C").extras().instance_key);
  EXPECT_FALSE(scene.at("/Plain").instanceable);
}

TEST(IndexCache, EndsAtCyclesWithAFinding) {
  Scene scene({{"root", R"(
def "A" (references = </B>) {}
def "B" (references = </A>) {}
def "C" (inherits = </C/x>) { def "x" {} }
def "D" (references = @ref@</D>) {})"},
               {"ref", "def \"D\" (references = @root@</D>) {}"}});
  for (const char* prim : {"/A", "/B", "/C", "/D"}) {
    EXPECT_EQ(scene.errors(prim), "arc-cycle") << prim;
  }
  EXPECT_EQ(scene.specs("/A"), "root/A, root/B");
}

TEST(IndexCache, StopsWhereArcsMultiply) {
  std::string text;
  for (int i = 0; i < 40; ++i) {
    const std::string next = "</P" + std::to_string(i + 1) + ">";
    text += "def \"P" + std::to_string(i) + "\" (references = [" + next + ", " + next +
            " (offset = 1)]) {}\n";
  }
  Scene scene(text + "def \"P40\" {}");
  EXPECT_EQ(scene.errors("/P0"), "index-capacity-exceeded");
}

TEST(IndexCache, LeavesOutMutedAndRepeatedLayers) {
  ComposeOptions options;
  options.muted = {"quiet", "ref"};
  Scene scene({{"root", R"((subLayers = [@quiet@, @loop@, @absent@])
def "A" (references = @ref@</M>) {})"},
               {"quiet", "over \"A\" {}"},
               {"loop", "(subLayers = [@root@])\nover \"A\" {}"},
               {"ref", "def \"M\" {}"}},
              options);
  EXPECT_EQ(scene.specs("/A"), "root/A, loop/A");
  EXPECT_EQ(scene.errors("/A"), "muted-asset-path");
  EXPECT_EQ(scene.stack_errors(), "invalid-sublayer-path sublayer-cycle");
}

TEST(IndexCache, MutesLayersThatCannotBeOpened) {
  ComposeOptions options;
  options.muted = {"absent", "/shots/absent.usda", "/lost.usda"};
  Scene scene({{"root", "(subLayers = [@absent@, @/shots/a.usda@])\ndef \"A\" {}"},
               {"/shots/a.usda", R"((subLayers = [@./absent.usda@])
over "A" (references = @../lost.usda@</M>) {})"}},
              options);
  EXPECT_EQ(scene.errors("/A"), "muted-asset-path");
  EXPECT_EQ(scene.stack_errors(), "");
}

TEST(IndexCache, PutsTheSessionFirst) {
  Scene scene({{"root", R"(def "A" (prepend variantSets = "v"
 variants = { string v = "a" }) { variantSet "v" = { "a" { }
 "b" { def "b" {} } } })"},
               {"session", "over \"A\" (variants = { string v = \"b\" }) {}"}});
  EXPECT_EQ(scene.specs("/A"), "session/A, root/A, root/A{v=b}");
  EXPECT_EQ(scene.children("/A"), "b");
}

TEST(IndexCache, EvaluatesExpressions) {
  Scene scene({{"root", R"((expressionVariables = { string WHICH = "one"
 string WRONG = "`1`" }
 subLayers = [@`"${WHICH}"`@])
def "A" (references = @`"${WHICH}"`@</M>) {}
def "Bad" (references = @`${WRONG}`@</M>) {}
def "V" (prepend variantSets = "v"
 variants = { string v = "`${WHICH}`" }) { variantSet "v" = { "one" { def "x" {} } } })"},
               {"one", R"((expressionVariables = { string WHICH = "weaker" })
def "M" {} over "A" {})"}});
  EXPECT_EQ(scene.specs("/A"), "root/A, one/A, one/M");
  EXPECT_EQ(scene.children("/V"), "x");
  EXPECT_EQ(scene.errors("/Bad"), "variable-expression-error");
}

TEST(IndexCache, FoldsListEditsOverLayers) {
  Scene scene({{"root", R"((subLayers = [@one@])
def "A" (prepend references = </P>
 delete references = </Q>
 append references = </R>) {}
def "P" {} def "Q" {} def "R" {} def "S" {})"},
               {"one", "over \"A\" (references = [</R>, </Q>, </S>]) {}"}});
  EXPECT_EQ(scene.specs("/A"), "root/A, one/A, root/P, root/S, root/R");
}

TEST(IndexCache, MapsTargetsAndNamesThoseOutside) {
  Scene scene({{"root", "def \"A\" (references = @ref@</M>) {}"},
               {"ref", R"(def "M" { rel to = [</M/x>, <x.a>, </Other>]
 def "x" {} }
def "Other" {})"}});
  const TargetList targets = compose_targets(scene.cache(), scene.at("/A"), Token("to"));
  ASSERT_EQ(targets.paths.size(), 2u);
  EXPECT_EQ(targets.paths[0], Path::from("/A/x"));
  EXPECT_EQ(targets.paths[1], Path::from("/A/x.a"));
  ASSERT_EQ(targets.errors.size(), 1u);
}

}  // namespace
}  // namespace tenon::compose
