// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The schema is made by walking the types of the fields in the tables that scene_json.cpp writes,
// case by case in the same way. A struct becomes a definition the first time that it is met and a
// reference each time; fields that are inlined are among those of their owner. Each field but an
// inlined pose may be null, which means its default. A struct has no further properties, except the
// outermost one, which is part of a larger answer.
#include <set>
#include <span>
#include <string>
#include <vector>

#include "tenon/answers/json.h"
#include "tenon/answers/json_form.h"
#include "tenon/answers/scene_json.h"
#include "tenon/scene/fields/data_type.h"
#include "tenon/scene/physics_scene.h"

namespace tenon::answers {
namespace {

using scene::DataKind;
using scene::DataType;
using scene::FieldInfo;
using scene::List;

Json numbers(std::size_t count) {
  return {{"type", "array"},
          {"items", {{"$ref", "#/$defs/number"}}},
          {"minItems", count},
          {"maxItems", count}};
}

Json of_type(std::string_view type) { return {{"type", std::string(type)}}; }

Json reference_to(const std::string& definition) { return {{"$ref", "#/$defs/" + definition}}; }

// What is the same for all fields is not in a template, which would be compiled for each of them.

void add_property(Json& properties, const FieldInfo& info, Json property) {
  std::string meaning(info.meaning);
  const std::string_view unit = unit_text(info.unit, true);
  const std::string_view other = unit_text(info.unit, false);
  if (!unit.empty()) {
    meaning += " [" + std::string(unit) + (unit == other ? "" : " or " + std::string(other)) + "]";
  }
  properties[std::string(info.name)] = {{"description", meaning},
                                        {"anyOf", {std::move(property), {{"type", "null"}}}}};
}

void add_derived(Json& properties, std::span<const DerivedKey> keys) {
  for (const DerivedKey& key : keys) {
    Json& property = properties[std::string(key.name)];
    const std::string meaning(key.meaning);
    if (property.is_null()) {
      property = {{"description", meaning}, {"type", {std::string(key.type), "null"}}};
    }
  }
}

void add_pose(Json& properties) {
  properties["position"] = numbers(3);
  properties["position"]["description"] = "[m]";
  properties["orientation"] = numbers(4);
  properties["orientation"]["description"] = "w, x, y, z; w is not negative";
}

Json empty_object() {
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
}

class SchemaWriter {
 public:
  Json whole() {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                   {"$id", "urn:tenon:physics:" + std::string(kSceneSchemaVersion)},
                   {"title",
                    "A physics scene as engines receive it: metres, kilograms, seconds, "
                    "radians"}};
    schema.update(object(scene::data_type<scene::PhysicsScene>()));
    schema["additionalProperties"] = true;  // of the answer around it
    defs_["number"] = {{"anyOf", {{{"type", "number"}}, {{"enum", {"inf", "-inf", "nan"}}}}}};
    defs_["reference"] = {{"description", "a path, or an index where several have that path"},
                          {"type", {"string", "integer", "null"}}};
    schema["$defs"] = defs_;
    return schema;
  }

 private:
  Json object(const DataType& type) {
    Json row = empty_object();
    add_properties(type, row["properties"]);
    return row;
  }

  void add_properties(const DataType& type, Json& properties) {
    for (const scene::DataField& field : type.fields) {
      if (!field.info->inlined) {
        add_property(properties, *field.info, schema_of(*field.type, *field.info));
      } else if (field.type->kind == DataKind::Pose) {
        add_pose(properties);
      } else {
        add_properties(*field.type, properties);
      }
    }
    add_derived(properties, derived_keys(type));
  }

  Json schema_of(const DataType& type, const FieldInfo& info) {
    switch (type.kind) {
      case DataKind::Flag:
        return info.on.empty() ? of_type("boolean")
                               : Json{{"enum", {std::string(info.off), std::string(info.on)}}};
      case DataKind::Word: {
        Json words = Json::array();
        for (const std::string_view name : type.words) {
          words.push_back(std::string(name));
        }
        return {{"enum", words}};
      }
      case DataKind::Ordinal:
        return info.refers == List::None || info.refers == List::Meshes ? of_type("integer")
                                                                        : reference_to("reference");
      case DataKind::Real:
        return reference_to("number");
      case DataKind::Integer:
        return of_type("integer");
      case DataKind::Text:
      case DataKind::Path:
        return of_type("string");
      case DataKind::Optional:
        return schema_of(*type.item, info);
      default:
        return schema_of_many(type, info);
    }
  }

  Json schema_of_many(const DataType& type, const FieldInfo& info) {
    if (type.kind == DataKind::Struct) {
      return reference_to(definition(type));
    }
    if (type.kind == DataKind::Pair) {
      return {{"type", "array"},
              {"prefixItems", {schema_of(*type.item, info), schema_of(*type.second, info)}}};
    }
    if (type.is_a<std::vector<scene::VendorSetting>>()) {
      return {{"type", "object"}, {"additionalProperties", {{"type", {"array", "string"}}}}};
    }
    if (type.kind == DataKind::List) {
      return {{"type", "array"}, {"items", schema_of(*type.item, info)}};
    }
    if (type.kind == DataKind::Pose) {
      Json row = {{"type", "object"}, {"properties", Json::object()}};
      add_pose(row["properties"]);
      return row;
    }
    return numbers(type.kind == DataKind::Rotation ? 4 : type.count);
  }

  /// The name of the struct's definition, which is made the first time.
  std::string definition(const DataType& type) {
    std::string name;
    for (const char c : type.word) {
      name += c == ' ' ? '_' : c;
    }
    name = name.empty() ? "limit" : name;
    if (made_.insert(name).second) {
      Json row = object(type);
      defs_[name] = std::move(row);
    }
    return name;
  }

  std::set<std::string> made_;
  Json defs_ = Json::object();
};

}  // namespace

std::string scene_schema() { return SchemaWriter().whole().dump(2); }

}  // namespace tenon::answers
