// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tenon/base/token.h"
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

struct Field {
  Token name;
  Value value;
};

/// What one layer says about one path: named fields in authored order, and where in the source.
class Spec {
 public:
  SpecKind kind = SpecKind::None;
  std::uint32_t line = 0;    ///< 1-based source line; 0 when unknown (binary layers)
  std::uint32_t column = 0;  ///< 1-based, in bytes

  const std::vector<Field>& fields() const { return fields_; }
  void reserve_fields(std::size_t count) { fields_.reserve(count); }

  /// The field's value, or nullptr.
  const Value* find(Token name) const {
    for (const Field& field : fields_) {
      if (field.name == name) {
        return &field.value;
      }
    }
    return nullptr;
  }
  bool has(Token name) const { return find(name) != nullptr; }
  /// The field's contents when it exists and is a T, else nullptr.
  template <class T>
  const T* get(Token name) const {
    const Value* value = find(name);
    return value == nullptr ? nullptr : value->get<T>();
  }
  template <class T>
  T get_or(Token name, T fallback) const {
    const T* value = get<T>(name);
    return value == nullptr ? fallback : *value;
  }

  void set(Token name, Value value) {
    for (Field& field : fields_) {
      if (field.name == name) {
        field.value = std::move(value);
        return;
      }
    }
    fields_.push_back({name, std::move(value)});
  }
  /// Appends without looking for an earlier field of that name; for readers of checked input.
  void append(Token name, Value value) { fields_.push_back({name, std::move(value)}); }
  void erase(Token name) {
    std::erase_if(fields_, [&](const Field& field) { return field.name == name; });
  }

 private:
  std::vector<Field> fields_;
};

}  // namespace tenon::layer
