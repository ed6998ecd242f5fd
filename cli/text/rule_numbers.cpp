// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/text/rule_numbers.h"

#include <algorithm>
#include <cctype>

namespace tenon::cli {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
  const std::size_t end = text.find_last_not_of(' ');
  return end == std::string_view::npos ? std::string_view() : text.substr(begin, end + 1 - begin);
}

/// The column of a row, whose columns stand between bars.
std::string_view column(std::string_view row, std::size_t index) {
  for (; index > 0; --index) {
    const std::size_t bar = row.find('|');
    row = bar == std::string_view::npos ? std::string_view() : row.substr(bar + 1);
  }
  return trimmed(row.substr(0, row.find('|')));
}

}  // namespace

bool is_rule_number(std::string_view text) {
  const bool begins =
      text.size() > 2 && std::isalpha(static_cast<unsigned char>(text[0])) != 0 && text[1] == '-';
  return begins && std::all_of(text.begin() + 2, text.end(),
                               [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::optional<std::string> rule_with_number(std::string_view number) {
  if (!is_rule_number(number)) {
    return std::nullopt;
  }
  std::string wanted(number);
  wanted[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(wanted[0])));
  std::string_view table = rule_number_table();
  while (!table.empty()) {
    const std::size_t end = std::min(table.find('\n'), table.size());
    const std::string_view row = table.substr(0, end);
    table.remove_prefix(std::min(end + 1, table.size()));
    if (column(row, 0) == wanted) {
      return std::string(column(row, 3));
    }
  }
  return std::nullopt;
}

}  // namespace tenon::cli
