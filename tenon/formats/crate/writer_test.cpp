// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/crate/writer.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tenon/bytes/byte_reader.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/reader.h"
#include "tenon/formats/crate/sample_layer.h"
#include "tenon/layer/fields.h"
#include "tenon/math/functions.h"

namespace tenon::formats {
namespace {

using layer::Layer;
using layer::SpecKind;
using layer::Value;

Result<Layer> read_back(const std::string& bytes) {
  Diagnostics diagnostics;
  auto layer = read_crate(bytes::FileBytes::own(bytes), "back.usdc", diagnostics);
  EXPECT_TRUE(diagnostics.empty());
  return layer;
}

void expect_equal(const Layer& a, const Layer& b) {
  EXPECT_EQ(a.spec_count(), b.spec_count());
  for (const Layer::Entry& entry : a.entries()) {
    const layer::Spec* other = b.find(entry.path);
    ASSERT_NE(other, nullptr) << entry.path.str();
    EXPECT_EQ(other->kind, entry.spec.kind) << entry.path.str();
    EXPECT_EQ(other->fields().size(), entry.spec.fields().size()) << entry.path.str();
    for (const layer::Field& field : entry.spec.fields()) {
      const Value* value = other->find(field.name);
      ASSERT_NE(value, nullptr) << entry.path.str() << " " << field.name.str();
      EXPECT_TRUE(*value == field.value) << entry.path.str() << " " << field.name.str();
    }
  }
}

Layer layer_with(Value value) {
  Layer layer("made");
  layer.root().set("primChildren", std::vector<Token>{"A"});
  layer.create(Path::from("/A"), SpecKind::Prim).set("field", std::move(value));
  return layer;
}

TEST(CrateWriter, GivesBackEveryTypeOfValue) {
  const Layer layer = crate::layer_of_all_types();
  const auto bytes = write_crate(layer);
  ASSERT_TRUE(bytes) << bytes.error().to_string();
  const auto back = read_back(*bytes);
  ASSERT_TRUE(back) << back.error().to_string();
  expect_equal(layer, *back);
  EXPECT_EQ(*write_crate(*back), *bytes);
}

// OpenUSD cannot write such a layer (CONFORMANCE.md).
TEST(CrateWriter, KeepsUnitsOfMeasure) {
  Layer layer = layer_with(1.0);
  layer.find(Path::from("/A"))->set(layer::fields::properties, std::vector<Token>{"a"});
  layer::Spec& length = layer.create(Path::from("/A.a"), SpecKind::Attribute);
  length.set(layer::fields::typeName, Token("double"));
  length.set(layer::fields::displayUnit, Token("mm"));
  const auto back = read_back(*write_crate(layer));
  ASSERT_TRUE(back) << back.error().to_string();
  expect_equal(layer, *back);
}

TEST(CrateWriter, KeepsNegativeZeroInfinityAndNan) {
  for (const double number : {-0.0, kInfinity, -kInfinity, 1e300, 1e-300, 0.1}) {
    const auto back = read_back(*write_crate(layer_with(number)));
    const auto* value = back->find(Path::from("/A"))->get<double>("field");
    EXPECT_EQ(*value, number);
    EXPECT_EQ(std::signbit(*value), std::signbit(number));
  }
  std::vector<double> zeros(20, 0.0);
  zeros[3] = -0.0;
  const auto back = read_back(*write_crate(layer_with(zeros)));
  EXPECT_TRUE(std::signbit((*back->find(Path::from("/A"))->get<layer::Array<double>>("field"))[3]));
  const auto nan = read_back(*write_crate(layer_with(std::nan(""))));
  EXPECT_TRUE(std::isnan(*nan->find(Path::from("/A"))->get<double>("field")));
}

/// Many properties of few kinds, whose fields are shared where they are equal, or their own.
Layer layer_of_like_specs(bool shared) {
  Layer layer("made");
  std::vector<Token> names;
  std::vector<layer::FieldList> lists;
  for (int i = 0; i < 7; ++i) {
    names.push_back(Token("p" + std::to_string(i)));
    layer::Spec spec;
    spec.set(layer::fields::typeName, Token(i % 2 == 0 ? "double" : "float"));
    spec.set(layer::fields::default_value, 0.1 * i);
    lists.push_back(spec.field_list());
  }
  std::vector<Token> children;
  for (int i = 0; i < 600; ++i) {
    children.push_back(Token("A" + std::to_string(i)));
    const Path prim = Path::absolute_root().child(children.back());
    layer.create(prim, SpecKind::Prim).set(layer::fields::properties, names);
    for (int j = 0; j < 7; ++j) {
      const auto field_list = lists[static_cast<std::size_t>((i + j) % 7)];
      layer::Spec& spec =
          layer.create(prim.property(names[static_cast<std::size_t>(j)]), SpecKind::Attribute);
      if (shared) {
        spec.set_field_list(field_list);
        continue;
      }
      for (const layer::Field& field : field_list.items()) {
        spec.set(field.name, field.value);
      }
    }
  }
  layer.root().set(layer::fields::primChildren, children);
  return layer;
}

TEST(CrateWriter, WritesSharedFieldsAsIfTheyWereNot) {
  const auto shared = write_crate(layer_of_like_specs(true));
  const auto own = write_crate(layer_of_like_specs(false));
  ASSERT_TRUE(shared && own);
  EXPECT_TRUE(*shared == *own);
  const auto back = read_back(*shared);
  ASSERT_TRUE(back);
  expect_equal(layer_of_like_specs(false), *back);
}

TEST(CrateWriter, WritesTheLowestVersionThatHoldsTheLayer) {
  layer::Spline spline;
  spline.knots.push_back({});
  layer::Spline eased = spline;
  eased.knots[0].post_tangent.algorithm = layer::TangentAlgorithm::AutoEase;
  layer::Spline bounded = spline;
  bounded.pre.mode = layer::SplineExtrapolation::LoopRepeat;
  bounded.pre.boundary = 2.5;
  const std::pair<Value, int> cases[] = {
      {Value(1.5), 8},
      {Value(layer::ListOp<layer::Payload>::make_prepended({{}})), 8},
      {Value(layer::TimeCode{1}), 9},
      {Value(std::vector<layer::TimeCode>{{1}}), 9},
      {Value(layer::PathExpression{"//"}), 10},
      {Value(layer::Relocates{{{Path::from("/A"), Path::from("/B")}}}), 11},
      {Value(spline), 12},
      {Value(eased), 13},
      {Value(bounded), 15},
  };
  for (const auto& [value, minor] : cases) {
    const Layer layer = layer_with(value);
    const std::string bytes = *write_crate(layer);
    EXPECT_EQ(bytes[9], minor);
    expect_equal(layer, *read_back(bytes));
  }
}

TEST(CrateWriter, WritesEqualValuesOnce) {
  Layer layer("made");
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) {
    values.push_back(i * 0.1);
  }
  const std::size_t empty = write_crate(layer)->size();
  for (const char* name : {"a", "b", "c"}) {
    layer.root().set(name, values);
  }
  EXPECT_LT(write_crate(layer)->size(), empty + 8 * 1000 + 300);
}

TEST(CrateWriter, StoresVariantsTargetsAndRelationalAttributes) {
  Layer layer("made");
  for (const char* path : {"/A", "/A/B"}) {
    layer.create(Path::from(path), SpecKind::Prim);
  }
  layer.create(Path::from("/A{set=}"), SpecKind::VariantSet);
  layer.create(Path::from("/A{set=one}"), SpecKind::Variant);
  layer.create(Path::from("/A{set=one}C"), SpecKind::Prim);
  layer.create(Path::from("/A{set=one}.x"), SpecKind::Attribute);
  layer.create(Path::from("/A.ns:rel"), SpecKind::Relationship)
      .set(layer::fields::targetPaths,
           layer::ListOp<Path>::make_explicit({Path::from("/A/B.x"), Path::from("/A.r[/B].y")}));
  layer.create(Path::from("/A.ns:rel[/A/B].attr"), SpecKind::Attribute);
  const auto back = read_back(*write_crate(layer));
  ASSERT_TRUE(back) << back.error().to_string();
  expect_equal(layer, *back);
}

TEST(CrateWriter, KeepsNamesOfVariantSetsThatPathsInTextCannotSay) {
  Layer layer("made");
  const Path prim = Path::from("/A");
  layer.create(prim, SpecKind::Prim);
  for (const char* set : {"0", "a-b"}) {
    layer.create(prim.variant_selection(Token(set), Token("")), SpecKind::VariantSet);
    layer.create(prim.variant_selection(Token(set), Token("x")), SpecKind::Variant);
  }
  const auto back = read_back(*write_crate(layer));
  ASSERT_TRUE(back) << back.error().to_string();
  expect_equal(layer, *back);
}

TEST(CrateWriter, RefusesRelativePaths) {
  const auto bytes = write_crate(
      layer_with(layer::ListOp<Path>::make_explicit({Path::from("B"), Path::from("../C")})));
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code(), ErrorCode::Invalid);
}

TEST(CrateReader, ReadsOnePayloadAsAList) {
  Layer layer("made");
  layer.create(Path::from("/A"), SpecKind::Prim)
      .set(layer::fields::payload, layer::Payload{"./p.usda", Path::from("/P"), {1, 2}});
  const auto back = read_back(*write_crate(layer));
  const auto* payloads =
      back->find(Path::from("/A"))->get<layer::ListOp<layer::Payload>>(layer::fields::payload);
  ASSERT_NE(payloads, nullptr);
  EXPECT_TRUE(payloads->is_explicit);
  EXPECT_EQ(payloads->explicit_items[0].asset_path, "./p.usda");
}

TEST(CrateReader, RefusesOtherVersionsByName) {
  const std::string bytes = *write_crate(Layer("made"));
  for (const auto& [major, minor] : {std::pair(0, 3), std::pair(0, 17), std::pair(1, 0)}) {
    std::string other = bytes;
    other[8] = static_cast<char>(major);
    other[9] = static_cast<char>(minor);
    Diagnostics diagnostics;
    const auto layer = read_crate(bytes::FileBytes::own(other), "x.usdc", diagnostics);
    ASSERT_FALSE(layer);
    EXPECT_EQ(layer.error().code(), ErrorCode::Unsupported);
    const std::string version = std::to_string(major) + "." + std::to_string(minor) + ".0";
    EXPECT_NE(layer.error().message().find(version), std::string::npos);
    EXPECT_EQ(layer.error().diagnostic().file, "x.usdc");
  }
}

TEST(CrateReader, HandsOutLongArraysAsTheyLieInTheFile) {
  const Layer layer = layer_with(crate::sample_array<float>(1000, false));
  const auto bytes = bytes::FileBytes::own(*write_crate(layer));
  Diagnostics diagnostics;
  const auto back = read_crate(bytes, "x.usdc", diagnostics);
  const auto* array = back->find(Path::from("/A"))->get<layer::Array<float>>("field");
  ASSERT_NE(array, nullptr);
  const auto* first = reinterpret_cast<const std::byte*>(array->data());
  EXPECT_GE(first, bytes->span().data());
  EXPECT_LT(first, bytes->span().data() + bytes->size());
  EXPECT_EQ(array->size(), 1000u);
  expect_equal(layer, *back);
}

TEST(CrateReader, LeavesPackedArraysInTheFile) {
  const Layer layer = layer_with(crate::sample_array<std::int32_t>(1000, true));
  const auto back = read_back(*write_crate(layer));
  const Value* value = back->find(Path::from("/A"))->find("field");
  EXPECT_TRUE(value->is_deferred());
  EXPECT_EQ(value->size(), 1000u);
  expect_equal(layer, *back);
}

TEST(CrateReader, SpecsOfOneSetOfFieldsShareThem) {
  Layer layer("made");
  for (const char* path : {"/A", "/B"}) {
    layer.create(Path::from(path), SpecKind::Prim).set("field", Value(std::vector<float>{1, 2}));
  }
  auto back = read_back(*write_crate(layer));
  layer::Spec& first = *back->find(Path::from("/A"));
  layer::Spec& second = *back->find(Path::from("/B"));
  EXPECT_TRUE(first.field_list().is_same(second.field_list()));
  first.set("field", Value(1));
  EXPECT_EQ(second.get<layer::Array<float>>("field")->size(), 2u);
}

TEST(CrateWriter, RefusesTextWithAZeroByte) {
  layer::Layer layer("made");
  layer.root().set("documentation", std::string("a\0b", 3));
  const auto crate = write_crate(layer);
  ASSERT_FALSE(crate);
  EXPECT_EQ(crate.error().diagnostic().rule, "crate.zero-byte");
}

}  // namespace
}  // namespace tenon::formats
