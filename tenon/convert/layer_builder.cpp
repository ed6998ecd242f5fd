// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Specs are made immediately. Their lists of children, properties and APIs are gathered beside them
// in order of first use and written at the end, so that a name costs no copy of its list. Type and
// variability of a property come from the schema that declares it, searched up its base schemas
// with the instance name filled in. A property that is declared nowhere is a mistake of this
// program.
#include "tenon/convert/layer_builder.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tenon/base/assert.h"
#include "tenon/layer/lists/list_op.h"

namespace tenon::convert {

using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

Vec3d without_noise(Vec3d metres) {
  constexpr double kNoise = 1e-15;
  for (double& part : metres.v) {
    part = std::fabs(part) < kNoise ? 0.0 : part;
  }
  return metres;
}

Quatd with_plain_zeros(const Quatd& rotation) {
  return {rotation.x + 0.0, rotation.y + 0.0, rotation.z + 0.0, rotation.w + 0.0};
}

Quatd without_noise(const Quatd& rotation) {
  // What some products of unit quaternions leave of a 0: each adds up to half of the last digit
  // of 1.
  constexpr double kNoise = 1e-15;
  const auto plain = [](double part) { return std::fabs(part) < kNoise ? 0.0 : part; };
  return {plain(rotation.x), plain(rotation.y), plain(rotation.z), plain(rotation.w)};
}

LayerBuilder::LayerBuilder(std::string identifier) : layer_(std::move(identifier)) {}

Path LayerBuilder::define(Path parent, Token name, Token type) {
  const Path path = parent.child(name);
  TENON_ASSERT(!layer_.has(path));
  lists_[parent].children.push_back(name);
  layer::Spec& spec = layer_.create(path, SpecKind::Prim);
  spec.append(fields::specifier, Value(layer::Specifier::Def));
  if (!type.empty()) {
    spec.append(fields::typeName, Value(type));
  }
  return path;
}

void LayerBuilder::set_metadata(Path prim, Token field, Value value) {
  layer_.create(prim, SpecKind::Prim).set(field, std::move(value));
}

void LayerBuilder::apply(Path prim, Token api) {
  std::vector<Token>& apis = lists_[prim].apis;
  if (std::find(apis.begin(), apis.end(), api) == apis.end()) {
    apis.push_back(api);
  }
}

const schema::PropertyDefinition& LayerBuilder::declared(Token schema,
                                                         std::string_view property) const {
  constexpr std::string_view kInstance = "__INSTANCE_NAME__";
  const auto [name, instance] = schema::split_api_name(schema);
  const schema::Schema* found = schema::Registry::instance().find(name);
  for (Token at = name; found != nullptr; found = schema::Registry::instance().find(at)) {
    for (const schema::PropertyDefinition& definition : found->properties) {
      std::string text = definition.name.str();
      if (const std::size_t hole = text.find(kInstance); hole != std::string::npos) {
        text.replace(hole, kInstance.size(), instance.str());
      }
      if (text == property) {
        return definition;
      }
    }
    at = found->base;
  }
  TENON_ASSERT(false && "no such property in the schema");
  static const schema::PropertyDefinition none;
  return none;
}

layer::Spec& LayerBuilder::property_spec(Path prim, Token name, SpecKind kind) {
  const Path path = prim.property(name);
  if (layer::Spec* known = layer_.find(path)) {
    return *known;
  }
  lists_[prim].properties.push_back(name);
  return layer_.create(path, kind);
}

void LayerBuilder::set_attribute(Path prim, Token name, Token type_name, Value value,
                                 layer::Variability variability) {
  layer::Spec& spec = property_spec(prim, name, SpecKind::Attribute);
  spec.set(fields::typeName, Value(type_name));
  if (variability == layer::Variability::Uniform) {
    spec.set(fields::variability, Value(variability));
  }
  spec.set(fields::default_value, std::move(value));
}

void LayerBuilder::set_custom(Path prim, Token name, Token type_name, Value value) {
  set_attribute(prim, name, type_name, std::move(value));
  layer_.create(prim.property(name), SpecKind::Attribute).set(fields::custom, Value(true));
}

void LayerBuilder::set_connection(Path prim, Token name, Token type_name, Path source) {
  layer::Spec& spec = property_spec(prim, name, SpecKind::Attribute);
  spec.set(fields::typeName, Value(type_name));
  spec.set(fields::connectionPaths, Value(layer::ListOp<Path>::make_explicit({source})));
}

void LayerBuilder::set_value(Path prim, Token schema, std::string_view property, Value value) {
  const schema::PropertyDefinition& definition = declared(schema, property);
  set_attribute(prim, Token(property), definition.type_name, std::move(value),
                definition.variability);
}

namespace {

/// Cut off to a whole number that an int can be; 0 for NaN.
std::int32_t whole_number(double value) {
  constexpr double kMin = std::numeric_limits<std::int32_t>::min();
  constexpr double kMax = std::numeric_limits<std::int32_t>::max();
  return std::isnan(value) ? 0 : static_cast<std::int32_t>(std::clamp(value, kMin, kMax));
}

}  // namespace

void LayerBuilder::set_number(Path prim, Token schema, std::string_view property, double value) {
  const schema::PropertyDefinition& definition = declared(schema, property);
  const Token type = definition.type_name;
  value += 0.0;  // no -0
  Value typed(value);
  if (type == "float") {
    typed = Value(static_cast<float>(value));
  } else if (type == "int") {
    typed = Value(whole_number(value));
  } else {
    TENON_ASSERT(type == "double");
  }
  set_value(prim, schema, property, std::move(typed));
}

void LayerBuilder::set_numbers(Path prim, Token schema, std::string_view property,
                               const std::vector<double>& numbers) {
  const Token type = declared(schema, property).type_name;
  if (numbers.empty()) {
    return;
  }
  if (type == "double[]") {
    set_value(prim, schema, property, Value(numbers));
  } else if (type == "int[]") {
    std::vector<std::int32_t> whole;
    for (const double number : numbers) {
      whole.push_back(whole_number(number));
    }
    set_value(prim, schema, property, Value(std::move(whole)));
  } else if (type == "float[]") {
    set_value(prim, schema, property, Value(std::vector<float>(numbers.begin(), numbers.end())));
  } else if (type == "bool[]") {
    layer::Array<bool> flags;
    for (const double number : numbers) {
      flags.push_back(number != 0);
    }
    set_value(prim, schema, property, Value(std::move(flags)));
  } else if (type == "double3" && numbers.size() == 3) {
    set_value(prim, schema, property, Value(Vec3d{{numbers[0], numbers[1], numbers[2]}}));
  } else if (type == "color4f" && numbers.size() == 4) {
    Vec4f color;
    for (std::size_t i = 0; i < 4; ++i) {
      color[i] = static_cast<float>(numbers[i]);
    }
    set_value(prim, schema, property, Value(color));
  } else if (type == "bool") {
    set_value(prim, schema, property, Value(numbers[0] != 0));
  } else {
    set_number(prim, schema, property, numbers[0]);
  }
}

void LayerBuilder::set_vector(Path prim, Token schema, std::string_view property,
                              const Vec3d& value) {
  set_value(prim, schema, property, Value(to_float(value + Vec3d{})));  // no -0
}

void LayerBuilder::set_rotation(Path prim, Token schema, std::string_view property,
                                const Quatd& value) {
  set_value(prim, schema, property, Value(to_float(without_noise(value))));
}

void LayerBuilder::set_targets(Path prim, Token schema, std::string_view property,
                               std::vector<Path> targets) {
  [[maybe_unused]] const bool is_relationship = declared(schema, property).is_relationship;
  TENON_ASSERT(is_relationship);
  set_relationship(prim, Token(property), std::move(targets));
}

void LayerBuilder::set_relationship(Path prim, Token name, std::vector<Path> targets) {
  layer::Spec& spec = property_spec(prim, name, SpecKind::Relationship);
  spec.set(fields::variability, Value(layer::Variability::Uniform));
  spec.set(fields::targetPaths, Value(layer::ListOp<Path>::make_explicit(std::move(targets))));
}

void LayerBuilder::declare(Path prim, Token name, Token type_name) {
  property_spec(prim, name, SpecKind::Attribute).set(fields::typeName, Value(type_name));
}

void LayerBuilder::declare_of(Path prim, Token schema, std::string_view property) {
  declare(prim, Token(property), declared(schema, property).type_name);
}

void LayerBuilder::set_property_metadata(Path property, Token field, Value value) {
  layer::Spec* spec = layer_.find(property);
  TENON_ASSERT(spec != nullptr);
  spec->set(field, std::move(value));
}

layer::Layer LayerBuilder::take() {
  layer_.set_may_lack_text();
  for (auto& [prim, lists] : lists_) {
    layer::Spec& spec = layer_.create(prim, SpecKind::Prim);
    if (!lists.apis.empty()) {
      spec.set(fields::apiSchemas,
               Value(layer::ListOp<Token>::make_prepended(std::move(lists.apis))));
    }
    if (!lists.properties.empty()) {
      spec.set(fields::properties, Value(std::move(lists.properties)));
    }
    if (!lists.children.empty()) {
      spec.set(fields::primChildren, Value(std::move(lists.children)));
    }
  }
  return std::move(layer_);
}

}  // namespace tenon::convert
