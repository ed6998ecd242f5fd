// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Statements in parentheses. A dictionary is changed entry by entry.
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "tenon/formats/text/layout/layout_state.h"
#include "tenon/formats/text/layout/list_layout.h"
#include "tenon/formats/text/metadata_word.h"
#include "tenon/formats/text/text_scanner.h"
#include "tenon/formats/text/write/metadata_writer.h"
#include "tenon/layer/field_values.h"

namespace tenon::formats::text {
namespace {

using layer::Spec;
using layer::SpecKind;
using layer::Value;
namespace fields = layer::fields;

/// The field that a statement is about.
Token field_of(std::string_view statement, SpecKind kind) {
  Scanner scanner(statement, 0);
  std::string_view word = scanner.next();
  if (word.starts_with('"') || word.starts_with('\'')) {
    return fields::comment;
  }
  if (is_list_edit(word)) {
    word = scanner.next();
  }
  return field_of_word(word, kind == SpecKind::PseudoRoot);
}

bool same_field(const Spec& a, const Spec& b, Token field) {
  const Value* x = a.find(field);
  const Value* y = b.find(field);
  if (x == nullptr || y == nullptr) {
    return x == y;
  }
  return *x == *y && (field != fields::subLayers || same_field(a, b, fields::subLayerOffsets));
}

/// Top-level entries of a dictionary: by key, the whole entry and its value.
struct Entry {
  SourceRange range;
  SourceRange value;
};

SourceRange range_in(std::string_view text, std::string_view part) {
  const auto begin = static_cast<std::size_t>(part.data() - text.data());
  return {begin, begin + part.size()};
}

/// Reads the entries from behind the '{' at `open`; false for what is not understood.
bool read_entries(std::string_view text, std::size_t open, std::map<std::string, Entry>& entries) {
  Scanner scanner(text, open + 1);
  while (true) {
    std::string_view word = scanner.next();
    if (word == "}") {
      return true;
    }
    if (word == ";") {
      continue;
    }
    Entry entry;
    entry.range.begin = range_in(text, word).begin;
    std::string_view name;
    while (!word.empty() && word != "=") {  // type, perhaps [ and ], then the name
      name = word;
      word = scanner.next();
    }
    if (word.empty() || name.empty()) {
      return false;
    }
    const std::string_view value = scanner.next();
    if (value.empty()) {
      return false;
    }
    entry.value = range_in(text, value);
    if (value == "{" || value == "[" || value == "(") {
      if (!scanner.skip_block()) {
        return false;
      }
      entry.value.end = scanner.offset();
    } else if (value.front() != '"' && value.front() != '\'' && value.front() != '@') {
      // A number may have signs and points.
      entry.value.end = std::min(text.find_first_of(" \t\r\n;}#", entry.value.begin), text.size());
      scanner = Scanner(text, entry.value.end);
    }
    entry.range.end = entry.value.end;
    std::string key(name);
    if (key.size() > 1 && (key.front() == '"' || key.front() == '\'')) {
      key = key.substr(1, key.size() - 2);
    }
    entries.insert_or_assign(std::move(key), entry);
  }
}

/// Dictionaries and variant selections by entry.
const std::map<std::string, Value, std::less<>>* entries_of(const Value* value,
                                                            layer::Dictionary& buffer) {
  if (value == nullptr) {
    return nullptr;
  }
  if (const auto* dictionary = value->get<layer::Dictionary>()) {
    return &dictionary->items;
  }
  if (const auto* selections = value->get<layer::VariantSelections>()) {
    for (const auto& [set, variant] : selections->items) {
      buffer.items.emplace(set, Value(variant));
    }
    return &buffer.items;
  }
  return nullptr;
}

/// The line of one entry in canonical text.
std::string entry_text(const std::string& key, const Value& value) {
  Spec spec;
  spec.kind = SpecKind::Prim;
  layer::Dictionary one;
  one.items.emplace(key, value);
  spec.set(fields::customData, Value(std::move(one)));
  const std::string text = metadata_field_text(spec, fields::customData);
  const std::size_t start = text.find('\n') + 1;
  return text.substr(start, text.rfind('}') - start);
}

class MetadataLayout {
 public:
  MetadataLayout(LayoutState& state, Path path, const MetadataPlace& place)
      : state_(state),
        patch_(state.patch),
        path_(path),
        place_(place),
        before_(*state.before.find(path)),
        after_(*state.after.find(path)) {}

  void run() {
    const auto block = state_.sources.metadata.find(path_);
    if (block != state_.sources.metadata.end()) {
      block_ = &block->second;
      for (const SourceRange statement : block_->statements) {
        const auto text = patch_.text().substr(statement.begin, statement.end - statement.begin);
        statements_[field_of(text, before_.kind)].push_back(statement);
      }
    }
    const std::set<Token> changed = changed_fields();
    if (!changed.empty() && remove_block()) {
      return;
    }
    for (const Token field : changed) {
      edit_field(field);
    }
    if (!added_.empty()) {
      add();
    }
  }

 private:
  std::set<Token> changed_fields() const {
    std::set<Token> changed;
    for (const Spec* spec : {&before_, &after_}) {
      for (const layer::Field& field : spec->fields()) {
        const Token own = field.name;
        const Token name = own == fields::subLayerOffsets ? fields::subLayers : own;
        if (stands_in_parentheses(name, before_.kind) && !same_field(before_, after_, name)) {
          changed.insert(name);
        }
      }
    }
    return changed;
  }

  /// Takes the parentheses away when nothing is left in them, comments included; false: they stay.
  bool remove_block() {
    const auto stands = [&](const layer::Field& field) {
      return stands_in_parentheses(field.name, after_.kind) && after_.has(field.name);
    };
    const auto left = after_.fields();
    if (block_ == nullptr || block_->statements.empty() ||
        std::any_of(left.begin(), left.end(), stands)) {
      return false;
    }
    const std::string_view text = patch_.text();
    std::size_t at = block_->range.begin + 1;
    for (const SourceRange statement : block_->statements) {
      if (text.substr(at, statement.begin - at).find_first_not_of(" \t\r\n;") != text.npos) {
        return false;
      }
      at = statement.end;
    }
    if (text.substr(at, block_->range.end - 1 - at).find_first_not_of(" \t\r\n;") != text.npos) {
      return false;
    }
    SourceRange range = block_->range;
    if (before_.kind == SpecKind::PseudoRoot) {
      range.end += text.substr(range.end).starts_with('\n') ? 1 : 0;
    } else {
      range.begin = text.find_last_not_of(" \t\r\n", range.begin - 1) + 1;
    }
    patch_.replace(range, {});
    return true;
  }

  std::string lines(const std::string& text) const {
    const std::size_t steps = before_.kind == SpecKind::PseudoRoot ? 1 : 0;
    return reindented(text, statement_indent(), state_.unit, steps);
  }

  std::string statement_indent() const {
    if (block_ != nullptr) {
      for (const SourceRange statement : block_->statements) {
        if (patch_.starts_line(statement.begin)) {
          return patch_.indent_at(statement.begin);
        }
      }
    }
    return patch_.indent_at(place_.statement) + state_.unit;
  }

  void edit_field(Token field) {
    const std::vector<SourceRange>& old = statements_[field];
    const std::string text = metadata_field_text(after_, field);
    if (old.empty()) {
      added_ += lines(text);
      return;
    }
    if (old.size() == 1 && edit_entries(field, old.front())) {
      return;
    }
    for (std::size_t i = text.empty() ? 0 : 1; i < old.size(); ++i) {
      patch_.remove(old[i]);
    }
    if (!text.empty()) {
      std::string by = lines(text);
      by.erase(0, statement_indent().size());
      by.pop_back();
      if (old.size() != 1 || !edit_list_items(patch_, old.front(), by)) {
        patch_.replace(old.front(), by);
      }
    }
  }

  /// Changes a dictionary entry by entry; false where that does not do.
  bool edit_entries(Token field, SourceRange statement) {
    layer::Dictionary before_buffer;
    layer::Dictionary after_buffer;
    const auto* before = entries_of(before_.find(field), before_buffer);
    const auto* after = entries_of(after_.find(field), after_buffer);
    const std::size_t open = patch_.text().find('{', statement.begin);
    std::map<std::string, Entry> places;
    if (before == nullptr || after == nullptr || before->empty() || after->empty() ||
        open >= statement.end || !read_entries(patch_.text(), open, places) ||
        !std::all_of(before->begin(), before->end(),
                     [&](const auto& item) { return places.contains(item.first); })) {
      return false;
    }
    const SourceRange last = last_of(places);
    const std::string indent = patch_.starts_line(last.begin)
                                   ? patch_.indent_at(last.begin)
                                   : patch_.indent_at(statement.begin) + state_.unit;
    for (const auto& [key, value] : *before) {
      if (!after->contains(key)) {
        patch_.remove(places[key].range);
      }
    }
    for (const auto& [key, value] : *after) {
      edit_entry(key, value, *before, places, indent, last);
    }
    return true;
  }

  static SourceRange last_of(const std::map<std::string, Entry>& places) {
    SourceRange last;
    for (const auto& [key, entry] : places) {
      last = entry.range.end > last.end ? entry.range : last;
    }
    return last;
  }

  void edit_entry(const std::string& key, const Value& value,
                  const std::map<std::string, Value, std::less<>>& before,
                  const std::map<std::string, Entry>& places, const std::string& indent,
                  SourceRange last) {
    const auto old = before.find(key);
    if (old != before.end() && old->second == value) {
      return;
    }
    std::string text = reindented(entry_text(key, value), indent, state_.unit, 1);
    if (old == before.end()) {
      patch_.insert_after(last, text);
      return;
    }
    const Entry& place = places.at(key);
    text.erase(0, indent.size());
    text.pop_back();
    if (old->second.type() == value.type() && old->second.is_array() == value.is_array()) {
      patch_.replace(place.value, text.substr(text.find(" = ") + 3));
    } else {
      patch_.replace(place.range, text);
    }
  }

  void add() {
    if (block_ != nullptr && !block_->statements.empty()) {
      patch_.insert_after(block_->statements.back(), added_);
    } else if (block_ != nullptr) {
      patch_.insert_inside(block_->range.begin, added_);
    } else if (before_.kind == SpecKind::PseudoRoot) {
      const bool at_line = patch_.text().substr(place_.head_end).starts_with('\n');
      patch_.insert(place_.head_end + (at_line ? 1 : 0), "(\n" + added_ + ")\n");
    } else {
      patch_.insert(place_.head_end, " (\n" + added_ + patch_.indent_at(place_.statement) + ")");
    }
  }

  LayoutState& state_;
  TextPatch& patch_;
  Path path_;
  MetadataPlace place_;
  const Spec& before_;
  const Spec& after_;
  const MetadataBlock* block_ = nullptr;
  std::map<Token, std::vector<SourceRange>> statements_;
  std::string added_;
};

}  // namespace

void edit_metadata(LayoutState& state, Path path, const MetadataPlace& place) {
  MetadataLayout(state, path, place).run();
}

}  // namespace tenon::formats::text
