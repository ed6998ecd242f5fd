// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Dictionaries, whose entries name their types, and values that name none.
#include <unordered_map>

#include "tenon/base/limits/limits.h"
#include "tenon/base/text/quoted_text.h"
#include "tenon/base/text/text_number.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/formats/text/words.h"
#include "tenon/layer/expressions/path_expression.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats::text {
namespace {

using layer::Dictionary;
using layer::Value;

std::string number_text(const Number& number) {
  switch (number.kind) {
    case Number::Kind::Unsigned:
      return std::to_string(number.unsigned_value);
    case Number::Kind::Signed:
      return std::to_string(number.signed_value);
    case Number::Kind::Double:
      break;
  }
  return layer_text(number.double_value);
}

bool append_number(Cursor& cursor, std::string& text) {
  Number number;
  if (!read_number(cursor, number)) {
    return false;
  }
  text += number_text(number);
  return true;
}

bool append_source(Cursor& cursor, std::string& text, std::size_t depth);

/// A tuple or a list, whose opening character is at the cursor.
bool append_items(Cursor& cursor, std::string& text, char close, std::size_t depth) {
  if (depth >= limits::kTextNestingDepth) {
    return cursor.fail_at(cursor.offset(), ErrorCode::Limit, "text.depth",
                          "values are nested too deep");
  }
  text += cursor.peek();
  cursor.advance();
  bool first = true;
  const bool ok = read_items(cursor, close, "of the value", [&] {
    if (!first) {
      text += ", ";
    }
    first = false;
    return append_source(cursor, text, depth + 1);
  });
  text += close;
  return ok;
}

bool append_source(Cursor& cursor, std::string& text, std::size_t depth) {
  if (at_number(cursor)) {
    return append_number(cursor, text);
  }
  std::string piece;
  switch (cursor.peek()) {
    case '"':
    case '\'':
      if (!read_string(cursor, piece)) {
        return false;
      }
      text += quoted_text(piece);
      return true;
    case '@':
      if (!read_asset_path(cursor, piece)) {
        return false;
      }
      text += asset_path_text(piece);
      return true;
    case '(':
      return append_items(cursor, text, ')', depth);
    case '[':
      return append_items(cursor, text, ']', depth);
    default:
      break;
  }
  std::string_view word;
  if (!read_name(cursor, "a value", word)) {
    return false;
  }
  text += word;
  return true;
}

/// A type by its name, looked up without making tokens.
struct KnownType {
  const layer::TypeName* scalar = nullptr;
  const layer::TypeName* array = nullptr;
};

const KnownType* find_known_type(std::string_view name) {
  static const auto* const kTypes = [] {
    auto* types = new std::unordered_map<std::string_view, KnownType>();
    for (const layer::TypeName& type : layer::all_type_names()) {
      KnownType& known = (*types)[type.scalar_name.view()];
      (type.is_array ? known.array : known.scalar) = &type;
    }
    return types;
  }();
  const auto it = kTypes->find(name);
  return it == kTypes->end() ? nullptr : &it->second;
}

bool read_key(Cursor& cursor, std::string& key) {
  if (at_string(cursor)) {
    return read_string(cursor, key);
  }
  const std::string_view word = cursor.peek_identifier();
  if (word.empty()) {
    return cursor.fail_expected("the name of a dictionary entry");
  }
  key.assign(word);
  cursor.advance(word.size());
  return true;
}

bool read_entry_start(Cursor& cursor, std::string& key) {
  if (!cursor.accept_separator()) {
    return cursor.fail_expected("a blank and the name of a dictionary entry");
  }
  if (!read_key(cursor, key)) {
    return false;
  }
  cursor.skip_inline();
  if (!cursor.expect('=', "after the name of the entry")) {
    return false;
  }
  cursor.skip_inline();
  return true;
}

bool read_nested(Cursor& cursor, Dictionary& dictionary, std::size_t depth);

bool read_entry(Cursor& cursor, Dictionary& dictionary, std::size_t depth) {
  std::string key;
  if (cursor.accept_word("dictionary")) {
    Dictionary inner;
    if (!read_entry_start(cursor, key) || !read_nested(cursor, inner, depth + 1)) {
      return false;
    }
    dictionary.items.insert_or_assign(std::move(key), Value(std::move(inner)));
    return true;
  }
  const std::size_t start = cursor.offset();
  WrittenType type;
  if (!read_type(cursor, type)) {
    return false;
  }
  if (type.type == nullptr) {
    return cursor.fail_at(
        start, ErrorCode::Parse, "text.type",
        "`" + std::string(type.name) + "` is not a type that a dictionary entry can have");
  }
  Value value;
  if (!read_entry_start(cursor, key) ||
      !read_value(cursor, type.type->type, type.is_array, value)) {
    return false;
  }
  layer::make_canonical(value);
  dictionary.items.insert_or_assign(std::move(key), std::move(value));
  return true;
}

bool read_nested(Cursor& cursor, Dictionary& dictionary, std::size_t depth) {
  if (depth >= limits::kTextNestingDepth) {
    return cursor.fail_at(cursor.offset(), ErrorCode::Limit, "text.depth",
                          "dictionaries are nested too deep");
  }
  if (!cursor.expect('{', "before the entries of a dictionary")) {
    return false;
  }
  return read_statements(cursor, '}', "of the dictionary",
                         [&] { return read_entry(cursor, dictionary, depth); });
}

}  // namespace

bool read_source_text(Cursor& cursor, std::string& text) {
  text.clear();
  const std::size_t start = cursor.offset();
  if (cursor.accept('[')) {
    cursor.skip_inline();
    if (cursor.accept(']')) {
      text = "[]";
      return true;
    }
    cursor.seek(start);
  }
  return append_source(cursor, text, 0);
}

bool read_dictionary(Cursor& cursor, Dictionary& dictionary) {
  return read_nested(cursor, dictionary, 0);
}

bool read_name(Cursor& cursor, std::string_view what, std::string_view& name) {
  const std::size_t start = cursor.offset();
  while (true) {
    const std::string_view word = cursor.peek_identifier();
    if (word.empty() || is_reserved_word(word)) {
      cursor.seek(start);
      return cursor.fail_expected(what);
    }
    cursor.advance(word.size());
    if (!cursor.starts_with("::")) {
      name = cursor.text().substr(start, cursor.offset() - start);
      return true;
    }
    cursor.advance(2);
  }
}

bool read_type(Cursor& cursor, WrittenType& type) {
  const std::size_t start = cursor.offset();
  type.name = cursor.peek_identifier();
  const KnownType* known = find_known_type(type.name);
  cursor.advance(type.name.size());
  if (known == nullptr || cursor.peek() == ':') {
    cursor.seek(start);
    if (!read_name(cursor, "the name of a type", type.name)) {
      return false;
    }
  }
  const std::size_t after = cursor.offset();
  cursor.skip_inline();
  type.is_array = cursor.accept('[');
  if (type.is_array) {
    cursor.skip_inline();
    if (!cursor.expect(']', "after '[' of an array type")) {
      return false;
    }
  } else {
    cursor.seek(after);
  }
  if (known != nullptr) {
    type.type = type.is_array ? known->array : known->scalar;
  } else {
    type.type = layer::find_type_name(
        Token(type.is_array ? std::string(type.name) + "[]" : std::string(type.name)));
  }
  return true;
}

}  // namespace tenon::formats::text
