// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/spec.h"

#include <algorithm>
#include <memory>

namespace tenon::layer {

FieldList::Block* FieldList::make(std::size_t capacity) {
  static_assert(sizeof(Block) % alignof(Field) == 0);
  auto* block = ::new (::operator new(sizeof(Block) + capacity * sizeof(Field))) Block;
  block->capacity = static_cast<std::uint32_t>(capacity);
  return block;
}

void FieldList::destroy(Block* block) {
  std::destroy_n(block->fields(), block->count);
  block->~Block();
  ::operator delete(block);
}

/// Makes room for `count` fields in a block that is this list's alone.
void FieldList::reserve(std::size_t count) {
  if (block_ == nullptr) {
    block_ = count == 0 ? nullptr : make(count);
    return;
  }
  const bool shared = is_shared();
  if (!shared && count <= block_->capacity) {
    return;
  }
  FieldList own;
  own.block_ = make(std::max<std::size_t>(count, block_->count));
  if (shared) {
    std::uninitialized_copy_n(block_->fields(), block_->count, own.block_->fields());
  } else {
    std::uninitialized_move_n(block_->fields(), block_->count, own.block_->fields());
  }
  own.block_->count = block_->count;
  *this = std::move(own);
}

void FieldList::erase(Token name) {
  const auto named = [&](const Field& field) { return field.name == name; };
  if (std::none_of(items().begin(), items().end(), named)) {
    return;
  }
  const std::span<Field> own = own_items();
  Field* const end = std::remove_if(own.data(), own.data() + own.size(), named);
  std::destroy(end, own.data() + own.size());
  block_->count = static_cast<std::uint32_t>(end - own.data());
}

void Spec::set(Token name, Value value) {
  if (!has(name)) {
    fields_.append(name, std::move(value));
    return;
  }
  for (Field& field : fields_.own_items()) {
    if (field.name == name) {
      field.value = std::move(value);
      return;
    }
  }
}

}  // namespace tenon::layer
