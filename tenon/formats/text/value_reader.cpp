// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Values whose type is known go from the text straight into their storage; nothing is kept between.
#include "tenon/formats/text/value_reader.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "tenon/base/limits/limits.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/plain_elements.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/number_arrays.h"
#include "tenon/math/functions.h"

namespace tenon::formats::text {
namespace {

using layer::ArrayBuffer;
using layer::AssetPath;
using layer::Duration;
using layer::PathExpression;
using layer::TimeCode;
using layer::Value;
using layer::ValueType;

bool read_component(Cursor& cursor, double& value) {
  if (at_number(cursor)) {
    return read_double(cursor, value);
  }
  if (at_string(cursor)) {
    const std::size_t start = cursor.offset();
    std::string word;
    if (!read_string(cursor, word)) {
      return false;
    }
    if (word == "inf" || word == "-inf" || word == "nan") {
      value = word == "inf" ? kInfinity : word == "nan" ? std::nan("") : -kInfinity;
      return true;
    }
    cursor.seek(start);
  }
  return cursor.fail_expected("a number");
}

bool read_component(Cursor& cursor, float& value) {
  double number = 0;
  const bool ok = read_component(cursor, number);
  value = static_cast<float>(number);
  return ok;
}

bool read_component(Cursor& cursor, Half& value) {
  double number = 0;
  const bool ok = read_component(cursor, number);
  value = Half(static_cast<float>(number));
  return ok;
}

template <class Int>
bool narrow(const Number& number, Int& value) {
  using Limits = std::numeric_limits<Int>;
  switch (number.kind) {
    case Number::Kind::Unsigned:
      value = static_cast<Int>(number.unsigned_value);
      return number.unsigned_value <= static_cast<std::uint64_t>(Limits::max());
    case Number::Kind::Signed:
      value = static_cast<Int>(number.signed_value);
      return Limits::is_signed && number.signed_value >= static_cast<std::int64_t>(Limits::min());
    case Number::Kind::Double:
      break;
  }
  const double whole = std::trunc(number.double_value);
  const double above = std::ldexp(1.0, Limits::digits);
  if (!(whole < above && whole >= (Limits::is_signed ? -above : 0.0))) {
    return false;
  }
  value = static_cast<Int>(whole);
  return true;
}

template <class Int>
bool read_whole(Cursor& cursor, Int& value) {
  const std::size_t start = cursor.offset();
  if (!at_number(cursor)) {
    return cursor.fail_expected("a whole number");
  }
  Number number;
  if (!read_number(cursor, number)) {
    return false;
  }
  if (narrow(number, value)) {
    return true;
  }
  const std::string_view written = cursor.text().substr(start, cursor.offset() - start);
  return cursor.fail_at(start, ErrorCode::Parse, "text.value",
                        std::string(written) + " does not fit: whole numbers from " +
                            std::to_string(std::numeric_limits<Int>::min()) + " to " +
                            std::to_string(std::numeric_limits<Int>::max()) + " are expected");
}

bool read_component(Cursor& cursor, std::int32_t& value) { return read_whole(cursor, value); }

bool bool_of_word(std::string_view word, bool& value) {
  std::string lower(word);
  for (char& c : lower) {
    c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  value = lower == "true" || lower == "yes" || lower == "1";
  return value || lower == "false" || lower == "no" || lower == "0";
}

bool read_scalar(Cursor& cursor, bool& value) {
  if (at_number(cursor)) {
    Number number;
    const bool ok = read_number(cursor, number);
    value = number.kind == Number::Kind::Unsigned ? number.unsigned_value != 0
                                                  : number.as_double() != 0;
    return ok;
  }
  const std::size_t start = cursor.offset();
  if (at_string(cursor)) {
    std::string word;
    if (!read_string(cursor, word)) {
      return false;
    }
    if (bool_of_word(word, value)) {
      return true;
    }
    cursor.seek(start);
  }
  const std::string_view word = cursor.peek_identifier();
  cursor.advance(word.size());
  if (bool_of_word(word, value)) {
    return true;
  }
  cursor.seek(start);
  return cursor.fail_expected("true or false");
}

bool read_scalar(Cursor& cursor, char& value) {
  bool truth = false;
  const bool ok = read_scalar(cursor, truth);
  value = truth ? 1 : 0;
  return ok;
}

bool read_scalar(Cursor& cursor, std::uint8_t& value) { return read_whole(cursor, value); }
bool read_scalar(Cursor& cursor, std::int32_t& value) { return read_whole(cursor, value); }
bool read_scalar(Cursor& cursor, std::uint32_t& value) { return read_whole(cursor, value); }
bool read_scalar(Cursor& cursor, std::int64_t& value) { return read_whole(cursor, value); }
bool read_scalar(Cursor& cursor, std::uint64_t& value) { return read_whole(cursor, value); }
bool read_scalar(Cursor& cursor, Half& value) { return read_component(cursor, value); }
bool read_scalar(Cursor& cursor, float& value) { return read_component(cursor, value); }
bool read_scalar(Cursor& cursor, double& value) { return read_component(cursor, value); }
bool read_scalar(Cursor& cursor, layer::TimeCode& value) {
  return read_component(cursor, value.value);
}
bool read_scalar(Cursor& cursor, layer::Duration& value) {
  return read_component(cursor, value.value);
}
bool read_scalar(Cursor& cursor, std::string& value) { return read_string(cursor, value); }

bool read_scalar(Cursor& cursor, Token& value) {
  std::string text;
  const bool ok = read_string(cursor, text);
  value = Token(text);
  return ok;
}

bool read_scalar(Cursor& cursor, layer::PathExpression& value) {
  return read_string(cursor, value.text);
}

bool read_scalar(Cursor& cursor, layer::AssetPath& value) {
  if (cursor.peek() == '@') {
    return read_asset_path(cursor, value.authored);
  }
  const std::size_t start = cursor.offset();
  if (!at_string(cursor)) {
    return cursor.fail_expected("an asset path such as @file.png@");
  }
  if (!read_string(cursor, value.authored)) {
    return false;
  }
  for (const char c : value.authored) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      return cursor.fail_at(start, ErrorCode::Parse, "text.value",
                            "an asset path holds a control character");
    }
  }
  return true;
}

/// Takes "(" item, ... ")" with exactly `count` items.
template <class Item>
bool read_tuple(Cursor& cursor, std::size_t count, Item item) {
  const std::size_t start = cursor.offset();
  if (!cursor.accept('(')) {
    return cursor.fail_expected("a tuple of " + std::to_string(count) + " in ( )");
  }
  std::size_t read = 0;
  const bool ok = read_items(cursor, ')', "of the tuple", [&] {
    if (read == count) {
      return cursor.fail_at(start, ErrorCode::Parse, "text.value",
                            "this tuple has more than " + std::to_string(count) + " items");
    }
    return item(read++);
  });
  if (ok && read != count) {
    return cursor.fail_at(start, ErrorCode::Parse, "text.value",
                          "this tuple has " + std::to_string(read) + " items where " +
                              std::to_string(count) + " are expected");
  }
  return ok;
}

/// The same for tuples as programs write them; no error for other forms.
template <class T>
bool accept_plain(Cursor& cursor, T& value) {
  const std::string_view rest = cursor.rest();
  const char* at = rest.data();
  if (!take_plain(at, at + rest.size(), value)) {
    return false;
  }
  cursor.advance(static_cast<std::size_t>(at - rest.data()));
  return true;
}

template <class Number>
bool read_numbers(Cursor& cursor, std::span<Number> numbers) {
  return read_tuple(cursor, numbers.size(),
                    [&](std::size_t i) { return read_component(cursor, numbers[i]); });
}

/// What a component is read as; real ones are rounded to their type afterwards, so that tuples of
/// all lengths and types are read by the same code.
template <class T>
using ReadAs = std::conditional_t<std::is_integral_v<T>, T, double>;

template <class T>
T component_of(ReadAs<T> number) {
  if constexpr (std::is_same_v<T, Half>) {
    return Half(static_cast<float>(number));
  } else {
    return static_cast<T>(number);
  }
}

template <class T, std::size_t N>
bool read_scalar(Cursor& cursor, Vec<T, N>& value) {
  if (accept_plain(cursor, value)) {
    return true;
  }
  std::array<ReadAs<T>, N> numbers{};
  if (!read_numbers(cursor, std::span<ReadAs<T>>(numbers))) {
    return false;
  }
  for (std::size_t i = 0; i < N; ++i) {
    value[i] = component_of<T>(numbers[i]);
  }
  return true;
}

template <class T>
bool read_scalar(Cursor& cursor, Quat<T>& value) {
  if (accept_plain(cursor, value)) {
    return true;
  }
  std::array<double, 4> numbers{};
  if (!read_numbers(cursor, std::span<double>(numbers))) {
    return false;
  }
  value.w = component_of<T>(numbers[0]);
  value.x = component_of<T>(numbers[1]);
  value.y = component_of<T>(numbers[2]);
  value.z = component_of<T>(numbers[3]);
  return true;
}

/// The rows of a square matrix one after the other, in which each has `size` numbers.
bool read_rows(Cursor& cursor, std::size_t size, double* numbers) {
  return read_tuple(cursor, size, [&](std::size_t row) {
    return read_numbers(cursor, std::span<double>(numbers + row * size, size));
  });
}

template <std::size_t N>
bool read_scalar(Cursor& cursor, Matrix<N>& value) {
  if (accept_plain(cursor, value)) {
    return true;
  }
  std::array<double, N * N> numbers{};
  if (!read_rows(cursor, N, numbers.data())) {
    return false;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    value[i / N][i % N] = numbers[i];
  }
  return true;
}

/// Where the elements of a list go, and how they are read.
struct ElementReader {
  void* elements = nullptr;
  bool (*read)(Cursor& cursor, void* elements) = nullptr;  ///< one, to the end
  const PlainType* plain = nullptr;  ///< of numbers in the form in which programs write them
};

template <class T>
bool read_number(Cursor& cursor, void* elements) {
  T number{};
  const bool ok = read_scalar(cursor, number);
  static_cast<layer::NumberBuffer*>(elements)->push_back(number);
  return ok;
}

template <class T>
bool read_element(Cursor& cursor, void* elements) {
  return read_scalar(cursor, static_cast<ArrayBuffer<T>*>(elements)->emplace_back());
}

/// Reads the elements of a list; lists within the list are flattened and must be of equal sizes.
class ListReader {
 public:
  ListReader(Cursor& cursor, const ElementReader& element) : cursor_(cursor), element_(element) {}

  bool read(std::size_t depth = 0) {
    if (depth >= limits::kTextNestingDepth) {
      return cursor_.fail_at(cursor_.offset(), ErrorCode::Limit, "text.depth",
                             "lists are nested too deep");
    }
    const std::size_t start = cursor_.offset();
    cursor_.advance();
    std::size_t count = 0;
    if (element_.plain != nullptr && depth == 0) {
      cursor_.skip_multi_line();
      auto& elements = *static_cast<layer::NumberBuffer*>(element_.elements);
      count = take_plain_elements(*element_.plain, cursor_, elements);
      element_depth_ = count == 0 ? kNoDepth : 0;
    }
    const bool ok = read_items(cursor_, ']', "of the list", [&] {
      ++count;
      return read_item(depth);
    });
    return ok && check_size(start, depth, count);
  }

 private:
  static constexpr std::size_t kNoDepth = ~std::size_t{0};

  bool read_item(std::size_t depth) {
    if (cursor_.peek() == '[') {
      return read(depth + 1);
    }
    if (element_depth_ != kNoDepth && element_depth_ != depth) {
      return cursor_.fail_at(cursor_.offset(), ErrorCode::Parse, "text.value",
                             "lists and single items are mixed in one list");
    }
    element_depth_ = depth;
    return element_.read(cursor_, element_.elements);
  }

  bool check_size(std::size_t start, std::size_t depth, std::size_t count) {
    if (depth >= sizes_.size()) {
      sizes_.resize(depth + 1);
    }
    if (sizes_[depth] == 0) {
      sizes_[depth] = count;
    }
    return sizes_[depth] == count || cursor_.fail_at(start, ErrorCode::Parse, "text.value",
                                                     "the lists within this list differ in size");
  }

  Cursor& cursor_;
  const ElementReader& element_;
  std::size_t element_depth_ = kNoDepth;
  std::vector<std::size_t> sizes_;
};

/// `[ ]` with nothing but blanks inside.
bool accept_empty_list(Cursor& cursor) {
  const std::size_t start = cursor.offset();
  if (cursor.accept('[')) {
    cursor.skip_inline();
    if (cursor.accept(']')) {
      return true;
    }
  }
  cursor.seek(start);
  return false;
}

bool read_list(Cursor& cursor, const ElementReader& element) {
  if (accept_empty_list(cursor)) {
    return true;
  }
  if (cursor.peek() != '[') {
    return cursor.fail_expected("'[', as the type name ends with []");
  }
  return ListReader(cursor, element).read();
}

template <class T>
bool read_array(Cursor& cursor, Value& value) {
  ArrayBuffer<T> elements;
  if (!read_list(cursor, {&elements, &read_element<T>})) {
    return false;
  }
  value = Value(std::move(elements));
  return true;
}

bool read_number_array(Cursor& cursor, ValueType type, ElementReader element, Value& value) {
  layer::NumberBuffer elements;
  element.elements = &elements;
  if (!read_list(cursor, element)) {
    return false;
  }
  value = layer::NumberArrays::make(type, std::move(elements));
  return true;
}

template <class T>
constexpr ElementReader number_reader() {
  if constexpr (PlainElement<T>) {
    return {nullptr, &read_number<T>, &kPlainType<T>};
  } else {
    return {nullptr, &read_number<T>};
  }
}

template <class T>
bool read_single(Cursor& cursor, Value& value) {
  if (cursor.peek() == '[') {
    return cursor.fail_expected("a single value, as the type name has no []");
  }
  T scalar{};
  if (!read_scalar(cursor, scalar)) {
    return false;
  }
  value = Value(std::move(scalar));
  return true;
}

}  // namespace

bool read_value(Cursor& cursor, ValueType type, bool is_array, Value& value) {
  switch (type) {
#define TENON_SCALAR(enumerator, cpp_type, name, crate_id) \
  case ValueType::enumerator:                              \
    return is_array ? read_array<cpp_type>(cursor, value) : read_single<cpp_type>(cursor, value);
#define TENON_NUMBER(enumerator, cpp_type, name, crate_id)                              \
  case ValueType::enumerator:                                                           \
    return is_array ? read_number_array(cursor, type, number_reader<cpp_type>(), value) \
                    : read_single<cpp_type>(cursor, value);
#include "tenon/layer/value_types.def"
    default:
      return cursor.fail_at(cursor.offset(), ErrorCode::Parse, "text.value",
                            "attributes of this type never have a value");
  }
}

}  // namespace tenon::formats::text
