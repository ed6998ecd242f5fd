// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/layer/number_arrays.h"

#include <utility>

namespace tenon::layer {

void NumberBuffer::append(const NumberBuffer& other) {
  if (other.size_ != 0) {
    reserve(size_ + other.size_);
    std::memcpy(bytes_.get() + size_, other.bytes_.get(), other.size_);
    size_ += other.size_;
  }
}

void NumberBuffer::reserve(std::size_t bytes) {
  if (bytes > capacity_) {
    auto larger = std::make_unique_for_overwrite<std::byte[]>(bytes);
    if (size_ != 0) {
      std::memcpy(larger.get(), bytes_.get(), size_);
    }
    bytes_ = std::move(larger);
    capacity_ = bytes;
  }
}

std::shared_ptr<const void> NumberBuffer::take_owner() {
  size_ = 0;
  capacity_ = 0;
  return std::shared_ptr<const std::byte[]>(std::move(bytes_));
}

NumberLayout NumberArrays::layout(ValueType type) {
  switch (type) {
#define TENON_NUMBER(enumerator, type, name, crate_id) \
  case ValueType::enumerator:                          \
    return {sizeof(type), &NumberArray<type>::equal};
#include "tenon/layer/value_types.def"
    default:
      return {};
  }
}

Value NumberArrays::value(ValueType type, ArrayBody* body) {
  Value value;
  value.type_ = type;
  value.is_array_ = true;
  new (&value.storage_) ArrayBody*(body);
  value.holding_ = body == nullptr ? Value::Holding::Inline : Value::Holding::Body;
  return value;
}

Value NumberArrays::make(ValueType type, std::span<const std::byte> elements) {
  const NumberLayout lies = layout(type);
  const std::size_t count = elements.size() / lies.size;
  return value(
      type, count == 0 ? nullptr : ArrayBody::copy(elements.data(), count, lies.size, lies.equal));
}

Value NumberArrays::make(ValueType type, NumberBuffer&& elements) {
  const std::span<const std::byte> bytes = elements.bytes();
  return bytes.size() < ArrayBody::kAdoptFrom ? make(type, bytes)
                                              : borrow(type, bytes, elements.take_owner());
}

Value NumberArrays::borrow(ValueType type, std::span<const std::byte> elements,
                           std::shared_ptr<const void> owner) {
  const NumberLayout lies = layout(type);
  const std::size_t count = elements.size() / lies.size;
  return value(type, count == 0
                         ? nullptr
                         : ArrayBody::borrow(elements.data(), count, lies.equal, std::move(owner)));
}

std::optional<std::span<const std::byte>> NumberArrays::elements(const Value& value) {
  const std::size_t size = value.is_array() ? layout(value.type()).size : 0;
  const Value* const held = size == 0 ? nullptr : value.decoded_or_null();
  if (held == nullptr) {
    return std::nullopt;
  }
  if (held->holding_ == Value::Holding::Inline) {
    return std::span<const std::byte>();
  }
  const auto& body = static_cast<const ArrayBody&>(*held->body());
  return std::span(static_cast<const std::byte*>(body.data), body.count * size);
}

}  // namespace tenon::layer
