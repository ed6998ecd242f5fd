// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/block.h"

#include "tenon/base/text/unicode.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/metadata_reader.h"
#include "tenon/formats/text/value_reader.h"

namespace tenon::formats::text {
namespace {

using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

// `Name` or `Name.Name`, with the blank behind it.
bool read_prim_type(Cursor& cursor, std::string& type_name) {
  while (true) {
    std::string_view word;
    if (!read_name(cursor, "the type of the prim or its name in quotes", word)) {
      return false;
    }
    type_name += word;
    const std::size_t after = cursor.offset();
    cursor.skip_inline();
    if (!cursor.accept('.')) {
      cursor.seek(after);
      return cursor.accept_separator() ||
             cursor.fail_expected("a blank and the name of the prim in quotes");
    }
    cursor.skip_inline();
    type_name += '.';
  }
}

bool check_prim_name(Cursor& cursor, std::string_view name, std::size_t offset) {
  return is_identifier(name) || cursor.fail_at(offset, ErrorCode::Parse, "text.name",
                                               "\"" + std::string(name) + "\" cannot name a prim",
                                               "use letters, digits and '_', no digit in front");
}

}  // namespace

std::string block_name(const Block& block) {
  return block.kind == Block::Kind::Prim ? "<" + block.path.str() + ">"
                                         : "the variant (set) <" + block.path.str() + ">";
}

bool read_prim_head(Cursor& cursor, std::string_view specifier_word, PrimHead& head) {
  cursor.advance(specifier_word.size());
  if (!cursor.accept_separator()) {
    return cursor.fail_expected("a blank after `" + std::string(specifier_word) + "`");
  }
  if (!at_string(cursor) && !read_prim_type(cursor, head.type_name)) {
    return false;
  }
  head.name_start = cursor.offset();
  if (!at_string(cursor)) {
    return cursor.fail_expected("the name of the prim in quotes");
  }
  if (!read_string(cursor, head.name) || !check_prim_name(cursor, head.name, head.name_start)) {
    return false;
  }
  head.name_end = cursor.offset();
  return true;
}

bool read_variant_name(Cursor& cursor, std::size_t start, std::string& name) {
  if (!read_string(cursor, name)) {
    return false;
  }
  return is_variant_name(name) ||
         cursor.fail_at(start, ErrorCode::Parse, "text.name",
                        "\"" + name + "\" cannot name a variant or variant set",
                        "use letters, digits, '_', '-' and '|'");
}

bool check_first_variant(Cursor& cursor) {
  const std::size_t inside = cursor.offset();
  cursor.skip_multi_line();
  if (cursor.peek() == '}' && cursor.offset() != inside) {
    return cursor.fail_expected("a variant such as \"name\" { }");
  }
  cursor.seek(inside);
  return true;
}

bool read_block_metadata(LayerState& state, Path path, SpecKind kind, layer::Spec* made) {
  Cursor& cursor = state.cursor;
  cursor.skip_multi_line();
  if (!cursor.failed() && cursor.peek() == '(') {
    if (!read_metadata(state, path, kind, made)) {
      return false;
    }
    cursor.skip_multi_line();
  }
  return !cursor.failed();
}

bool open_brace(Cursor& cursor, Path path, std::size_t start) {
  if (cursor.accept('{')) {
    return true;
  }
  const std::string line = std::to_string(cursor.place_of(start).line);
  return cursor.fail_expected(
      "'{' before the contents of <" + path.str() + ">, declared at line " + line,
      "add '{' and '}' for <" + path.str() + ">");
}

void store_children(LayerState& state, Block& block) {
  layer::Spec& spec = state.layer.create(block.path, SpecKind::Prim);
  if (block.kind == Block::Kind::VariantSet) {
    spec.set(fields::variantChildren, Value(std::move(block.children)));
    return;
  }
  if (!block.children.empty()) {
    spec.set(fields::primChildren, Value(std::move(block.children)));
  }
  if (!block.properties.empty()) {
    spec.set(fields::properties, state.shared_names(block.properties));
    block.properties.clear();
    state.spare_names = std::move(block.properties);
  }
  if (!block.variant_sets.empty()) {
    spec.set(fields::variantSetChildren, Value(std::move(block.variant_sets)));
  }
  if (block.kind == Block::Kind::Prim) {
    state.share_fields(spec.get_or(fields::typeName, Token()), spec);
  }
}

}  // namespace tenon::formats::text
