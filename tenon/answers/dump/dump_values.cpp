// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Text and digests have to equal those that Python makes of OpenUSD's values. A long array is told
// by its size, its ends and a hash. Numbers are hashed as they lie in memory; texts, asset paths
// and times as json.dumps prints them in ASCII, each with a zero byte behind it. What JSON has no
// form for is an object whose first key begins with '$'. Scalar types come from the list in
// value_types.def.
#include "tenon/answers/dump/dump_values.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <type_traits>

#include "tenon/base/sha256.h"
#include "tenon/base/text/unicode.h"

namespace tenon::answers {
namespace {

using layer::Value;
using layer::ValueType;

// Text as Python's json.dumps prints it when asked for ASCII alone.
std::string ascii_quoted(std::string_view text) {
  const std::string quoted = json_quoted(text);
  std::string result;
  for (std::string_view rest = quoted; !rest.empty();) {
    const unicode::Decoded decoded = unicode::decode(rest);
    const std::size_t length = decoded.length == 0 ? 1 : decoded.length;
    if (length == 1) {
      result += rest.front();
    } else {
      char units[16];
      const auto code = static_cast<unsigned>(decoded.code_point);
      if (code < 0x10000) {
        std::snprintf(units, sizeof units, "\\u%04x", code);
      } else {
        std::snprintf(units, sizeof units, "\\u%04x\\u%04x", 0xD800 + ((code - 0x10000) >> 10u),
                      0xDC00 + ((code - 0x10000) & 0x3FFu));
      }
      result += units;
    }
    rest.remove_prefix(length);
  }
  return result;
}

struct ValueWriter {
  JsonWriter& json;
  const ValueStyle& style;

  void write(bool x) { json.boolean(x); }
  void write(std::uint8_t x) { json.integer(x); }
  void write(std::int32_t x) { json.integer(x); }
  void write(std::uint32_t x) { json.integer(x); }
  void write(std::int64_t x) { json.integer(x); }
  void write(std::uint64_t x) { json.unsigned_integer(x); }
  void write(Half x) { json.number(static_cast<double>(float(x))); }
  void write(float x) { json.number(static_cast<double>(x)); }
  void write(double x) { json.number(x); }
  void write(const std::string& x) { json.string(x); }
  void write(Token x) { json.string(x.view()); }
  void write(Path x) { json.string(style.path_text(x)); }
  void write(layer::TimeCode x) { json.number(x.value); }
  void write(layer::Duration x) { json.number(x.value); }
  void write(const layer::AssetPath& x) {
    json.begin_object();
    json.key("$asset");
    json.string(x.evaluated.empty() ? x.authored : x.evaluated);
    json.key("resolved");
    x.resolved.empty() ? json.null() : json.string(style.file_text(x.resolved));
    json.end_object();
  }
  void write(const layer::PathExpression& x) {
    json.begin_object();
    json.key("$pathExpression");
    json.string(style.expression_text(x.text));
    json.end_object();
  }
  template <class T, std::size_t N>
  void write(const Vec<T, N>& x) {
    json.array(x.v, [this](const auto& item) { this->write(item); });
  }
  template <class T>
  void write(const Quat<T>& x) {
    json.array(std::array{x.w, x.x, x.y, x.z}, [this](const auto& item) { this->write(item); });
  }
  template <std::size_t N>
  void write(const Matrix<N>& x) {
    json.array(x.m, [this](const auto& row) {
      json.array(row, [this](double item) { json.number(item); });
    });
  }
  void write(const layer::Dictionary& x) {
    json.begin_object();
    for (const auto& [key, item] : x.items) {
      json.key(key);
      write_value(json, item, style);
    }
    json.end_object();
  }
  void write(const layer::UnregisteredValue& x) {
    json.begin_object();
    json.key("$unregistered");
    write_value(json, x.value, style);
    json.end_object();
  }
  void write(layer::Permission x) {
    json.string(x == layer::Permission::Public ? "Public" : "Private");
  }
  void write(layer::Specifier x) {
    json.string(x == layer::Specifier::Def    ? "Def"
                : x == layer::Specifier::Over ? "Over"
                                              : "Class");
  }
  void write(layer::Variability x) {
    json.string(x == layer::Variability::Uniform ? "Uniform" : "Varying");
  }

  template <class T>
  void write_items(std::string_view name, const std::vector<T>& items) {
    if (items.empty()) {
      return;
    }
    json.key(name);
    write_list(items);
  }
  template <class T>
  void write_list(const std::vector<T>& items) {
    json.array(items, [this](const T& item) { write(item); });
  }
  template <class T>
  void write(const layer::ListOp<T>& x) {
    json.begin_object();
    json.key("$listop");
    json.begin_object();
    if (x.is_explicit) {
      json.key("explicit");
      write_list(x.explicit_items);
    } else {
      write_items("prepended", x.prepended);
      write_items("appended", x.appended);
      write_items("deleted", x.deleted);
      write_items("ordered", x.ordered);
      write_items("added", x.added);
    }
    json.end_object();
    json.end_object();
  }

  // bools are stored as char
  template <class T, class Stored>
  void write_element(const Stored& x) {
    if constexpr (std::is_same_v<T, bool>) {
      json.boolean(x != 0);
    } else {
      write(x);
    }
  }

  template <class T>
  std::string hash(const layer::Array<T>& array) {
    Sha256 sha;
    if constexpr (std::is_same_v<T, std::string> || std::is_same_v<T, Token>) {
      for (const T& item : array) {
        sha.update(ascii_quoted(std::string_view(Token(item).view())));
        sha.update(std::string_view("\0", 1));
      }
    } else if constexpr (std::is_same_v<T, layer::TimeCode> || std::is_same_v<T, layer::Duration>) {
      for (const T& item : array) {
        sha.update(json_number(item.value));
        sha.update(std::string_view("\0", 1));
      }
    } else if constexpr (std::is_same_v<T, layer::AssetPath>) {
      for (const T& item : array) {
        const std::string resolved =
            item.resolved.empty() ? "null" : ascii_quoted(style.file_text(item.resolved));
        const std::string path = item.evaluated.empty() ? item.authored : item.evaluated;
        sha.update("{\"$asset\": " + ascii_quoted(path) + ", \"resolved\": " + resolved + "}");
        sha.update(std::string_view("\0", 1));
      }
    } else if constexpr (std::is_same_v<T, layer::PathExpression>) {
      for (const T& item : array) {
        sha.update(ascii_quoted(item.text));
        sha.update(std::string_view("\0", 1));
      }
    } else if constexpr (std::is_trivially_copyable_v<T>) {
      sha.update({reinterpret_cast<const char*>(array.data()), array.size() * sizeof(array[0])});
    }
    return sha.hex_digest();
  }

  template <class T>
  void write_array(const layer::Array<T>& array) {
    if (array.size() <= style.full_arrays) {
      json.array(array, [this](const auto& item) { this->write_element<T>(item); });
      return;
    }
    json.begin_object();
    json.key("$array");
    json.begin_object();
    json.key("n");
    json.unsigned_integer(array.size());
    json.key("sha256");
    json.string(hash<T>(array));
    const std::size_t ends = std::min<std::size_t>(4, array.size());
    for (const bool head : {true, false}) {
      json.key(head ? "head" : "tail");
      json.begin_array();
      for (std::size_t i = 0; i < ends; ++i) {
        write_element<T>(array[head ? i : array.size() - ends + i]);
      }
      json.end_array();
    }
    json.end_object();
    json.end_object();
  }
};

void write_block(JsonWriter& json) {
  json.begin_object();
  json.key("$block");
  json.boolean(true);
  json.end_object();
}

void write_field(ValueWriter& writer, const Value& value) {
  switch (value.type()) {
    case ValueType::ValueBlock:
      return write_block(writer.json);
    case ValueType::PathVector: {  // a path written where a value is expected
      const auto& paths = *value.get<std::vector<Path>>();
      return paths.empty() ? writer.json.null()
                           : writer.json.string(writer.style.path_text(paths.front()));
    }
#define TENON_DUMP(enumerator, type) \
  case ValueType::enumerator:        \
    return writer.write(*value.get<type>());
      TENON_DUMP(Dictionary, layer::Dictionary)
      TENON_DUMP(TokenListOp, layer::ListOp<Token>)
      TENON_DUMP(StringListOp, layer::ListOp<std::string>)
      TENON_DUMP(PathListOp, layer::ListOp<Path>)
      TENON_DUMP(IntListOp, layer::ListOp<std::int32_t>)
      TENON_DUMP(Int64ListOp, layer::ListOp<std::int64_t>)
      TENON_DUMP(UIntListOp, layer::ListOp<std::uint32_t>)
      TENON_DUMP(UInt64ListOp, layer::ListOp<std::uint64_t>)
      TENON_DUMP(UnregisteredValue, layer::UnregisteredValue)
      TENON_DUMP(UnregisteredValueListOp, layer::ListOp<layer::UnregisteredValue>)
      TENON_DUMP(Specifier, layer::Specifier)
      TENON_DUMP(Permission, layer::Permission)
      TENON_DUMP(Variability, layer::Variability)
#undef TENON_DUMP
    default:
      return writer.json.null();
  }
}

template <class T>
void write_scalar_or_array(ValueWriter& writer, const Value& value) {
  if (!value.is_array()) {
    return writer.write(*value.get<T>());
  }
  // Corrupt deferred data have no elements to show.
  const auto* array = value.get<layer::Array<T>>();
  array == nullptr ? writer.json.null() : writer.write_array<T>(*array);
}

}  // namespace

void write_value(JsonWriter& json, const Value& value, const ValueStyle& style) {
  using layer::AssetPath;
  using layer::Duration;
  using layer::PathExpression;
  using layer::TimeCode;
  ValueWriter writer{json, style};
  switch (value.type()) {
#define TENON_SCALAR(enumerator, type, name, crate_id) \
  case ValueType::enumerator:                          \
    return write_scalar_or_array<type>(writer, value);
#include "tenon/layer/value_types.def"
    default:
      return write_field(writer, value);
  }
}

}  // namespace tenon::answers
