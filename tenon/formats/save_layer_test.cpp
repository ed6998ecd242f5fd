// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/save_layer.h"

#include <gtest/gtest.h>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/open_layer.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats {
namespace {

namespace fields = layer::fields;
using layer::Layer;
using layer::SpecKind;

/// A prim with an attribute; `change` puts into it what no text says.
template <class Change>
Layer from_crate(const Change& change) {
  Layer layer("odd.usda");
  const Path prim = Path::absolute_root().child(Token("A"));
  const Path attribute = prim.property(Token("a"));
  layer.root().set(fields::primChildren, std::vector<Token>{Token("A")});
  layer::Spec& spec = layer.create(prim, SpecKind::Prim);
  spec.set(fields::specifier, layer::Specifier::Def);
  spec.set(fields::properties, std::vector<Token>{Token("a")});
  layer.create(attribute, SpecKind::Attribute).set(fields::typeName, Token("float"));
  change(*layer.find(prim), *layer.find(attribute));
  Diagnostics diagnostics;
  auto bytes = encode_layer(layer, LayerFormat::Crate);
  EXPECT_TRUE(bytes);
  auto back = read_layer(bytes::FileBytes::own(*bytes), "odd.usdc", diagnostics);
  EXPECT_TRUE(back);
  return *std::move(back);
}

void expect_no_text(const Layer& layer) {
  const auto text = encode_layer(layer, LayerFormat::Text);
  ASSERT_FALSE(text) << *text;
  EXPECT_EQ(text.error().code(), ErrorCode::Unsupported);
  EXPECT_EQ(text.error().diagnostic().file, "odd.usdc");
  EXPECT_NE(text.error().diagnostic().fix, "");
  EXPECT_TRUE(encode_layer(layer, LayerFormat::Crate));
}

TEST(SaveLayer, WritesTextOfCratesThatHaveOne) {
  EXPECT_TRUE(encode_layer(
      from_crate([](layer::Spec&, layer::Spec& a) { a.set(fields::default_value, 1.0f); }),
      LayerFormat::Text));
  // Bytes of a string that are no UTF-8 are written as their numbers.
  EXPECT_TRUE(encode_layer(from_crate([](layer::Spec& p, layer::Spec&) {
                             p.set(fields::documentation, std::string("\xff is no UTF-8"));
                           }),
                           LayerFormat::Text));
}

TEST(SaveLayer, RefusesTextThatCannotBeReadBack) {
  expect_no_text(from_crate([](layer::Spec&, layer::Spec& a) {
    a.set(fields::default_value, std::string("no number"));
  }));
  expect_no_text(from_crate(
      [](layer::Spec&, layer::Spec& a) { a.set(fields::typeName, Token("fl\xffoat")); }));
  for (const char* const path : {"a\xff.png", "a\n.png", "a\x7f.png"}) {
    expect_no_text(from_crate([&](layer::Spec&, layer::Spec& a) {
      a.set(fields::typeName, Token("asset"));
      a.set(fields::default_value, layer::AssetPath{path, "", ""});
    }));
  }
  expect_no_text(from_crate([](layer::Spec& p, layer::Spec&) { p.set(Token("no word"), 1.0f); }));
  expect_no_text(
      from_crate([](layer::Spec& p, layer::Spec&) { p.set(fields::kind, layer::Specifier::Def); }));
  Layer layer = from_crate([](layer::Spec&, layer::Spec&) {});
  layer.root().set(fields::specifier, layer::Specifier::Def);
  expect_no_text(layer);
}

// A crate holds equal arrays once; so many in so small a file are no text of a bounded size.
TEST(SaveLayer, RefusesTextOfOneArrayInManyPlaces) {
  const layer::Value array = std::vector<int>(16'384, 7);
  const auto with_places = [&](std::size_t places) {
    return from_crate([&](layer::Spec& prim, layer::Spec&) {
      layer::Dictionary places_of_it;
      for (std::size_t i = 0; i < places; ++i) {
        places_of_it.items[std::to_string(i)] = array;
      }
      prim.set(fields::customData, places_of_it);
    });
  };
  const Layer few = with_places(100);
  EXPECT_TRUE(check_repeated_arrays(few));
  EXPECT_TRUE(encode_layer(few, LayerFormat::Text));
  const Layer many = with_places(2'200);
  EXPECT_FALSE(check_repeated_arrays(many));
  const auto text = encode_layer(many, LayerFormat::Text);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code(), ErrorCode::Limit);
  EXPECT_EQ(text.error().diagnostic().rule, "layer.repeated-arrays");
  EXPECT_TRUE(encode_layer(many, LayerFormat::Crate));
}

// Binary layers may have more levels of prims than text.
TEST(SaveLayer, RefusesTextThatWouldBeNestedTooDeepToBeRead) {
  const auto with_levels = [](std::size_t levels) {
    Layer layer("odd.usda");
    Path path = Path::absolute_root();
    for (std::size_t i = 0; i < levels; ++i) {
      layer.create(path, SpecKind::Prim).set(fields::primChildren, std::vector<Token>{Token("a")});
      path = path.child(Token("a"));
      layer.create(path, SpecKind::Prim).set(fields::specifier, layer::Specifier::Def);
    }
    Diagnostics diagnostics;
    const auto bytes = encode_layer(layer, LayerFormat::Crate);
    EXPECT_TRUE(bytes);
    auto back = read_layer(bytes::FileBytes::own(*bytes), "odd.usdc", diagnostics);
    EXPECT_TRUE(back);
    return *std::move(back);
  };
  EXPECT_TRUE(encode_layer(with_levels(limits::kTextNestingDepth), LayerFormat::Text));
  expect_no_text(with_levels(limits::kTextNestingDepth + 1));
}

}  // namespace
}  // namespace tenon::formats
