// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Internal to this folder.
namespace tenon::mjcf {

/// Calls `with(section, tag, attribute, value)` for each attribute of a text in turn and replaces
/// the value by its result. `section` is the enclosing element of the first level.
template <class With>
std::string walk_text(std::string_view text, const With& with) {
  std::string out;
  std::string_view section;
  int depth = 0;
  std::size_t at = 0;
  while (true) {
    const std::size_t open = text.find('<', at);
    if (open != std::string_view::npos && text.substr(open).starts_with("<!--")) {
      const std::size_t end = text.find("-->", open);
      const std::size_t behind = end == std::string_view::npos ? text.size() : end + 3;
      out += text.substr(at, behind - at);
      at = behind;
      continue;
    }
    const std::size_t close = open == std::string_view::npos ? open : text.find('>', open);
    if (close == std::string_view::npos) {
      out += text.substr(at);
      return out;
    }
    const std::string_view tag =
        text.substr(open + 1, text.find_first_of(" />\n", open + 2) - open - 1);
    const bool closes = tag.starts_with('/');
    section = depth == 1 && !closes ? tag : section;
    std::size_t from = open;  // what is not copied yet
    out += text.substr(at, open - at);
    for (std::size_t search = open;;) {
      const std::size_t quote = text.substr(0, close).find('"', search);
      const std::size_t end = quote == std::string_view::npos ? quote : text.find('"', quote + 1);
      if (end == std::string_view::npos) {
        break;
      }
      const std::size_t name = text.rfind(' ', quote) + 1;
      out += text.substr(from, quote + 1 - from);
      out += with(section, tag, text.substr(name, quote - 1 - name),
                  text.substr(quote + 1, end - quote - 1));
      from = end;
      search = end + 1;
    }
    out += text.substr(from, close + 1 - from);
    depth += closes ? -1 : text[close - 1] == '/' || tag.starts_with('?') ? 0 : 1;
    at = close + 1;
  }
}

}  // namespace tenon::mjcf
