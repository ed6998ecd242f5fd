// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// The value in place equals that of get(), for every source of a value.
#include <string>

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

struct Counts {
  int in_place = 0;
  int nothing = 0;
  int read = 0;
};

void compare(const Prim& prim, Token name, Counts& counts) {
  const Attribute attribute = prim.attribute(name);
  const layer::Value* const found = attribute.value_in_place();
  if (found == nullptr) {
    ++counts.read;
    return;
  }
  ++(found->empty() ? counts.nothing : counts.in_place);
  EXPECT_TRUE(*found == attribute.get()) << attribute.path().str();
}

/// Every attribute that a layer or a schema has, and one that nothing has.
Counts compare_all(const Stage& stage) {
  Counts counts;
  std::vector<Prim> pending{stage.pseudo_root()};
  while (!pending.empty()) {
    const Prim prim = pending.back();
    pending.pop_back();
    for (const Token name : prim.property_names()) {
      compare(prim, name, counts);
    }
    compare(prim, Token("nobody:has:this"), counts);
    for (const Prim& child : prim.children()) {
      pending.push_back(child);
    }
  }
  return counts;
}

TEST(ValueInPlace, IsWhatGetGives) {
  const Stage stage = open_text(
      {{"root",
        "(; subLayers = [@mid@, @weak@]; )"
        "def Mesh \"A\" (; references = @part@</P> (offset = 5; scale = 2); ) {"
        " double x = 1; int[] y = edit [append 3]; asset z = @part@; timecode t = 3;"
        " double blocked = None; double hidden = AnimationBlock; double samples.timeSamples ="
        " { 1: 2 }; rel r = </A>; pathExpression e = \"//\"; double refined; double[] list = [1];"
        " double a.connect = </A.x>; }"
        "def Cube \"B\" (; instanceable = true; references = @part@</P>; ){; }"
        "def Sphere \"C\" {; double radius = 2; double radius.timeSamples = { 1: 3 }; }"
        "def \"D\" (; variants = {; string v = \"two\"; }; prepend variantSets = [\"v\"]; ) {"
        " double own = 1; variantSet \"v\" = {; \"two\" {; double inside = 2; double own = 4; }; };"
        " }"},
       {"mid",
        "over \"A\" {; double x = 2; int[] y = [1, 2]; double blocked = 4; double hidden = 5; }"},
       {"weak", "over \"A\" {; double refined = 8; double x = 3; double only_weak = 9; }"},
       {"part",
        "def Sphere \"P\" {; double from_part = 3; timecode late = 7; asset image = @part@;"
        " color3f[] primvars:displayColor = [(1, 0, 0)]; uniform token[] xformOpOrder = []; }"}});
  const Counts counts = compare_all(stage);
  EXPECT_GT(counts.in_place, 30);
  EXPECT_GT(counts.nothing, 20);
  EXPECT_GT(counts.read, 8);
}

// More names than a list is searched for, in one layer and in two; places in the list of a prim
// that two layers name differ from those in each layer.
TEST(ValueInPlace, IsFoundWhereverThePropertyStands) {
  std::string many;
  std::string odd;
  for (int i = 0; i < 100; ++i) {
    many += "double n" + std::to_string(i) + " = " + std::to_string(i) + "; ";
    if (i % 2 == 1 && i < 40) {
      odd += "double n" + std::to_string(40 - i) + " = " + std::to_string(-i) + "; ";
    }
  }
  const Stage stage =
      open_text({{"root", "(; subLayers = [@weak@]; )def \"Few\" {; " + odd +
                              "def \"Child\" {; double c = 1; }; }"
                              "over \"Many\" {; " +
                              odd + "; }"},
                 {"weak", "over \"Few\" {; double first = 1; " + odd +
                              "double last = 2; }def \"Many\" {; " + many + "; }"}});
  const Counts counts = compare_all(stage);
  EXPECT_EQ(counts.in_place, 22 + 1 + 100);
  EXPECT_EQ(counts.read, 0);
}

}  // namespace
}  // namespace tenon::stage
