// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/type_names.h"

#include <deque>
#include <unordered_map>
#include <vector>

#include "tenon/layer/field_values.h"

namespace tenon::layer {
namespace {

struct Row {
  const char* name;
  ValueType type;
  const char* role;
};

constexpr Row kRows[] = {
#define TENON_SCALAR(enumerator, type, name, crate_id) {name, ValueType::enumerator, ""},
#include "tenon/layer/value_types.def"
#define TENON_ROLE(name, enumerator, role) {name, ValueType::enumerator, role},
#include "tenon/layer/value_types.def"
};

struct Alias {
  const char* old_name;
  const char* name;
};

/// Names that layers of long ago use and OpenUSD still reads.
constexpr Alias kAliases[] = {
    {"Vec2i", "int2"},           {"Vec2h", "half2"},        {"Vec2f", "float2"},
    {"Vec2d", "double2"},        {"Vec3i", "int3"},         {"Vec3h", "half3"},
    {"Vec3f", "float3"},         {"Vec3d", "double3"},      {"Vec4i", "int4"},
    {"Vec4h", "half4"},          {"Vec4f", "float4"},       {"Vec4d", "double4"},
    {"Point", "point3d"},        {"PointFloat", "point3f"}, {"Normal", "normal3d"},
    {"NormalFloat", "normal3f"}, {"Vector", "vector3d"},    {"VectorFloat", "vector3f"},
    {"Color", "color3d"},        {"ColorFloat", "color3f"}, {"Quath", "quath"},
    {"Quatf", "quatf"},          {"Quatd", "quatd"},        {"Matrix2d", "matrix2d"},
    {"Matrix3d", "matrix3d"},    {"Matrix4d", "matrix4d"},  {"Frame", "frame4d"},
    {"Transform", "matrix4d"},   {"PointIndex", "int"},     {"EdgeIndex", "int"},
    {"FaceIndex", "int"},        {"Schema", "token"},
};

struct NameTable {
  std::vector<TypeName> names;
  std::unordered_map<Token, std::size_t> by_name;
  std::unordered_map<unsigned, std::size_t> by_type;

  NameTable() {
    for (const bool array : {false, true}) {
      for (const Row& row : kRows) {
        if (array && row.type == ValueType::Opaque) {
          continue;
        }
        const std::string name = std::string(row.name) + (array ? "[]" : "");
        by_name.emplace(Token(name), names.size());
        if (*row.role == '\0') {
          by_type.emplace(key(row.type, array), names.size());
        }
        names.push_back({Token(name), Token(row.name), row.type, array, Token(row.role)});
      }
      for (const Alias& alias : kAliases) {
        const std::string suffix = array ? "[]" : "";
        const auto found = by_name.find(Token(alias.name + suffix));
        by_name.emplace(Token(alias.old_name + suffix), found->second);
      }
    }
  }

  static unsigned key(ValueType type, bool array) {
    return 2 * static_cast<unsigned>(type) + (array ? 1u : 0u);
  }
};

const NameTable& name_table() {
  static const auto* table = new NameTable();
  return *table;
}

}  // namespace

const TypeName* find_type_name(Token name) {
  const auto it = name_table().by_name.find(name);
  return it == name_table().by_name.end() ? nullptr : &name_table().names[it->second];
}

const TypeName* type_name_of(ValueType type, bool is_array) {
  const auto it = name_table().by_type.find(NameTable::key(type, is_array));
  return it == name_table().by_type.end() ? nullptr : &name_table().names[it->second];
}

std::span<const TypeName> all_type_names() { return name_table().names; }

std::size_t element_size(ValueType type) {
  switch (type) {
#define TENON_SCALAR(enumerator, cpp_type, name, crate_id)                            \
  case ValueType::enumerator:                                                         \
    return std::is_trivially_copyable_v<cpp_type> && !std::is_same_v<cpp_type, Token> \
               ? sizeof(cpp_type)                                                     \
               : 0;
#include "tenon/layer/value_types.def"
    default:
      return 0;
  }
}

}  // namespace tenon::layer
