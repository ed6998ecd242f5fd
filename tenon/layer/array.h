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
#include "tenon/layer/scalar_types.h"

namespace tenon::layer {

/// Contents that values share: counted, never changed while there is more than one owner.
struct SharedBody {
  SharedBody() = default;
  SharedBody(const SharedBody&) = delete;
  SharedBody& operator=(const SharedBody&) = delete;
  virtual ~SharedBody() = default;
  virtual bool equals(const SharedBody& other) const = 0;
  /// Number of elements of an array, else 1.
  virtual std::size_t size() const = 0;
  std::atomic<std::uint32_t> owners{1};
};

/// An array of numbers, or of vectors, quaternions and matrices of them. Its elements never change;
/// copies share them. They are its own or lie in memory of somebody else, such as a mapped file,
/// that is kept alive. The size of one pointer; one allocation. To make one, fill a std::vector.
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
  NumberArray(std::vector<T>&& elements) {
    if (elements.size() * sizeof(T) < kAdoptFrom) {
      copy_elements(elements);
      return;
    }
    auto owner = std::make_shared<const std::vector<T>>(std::move(elements));
    body_ = new Borrowed(*owner, owner);
  }
  /// `elements` as they lie in memory that `owner` keeps alive and unchanged.
  static NumberArray borrow(std::span<const T> elements, std::shared_ptr<const void> owner) {
    NumberArray array;
    if (!elements.empty()) {
      array.body_ = new Borrowed(elements, std::move(owner));
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

  const T* data() const { return body_ == nullptr ? nullptr : elements().data; }
  std::size_t size() const { return body_ == nullptr ? 0 : elements().count; }
  bool empty() const { return body_ == nullptr; }
  std::span<const T> span() const { return {data(), size()}; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T& front() const { return data()[0]; }
  const T& back() const { return data()[size() - 1]; }
  bool operator==(const NumberArray& other) const {
    return body_ == other.body_ || std::equal(begin(), end(), other.begin(), other.end());
  }

  /// What copies share and a Value holds; nullptr for an empty array.
  SharedBody* body() const { return body_; }

 private:
  static constexpr std::size_t kAdoptFrom = 4096;  // bytes

  struct Elements : SharedBody {
    Elements(const T* first, std::size_t n) : data(first), count(n) {}
    bool equals(const SharedBody& other) const override {
      const auto& o = static_cast<const Elements&>(other);
      return std::equal(data, data + count, o.data, o.data + o.count);
    }
    std::size_t size() const override { return count; }
    const T* data;
    std::size_t count;
  };
  /// Elements behind the body, in one allocation.
  struct Own final : Elements {
    explicit Own(std::size_t n) : Elements(reinterpret_cast<const T*>(this + 1), n) {}
    static void operator delete(void* memory) { ::operator delete(memory); }
  };
  struct Borrowed final : Elements {
    Borrowed(std::span<const T> elements, std::shared_ptr<const void> o)
        : Elements(elements.data(), elements.size()), owner(std::move(o)) {}
    std::shared_ptr<const void> owner;
  };

  const Elements& elements() const { return *static_cast<const Elements*>(body_); }
  void copy_elements(std::span<const T> elements) {
    if (!elements.empty()) {
      void* memory = ::operator new(sizeof(Own) + elements.size_bytes());
      body_ = ::new (memory) Own(elements.size());
      std::memcpy(static_cast<void*>(static_cast<Own*>(body_) + 1), elements.data(),
                  elements.size_bytes());
    }
  }

  SharedBody* body_ = nullptr;
};

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
