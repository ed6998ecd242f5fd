// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/value_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "tenon/base/text_number.h"
#include "tenon/base/unicode.h"
#include "tenon/formats/text/cursor.h"
#include "tenon/formats/text/dictionary_writer.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats {
namespace text {
namespace {

using layer::AssetPath;
using layer::PathExpression;
using layer::TimeCode;
using layer::Value;
using layer::ValueType;

void append(std::string& out, bool value) { out += value ? '1' : '0'; }
void append(std::string& out, char value) { out += value != 0 ? '1' : '0'; }
void append(std::string& out, float value) { append_layer_text(out, value); }
void append(std::string& out, double value) { append_layer_text(out, value); }
void append(std::string& out, layer::TimeCode value) { append_layer_text(out, value.value); }
void append(std::string& out, const std::string& value) { append_quoted(out, value); }
void append(std::string& out, const Token& value) { append_quoted(out, value.view()); }
void append(std::string& out, const layer::PathExpression& value) {
  append_quoted(out, value.text);
}
void append(std::string& out, const layer::AssetPath& value) {
  out += asset_path_text(value.authored);
}

template <class Int>
  requires std::is_integral_v<Int>
void append(std::string& out, Int value) {
  std::array<char, 24> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  out.append(buffer.data(), end);
}

/// Six significant digits, as C's %g: enough to tell all halves apart.
void append(std::string& out, Half value) {
  const float number = static_cast<float>(value);
  if (!std::isfinite(number)) {
    append(out, number);
    return;
  }
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                 std::chars_format::general, 6)
                       .ptr;
  out.append(buffer.data(), end);
}

template <class T, std::size_t N>
void append(std::string& out, const Vec<T, N>& value) {
  for (std::size_t i = 0; i < N; ++i) {
    out += i == 0 ? "(" : ", ";
    append(out, value[i]);
  }
  out += ')';
}

template <class T>
void append(std::string& out, const Quat<T>& value) {
  append(out, Vec<T, 4>{{value.w, value.x, value.y, value.z}});
}

template <std::size_t N>
void append(std::string& out, const Matrix<N>& value) {
  for (std::size_t row = 0; row < N; ++row) {
    out += row == 0 ? "( " : ", ";
    append(out, Vec<double, N>{value.m[row]});
  }
  out += " )";
}

template <class T>
void append_typed(std::string& out, const Value& value) {
  if (!value.is_array()) {
    if (const T* scalar = value.get<T>()) {
      append(out, *scalar);
    }
    return;
  }
  out += '[';
  if (const auto* elements = value.get<layer::Array<T>>()) {
    bool first = true;
    for (const auto& element : *elements) {
      if (!first) {
        out += ", ";
      }
      first = false;
      append(out, element);
    }
  }
  out += ']';
}

/// True for characters that stand for themselves, whatever the quotes.
bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\'' && c != '\\'; }

}  // namespace

void append_quoted(std::string& out, std::string_view text) {
  if (std::all_of(text.begin(), text.end(), is_plain)) {
    out += '"';
    out += text;
    out += '"';
  } else {
    out += quoted(text);
  }
}

std::string asset_path_text(std::string_view path) {
  if (path.find('@') == std::string_view::npos) {
    return '@' + std::string(path) + '@';
  }
  std::string out = "@@@";
  for (std::size_t at = 0; at < path.size();) {
    const bool delimiter = path.substr(at, 3) == "@@@";
    out += delimiter ? "\\@@@" : std::string(1, path[at]);
    at += delimiter ? 3 : 1;
  }
  return out + "@@@";
}

void append_value_text(std::string& out, const Value& value) {
  switch (value.type()) {
#define TENON_SCALAR(enumerator, cpp_type, name, crate_id) \
  case ValueType::enumerator:                              \
    append_typed<cpp_type>(out, value);                    \
    return;
#include "tenon/layer/value_types.def"
    case ValueType::ValueBlock:
      out += "None";
      return;
    case ValueType::AnimationBlock:
      out += "AnimationBlock";
      return;
    default:
      append_field_text(out, value);
  }
}

}  // namespace text

std::string value_text(const layer::Value& value) {
  std::string out;
  text::append_value_text(out, value);
  return out;
}

Result<layer::Value> parse_value(std::string_view source, const layer::TypeName& type) {
  text::Cursor cursor(source, {});
  cursor.skip_multi_line();
  layer::Value value;
  if (cursor.accept_word("None")) {
    value = layer::ValueBlock{};
  } else if (cursor.accept_word("AnimationBlock")) {
    value = layer::AnimationBlock{};
  } else if (!text::read_value(cursor, type.type, type.is_array, value)) {
    return cursor.take_error();
  }
  cursor.skip_multi_line();
  if (!cursor.failed() && !cursor.at_end()) {
    cursor.fail_expected("the end of the value");
  }
  if (cursor.failed()) {
    return cursor.take_error();
  }
  return value;
}

}  // namespace tenon::formats
