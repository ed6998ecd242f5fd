// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A value that 32 bits can hold without loss is its own word. Any other is encoded aside and placed
// in the file, unless the same bytes are there already at a fitting alignment. What a value
// contains is placed before it, so its own bytes are only numbers, indices and words. Equal values
// thus have equal bytes, and the parts of nested ones are shared too. The distance that the format
// keeps in front of such words is always the same, for they come next. The version that a file
// needs rises with the types that are written.
#include "tenon/formats/crate/value_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "tenon/formats/crate/array_writer.h"
#include "tenon/formats/crate/spline_codec.h"
#include "tenon/formats/crate/storage_form.h"
#include "tenon/layer/fields.h"

namespace tenon::formats::crate {
namespace {

using layer::Value;
using layer::ValueType;

constexpr std::int64_t kNoDistance = 8;  // the word of an inner value stands right behind

bool is_token_list(Token field) {
  using namespace layer::fields;  // NOLINT(google-build-using-namespace): a list of its names
  static const Token names[] = {primChildren,
                                properties,
                                variantSetChildren,
                                variantChildren,
                                primOrder,
                                propertyOrder,
                                connectionChildren,
                                targetChildren,
                                Token("mapperChildren"),
                                Token("mapperArgChildren"),
                                Token("expressionChildren")};
  return std::find(std::begin(names), std::end(names), field) != std::end(names);
}

/// A whole number from -128 to 127 without a negative zero.
template <class T>
std::optional<std::uint8_t> as_byte(T value) {
  const auto number = static_cast<double>(value);
  if (!(number >= -128 && number <= 127) || std::signbit(number) != (number < 0)) {
    return std::nullopt;
  }
  const auto byte = static_cast<std::int8_t>(number);
  return static_cast<double>(byte) == number ? std::optional(static_cast<std::uint8_t>(byte))
                                             : std::nullopt;
}

template <class T>
std::optional<std::uint32_t> vector_bits(const T& vector) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < VectorTraits<T>::size; ++i) {
    const auto byte = as_byte(vector[i]);
    if (!byte) {
      return std::nullopt;
    }
    bits |= std::uint32_t{*byte} << (8 * i);
  }
  return bits;
}

template <class T>
std::optional<std::uint32_t> matrix_bits(const T& matrix) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < MatrixTraits<T>::size; ++i) {
    for (std::size_t j = 0; j < MatrixTraits<T>::size; ++j) {
      const auto byte = as_byte(matrix[i][j]);
      if (!byte || (i != j && *byte != 0)) {
        return std::nullopt;
      }
      if (i == j) {
        bits |= std::uint32_t{*byte} << (8 * i);
      }
    }
  }
  return bits;
}

std::uint32_t float_bits(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

/// The 32 bits that hold the whole value, where they can.
template <class T>
std::optional<std::uint32_t> inline_bits(const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    const bool exact =
        std::abs(value) <= kLargest && static_cast<double>(static_cast<float>(value)) == value;
    return exact ? std::optional(float_bits(static_cast<float>(value))) : std::nullopt;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    const bool fits = value >= std::numeric_limits<std::int32_t>::min() &&
                      value <= std::numeric_limits<std::int32_t>::max();
    return fits ? std::optional(static_cast<std::uint32_t>(value)) : std::nullopt;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    const bool fits = value <= std::numeric_limits<std::uint32_t>::max();
    return fits ? std::optional(static_cast<std::uint32_t>(value)) : std::nullopt;
  } else if constexpr (VectorTraits<T>::size != 0) {
    return vector_bits(value);
  } else if constexpr (MatrixTraits<T>::size != 0) {
    return matrix_bits(value);
  } else if constexpr (std::is_same_v<T, layer::Dictionary>) {
    return value.empty() ? std::optional(0u) : std::nullopt;
  } else {
    return std::nullopt;
  }
}

}  // namespace

template <class T>
Result<void> ValueWriter::item(bytes::ByteWriter& to, const T& value) {
  if constexpr (kIsPlain<T>) {
    to.write(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    to.write(tables_.string(value));
  } else if constexpr (std::is_same_v<T, Token>) {
    to.write(tables_.token(value));
  } else if constexpr (std::is_same_v<T, Path>) {
    if (!value.empty() && !value.is_absolute()) {
      return Error(ErrorCode::Invalid, "the relative path " + value.str() + " cannot be stored")
          .with_rule("crate.relative-path");
    }
    to.write(tables_.path(value));
  } else if constexpr (std::is_same_v<T, layer::TimeCode>) {
    need(kTimeCodes);
    to.write(value.value);
  } else if constexpr (std::is_same_v<T, layer::Duration>) {
    need(kDurations);
    to.write(value.value);
  } else if constexpr (std::is_same_v<T, layer::PathExpression>) {
    need(kPathExpressions);
    to.write(tables_.string(value.text));
  } else if constexpr (std::is_same_v<T, layer::LayerOffset>) {
    to.write(value.offset);
    to.write(value.scale);
  } else if constexpr (std::is_same_v<T, layer::Reference>) {
    TENON_CHECK(item(to, value.asset_path));
    TENON_CHECK(item(to, value.prim_path));
    TENON_CHECK(item(to, value.offset));
    return item(to, value.custom_data);
  } else if constexpr (std::is_same_v<T, layer::Payload>) {
    TENON_CHECK(item(to, value.asset_path));
    TENON_CHECK(item(to, value.prim_path));
    return item(to, value.offset);
  } else if constexpr (std::is_same_v<T, layer::UnregisteredValue>) {
    return item(to, value.value);
  } else if constexpr (std::is_same_v<T, Value>) {
    TENON_TRY(const ValueWord word, write(value));
    to.write(kNoDistance);
    to.write(word);
  } else if constexpr (std::is_same_v<T, layer::Dictionary> ||
                       std::is_same_v<T, layer::VariantSelections>) {
    to.write(std::uint64_t{value.items.size()});
    for (const auto& entry : value.items) {
      TENON_CHECK(item(to, entry.first));
      TENON_CHECK(item(to, entry.second));
    }
  } else if constexpr (std::is_same_v<T, layer::Relocates>) {
    need(kRelocates);
    return item(to, value.pairs);
  } else if constexpr (std::is_same_v<T, layer::TimeSamples>) {
    return samples(to, value);
  } else {
    static_assert(std::is_same_v<T, layer::Spline>);
    return curve(to, value);
  }
  return {};
}

Result<void> ValueWriter::samples(bytes::ByteWriter& to, const layer::TimeSamples& samples) {
  TENON_TRY(const ValueWord times, stored(kDoubleVector, samples.times));
  std::vector<ValueWord> words;
  for (const Value& sample : samples.values) {
    TENON_TRY(const ValueWord word, write(sample));
    words.push_back(word);
  }
  to.write(kNoDistance);
  to.write(times);
  to.write(kNoDistance);
  to.write(std::uint64_t{words.size()});
  to.write_array(std::span<const ValueWord>(words));
  return {};
}

Result<void> ValueWriter::curve(bytes::ByteWriter& to, const layer::Spline& spline) {
  const EncodedSpline encoded = encode_spline(spline);
  need(encoded.needed);
  to.write(std::uint64_t{encoded.bytes.size()});
  to.write_text(encoded.bytes);
  std::vector<std::pair<double, layer::Dictionary>> custom_data;
  for (const layer::SplineKnot& knot : spline.knots) {
    if (!knot.custom_data.empty()) {
      custom_data.emplace_back(knot.time, knot.custom_data);
    }
  }
  return item(to, custom_data);
}

template <class T>
Result<void> ValueWriter::item(bytes::ByteWriter& to, const std::vector<T>& values) {
  to.write(std::uint64_t{values.size()});
  for (const T& value : values) {
    TENON_CHECK(item(to, value));
  }
  return {};
}

template <class A, class B>
Result<void> ValueWriter::item(bytes::ByteWriter& to, const std::pair<A, B>& pair) {
  TENON_CHECK(item(to, pair.first));
  return item(to, pair.second);
}

template <class T>
Result<void> ValueWriter::item(bytes::ByteWriter& to, const layer::ListOp<T>& edit) {
  const std::pair<std::uint8_t, const std::vector<T>*> lists[] = {
      {list_bits::kExplicitItems, &edit.explicit_items},
      {list_bits::kAdded, &edit.added},
      {list_bits::kPrepended, &edit.prepended},
      {list_bits::kAppended, &edit.appended},
      {list_bits::kDeleted, &edit.deleted},
      {list_bits::kOrdered, &edit.ordered},
  };
  std::uint8_t bits = edit.is_explicit ? list_bits::kExplicit : std::uint8_t{0};
  for (const auto& [bit, list] : lists) {
    bits = static_cast<std::uint8_t>(bits | (list->empty() ? 0u : bit));
  }
  to.write(bits);
  for (const auto& [bit, list] : lists) {
    if (!list->empty()) {
      TENON_CHECK(item(to, *list));
    }
  }
  return {};
}

std::uint64_t ValueWriter::place(std::string_view data, std::size_t alignment) {
  const std::string_view before = out_.bytes();
  const std::uint32_t known = placed_index_.find_or_add(
      RowHash().with(std::hash<std::string_view>{}(data)),
      static_cast<std::uint32_t>(placed_.size()), [&](std::uint32_t number) {
        const Placed& placed = placed_[number];
        return placed.size == data.size() && placed.offset % alignment == 0 &&
               before.substr(static_cast<std::size_t>(placed.offset), placed.size) == data;
      });
  if (known != RowIndex::kNone) {
    return placed_[known].offset;
  }
  const std::uint64_t offset = out_.align(alignment);
  out_.write_text(data);
  placed_.push_back({offset, data.size()});
  return offset;
}

template <class T>
Result<ValueWord> ValueWriter::stored(unsigned type, const T& value) {
  bytes::ByteWriter data;
  TENON_CHECK(item(data, value));
  return ValueWord::make(type, 0, place(data.bytes(), 1));
}

template <class T>
Result<ValueWord> ValueWriter::single(unsigned type, const T& value) {
  if constexpr (std::is_same_v<T, layer::Opaque>) {
    return Error(ErrorCode::Invalid, "an opaque attribute cannot have a value");
  } else if constexpr (std::is_same_v<T, layer::ArrayEdit>) {
    return array_edit(value);
  } else if constexpr (kIsEmpty<T>) {
    return ValueWord::make(type, ValueWord::kInlined, 0);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return ValueWord::make(type, ValueWord::kInlined, tables_.string(value));
  } else if constexpr (std::is_same_v<T, Token>) {
    return ValueWord::make(type, ValueWord::kInlined, tables_.token(value));
  } else if constexpr (std::is_same_v<T, layer::AssetPath>) {
    return ValueWord::make(type, ValueWord::kInlined, tables_.token(Token(value.authored)));
  } else if constexpr (kAlwaysInlined<T>) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof(value));
    return ValueWord::make(type, ValueWord::kInlined, bits);
  } else {
    if (const auto bits = inline_bits(value)) {
      return ValueWord::make(type, ValueWord::kInlined, *bits);
    }
    return stored(type, value);
  }
}

template <class T>
ValueWord ValueWriter::array(unsigned type, const layer::Array<T>& array) {
  if constexpr (std::is_same_v<T, layer::Duration>) {
    need(kDurations);
  }
  if (array.empty()) {
    return ValueWord::make(type, ValueWord::kArray, 0);
  }
  if constexpr (std::is_same_v<T, layer::TimeCode>) {
    need(kTimeCodes);
  }
  if constexpr (std::is_same_v<T, layer::PathExpression>) {
    need(kPathExpressions);
  }
  const EncodedArray encoded = encode_array<T>(array, tables_);
  constexpr std::size_t kAlignment = 8;  // so that readers can use the mapped bytes
  const std::uint64_t flags = ValueWord::kArray | (encoded.packed ? ValueWord::kPacked : 0);
  return ValueWord::make(type, flags, place(encoded.bytes, kAlignment));
}

/// As array_edit of value_reader.cpp reads it.
ValueWord ValueWriter::array_edit(const layer::ArrayEdit& edit) {
  using namespace layer;  // NOLINT(google-build-using-namespace): the table names its types
  need(kArrayEdits);
  ValueWord literals;
  switch (edit.literals.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id)                   \
  case ValueType::enumerator:                                            \
    literals = array<type>(crate_id, *edit.literals.get<Array<type>>()); \
    break;
#include "tenon/layer/value_types.def"
    default:
      break;
  }
  if (edit.instructions.empty()) {
    return ValueWord::make(literals.type(), ValueWord::kArrayEdit, 0);
  }
  constexpr unsigned kInt64 = 5;
  bytes::ByteWriter data;
  data.write(literals);
  data.write(array<std::int64_t>(kInt64, edit.instructions));
  data.write(std::uint8_t{0});
  return ValueWord::make(literals.type(), ValueWord::kArrayEdit, place(data.bytes(), 1));
}

Result<ValueWord> ValueWriter::write(const Value& given) {
  using namespace layer;  // NOLINT(google-build-using-namespace): the table names its types
  if (given.is_deferred()) {
    TENON_TRY(const Value value, given.decoded());
    return write(value);
  }
  const Value& value = given;
  switch (value.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id)                         \
  case ValueType::enumerator:                                                  \
    return value.is_array() ? array<type>(crate_id, *value.get<Array<type>>()) \
                            : single<type>(crate_id, *value.get<type>());
#define TENON_FIELD(enumerator, type, crate_id) \
  case ValueType::enumerator:                   \
    return single<type>(crate_id, *value.get<type>());
#include "tenon/layer/value_types.def"
    case ValueType::None:
      break;
  }
  return single<ValueBlock>(51, ValueBlock());  // a sample that could not be read
}

Result<ValueWord> ValueWriter::write(Token field, const Value& value) {
  if (const auto* tokens = value.get<layer::Array<Token>>();
      tokens != nullptr && is_token_list(field)) {
    return stored(kTokenVector, *tokens);
  }
  if (const auto* strings = value.get<layer::Array<std::string>>();
      strings != nullptr && field == layer::fields::subLayers) {
    return stored(kStringVector, *strings);
  }
  return write(value);
}

}  // namespace tenon::formats::crate
