// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Which values are their own word: all of at most four bytes, strings, tokens and asset paths (by
// index); a double that is a float, a 64-bit integer that fits 32, a vector of small whole numbers,
// a matrix that is zero except for a diagonal of such, an empty dictionary. Others are at an
// offset.
#include "tenon/formats/crate/value_reader.h"

#include <cstring>
#include <type_traits>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/crate/storage_form.h"

namespace tenon::formats::crate {
namespace {

using layer::Value;
using layer::ValueType;

template <class T>
T small_vector(std::uint32_t bits) {
  T vector;
  for (std::size_t i = 0; i < VectorTraits<T>::size; ++i) {
    const auto number = static_cast<std::int8_t>(bits >> (8 * i));
    vector[i] = static_cast<typename VectorTraits<T>::Element>(static_cast<float>(number));
  }
  return vector;
}

template <class T>
T small_matrix(std::uint32_t bits) {
  T matrix;
  for (std::size_t i = 0; i < MatrixTraits<T>::size; ++i) {
    matrix[i][i] = static_cast<std::int8_t>(bits >> (8 * i));
  }
  return matrix;
}

template <class T>
Result<T> enumerator(std::uint32_t bits) {
  constexpr bool kVariability = std::is_same_v<T, layer::Variability>;
  if (kVariability && bits == 2) {
    return static_cast<T>(1);  // "config" of long ago, read as uniform
  }
  constexpr std::uint32_t kCount = std::is_same_v<T, layer::Specifier> ? 3 : 2;
  if (bits >= kCount) {
    return corrupt("a specifier, permission or variability of number " + std::to_string(bits));
  }
  return static_cast<T>(bits);
}

}  // namespace

/// Values of one long text share it.
Result<Value> ValueReader::text(std::uint32_t index) {
  TENON_TRY(const std::string_view text, string_at(file_, index));
  if (text.size() <= limits::kCrateBytesPerUnit) {
    TENON_CHECK(budget_.spend(1));
    return Value(std::string(text));
  }
  layer::Value& known = texts_[index];
  if (known.empty()) {
    known = Value(std::string(text));
  }
  return known;
}

template <class T>
Result<Value> ValueReader::inlined(std::uint32_t bits) {
  if constexpr (std::is_same_v<T, bool>) {
    return Value((bits & 0xffu) != 0);
  } else if constexpr (kIsEmpty<T>) {
    return Value(T());
  } else if constexpr (std::is_enum_v<T>) {
    TENON_TRY(const T value, enumerator<T>(bits));
    return Value(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return text(bits);
  } else if constexpr (std::is_same_v<T, Token>) {
    TENON_TRY(const Token token, token_at(file_, bits));
    return Value(token);
  } else if constexpr (std::is_same_v<T, layer::AssetPath>) {
    TENON_TRY(const Token token, token_at(file_, bits));
    TENON_CHECK(items_.pay_for_text(bits, token.str().size()));
    return Value(layer::AssetPath{token.str(), "", ""});
  } else if constexpr (sizeof(T) <= 4) {
    T value;
    std::memcpy(static_cast<void*>(&value), &bits, sizeof(T));
    return Value(value);
  } else if constexpr (std::is_same_v<T, double>) {
    float value = 0;
    std::memcpy(&value, &bits, sizeof(value));
    return Value(static_cast<double>(value));
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return Value(std::int64_t{static_cast<std::int32_t>(bits)});
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return Value(std::uint64_t{bits});
  } else if constexpr (VectorTraits<T>::size != 0) {
    return Value(small_vector<T>(bits));
  } else if constexpr (MatrixTraits<T>::size != 0) {
    return Value(small_matrix<T>(bits));
  } else if constexpr (std::is_same_v<T, layer::UnregisteredValue>) {
    return corrupt("an unknown field holds no value");
  } else {
    return Value(T());  // only the empty one is its own word
  }
}

template <class T>
Result<Value> ValueReader::stored(ValueWord word) {
  bytes::ByteReader in = file_.reader();
  TENON_CHECK(in.seek(word.payload()));
  if constexpr (kIsPlain<T>) {
    TENON_TRY(T value, in.read<T>());
    return Value(value);
  } else {
    T value;
    TENON_CHECK(items_.read(in, value));
    return Value(std::move(value));
  }
}

template <class T>
Result<Value> ValueReader::single(ValueWord word) {
  if constexpr (kAlwaysInlined<T>) {
    return inlined<T>(word.inlined());
  } else if constexpr (std::is_same_v<T, layer::Opaque> || std::is_same_v<T, layer::ArrayEdit>) {
    return unsupported(word, "values of this type");
  } else {
    return word.is_inlined() ? inlined<T>(word.inlined()) : stored<T>(word);
  }
}

Result<Value> ValueReader::unsupported(ValueWord word, const char* what) {
  if (diagnostics_.size() >= limits::kLayerFindings) {
    return Value();
  }
  Diagnostic diagnostic;
  diagnostic.severity = Severity::Error;
  diagnostic.rule = "crate.value-unsupported";
  diagnostic.message = std::string(what) + " cannot be read from binary layers (type " +
                       std::to_string(word.type()) + "); the value is skipped";
  diagnostics_.add(std::move(diagnostic));
  return Value();
}

/// Types that are arrays in memory but have ids of their own, and values wrapped once more.
Result<Value> ValueReader::other(ValueWord word) {
  switch (word.type()) {
    case kTokenVector:
      return stored<std::vector<Token>>(word);
    case kDoubleVector:
      return stored<std::vector<double>>(word);
    case kStringVector:
      return stored<std::vector<std::string>>(word);
    case kValueType: {
      bytes::ByteReader in = file_.reader();
      TENON_CHECK(in.seek(word.payload()));
      Value value;
      TENON_CHECK(items_.read(in, value));
      return value;
    }
    default:
      return unsupported(word, "values of this type");
  }
}

bool may_hold_paths(ValueWord word) {
  using namespace layer;  // NOLINT(google-build-using-namespace): the table names its types
  switch (word.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id) \
  case crate_id:                                       \
    return false;
#include "tenon/layer/value_types.def"
    case kTokenVector:
    case kDoubleVector:
    case kStringVector:
      return false;
#define TENON_FIELD(enumerator, type, crate_id)                             \
  case crate_id:                                                            \
    return !(std::is_enum_v<type> || std::is_same_v<type, ListOp<Token>> || \
             std::is_same_v<type, ListOp<std::string>>);
#include "tenon/layer/value_types.def"
    default:
      return true;
  }
}

/// Attributes and samples share large arrays, which are decoded and paid for once.
Result<Value> ValueReader::array(ValueType element, ValueWord word) {
  if (const auto known = arrays_.find(word.bits); known != arrays_.end()) {
    TENON_CHECK(budget_.spend(1));
    return known->second;
  }
  TENON_TRY(Value value, read_array(tables_.file, element, word, budget_));
  if (value.is_deferred()) {
    arrays_.emplace(word.bits, value);
  }
  return value;
}

/// At the offset: the word of the literals, the word of the instructions, and a byte of old that
/// means nothing. Without an offset the edit changes nothing.
Result<Value> ValueReader::array_edit(ValueType element, ValueWord word) {
  layer::ArrayEdit edit{layer::make_array(element, {}), {}};
  if (word.payload() == 0) {
    return Value(std::move(edit));
  }
  bytes::ByteReader in = file_.reader();
  TENON_CHECK(in.seek(word.payload()));
  TENON_TRY(const ValueWord literals, in.read<ValueWord>());
  TENON_TRY(const ValueWord instructions, in.read<ValueWord>());
  constexpr unsigned kInt64 = 5;
  if (literals.type() != word.type() || !literals.is_array() || instructions.type() != kInt64 ||
      !instructions.is_array()) {
    return corrupt("an edit of an array is not made of two arrays");
  }
  TENON_TRY(const Value elements, array(element, literals));
  TENON_TRY(edit.literals, elements.decoded());
  TENON_TRY(const Value words, array(ValueType::Int64, instructions));
  TENON_TRY(const Value decoded, words.decoded());
  edit.instructions = *decoded.get<layer::Array<std::int64_t>>();
  TENON_CHECK(budget_.spend(edit.instructions.size()));
  return edit.is_well_formed() ? Result<Value>(Value(std::move(edit)))
                               : corrupt("an edit of an array has an unknown instruction");
}

Result<Value> ValueReader::read(ValueWord word) {
  using namespace layer;  // NOLINT(google-build-using-namespace): the table names its types
  switch (word.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id)                    \
  case crate_id:                                                          \
    return word.is_array_edit() ? array_edit(ValueType::enumerator, word) \
           : word.is_array()    ? array(ValueType::enumerator, word)      \
                                : single<type>(word);
#define TENON_FIELD(enumerator, type, crate_id) \
  case crate_id:                                \
    return single<type>(word);
#include "tenon/layer/value_types.def"
    default:
      return other(word);
  }
}

}  // namespace tenon::formats::crate
