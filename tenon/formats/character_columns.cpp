// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/character_columns.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <tuple>

#include "tenon/formats/source_bytes.h"

namespace tenon::formats {
namespace {

/// A place in bytes, and where its column in characters goes.
struct Mark {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t* result = nullptr;
};

/// Walks through a text once, from its front to its back.
class CharacterCounter {
 public:
  explicit CharacterCounter(std::string_view text) : text_(text) {}

  /// The column in characters; 0 where the text has no such place. Places come in their order.
  std::uint32_t column_of(std::uint32_t line, std::uint32_t column) {
    for (; line_ < line; ++line_) {
      const std::size_t end = text_.find('\n', at_);
      if (end == std::string_view::npos) {
        return 0;
      }
      at_ = end + 1;
      byte_ = character_ = 1;
    }
    for (; byte_ < column; ++byte_, ++at_) {
      if (at_ >= text_.size() || text_[at_] == '\n') {
        return 0;
      }
      const bool continues = (static_cast<unsigned char>(text_[at_]) & 0xC0U) == 0x80U;
      character_ += continues ? 0 : 1;
    }
    return character_;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1;
  std::uint32_t byte_ = 1;       // of the line
  std::uint32_t character_ = 1;  // of the line
};

}  // namespace

std::vector<CharacterColumns> character_columns(const std::vector<const Diagnostic*>& findings,
                                                const bytes::Files& files) {
  std::vector<CharacterColumns> columns(findings.size());
  std::map<std::string, std::vector<Mark>> by_file;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Diagnostic& finding = *findings[i];
    const auto add = [&](std::uint32_t line, std::uint32_t column, std::uint32_t& result) {
      if (line > 0 && column > 0 && !finding.file.empty()) {
        by_file[finding.file].push_back({line, column, &result});
      }
    };
    add(finding.line, finding.column, columns[i].column);
    add(finding.end_line, finding.end_column, columns[i].end_column);
  }
  for (auto& [file, marks] : by_file) {
    const auto bytes = source_bytes(files, file);
    if (bytes == nullptr) {
      continue;
    }
    std::sort(marks.begin(), marks.end(), [](const Mark& a, const Mark& b) {
      return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
    CharacterCounter counter(bytes->text());
    for (const Mark& mark : marks) {
      *mark.result = counter.column_of(mark.line, mark.column);
    }
  }
  return columns;
}

}  // namespace tenon::formats
