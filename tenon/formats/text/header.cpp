// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/text/header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>

#include "tenon/base/text/shown_path.h"
#include "tenon/base/text/unicode.h"
#include "tenon/formats/foreign_format.h"

namespace tenon::formats::text {
namespace {

constexpr unsigned kMajor = 1;
constexpr unsigned kMaxMinor = 4;

/// Offset of the first byte that is no UTF-8; the size of `text` when there is none. Where there is
/// more than ASCII, characters are looked at one by one.
std::size_t first_ill_formed(std::string_view text) {
  std::array<std::uint64_t, 8> words{};
  std::size_t at = 0;
  while (at < text.size()) {
    if (at + sizeof(words) <= text.size()) {
      std::memcpy(words.data(), text.data() + at, sizeof(words));
      std::uint64_t all = 0;
      for (const std::uint64_t word : words) {
        all |= word;
      }
      if ((all & 0x8080808080808080ull) == 0) {
        at += sizeof(words);
        continue;
      }
    }
    const std::size_t end = std::min(at + sizeof(words), text.size());
    while (at < end) {
      const bool ascii = static_cast<unsigned char>(text[at]) < 0x80;
      const std::size_t length = ascii ? 1 : unicode::decode(text.substr(at)).length;
      if (length == 0) {
        return at;
      }
      at += length;
    }
  }
  return at;
}

bool check_encoding(Cursor& cursor) {
  const std::string_view text = cursor.text();
  constexpr std::string_view kFix = "save the file as UTF-8 without a byte order mark";
  const std::string_view head = text.substr(0, 2);
  if (text.substr(0, 3) == "\xEF\xBB\xBF" || head == "\xFE\xFF" || head == "\xFF\xFE") {
    return cursor.fail_at(0, ErrorCode::Parse, "text.encoding",
                          "the text starts with a byte order mark", kFix);
  }
  const std::size_t bad = first_ill_formed(text);
  return bad == text.size() ||
         cursor.fail_at(bad, ErrorCode::Parse, "text.encoding", "this byte is not UTF-8", kFix);
}

/// Reads "1.0" or "1.0.32"; false when the text has another form.
bool parse_version(std::string_view text, unsigned& major, unsigned& minor) {
  unsigned parts[3] = {0, 0, 0};
  const char* at = text.data();
  const char* const end = at + text.size();
  int count = 0;
  while (count < 3) {
    const auto result = std::from_chars(at, end, parts[count]);
    if (result.ec != std::errc{} || parts[count] > 255) {
      return false;
    }
    ++count;
    at = result.ptr;
    if (at == end) {
      break;
    }
    if (*at != '.') {
      return false;
    }
    ++at;
  }
  major = parts[0];
  minor = parts[1];
  return count >= 2 && at == end;
}

}  // namespace

bool read_header(LayerState& state) {
  Cursor& cursor = state.cursor;
  const std::string_view text = cursor.text();
  if (const ForeignFormat foreign = foreign_format(text); foreign != ForeignFormat::None) {
    return cursor.fail_at(0, ErrorCode::Parse, "text.header",
                          "this is " + std::string(foreign_format_name(foreign)) + ", not USD",
                          foreign_format_advice(foreign, shown_path(std::string(cursor.file()))));
  }
  if (text.empty()) {
    return cursor.fail_at(0, ErrorCode::Parse, "text.header", "the file is empty",
                          "write it again, or name another file");
  }
  if (!check_encoding(cursor)) {
    return false;
  }
  if (!cursor.starts_with("#usda ")) {
    return cursor.fail_at(
        0, ErrorCode::Parse, "text.header",
        "this is not USD: the first line of a text layer must be `#usda 1.0`",
        "name a USD, URDF or MJCF file, or add that line at the top where it is a "
        "text layer without it");
  }
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::size_t start = line.find_first_not_of(" \t", 5);
  std::string_view version;
  if (start != std::string_view::npos) {
    version = line.substr(start, line.find_first_of(" \t\r", start) - start);
  }
  unsigned major = 0;
  unsigned minor = 0;
  if (!parse_version(version, major, minor)) {
    return cursor.fail_at(start == std::string_view::npos ? 0 : start, ErrorCode::Parse,
                          "text.header", "\"" + std::string(version) + "\" is not a version",
                          "write `#usda 1.0`");
  }
  if (major != kMajor || minor > kMaxMinor) {
    return cursor.fail_at(start, ErrorCode::Unsupported, "text.header",
                          "version " + std::string(version) + " is not supported: 1.0 to 1." +
                              std::to_string(kMaxMinor) + " are");
  }
  cursor.seek(line.size() < text.size() ? line.size() + 1 : text.size());
  return true;
}

}  // namespace tenon::formats::text
