// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Arrays lie as a count and then their elements, or packed: integers delta-coded, floating-point
// numbers as integers ('i') or as a table of the distinct ones with indices into it ('t').
#include "tenon/formats/crate/array_reader.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>

#include "tenon/base/limits/crate_limits.h"
#include "tenon/base/limits/limits.h"
#include "tenon/bytes/integer_coding.h"
#include "tenon/formats/crate/storage_form.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/number_arrays.h"

namespace tenon::formats::crate {
namespace {

using layer::NumberArrays;
using layer::Value;
using layer::ValueType;

constexpr std::uint64_t kSmallArray = 96;  // bytes; decoded at once, cheaper than remembering

/// Where the elements are and how many.
struct ArrayHeader {
  std::uint64_t offset = 0;  ///< of the elements
  std::uint64_t count = 0;
  bool packed = false;
};

/// How the elements of a type lie; what follows from it alone is not compiled for each type.
struct Storage {
  bool is_integer = false;
  bool is_real = false;
  std::uint64_t size = 0;    ///< of an element in memory
  std::uint64_t stride = 0;  ///< of one in the file, where they are not packed
  std::uint64_t alignment = 0;
  bool is_number = false;  ///< lies in the file as in memory, where it is not packed
};

template <class T>
constexpr Storage kStorage{kIsInteger<T>, kIsReal<T>,
                           sizeof(T),     kIsText<T> ? sizeof(std::uint32_t) : sizeof(T),
                           alignof(T),    layer::kIsNumberArray<T>};

bool is_packed(const Storage& storage, const Version& version, ValueWord word) {
  const bool known = (storage.is_integer && version >= kPackedIntegers) ||
                     (storage.is_real && version >= kPackedFloats);
  return known && word.is_packed();
}

/// The fewest bytes that so many elements can take.
Result<void> check_room(const Storage& storage, bytes::ByteReader in, const ArrayHeader& header) {
  if (!header.packed) {
    return header.count <= in.remaining() / storage.stride
               ? Result<void>()
               : bytes::out_of_bounds(header.offset, header.count, in.size());
  }
  if (storage.is_real) {
    TENON_TRY(const char code, in.read<char>());
    if (code == 't') {
      TENON_TRY(const std::uint32_t distinct, in.read<std::uint32_t>());
      TENON_CHECK(in.take(std::uint64_t{distinct} * storage.size));
    } else if (code != 'i') {
      return corrupt("an array is packed in an unknown way");
    }
  }
  TENON_TRY(const std::uint64_t size, in.read<std::uint64_t>());
  TENON_CHECK(in.take(size));
  return header.count <= bytes::max_integer_count(size)
             ? Result<void>()
             : corrupt("an array claims more elements than its bytes can hold");
}

Result<ArrayHeader> read_header(const Storage& storage, const CrateFile& file, ValueWord word) {
  bytes::ByteReader in = file.reader();
  TENON_CHECK(in.seek(word.payload()));
  if (file.version < kPackedIntegers) {
    TENON_CHECK(in.read<std::uint32_t>());  // the rank, always 1
  }
  ArrayHeader header;
  if (file.version < kWideCounts) {
    TENON_TRY(header.count, in.read<std::uint32_t>());
  } else {
    TENON_TRY(header.count, in.read<std::uint64_t>());
  }
  header.offset = in.offset();
  header.packed = is_packed(storage, file.version, word) && header.count >= kSmallestPacked;
  TENON_CHECK(check_room(storage, in, header));
  return header;
}

template <class T>
Result<std::vector<T>> decode_integers(bytes::ByteReader& in, std::size_t count) {
  TENON_TRY(auto integers, open_packed<T>(in, count));
  std::vector<T> array(count);
  integers.read(array);
  return array;
}

/// Whole numbers that are kept as integers.
template <class T>
Result<std::vector<T>> decode_whole(bytes::ByteReader& in, std::size_t count) {
  TENON_TRY(auto integers, open_packed<std::int32_t>(in, count));
  std::vector<T> array;
  array.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    array.push_back(static_cast<T>(static_cast<double>(integers.next())));
  }
  return array;
}

/// Indices into a table of those that differ.
template <class T>
Result<std::vector<T>> decode_by_table(bytes::ByteReader& in, std::size_t count) {
  TENON_TRY(const std::uint32_t distinct, in.read<std::uint32_t>());
  TENON_TRY(const std::vector<T> table, in.read_array<T>(distinct));
  TENON_TRY(auto indices, open_packed<std::uint32_t>(in, count));
  std::vector<T> array;
  array.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t index = indices.next();
    if (index >= table.size()) {
      return corrupt("an array names an element that is not in its table");
    }
    array.push_back(table[index]);
  }
  return array;
}

template <class T>
Result<std::vector<T>> decode_packed(bytes::ByteReader& in, std::uint64_t count) {
  const auto size = static_cast<std::size_t>(count);
  if constexpr (kIsInteger<T>) {
    return decode_integers<T>(in, size);
  } else {
    TENON_TRY(const char code, in.read<char>());
    return code == 'i' ? decode_whole<T>(in, size) : decode_by_table<T>(in, size);
  }
}

/// Takes `size` bytes off what the arrays of the file may unpack to.
Result<void> unpack(const CrateFile& file, std::uint64_t size) {
  const std::uint64_t most =
      limits::kCrateArrays + file.bytes->size() * limits::kCrateArraysPerByte;
  const std::uint64_t before = file.unpacked.fetch_add(size, std::memory_order_relaxed);
  if (before + size > most) {
    file.unpacked.fetch_sub(size, std::memory_order_relaxed);
    return Error(ErrorCode::Limit,
                 "the arrays of the file unpack to more than " + std::to_string(most >> 20) + " MB")
        .with_rule("crate.too-much")
        .with_fix("save the file as text, or in several files");
  }
  return {};
}

template <class T>
Result<std::vector<T>> decode_texts(const CrateFile& file, bytes::ByteReader& in,
                                    std::uint64_t count) {
  TENON_TRY(const std::vector<std::uint32_t> indices, in.read_array<std::uint32_t>(count));
  std::vector<T> array;
  array.reserve(indices.size());
  for (const std::uint32_t index : indices) {
    if constexpr (std::is_same_v<T, Token>) {
      TENON_TRY(const Token token, token_at(file, index));
      array.push_back(token);
    } else {
      TENON_TRY(const std::string_view text, string_at(file, index));
      TENON_CHECK(unpack(file, text.size()));
      array.emplace_back();
      if constexpr (std::is_same_v<T, std::string>) {
        array.back() = text;
      } else if constexpr (std::is_same_v<T, layer::AssetPath>) {
        array.back().authored = text;
      } else {
        array.back().text = text;
      }
    }
  }
  return array;
}

Result<Value> decode_bools(bytes::ByteReader& in, std::uint64_t count) {
  TENON_TRY(std::vector<char> array, in.read_array<char>(count));
  for (char& element : array) {
    element = element != 0 ? 1 : 0;
  }
  return Value(std::move(array));
}

/// Bools, texts and numbers that are packed.
template <class T>
Result<Value> decode(const CrateFile& file, bytes::ByteReader& in, std::uint64_t count) {
  if constexpr (kIsText<T>) {
    TENON_TRY(std::vector<T> array, decode_texts<T>(file, in, count));
    return Value(std::move(array));
  } else if constexpr (std::is_same_v<T, bool>) {
    return decode_bools(in, count);
  } else {
    TENON_TRY(std::vector<T> array, decode_packed<T>(in, count));
    return Value(std::move(array));
  }
}

/// All that reading arrays of a type needs to know of it.
struct ElementType {
  ValueType type = ValueType::None;
  Storage storage;
  /// What decodes elements that do not lie as in memory; nullptr where all do.
  Result<Value> (*decode)(const CrateFile& file, bytes::ByteReader& in,
                          std::uint64_t count) = nullptr;
};

template <class T>
constexpr ElementType element_type() {
  ElementType element{layer::ValueTraits<T>::type, kStorage<T>};
  if constexpr (kIsInteger<T> || kIsReal<T> || !layer::kIsNumberArray<T>) {
    element.decode = &decode<T>;
  }
  return element;
}
template <class T>
constexpr ElementType kElement = element_type<T>();

bool lies_as_in_memory(const ElementType& element, const ArrayHeader& header) {
  return element.storage.is_number && !header.packed;
}

Result<Value> decoded(const CrateFile& file, const ElementType& element,
                      const ArrayHeader& header) {
  bytes::ByteReader in = file.reader();
  TENON_CHECK(in.seek(header.offset));
  if (!lies_as_in_memory(element, header)) {
    return element.decode(file, in, header.count);
  }
  TENON_TRY(const auto elements, in.take(header.count * element.storage.size));
  return NumberArrays::make(element.type, elements);
}

/// The elements as they lie in the file, where they are stored as in memory and aligned; else
/// nothing.
std::optional<Value> borrowed(const CrateFile& file, const ElementType& element,
                              const ArrayHeader& header) {
  const std::byte* const at = file.bytes->span().data() + header.offset;
  if (!lies_as_in_memory(element, header) ||
      reinterpret_cast<std::uintptr_t>(at) % element.storage.alignment != 0) {
    return std::nullopt;
  }
  const std::span elements(at, static_cast<std::size_t>(header.count * element.storage.size));
  return NumberArrays::borrow(element.type, elements, file.bytes);
}

class CrateArray final : public layer::DeferredArray {
 public:
  CrateArray(std::shared_ptr<const CrateFile> file, const ElementType& element,
             const ArrayHeader& header)
      : file_(std::move(file)), element_(element), header_(header) {}
  std::size_t size() const override { return static_cast<std::size_t>(header_.count); }
  Result<Value> decode() const override {
    TENON_CHECK(unpack(*file_, header_.count * element_.storage.size));
    return decoded(*file_, element_, header_);
  }

 private:
  std::shared_ptr<const CrateFile> file_;
  const ElementType& element_;
  ArrayHeader header_;
};

Result<Value> read_array_of(const ElementType& element,
                            const std::shared_ptr<const CrateFile>& file, ValueWord word,
                            WorkBudget& budget) {
  if (word.payload() == 0) {
    return layer::make_array(element.type, {});
  }
  TENON_TRY(const ArrayHeader header, read_header(element.storage, *file, word));
  TENON_CHECK(budget.spend(1));
  if (!header.packed && header.count <= kSmallArray / element.storage.size) {
    return decoded(*file, element, header);
  }
  if (std::optional<Value> array = borrowed(*file, element, header)) {
    return *std::move(array);
  }
  return Value::deferred(element.type, std::make_unique<CrateArray>(file, element, header));
}

}  // namespace

Result<Token> token_at(const CrateFile& file, std::uint32_t index) {
  if (index >= file.tokens.size()) {
    return corrupt("a value names a token that is not there");
  }
  return file.tokens[index];
}

Result<std::string_view> string_at(const CrateFile& file, std::uint32_t index) {
  if (index >= file.strings.size()) {
    return corrupt("a value names a string that is not there");
  }
  return file.tokens[file.strings[index]].view();
}

Result<Value> read_array(const std::shared_ptr<const CrateFile>& file, ValueType element,
                         ValueWord word, WorkBudget& budget) {
  using namespace layer;  // NOLINT(google-build-using-namespace): the table names its types
  switch (element) {
#define TENON_SCALAR(enumerator, type, name, crate_id) \
  case ValueType::enumerator:                          \
    return read_array_of(kElement<type>, file, word, budget);
#include "tenon/layer/value_types.def"
    default:
      return corrupt("a value of a type that has no arrays claims to be one");
  }
}

}  // namespace tenon::formats::crate
