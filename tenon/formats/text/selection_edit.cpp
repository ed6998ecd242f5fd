// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Edits one dictionary entry in the text of a layer. The scanner knows just enough of the grammar
// to skip what may contain brackets without meaning them: comments, strings and asset paths.
#include "tenon/formats/text/selection_edit.h"

#include <algorithm>

namespace tenon::formats::text {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == ':';
}

class Scanner {
 public:
  Scanner(std::string_view text, std::size_t at) : text_(text), at_(at) {}

  std::size_t at() const { return at_; }
  bool at_end() const { return at_ >= text_.size(); }
  char peek() const { return at_end() ? '\0' : text_[at_]; }

  void skip_blanks_and_comments() {
    while (!at_end() && (is_blank(peek()) || peek() == '#' || starts("//") || starts("/*"))) {
      if (starts("/*")) {
        to_after("*/", 2);
      } else if (is_blank(peek())) {
        ++at_;
      } else {
        at_ = std::min(text_.find('\n', at_), text_.size());
      }
    }
  }

  /// Past the next word, string, asset path or single sign.
  std::string_view next() {
    skip_blanks_and_comments();
    const std::size_t start = at_;
    if (at_end()) {
      return {};
    }
    const char c = peek();
    if (c == '"' || c == '\'') {
      skip_string(c);
    } else if (c == '@') {
      starts("@@@") ? to_after("@@@", 3) : to_after("@", 1);
    } else if (is_word(c)) {
      while (is_word(peek())) {
        ++at_;
      }
    } else {
      ++at_;
    }
    return text_.substr(start, at_ - start);
  }

  /// After an opening bracket was taken: past its partner. False at the end of the text.
  bool skip_block() {
    std::size_t depth = 1;
    while (depth > 0 && !at_end()) {
      const std::string_view token = next();
      depth += token == "(" || token == "{" || token == "[" ? 1u : 0u;
      depth -= token == ")" || token == "}" || token == "]" ? 1u : 0u;
    }
    return depth == 0;
  }

 private:
  bool starts(std::string_view word) const { return text_.substr(at_, word.size()) == word; }
  void to_after(std::string_view end, std::size_t from) {
    const std::size_t found = text_.find(end, at_ + from);
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
  }
  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool triple = starts(three);
    at_ += triple ? 3 : 1;
    while (!at_end()) {
      if (peek() == '\\') {
        at_ += 2;
      } else if (triple ? starts(three) : peek() == quote) {
        at_ += triple ? 3 : 1;
        return;
      } else {
        ++at_;
      }
    }
    at_ = text_.size();
  }

  std::string_view text_;
  std::size_t at_;
};

std::optional<std::size_t> offset_of(std::string_view text, TextPlace place) {
  std::size_t at = 0;
  for (std::uint32_t line = 1; line < place.line; ++line) {
    at = text.find('\n', at);
    if (at == std::string_view::npos) {
      return std::nullopt;
    }
    ++at;
  }
  at += place.column > 0 ? place.column - 1 : 0;
  return at < text.size() ? std::optional(at) : std::nullopt;
}

std::string quoted(std::string_view word) {
  std::string result = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') {
      result += '\\';
    }
    result += c;
  }
  return result + '"';
}

/// Blanks in front of the line that holds `at`.
std::string indent_at(std::string_view text, std::size_t at) {
  const std::size_t newline = text.rfind('\n', at == 0 ? 0 : at - 1);
  std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  std::size_t end = start;
  while (end < text.size() && (text[end] == ' ' || text[end] == '\t')) {
    ++end;
  }
  return std::string(text.substr(start, end - start));
}

std::string replaced(std::string_view text, std::size_t at, std::size_t length,
                     const std::string& by) {
  return std::string(text.substr(0, at)) + by + std::string(text.substr(at + length));
}

/// Inside `variants = {`: replaces the entry of `set` or adds one before the closing brace.
std::optional<std::string> edit_selections(std::string_view text, Scanner scanner,
                                           std::string_view set, std::string_view variant) {
  const std::size_t open = scanner.at();
  while (true) {
    const std::string_view type = scanner.next();
    if (type == "}") {
      break;
    }
    if (type.empty()) {
      return std::nullopt;
    }
    std::string_view name = scanner.next();
    if (name.size() > 1 && (name.front() == '"' || name.front() == '\'')) {
      name = name.substr(1, name.size() - 2);
    }
    if (scanner.next() != "=") {
      return std::nullopt;
    }
    const std::string_view value = scanner.next();
    if (name == set) {
      const auto at = static_cast<std::size_t>(value.data() - text.data());
      return replaced(text, at, value.size(), quoted(variant));
    }
    Scanner after = scanner;
    if (after.next() == ";") {
      scanner = after;
    }
  }
  const std::string indent = indent_at(text, open);
  return replaced(text, open, 0,
                  "\n" + indent + "    string " + std::string(set) + " = " + quoted(variant));
}

/// The token `variants` may be part of `variantSets` lines; only `variants = {` counts.
std::optional<std::string> edit_metadata(std::string_view text, Scanner scanner,
                                         std::string_view set, std::string_view variant) {
  const std::size_t open = scanner.at();
  while (!scanner.at_end()) {
    const std::string_view token = scanner.next();
    if (token == ")") {
      const std::string indent = indent_at(text, open) + "    ";
      return replaced(text, open, 0,
                      "\n" + indent + "variants = {\n" + indent + "    string " + std::string(set) +
                          " = " + quoted(variant) + "\n" + indent + "}");
    }
    if (token == "variants") {
      Scanner inner = scanner;
      if (inner.next() == "=" && inner.next() == "{") {
        return edit_selections(text, inner, set, variant);
      }
    }
    if (token == "(" || token == "{" || token == "[") {
      scanner.skip_block();
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> with_variant_selection(std::string_view text, TextPlace place,
                                                  std::string_view set, std::string_view variant) {
  const auto start = offset_of(text, place);
  if (!start) {
    return std::nullopt;
  }
  Scanner scanner(text, *start);
  std::string_view name = scanner.next();
  while (!name.empty() && name.front() != '"' && name.front() != '\'') {
    if (!is_word(name.front())) {
      return std::nullopt;
    }
    name = scanner.next();
  }
  if (name.empty()) {
    return std::nullopt;
  }
  const std::size_t after_name = scanner.at();
  const std::string_view next = scanner.next();
  if (next == "(") {
    return edit_metadata(text, scanner, set, variant);
  }
  const std::string indent = indent_at(text, *start);
  return replaced(text, after_name, 0,
                  " (\n" + indent + "    variants = {\n" + indent + "        string " +
                      std::string(set) + " = " + quoted(variant) + "\n" + indent + "    }\n" +
                      indent + ")");
}

}  // namespace tenon::formats::text
