// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// What goes into parentheses is found by exclusion: all fields that no other part of the text has,
// so that one that no schema knows is not lost. The order is fixed: the comment, then fields by
// name (those of the layer byte by byte, others as in dictionaries), then relocates of the layer.
// Fields whose word differs from their name, or whose value has a grammar of its own, are told
// apart first. All others are `name = value`, or one statement for each edit of a list.
#include "tenon/formats/text/write/metadata_writer.h"

#include <algorithm>

#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/write/dictionary_writer.h"
#include "tenon/formats/text/write/list_writer.h"
#include "tenon/formats/text/write/value_text.h"
#include "tenon/layer/metadata_fields.h"

namespace tenon::formats::text {
namespace {

using layer::Dictionary;
using layer::Field;
using layer::Spec;
using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

bool is_arc_field(Token name) {
  return name == fields::payload || name == fields::references || name == fields::inheritPaths ||
         name == fields::specializes || name == fields::variantSetNames ||
         name == fields::variantSelection;
}

/// True for fields that go into the parentheses: metadata, and fields that no schema knows.
bool stands_in_metadata(Token name, SpecKind kind) {
  const bool is_prim = kind == SpecKind::Prim || kind == SpecKind::Variant;
  if (is_prim && (name == fields::typeName || is_arc_field(name))) {
    return name != fields::typeName;
  }
  return !layer::is_structural_field(name, kind);
}

std::vector<const Field*> metadata_of(const Spec& spec) {
  std::vector<const Field*> found;
  for (const Field& field : spec.fields()) {
    if (stands_in_metadata(field.name, spec.kind)) {
      found.push_back(&field);
    }
  }
  std::sort(found.begin(), found.end(), [](const Field* a, const Field* b) {
    return dictionary_less(a->name.view(), b->name.view());
  });
  return found;
}

void append_comment(std::string& out, const Spec& spec, std::size_t indent) {
  const auto* comment = spec.get<std::string>(fields::comment);
  if (comment != nullptr && !comment->empty()) {
    append_indent(out, indent);
    out += quoted_text(*comment) + '\n';
  }
}

/// `name = value` for all types that need no other grammar.
void append_simple(std::string& out, std::string_view name, const Value& value,
                   std::size_t indent) {
  if (append_list_op(out, indent, name, value)) {
    return;
  }
  const Value* shown = &value;
  if (const auto* unknown = value.get<layer::UnregisteredValue>()) {
    shown = &unknown->value;
    if (append_list_op(out, indent, name, *shown)) {
      return;
    }
  }
  append_indent(out, indent);
  out += name;
  out += " = ";
  if (const auto* dictionary = shown->get<Dictionary>()) {
    append_dictionary(out, *dictionary, indent, Lines::Many);
    return;
  }
  if (const auto* text = shown->get<std::string>(); text != nullptr && shown != &value) {
    out += *text;
  } else if (const auto* truth = shown->get<bool>()) {
    out += *truth ? "true" : "false";
  } else {
    append_value_text(out, *shown);
  }
  out += '\n';
}

void append_substitutions(std::string& out, Token name, const Dictionary& dictionary,
                          std::size_t indent) {
  append_indent(out, indent);
  out += name.str() + " = {\n";
  std::size_t left = dictionary.items.size();
  for (const auto& [from, to] : dictionary.items) {
    --left;
    append_indent(out, indent + 1);
    out += quoted_text(from) + ": " + quoted_text(to.get_or(std::string())) +
           (left > 0 ? ", \n" : "\n");
  }
  append_indent(out, indent);
  out += "}\n";
}

void append_variant_selections(std::string& out, const layer::VariantSelections& selections,
                               std::size_t indent) {
  if (selections.items.empty()) {
    return;
  }
  Dictionary dictionary;
  for (const auto& [set, variant] : selections.items) {
    dictionary.items.emplace(set, Value(variant));
  }
  append_indent(out, indent);
  out += "variants = ";
  append_dictionary(out, dictionary, indent, Lines::Many);
}

void append_variant_set_names(std::string& out, const layer::ListOp<std::string>& op,
                              std::size_t indent) {
  for_each_edit(op, [&](const char* word, const std::vector<std::string>& names) {
    append_indent(out, indent);
    out += std::string(word) + "variantSets = ";
    append_names(out, names);
    out += '\n';
  });
}

/// Bare words after `=`.
void append_word(std::string& out, Token name, std::string_view word, std::size_t indent) {
  append_indent(out, indent);
  out += name.str() + " = " + std::string(word) + '\n';
}

void append_field(std::string& out, const Field& field, std::size_t indent) {
  const Token name = field.name;
  const Value& value = field.value;
  if (name == fields::documentation) {
    append_simple(out, "doc", value, indent);
  } else if (name == fields::symmetryFunction || name == fields::displayUnit) {
    append_word(out, name, value.get_or(Token()).view(), indent);
  } else if (name == fields::inheritPaths) {
    append_list_op(out, indent, "inherits", value);
  } else if (const auto* names = value.get<layer::ListOp<std::string>>();
             names != nullptr && name == fields::variantSetNames) {
    append_variant_set_names(out, *names, indent);
  } else if (const auto* selections = value.get<layer::VariantSelections>()) {
    append_variant_selections(out, *selections, indent);
  } else if (const auto* dictionary = value.get<Dictionary>();
             dictionary != nullptr &&
             (name == fields::prefixSubstitutions || name == fields::suffixSubstitutions)) {
    append_substitutions(out, name, *dictionary, indent);
  } else {
    append_simple(out, name.view(), value, indent);
  }
}

void append_sublayers(std::string& out, const Spec& root, const Field& field) {
  const auto* paths = field.value.get<std::vector<std::string>>();
  if (paths == nullptr) {  // of another type: only a binary file has that
    append_simple(out, field.name.view(), field.value, 1);
    return;
  }
  const auto* offsets = root.get<std::vector<layer::LayerOffset>>(fields::subLayerOffsets);
  out += "    subLayers = [\n";
  for (std::size_t i = 0; i < paths->size(); ++i) {
    out += "        " + asset_path_text((*paths)[i]);
    if (offsets != nullptr && i < offsets->size()) {
      append_offset(out, (*offsets)[i]);
    }
    out += i + 1 < paths->size() ? ",\n" : "\n";
  }
  out += "    ]\n";
}

void append_layer_field(std::string& out, const Spec& root, const Field& field) {
  if (field.name == fields::subLayers) {
    append_sublayers(out, root, field);
  } else if (field.name == fields::documentation) {
    if (!field.value.get_or(std::string()).empty()) {
      append_simple(out, "doc", field.value, 1);
    }
  } else if (field.name == fields::hasOwnedSubLayers) {
    out += field.value.get_or(false) ? "    hasOwnedSubLayers = true\n" : "";
  } else {
    append_simple(out, field.name.view(), field.value, 1);
  }
}

void append_relocates(std::string& out, const layer::Relocates& relocates) {
  out += "    relocates = {\n";
  std::size_t left = relocates.pairs.size();
  for (const auto& [source, target] : relocates.pairs) {
    --left;
    out += "        <" + source.str() + ">: <" + target.str() + (left > 0 ? ">, \n" : ">\n");
  }
  out += "    }\n";
}

}  // namespace

bool is_metadata(const Field& field, SpecKind kind) {
  if (field.name == fields::comment) {
    const auto* comment = field.value.get<std::string>();
    return comment != nullptr && !comment->empty();
  }
  return stands_in_metadata(field.name, kind);
}

bool has_metadata(const Spec& spec) {
  return std::any_of(spec.fields().begin(), spec.fields().end(),
                     [&](const Field& field) { return is_metadata(field, spec.kind); });
}

bool stands_in_parentheses(Token field, SpecKind kind) {
  if (field == fields::comment) {
    return true;
  }
  if (kind == SpecKind::PseudoRoot) {
    return field == fields::subLayers || field == fields::layerRelocates ||
           !layer::is_structural_field(field, kind);
  }
  return stands_in_metadata(field, kind);
}

std::string metadata_field_text(const Spec& spec, Token field) {
  std::string out;
  const Value* value = spec.find(field);
  if (value == nullptr || !stands_in_parentheses(field, spec.kind)) {
    return out;
  }
  const bool is_layer = spec.kind == SpecKind::PseudoRoot;
  if (field == fields::comment) {
    append_comment(out, spec, is_layer ? 1 : 0);
  } else if (const auto* relocates = value->get<layer::Relocates>(); relocates && is_layer) {
    append_relocates(out, *relocates);
  } else if (is_layer) {
    append_layer_field(out, spec, {field, *value});
  } else {
    append_field(out, {field, *value}, 0);
  }
  return out;
}

bool append_metadata(std::string& out, const Spec& spec, std::size_t indent) {
  if (!has_metadata(spec)) {
    return false;
  }
  out += " (\n";
  append_comment(out, spec, indent + 1);
  for (const Field* field : metadata_of(spec)) {
    append_field(out, *field, indent + 1);
  }
  append_indent(out, indent);
  out += ')';
  return true;
}

void append_layer_metadata(std::string& out, const Spec& root) {
  std::vector<const Field*> found;
  for (const Field& field : root.fields()) {
    const bool is_sublayers =
        field.name == fields::subLayers && field.value.holds<std::vector<std::string>>();
    if (is_sublayers || !layer::is_structural_field(field.name, SpecKind::PseudoRoot)) {
      found.push_back(&field);
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Field* a, const Field* b) { return a->name < b->name; });
  std::string lines;
  append_comment(lines, root, 1);
  for (const Field* field : found) {
    append_layer_field(lines, root, *field);
  }
  if (const auto* relocates = root.get<layer::Relocates>(fields::layerRelocates)) {
    append_relocates(lines, *relocates);
  }
  if (!lines.empty()) {
    out += "(\n" + lines + ")\n";
  }
}

}  // namespace tenon::formats::text
