// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/write/dictionary_writer.h"

#include <algorithm>

#include "tenon/base/path.h"
#include "tenon/formats/text/write/list_writer.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/field_values.h"
#include "tenon/layer/type_names.h"

namespace tenon::formats::text {
namespace {

using layer::Dictionary;
using layer::Value;
using layer::ValueType;

/// OpenUSD quotes keys with letters beyond ASCII.
bool is_plain_key(std::string_view key) {
  return is_identifier(key) &&
         std::all_of(key.begin(), key.end(), [](char c) { return (c & '\x80') == 0; });
}

void append_entry(std::string& out, const std::string& key, const Value& value, std::size_t indent,
                  Lines lines) {
  const std::string name = is_plain_key(key) ? key : quoted_text(key);
  if (const auto* inner = value.get<Dictionary>()) {
    out += "dictionary " + name + " = ";
    append_dictionary(out, *inner, indent, lines);
    return;
  }
  const layer::TypeName* type = layer::type_name_of(value.type(), value.is_array());
  out += (type == nullptr ? std::string() : type->name.str()) + ' ' + name + " = ";
  append_value_text(out, value);
  if (lines == Lines::Many) {
    out += '\n';
  }
}

}  // namespace

void append_dictionary(std::string& out, const Dictionary& dictionary, std::size_t indent,
                       Lines lines) {
  const bool many = lines == Lines::Many;
  out += many ? "{\n" : "{ ";
  std::size_t left = dictionary.items.size();
  for (const auto& [key, value] : dictionary.items) {
    --left;
    append_indent(out, many ? indent + 1 : 0);
    append_entry(out, key, value, indent + 1, lines);
    if (!many && left > 0) {
      out += "; ";
    }
  }
  append_indent(out, many ? indent : 0);
  out += many ? "}\n" : " }";
}

void append_field_text(std::string& out, const Value& value) {
  if (const auto* dictionary = value.get<Dictionary>()) {
    append_dictionary(out, *dictionary, 0, Lines::One);
  } else if (const auto* unknown = value.get<layer::UnregisteredValue>()) {
    const auto* text = unknown->value.get<std::string>();
    if (text != nullptr) {
      out += *text;
    } else {
      append_field_text(out, unknown->value);
    }
  } else if (const auto* permission = value.get<layer::Permission>()) {
    out += *permission == layer::Permission::Private ? "private" : "public";
  } else if (const auto* specifier = value.get<layer::Specifier>()) {
    constexpr const char* kNames[] = {"def", "over", "class"};
    out += kNames[static_cast<std::size_t>(*specifier)];
  } else if (const auto* variability = value.get<layer::Variability>()) {
    out += *variability == layer::Variability::Uniform ? "uniform" : "varying";
  } else if (const auto* paths = value.get<std::vector<Path>>()) {
    bool first = true;
    for (const Path& path : *paths) {
      out += (first ? "<" : ", <") + path.str() + '>';
      first = false;
    }
  }
}

}  // namespace tenon::formats::text
