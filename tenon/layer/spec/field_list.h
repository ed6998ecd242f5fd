// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/layer/value.h"

namespace tenon::layer {

struct Field {
  Field() = default;
  Field(Token field_name, Value field_value) : value(std::move(field_value)), name(field_name) {}

  [[no_unique_address]] Value value;  // the name uses its tail padding
  ShortToken name;
};
static_assert(sizeof(Field) == sizeof(Value), "many of them are in memory");

/// Fields one after another: in one or two rows, or picked out of a table.
class FieldRange {
 public:
  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = Field;
    using difference_type = std::ptrdiff_t;
    using pointer = const Field*;
    using reference = const Field&;

    Iterator() = default;
    const Field& operator*() const { return picked_ == nullptr ? *at_ : at_[*picked_]; }
    const Field* operator->() const { return &**this; }
    Iterator& operator++() {
      if (picked_ != nullptr) {
        ++picked_;
      } else if (++at_ == turn_) {
        at_ = second_;
      }
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const Iterator& other) const {
      return at_ == other.at_ && picked_ == other.picked_;
    }

   private:
    friend class FieldRange;
    Iterator(const Field* at, const Field* turn, const Field* second, const std::uint32_t* picked)
        : at_(at), turn_(turn), second_(second), picked_(picked) {}

    const Field* at_ = nullptr;
    const Field* turn_ = nullptr;    // the end of the first of two rows
    const Field* second_ = nullptr;  // where the second begins
    const std::uint32_t* picked_ = nullptr;
  };

  FieldRange() = default;
  explicit FieldRange(std::span<const Field> row) : fields_(row.data()), size_(row.size()) {}
  /// The first row has something in it.
  FieldRange(std::span<const Field> first, std::span<const Field> second)
      : fields_(first.data()),
        turn_(first.data() + first.size()),
        second_(second.data()),
        size_(first.size() + second.size()) {}
  FieldRange(const Field* table, std::span<const std::uint32_t> picked)
      : fields_(table), picked_(picked.data()), size_(picked.size()) {}

  Iterator begin() const { return {fields_, turn_, second_, picked_}; }
  Iterator end() const {
    return picked_ != nullptr ? Iterator(fields_, nullptr, nullptr, picked_ + size_)
                              : Iterator(row_at(size_), nullptr, nullptr, nullptr);
  }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const Field& operator[](std::size_t i) const {
    return picked_ == nullptr ? *row_at(i) : fields_[picked_[i]];
  }

 private:
  const Field* row_at(std::size_t i) const {
    const auto first = static_cast<std::size_t>(turn_ == nullptr ? 0 : turn_ - fields_);
    return turn_ == nullptr || i < first ? fields_ + i : second_ + (i - first);
  }

  const Field* fields_ = nullptr;
  const Field* turn_ = nullptr;
  const Field* second_ = nullptr;
  const std::uint32_t* picked_ = nullptr;
  std::size_t size_ = 0;
};

class FieldTable;

/// Named values in authored order. Copies share them until one of them is changed. The size of one
/// pointer: to fields of its own in one allocation, which may follow those of a list that many have
/// in common, or into a FieldTable.
class FieldList {
 public:
  FieldList() = default;
  /// A list that begins with what `common` has, which it shares; with room for `more` fields.
  FieldList(const FieldList& common, std::size_t more);
  FieldList(const FieldList& other) : at_(other.at_) { keep(); }
  FieldList(FieldList&& other) noexcept : at_(std::exchange(other.at_, nullptr)) {}
  FieldList& operator=(FieldList other) noexcept {
    std::swap(at_, other.at_);
    return *this;
  }
  ~FieldList() {
    if (at_ != nullptr) {
      release();
    }
  }

  FieldRange items() const;
  /// The field's value, or nullptr.
  const Value* find(Token name) const;
  /// Fields that may be changed: this list's own from now on.
  std::span<Field> own_items();
  void reserve(std::size_t count);
  void append(Token name, Value value);
  void erase(Token name);
  /// True for lists that are one in memory, which have one `id`; that of the empty list is null.
  bool is_same(const FieldList& other) const { return at_ == other.at_; }
  const void* id() const { return at_; }

 private:
  friend class FieldTable;

  struct alignas(Field) Block {
    std::atomic<std::uint32_t> owners{1};
    std::uint32_t count = 0;
    std::uint32_t capacity = 0;
    Block* common = nullptr;  // its fields come first; it has no common one itself
    Field* fields() { return std::launder(reinterpret_cast<Field*>(this + 1)); }
    std::span<Field> row() { return {fields(), count}; }
  };

  // Addresses in tables are odd.
  bool is_in_table() const { return (reinterpret_cast<std::uintptr_t>(at_) & 1u) != 0; }
  Block* block() const { return reinterpret_cast<Block*>(at_); }
  const std::uint32_t* picked() const { return reinterpret_cast<const std::uint32_t*>(at_ - 1); }
  bool is_own() const {
    return at_ != nullptr && !is_in_table() && block()->owners.load(std::memory_order_acquire) == 1;
  }
  void keep();
  void release();
  void make_room();
  static Block* make(std::size_t capacity);
  static void release(Block* block);

  std::byte* at_ = nullptr;
};

/// Fields that many lists pick from, as binary layers have them: a list costs four bytes for each
/// of its fields. Freed with the last list.
class FieldTable {
 public:
  /// Runs of places in `fields`, each ended by kEnd. Less than kEnd of them.
  static constexpr std::uint32_t kEnd = 1u << 31u;
  static FieldTable* make(std::vector<Field> fields, std::span<const std::uint32_t> runs);

  /// The list of the run that starts at `start` of `runs`, where one before it ends. Not for two
  /// threads at once.
  FieldList list(std::size_t start);
  /// What `make` and each list do: the last one frees it.
  void release();

 private:
  friend class FieldList;

  explicit FieldTable(std::vector<Field> fields) : fields_(std::move(fields)) {}
  ~FieldTable() = default;
  /// The runs, one place on; in front of each, in place of the end of another, stands how far it is
  /// from the first word, and kEnd.
  std::uint32_t* words() { return reinterpret_cast<std::uint32_t*>(this + 1); }
  static FieldTable& of(const std::uint32_t* picked) {
    const std::uint32_t* const words = picked - (picked[-1] & ~kEnd);
    return *std::launder(reinterpret_cast<FieldTable*>(const_cast<std::uint32_t*>(words)) - 1);
  }

  std::atomic<std::uint32_t> owners_{1};
  std::vector<Field> fields_;
};

inline FieldRange FieldList::items() const {
  if (at_ == nullptr) {
    return {};
  }
  if (!is_in_table()) {
    return block()->common == nullptr ? FieldRange(block()->row())
                                      : FieldRange(block()->common->row(), block()->row());
  }
  const std::uint32_t* end = picked();
  while ((*end & FieldTable::kEnd) == 0) {
    ++end;
  }
  return {FieldTable::of(picked()).fields_.data(), {picked(), end}};
}

inline const Value* FieldList::find(Token name) const {
  if (at_ == nullptr) {
    return nullptr;
  }
  const ShortToken wanted = name;
  if (is_in_table()) {
    const std::uint32_t* const first = picked();
    const Field* const fields = FieldTable::of(first).fields_.data();
    for (const std::uint32_t* at = first; (*at & FieldTable::kEnd) == 0; ++at) {
      if (fields[*at].name == wanted) {
        return &fields[*at].value;
      }
    }
    return nullptr;
  }
  for (Block* each : {block()->common, block()}) {
    for (const Field& field : each == nullptr ? std::span<Field>() : each->row()) {
      if (field.name == wanted) {
        return &field.value;
      }
    }
  }
  return nullptr;
}

inline void FieldList::append(Token name, Value value) {
  if (!is_own() || block()->count == block()->capacity) {
    make_room();
  }
  ::new (block()->fields() + block()->count) Field(name, std::move(value));
  ++block()->count;
}

inline void FieldList::keep() {
  if (at_ != nullptr) {
    (is_in_table() ? FieldTable::of(picked()).owners_ : block()->owners)
        .fetch_add(1, std::memory_order_relaxed);
  }
}

inline void FieldList::release() {
  is_in_table() ? FieldTable::of(picked()).release() : release(block());
}

}  // namespace tenon::layer
