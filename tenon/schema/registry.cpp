// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/schema/registry.h"

#include <algorithm>

#include "tenon/schema/fallback.h"

namespace tenon::schema {
namespace {

std::vector<Token> words(std::string_view text, char separator = ' ') {
  std::vector<Token> result;
  while (!text.empty()) {
    const std::size_t end = text.find(separator);
    result.emplace_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return result;
}

PropertyDefinition make_property(const PropertyRow& row, bool vendor) {
  PropertyDefinition property;
  property.name = Token(row.name);
  property.is_relationship = (row.flags & kRelationship) != 0;
  property.vendor = vendor;
  if ((row.flags & kUniform) != 0) {
    property.variability = layer::Variability::Uniform;
  }
  if (property.is_relationship) {
    return property;
  }
  property.type_name = Token(row.type);
  property.type = layer::find_type_name(property.type_name);
  property.allowed_tokens = words(row.allowed, '\n');
  if ((row.flags & kFallback) != 0 && property.type != nullptr) {
    property.fallback = read_fallback(*property.type, row.fallback);
  }
  return property;
}

}  // namespace

std::pair<Token, Token> split_api_name(Token applied) {
  const std::string_view text = applied.view();
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) {
    return {applied, Token()};
  }
  return {Token(text.substr(0, colon)), Token(text.substr(colon + 1))};
}

const Registry& Registry::instance() {
  static const Registry registry;
  return registry;
}

Registry::Registry() {
  for (std::size_t i = 0; i < kCoreSchemaCount; ++i) {
    add(kCoreSchemas[i], kCoreProperties, kCorePropertyIndices, false);
  }
  for (std::size_t i = 0; i < kVendorSchemaCount; ++i) {
    add(kVendorSchemas[i], kVendorProperties, kVendorPropertyIndices, true);
  }
  for (auto& [name, schema] : by_name_) {
    complete(*schema);
    sorted_.push_back(schema.get());
  }
  std::sort(sorted_.begin(), sorted_.end(),
            [](const Schema* a, const Schema* b) { return a->name < b->name; });
}

void Registry::add(const SchemaRow& row, const PropertyRow* properties,
                   const std::uint16_t* indices, bool vendor) {
  auto schema = std::make_unique<Schema>();
  schema->name = Token(row.name);
  schema->kind = row.kind;
  schema->base = Token(row.base);
  schema->built_in_apis = words(row.built_in_apis);
  schema->can_only_apply_to = words(row.applies_to);
  schema->vendor = vendor;
  schema->properties.reserve(row.count);
  for (std::size_t i = 0; i < row.count; ++i) {
    schema->properties.push_back(make_property(properties[indices[row.first + i]], vendor));
  }
  by_name_.try_emplace(schema->name, std::move(schema));
}

void Registry::complete(Schema& schema) {
  for (const Schema* at = &schema; at != nullptr; at = find(at->base)) {
    schema.chain.push_back(at->name);
  }
}

const Schema* Registry::find(Token name) const {
  const auto it = by_name_.find(name);
  return it == by_name_.end() ? nullptr : it->second.get();
}

bool Registry::is_a(Token type, Token base) const {
  const Schema* schema = find(type);
  return schema != nullptr &&
         std::find(schema->chain.begin(), schema->chain.end(), base) != schema->chain.end();
}

}  // namespace tenon::schema
