// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "tenon/base/token.h"
#include "tenon/layer/spec.h"
#include "tenon/layer/value.h"

namespace tenon::layer {

/// A field allowed in the parentheses of a spec, with the type of its value.
struct MetadataField {
  Token name;
  ValueType type = ValueType::None;
  bool is_array = false;
  std::uint8_t homes = 0;  ///< bits 1 << home: layer, prim, attribute, relationship
};

/// The field `name` where `kind` of spec has it as metadata (variants count as prims), else
/// nullptr. The core fields and those that the schema domains shipped with OpenUSD 26.11 register.
const MetadataField* find_metadata_field(Token name, SpecKind kind);

/// True where `value` is of the type that the metadata `name` of such specs has. Binary layers can
/// hold others, which no text can.
bool is_value_of_metadata(Token name, SpecKind kind, const Value& value);

/// True for a field of `kind` that is no metadata: children, arcs, values and the like.
bool is_structural_field(Token name, SpecKind kind);

/// All rows, sorted by name.
std::span<const MetadataField> all_metadata_fields();

}  // namespace tenon::layer
