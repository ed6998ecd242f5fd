// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/paths/path_numbers.h"
#include "tenon/base/token.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/formats/crate/layout.h"
#include "tenon/formats/crate/row_index.h"

namespace tenon::formats::crate {

/// The structural sections of a file to be written: each token, string, path, field and set of
/// fields once, by index in the order of first use.
class TableWriter {
 public:
  TableWriter();

  /// Room for so many specs.
  void reserve(std::size_t specs);

  std::uint32_t token(Token token);
  std::uint32_t string(std::string_view text);
  /// An absolute path or the empty one. Everything above it becomes a row too.
  std::uint32_t path(Path path);
  std::uint32_t field(Token name, ValueWord value);
  std::uint32_t field_set(const std::vector<std::uint32_t>& fields);
  void spec(Path path, std::uint32_t kind, std::uint32_t field_set);

  /// Appends the sections and the table of contents; the offset of the latter. `spec_paths` are
  /// those of all specs in their order: mostly there are no others.
  std::size_t write(bytes::ByteWriter& out, std::span<const Path> spec_paths);
  /// False when there are more rows than the format can count.
  bool fits() const;
  /// The first text that the format, which ends texts with a zero, cannot hold; nullptr for none.
  const std::string* unfit_text() const {
    return has_zero_byte_ ? &text_with_zero_byte_.str() : nullptr;
  }

 private:
  struct PathTree;
  std::uint32_t empty_path();
  void add_above(Path path);
  std::uint32_t row_of(Path path);
  auto path_of() const {
    return [this](std::uint32_t number) { return paths_[number - 1]; };
  }
  void write_tokens(bytes::ByteWriter& out) const;
  void write_fields(bytes::ByteWriter& out) const;
  /// Rows of paths in the order of these.
  std::vector<std::uint32_t> ordered_paths(std::span<const Path> spec_paths) const;
  void write_paths(bytes::ByteWriter& out, std::span<const Path> spec_paths) const;
  void write_specs(bytes::ByteWriter& out) const;

  std::vector<Token> tokens_;
  RowIndex token_index_;
  Token text_with_zero_byte_;
  bool has_zero_byte_ = false;
  std::vector<std::uint32_t> strings_;
  std::vector<std::uint32_t> string_of_token_;  // 1 + its number; 0: none
  std::vector<Path> paths_;
  std::vector<std::uint32_t> path_tokens_;  // of their last elements
  PathNumbers path_rows_;                   // 1 + where a path is in paths_
  Path last_parent_;  // of the path that came last: it and what is above it have rows
  std::uint32_t empty_path_ = RowIndex::kNone;
  std::vector<std::uint32_t> field_names_;
  std::vector<std::uint64_t> field_words_;
  RowIndex field_index_;
  std::vector<std::uint32_t> field_sets_;
  RowIndex field_set_index_;  // by where they start
  std::vector<std::uint32_t> spec_paths_;
  std::vector<std::uint32_t> spec_sets_;
  std::vector<std::uint32_t> spec_kinds_;
};

}  // namespace tenon::formats::crate
