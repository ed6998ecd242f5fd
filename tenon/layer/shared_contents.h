// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <utility>

#include "tenon/layer/value.h"

namespace tenon::layer {

/// The contents of a value, where they are, kept whatever becomes of the value: contents never
/// change. Nothing where the value holds no T. The size of one pointer. T is no array of numbers
/// and too large to be kept inline.
template <class T>
class SharedContents {
 public:
  SharedContents() = default;
  explicit SharedContents(const Value& value) {
    static_assert(!Value::kInline<T> && !Value::kIsArray<T>);
    const Value* const held = value.holds<T>() ? value.decoded_or_null() : nullptr;
    if (held != nullptr) {
      body_ = static_cast<Value::Held<T>*>(held->body());
      body_->owners.fetch_add(1, std::memory_order_relaxed);
    }
  }
  SharedContents(const SharedContents& other) : body_(other.body_) {
    if (body_ != nullptr) {
      body_->owners.fetch_add(1, std::memory_order_relaxed);
    }
  }
  SharedContents(SharedContents&& other) noexcept : body_(std::exchange(other.body_, nullptr)) {}
  SharedContents& operator=(SharedContents other) noexcept {
    std::swap(body_, other.body_);
    return *this;
  }
  ~SharedContents() {
    if (body_ != nullptr && body_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) {
      delete body_;
    }
  }

  /// nullptr where there are none.
  const T* get() const { return body_ == nullptr ? nullptr : &body_->value; }

 private:
  Value::Held<T>* body_ = nullptr;
};

}  // namespace tenon::layer
