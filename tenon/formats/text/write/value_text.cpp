// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// value_types.def picks the overload for a type; vectors, quaternions, matrices and arrays print
// their elements by the same overloads. Real numbers have the fewest digits that read back as the
// same number, halves the six digits of OpenUSD, which tell all halves apart. The real part of a
// quaternion comes first. A text in plain ASCII without quotes and backslashes is copied between
// quotes, others are escaped. parse_value is the way back, by the readers of layers, and has to use
// up all of its text.
#include "tenon/formats/text/write/value_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "tenon/base/text/text_number.h"
#include "tenon/base/text/unicode.h"
#include "tenon/formats/text/array_edit_reader.h"
#include "tenon/formats/text/cursor.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/formats/text/write/dictionary_writer.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats {
namespace text {
namespace {

using layer::ArrayEditOp;
using layer::AssetPath;
using layer::Duration;
using layer::PathExpression;
using layer::TimeCode;
using layer::Value;
using layer::ValueType;

void append(std::string& out, bool value) { out += value ? '1' : '0'; }
void append(std::string& out, char value) { out += value != 0 ? '1' : '0'; }
void append(std::string& out, float value) { append_layer_text(out, value); }
void append(std::string& out, double value) { append_layer_text(out, value); }
void append(std::string& out, layer::TimeCode value) { append_layer_text(out, value.value); }
void append(std::string& out, layer::Duration value) { append_layer_text(out, value.value); }
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

template <class T>
void append_element(std::string& out, const Value& array, std::int64_t index) {
  const auto* elements = array.get<layer::Array<T>>();
  if (elements != nullptr) {
    append(out, (*elements)[static_cast<std::size_t>(index)]);
  }
}

void append_literal(std::string& out, const layer::ArrayEdit& edit, std::int64_t index) {
  switch (edit.literals.type()) {
#define TENON_SCALAR(enumerator, cpp_type, name, crate_id) \
  case ValueType::enumerator:                              \
    return append_element<cpp_type>(out, edit.literals, index);
#include "tenon/layer/value_types.def"
    default:
      return;
  }
}

void append_index(std::string& out, std::int64_t index) {
  out += '[';
  append(out, index);
  out += ']';
}

/// The element that a step writes or inserts: a literal, or the element at an index.
void append_given(std::string& out, const layer::ArrayEdit& edit,
                  const layer::ArrayEditStep& step) {
  if (layer::literal_argument(step.op) == 0) {
    append_literal(out, edit, step.first);
  } else {
    append_index(out, step.first);
  }
}

void append_insertion(std::string& out, const layer::ArrayEdit& edit,
                      const layer::ArrayEditStep& step) {
  const bool at_end = step.second == layer::kArrayEnd;
  out += at_end ? "append " : step.second == 0 ? "prepend " : "insert ";
  append_given(out, edit, step);
  if (!at_end && step.second != 0) {
    out += " at ";
    append_index(out, step.second);
  }
}

void append_step(std::string& out, const layer::ArrayEdit& edit, const layer::ArrayEditStep& step) {
  switch (step.op) {
    case ArrayEditOp::Write:
    case ArrayEditOp::WriteCopy:
      out += "write ";
      append_given(out, edit, step);
      out += " to ";
      append_index(out, step.second);
      return;
    case ArrayEditOp::Insert:
    case ArrayEditOp::InsertCopy:
      return append_insertion(out, edit, step);
    case ArrayEditOp::Erase:
      out += "erase ";
      return append_index(out, step.first);
    case ArrayEditOp::MinSize:
    case ArrayEditOp::MinSizeFill:
      out += "minsize ";
      break;
    case ArrayEditOp::Resize:
    case ArrayEditOp::ResizeFill:
      out += "resize ";
      break;
    case ArrayEditOp::MaxSize:
      out += "maxsize ";
      break;
  }
  append(out, step.first);
  if (has_second_argument(step.op)) {
    out += " fill ";
    append_literal(out, edit, step.second);
  }
}

void append_array_edit(std::string& out, const layer::ArrayEdit& edit) {
  out += "edit [";
  bool first = true;
  for_each_step(edit, [&](const layer::ArrayEditStep& step) {
    out += first ? "" : "; ";
    first = false;
    append_step(out, edit, step);
  });
  out += ']';
}

/// True for characters that need no escape, whatever the quotes.
bool is_plain(char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\'' && c != '\\'; }

}  // namespace

void append_quoted(std::string& out, std::string_view text) {
  if (std::all_of(text.begin(), text.end(), is_plain)) {
    out += '"';
    out += text;
    out += '"';
  } else {
    out += quoted_text(text);
  }
}

void append_value_text(std::string& out, const Value& value) {
  switch (value.type()) {
#define TENON_SCALAR(enumerator, cpp_type, name, crate_id) \
  case ValueType::enumerator:                              \
    append_typed<cpp_type>(out, value);                    \
    return;
#include "tenon/layer/value_types.def"
    case ValueType::ArrayEdit:
      return append_array_edit(out, *value.get<layer::ArrayEdit>());
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

int minor_version_of(const Value& value) {
  switch (value.type()) {
    case ValueType::Duration:
      return 4;
    case ValueType::ArrayEdit: {
      const Value& literals = value.get<layer::ArrayEdit>()->literals;
      const bool texts =
          literals.type() == ValueType::String || literals.type() == ValueType::Token ||
          literals.type() == ValueType::Asset || literals.type() == ValueType::PathExpression;
      return texts ? 2 : minor_version_of(literals);
    }
    case ValueType::Dictionary: {
      int version = 0;
      for (const auto& [name, item] : value.get<layer::Dictionary>()->items) {
        version = std::max(version, minor_version_of(item));
      }
      return version;
    }
    default:
      return 0;
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
  } else if (!(type.is_array && text::at_array_edit(cursor)
                   ? text::read_array_edit(cursor, type.type, value)
                   : text::read_value(cursor, type.type, type.is_array, value))) {
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
