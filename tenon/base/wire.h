// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "tenon/base/containers/apart.h"
#include "tenon/base/enum_range.h"
#include "tenon/base/fields.h"

/// Plain values as bytes, for another process of one machine: numbers, enums, strings, vectors,
/// arrays, pairs, optionals, maps, and structs of such. What is decoded comes from a process that
/// may be hostile: no count is believed before the bytes that it needs are there, flags are 0 or 1,
/// enums are enumerators. What the values mean (indices, finite numbers) is for their owner to
/// check.
namespace tenon::wire {

template <class T>
inline constexpr bool kIsVector = false;
template <class T>
inline constexpr bool kIsVector<std::vector<T>> = true;
template <class T>
inline constexpr bool kIsArray = false;
template <class T, std::size_t N>
inline constexpr bool kIsArray<std::array<T, N>> = true;
template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsOptional<Apart<T>> = true;
template <class T>
inline constexpr bool kIsMap = false;
template <class K, class V>
inline constexpr bool kIsMap<std::map<K, V>> = true;
template <class T>
inline constexpr bool kIsPair = false;
template <class A, class B>
inline constexpr bool kIsPair<std::pair<A, B>> = true;
template <class T>
inline constexpr bool kIsNumber = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;

/// A type that travels as another one says here how:
///   static Other to(const T& value);  static std::optional<T> from(const Other& there);
template <class T>
struct TravelsAs;
template <class T>
concept Travels = requires(const T& value) { TravelsAs<T>::from(TravelsAs<T>::to(value)); };
template <class T>
using Travelling = decltype(TravelsAs<T>::to(std::declval<const T&>()));

template <class T>
constexpr std::size_t min_size();

template <class... T>
constexpr std::size_t sum_of_least(TypeList<T...>) {
  return (std::size_t{0} + ... + min_size<T>());
}

/// Bytes that the smallest value of a type takes.
template <class T>
constexpr std::size_t min_size() {
  if constexpr (kIsNumber<T> || std::is_enum_v<T>) {
    return sizeof(T);
  } else if constexpr (std::is_same_v<T, bool> || kIsOptional<T>) {
    return 1;
  } else if constexpr (std::is_same_v<T, std::string> || kIsVector<T> || kIsMap<T>) {
    return sizeof(std::uint64_t);
  } else if constexpr (kIsArray<T>) {
    return std::tuple_size_v<T> * min_size<typename T::value_type>();
  } else if constexpr (kIsPair<T>) {
    return min_size<typename T::first_type>() + min_size<typename T::second_type>();
  } else if constexpr (Travels<T>) {
    return min_size<Travelling<T>>();
  } else {
    return sum_of_least(FieldTypes<T>());
  }
}

template <class T>
constexpr bool is_flat();

template <class... T>
constexpr bool all_flat(TypeList<T...>) {
  return (is_flat<T>() && ...);
}

/// Numbers without gaps, which are copied as they lie in memory.
template <class T>
constexpr bool is_flat() {
  if constexpr (kIsNumber<T>) {
    return true;
  } else if constexpr (kIsArray<T>) {
    return is_flat<typename T::value_type>() && sizeof(T) == min_size<T>();
  } else if constexpr (Travels<T> || kIsPair<T>) {
    return false;
  } else if constexpr (std::is_aggregate_v<T> && std::is_trivially_copyable_v<T>) {
    return all_flat(FieldTypes<T>()) && sizeof(T) == min_size<T>();
  } else {
    return false;
  }
}

/// Writes a value into `sink`, which has `void put(const void* bytes, std::size_t count)`.
template <class Sink, class T>
void encode(Sink& sink, const T& value) {
  if constexpr (is_flat<T>()) {
    sink.put(&value, sizeof(T));
  } else if constexpr (Travels<T>) {
    encode(sink, TravelsAs<T>::to(value));
  } else if constexpr (std::is_same_v<T, bool>) {
    const char flag = value ? 1 : 0;
    sink.put(&flag, 1);
  } else if constexpr (std::is_enum_v<T>) {
    encode(sink, static_cast<std::underlying_type_t<T>>(value));
  } else if constexpr (std::is_same_v<T, std::string>) {
    encode(sink, std::uint64_t{value.size()});
    sink.put(value.data(), value.size());
  } else if constexpr (kIsPair<T>) {
    encode(sink, value.first);
    encode(sink, value.second);
  } else if constexpr (kIsOptional<T>) {
    encode(sink, value.has_value());
    if (value) {
      encode(sink, *value);
    }
  } else if constexpr (kIsMap<T>) {
    encode(sink, std::uint64_t{value.size()});
    for (const auto& [key, item] : value) {
      encode(sink, key);
      encode(sink, item);
    }
  } else if constexpr (kIsVector<T> || kIsArray<T>) {
    if constexpr (kIsVector<T>) {
      encode(sink, std::uint64_t{value.size()});
    }
    if constexpr (is_flat<typename T::value_type>()) {
      sink.put(value.data(), value.size() * sizeof(typename T::value_type));
    } else {
      for (const auto& item : value) {
        encode(sink, item);
      }
    }
  } else {
    with_fields(value, [&](const auto&... field) { (encode(sink, field), ...); });
  }
}

/// Reads values from untrusted bytes. After the first fault nothing more is read.
class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : rest_(bytes) {}

  bool is_sound() const { return is_sound_; }
  bool is_done() const { return is_sound_ && rest_.empty(); }

  template <class T>
  void read(T& value) {
    if constexpr (is_flat<T>()) {
      take(&value, sizeof(T));
    } else if constexpr (Travels<T>) {
      read_travelling(value);
    } else if constexpr (kIsPair<T>) {
      read(value.first);
      read(value.second);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = flag();
    } else if constexpr (std::is_enum_v<T>) {
      read_enum(value);
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.resize(count(1));
      take(value.data(), value.size());
    } else if constexpr (kIsOptional<T>) {
      if (flag()) {
        read(value.emplace());
      }
    } else if constexpr (kIsMap<T>) {
      read_map(value);
    } else if constexpr (kIsVector<T>) {
      value.resize(count(min_size<typename T::value_type>()));
      read_items(value);
    } else if constexpr (kIsArray<T>) {
      read_items(value);
    } else {
      with_fields(value, [&](auto&... field) { (read(field), ...); });
    }
  }

  // What values that are not known to the compiler are read of.

  /// The next bytes as they are.
  void take(void* to, std::size_t size) {
    if (!is_sound_ || rest_.size() < size) {
      is_sound_ = false;
      return;
    }
    if (size != 0) {
      std::memcpy(to, rest_.data(), size);
      rest_.remove_prefix(size);
    }
  }

  /// How many items follow, each of at least `least` bytes; 0 where they cannot be there.
  std::size_t count(std::size_t least) {
    std::uint64_t items = 0;
    take(&items, sizeof(items));
    if (!is_sound_ || items > rest_.size() / least) {
      is_sound_ = false;
      return 0;
    }
    return static_cast<std::size_t>(items);
  }

  /// A byte that is 0 or 1.
  bool flag() {
    unsigned char byte = 0;
    take(&byte, 1);
    is_sound_ = is_sound_ && byte <= 1;
    return is_sound_ && byte == 1;
  }

 private:
  template <class T>
  void read_travelling(T& value) {
    Travelling<T> there{};
    read(there);
    if (std::optional<T> read = is_sound_ ? TravelsAs<T>::from(there) : std::nullopt) {
      value = *std::move(read);
    } else {
      is_sound_ = false;
    }
  }

  template <class Enum>
  void read_enum(Enum& value) {
    std::underlying_type_t<Enum> number = 0;
    take(&number, sizeof(number));
    if (is_sound_ && is_enumerator<Enum>(number)) {
      value = static_cast<Enum>(number);
    } else {
      is_sound_ = false;
    }
  }

  template <class K, class V>
  void read_map(std::map<K, V>& value) {
    const std::size_t items = count(min_size<K>() + min_size<V>());
    for (std::size_t i = 0; i < items && is_sound_; ++i) {
      K key{};
      read(key);
      const auto [at, is_new] = value.try_emplace(std::move(key));
      is_sound_ = is_sound_ && is_new;
      read(at->second);
    }
  }

  template <class Items>
  void read_items(Items& value) {
    if constexpr (is_flat<typename Items::value_type>()) {
      take(value.data(), value.size() * sizeof(typename Items::value_type));
    } else {
      for (auto& item : value) {
        read(item);
        if (!is_sound_) {
          return;
        }
      }
    }
  }

  std::string_view rest_;
  bool is_sound_ = true;
};

/// Counts the bytes of an encoding.
struct SizeSink {
  std::uint64_t size = 0;
  void put(const void*, std::size_t count) { size += count; }
};

struct StringSink {
  std::string bytes;
  void put(const void* from, std::size_t count) {
    bytes.append(static_cast<const char*>(from), count);
  }
};

template <class T>
std::uint64_t encoded_size(const T& value) {
  SizeSink sink;
  encode(sink, value);
  return sink.size;
}

template <class T>
std::string encoded(const T& value) {
  StringSink sink;
  encode(sink, value);
  return std::move(sink.bytes);
}

/// The value that all of `bytes` is; none where they are not one.
template <class T>
std::optional<T> decoded(std::string_view bytes) {
  std::optional<T> value(std::in_place);
  Decoder decoder(bytes);
  decoder.read(*value);
  if (!decoder.is_done()) {
    value.reset();
  }
  return value;
}

}  // namespace tenon::wire
