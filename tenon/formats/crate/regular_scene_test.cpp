// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Scenes so regular that their binary layers are a thousandth of their content: what the writer
// writes, the reader reads.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tenon/formats/crate/reader.h"
#include "tenon/formats/crate/writer.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/save_layer.h"
#include "tenon/formats/text/write/writer.h"
#include "tenon/layer/fields.h"

namespace tenon::formats {
namespace {

using layer::Layer;
using layer::SpecKind;
using layer::Value;

#if defined(__SANITIZE_ADDRESS__)
constexpr std::size_t kSide = 100;
#else
constexpr std::size_t kSide = 320;
#endif

Result<Layer> read_any(const std::string& bytes) {
  Diagnostics diagnostics;
  return read_layer(bytes::FileBytes::own(bytes), "back", diagnostics);
}

/// `side` groups of as many prims, each with an attribute when `attribute` is set.
Layer groups(std::size_t side, bool attribute) {
  Layer made("made");
  const auto names = [&](const char* start) {
    std::vector<Token> all;
    for (std::size_t i = 0; i < side; ++i) {
      all.emplace_back(start + std::to_string(i));
    }
    return all;
  };
  const std::vector<Token> outer = names("g");
  const std::vector<Token> inner = names("c");
  made.root().set("primChildren", outer);
  for (const Token group : outer) {
    const Path top = Path::absolute_root().child(group);
    layer::Spec& spec = made.create(top, SpecKind::Prim);
    spec.set("specifier", layer::Specifier::Def);
    spec.set("primChildren", inner);
    for (const Token name : inner) {
      layer::Spec& prim = made.create(top.child(name), SpecKind::Prim);
      prim.set("specifier", layer::Specifier::Def);
      if (attribute) {
        prim.set("properties", std::vector<Token>{"size"});
        layer::Spec& size = made.create(top.child(name).property("size"), SpecKind::Attribute);
        size.set("typeName", Token("double"));
        size.set("custom", false);
        size.set("variability", layer::Variability::Varying);
        size.set("default", 1.5);
      }
    }
  }
  return made;
}

void expect_same(const Layer& a, const Layer& b) {
  ASSERT_EQ(a.spec_count(), b.spec_count());
  for (const Layer::Entry& entry : a.entries()) {
    const layer::Spec* other = b.find(entry.path);
    ASSERT_NE(other, nullptr) << entry.path.str();
    ASSERT_EQ(other->fields().size(), entry.spec.fields().size()) << entry.path.str();
    for (const layer::Field& field : entry.spec.fields()) {
      const Value* value = other->find(field.name);
      ASSERT_TRUE(value != nullptr && *value == field.value) << entry.path.str();
    }
  }
}

TEST(RegularScene, ReadsBackAsCrateAndAsText) {
  for (const bool attribute : {false, true}) {
    const Layer made = groups(kSide, attribute);
    const auto crate = write_crate(made);
    ASSERT_TRUE(crate);
    EXPECT_LT(crate->size(), made.spec_count());
    const auto back = read_any(*crate);
    ASSERT_TRUE(back) << back.error().to_string();
    expect_same(made, *back);
    const auto from_text = read_any(write_text(made));
    ASSERT_TRUE(from_text) << from_text.error().to_string();
    expect_same(made, *from_text);
  }
}

Layer with_default(const char* type, Value value) {
  Layer made("made");
  made.root().set("primChildren", std::vector<Token>{"A"});
  layer::Spec& prim = made.create(Path::from("/A"), SpecKind::Prim);
  prim.set("specifier", layer::Specifier::Def);
  prim.set("properties", std::vector<Token>{"a"});
  layer::Spec& spec = made.create(Path::from("/A.a"), SpecKind::Attribute);
  spec.set("typeName", Token(type));
  spec.set("default", std::move(value));
  return made;
}

void expect_value_back(const char* type, const Value& value) {
  const auto crate = write_crate(with_default(type, value));
  ASSERT_TRUE(crate);
  EXPECT_LT(crate->size(), 1'000'000u);
  const auto back = read_any(*crate);
  ASSERT_TRUE(back) << back.error().to_string();
  const auto decoded = back->find(Path::from("/A.a"))->find("default")->decoded();
  ASSERT_TRUE(decoded) << decoded.error().to_string();
  EXPECT_TRUE(*decoded == value);
}

TEST(RegularScene, MillionsOfEqualElements) {
  expect_value_back("int[]", Value(std::vector<std::int32_t>(16'000'000, 3)));
  expect_value_back("int64[]", Value(std::vector<std::int64_t>(4'000'000, -7)));
  expect_value_back("double[]", Value(std::vector<double>(4'000'000, 0.1)));
}

/// Nothing is written with an empty array in its place.
TEST(RegularScene, ArraysBeyondTheLimitAreNamedWhenTheyAreWritten) {
  const auto many = [](std::int32_t number) {
    return Value(std::vector<std::int32_t>(36'000'000, number));
  };
  Layer made = with_default("int[]", many(3));
  made.find(Path::from("/A.a"))->set("other", many(4));
  const auto crate = write_crate(made);
  ASSERT_TRUE(crate);
  const auto back = read_any(*crate);
  ASSERT_TRUE(back) << back.error().to_string();
  const auto text = encode_layer(*back, LayerFormat::Text);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code(), ErrorCode::Limit);
  EXPECT_EQ(text.error().diagnostic().prim, "/A.a");
}

TEST(RegularScene, LongTextsOfOneLetter) {
  expect_value_back("string", Value(std::string(60'000'000, ' ')));
}

}  // namespace
}  // namespace tenon::formats
