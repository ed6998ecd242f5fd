// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/path.h"
#include "tenon/formats/text/layout/source_map.h"
#include "tenon/formats/text/layout/statement_text.h"

namespace tenon::formats::text {

/// Finds parts of statements in the text of a layer again, by what they say: a place is only told
/// where the text there says what was looked for. The text is a layer's that was read without a
/// fault, or was changed since, so nothing is taken for granted.
class PartFinder {
 public:
  explicit PartFinder(std::string_view text);

  /// Where `part` of the statement that begins at `offset` stands: the item, else what is around
  /// it; nothing when the statement is not there. Cheap when asked for a long list item by item.
  /// The root's offset is of no matter.
  std::optional<SourceRange> find(std::size_t offset, const StatementPart& part);

 private:
  /// What the text says about one field: several statements may edit one list.
  struct FieldText {
    std::string spec;
    std::string field;
    std::vector<SourceRange> statements{};  ///< those that take away come last
    std::vector<SourceRange> values{};      ///< of the same
    std::vector<SourceRange> items{};       ///< of all lists
    std::unordered_map<std::string, SourceRange> by_text{};
  };

  const std::optional<StatementText>& statement_at(std::size_t offset);
  const FieldText& field_text(const StatementText& first, const StatementPart& part);
  void add_property_values(const StatementText& first, FieldText& found);
  void add_metadata_values(std::size_t open, FieldText& found);
  std::optional<StatementText> next_about(const StatementText& statement);
  void add_items(SourceRange value, FieldText& found);
  SourceRange find_entry(const FieldText& field, const StatementPart& part);
  std::string item_text(SourceRange item) const;
  void spend(std::size_t bytes) { work_left_ -= bytes < work_left_ ? bytes : work_left_; }

  /// Zero behind the end: what was changed may end in a field without its value.
  char char_at(std::size_t at) const { return at < text_.size() ? text_[at] : '\0'; }

  std::string_view text_;
  std::size_t work_left_;  // bytes still to be looked at
  Path spec_;              // of the part
  FieldText last_;
  std::size_t last_offset_ = kNowhere;  // of the statement looked at last
  std::optional<StatementText> last_statement_;
};

}  // namespace tenon::formats::text
