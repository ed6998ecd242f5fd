// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/formats/find_places.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "tenon/base/path.h"
#include "tenon/formats/open_layer.h"
#include "tenon/formats/source_bytes.h"
#include "tenon/formats/text/cursor.h"
#include "tenon/formats/text/layout/part_finder.h"
#include "tenon/formats/text/reader.h"

namespace tenon::formats {
namespace {

/// The findings in one layer, in the order of its text.
class LayerPlaces {
 public:
  LayerPlaces(std::string_view text, std::string file)
      : text_(text), file_(std::move(file)), finder_(text) {}

  void find(Diagnostic& finding) {
    const bool is_root = finding.part.spec == "/";
    const auto offset = is_root ? std::optional<std::size_t>(0) : offset_of(finding);
    const auto range = offset ? finder_.find(*offset, finding.part) : std::nullopt;
    if (!range) {
      return;
    }
    marks_.push_back({range->begin, &finding.line, &finding.column});
    marks_.push_back({range->end, &finding.end_line, &finding.end_column});
  }

  /// Writes the places found: from the front to the back, so that lines are counted once.
  void finish() {
    std::sort(marks_.begin(), marks_.end(),
              [](const Mark& a, const Mark& b) { return a.offset < b.offset; });
    const text::Cursor cursor(text_, {});
    for (const Mark& mark : marks_) {
      const text::SourcePlace place = cursor.place_of(mark.offset);
      *mark.line = place.line;
      *mark.column = place.column;
    }
  }

 private:
  struct Mark {
    std::size_t offset;
    std::uint32_t* line;
    std::uint32_t* column;
  };

  /// Where the statement of the spec begins.
  std::optional<std::size_t> offset_of(const Diagnostic& finding) {
    if (finding.column == layer::Spec::kLastColumn) {
      return offset_by_path(Path::from(finding.part.spec));
    }
    if (finding.line < line_) {
      line_ = 1;
      line_start_ = 0;
    }
    for (; line_ < finding.line; ++line_) {
      const std::size_t end = text_.find('\n', line_start_);
      if (end == std::string_view::npos) {
        return std::nullopt;
      }
      line_start_ = end + 1;
    }
    return finding.column == 0 ? std::nullopt : std::optional(line_start_ + finding.column - 1);
  }

  /// The same in lines so long that specs do not know their column.
  std::optional<std::size_t> offset_by_path(Path spec) {
    if (!sources_) {
      Diagnostics ignored;
      if (!read_text_with_sources(text_, file_, ignored, sources_.emplace())) {
        sources_ = text::SourceMap();
      }
    }
    if (const auto property = sources_->properties.find(spec);
        property != sources_->properties.end()) {
      return property->second.front().range.begin;
    }
    const auto block = sources_->blocks.find(spec);
    return block == sources_->blocks.end() ? std::nullopt
                                           : std::optional(block->second.range.begin);
  }

  std::string_view text_;
  std::string file_;
  std::uint32_t line_ = 1;
  std::size_t line_start_ = 0;
  std::vector<Mark> marks_;
  text::PartFinder finder_;
  std::optional<text::SourceMap> sources_;
};

auto order_of(const Diagnostic& finding) {
  return std::tie(finding.line, finding.column, finding.part.field);
}

}  // namespace

void find_places(const std::vector<Diagnostic*>& findings, const bytes::Files& files) {
  std::map<std::string, std::vector<Diagnostic*>> by_file;
  for (Diagnostic* finding : findings) {
    if (!finding->part.spec.empty() && !finding->file.empty()) {
      by_file[finding->file].push_back(finding);
    }
  }
  for (auto& [file, found] : by_file) {
    const auto bytes = source_bytes(files, file);
    const bool is_text = bytes != nullptr && format_of(*bytes) == LayerFormat::Text;
    if (is_text) {
      std::stable_sort(found.begin(), found.end(), [](const Diagnostic* a, const Diagnostic* b) {
        return order_of(*a) < order_of(*b);
      });
      LayerPlaces places(bytes->text(), file);
      for (Diagnostic* finding : found) {
        places.find(*finding);
      }
      places.finish();
    }
    for (Diagnostic* finding : found) {
      if (bytes != nullptr && !is_text) {
        finding->line = finding->column = 0;  // binary layers have no lines
      }
      finding->part = {};
    }
  }
}

void find_places(Diagnostics& findings, const bytes::Files& files) {
  std::vector<Diagnostic*> all;
  for (Diagnostic& finding : findings) {
    all.push_back(&finding);
  }
  find_places(all, files);
}

}  // namespace tenon::formats
