// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tenon/base/wire.h"
#include "tenon/math/matrix.h"
#include "tenon/math/transform.h"
#include "tenon/math/vector.h"
#include "tenon/scene/fields/data_type.h"
#include "tenon/scene/fields/enum_names.h"

/// Makes the data type of a C++ type, and of all that it is made of. For the one file that does it
/// for the whole scene, and for tests with tables of their own.
namespace tenon::scene {

/// Numbers in a row, by the type that holds them.
template <class T>
struct RowOfNumbers : std::false_type {};
template <class T, std::size_t N>
struct RowOfNumbers<std::array<T, N>> : std::true_type {
  using Number = T;
};
template <class T, std::size_t N>
struct RowOfNumbers<Vec<T, N>> : std::true_type {
  using Number = T;
};
template <std::size_t N>
struct RowOfNumbers<Matrix<N>> : std::true_type {
  using Number = double;
};

template <class T>
void describe_number(DataType& type) {
  static_assert(std::is_integral_v<T> || std::is_same_v<T, double>, "fields have no such number");
  type.kind = std::is_same_v<T, double>  ? DataKind::Real
              : std::is_same_v<T, Index> ? DataKind::Ordinal
                                         : DataKind::Integer;
  type.is_signed = std::is_signed_v<T>;
  type.is_flat = true;
  type.wire_size = sizeof(T);
}

template <class T>
void describe_numbers(DataType& type) {
  using Number = typename RowOfNumbers<T>::Number;
  static_assert(std::is_arithmetic_v<Number> && sizeof(T) % sizeof(Number) == 0);
  type.kind = DataKind::Numbers;
  type.count = sizeof(T) / sizeof(Number);
  type.item = &data_type<Number>();
  type.items = [](const void*) { return sizeof(T) / sizeof(Number); };
  type.first = [](const void* value) { return value; };
  type.is_flat = true;
  type.wire_size = sizeof(T);
}

template <class T>
void describe_list(DataType& type) {
  using Item = typename T::value_type;
  static_assert(!std::is_same_v<Item, bool>, "bits of a vector cannot be pointed at");
  type.kind = DataKind::List;
  type.item = &data_type<Item>();
  type.wire_size = sizeof(std::uint64_t);
  type.items = [](const void* value) { return static_cast<const T*>(value)->size(); };
  type.first = [](const void* value) -> const void* {
    return static_cast<const T*>(value)->data();
  };
  type.resize = [](void* value, std::size_t count) { static_cast<T*>(value)->resize(count); };
}

template <class T>
void describe_optional(DataType& type) {
  type.kind = DataKind::Optional;
  type.item = &data_type<typename T::value_type>();
  type.wire_size = 1;
  type.items = [](const void* value) {
    return std::size_t{static_cast<const T*>(value)->has_value() ? 1u : 0u};
  };
  type.first = [](const void* value) -> const void* { return &**static_cast<const T*>(value); };
  type.resize = [](void* value, std::size_t count) {
    T& one = *static_cast<T*>(value);
    one.reset();
    if (count != 0) {
      one.emplace();
    }
  };
}

template <class T>
void describe_pair(DataType& type) {
  static const T kPair{};
  type.kind = DataKind::Pair;
  type.item = &data_type<typename T::first_type>();
  type.second = &data_type<typename T::second_type>();
  type.second_offset = static_cast<std::size_t>(reinterpret_cast<const char*>(&kPair.second) -
                                                reinterpret_cast<const char*>(&kPair));
  type.wire_size = type.item->wire_size + type.second->wire_size;
}

inline void describe_pose(DataType& type) {
  type.kind = DataKind::Pose;
  type.item = &data_type<Vec3d>();
  type.second = &data_type<Quatd>();
  type.second_offset = offsetof(Pose, orientation);
  type.is_flat = true;
  type.wire_size = sizeof(Pose);
}

// Never inlined: there are 900 fields.
[[gnu::noinline]] inline void add_data_field(DataType& type, const FieldInfo* info,
                                             const DataType& field, const void* member) {
  const auto offset = static_cast<const char*>(member) - static_cast<const char*>(type.plain);
  type.fields.push_back({info, &field, static_cast<std::size_t>(offset)});
}

template <class T, auto... Members>
void add_data_fields(const Rows<Members...>& rows, const T& plain, DataType& type) {
  const FieldInfo* info = rows.infos;
  const auto add = [&]<class Member>(const Member& member) {
    add_data_field(type, info++, data_type<Member>(), &member);
  };
  (add(plain.*Members), ...);
}

template <class T>
void describe_struct(DataType& type) {
  static_assert(is_complete<T>(), "a member has no row in its table");
  static const T kPlain{};
  type.kind = DataKind::Struct;
  type.word = Table<T>::kWord;
  type.plain = &kPlain;
  type.fields.reserve(kFieldCount<T>);
  add_data_fields(Table<T>::kFields, kPlain, type);
  type.is_flat = std::is_trivially_copyable_v<T>;
  for (const DataField& field : type.fields) {
    type.wire_size += field.type->wire_size;
    type.is_flat = type.is_flat && field.type->is_flat;
  }
  type.is_flat = type.is_flat && type.wire_size == sizeof(T);
}

template <class T>
void describe_words(DataType& type) {
  static_assert(sizeof(T) == sizeof(std::underlying_type_t<T>));
  type.kind = DataKind::Word;
  type.words = EnumNames<T>::kNames;
  type.wire_size = sizeof(T);
}

template <class T>
DataType make_data_type() {
  DataType type;
  type.id = &kDataId<T>;
  type.size = sizeof(T);
  if constexpr (!wire::kIsOptional<T> && !wire::kIsPair<T> && !wire::kIsVector<T> && !HasTable<T>) {
    type.assign = [](void* to, const void* from) {
      *static_cast<T*>(to) = *static_cast<const T*>(from);
    };
  }
  if constexpr (std::is_same_v<T, bool>) {
    type.kind = DataKind::Flag;
    type.wire_size = 1;
  } else if constexpr (std::is_arithmetic_v<T>) {
    describe_number<T>(type);
  } else if constexpr (std::is_enum_v<T>) {
    describe_words<T>(type);
  } else if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, Path>) {
    type.kind = std::is_same_v<T, Path> ? DataKind::Path : DataKind::Text;
    type.wire_size = sizeof(std::uint64_t);
  } else if constexpr (std::is_same_v<T, Quatd>) {
    type.kind = DataKind::Rotation;
    type.is_flat = true;
    type.wire_size = sizeof(T);
  } else if constexpr (std::is_same_v<T, Pose>) {
    describe_pose(type);
  } else if constexpr (RowOfNumbers<T>::value) {
    describe_numbers<T>(type);
  } else if constexpr (wire::kIsOptional<T>) {
    describe_optional<T>(type);
  } else if constexpr (wire::kIsPair<T>) {
    describe_pair<T>(type);
  } else if constexpr (wire::kIsVector<T>) {
    describe_list<T>(type);
  } else {
    static_assert(HasTable<T>, "a field of a type without a table");
    describe_struct<T>(type);
  }
  return type;
}

// Never inlined, so that who names the scene has those of all that is in it for others to link to.
template <class T>
[[gnu::noinline]] const DataType& data_type() {
  static const DataType kType = make_data_type<T>();
  return kType;
}

}  // namespace tenon::scene
