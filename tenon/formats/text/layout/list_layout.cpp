// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/layout/list_layout.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

namespace tenon::formats::text {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

/// The items of a list, as ranges of `text`, and the words in front of it.
struct ListItems {
  std::string head;
  std::vector<SourceRange> items;
};

std::string words_of(std::string_view text) {
  std::string words;
  for (const char c : text) {
    const bool blank = kBlanks.find(c) != std::string_view::npos;
    if (!blank || (!words.empty() && words.back() != ' ')) {
      words += blank ? ' ' : c;
    }
  }
  return words;
}

/// Where a text or a path that begins at `at` ends; 0 for anything else.
std::size_t end_of_item(std::string_view text, std::size_t at) {
  const char open = text[at];
  if (open != '"' && open != '\'' && open != '<') {
    return 0;
  }
  const char close = open == '<' ? '>' : open;
  for (std::size_t end = at + 1; end < text.size() && text[end] != '\n'; ++end) {
    if (text[end] == '\\') {
      ++end;
    } else if (text[end] == close) {
      return end + 1;
    }
  }
  return 0;
}

std::optional<ListItems> read_items(std::string_view text) {
  const std::size_t open = text.find('[');
  const std::string_view head = text.substr(0, std::min(open, text.size()));
  if (open == std::string_view::npos || head.find_first_of("\"'<#(") != std::string_view::npos) {
    return std::nullopt;
  }
  ListItems found{words_of(head), {}};
  for (std::size_t at = open + 1; at < text.size();) {
    if (text[at] == ']') {
      const bool last = text.find_first_not_of(kBlanks, at + 1) == std::string_view::npos;
      return last ? std::optional(std::move(found)) : std::nullopt;
    }
    if (text[at] == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (text[at] == ',' || kBlanks.find(text[at]) != std::string_view::npos) {
      ++at;
    } else {
      const std::size_t end = end_of_item(text, at);
      if (end == 0) {
        return std::nullopt;
      }
      found.items.push_back({at, end});
      at = end;
    }
  }
  return std::nullopt;
}

std::string_view part(std::string_view text, SourceRange range) {
  return text.substr(range.begin, range.end - range.begin);
}

}  // namespace

bool edit_list_items(TextPatch& patch, SourceRange statement, const std::string& canonical) {
  const std::string_view text = part(patch.text(), statement);
  const auto old = read_items(text);
  const auto now = read_items(canonical);
  if (!old || !now || old->head != now->head || old->items.empty() || now->items.empty()) {
    return false;
  }
  std::vector<SourceRange> gone;
  std::size_t kept = 0;
  for (const SourceRange item : old->items) {
    const bool stays =
        kept < now->items.size() && part(text, item) == part(canonical, now->items[kept]);
    kept += stays ? 1 : 0;
    if (!stays) {
      gone.push_back(item);
    }
  }
  if (kept == 0 || (kept < now->items.size() && !gone.empty())) {
    return false;
  }
  const auto in_patch = [&](std::size_t at) { return statement.begin + at; };
  for (const SourceRange item : gone) {
    const auto at = std::find_if(old->items.begin(), old->items.end(),
                                 [&](SourceRange one) { return one.begin == item.begin; });
    const bool first = at == old->items.begin();
    patch.replace({in_patch(first ? item.begin : std::prev(at)->end),
                   in_patch(first ? std::next(at)->begin : item.end)},
                  {});
  }
  std::string added;
  for (std::size_t i = kept; i < now->items.size(); ++i) {
    added += ", " + std::string(part(canonical, now->items[i]));
  }
  if (!added.empty()) {
    patch.insert(in_patch(old->items.back().end), std::move(added));
  }
  return true;
}

}  // namespace tenon::formats::text
