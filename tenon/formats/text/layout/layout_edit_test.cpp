// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/layout/layout_edit.h"

#include <functional>

#include <gtest/gtest.h>

#include "tenon/formats/text/reader.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/fields.h"

namespace tenon::formats {
namespace {

using layer::Layer;
using layer::Spec;
using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

// An asset as people write them, two blanks a step.
const char kLaidOut[] = R"(#usda 1.0
# head
(
  defaultPrim = "A"   # which
  upAxis = "Z"
)

# the robot
def Xform "A" (
  kind = "component" # a kind
  customData = {
    int a = 1 # one
    string b = "x"
  }
  variants = {
    string look = "red"
  }
)
{
  # sizes
  double size = 1   # metres
  double x.timeSamples = {
    0: 1, # start
    10: 2,
  }
  rel r = </A>

  def "B" { }   # inner

  /* a block */ def Scope "C"
  {
    float y
  }
  variantSet "look" = {
    "red" {
      int v = 1
    }
  }
}
// the end
)";

Layer read_text_layer(std::string_view text) {
  Diagnostics ignored;
  return *read_text(text, "test.usda", ignored);
}

void list(Layer& layer, const char* parent, Token field, const char* name) {
  Spec& spec = *layer.find(Path::from(parent));
  std::vector<Token> names = Layer::children(spec, field);
  names.emplace_back(name);
  spec.set(field, std::move(names));
}

Spec& spec(Layer& layer, const char* path) { return *layer.find(Path::from(path)); }

struct Case {
  const char* name;
  std::function<void(Layer&)> edit;
  const char* from;  // the only part of the text that changes
  const char* to;
};

const Case kCases[] = {
    {"a value", [](Layer& l) { spec(l, "/A.size").set("default", 2.5); }, "double size = 1 ",
     "double size = 2.5 "},
    {"a value that goes", [](Layer& l) { spec(l, "/A.size").erase("default"); },
     "double size = 1   # metres", "double size   # metres"},
    {"a value that comes", [](Layer& l) { spec(l, "/A/C.y").set("default", 0.5f); }, "float y",
     "float y = 0.5"},
    {"a sample",
     [](Layer& l) {
       auto samples = *spec(l, "/A.x").get<layer::TimeSamples>(fields::timeSamples);
       samples.set(0, Value(7.0));
       samples.set(5, Value(8.0));
       spec(l, "/A.x").set(fields::timeSamples, std::move(samples));
     },
     "    0: 1, # start\n", "    0: 7, # start\n    5: 8,\n"},
    {"metadata of the layer", [](Layer& l) { l.root().set("upAxis", Token("Y")); },
     "upAxis = \"Z\"", "upAxis = \"Y\""},
    {"new metadata of the layer", [](Layer& l) { l.root().set("metersPerUnit", 1.0); },
     "  upAxis = \"Z\"\n", "  upAxis = \"Z\"\n  metersPerUnit = 1\n"},
    {"metadata that goes", [](Layer& l) { spec(l, "/A").erase("kind"); },
     "  kind = \"component\" # a kind\n", ""},
    {"a dictionary entry",
     [](Layer& l) {
       auto data = *spec(l, "/A").get<layer::Dictionary>("customData");
       data.items["a"] = Value(3);
       data.items["c"] = Value(4.5);
       spec(l, "/A").set("customData", std::move(data));
     },
     "    int a = 1 # one\n    string b = \"x\"\n",
     "    int a = 3 # one\n    string b = \"x\"\n    double c = 4.5\n"},
    {"a variant selection",
     [](Layer& l) {
       layer::VariantSelections chosen;
       chosen.items["look"] = "blue";
       spec(l, "/A").set(fields::variantSelection, std::move(chosen));
     },
     "look = \"red\"\n  }\n)", "look = \"blue\"\n  }\n)"},
    {"an applied API",
     [](Layer& l) {
       spec(l, "/A").set("apiSchemas", layer::ListOp<Token>::make_prepended({Token("FooAPI")}));
     },
     "    string look = \"red\"\n  }\n)",
     "    string look = \"red\"\n  }\n  prepend apiSchemas = [\"FooAPI\"]\n)"},
    {"a reference where there were no parentheses",
     [](Layer& l) {
       spec(l, "/A/C").set("references", layer::ListOp<layer::Reference>::make_prepended(
                                             {{"./r.usda", Path(), {}, {}}}));
     },
     "def Scope \"C\"\n", "def Scope \"C\" (\n    prepend references = @./r.usda@\n  )\n"},
    {"a type", [](Layer& l) { spec(l, "/A/B").set("typeName", Token("Cube")); }, "def \"B\"",
     "def Cube \"B\""},
    {"a property that comes",
     [](Layer& l) {
       list(l, "/A", fields::properties, "z");
       Spec& z = l.create(Path::from("/A.z"), SpecKind::Attribute);
       z.set("custom", true);
       z.set("typeName", Token("int[]"));
       z.set("variability", layer::Variability::Varying);
       z.set("default", Value(layer::Array<std::int32_t>{1, 2}));
     },
     "  rel r = </A>\n", "  rel r = </A>\n  custom int[] z = [1, 2]\n"},
    {"a property that goes",
     [](Layer& l) {
       l.erase(Path::from("/A.size"));
       spec(l, "/A").set(fields::properties, std::vector<Token>{"x", "r"});
     },
     "  double size = 1   # metres\n", ""},
    {"targets",
     [](Layer& l) {
       spec(l, "/A.r").set(fields::targetPaths,
                           layer::ListOp<Path>::make_prepended({Path::from("/A/B")}));
     },
     "rel r = </A>", "prepend rel r = </A/B>"},
    {"a prim that comes",
     [](Layer& l) {
       list(l, "/A/C", fields::primChildren, "D");
       l.create(Path::from("/A/C/D"), SpecKind::Prim).set("specifier", layer::Specifier::Def);
     },
     "    float y\n", "    float y\n\n    def \"D\"\n    {\n    }\n"},
    {"a prim that goes",
     [](Layer& l) {
       l.erase(Path::from("/A/B"));
       spec(l, "/A").set(fields::primChildren, std::vector<Token>{"C"});
     },
     "\n  def \"B\" { }   # inner\n", ""},
    {"a value in a variant", [](Layer& l) { spec(l, "/A{look=red}.v").set("default", Value(5)); },
     "int v = 1", "int v = 5"},
};

TEST(LayoutEdit, ChangesNothingElse) {
  for (const Case& c : kCases) {
    std::string expected = kLaidOut;
    const std::size_t at = expected.find(c.from);
    ASSERT_NE(at, std::string::npos) << c.name;
    expected.replace(at, std::string(c.from).size(), c.to);
    Layer layer = read_text_layer(kLaidOut);
    c.edit(layer);
    const EditedText edited = edit_text(kLaidOut, layer);
    EXPECT_TRUE(edited.kept_layout) << c.name;
    EXPECT_EQ(edited.text, expected) << c.name;
  }
}

TEST(LayoutEdit, AllAtOnce) {
  Layer layer = read_text_layer(kLaidOut);
  for (const Case& c : kCases) {
    const std::string name = c.name;
    if (name != "a value that goes" && name != "a value" && name != "a property that goes") {
      c.edit(layer);
    }
  }
  const EditedText edited = edit_text(kLaidOut, layer);
  EXPECT_TRUE(edited.kept_layout);
  for (const char* comment : {"# head", "# which", "# the robot", "# one", "# sizes", "# start",
                              "/* a block */", "// the end"}) {
    EXPECT_NE(edited.text.find(comment), std::string::npos) << comment;
  }
}

TEST(LayoutEdit, NoChangeKeepsEveryByte) {
  const EditedText edited = edit_text(kLaidOut, read_text_layer(kLaidOut));
  EXPECT_TRUE(edited.kept_layout);
  EXPECT_EQ(edited.text, kLaidOut);
}

TEST(LayoutEdit, ItemsOfListsComeAndGoAlone) {
  const std::string original =
      "#usda 1.0\n"
      "def \"A\" (prepend apiSchemas = [\"X\",   # first\n"
      "    \"Y\"])\n{\n    rel r = [ </A>,\n        </B> ]\n}\n";
  Diagnostics findings;
  Layer layer = *read_text(original, "a.usda", findings);
  Spec& prim = *layer.find(Path::from("/A"));
  Spec& rel = *layer.find(Path::from("/A.r"));
  const Spec prim_before = prim;
  const Spec rel_before = rel;
  auto apis = prim.get_or(fields::apiSchemas, layer::ListOp<Token>{});
  apis.prepended.emplace_back("Z");
  prim.set(fields::apiSchemas, Value(apis));
  rel.set(fields::targetPaths, Value(layer::ListOp<Path>::make_explicit(
                                   {Path::from("/A"), Path::from("/B"), Path::from("/C")})));
  const EditedText more = edit_text(original, layer);
  EXPECT_NE(more.text.find("\"X\",   # first\n    \"Y\", \"Z\"])"), std::string::npos) << more.text;
  EXPECT_NE(more.text.find("[ </A>,\n        </B>, </C> ]"), std::string::npos) << more.text;
  prim = prim_before;
  rel = rel_before;
  EXPECT_EQ(edit_text(more.text, layer).text, original);
}

TEST(LayoutEdit, ParenthesesGoWithTheLastStatementInThem) {
  const std::string original = "#usda 1.0\n\ndef \"A\"\n{\n}\n";
  Diagnostics findings;
  Layer layer = *read_text(original, "a.usda", findings);
  Spec& prim = *layer.find(Path::from("/A"));
  prim.set(fields::kind, Token("component"));
  const EditedText more = edit_text(original, layer);
  EXPECT_NE(more.text.find("kind"), std::string::npos);
  prim.erase(fields::kind);
  EXPECT_EQ(edit_text(more.text, layer).text, original);
}

TEST(LayoutEdit, ARenamedPrimKeepsItsLayout) {
  const std::string original =
      "#usda 1.0\ndef \"A\" { # one\n  def \"B\"   # two\n  {\n    float x = 1e-07  # three\n  "
      "}\n}\n";
  Diagnostics findings;
  std::string wanted = original;
  wanted.replace(wanted.find("\"B\""), 3, "\"Other\"");
  const Layer layer = *read_text(wanted, "a.usda", findings);
  const EditedText edited = edit_text(original, layer);
  EXPECT_EQ(edited.text, wanted);
  EXPECT_TRUE(edited.kept_layout);
}

TEST(LayoutEdit, WhatCannotBeDoneInPlaceIsToldAndWrittenAnew) {
  Layer layer = read_text_layer(kLaidOut);
  spec(layer, "/A{look=red}").set("typeName", Token("Cube"));  // which no text can say
  const EditedText edited = edit_text(kLaidOut, layer);
  EXPECT_FALSE(edited.kept_layout);
  EXPECT_EQ(edited.text, write_text(layer));
  EXPECT_FALSE(edit_text("no layer", layer).kept_layout);
}

TEST(LayoutEdit, PrimsChangePlaces) {
  const char text[] =
      "#usda 1.0\n# a\ndef \"A\"\n{\n}\n# b\ndef \"B\"\n{\n}\n# c\ndef \"C\" # C\n{\n}\n";
  Layer layer = read_text_layer(text);
  layer.root().set(fields::primChildren, std::vector<Token>{"B", "A", "C"});
  const EditedText edited = edit_text(text, layer);
  EXPECT_TRUE(edited.kept_layout);
  EXPECT_NE(edited.text.find("# c\ndef \"C\" # C\n"), std::string::npos) << edited.text;
}

TEST(LayoutEdit, OneLineTextsAndEmptyOnes) {
  Layer layer = read_text_layer("#usda 1.0\n");
  list(layer, "/", fields::primChildren, "A");
  layer.create(Path::from("/A"), SpecKind::Prim).set("specifier", layer::Specifier::Def);
  EXPECT_EQ(edit_text("#usda 1.0\n", layer).text, "#usda 1.0\n\ndef \"A\"\n{\n}\n");

  const char text[] = "#usda 1.0\ndef \"A\" (kind = \"x\"; hidden = true) { int a = 1; int b; }\n";
  layer = read_text_layer(text);
  spec(layer, "/A").set("active", false);
  spec(layer, "/A.a").set("default", Value(2));
  const EditedText edited = edit_text(text, layer);
  EXPECT_TRUE(edited.kept_layout) << edited.text;
}

}  // namespace
}  // namespace tenon::formats
