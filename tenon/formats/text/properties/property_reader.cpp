// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Several statements may be about one property: its declaration, samples, a spline, connections.
// The first one makes the spec. Each attribute statement repeats the type and has to agree with it,
// so a value is read by its type at once, in any order of statements. Targets are made absolute
// against the owner as they are read. Metadata follows a declaration alone. A statement that begins
// as one before it takes over its head, or all its fields (known_attributes.h).
#include "tenon/formats/text/properties/property_reader.h"

#include "tenon/formats/text/arc_reader.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/metadata_reader.h"
#include "tenon/formats/text/properties/own_values.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/layer/written_type_name.h"

namespace tenon::formats::text {
namespace {

using layer::SpecKind;
using layer::Value;
using layer::ValueType;
using layer::Variability;
namespace fields = layer::fields;

/// True for a prim or a property of a prim; the root has no properties.
bool is_target(Path path) {
  return path.is_prim() || (path.is_property() && path.prim().is_prim());
}

/// The name as written; the token of a current name is at hand.
Token type_name_of(const WrittenType& written) {
  if (written.type != nullptr && written.type->scalar_name == written.name) {
    return written.type->name;
  }
  return Token(written.is_array ? std::string(written.name) + "[]" : std::string(written.name));
}

bool separator(Cursor& cursor) {
  return cursor.accept_separator() || cursor.fail_expected("a blank between two words");
}

// Takes `c` with blanks around it.
bool accept_between_blanks(Cursor& cursor, char c) {
  const std::size_t before = cursor.offset();
  cursor.skip_inline();
  if (cursor.accept(c)) {
    cursor.skip_inline();
    return true;
  }
  cursor.seek(before);
  return false;
}

// Targets

// Where one of the items of the list at `start` stands.
std::size_t item_at(const Cursor& cursor, std::size_t start, const Path& item,
                    const std::vector<Path>& items) {
  return offset_of_item(cursor.text(), start, static_cast<std::size_t>(&item - items.data()));
}

bool fail_target(Cursor& cursor, std::size_t start, Path path, std::string_view what) {
  return cursor.fail_at(start, ErrorCode::Parse, "text.target",
                        "<" + path.str() + "> cannot be a target: " + std::string(what) +
                            " and have no variant selections");
}

// `rel name [<path>]` of old layers declares a target without listing it: it has no effect.
bool read_unlisted_target(Cursor& cursor) {
  Path path;
  if (!read_path(cursor, path)) {
    return false;
  }
  cursor.skip_inline();
  return cursor.expect(']', "after the target");
}

// One statement: its words in front, then what follows the name.
class PropertyReader {
 public:
  PropertyReader(LayerState& state, Path owner, std::vector<Token>& properties)
      : state_(state), cursor_(state.cursor), owner_(owner), properties_(properties) {}

  bool read() {
    start_ = cursor_.offset();
    return noted(read_statement());
  }

  bool read_known(KnownAttribute& known) {
    start_ = cursor_.offset();
    return noted(read_known_statement(known));
  }

 private:
  bool noted(bool ok) {
    if (ok && state_.sources != nullptr) {
      statement_.range = {start_, cursor_.offset()};
      state_.sources->properties[path_].push_back(statement_);
    }
    return ok;
  }

  bool read_statement() {
    edit_ = accept_list_edit(cursor_);
    if (edit_ != ListEdit::Explicit && !separator(cursor_)) {
      return false;
    }
    head_.is_custom = cursor_.accept_word("custom");
    if (head_.is_custom && !separator(cursor_)) {
      return false;
    }
    is_varying_ = cursor_.accept_word("varying");
    if (is_varying_ && !separator(cursor_)) {
      return false;
    }
    if (cursor_.accept_word("rel")) {
      return separator(cursor_) && read_relationship();
    }
    if (is_varying_) {
      return cursor_.fail_expected("`rel`", "attributes vary by default: remove `varying`");
    }
    head_.is_uniform = cursor_.accept_word("uniform") || cursor_.accept_word("config");
    if (head_.is_uniform && !separator(cursor_)) {
      return false;
    }
    return read_attribute();
  }

  bool read_property_name() {
    const std::string_view name = cursor_.peek_namespaced();
    if (name.empty()) {
      return cursor_.fail_expected("the name of a property");
    }
    cursor_.advance(name.size());
    path_ = owner_.property(Token(name));
    statement_.name_end = cursor_.offset();
    return true;
  }

  // Attributes

  bool read_attribute() {
    WrittenType written;
    if (!read_type(cursor_, written) || !separator(cursor_) || !read_property_name()) {
      return false;
    }
    head_.own = {written.type, written.is_array};
    head_.type_name = type_name_of(written);
    head_.name = path_.name();
    head_.name_end = statement_.name_end - start_;
    const layer::FieldList& declared =
        state_.attribute_fields(head_.is_custom, head_.type_name, variability());
    if (!make_attribute(declared)) {
      return false;
    }
    if (accept_between_blanks(cursor_, '.')) {
      return read_attribute_part();
    }
    if (edit_ != ListEdit::Explicit) {
      return cursor_.fail_expected("`.connect` after a list edit",
                                   "remove the word in front of the attribute");
    }
    cursor_.skip_inline();
    if (cursor_.accept('=')) {
      return read_assigned(state_.known_attributes.note(cursor_.since(start_), head_, declared));
    }
    cursor_.seek(start_ + head_.name_end);
    if (!read_optional_metadata()) {
      return false;
    }
    state_.share_fields(path_.name(), *spec_);
    return true;
  }

  /// The same for one whose head is known.
  bool read_known_statement(KnownAttribute& known) {
    const std::string_view rest = cursor_.rest();
    head_ = known.head;
    path_ = owner_.property(head_.name);
    statement_.name_end = start_ + head_.name_end;
    if (const layer::FieldList* fields = KnownAttributes::repeated(known, rest)) {
      spec_ = &state_.layer.create(path_, SpecKind::Attribute);
      if (spec_->line == 0) {
        note_new_property();
        spec_->set_field_list(*fields);
        cursor_.advance(known.line.text.size() - 1);
        statement_.value = {start_ + known.line.value_begin, cursor_.offset()};
        return true;
      }
    }
    if (!make_attribute(known.declared)) {
      return false;
    }
    cursor_.advance(known.text.size());
    return read_assigned(&known);
  }

  /// What follows the '=' of a default value.
  bool read_assigned(KnownAttribute* known) {
    const std::size_t warnings = state_.warnings;
    cursor_.skip_inline();
    if (!read_default()) {
      return false;
    }
    const std::size_t end = cursor_.offset();
    if (!read_optional_metadata()) {
      return false;
    }
    const bool means_same_anywhere = head_.own.type != nullptr &&
                                     head_.own.type->type != ValueType::PathExpression &&
                                     state_.warnings == warnings;
    const bool may_come_again =
        known != nullptr && is_new_ && means_same_anywhere && cursor_.offset() == end;
    if (!may_come_again ||
        !KnownAttributes::note_line(*known, cursor_.text().substr(start_), end - start_,
                                    statement_.value.begin - start_, spec_->field_list())) {
      state_.share_fields(path_.name(), *spec_);
    }
    return true;
  }

  bool read_optional_metadata() {
    const std::size_t before = cursor_.offset();
    cursor_.skip_inline();
    if (cursor_.peek() != '(') {
      cursor_.seek(before);
      return true;
    }
    return read_metadata(state_, path_, spec_->kind, is_new_ ? spec_ : nullptr);
  }

  Variability variability() const {
    return head_.is_uniform ? Variability::Uniform : Variability::Varying;
  }

  bool make_attribute(const layer::FieldList& declared) {
    spec_ = &state_.layer.create(path_, SpecKind::Attribute);
    if (spec_->line != 0) {
      return redeclare(*spec_, head_.type_name, variability());
    }
    note_new_property();
    spec_->set_field_list(layer::FieldList(declared, 1));
    return true;
  }

  void note_new_property() {
    is_new_ = true;
    properties_.push_back(path_.name());
    const SourcePlace place = cursor_.place_of(start_);
    spec_->set_place(place.line, place.column);
  }

  /// A further statement about an attribute must agree with the first.
  bool redeclare(layer::Spec& spec, Token type_name, Variability variability) {
    const std::string first = "it was declared at line " + std::to_string(spec.line);
    if (spec.kind != SpecKind::Attribute) {
      return cursor_.fail_at(start_, ErrorCode::Parse, "text.duplicate",
                             "`" + path_.name().str() + "` is already a relationship; " + first);
    }
    const Token old_type = spec.get_or(fields::typeName, Token());
    if (layer::written_type_name(old_type) != layer::written_type_name(type_name)) {
      return cursor_.fail_at(start_, ErrorCode::Parse, "text.duplicate",
                             "`" + path_.name().str() + "` already has type " + old_type.str() +
                                 ", not " + type_name.str() + "; " + first);
    }
    if (spec.get_or(fields::variability, Variability::Varying) != variability) {
      return cursor_.fail_at(
          start_, ErrorCode::Parse, "text.duplicate",
          "`" + path_.name().str() + "` is both uniform and not uniform; " + first);
    }
    if (head_.is_custom) {
      spec.set(fields::custom, Value(true));
    }
    return true;
  }

  bool read_attribute_part() {
    const bool plain = edit_ == ListEdit::Explicit;
    statement_.part = PropertyPart::Other;
    if (cursor_.accept_word("connect")) {
      return read_assignment(cursor_) && read_connections();
    }
    if (plain && cursor_.accept_word("timeSamples")) {
      return read_assignment(cursor_) && read_samples();
    }
    if (plain && cursor_.accept_word("spline")) {
      Value value;
      const ValueType type =
          head_.own.type == nullptr || head_.own.is_array ? ValueType::None : head_.own.type->type;
      return read_assignment(cursor_) && read_spline(cursor_, type, value) &&
             set(fields::spline, std::move(value));
    }
    return cursor_.fail_expected(plain ? "`timeSamples`, `connect` or `spline`" : "`connect`");
  }

  bool set(Token field, Value value) {
    spec_->set(field, std::move(value));
    return true;
  }

  bool read_default() {
    Value value;
    statement_.value.begin = cursor_.offset();
    if (!read_default_value(state_, head_.own, owner_, value)) {
      return false;
    }
    statement_.value.end = cursor_.offset();
    return set(fields::default_value, std::move(value));
  }

  bool read_samples() {
    Value samples;
    statement_.part = PropertyPart::Samples;
    statement_.value.begin = cursor_.offset();
    const bool ok = read_time_samples(state_, head_.own, path_, samples);
    statement_.value.end = cursor_.offset();
    return ok && set(fields::timeSamples, std::move(samples));
  }

  bool read_connections() {
    const std::size_t start = cursor_.offset();
    std::vector<Path> paths;
    if (!read_path_list(cursor_, paths)) {
      return false;
    }
    for (Path& path : paths) {
      // Unlike in relationships, a variant that only the prim around names is removed.
      const Path absolute = target_of(path, owner_).strip_variants();
      if (path.has_variants() || !is_target(absolute)) {
        return fail_target(cursor_, item_at(cursor_, start, path, paths), path,
                           "connections lead to prims or properties");
      }
      path = absolute;
    }
    if (!check_items(cursor_, start, edit_, paths)) {
      return false;
    }
    set_items(*spec_, fields::connectionPaths, edit_, std::move(paths));
    return true;
  }

  // Relationships

  bool read_relationship() {
    if (!read_property_name() || !make_relationship()) {
      return false;
    }
    if (edit_ == ListEdit::Explicit) {
      if (accept_between_blanks(cursor_, '.')) {
        statement_.part = PropertyPart::Other;
        return read_relationship_default();
      }
      if (accept_between_blanks(cursor_, '[')) {
        statement_.part = PropertyPart::Other;
        return read_unlisted_target(cursor_);
      }
    }
    if (accept_between_blanks(cursor_, '=')) {
      statement_.value.begin = cursor_.offset();
      if (!read_targets()) {
        return false;
      }
      statement_.value.end = cursor_.offset();
    }
    if (edit_ != ListEdit::Explicit) {
      statement_.part = PropertyPart::Other;
    }
    return edit_ != ListEdit::Explicit || read_optional_metadata();
  }

  bool make_relationship() {
    spec_ = &state_.layer.create(path_, SpecKind::Relationship);
    if (spec_->line == 0) {
      note_new_property();
      spec_->reserve_fields(head_.is_custom ? 3 : 2);  // with its targets; most have no more
    } else if (spec_->kind != SpecKind::Relationship) {
      return cursor_.fail_at(start_, ErrorCode::Parse, "text.duplicate",
                             "`" + path_.name().str() + "` is already an attribute; it was " +
                                 "declared at line " + std::to_string(spec_->line));
    }
    set(fields::variability, Value(is_varying_ ? Variability::Varying : Variability::Uniform));
    return !head_.is_custom || set(fields::custom, Value(true));
  }

  bool read_targets() {
    const std::size_t start = cursor_.offset();
    std::vector<Path> paths;
    if (!read_path_list(cursor_, paths)) {
      return false;
    }
    for (Path& path : paths) {
      const Path absolute = target_of(path, owner_);
      const bool fits = is_target(absolute) || absolute.kind() == PathKind::Mapper;
      if (absolute.has_variants() || !fits) {
        return fail_target(cursor_, item_at(cursor_, start, path, paths), path,
                           "relationships lead to prims or properties");
      }
      path = absolute;
    }
    if (!check_items(cursor_, start, edit_, paths)) {
      return false;
    }
    set_items(*spec_, fields::targetPaths, edit_, std::move(paths));
    return true;
  }

  bool read_relationship_default() {
    Path path;
    if (!cursor_.accept_word("default")) {
      return cursor_.fail_expected("`default`");
    }
    return read_assignment(cursor_) && read_path(cursor_, path) &&
           set(fields::default_value, Value(std::vector<Path>{path}));
  }

  LayerState& state_;
  Cursor& cursor_;
  Path owner_;
  std::vector<Token>& properties_;
  std::size_t start_ = 0;
  PropertyStatement statement_;
  ListEdit edit_ = ListEdit::Explicit;
  AttributeHead head_;
  bool is_varying_ = false;
  bool is_new_ = false;  // the spec was made by this statement
  Path path_;
  layer::Spec* spec_ = nullptr;
};

}  // namespace

Path target_of(Path path, Path owner) {
  if (path.empty() || path.is_absolute()) {
    return path;
  }
  Path from = owner.prim();
  std::string rest = path.str();
  if (rest == ".") {
    return {};
  }
  while (!from.empty() && rest.starts_with("..")) {
    from = from.parent();
    rest.erase(0, rest.starts_with("../") ? 3 : 2);
  }
  return rest.empty() || from.empty() ? from : Path::from(rest).absolute(from);
}

bool read_property(LayerState& state, Path owner, std::vector<Token>& properties) {
  return PropertyReader(state, owner, properties).read();
}

bool read_known_attribute(LayerState& state, KnownAttribute& known, Path owner,
                          std::vector<Token>& properties) {
  return PropertyReader(state, owner, properties).read_known(known);
}

}  // namespace tenon::formats::text
