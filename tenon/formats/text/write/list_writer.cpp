// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A list op becomes one statement for each of its edits that says something; an explicit one has
// one statement, None when it is empty. Paths, references and payloads stand one per line, and a
// single one without brackets. A reference with custom data always has brackets. Other items stay
// on one line in brackets; append_names alone leaves them out around a single name. These are the
// forms that OpenUSD prints.
#include "tenon/formats/text/write/list_writer.h"

#include "tenon/base/text/text_number.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/write/dictionary_writer.h"
#include "tenon/formats/text/write/value_text.h"

namespace tenon::formats::text {
namespace {

using layer::ListOp;

/// How one kind of item is printed.
template <class T>
struct ItemStyle {
  static constexpr bool kPerLine = false;
  static bool alone(const T&) { return false; }  // may stand without brackets
};
template <>
struct ItemStyle<Path> {
  static constexpr bool kPerLine = true;
  static bool alone(const Path&) { return true; }
};
template <>
struct ItemStyle<layer::Payload> {
  static constexpr bool kPerLine = true;
  static bool alone(const layer::Payload&) { return true; }
};
template <>
struct ItemStyle<layer::Reference> {
  static constexpr bool kPerLine = true;
  static bool alone(const layer::Reference& item) { return item.custom_data.empty(); }
};

void append_path(std::string& out, Path path) { out += '<' + path.str() + '>'; }

template <class Arc>
void append_target(std::string& out, const Arc& arc) {
  if (!arc.asset_path.empty()) {
    out += asset_path_text(arc.asset_path);
  }
  if (arc.asset_path.empty() || !arc.prim_path.empty()) {
    append_path(out, arc.prim_path);
  }
}

void append_item(std::string& out, std::size_t, Token item) { out += quoted_text(item.view()); }
void append_item(std::string& out, std::size_t, const std::string& item) {
  out += quoted_text(item);
}
void append_item(std::string& out, std::size_t, Path item) { append_path(out, item); }
template <class Int>
  requires std::is_integral_v<Int>
void append_item(std::string& out, std::size_t, Int item) {
  out += std::to_string(item);
}
void append_item(std::string& out, std::size_t, const layer::UnregisteredValue& item) {
  append_field_text(out, layer::Value(item));
}
void append_item(std::string& out, std::size_t, const layer::Payload& item) {
  append_target(out, item);
  append_offset(out, item.offset);
}
void append_item(std::string& out, std::size_t indent, const layer::Reference& item) {
  append_target(out, item);
  if (item.custom_data.empty()) {
    append_offset(out, item.offset);
    return;
  }
  out += " (\n";
  if (item.offset.offset != 0) {
    append_indent(out, indent + 1);
    out += "offset = " + layer_text(item.offset.offset) + '\n';
  }
  if (item.offset.scale != 1) {
    append_indent(out, indent + 1);
    out += "scale = " + layer_text(item.offset.scale) + '\n';
  }
  append_indent(out, indent + 1);
  out += "customData = ";
  append_dictionary(out, item.custom_data, indent + 1, Lines::Many);
  append_indent(out, indent);
  out += ')';
}

template <class T>
void append_items(std::string& out, std::size_t indent, const std::vector<T>& items) {
  using Style = ItemStyle<T>;
  if (items.empty()) {
    out += "None\n";
    return;
  }
  if (items.size() == 1 && Style::alone(items.front())) {
    append_item(out, 0, items.front());
    out += '\n';
    return;
  }
  out += Style::kPerLine ? "[\n" : "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    append_indent(out, Style::kPerLine ? indent + 1 : 0);
    append_item(out, indent + 1, items[i]);
    const bool last = i + 1 == items.size();
    out += last ? "" : Style::kPerLine ? "," : ", ";
    out += Style::kPerLine ? "\n" : "";
  }
  append_indent(out, Style::kPerLine ? indent : 0);
  out += "]\n";
}

template <class T>
bool append_if(std::string& out, std::size_t indent, std::string_view name,
               const layer::Value& value) {
  const auto* op = value.get<ListOp<T>>();
  if (op == nullptr) {
    return false;
  }
  for_each_edit(*op, [&](const char* word, const std::vector<T>& items) {
    append_indent(out, indent);
    out += word;
    out += name;
    out += " = ";
    append_items(out, indent, items);
  });
  return true;
}

}  // namespace

void append_indent(std::string& out, std::size_t indent) { out.append(4 * indent, ' '); }

bool append_list_op(std::string& out, std::size_t indent, std::string_view name,
                    const layer::Value& value) {
  return append_if<Token>(out, indent, name, value) ||
         append_if<std::string>(out, indent, name, value) ||
         append_if<Path>(out, indent, name, value) ||
         append_if<layer::Reference>(out, indent, name, value) ||
         append_if<layer::Payload>(out, indent, name, value) ||
         append_if<std::int32_t>(out, indent, name, value) ||
         append_if<std::uint32_t>(out, indent, name, value) ||
         append_if<std::int64_t>(out, indent, name, value) ||
         append_if<std::uint64_t>(out, indent, name, value) ||
         append_if<layer::UnregisteredValue>(out, indent, name, value);
}

void append_offset(std::string& out, const layer::LayerOffset& offset) {
  if (offset.is_identity()) {
    return;
  }
  out += " (";
  if (offset.offset != 0) {
    out += "offset = " + layer_text(offset.offset);
  }
  if (offset.scale != 1) {
    out += offset.offset != 0 ? "; scale = " : "scale = ";
    out += layer_text(offset.scale);
  }
  out += ')';
}

template <class Name>
void append_names(std::string& out, const std::vector<Name>& names) {
  out += names.size() > 1 ? "[" : "";
  for (std::size_t i = 0; i < names.size(); ++i) {
    out += i > 0 ? ", " : "";
    append_item(out, 0, names[i]);
  }
  out += names.size() > 1 ? "]" : "";
}
template void append_names(std::string&, const std::vector<Token>&);
template void append_names(std::string&, const std::vector<std::string>&);

}  // namespace tenon::formats::text
