// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tenon/base/token.h"
#include "tenon/layer/array_body.h"
#include "tenon/layer/scalar_types.h"

namespace tenon::layer {

/// An array of numbers, or of vectors, quaternions and matrices of them. Its elements never change;
/// copies share them. They are its own or in memory of another owner, such as a mapped file, that
/// is kept alive. The size of one pointer; one allocation. To make one, fill a std::vector.
template <class T>
class NumberArray {
 public:
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= 8);
  using value_type = T;
  using const_iterator = const T*;

  NumberArray() = default;
  explicit NumberArray(std::size_t count, T value = {})
      : NumberArray(std::vector<T>(count, value)) {}
  NumberArray(std::initializer_list<T> elements)
      : NumberArray(std::span<const T>(elements.begin(), elements.size())) {}
  explicit NumberArray(std::span<const T> elements) { copy_elements(elements); }
  NumberArray(const std::vector<T>& elements) : NumberArray(std::span<const T>(elements)) {}
  /// Takes a long vector over as it is; the elements of a short one are copied.
  NumberArray(std::vector<T>&& elements);
  /// `elements` as they lie in memory that `owner` keeps alive and unchanged.
  static NumberArray borrow(std::span<const T> elements, std::shared_ptr<const void> owner) {
    NumberArray array;
    if (!elements.empty()) {
      array.body_ = ArrayBody::borrow(elements.data(), elements.size(), &equal, std::move(owner));
    }
    return array;
  }

  NumberArray(const NumberArray& other) : body_(other.body_) {
    if (body_ != nullptr) {
      body_->owners.fetch_add(1, std::memory_order_relaxed);
    }
  }
  NumberArray(NumberArray&& other) noexcept : body_(std::exchange(other.body_, nullptr)) {}
  NumberArray& operator=(NumberArray other) noexcept {
    std::swap(body_, other.body_);
    return *this;
  }
  ~NumberArray() {
    if (body_ != nullptr && body_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) {
      delete body_;
    }
  }

  const T* data() const { return body_ == nullptr ? nullptr : static_cast<const T*>(body_->data); }
  std::size_t size() const { return body_ == nullptr ? 0 : body_->count; }
  bool empty() const { return body_ == nullptr; }
  std::span<const T> span() const { return {data(), size()}; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T& front() const { return data()[0]; }
  const T& back() const { return data()[size() - 1]; }
  bool operator==(const NumberArray& other) const {
    return body_ == other.body_ ||
           (body_ != nullptr && other.body_ != nullptr && body_->ArrayBody::equals(*other.body_));
  }

  /// What copies share and a Value holds; nullptr for an empty array.
  SharedBody* body() const { return body_; }
  /// As ArrayBody::Equal.
  static bool equal(const void* a, const void* b, std::size_t count);

 private:
  static void drop_vector(void* vector) { delete static_cast<std::vector<T>*>(vector); }
  void copy_elements(std::span<const T> elements) {
    if (!elements.empty()) {
      body_ = ArrayBody::copy(elements.data(), elements.size(), sizeof(T), &equal);
    }
  }

  ArrayBody* body_ = nullptr;
};

template <class T>
NumberArray<T>::NumberArray(std::vector<T>&& elements) {
  if (elements.size() * sizeof(T) < ArrayBody::kAdoptFrom) {
    copy_elements(elements);
    return;
  }
  auto* const kept = new std::vector<T>(std::move(elements));
  body_ = ArrayBody::adopt(kept->data(), kept->size(), &equal, kept, &drop_vector);
}

template <class T>
bool NumberArray<T>::equal(const void* a, const void* b, std::size_t count) {
  const T* const first = static_cast<const T*>(a);
  return std::equal(first, first + count, static_cast<const T*>(b));
}

/// How an element of an array is kept: bools one per byte.
template <class T>
using ArrayElement = std::conditional_t<std::is_same_v<T, bool>, char, T>;

/// Elements that an array is made from.
template <class T>
using ArrayBuffer = std::vector<ArrayElement<T>>;

/// Arrays of bools and of texts hold their own elements, others share them.
template <class T>
constexpr bool kIsNumberArray =
    !(std::is_same_v<T, bool> || std::is_same_v<T, std::string> || std::is_same_v<T, Token> ||
      std::is_same_v<T, AssetPath> || std::is_same_v<T, PathExpression>);
template <class T, bool IsNumber = kIsNumberArray<T>>
struct ArrayOf {
  using type = ArrayBuffer<T>;
};
template <class T>
struct ArrayOf<T, true> {
  using type = NumberArray<T>;
};

/// The contents of a value of array type.
template <class T>
using Array = typename ArrayOf<T>::type;

}  // namespace tenon::layer
