// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// The first word of a statement decides. Reserved words are told apart one by one, and the kind of
// the spec says which of them it admits. Any other word names a field: one that is registered is
// read by its type, an unknown one keeps its source text, so that it can be written again. List
// edits of one field add up to one list op, statement by statement. When no source map is wanted,
// reading goes on behind a faulty statement whose end is certain. The fields of a spec are bounded
// by a limit.
#include "tenon/formats/text/metadata_reader.h"

#include "tenon/base/limits/limits.h"
#include "tenon/formats/text/arc_reader.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/formats/text/words.h"
#include "tenon/layer/metadata_fields.h"

namespace tenon::formats::text {
namespace {

using layer::Dictionary;
using layer::SpecKind;
using layer::UnregisteredValue;
using layer::Value;
using layer::ValueType;
namespace fields = layer::fields;

/// One block of metadata.
class MetadataReader {
 public:
  MetadataReader(LayerState& state, Path path, SpecKind kind)
      : state_(state), cursor_(state.cursor), path_(path), kind_(kind) {}

  bool read_item() {
    if (spec().fields().size() >= limits::kSpecFields) {
      return cursor_.fail_at(cursor_.offset(), ErrorCode::Limit, "text.too-many-fields",
                             "<" + path_.str() + "> has more than " +
                                 std::to_string(limits::kSpecFields) + " metadata fields");
    }
    if (at_string(cursor_)) {
      std::string comment;
      return read_string(cursor_, comment) && set(fields::comment, Value(std::move(comment)));
    }
    const std::string_view word = cursor_.peek_identifier();
    if (word.empty()) {
      return fail_item();
    }
    if (!is_reserved_word(word)) {
      return read_field(ListEdit::Explicit);
    }
    const ListEdit edit = accept_list_edit(cursor_);
    if (edit != ListEdit::Explicit) {
      return read_edit(edit);
    }
    return read_special(word);
  }

 private:
  bool is_prim() const { return kind_ == SpecKind::Prim || kind_ == SpecKind::Variant; }
  layer::Spec& spec() { return state_.layer.create(path_, layer::SpecKind::Prim); }
  bool set(Token name, Value value) {
    spec().set(name, std::move(value));
    return true;
  }
  bool fail_item() {
    return cursor_.fail_expected(is_prim() ? "a metadata field, a string or ')'"
                                           : "a metadata field, a comment string or ')'");
  }

  bool read_edit(ListEdit edit) {
    if (!cursor_.accept_separator()) {
      return cursor_.fail_expected("a blank and the name of a field");
    }
    if (is_prim()) {
      bool taken = false;
      if (!read_arc(edit, taken) || taken) {
        return !cursor_.failed();
      }
    }
    return read_field(edit);
  }

  /// The lists that have a grammar of their own.
  bool read_arc(ListEdit edit, bool& taken) {
    taken = true;
    ++state_.arcs;
    if (cursor_.accept_word("references")) {
      return read_references(state_, path_, edit);
    }
    if (cursor_.accept_word("payload")) {
      return read_payload(state_, path_, edit);
    }
    if (cursor_.accept_word("inherits")) {
      return read_prim_paths(state_, path_, fields::inheritPaths, edit);
    }
    if (cursor_.accept_word("specializes")) {
      return read_prim_paths(state_, path_, fields::specializes, edit);
    }
    if (cursor_.accept_word("variantSets")) {
      return read_variant_sets(edit);
    }
    --state_.arcs;
    taken = false;
    return true;
  }

  bool read_special(std::string_view word) {
    if (word == "doc") {
      return read_string_field(fields::documentation);
    }
    if (kind_ == SpecKind::PseudoRoot) {
      if (cursor_.accept_word("subLayers")) {
        return read_sublayers(state_);
      }
      return cursor_.accept_word("relocates") ? read_layer_relocates(state_) : fail_item();
    }
    if (word == "customData" || word == "symmetryArguments") {
      cursor_.advance(word.size());
      return read_value_of(Token(word), ListEdit::Explicit);
    }
    if (word == "permission" || word == "symmetryFunction") {
      return read_word_field(word);
    }
    if (kind_ == SpecKind::Attribute && word == "displayUnit") {
      return read_word_field(word);
    }
    return is_prim() ? read_prim_special(word) : fail_item();
  }

  bool read_prim_special(std::string_view word) {
    if (word == "kind") {
      std::string kind;
      cursor_.advance(word.size());
      return read_assignment(cursor_) && read_string(cursor_, kind) &&
             set(fields::kind, Value(Token(kind)));
    }
    if (word == "variants") {
      cursor_.advance(word.size());
      return read_variant_selections();
    }
    if (word == "prefixSubstitutions" || word == "suffixSubstitutions") {
      cursor_.advance(word.size());
      return read_substitutions(Token(word));
    }
    bool taken = false;
    if (!read_arc(ListEdit::Explicit, taken)) {
      return false;
    }
    return taken || fail_item();
  }

  bool read_string_field(Token field) {
    cursor_.advance(cursor_.peek_identifier().size());
    std::string text;
    return read_assignment(cursor_) && read_string(cursor_, text) &&
           set(field, Value(std::move(text)));
  }

  /// permission, symmetryFunction and displayUnit take a bare word.
  bool read_word_field(std::string_view field) {
    cursor_.advance(field.size());
    if (!read_assignment(cursor_)) {
      return false;
    }
    const std::size_t start = cursor_.offset();
    std::string_view word;
    if (field == "symmetryFunction") {
      const std::string_view next = cursor_.peek_identifier();
      if (!next.empty() && !is_reserved_word(next) && !read_name(cursor_, "a name", word)) {
        return false;
      }
      return set(fields::symmetryFunction, Value(Token(word)));
    }
    if (field == "permission") {
      const bool is_private = cursor_.accept_word("private");
      if (!is_private && !cursor_.accept_word("public")) {
        return cursor_.fail_expected("`public` or `private`");
      }
      return set(fields::permission,
                 Value(is_private ? layer::Permission::Private : layer::Permission::Public));
    }
    if (!read_name(cursor_, "the name of a unit such as cm", word)) {
      return false;
    }
    if (!is_unit_name(word)) {
      return cursor_.fail_at(start, ErrorCode::Parse, "text.value",
                             "`" + std::string(word) + "` is not a unit of measure",
                             "write mm, cm, dm, m, km, in, ft, yd, mi, deg or rad");
    }
    return set(fields::displayUnit, Value(Token(word)));
  }

  bool read_variant_sets(ListEdit edit) {
    if (!read_assignment(cursor_)) {
      return false;
    }
    const std::size_t start = cursor_.offset();
    std::vector<std::string> names;
    if (!read_name_list(cursor_, names)) {
      return false;
    }
    for (const std::string& name : names) {
      if (!is_variant_name(name)) {
        return cursor_.fail_at(start, ErrorCode::Parse, "text.name",
                               "\"" + name + "\" cannot name a variant set");
      }
    }
    if (!check_items(cursor_, start, edit, names)) {
      return false;
    }
    if (edit == ListEdit::Add || edit == ListEdit::Explicit) {
      std::vector<Token> children(names.begin(), names.end());
      for (const Token& name : children) {
        state_.make_spec(path_.variant_selection(name, Token()), SpecKind::VariantSet, start);
      }
      set(fields::variantSetChildren, Value(std::move(children)));
    }
    set_items(spec(), fields::variantSetNames, edit, std::move(names));
    return true;
  }

  bool read_variant_selections() {
    Dictionary dictionary;
    const std::size_t start = cursor_.offset();
    if (!read_assignment(cursor_) || !read_dictionary(cursor_, dictionary)) {
      return false;
    }
    auto selections = spec().get_or(fields::variantSelection, layer::VariantSelections{});
    for (const auto& [set_name, value] : dictionary.items) {
      const auto* variant = value.get<std::string>();
      if (variant == nullptr) {
        return cursor_.fail_at(start, ErrorCode::Parse, "text.value",
                               "the variant of set \"" + set_name + "\" must be a string");
      }
      const bool is_expression =
          variant->size() > 1 && variant->front() == '`' && variant->back() == '`';
      if (!is_expression && !is_variant_name(*variant)) {
        return cursor_.fail_at(start, ErrorCode::Parse, "text.name",
                               "\"" + *variant + "\" cannot name a variant");
      }
      selections.items.insert_or_assign(set_name, *variant);
    }
    return set(fields::variantSelection, Value(std::move(selections)));
  }

  bool read_substitutions(Token field) {
    if (!read_assignment(cursor_) || !cursor_.expect('{', "before the substitutions")) {
      return false;
    }
    Dictionary dictionary;
    cursor_.skip_multi_line();
    const bool ok = cursor_.accept('}') || read_items(cursor_, '}', "of the substitutions", [&] {
                      std::string from;
                      std::string to;
                      if (!read_string(cursor_, from)) {
                        return false;
                      }
                      cursor_.skip_inline();
                      if (!cursor_.expect(':', "between the two strings")) {
                        return false;
                      }
                      cursor_.skip_inline();
                      if (!read_string(cursor_, to)) {
                        return false;
                      }
                      dictionary.items.insert_or_assign(std::move(from), Value(std::move(to)));
                      return true;
                    });
    return ok && set(field, Value(std::move(dictionary)));
  }

  bool read_field(ListEdit edit) {
    std::string_view word;
    if (!read_name(cursor_, "the name of a metadata field", word)) {
      return false;
    }
    return read_value_of(Token(word), edit);
  }

  bool read_value_of(Token name, ListEdit edit) {
    const std::size_t start = cursor_.offset() - name.view().size();
    if (!read_assignment(cursor_)) {
      return false;
    }
    if (edit != ListEdit::Explicit && cursor_.peek() != '[' &&
        cursor_.peek_identifier() != "None") {
      return cursor_.fail_expected("None or '[' after a list edit");
    }
    if (const auto* field = layer::find_metadata_field(name, kind_)) {
      return read_registered(*field, edit, start);
    }
    if (layer::is_structural_field(name, kind_)) {
      return cursor_.fail_at(start, ErrorCode::Parse, "text.field",
                             "`" + name.str() + "` is a field of its own and not metadata");
    }
    return read_unregistered(name, edit);
  }

  bool read_registered(const layer::MetadataField& field, ListEdit edit, std::size_t start) {
    if (field.type == ValueType::TokenListOp) {
      return read_list_op<Token>(field.name, ValueType::Token, edit);
    }
    if (field.type == ValueType::StringListOp) {
      return read_list_op<std::string>(field.name, ValueType::String, edit);
    }
    if (field.type == ValueType::Int64ListOp) {
      return read_list_op<std::int64_t>(field.name, ValueType::Int64, edit);
    }
    if (cursor_.accept_word("None")) {
      return cursor_.fail_at(start, ErrorCode::Parse, "text.value",
                             "`" + field.name.str() + "` cannot be None");
    }
    Value value;
    if (field.type == ValueType::Dictionary || cursor_.peek() == '{') {
      Dictionary dictionary;
      if (!read_dictionary(cursor_, dictionary)) {
        return false;
      }
      value = Value(std::move(dictionary));
    } else if (!read_value(cursor_, field.type, field.is_array, value)) {
      return false;
    }
    if (field.name == fields::framesPerSecond && !(value.get_or(1.0) > 0)) {
      return cursor_.fail_at(start, ErrorCode::Parse, "text.value",
                             "`framesPerSecond` must be above zero");
    }
    return set(field.name, std::move(value));
  }

  template <class T>
  bool read_list_op(Token name, ValueType element, ListEdit edit) {
    const std::size_t start = cursor_.offset();
    Value value;
    std::vector<T> items;
    if (!cursor_.accept_word("None")) {
      if (!read_value(cursor_, element, true, value)) {
        return false;
      }
      const auto& listed = *value.get<layer::Array<T>>();
      items.assign(listed.begin(), listed.end());
      if (items.empty() && edit != ListEdit::Explicit) {
        return cursor_.fail_at(start, ErrorCode::Parse, "text.list",
                               "an empty list can only be set, not added, prepended or deleted",
                               "remove the statement");
      }
    }
    if (has_duplicates(items)) {
      state_.warn(offset_of_item(cursor_.text(), start, first_repeated(items)), "text.list",
                  "`" + name.str() + "` names one item twice; the whole list is ignored",
                  "remove one of the equal items");
      return true;
    }
    set_items(spec(), name, edit, std::move(items));
    return true;
  }

  bool read_unregistered(Token name, ListEdit edit) {
    if (cursor_.peek() == '{') {
      Dictionary dictionary;
      return read_dictionary(cursor_, dictionary) &&
             set(name, Value(UnregisteredValue{Value(std::move(dictionary))}));
    }
    std::string text;
    if (cursor_.accept_word("None")) {
      text = "None";
    } else if (cursor_.peek() == '<') {
      const std::size_t start = cursor_.offset();
      Path path;
      if (!read_path(cursor_, path)) {
        return false;
      }
      text = cursor_.text().substr(start, cursor_.offset() - start);
    } else if (!read_source_text(cursor_, text)) {
      return false;
    }
    if (edit == ListEdit::Explicit) {
      return set(name, Value(UnregisteredValue{Value(std::move(text))}));
    }
    return edit_unregistered(name, edit, text);
  }

  /// An edit of a list of unknown type: its items are kept as one text without the brackets.
  bool edit_unregistered(Token name, ListEdit edit, const std::string& text) {
    layer::ListOp<UnregisteredValue> op;
    if (const auto* old = spec().get<UnregisteredValue>(name)) {
      const auto* old_op = old->value.get<layer::ListOp<UnregisteredValue>>();
      if (old_op == nullptr) {
        return true;  // a plain value was given before: it stays
      }
      op = *old_op;
    }
    std::vector<UnregisteredValue> items;
    if (text != "None") {
      items.push_back({Value(text.substr(1, text.size() - 2))});
    }
    set_items(op, edit, std::move(items));
    return set(name, Value(UnregisteredValue{Value(std::move(op))}));
  }

  LayerState& state_;
  Cursor& cursor_;
  Path path_;
  SpecKind kind_;
};

/// The '(' was taken.
bool read_block(LayerState& state, Path path, SpecKind kind) {
  MetadataReader reader(state, path, kind);
  Cursor& cursor = state.cursor;
  if (state.sources == nullptr) {
    return read_statements(cursor, ')', "of the metadata", [&] {
      const std::size_t start = cursor.offset();
      return reader.read_item() ||
             state.go_on_at(end_of_faulty_statement(cursor.text(), start, cursor.fault(), ')'));
    });
  }
  MetadataBlock block;
  block.range.begin = cursor.offset() - 1;
  const bool ok = read_statements(cursor, ')', "of the metadata", [&] {
    const std::size_t begin = cursor.offset();
    const bool read = reader.read_item();
    block.statements.push_back({begin, cursor.offset()});
    return read;
  });
  block.range.end = cursor.offset();
  state.sources->metadata.insert_or_assign(path, std::move(block));
  return ok;
}

}  // namespace

bool read_metadata(LayerState& state, Path path, SpecKind kind, layer::Spec* made) {
  Cursor& cursor = state.cursor;
  const std::size_t start = cursor.offset();
  if (made != nullptr && state.sources == nullptr) {
    if (const std::size_t length = state.known_metadata.take(cursor.rest(), *made)) {
      cursor.advance(length);
      return true;
    }
  }
  const std::size_t fields_before = made == nullptr ? 0 : made->fields().size();
  const std::size_t arcs = state.arcs;
  const std::size_t warnings = state.warnings;
  const std::size_t faults = state.faults.size();
  cursor.advance();
  if (!read_block(state, path, kind)) {
    return false;
  }
  if (made != nullptr && state.arcs == arcs && state.warnings == warnings &&
      state.faults.size() == faults) {
    state.known_metadata.note(cursor.since(start), *made, fields_before);
  }
  return true;
}

bool read_name_list(Cursor& cursor, std::vector<std::string>& names) {
  if (!cursor.accept('[')) {
    return read_string(cursor, names.emplace_back());
  }
  return read_items(cursor, ']', "of the names",
                    [&] { return read_string(cursor, names.emplace_back()); });
}

}  // namespace tenon::formats::text
