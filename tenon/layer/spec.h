// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "tenon/base/token.h"
#include "tenon/layer/spec/field_list.h"
#include "tenon/layer/value.h"

namespace tenon::layer {

enum class SpecKind : std::uint8_t {
  None,
  PseudoRoot,
  Prim,
  Attribute,
  Relationship,
  VariantSet,
  Variant,
  Connection,
  RelationshipTarget,
  Mapper,
  MapperArg,
  Expression,
};

/// What one layer says about one path: named fields in authored order, and where in the source.
/// Specs may share their fields; changing those of one does not change another.
class Spec {
 public:
  static constexpr std::uint32_t kLastColumn = (1U << 24U) - 1;

  SpecKind kind = SpecKind::None;
  std::uint32_t column : 24 = 0;  ///< 1-based, in bytes; kLastColumn for all beyond
  std::uint32_t line = 0;         ///< 1-based source line; 0 when unknown (binary layers)

  void set_place(std::uint32_t source_line, std::uint32_t source_column) {
    line = source_line;
    column = (source_column < kLastColumn ? source_column : kLastColumn) & kLastColumn;
  }

  FieldRange fields() const { return fields_.items(); }
  void reserve_fields(std::size_t count) { fields_.reserve(count); }
  const FieldList& field_list() const { return fields_; }
  /// Replaces all fields, which stay shared with the owner of `fields`.
  void set_field_list(FieldList fields) { fields_ = std::move(fields); }

  /// The field's value, or nullptr.
  const Value* find(Token name) const { return fields_.find(name); }
  bool has(Token name) const { return find(name) != nullptr; }
  /// The field's contents when it exists and is a T, else nullptr.
  template <class T>
  const T* get(Token name) const {
    const Value* value = find(name);
    return value == nullptr ? nullptr : value->get<T>();
  }
  template <class T>
  T get_or(Token name, T fallback) const {
    if (const T* value = get<T>(name)) {
      return *value;
    }
    return fallback;
  }

  void set(Token name, Value value);
  /// Appends without looking for an earlier field of that name; for readers of checked input.
  void append(Token name, Value value) { fields_.append(name, std::move(value)); }
  void erase(Token name) { fields_.erase(name); }

 private:
  FieldList fields_;
};

static_assert(sizeof(Spec) == 8 + sizeof(void*), "many of them are in memory");

}  // namespace tenon::layer
