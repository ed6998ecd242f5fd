// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tenon/base/token.h"
#include "tenon/layer/value.h"

namespace tenon::layer {

/// A type as attributes name it: "color3f[]" is an array of Float3 with the role "Color".
struct TypeName {
  Token name;  ///< with "[]" for arrays
  Token scalar_name;
  ValueType type = ValueType::None;
  bool is_array = false;
  Token role;
};

/// The entry for a name, old aliases included ("Vec3f", "PointFloat"); nullptr when unknown.
const TypeName* find_type_name(Token name);
/// The role-free name of a value's type, "float3[]"; nullptr for field types.
const TypeName* type_name_of(ValueType type, bool is_array);
/// All canonical names, scalars before arrays.
std::span<const TypeName> all_type_names();

/// Size in bytes of one element in memory and in binary layers; 0 for strings and the like.
std::size_t element_size(ValueType type);

}  // namespace tenon::layer
