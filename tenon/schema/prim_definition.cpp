// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/schema/registry.h"

namespace tenon::schema {
namespace {

constexpr std::string_view kInstanceName = "__INSTANCE_NAME__";

Token with_instance(Token name, Token instance) {
  const std::size_t at = name.view().find(kInstanceName);
  if (at == std::string_view::npos) {
    return name;
  }
  std::string text = name.str();
  text.replace(at, kInstanceName.size(), instance.str());
  return Token(text);
}

bool contains(const std::vector<Token>& list, Token name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

// OpenUSD drops a single-apply schema with an instance name and a multiple-apply one without.
bool fits(const Schema& schema, Token applied, Token instance) {
  const bool has_instance = applied != schema.name;
  if (schema.kind == SchemaKind::SingleApplyApi) {
    return !has_instance;
  }
  return schema.kind == SchemaKind::MultipleApplyApi && has_instance && !instance.empty();
}

}  // namespace

PrimDefinition::PrimDefinition(Token type, const std::vector<Token>& apis)
    : type_(type), schema_(Registry::instance().find(type)) {
  if (schema_ != nullptr && schema_->kind != SchemaKind::ConcreteTyped) {
    schema_ = schema_->kind == SchemaKind::AbstractTyped ? schema_ : nullptr;
  }
  if (schema_ != nullptr) {
    add_properties(*schema_, Token(), false);
    for (const Token api : schema_->built_in_apis) {
      apply(api, schema_->vendor);
    }
  }
  for (const Token api : apis) {
    apply(api, false);
  }
}

void PrimDefinition::apply(Token api, bool built_in_of_vendor) {
  const auto [name, instance] = split_api_name(api);
  const Schema* schema = Registry::instance().find(name);
  const bool known = schema != nullptr && fits(*schema, api, instance);
  const bool stock = known && !schema->vendor && !built_in_of_vendor;
  if (stock && !contains(applied_stock_, api)) {
    applied_stock_.push_back(api);
  } else if (contains(applied_, api)) {
    return;
  }
  if (!contains(applied_, api)) {
    applied_.push_back(api);
  }
  if (!known) {
    return;
  }
  add_properties(*schema, instance, built_in_of_vendor);
  for (const Token built_in : schema->built_in_apis) {
    apply(with_instance(built_in, instance), built_in_of_vendor || schema->vendor);
  }
}

void PrimDefinition::add_properties(const Schema& schema, Token instance, bool through_vendor) {
  for (const PropertyDefinition& property : schema.properties) {
    const Token name = with_instance(property.name, instance);
    const bool vendor = property.vendor || through_vendor;
    const auto [it, inserted] = properties_.try_emplace(name, &property);
    if (!inserted && (vendor || !it->second->vendor)) {
      continue;
    }
    it->second = &property;
    if (name != property.name || vendor != property.vendor) {
      instanced_.push_back(std::make_unique<PropertyDefinition>(property));
      instanced_.back()->name = name;
      instanced_.back()->vendor = vendor;
      it->second = instanced_.back().get();
    }
  }
}

Token PrimDefinition::declaring_schema(Token property) const {
  std::vector<Token> names = applied_;
  if (schema_ != nullptr) {
    names.insert(names.end(), schema_->chain.begin(), schema_->chain.end());
  }
  for (const Token name : names) {
    const auto [base, instance] = split_api_name(name);
    const Schema* schema = Registry::instance().find(base);
    if (schema == nullptr) {
      continue;
    }
    for (const PropertyDefinition& declared : schema->properties) {
      if (with_instance(declared.name, instance) == property) {
        return name;
      }
    }
  }
  return {};
}

std::vector<Token> PrimDefinition::property_names(bool with_vendor) const {
  std::vector<Token> names;
  for (const auto& [name, property] : properties_) {
    if (with_vendor || !property->vendor) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end(),
            [](const Token& a, const Token& b) { return dictionary_less(a.view(), b.view()); });
  return names;
}

}  // namespace tenon::schema
