// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/layout/text_patch.h"

#include <algorithm>
#include <utility>

namespace tenon::formats::text {
namespace {

bool is_inline_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::size_t skip_inline_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && is_inline_blank(text[at])) {
    ++at;
  }
  return at;
}

bool is_line_end(std::string_view text, std::size_t at) {
  return at >= text.size() || text[at] == '\n';
}

}  // namespace

void TextPatch::replace(SourceRange range, std::string by) {
  replacements_.push_back({range, std::move(by)});
}

std::size_t TextPatch::line_start(std::size_t at) const {
  const std::size_t newline = at == 0 ? std::string_view::npos : text_.rfind('\n', at - 1);
  return newline == std::string_view::npos ? 0 : newline + 1;
}

bool TextPatch::starts_line(std::size_t at) const {
  return skip_inline_blanks(text_, line_start(at)) >= at;
}

std::string TextPatch::indent_at(std::size_t at) const {
  const std::size_t start = line_start(at);
  return std::string(text_.substr(start, std::min(at, skip_inline_blanks(text_, start)) - start));
}

/// Behind the separator and a comment that may follow a statement; at the end of the line when
/// nothing else follows, else at what follows.
std::size_t TextPatch::skip_rest(std::size_t at, char separator) const {
  std::size_t next = skip_inline_blanks(text_, at);
  if (next < text_.size() && text_[next] == separator) {
    next = skip_inline_blanks(text_, next + 1);
  }
  if (next < text_.size() && (text_[next] == '#' || text_.substr(next, 2) == "//")) {
    next = std::min(text_.find('\n', next), text_.size());
  }
  return next;
}

void TextPatch::remove(SourceRange statement, char separator) {
  const std::size_t after = skip_rest(statement.end, separator);
  if (starts_line(statement.begin) && is_line_end(text_, after)) {
    std::size_t start = line_start(statement.begin);
    if (separator == '\0' && start > 1 && text_.substr(start - 2, 2) == "\n\n") {
      --start;  // the empty line in front of a block
    }
    replace({start, std::min(after + 1, text_.size())}, {});
  } else {
    replace({statement.begin, is_line_end(text_, after) ? statement.end : after}, {});
  }
}

void TextPatch::insert_after(SourceRange statement, const std::string& lines, char separator) {
  const std::size_t after = skip_rest(statement.end, separator);
  if (after < text_.size() && text_[after] == '\n') {
    insert(after + 1, lines);
    return;
  }
  // What follows on the line gets a line of its own.
  insert(after, "\n" + lines + indent_at(statement.begin));
}

void TextPatch::insert_inside(std::size_t bracket, const std::string& lines) {
  insert_after({bracket, bracket + 1}, lines, '\0');
}

std::optional<std::string> TextPatch::result() {
  std::stable_sort(
      replacements_.begin(), replacements_.end(), [](const Replacement& a, const Replacement& b) {
        return std::pair(a.range.begin, a.range.end) < std::pair(b.range.begin, b.range.end);
      });
  std::string out;
  std::size_t at = 0;
  for (const Replacement& replacement : replacements_) {
    if (replacement.range.begin < at || replacement.range.end > text_.size()) {
      return std::nullopt;
    }
    out += text_.substr(at, replacement.range.begin - at);
    out += replacement.by;
    at = replacement.range.end;
  }
  out += text_.substr(at);
  return out;
}

std::string reindented(std::string_view text, const std::string& base, const std::string& unit,
                       std::size_t steps) {
  std::string out;
  bool in_string = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    if (!in_string && line != "\n") {
      std::size_t depth = 0;
      while (line.starts_with("    ")) {
        line.remove_prefix(4);
        ++depth;
      }
      out += base;
      for (std::size_t i = steps; i < depth; ++i) {
        out += unit;
      }
    }
    out += line;
    for (std::size_t at = 0; (at = line.find("\"\"\"", at)) != std::string_view::npos; at += 3) {
      in_string = !in_string;
    }
  }
  return out;
}

}  // namespace tenon::formats::text
