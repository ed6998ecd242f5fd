// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Statements are split without their meaning. The text is known to be a layer's, so the shape is
// enough: the last word before '.', '=' or the end is a property's name and the one before it its
// type, whatever words come before. A value is one literal, or everything up to the partner of its
// opening bracket. An entry that begins with a number or a path has its key before ':', another one
// has the last token before '='. What does not look like a statement gives nothing.
#include "tenon/formats/text/layout/statement_text.h"

#include <algorithm>

#include "tenon/formats/text/literals.h"
#include "tenon/formats/text/metadata_word.h"
#include "tenon/formats/text/text_scanner.h"

namespace tenon::formats::text {
namespace {

bool is_string(std::string_view token) {
  return !token.empty() && (token.front() == '"' || token.front() == '\'');
}

SourceRange range_of(std::string_view text, std::string_view token) {
  const auto begin = static_cast<std::size_t>(token.data() - text.data());
  return {begin, begin + token.size()};
}

/// Past blanks, tabs and comments within a line.
std::size_t skip_inline(std::string_view text, std::size_t at) {
  Cursor cursor(text, {});
  cursor.seek(at);
  cursor.skip_inline();
  return cursor.offset();
}

std::size_t metadata_after(std::string_view text, std::size_t end, bool on_any_line) {
  Scanner scanner(text, end);
  if (on_any_line) {
    scanner.skip_blanks_and_comments();
  } else {
    scanner = Scanner(text, skip_inline(text, end));
  }
  return scanner.peek() == '(' ? scanner.offset() : kNowhere;
}

/// A path at the scanner, which stands before '<'.
void skip_path(std::string_view text, Scanner& scanner) {
  const std::size_t close = text.find('>', scanner.offset());
  scanner = Scanner(text, close == kNowhere ? text.size() : close + 1);
}

/// The words in front of a property's value.
struct Words {
  std::vector<SourceRange> words;
  std::string_view suffix;
  std::size_t end = 0;
};

Words take_words(std::string_view text, std::size_t offset) {
  constexpr std::size_t kMaxWords = 6;  // an edit, custom, uniform, the type, the name, a suffix
  Words found;
  bool is_suffix = false;
  std::size_t at = offset;
  while (found.words.size() <= kMaxWords && at < text.size()) {
    const std::size_t begin = at;
    if (Scanner::is_word(text[at])) {
      at = static_cast<std::size_t>(std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                     text.end(), Scanner::is_word) -
                                    text.begin());
      if (is_suffix) {
        found.suffix = text.substr(begin, at - begin);
        found.end = at;
        break;
      }
      found.words.push_back({begin, at});
      found.end = at;
    } else if (text.substr(at, 2) == "[]" && !found.words.empty()) {
      at += 2;
      found.words.back().end = found.end = at;
    } else if (text[at] == '.' && !found.words.empty()) {
      is_suffix = true;
      ++at;
    } else {
      break;
    }
    at = skip_inline(text, at);
  }
  return found;
}

}  // namespace

std::string unquoted(std::string_view text) {
  Cursor cursor(text, {});
  std::string value;
  return is_string(text) && read_string(cursor, value) ? value : std::string(text);
}

std::optional<StatementText> block_statement(std::string_view text, std::size_t offset) {
  Scanner scanner(text, offset);
  StatementText found;
  found.range.begin = offset;
  std::string_view token = scanner.next();
  if (token == "def" || token == "over" || token == "class" || token == "variantSet") {
    token = scanner.next();
    if (!token.empty() && Scanner::is_word(token.front())) {
      found.type = range_of(text, token);
    }
    while (!token.empty() && (Scanner::is_word(token.front()) || token == ".")) {
      found.type.end = range_of(text, token).end;
      token = scanner.next();
    }
  }
  if (!is_string(token)) {
    return std::nullopt;
  }
  found.name = unquoted(token);
  found.range.end = scanner.offset();
  found.metadata = metadata_after(text, scanner.offset(), true);
  return found;
}

std::optional<StatementText> property_statement(std::string_view text, std::size_t offset) {
  const Words words = take_words(text, offset);
  if (words.words.empty()) {
    return std::nullopt;
  }
  const auto at = [&](SourceRange range) {
    return text.substr(range.begin, range.end - range.begin);
  };
  StatementText found;
  found.range = {offset, words.end};
  found.name = at(words.words.back());
  found.suffix = words.suffix;
  const std::string_view first = at(words.words.front());
  found.takes_away = first == "delete" || first == "reorder";
  if (words.words.size() > 1 && at(words.words[words.words.size() - 2]) != "rel") {
    found.type = words.words[words.words.size() - 2];
  }
  const std::size_t equals = skip_inline(text, words.end);
  if (equals < text.size() && text[equals] == '=') {
    Scanner scanner(text, equals + 1);
    found.value = take_value(text, scanner);
    found.range.end = std::max(found.value.end, found.range.end);
  }
  found.metadata = metadata_after(text, found.range.end, false);
  return found;
}

std::size_t layer_metadata(std::string_view text) { return metadata_after(text, 0, true); }

std::size_t end_of(std::string_view text, const StatementText& statement) {
  if (statement.metadata == kNowhere) {
    return statement.range.end;
  }
  Scanner scanner(text, statement.metadata + 1);
  scanner.skip_block();
  return scanner.offset();
}

std::optional<MetadataText> take_metadata(std::string_view text, Scanner& scanner) {
  std::string_view token = scanner.next();
  while (token == ";") {
    token = scanner.next();
  }
  if (token.empty() || token == ")") {
    return std::nullopt;
  }
  MetadataText found;
  found.range = range_of(text, token);
  if (is_string(token)) {
    found.value = found.range;
    return found;
  }
  found.takes_away = token == "delete" || token == "reorder";
  if (is_list_edit(token)) {
    token = scanner.next();
  }
  found.word = token;
  if (token.empty() || !Scanner::is_word(token.front()) || scanner.next() != "=") {
    return std::nullopt;
  }
  found.value = take_value(text, scanner);
  if (found.value.begin == found.value.end) {
    return std::nullopt;
  }
  const std::size_t parameters = metadata_after(text, found.value.end, false);
  if (parameters != kNowhere) {
    scanner = Scanner(text, parameters + 1);
    scanner.skip_block();
  }
  found.range.end = scanner.offset();
  return found;
}

std::optional<EntryText> take_entry(std::string_view text, Scanner& scanner) {
  scanner.skip_blanks_and_comments();
  while (scanner.peek() == ',' || scanner.peek() == ';') {
    scanner.next();
    scanner.skip_blanks_and_comments();
  }
  EntryText found;
  found.range.begin = scanner.offset();
  const char c = scanner.peek();
  if (scanner.at_end() || c == '}') {
    return std::nullopt;
  }
  if (c == '<' || c == '-' || c == '+' || c == '.' || (c >= '0' && c <= '9')) {
    if (c == '<') {
      skip_path(text, scanner);
    }
    const std::size_t colon = text.find(':', scanner.offset());
    found.key =
        text.substr(found.range.begin, (c == '<' ? scanner.offset() : colon) - found.range.begin);
    if (colon == kNowhere) {
      return std::nullopt;
    }
    scanner = Scanner(text, colon + 1);
  } else {
    std::string_view name;
    std::string_view token = scanner.next();
    while (!token.empty() && token != "=" && token != "}") {  // the type, [ and ], the name
      name = token;
      token = scanner.next();
    }
    if (token != "=") {
      return std::nullopt;
    }
    found.key = unquoted(name);
  }
  found.value = take_value(text, scanner);
  found.range.end = found.value.end;
  return found.value.begin == found.value.end ? std::nullopt : std::optional(found);
}

SourceRange take_value(std::string_view text, Scanner& scanner) {
  scanner.skip_blanks_and_comments();
  const std::size_t begin = scanner.offset();
  const char c = scanner.peek();
  if (c == '[' || c == '(' || c == '{') {
    scanner.next();
    scanner.skip_block();
  } else if (c == '"' || c == '\'') {
    scanner.next();
  } else if (c == '<') {
    skip_path(text, scanner);
  } else if (c == '@') {
    scanner.next();
    const std::size_t path = skip_inline(text, scanner.offset());
    if (path < text.size() && text[path] == '<') {
      scanner = Scanner(text, path);
      skip_path(text, scanner);
    }
  } else {
    const std::size_t end = text.find_first_of(" \t\r\n;,()[]{}#", begin);
    scanner = Scanner(text, std::min(end, text.size()));
  }
  return {begin, scanner.offset()};
}

std::size_t offset_of_item(std::string_view text, std::size_t begin, std::size_t number) {
  if (begin >= text.size() || text[begin] != '[') {
    return begin;
  }
  Scanner scanner(text, begin + 1);
  auto item = take_item(text, scanner);
  for (; item && number > 0; --number) {
    item = take_item(text, scanner);
  }
  return item ? item->begin : begin;
}

std::optional<SourceRange> take_item(std::string_view text, Scanner& scanner) {
  scanner.skip_blanks_and_comments();
  const SourceRange item = take_value(text, scanner);
  if (item.begin == item.end) {
    return std::nullopt;
  }
  scanner.skip_blanks_and_comments();
  if (scanner.peek() == '(') {
    scanner.next();
    scanner.skip_block();
    scanner.skip_blanks_and_comments();
  }
  if (scanner.peek() == ',') {
    scanner.next();
  }
  return item;
}

}  // namespace tenon::formats::text
