// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// Form of the generated schema tables (tools/generate_schema.py).
namespace tenon::schema {

enum class SchemaKind : std::uint8_t {
  AbstractBase,
  AbstractTyped,
  ConcreteTyped,
  NonAppliedApi,
  SingleApplyApi,
  MultipleApplyApi,
};

inline constexpr std::uint8_t kUniform = 1;
inline constexpr std::uint8_t kRelationship = 2;
inline constexpr std::uint8_t kFallback = 4;

struct PropertyRow {
  const char* name;      ///< with __INSTANCE_NAME__ in multiple-apply schemas
  const char* type;      ///< empty for relationships
  std::uint8_t flags;    ///< kUniform, kRelationship, kFallback
  const char* fallback;  ///< numbers separated by blanks, or text; of text arrays a line each
  const char* allowed;   ///< allowed tokens, a line each
};

struct SchemaRow {
  const char* name;
  SchemaKind kind;
  const char* base;           ///< the schema that this one derives from; empty at the top
  const char* built_in_apis;  ///< separated by blanks, strongest first
  const char* applies_to;  ///< types that an API may be applied to, separated by blanks; empty: any
  std::uint16_t first;     ///< into the index table
  std::uint16_t count;
};

extern const PropertyRow kCoreProperties[];
extern const std::uint16_t kCorePropertyIndices[];
extern const SchemaRow kCoreSchemas[];
extern const std::size_t kCoreSchemaCount;

extern const PropertyRow kVendorProperties[];
extern const std::uint16_t kVendorPropertyIndices[];
extern const SchemaRow kVendorSchemas[];
extern const std::size_t kVendorSchemaCount;

}  // namespace tenon::schema
