// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/structure/xml_note.h"

#include "tenon/structure/digest_text.h"

namespace tenon::structure {
namespace {

constexpr std::string_view kBegin = "<!-- written by tenon; digests of the files as they were\n";
constexpr std::string_view kEnd = "-->\n";
constexpr std::string_view kHex = "0123456789abcdef";

/// A name as allowed in a comment, which two hyphens would end, on one line.
std::string escaped(std::string_view name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool ends_comment = c == '-' && text.ends_with('-');
    if (c == '%' || byte < 0x20 || byte == 0x7f || ends_comment) {
      text += {'%', kHex[byte >> 4], kHex[byte & 0xfu]};
    } else {
      text += c;
    }
  }
  return text;
}

std::string unescaped(std::string_view text) {
  std::string name;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t high =
        text[i] == '%' && i + 2 < text.size() ? kHex.find(text[i + 1]) : std::string_view::npos;
    const std::size_t low =
        high != std::string_view::npos ? kHex.find(text[i + 2]) : std::string_view::npos;
    if (low != std::string_view::npos) {
      name += static_cast<char>(high * 16 + low);
      i += 2;
    } else {
      name += text[i];
    }
  }
  return name;
}

/// What each line of the note begins with: nothing in XML, a mark of comments in Python, whose
/// files begin with the text that describes them. None for other text.
std::optional<std::string_view> line_start(std::string_view text) {
  if (text.starts_with('<')) {
    return "";
  }
  return text.starts_with("\"\"\"") ? std::optional<std::string_view>("# ") : std::nullopt;
}

}  // namespace

bool holds_xml_note(std::string_view text) { return line_start(text).has_value(); }

std::string with_xml_note(std::string text, const std::map<std::string, std::uint64_t>& others) {
  text += text.ends_with('\n') ? "" : "\n";
  const std::string start(line_start(text).value_or(""));
  text += start + std::string(kBegin) + start + hex_of(0) + "\n";
  for (const auto& [name, digest] : others) {
    text += start + hex_of(digest) + " " + escaped(name) + "\n";
  }
  return text += start + std::string(kEnd);
}

std::optional<XmlNote> xml_note_of(std::string_view text) {
  const std::size_t begin = text.rfind(kBegin);
  const std::optional<std::string_view> start = line_start(text);
  if (!start || begin == std::string_view::npos ||
      !text.ends_with(std::string(*start) + std::string(kEnd))) {
    return std::nullopt;
  }
  XmlNote note;
  const std::size_t first_line = begin + kBegin.size();
  note.own_at = first_line + start->size();
  const std::size_t behind = text.size() - kEnd.size() - start->size();
  std::string_view lines = behind < first_line ? "" : text.substr(first_line, behind - first_line);
  for (bool first = true; first || !lines.empty(); first = false) {
    if (!lines.starts_with(*start)) {
      return std::nullopt;
    }
    lines.remove_prefix(start->size());
    const std::size_t end = lines.find('\n');
    const auto digest = digest_from(lines.substr(0, kDigestDigits));
    if (end == std::string_view::npos || !digest || (end == kDigestDigits) != first) {
      return std::nullopt;
    }
    if (!first && lines[kDigestDigits] != ' ') {
      return std::nullopt;
    }
    if (first) {
      note.own = *digest;
    } else {
      note.others[unescaped(lines.substr(kDigestDigits + 1, end - kDigestDigits - 1))] = *digest;
    }
    lines.remove_prefix(end + 1);
  }
  return note;
}

}  // namespace tenon::structure
