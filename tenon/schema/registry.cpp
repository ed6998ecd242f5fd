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

// All but the chain.
void fill(Schema& schema, const SchemaRow& row, bool vendor) {
  schema.name = Token(row.name);
  schema.kind = row.kind;
  schema.base = Token(row.base);
  schema.built_in_apis = words(row.built_in_apis);
  schema.can_only_apply_to = words(row.applies_to);
  schema.vendor = vendor;
  schema.properties.reserve(row.count);
  const std::uint16_t* const indices = vendor ? kVendorPropertyIndices : kCorePropertyIndices;
  const PropertyRow* const properties = vendor ? kVendorProperties : kCoreProperties;
  for (std::size_t i = row.first; i < row.first + std::size_t{row.count}; ++i) {
    schema.properties.push_back(make_property(properties[indices[i]], vendor));
  }
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
  slots_.reserve(kCoreSchemaCount + kVendorSchemaCount);
  for (std::size_t i = 0; i < kCoreSchemaCount; ++i) {
    add(kCoreSchemas[i], false);
  }
  for (std::size_t i = 0; i < kVendorSchemaCount; ++i) {
    add(kVendorSchemas[i], true);
  }
}

void Registry::add(const SchemaRow& row, bool vendor) {
  const auto [it, inserted] = slots_.try_emplace(row.name);
  if (inserted) {
    it->second.row = &row;
    it->second.vendor = vendor;
  }
}

const Registry::Slot* Registry::slot(std::string_view name) const {
  const auto it = slots_.find(name);
  return it == slots_.end() ? nullptr : &it->second;
}

const Schema& Registry::schema_of(const Slot& slot) {
  std::call_once(slot.made, [&] {
    fill(slot.schema, *slot.row, slot.vendor);
    for (const Slot* at = &slot; at != nullptr; at = instance().slot(at->row->base)) {
      slot.schema.chain.emplace_back(at->row->name);
    }
  });
  return slot.schema;
}

const Schema* Registry::find(Token name) const {
  const Slot* found = slot(name.view());
  return found == nullptr ? nullptr : &schema_of(*found);
}

bool Registry::is_vendor(Token name) const {
  const Slot* found = slot(name.view());
  return found != nullptr && found->vendor;
}

std::vector<const Schema*> Registry::schemas() const {
  std::vector<const Schema*> result;
  for (const auto& [name, slot] : slots_) {
    result.push_back(&schema_of(slot));
  }
  std::sort(result.begin(), result.end(),
            [](const Schema* a, const Schema* b) { return a->name < b->name; });
  return result;
}

bool Registry::is_a(Token type, Token base) const {
  const Schema* schema = find(type);
  return schema != nullptr &&
         std::find(schema->chain.begin(), schema->chain.end(), base) != schema->chain.end();
}

}  // namespace tenon::schema
