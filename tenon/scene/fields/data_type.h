// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/scene/fields/field.h"

/// The tables of fields as data: what each field is made of and where it lies, so that a walk over
/// all of them is compiled once and not for each struct. Made from the tables by make_data_type.h;
/// the walks of tenon/scene and tenon/answers see values by it.
namespace tenon::scene {

enum class DataKind : std::uint8_t {
  Flag,
  Ordinal,  ///< scene::Index: into a list of the scene, or a plain number (FieldInfo::refers)
  Word,     ///< an enumerator
  Integer,  ///< others
  Real,     ///< double
  Text,
  Path,
  Numbers,   ///< a fixed count in a row: arrays, vectors, matrices by rows
  Rotation,  ///< Quatd
  Pose,
  Optional,
  Pair,
  List,
  Struct,  ///< has a table
};

template <class T>
inline constexpr char kDataId = 0;

struct DataType;

/// A field of a struct.
struct DataField {
  const FieldInfo* info;
  const DataType* type;
  std::size_t offset;  ///< in the struct [bytes]
};

struct DataType {
  DataKind kind = DataKind::Flag;
  const void* id = nullptr;   ///< other for each C++ type; see is_a
  std::size_t size = 0;       ///< of a value in memory [bytes]
  std::size_t wire_size = 0;  ///< of the shortest value in bytes for others (tenon/base/wire.h)
  bool is_flat = false;       ///< numbers without gaps: those bytes are as they lie in memory
  bool is_signed = false;     ///< of an Integer
  std::size_t count = 0;      ///< of Numbers
  /// Of Numbers, an Optional, a List; the first of a Pair, the position of a Pose.
  const DataType* item = nullptr;
  const DataType* second = nullptr;         ///< of a Pair; the rotation of a Pose
  std::size_t second_offset = 0;            ///< of a Pair or a Pose [bytes]
  std::span<const std::string_view> words;  ///< of a Word, by enumerator

  std::string_view word;          ///< of a Struct: what one is called
  std::vector<DataField> fields;  ///< of a Struct, in the order of its table
  const void* plain = nullptr;    ///< of a Struct: a new one

  /// How many an Optional (0 or 1), a List or Numbers have.
  std::size_t (*items)(const void* value) = nullptr;
  const void* (*first)(const void* value) = nullptr;  ///< the first of them, where there is one
  /// Leaves that many, new ones made.
  void (*resize)(void* value, std::size_t count) = nullptr;
  /// Of one that is not made of others: all but an Optional, a Pair, a List and a Struct.
  void (*assign)(void* to, const void* from) = nullptr;

  template <class T>
  bool is_a() const {
    return id == &kDataId<T>;
  }
};

/// The type of a C++ type that fields of the scene have, as deep as they lie, or the scene itself.
template <class T>
const DataType& data_type();

/// A value that is read; of its type nothing is known when it is compiled.
struct DataView {
  const DataType* type;
  const void* at;

  DataKind kind() const { return type->kind; }
  template <class T>
  bool is_a() const {
    return type->is_a<T>();
  }
  /// The value itself; only after a look at its kind or type.
  template <class T>
  const T& as() const {
    return *static_cast<const T*>(at);
  }
  /// nullptr where it is of another type.
  template <class T>
  const T* get_if() const {
    return is_a<T>() ? static_cast<const T*>(at) : nullptr;
  }

  /// Of an Optional (0 or 1), a List or Numbers.
  std::size_t size() const { return type->items(at); }
  DataView operator[](std::size_t i) const {
    return {type->item, static_cast<const char*>(type->first(at)) + i * type->item->size};
  }
  DataView first() const { return {type->item, at}; }  ///< of a Pair or a Pose
  DataView second() const {
    return {type->second, static_cast<const char*>(at) + type->second_offset};
  }
  DataView member(const DataField& field) const {
    return {field.type, static_cast<const char*>(at) + field.offset};
  }
};

/// A value that may be changed.
struct DataRef {
  const DataType* type;
  void* at;

  operator DataView() const { return {type, at}; }  // NOLINT: what may be changed can be read
  DataKind kind() const { return type->kind; }
  template <class T>
  T& as() const {
    return *static_cast<T*>(at);
  }
  template <class T>
  T* get_if() const {
    return type->is_a<T>() ? static_cast<T*>(at) : nullptr;
  }
  std::size_t size() const { return type->items(at); }
  DataRef operator[](std::size_t i) const {
    void* const first = const_cast<void*>(type->first(at));  // of what may be changed
    return {type->item, static_cast<char*>(first) + i * type->item->size};
  }
  DataRef first() const { return {type->item, at}; }
  DataRef second() const { return {type->second, static_cast<char*>(at) + type->second_offset}; }
  DataRef member(const DataField& field) const {
    return {field.type, static_cast<char*>(at) + field.offset};
  }
  /// Of an Optional or a List.
  void resize(std::size_t count) const { type->resize(at, count); }
  /// Of two values of one type.
  void assign(DataView from) const;  ///< a value of the same type
};

template <class T>
DataView view_of(const T& value) {
  return {&data_type<T>(), &value};
}
template <class T>
DataRef ref_to(T& value) {
  return {&data_type<T>(), &value};
}

/// The field of a struct with this name; nullptr where it has none.
const DataField* find_field(const DataType& type, std::string_view name);

/// The path of an object; nullptr of structs without one.
const Path* path_of(DataView object);

/// A list of structs.
inline bool is_struct_list(const DataType& type) {
  return type.kind == DataKind::List && type.item->kind == DataKind::Struct;
}

/// Numbers and nothing else: no flags, words or paths in them.
bool has_numbers(const DataType& type);

/// Of a Real, an Integer or an Ordinal.
double number_of(DataView value);

/// Into a Real, an Integer or an Ordinal; whole and in its range where it is no Real.
void set_number(DataRef to, double value);

/// The numbers that an Integer or an Ordinal can hold.
struct IntegerRange {
  double lowest;
  double highest;
};
IntegerRange integer_range(const DataType& type);

/// Into an Integer, an Ordinal or a Word; in its range.
void set_integer(DataRef to, std::int64_t value);

/// An enumerator's number, and its word.
std::size_t enumerator_of(DataView word);
inline std::string_view word_of(DataView word) { return word.type->words[enumerator_of(word)]; }

}  // namespace tenon::scene
