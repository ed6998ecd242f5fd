// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/value.h"

#include <thread>

#include <gtest/gtest.h>

#include "tenon/layer/field_values.h"
#include "tenon/layer/metadata_fields.h"
#include "tenon/layer/shared_contents.h"
#include "tenon/layer/type_names.h"

namespace tenon::layer {
namespace {

template <class T>
void check_holds(T contents, ValueType type, bool is_array) {
  const Value value(contents);
  EXPECT_EQ(value.type(), type);
  EXPECT_EQ(value.is_array(), is_array);
  ASSERT_NE(value.get<T>(), nullptr);
  EXPECT_TRUE(*value.get<T>() == contents);
  const Value copy = value;
  EXPECT_EQ(copy, value);
  Value moved = copy;
  const Value taken = std::move(moved);
  EXPECT_EQ(taken, value);
  EXPECT_EQ(value.get<Opaque>(), nullptr);
}

TEST(Value, HoldsEveryTypeInlineOrShared) {
  check_holds(true, ValueType::Bool, false);
  check_holds(1.5, ValueType::Double, false);
  check_holds(Vec4f{{1, 2, 3, 4}}, ValueType::Float4, false);
  check_holds(Vec3d{{1, 2, 3}}, ValueType::Double3, false);
  check_holds(Mat4d{}, ValueType::Matrix4d, false);
  check_holds(std::string(100, 'x'), ValueType::String, false);
  check_holds(Token("t"), ValueType::Token, false);
  check_holds(Array<double>{1, 2}, ValueType::Double, true);
  check_holds(std::vector<char>{1, 0}, ValueType::Bool, true);
  check_holds(std::vector<std::string>{"a"}, ValueType::String, true);
  check_holds(ListOp<Path>::make_explicit({Path::from("/A")}), ValueType::PathListOp, false);
  check_holds(Dictionary{}, ValueType::Dictionary, false);
  check_holds(ValueBlock{}, ValueType::ValueBlock, false);
  EXPECT_TRUE(Value().empty());
  EXPECT_EQ(sizeof(Value), 32u);
}

TEST(Value, DiffersByTypeAndContents) {
  EXPECT_NE(Value(1.0), Value(1.0f));
  EXPECT_NE(Value(1), Value(2));
  EXPECT_NE(Value(std::vector<int>{1}), Value(1));
  EXPECT_EQ(Value(), Value());
  EXPECT_EQ(Value(std::string("a")), Value(std::string("a")));
  Value changed(std::string("a"));
  const Value before = changed;
  changed = Value(std::string("b"));
  EXPECT_EQ(before.get_or(std::string()), "a");
  changed = 3;
  EXPECT_EQ(changed.get_or(0), 3);
  EXPECT_EQ(changed.get_or(0.5), 0.5);
}

/// Gives three numbers, or an error, and counts how often it is asked.
class CountingArray final : public DeferredArray {
 public:
  CountingArray(bool corrupt, std::atomic<int>& calls) : corrupt_(corrupt), calls_(calls) {}
  std::size_t size() const override { return 3; }
  Result<Value> decode() const override {
    ++calls_;
    if (corrupt_) {
      return Error(ErrorCode::Corrupt, "bad data");
    }
    return Value(std::vector<float>{1, 2, 3});
  }

 private:
  bool corrupt_;
  std::atomic<int>& calls_;
};

TEST(Value, DeferredArraysAreDecodedOnceByAnyThread) {
  std::atomic<int> calls = 0;
  const Value value =
      Value::deferred(ValueType::Float, std::make_unique<CountingArray>(false, calls));
  EXPECT_TRUE(value.is_deferred());
  EXPECT_EQ(value.size(), 3u);
  EXPECT_EQ(calls, 0);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([copy = value] {
      const auto* numbers = copy.get<Array<float>>();
      ASSERT_NE(numbers, nullptr);
      EXPECT_EQ((*numbers)[2], 3.0f);
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(value, Value(std::vector<float>{1, 2, 3}));
}

TEST(Value, ContentsAreTakenOutUnlessTheyAreShared) {
  const std::string text(100, 'x');
  Value value(text);
  const Value copy = value;
  EXPECT_EQ(value.take<std::string>(), text);
  EXPECT_TRUE(value.empty());
  EXPECT_EQ(copy.get_or<std::string>(""), text);
  Value only{std::vector<Path>(100)};
  const Path* const place = only.get<std::vector<Path>>()->data();
  EXPECT_EQ(only.take<std::vector<Path>>().data(), place);
}

TEST(Value, CorruptDeferredArraysSayWhy) {
  std::atomic<int> calls = 0;
  const Value value =
      Value::deferred(ValueType::Float, std::make_unique<CountingArray>(true, calls));
  EXPECT_EQ(value.get<Array<float>>(), nullptr);
  const auto decoded = value.decoded();
  ASSERT_FALSE(decoded);
  EXPECT_EQ(decoded.error().message(), "bad data");
}

TEST(TypeNames, NamesAliasesAndRoles) {
  const TypeName* color = find_type_name("color3f[]");
  ASSERT_NE(color, nullptr);
  EXPECT_EQ(color->type, ValueType::Float3);
  EXPECT_TRUE(color->is_array);
  EXPECT_EQ(color->role, "Color");
  EXPECT_EQ(color->scalar_name, "color3f");
  const TypeName* old = find_type_name("PointFloat");
  ASSERT_NE(old, nullptr);
  EXPECT_EQ(old->name, "point3f");
  EXPECT_EQ(find_type_name("nothing"), nullptr);
  EXPECT_EQ(type_name_of(ValueType::Float3, false)->name, "float3");
  EXPECT_EQ(type_name_of(ValueType::Dictionary, false), nullptr);
  EXPECT_EQ(element_size(ValueType::Float3), 12u);
  EXPECT_EQ(element_size(ValueType::Token), 0u);
  for (const TypeName& type : all_type_names()) {
    EXPECT_EQ(find_type_name(type.name), &type);
  }
}

TEST(TimeSamples, BracketAndSet) {
  TimeSamples samples;
  samples.set(2, Value(20.0));
  samples.set(1, Value(10.0));
  samples.set(2, Value(21.0));
  EXPECT_EQ(samples.times, (std::vector<double>{1, 2}));
  EXPECT_EQ(samples.values[1].get_or(0.0), 21.0);
  struct Row {
    double time;
    std::size_t lower;
    std::size_t upper;
  };
  for (const Row& row : {Row{0, 0, 0}, Row{1, 0, 0}, Row{1.5, 0, 1}, Row{2, 1, 1}, Row{3, 1, 1}}) {
    const TimeSamples::Bracket found = samples.bracket(row.time);
    EXPECT_EQ(found.lower, row.lower) << row.time;
    EXPECT_EQ(found.upper, row.upper) << row.time;
  }
}

TEST(Dictionary, MergesNestedDictionaries) {
  Dictionary inner_strong;
  inner_strong.items["a"] = 1;
  Dictionary inner_weak;
  inner_weak.items["a"] = 2;
  inner_weak.items["b"] = 3;
  Dictionary strong;
  strong.items["d"] = Value(inner_strong);
  strong.items["x"] = 1;
  Dictionary weak;
  weak.items["d"] = Value(inner_weak);
  weak.items["x"] = 2.0;
  const Dictionary both = merge(strong, weak);
  const auto* inner = both.find("d")->get<Dictionary>();
  ASSERT_NE(inner, nullptr);
  EXPECT_EQ(inner->find("a")->get_or(0), 1);
  EXPECT_EQ(inner->find("b")->get_or(0), 3);
  EXPECT_EQ(both.find("x")->get_or(0), 1);
  EXPECT_EQ(both.find("y"), nullptr);
}

TEST(MetadataFields, HaveTypesAndHomes) {
  const MetadataField* unit = find_metadata_field("metersPerUnit", SpecKind::PseudoRoot);
  ASSERT_NE(unit, nullptr);
  EXPECT_EQ(unit->type, ValueType::Double);
  EXPECT_EQ(find_metadata_field("metersPerUnit", SpecKind::Prim), nullptr);
  EXPECT_NE(find_metadata_field("kind", SpecKind::Variant), nullptr);
  EXPECT_EQ(find_metadata_field("nothing", SpecKind::Prim), nullptr);
  EXPECT_TRUE(is_value_of_metadata("metersPerUnit", SpecKind::PseudoRoot, Value(1.0)));
  EXPECT_FALSE(is_value_of_metadata("metersPerUnit", SpecKind::PseudoRoot, Value(1)));
  EXPECT_FALSE(is_value_of_metadata("metersPerUnit", SpecKind::Prim, Value(1.0)));
  EXPECT_TRUE(is_structural_field("primChildren", SpecKind::Prim));
  EXPECT_FALSE(is_structural_field("primChildren", SpecKind::Attribute));
  for (std::size_t i = 1; i < all_metadata_fields().size(); ++i) {
    EXPECT_LT(all_metadata_fields()[i - 1].name, all_metadata_fields()[i].name);
  }
}

TEST(LayerOffset, ComposesAndInverts) {
  const LayerOffset outer{10, 2};
  const LayerOffset inner{3, 0.5};
  EXPECT_EQ((outer * inner).apply(4), outer.apply(inner.apply(4)));
  EXPECT_EQ(outer.inverse().apply(outer.apply(7)), 7);
  EXPECT_TRUE(LayerOffset{}.is_identity());
}

TEST(SharedContents, StayWhenTheValueChanges) {
  Value value(std::vector<Token>{"a", "b"});
  const SharedContents<std::vector<Token>> shared(value);
  EXPECT_EQ(shared.get(), value.get<std::vector<Token>>());
  const SharedContents<std::vector<Token>> copy = shared;
  value = 3;
  ASSERT_NE(copy.get(), nullptr);
  EXPECT_EQ(*copy.get(), (std::vector<Token>{"a", "b"}));
  EXPECT_EQ(copy.get(), shared.get());
}

TEST(SharedContents, AreNothingForOtherTypes) {
  EXPECT_EQ(SharedContents<std::vector<Token>>().get(), nullptr);
  EXPECT_EQ(SharedContents<std::vector<Token>>(Value()).get(), nullptr);
  EXPECT_EQ(SharedContents<std::vector<Token>>(Value(Token("a"))).get(), nullptr);
  EXPECT_EQ(SharedContents<std::vector<Token>>(Value(std::vector<std::string>{"a"})).get(),
            nullptr);
}

}  // namespace
}  // namespace tenon::layer
