// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/formats/text/cursor.h"
#include "tenon/layer/dictionary.h"
#include "tenon/layer/type_names.h"
#include "tenon/layer/value.h"

namespace tenon::formats::text {

/// Reads one value of a type: a scalar, a tuple such as `(1, 2, 3)` or, for array types, a list.
/// The conversions are OpenUSD's: whole numbers fit float types, 0 and "no" fit bool, strings fit
/// asset, and so on.
bool read_value(Cursor& cursor, layer::ValueType type, bool is_array, layer::Value& value);

/// Reads a value whose type is unknown and keeps its source text in canonical form, `[1, "a"]`.
bool read_source_text(Cursor& cursor, std::string& text);

/// Reads `{ type name = value ... }`, with the limit limits::kTextNestingDepth.
bool read_dictionary(Cursor& cursor, layer::Dictionary& dictionary);

/// Takes a word that may name a type or a field: identifiers joined by "::", none of them reserved.
bool read_name(Cursor& cursor, std::string_view what, std::string_view& name);
/// A type as written: "float3" and whether "[]" follows, and what it means.
struct WrittenType {
  std::string_view name;
  bool is_array = false;
  const layer::TypeName* type = nullptr;  ///< nullptr when no such type is known
};
/// Takes a type name and the "[]" that may follow it.
bool read_type(Cursor& cursor, WrittenType& type);

}  // namespace tenon::formats::text
