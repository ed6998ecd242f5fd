// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/spec/field_list.h"

#include <algorithm>
#include <memory>

namespace tenon::layer {

FieldList::Block* FieldList::make(std::size_t capacity) {
  static_assert(sizeof(Block) % alignof(Field) == 0);
  auto* block = ::new (::operator new(sizeof(Block) + capacity * sizeof(Field))) Block;
  block->capacity = static_cast<std::uint32_t>(capacity);
  return block;
}

void FieldList::release(Block* block) {
  if (block->owners.fetch_sub(1, std::memory_order_acq_rel) != 1) {
    return;
  }
  if (block->common != nullptr) {
    release(block->common);
  }
  std::destroy_n(block->fields(), block->count);
  block->~Block();
  ::operator delete(block);
}

FieldList::FieldList(const FieldList& common, std::size_t more) {
  if (common.at_ != nullptr && (common.is_in_table() || common.block()->common != nullptr)) {
    *this = common;
    reserve(items().size() + more);
    return;
  }
  Block* const made = make(more);
  at_ = reinterpret_cast<std::byte*>(made);
  if (!common.items().empty()) {
    common.block()->owners.fetch_add(1, std::memory_order_relaxed);
    made->common = common.block();
  }
}

/// All fields in a block that is this list's alone, with room for `count`.
void FieldList::reserve(std::size_t count) {
  const FieldRange there = items();
  const bool whole = is_own() && block()->common == nullptr;
  if (at_ == nullptr ? count == 0 : whole && count <= block()->capacity) {
    return;
  }
  FieldList more;
  Block* const made = make(std::max(count, there.size()));
  more.at_ = reinterpret_cast<std::byte*>(made);
  if (whole) {
    std::uninitialized_move_n(block()->fields(), there.size(), made->fields());
  } else {
    std::uninitialized_copy(there.begin(), there.end(), made->fields());
  }
  made->count = static_cast<std::uint32_t>(there.size());
  *this = std::move(more);
}

/// For one field more. What is in common stays so.
void FieldList::make_room() {
  if (!is_own() || block()->common == nullptr) {
    const std::size_t count = items().size();
    return reserve(count < 4 ? 4 : 2 * count);
  }
  FieldList more;
  Block* const made = make(2 * std::size_t{block()->count} + 2);
  more.at_ = reinterpret_cast<std::byte*>(made);
  std::uninitialized_move_n(block()->fields(), block()->count, made->fields());
  made->count = block()->count;
  made->common = std::exchange(block()->common, nullptr);
  *this = std::move(more);
}

std::span<Field> FieldList::own_items() {
  if (at_ == nullptr) {
    return {};
  }
  reserve(items().size());
  return block()->row();
}

void FieldList::erase(Token name) {
  if (find(name) == nullptr) {
    return;
  }
  const std::span<Field> own = own_items();
  Field* const end = std::remove_if(own.data(), own.data() + own.size(),
                                    [&](const Field& field) { return field.name == name; });
  std::destroy(end, own.data() + own.size());
  block()->count = static_cast<std::uint32_t>(end - own.data());
}

FieldTable* FieldTable::make(std::vector<Field> fields, std::span<const std::uint32_t> runs) {
  static_assert(sizeof(FieldTable) % alignof(std::uint32_t) == 0);
  const std::size_t bytes = sizeof(FieldTable) + (runs.size() + 1) * sizeof(std::uint32_t);
  auto* const table = ::new (::operator new(bytes)) FieldTable(std::move(fields));
  std::uint32_t* const words = table->words();
  words[0] = kEnd | 1u;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool ends = (runs[i] & kEnd) != 0;
    words[i + 1] = ends ? kEnd | static_cast<std::uint32_t>(i + 2) : runs[i];
  }
  return table;
}

FieldList FieldTable::list(std::size_t start) {
  FieldList made;
  made.at_ = reinterpret_cast<std::byte*>(words() + start + 1) + 1;
  owners_.store(owners_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  return made;
}

void FieldTable::release() {
  if (owners_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
    this->~FieldTable();
    ::operator delete(this);
  }
}

}  // namespace tenon::layer
