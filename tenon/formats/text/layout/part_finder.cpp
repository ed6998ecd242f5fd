// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A finding names a field, keys and an item of a spec. They are looked for in the text from the
// outside in, and each step compares the text there with the part wanted. Where that fails, the
// range around it is the answer. Statement, field and items of the last question are kept, with the
// items by their text, so that a list that is asked about item by item is scanned once. The bytes
// looked at count against a bound that grows with the text. When it is used up, nothing is found
// any more.
#include "tenon/formats/text/layout/part_finder.h"

#include <algorithm>
#include <cstdlib>

#include "tenon/base/limits/fault_limits.h"
#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/metadata_word.h"
#include "tenon/formats/text/properties/property_reader.h"

namespace tenon::formats::text {
namespace {

namespace fields = layer::fields;

bool is_opening_word(std::string_view word) {
  return word == "def" || word == "over" || word == "class" || word == "variantSet" ||
         word.starts_with('"') || word.starts_with('\'');
}

/// The suffix of the statements that give a property this field; nothing for metadata.
std::optional<std::string_view> suffix_of(std::string_view field) {
  if (field == "default" || field == "targetPaths") {
    return "";
  }
  if (field == "connectionPaths") {
    return "connect";
  }
  return field == "timeSamples" || field == "spline" ? std::optional(field) : std::nullopt;
}

/// The keys of samples are numbers, written in many ways.
bool is_key(const std::string& written, const std::string& key) {
  if (written == key) {
    return true;
  }
  char* end = nullptr;
  char* key_end = nullptr;
  const double a = std::strtod(written.c_str(), &end);
  const double b = std::strtod(key.c_str(), &key_end);
  return end != written.c_str() && key_end != key.c_str() && *key_end == '\0' && a == b;
}

std::optional<StatementText> statement_of(std::string_view text, std::size_t offset, Path spec) {
  auto found =
      spec.is_property() ? property_statement(text, offset) : block_statement(text, offset);
  const Token name =
      spec.is_variant_selection() && !spec.variant().empty() ? spec.variant() : spec.name();
  return found && found->name == name.view() ? found : std::nullopt;
}

}  // namespace

PartFinder::PartFinder(std::string_view text)
    : text_(text), work_left_(limits::kPlaceWork + limits::kPlaceWorkPerByte * text.size()) {}

std::optional<SourceRange> PartFinder::find(std::size_t offset, const StatementPart& part) {
  spec_ = Path::from(part.spec);
  if (work_left_ == 0 || spec_.empty() || offset > text_.size()) {
    return std::nullopt;
  }
  const std::optional<StatementText>& first = statement_at(offset);
  if (!first) {
    return std::nullopt;
  }
  const auto or_nothing = [](SourceRange range) {
    return range.begin == range.end ? std::nullopt : std::optional(range);
  };
  if (part.field.empty()) {
    return or_nothing(first->range);
  }
  if (part.field == fields::typeName.view() && first->type.end != 0) {
    return first->type;
  }
  const FieldText& field = field_text(*first, part);
  if (field.values.empty()) {
    return or_nothing(first->range);
  }
  return part.keys.empty() && part.item.empty() && part.index == 0 ? field.statements.front()
                                                                   : find_entry(field, part);
}

const std::optional<StatementText>& PartFinder::statement_at(std::size_t offset) {
  if (last_.spec == spec_.str() && last_offset_ == offset && last_statement_) {
    return last_statement_;
  }
  last_ = {spec_.str(), {}};
  last_offset_ = offset;
  last_statement_.reset();
  if (spec_.is_absolute_root()) {
    last_statement_.emplace().metadata = layer_metadata(text_);
  } else {
    last_statement_ = statement_of(text_, offset, spec_);
  }
  spend(last_statement_ ? last_statement_->range.end - last_statement_->range.begin : 1);
  return last_statement_;
}

const PartFinder::FieldText& PartFinder::field_text(const StatementText& first,
                                                    const StatementPart& part) {
  if (last_.spec == part.spec && last_.field == part.field) {
    return last_;
  }
  last_ = {part.spec, part.field};
  if (spec_.is_property() && suffix_of(part.field)) {
    add_property_values(first, last_);
  } else if (first.metadata != kNowhere) {
    add_metadata_values(first.metadata, last_);
  }
  if (part.keys.empty()) {
    for (const SourceRange value : last_.values) {
      add_items(value, last_);
    }
  }
  return last_;
}

void PartFinder::add_property_values(const StatementText& first, FieldText& found) {
  const std::string_view suffix = *suffix_of(found.field);
  FieldText taken;
  for (auto statement = std::optional(first); statement; statement = next_about(*statement)) {
    if (statement->suffix == suffix && statement->value.end != 0) {
      FieldText& to = statement->takes_away ? taken : found;
      to.statements.push_back(statement->range);
      to.values.push_back(statement->value);
    }
    if (!found.values.empty() && found.field != "targetPaths" && suffix != "connect") {
      break;  // only lists are edited by several statements
    }
  }
  found.statements.insert(found.statements.end(), taken.statements.begin(), taken.statements.end());
  found.values.insert(found.values.end(), taken.values.begin(), taken.values.end());
}

std::optional<StatementText> PartFinder::next_about(const StatementText& statement) {
  Scanner scanner(text_, end_of(text_, statement));
  while (work_left_ > 0) {
    const std::size_t begin = scanner.offset();
    scanner.skip_blanks_and_comments();
    const std::size_t start = scanner.offset();
    std::string_view token = scanner.next();
    if (token.empty() || token == "}") {
      break;
    }
    if (is_opening_word(token)) {
      while (!token.empty() && token != "{") {
        token = scanner.next();
        if (token == "(") {
          scanner.skip_block();
        }
      }
      scanner.skip_block();
    } else if (token != ";") {
      const auto found = property_statement(text_, start);
      if (!found) {
        break;
      }
      spend(found->range.end - begin);
      if (found->name == spec_.name().view()) {
        return found;
      }
      scanner = Scanner(text_, end_of(text_, *found));
    }
    spend(scanner.offset() - begin);
  }
  return std::nullopt;
}

void PartFinder::add_metadata_values(std::size_t open, FieldText& found) {
  Scanner scanner(text_, open + 1);
  FieldText taken;
  while (const auto statement = take_metadata(text_, scanner)) {
    spend(statement->range.end - statement->range.begin);
    const Token field = statement->word.empty()
                            ? fields::comment
                            : field_of_word(statement->word, spec_.is_absolute_root());
    if (field.view() == found.field) {
      FieldText& to = statement->takes_away ? taken : found;
      to.statements.push_back(statement->range);
      to.values.push_back(statement->value);
    }
  }
  found.statements.insert(found.statements.end(), taken.statements.begin(), taken.statements.end());
  found.values.insert(found.values.end(), taken.values.begin(), taken.values.end());
}

void PartFinder::add_items(SourceRange value, FieldText& found) {
  const auto add = [&](SourceRange item) {
    found.items.push_back(item);
    found.by_text.emplace(item_text(item), item);
  };
  spend(value.end - value.begin);
  Scanner scanner(text_, value.begin + 1);
  const char opening = char_at(value.begin);
  if (opening == '[') {
    while (const auto item = take_item(text_, scanner)) {
      add(*item);
    }
  } else if (opening == '{') {
    while (const auto entry = take_entry(text_, scanner)) {
      found.items.push_back(entry->range);
      found.by_text.emplace(item_text({entry->range.begin, entry->range.begin + entry->key.size()}),
                            entry->range);
    }
  } else {
    add(value);
  }
}

SourceRange PartFinder::find_entry(const FieldText& field, const StatementPart& part) {
  SourceRange best = field.statements.front();
  SourceRange value = field.values.front();
  for (const std::string& key : part.keys) {
    std::optional<EntryText> entry;
    Scanner scanner(text_, value.begin + 1);
    if (char_at(value.begin) == '{') {
      while ((entry = take_entry(text_, scanner)) && !is_key(entry->key, key)) {
      }
    }
    spend(scanner.offset() - value.begin);
    if (!entry) {
      return best;
    }
    best = entry->range;
    value = entry->value;
  }
  FieldText within;
  if (!part.keys.empty() && (!part.item.empty() || part.index != 0)) {
    add_items(value, within);
  }
  const FieldText& list = part.keys.empty() ? field : within;
  if (part.index != 0 && part.index <= list.items.size()) {
    return list.items[part.index - 1];
  }
  const auto found = list.by_text.find(part.item);
  return found == list.by_text.end() || part.item.empty() ? best : found->second;
}

std::string PartFinder::item_text(SourceRange item) const {
  const std::string_view text = text_.substr(item.begin, item.end - item.begin);
  if (text.empty() || (text.front() != '@' && text.front() != '<')) {
    return unquoted(text);
  }
  Cursor cursor(text, {});
  std::string found;
  if (text.front() == '@') {
    std::string asset;
    if (!read_asset_path(cursor, asset)) {
      return std::string(text);
    }
    found = "@" + asset + "@";
    cursor.skip_inline();
  }
  Path path;
  if (cursor.peek() == '<' && read_path(cursor, path)) {
    const Path absolute =
        spec_.is_property() ? target_of(path, spec_.parent()) : path.absolute(spec_.prim());
    found += "<" + absolute.str() + ">";
  }
  return found;
}

}  // namespace tenon::formats::text
