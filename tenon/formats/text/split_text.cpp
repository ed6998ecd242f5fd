// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/split_text.h"

#include <algorithm>

namespace tenon::formats::text {
namespace {

/// The first byte of `text` from `at` on that is no blank.
std::size_t skip_blanks(std::string_view text, std::size_t at) {
  while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) {
    ++at;
  }
  return at;
}

bool begins_prim(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at, 6);
  return rest.starts_with("def ") || rest.starts_with("over ") || rest == "class ";
}

/// The byte after the end of the line; the size of the text in its last line.
std::size_t next_line(std::string_view text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  return end == std::string_view::npos ? text.size() : end + 1;
}

}  // namespace

std::size_t find_split(std::string_view text) {
  const std::size_t last = text.size() - text.size() / 4;
  std::size_t line = next_line(text, text.size() / 2);
  while (line < last) {
    const std::size_t word = skip_blanks(text, line);
    if (begins_prim(text, word)) {
      return word;
    }
    line = next_line(text, word);
  }
  return std::string_view::npos;
}

std::vector<std::size_t> prims_around(std::string_view text, std::size_t offset) {
  struct Head {
    std::size_t indentation;
    std::size_t offset;
  };
  std::vector<Head> around;
  const auto leave = [&](std::size_t indentation) {
    while (!around.empty() && around.back().indentation >= indentation) {
      around.pop_back();
    }
  };
  std::size_t line = 0;
  while (true) {
    const std::size_t word = skip_blanks(text, line);
    if (word >= offset) {
      leave(word - line);
      break;
    }
    if (begins_prim(text, word)) {
      leave(word - line);
      around.push_back({word - line, word});
    }
    line = next_line(text, word);
  }
  std::vector<std::size_t> offsets(around.size());
  std::transform(around.begin(), around.end(), offsets.begin(),
                 [](const Head& head) { return head.offset; });
  return offsets;
}

}  // namespace tenon::formats::text
