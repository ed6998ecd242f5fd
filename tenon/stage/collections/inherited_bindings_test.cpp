// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/stage/collections/inherited_bindings.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tenon/stage/test_stage.h"

namespace tenon::stage {
namespace {

/// Bindings of all sorts, and none, on some of the prims; `collections`: also of collections.
std::string random_bindings(std::mt19937& random, bool collections) {
  static const char* const kTargets[] = {"</M>", "</P>", "</NoMaterial>", "[</M>, </P>]",
                                         "</Gone>"};
  std::string text;
  for (const char* name : {"material:binding", "material:binding:physics"}) {
    if (random() % 3 == 0) {
      const std::string how =
          random() % 2 == 0 ? " (bindMaterialAs = \"strongerThanDescendants\")" : "";
      text += std::string("rel ") + name + " = " + kTargets[random() % 5] + how + "\n";
    }
  }
  if (collections && random() % 6 == 0) {
    text += "rel material:binding:collection:physics:c = [</W.collection:c>, </M>]\n";
  }
  return text;
}

std::string random_tree(std::mt19937& random, int depth, bool collections) {
  std::string text = random_bindings(random, collections);
  for (int i = 0; depth > 0 && i < 3; ++i) {
    text += "def Xform \"x" + std::to_string(i) + "\" {\n" +
            random_tree(random, depth - 1, collections) + "}\n";
  }
  return text;
}

/// Asks for all prims below, in an order that goes down and back up.
void expect_same_below(const Prim& prim, InheritedBindings& fast, Token purpose, int& bound) {
  for (const Prim& child : prim.children()) {
    const MaterialBinding a = fast.find(child);
    const MaterialBinding b = find_material_binding(child, purpose);
    EXPECT_EQ(a.material, b.material) << child.path().str();
    EXPECT_EQ(a.relationship, b.relationship) << child.path().str();
    EXPECT_EQ(a.binding_api_missing, b.binding_api_missing) << child.path().str();
    EXPECT_EQ(a.cut_collection, b.cut_collection) << child.path().str();
    bound += b.material.empty() ? 0 : 1;
    expect_same_below(child, fast, purpose, bound);
  }
}

TEST(InheritedBindings, AreThoseOfEachPrimByItself) {
  std::mt19937 random(11);
  for (int round = 0; round < 30; ++round) {
    const bool collections = round % 3 == 0;
    const Stage stage = open_text(
        Texts{{"root",
               "def Material \"M\" {}\ndef Material \"P\" {}\ndef Xform \"NoMaterial\" {}\n"
               "def Xform \"W\" (apiSchemas = [\"CollectionAPI:c\"]) {\n"
               "rel collection:c:includes = [</W/x0>, </W/x2/x1>]\n" +
                   random_tree(random, 3, collections) +
                   "}\ndef Xform \"I\" (instanceable = true\nreferences = @part@</W>) {\n" +
                   random_bindings(random, collections) + "}\n"},
              {"part", "def Material \"M\" {}\ndef Xform \"W\" {\n" +
                           random_tree(random, 2, collections) + "}\n"}});
    for (const char* purpose : {"physics", "", "full"}) {
      TargetMemo targets;
      InheritedBindings fast{Token(purpose), targets};
      int bound = 0;
      expect_same_below(stage.pseudo_root(), fast, Token(purpose), bound);
      EXPECT_GT(bound, 0) << round;
    }
  }
}

}  // namespace
}  // namespace tenon::stage
