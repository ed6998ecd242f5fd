// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Strings of the JSON text alone are looked at (RFC 8259, section 7), for that is where names of
// files stand; what else the text says is for the reader of the format.
#include "tenon/mesh/gltf_files.h"

#include <filesystem>
#include <optional>

#include "tenon/base/text/unicode.h"
#include "tenon/bytes/asset_resolver.h"
#include "tenon/bytes/read_record.h"

namespace tenon::mesh {
namespace {

namespace fs = std::filesystem;

/// The JSON text: all of the file, or the first chunk of a GLB (glTF 2.0, 4.4).
std::string_view json_of(std::string_view bytes) {
  constexpr std::size_t kHeaders = 20;
  return bytes.starts_with("glTF") && bytes.size() > kHeaders ? bytes.substr(kHeaders) : bytes;
}

/// Four hexadecimal digits; none where they are none.
std::optional<std::uint32_t> hex4(std::string_view text) {
  if (text.size() < 4) {
    return std::nullopt;
  }
  std::uint32_t value = 0;
  for (const char c : text.substr(0, 4)) {
    const int digit = c >= '0' && c <= '9'   ? c - '0'
                      : c >= 'a' && c <= 'f' ? c - 'a' + 10
                      : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                             : -1;
    if (digit < 0) {
      return std::nullopt;
    }
    value = value * 16 + static_cast<std::uint32_t>(digit);
  }
  return value;
}

class Strings {
 public:
  explicit Strings(std::string_view text) : text_(text) {}

  /// The next string; none at the end.
  std::optional<std::string> next() {
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      const char c = text_[at_];
      depth_ += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
    }
    if (at_ >= text_.size()) {
      return std::nullopt;
    }
    std::string value;
    for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) {
        ++at_;
        take_escape(value);
      } else {
        value += text_[at_];
      }
    }
    ++at_;
    return value;
  }

  /// How many objects and lists enclose the string.
  int depth() const { return depth_; }
  /// Whether the string is the name of a member.
  bool before_colon() const {
    const std::size_t next = text_.find_first_not_of(" \t\r\n", at_);
    return next != std::string_view::npos && text_[next] == ':';
  }

 private:
  void take_escape(std::string& value) {
    const char c = text_[at_];
    const auto code = c == 'u' ? hex4(text_.substr(at_ + 1)) : std::nullopt;
    if (code) {
      unicode::append(*code, value);  // half of a pair comes out as no text, and names no file
      at_ += 4;
      return;
    }
    value += c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c == 'b' ? '\b' : c;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::vector<std::string> gltf_uris(std::string_view bytes) {
  std::vector<std::string> uris;
  Strings strings(json_of(bytes));
  std::string section;
  while (const auto name = strings.next()) {
    if (strings.depth() == 1 && strings.before_colon()) {
      section = *name;
    }
    if (*name != "uri" || !strings.before_colon()) {
      continue;
    }
    const auto uri = strings.next();
    if (uri && !uri->starts_with("data:") && section != "images") {
      uris.push_back(*uri);
    }
  }
  return uris;
}

Result<void> check_gltf_files(std::string_view bytes, const std::string& path,
                              const bytes::ReadPolicy& policy) {
  const fs::path folder = fs::path(path).parent_path();
  for (const std::string& uri : gltf_uris(bytes)) {
    // As a name and as a URI: readers differ in which it is to them.
    for (const std::string& name : {uri, bytes::plain_asset_path("file:" + uri)}) {
      const std::string file = (folder / bytes::plain_asset_path(name)).generic_string();
      if (policy.files()->kind(file) == bytes::NameKind::Nothing) {
        continue;
      }
      TENON_CHECK(bytes::check_on_disk(policy.files(), file));
      bytes::note_read(file);
      if (!policy.allows(file)) {
        return std::move(policy.check(file)).error().in_file(path);
      }
    }
  }
  return {};
}

}  // namespace tenon::mesh
