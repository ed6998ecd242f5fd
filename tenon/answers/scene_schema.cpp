// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The schema is made by walking the types of the fields in the tables that scene_json.cpp writes,
// case by case in the same way. A struct becomes a definition the first time that it is met and a
// reference each time; fields that are inlined stand among those of their owner. Each field but an
// inlined pose may be null, which stands for its default. A struct has no further properties, but
// for the outermost one, which is part of a larger answer.
#include <set>
#include <span>
#include <string>
#include <type_traits>

#include "tenon/answers/json.h"
#include "tenon/answers/json_form.h"
#include "tenon/answers/scene_json.h"
#include "tenon/base/wire.h"
#include "tenon/scene/fields/enum_names.h"

namespace tenon::answers {
namespace {

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
    schema.update(object<scene::PhysicsScene>());
    schema["additionalProperties"] = true;  // of the answer around it
    defs_["number"] = {{"anyOf", {{{"type", "number"}}, {{"enum", {"inf", "-inf", "nan"}}}}}};
    defs_["reference"] = {{"description", "a path, or an index where several have that path"},
                          {"type", {"string", "integer", "null"}}};
    schema["$defs"] = defs_;
    return schema;
  }

 private:
  template <class T>
  Json object() {
    Json row = empty_object();
    add_properties<T>(row["properties"]);
    return row;
  }

  template <class T>
  void add_properties(Json& properties) {
    scene::each_field_type<T>([&](const FieldInfo& info, auto type) {
      using Member = typename decltype(type)::type;
      if constexpr (std::is_same_v<Member, Pose>) {
        if (info.inlined) {
          add_pose(properties);
          return;
        }
      } else if constexpr (scene::HasTable<Member>) {
        if (info.inlined) {
          add_properties<Member>(properties);
          return;
        }
      }
      add_property(properties, info, schema_of<Member>(info));
    });
    add_derived(properties, kDerived<T>);
  }

  template <class T>
  Json schema_of(const FieldInfo& info) {
    if constexpr (std::is_same_v<T, bool>) {
      return info.on.empty() ? of_type("boolean")
                             : Json{{"enum", {std::string(info.off), std::string(info.on)}}};
    } else if constexpr (std::is_enum_v<T>) {
      Json words = Json::array();
      for (const std::string_view name : scene::EnumNames<T>::kNames) {
        words.push_back(std::string(name));
      }
      return {{"enum", words}};
    } else if constexpr (std::is_same_v<T, scene::Index>) {
      return info.refers == List::None || info.refers == List::Meshes ? of_type("integer")
                                                                      : reference_to("reference");
    } else if constexpr (std::is_same_v<T, double>) {
      return reference_to("number");
    } else if constexpr (std::is_arithmetic_v<T>) {
      return of_type("integer");
    } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, Path>) {
      return of_type("string");
    } else if constexpr (wire::kIsOptional<T>) {
      return schema_of<typename T::value_type>(info);
    } else if constexpr (std::is_same_v<T, std::vector<scene::VendorSetting>>) {
      return {{"type", "object"}, {"additionalProperties", {{"type", {"array", "string"}}}}};
    } else {
      return schema_of_many<T>(info);
    }
  }

  template <class T>
  Json schema_of_many(const FieldInfo& info) {
    if constexpr (scene::HasTable<T>) {
      return reference_to(definition<T>());
    } else if constexpr (wire::kIsPair<T>) {
      return {
          {"type", "array"},
          {"prefixItems",
           {schema_of<typename T::first_type>(info), schema_of<typename T::second_type>(info)}}};
    } else if constexpr (wire::kIsVector<T>) {
      return {{"type", "array"}, {"items", schema_of<typename T::value_type>(info)}};
    } else if constexpr (wire::kIsArray<T>) {
      return numbers(std::tuple_size_v<T>);
    } else if constexpr (std::is_same_v<T, Pose>) {
      Json row = {{"type", "object"}, {"properties", Json::object()}};
      add_pose(row["properties"]);
      return row;
    } else {
      return numbers(sizeof(T) / sizeof(typename Component<T>::type));
    }
  }

  template <class T>
  struct Component {
    using type = double;
  };
  template <class T, std::size_t N>
  struct Component<Vec<T, N>> {
    using type = T;
  };

  /// The name of the struct's definition, which is made the first time.
  template <class T>
  std::string definition() {
    std::string name;
    for (const char c : scene::Table<T>::kWord) {
      name += c == ' ' ? '_' : c;
    }
    name = name.empty() ? "limit" : name;
    if (made_.insert(name).second) {
      Json row = object<T>();
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
