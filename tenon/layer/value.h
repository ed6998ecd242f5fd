// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/layer/array.h"
#include "tenon/layer/scalar_types.h"
#include "tenon/math/half.h"
#include "tenon/math/matrix.h"
#include "tenon/math/quaternion.h"
#include "tenon/math/vector.h"

namespace tenon::layer {

template <class T>
struct ListOp;
struct ArrayEdit;
struct Dictionary;
struct LayerOffset;
struct Payload;
struct Reference;
struct Relocates;
struct Spline;
struct TimeSamples;
struct UnregisteredValue;
struct VariantSelections;

enum class ValueType : std::uint8_t {
  None,
#define TENON_SCALAR(enumerator, type, name, crate_id) enumerator,
#define TENON_FIELD(enumerator, type, crate_id) enumerator,
#include "tenon/layer/value_types.def"
};

template <class T>
struct ValueTraits;  // type, is_array
#define TENON_SCALAR(enumerator, cpp_type, name, crate_id)   \
  template <>                                                \
  struct ValueTraits<cpp_type> {                             \
    static constexpr ValueType type = ValueType::enumerator; \
    static constexpr bool is_array = false;                  \
  };                                                         \
  template <>                                                \
  struct ValueTraits<Array<cpp_type>> {                      \
    static constexpr ValueType type = ValueType::enumerator; \
    static constexpr bool is_array = true;                   \
  };
#define TENON_FIELD(enumerator, cpp_type, crate_id)          \
  template <>                                                \
  struct ValueTraits<cpp_type> {                             \
    static constexpr ValueType type = ValueType::enumerator; \
    static constexpr bool is_array = false;                  \
  };
#include "tenon/layer/value_types.def"

class Value;
template <class T>
class SharedContents;

/// An array that still lies in a file; decoded on first use, once, from any thread.
class DeferredArray {
 public:
  virtual ~DeferredArray() = default;
  /// Number of elements, known without decoding.
  virtual std::size_t size() const = 0;
  /// The decoded array; an Error for corrupt data.
  virtual Result<Value> decode() const = 0;
};

/// The array type of a std::vector<T>.
template <class T>
concept ArrayElementType = requires { ValueTraits<NumberArray<T>>::type; };

/// One value of any type that a layer can hold. Copies share large contents, which never change.
/// 32 bytes, five of them to spare; numbers up to three doubles, tokens and paths are stored
/// inline.
class Value {
 public:
  Value() = default;
  Value(const Value& other) { copy_from(other); }
  Value(Value&& other) noexcept { take_from(other); }
  Value& operator=(const Value& other) { return *this = Value(other); }
  Value& operator=(Value&& other) noexcept {
    if (this != &other) {
      release();
      take_from(other);
    }
    return *this;
  }
  ~Value() { release(); }

  template <class T, class Traits = ValueTraits<std::decay_t<T>>, ValueType = Traits::type>
  Value(T&& value) : type_(Traits::type), is_array_(Traits::is_array) {
    using Stored = std::decay_t<T>;
    if constexpr (kIsArray<Stored>) {
      const auto* array = new (&storage_) Stored(std::forward<T>(value));
      holding_ = array->body() == nullptr ? Holding::Inline : Holding::Body;
    } else if constexpr (kInline<Stored>) {
      new (&storage_) Stored(std::forward<T>(value));
    } else {
      new (&storage_) SharedBody*(new Held<Stored>(std::forward<T>(value)));
      holding_ = Holding::Body;
    }
  }
  /// An array of these elements.
  template <ArrayElementType T>
  Value(std::vector<T> elements) : Value(NumberArray<T>(std::move(elements))) {}
  /// A value of array type `element` that is decoded when asked for.
  static Value deferred(ValueType element, std::unique_ptr<DeferredArray> source);

  bool empty() const { return type_ == ValueType::None; }
  ValueType type() const { return type_; }
  bool is_array() const { return is_array_; }
  bool is_block() const { return type_ == ValueType::ValueBlock; }
  bool is_deferred() const { return holding_ == Holding::Deferred; }

  /// The contents when they are a T, else nullptr. Decodes a deferred array; nullptr when its data
  /// are corrupt (see `decoded`). Arrays are Array<T>.
  template <class T>
  const T* get() const {
    using Traits = ValueTraits<T>;
    if (type_ != Traits::type || is_array_ != Traits::is_array) {
      return nullptr;
    }
    if constexpr (kIsArray<T>) {
      const Value* value = decoded_or_null();
      return value == nullptr ? nullptr
                              : std::launder(reinterpret_cast<const T*>(&value->storage_));
    } else if constexpr (kInline<T>) {
      return std::launder(reinterpret_cast<const T*>(&storage_));
    } else {
      const Value* value = decoded_or_null();
      return value == nullptr ? nullptr : &static_cast<const Held<T>*>(value->body())->value;
    }
  }
  template <class T>
  T get_or(T fallback) const {
    const T* value = get<T>();
    if (value != nullptr) {
      return *value;
    }
    return fallback;
  }
  /// The contents, moved out where they are not shared; the value is empty afterwards. It must hold
  /// a T, which is no array and too large to be kept inline.
  template <class T>
  T take() {
    static_assert(!kInline<T> && !kIsArray<T>);
    auto& held = *static_cast<Held<T>*>(body());
    const bool shared = held.owners.load(std::memory_order_acquire) != 1;
    T contents = shared ? T(held.value) : std::move(held.value);
    *this = Value();
    return contents;
  }
  template <class T>
  bool holds() const {
    return type_ == ValueTraits<T>::type && is_array_ == ValueTraits<T>::is_array;
  }

  /// This value with deferred data read, or the reason why they cannot be.
  Result<Value> decoded() const;
  /// Number of elements of an array (also of a deferred one); 1 for other values, 0 for none.
  std::size_t size() const;

  /// Same type and equal contents; decodes deferred arrays. NaN differs from NaN.
  bool operator==(const Value& other) const;

 private:
  friend struct NumberArrays;
  template <class T>
  friend class SharedContents;
  template <class T>
  struct Held final : SharedBody {
    template <class U>
    explicit Held(U&& u) : value(std::forward<U>(u)) {}
    bool equals(const SharedBody& other) const override {
      return value == static_cast<const Held&>(other).value;
    }
    std::size_t size() const override {
      if constexpr (ValueTraits<T>::is_array) {
        return value.size();
      } else {
        return 1;
      }
    }
    T value;
  };
  struct DeferredBody;
  enum class Holding : std::uint8_t { Inline, Body, Deferred };

  static constexpr std::size_t kRoom = 24;  // three doubles: most translations

  template <class T>
  static constexpr bool kInline =
      std::is_trivially_copyable_v<T> && sizeof(T) <= kRoom && alignof(T) <= 8;

  template <class T>
  struct IsArray : std::false_type {};
  template <class T>
  struct IsArray<NumberArray<T>> : std::true_type {};
  template <class T>
  static constexpr bool kIsArray = IsArray<T>::value;

  SharedBody* body() const {
    return *std::launder(reinterpret_cast<SharedBody* const*>(&storage_));
  }
  const Value* decoded_or_null() const;
  bool equal_arrays(const Value& other) const;
  void copy_from(const Value& other) {
    std::memcpy(storage_, other.storage_, sizeof(storage_));
    type_ = other.type_;
    is_array_ = other.is_array_;
    holding_ = other.holding_;
    if (holding_ != Holding::Inline) {
      body()->owners.fetch_add(1, std::memory_order_relaxed);
    }
  }
  void take_from(Value& other) noexcept {
    std::memcpy(storage_, other.storage_, sizeof(storage_));
    type_ = other.type_;
    is_array_ = other.is_array_;
    holding_ = other.holding_;
    other.type_ = ValueType::None;
    other.is_array_ = false;
    other.holding_ = Holding::Inline;
  }
  /// Leaves the members as they are.
  void release() {
    if (holding_ != Holding::Inline) {
      release_body();
    }
  }
  void release_body();

  alignas(8) std::byte storage_[kRoom] = {};
  ValueType type_ = ValueType::None;
  bool is_array_ = false;
  Holding holding_ = Holding::Inline;
};

// Compiled once, in value.cpp.
#define TENON_NUMBER(enumerator, cpp_type, name, crate_id)                     \
  extern template NumberArray<cpp_type>::NumberArray(std::vector<cpp_type>&&); \
  extern template bool NumberArray<cpp_type>::equal(const void*, const void*, std::size_t);
#include "tenon/layer/value_types.def"

}  // namespace tenon::layer
