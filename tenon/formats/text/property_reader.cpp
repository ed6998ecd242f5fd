// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Several statements may be about one property: its declaration, samples, a spline, connections.
// The first one makes the spec. Each attribute statement repeats the type and has to agree with it,
// so a value is read by its type at once, in any order of statements. Targets are made absolute
// against the owner as they are read. Samples are put in order at their '}', and only when some did
// not ascend. Metadata follows a declaration alone.
#include "tenon/formats/text/property_reader.h"

#include <algorithm>
#include <cmath>

#include "tenon/formats/text/arc_reader.h"
#include "tenon/formats/text/array_edit_reader.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/metadata_reader.h"
#include "tenon/formats/text/value_reader.h"
#include "tenon/layer/expressions/path_expression.h"
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

bool read_optional_metadata(LayerState& state, Path path, SpecKind kind) {
  Cursor& cursor = state.cursor;
  const std::size_t before = cursor.offset();
  cursor.skip_inline();
  if (cursor.accept('(')) {
    return read_metadata(state, path, kind);
  }
  cursor.seek(before);
  return true;
}

// Values

// The type of an attribute as its statement gives it.
struct OwnType {
  const layer::TypeName* type = nullptr;  // null: unknown
  bool is_array = false;
};

// A value of the attribute's type; the source text where the type is unknown. A path is taken
// for any type, as some layers give a connection in that way.
bool read_own_value(Cursor& cursor, const OwnType& own, Value& value) {
  if (cursor.peek() == '<') {
    Path path;
    const bool ok = read_path(cursor, path);
    value = Value(std::vector<Path>{path});
    return ok;
  }
  if (at_array_edit(cursor)) {
    return own.type == nullptr || !own.is_array
               ? cursor.fail_expected("a value of the attribute's type, which is not a known array")
               : read_array_edit(cursor, own.type->type, value);
  }
  if (own.type != nullptr) {
    return read_value(cursor, own.type->type, own.is_array, value);
  }
  std::string text;
  if (!read_source_text(cursor, text)) {
    return false;
  }
  value = Value(layer::UnregisteredValue{Value(std::move(text))});
  return true;
}

// Path expressions are kept in canonical form; those of defaults with absolute paths, but for
// elements that an edit gives.
void settle_expressions(LayerState& state, Value& value, std::size_t start, Path anchor) {
  if (const auto* edit = value.get<layer::ArrayEdit>()) {
    layer::ArrayEdit settled = *edit;
    settle_expressions(state, settled.literals, start, {});
    value = Value(std::move(settled));
  }
  if (value.type() == ValueType::PathExpression && !layer::make_canonical(value, anchor)) {
    state.warn(start, "value.path-expression",
               "this is not a path expression; it is read as an empty one", "");
  }
}

// Puts the samples in order; of equal times the last one counts.
void sort_samples(layer::TimeSamples& samples) {
  std::vector<std::size_t> order(samples.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return samples.times[a] < samples.times[b];
  });
  layer::TimeSamples sorted;
  for (const std::size_t i : order) {
    if (!sorted.empty() && sorted.times.back() == samples.times[i]) {
      sorted.values.back() = std::move(samples.values[i]);
      continue;
    }
    sorted.times.push_back(samples.times[i]);
    sorted.values.push_back(std::move(samples.values[i]));
  }
  samples = std::move(sorted);
}

bool read_time_sample(LayerState& state, const OwnType& own, Path path, layer::TimeSamples& samples,
                      bool& ascending) {
  Cursor& cursor = state.cursor;
  const std::size_t start = cursor.offset();
  double time = 0;
  if (!at_number(cursor)) {
    return cursor.fail_expected("the time of a sample or '}'");
  }
  if (!read_double(cursor, time)) {
    return false;
  }
  if (std::isnan(time)) {
    return cursor.fail_at(start, ErrorCode::Parse, "text.value", "nan is not a time");
  }
  cursor.skip_inline();
  if (!cursor.expect(':', "after the time of a sample")) {
    return false;
  }
  cursor.skip_inline();
  Value value;
  const std::size_t value_start = cursor.offset();
  if (cursor.accept_word("None")) {
    value = layer::ValueBlock{};
  } else if (!read_own_value(cursor, own, value)) {
    return false;
  }
  if (state.sources != nullptr) {
    const std::size_t end = cursor.offset();
    state.sources->samples[path].push_back({time, {start, end}, {value_start, end}});
  }
  settle_expressions(state, value, value_start, {});
  ascending = ascending && (samples.empty() || samples.times.back() < time);
  samples.times.push_back(time);
  samples.values.push_back(std::move(value));
  return true;
}

// `{ time: value, ... }` of the attribute at `path`.
bool read_time_samples(LayerState& state, const OwnType& own, Path path, Value& result) {
  Cursor& cursor = state.cursor;
  if (!cursor.expect('{', "before the time samples")) {
    return false;
  }
  layer::TimeSamples& samples = state.samples_buffer;
  samples.times.clear();
  samples.values.clear();
  bool ascending = true;
  cursor.skip_multi_line();
  const bool ok = cursor.accept('}') || read_items(cursor, '}', "of the time samples", [&] {
                    return read_time_sample(state, own, path, samples, ascending);
                  });
  if (!ok) {
    return false;
  }
  if (!ascending) {
    sort_samples(samples);
  }
  result = Value(layer::TimeSamples(samples));
  return true;
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
    const bool ok = read_statement();
    if (ok && state_.sources != nullptr) {
      statement_.range = {start_, cursor_.offset()};
      state_.sources->properties[path_].push_back(statement_);
    }
    return ok;
  }

 private:
  bool read_statement() {
    start_ = cursor_.offset();
    edit_ = accept_list_edit(cursor_);
    if (edit_ != ListEdit::Explicit && !separator(cursor_)) {
      return false;
    }
    is_custom_ = cursor_.accept_word("custom");
    if (is_custom_ && !separator(cursor_)) {
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
    is_uniform_ = cursor_.accept_word("uniform") || cursor_.accept_word("config");
    if (is_uniform_ && !separator(cursor_)) {
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
    own_ = {written.type, written.is_array};
    if (!make_attribute(type_name_of(written))) {
      return false;
    }
    if (accept_between_blanks(cursor_, '.')) {
      return read_attribute_part();
    }
    if (edit_ != ListEdit::Explicit) {
      return cursor_.fail_expected("`.connect` after a list edit",
                                   "remove the word in front of the attribute");
    }
    const bool ok = (!accept_between_blanks(cursor_, '=') || read_default()) &&
                    read_optional_metadata(state_, path_, SpecKind::Attribute);
    if (ok) {
      state_.share_fields(path_.name(), *spec_);
    }
    return ok;
  }

  bool make_attribute(Token type_name) {
    const Variability variability = is_uniform_ ? Variability::Uniform : Variability::Varying;
    spec_ = &state_.layer.create(path_, SpecKind::Attribute);
    if (spec_->line != 0) {
      return redeclare(*spec_, type_name, variability);
    }
    note_new_property();
    const layer::FieldList& common = state_.attribute_fields(is_custom_, type_name, variability);
    spec_->set_field_list(layer::FieldList(common, 1));
    return true;
  }

  void note_new_property() {
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
    if (is_custom_) {
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
          own_.type == nullptr || own_.is_array ? ValueType::None : own_.type->type;
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
    if (cursor_.accept_word("None")) {
      value = layer::ValueBlock{};
    } else if (cursor_.accept_word("AnimationBlock")) {
      value = layer::AnimationBlock{};
    } else if (!read_own_value(cursor_, own_, value)) {
      return false;
    }
    statement_.value.end = cursor_.offset();
    settle_expressions(state_, value, statement_.value.begin, owner_.strip_variants().prim());
    return set(fields::default_value, std::move(value));
  }

  bool read_samples() {
    Value samples;
    statement_.part = PropertyPart::Samples;
    statement_.value.begin = cursor_.offset();
    const bool ok = read_time_samples(state_, own_, path_, samples);
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
      // Unlike with relationships a variant that only the prim around names is left out.
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
    return edit_ != ListEdit::Explicit ||
           read_optional_metadata(state_, path_, SpecKind::Relationship);
  }

  bool make_relationship() {
    spec_ = &state_.layer.create(path_, SpecKind::Relationship);
    if (spec_->line == 0) {
      note_new_property();
    } else if (spec_->kind != SpecKind::Relationship) {
      return cursor_.fail_at(start_, ErrorCode::Parse, "text.duplicate",
                             "`" + path_.name().str() + "` is already an attribute; it was " +
                                 "declared at line " + std::to_string(spec_->line));
    }
    set(fields::variability, Value(is_varying_ ? Variability::Varying : Variability::Uniform));
    return !is_custom_ || set(fields::custom, Value(true));
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
  bool is_custom_ = false;
  bool is_varying_ = false;
  bool is_uniform_ = false;
  OwnType own_;
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

}  // namespace tenon::formats::text
