// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <utility>

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

/// Named values in authored order. Copies share them until one of them is changed. The size of one
/// pointer; one allocation.
class FieldList {
 public:
  FieldList() = default;
  FieldList(const FieldList& other) : block_(other.block_) {
    if (block_ != nullptr) {
      block_->owners.fetch_add(1, std::memory_order_relaxed);
    }
  }
  FieldList(FieldList&& other) noexcept : block_(std::exchange(other.block_, nullptr)) {}
  FieldList& operator=(FieldList other) noexcept {
    std::swap(block_, other.block_);
    return *this;
  }
  ~FieldList() {
    if (block_ != nullptr && block_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) {
      destroy(block_);
    }
  }

  std::span<const Field> items() const {
    return block_ == nullptr ? std::span<const Field>()
                             : std::span<const Field>(block_->fields(), block_->count);
  }
  /// Fields that may be changed: this list's own from now on.
  std::span<Field> own_items() {
    if (block_ == nullptr) {
      return {};
    }
    reserve(block_->count);
    return {block_->fields(), block_->count};
  }
  void reserve(std::size_t count);
  void append(Token name, Value value) {
    const std::size_t count = items().size();
    if (block_ == nullptr || count == block_->capacity || is_shared()) {
      reserve(count < 4 ? 4 : 2 * count);
    }
    ::new (block_->fields() + count) Field{name, std::move(value)};
    ++block_->count;
  }
  void erase(Token name);
  /// True for lists that are one in memory.
  bool is_same(const FieldList& other) const { return block_ == other.block_; }

 private:
  struct alignas(Field) Block {
    std::atomic<std::uint32_t> owners{1};
    std::uint32_t count = 0;
    std::uint32_t capacity = 0;
    Field* fields() { return std::launder(reinterpret_cast<Field*>(this + 1)); }
  };

  bool is_shared() const { return block_->owners.load(std::memory_order_acquire) != 1; }
  static Block* make(std::size_t capacity);
  static void destroy(Block* block);

  Block* block_ = nullptr;
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

  std::span<const Field> fields() const { return fields_.items(); }
  void reserve_fields(std::size_t count) { fields_.reserve(count); }
  const FieldList& field_list() const { return fields_; }
  /// Replaces all fields, which stay shared with the owner of `fields`.
  void set_field_list(FieldList fields) { fields_ = std::move(fields); }

  /// The field's value, or nullptr.
  const Value* find(Token name) const {
    for (const Field& field : fields()) {
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
