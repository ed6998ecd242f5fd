// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/answers/dump/schema_json.h"

#include <map>
#include <string>
#include <vector>

#include "tenon/answers/dump/json_writer.h"
#include "tenon/answers/dump/layer_json.h"
#include "tenon/schema/registry.h"

namespace tenon::answers {
namespace {

std::string_view schema_kind_name(schema::SchemaKind kind) {
  constexpr std::string_view kNames[] = {"AbstractBase",  "AbstractTyped",  "ConcreteTyped",
                                         "NonAppliedAPI", "SingleApplyAPI", "MultipleApplyAPI"};
  return kNames[static_cast<std::size_t>(kind)];
}

void write_member(JsonWriter& json, std::string_view name, std::string_view text) {
  json.key(name);
  json.string(text);
}

void write_member(JsonWriter& json, std::string_view name, const std::vector<Token>& tokens) {
  json.key(name);
  json.array(tokens, [&](Token token) { json.string(token.view()); });
}

void write_property(JsonWriter& json, const schema::PropertyDefinition& property) {
  json.begin_object();
  write_member(json, "type", property.is_relationship ? "rel" : property.type_name.view());
  if (!property.is_relationship) {
    const bool uniform = property.variability == layer::Variability::Uniform;
    write_member(json, "variability", uniform ? "uniform" : "varying");
  }
  if (!property.fallback.empty()) {
    json.key("fallback");
    write_plain_value(json, property.fallback);
  }
  if (!property.allowed_tokens.empty()) {
    write_member(json, "allowedTokens", property.allowed_tokens);
  }
  json.end_object();
}

void write_schema(JsonWriter& json, const schema::Schema& schema) {
  json.begin_object();
  write_member(json, "kind", schema_kind_name(schema.kind));
  write_member(json, "base", schema.base.view());
  json.key("vendor");
  json.boolean(schema.vendor);
  write_member(json, "builtInApis", schema.built_in_apis);
  write_member(json, "canOnlyApplyTo", schema.can_only_apply_to);
  std::map<std::string_view, const schema::PropertyDefinition*> properties;
  for (const schema::PropertyDefinition& property : schema.properties) {
    properties.emplace(property.name.view(), &property);
  }
  json.key("properties");
  json.begin_object();
  for (const auto& [name, property] : properties) {
    json.key(name);
    write_property(json, *property);
  }
  json.end_object();
  json.end_object();
}

}  // namespace

void write_schemas_json(std::ostream& out) {
  JsonWriter json(out);
  json.begin_object();
  for (const schema::Schema* schema : schema::Registry::instance().schemas()) {
    json.key(schema->name.view());
    write_schema(json, *schema);
  }
  json.end_object();
}

}  // namespace tenon::answers
