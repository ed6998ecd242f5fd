// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/token.h"
#include "tenon/bytes/byte_writer.h"
#include "tenon/formats/crate/layout.h"

namespace tenon::formats::crate {

/// The structural sections of a file to be written: each token, string, path, field and set of
/// fields once, by index in the order of first use.
class TableWriter {
 public:
  TableWriter();

  std::uint32_t token(Token token);
  std::uint32_t string(std::string_view text);
  /// An absolute path or the empty one. Everything above it becomes a row too.
  std::uint32_t path(Path path);
  std::uint32_t field(Token name, ValueWord value);
  std::uint32_t field_set(const std::vector<std::uint32_t>& fields);
  void spec(Path path, std::uint32_t kind, std::uint32_t field_set);

  /// Appends the sections and the table of contents; the offset of the latter.
  std::size_t write(bytes::ByteWriter& out);
  /// False when there are more rows than the format can count.
  bool fits() const;
  /// The first text that the format, which ends texts with a zero, cannot hold; nullptr for none.
  const std::string* unfit_text() const {
    return has_zero_byte_ ? &text_with_zero_byte_.str() : nullptr;
  }

 private:
  struct FieldRow {
    std::uint32_t name = 0;
    std::uint64_t word = 0;
    bool operator==(const FieldRow&) const = default;
  };
  struct RowHash {
    std::size_t operator()(const FieldRow& row) const;
    std::size_t operator()(const std::vector<std::uint32_t>& set) const;
  };
  struct PathTree;
  void write_tokens(bytes::ByteWriter& out) const;
  void write_fields(bytes::ByteWriter& out) const;
  void write_paths(bytes::ByteWriter& out) const;
  void write_specs(bytes::ByteWriter& out) const;

  std::vector<Token> tokens_;
  std::unordered_map<Token, std::uint32_t> token_index_;
  Token text_with_zero_byte_;
  bool has_zero_byte_ = false;
  std::vector<std::uint32_t> strings_;
  std::unordered_map<std::uint32_t, std::uint32_t> string_index_;  // by token
  std::vector<Path> paths_;
  std::vector<std::uint32_t> path_tokens_;  // of their last elements
  std::unordered_map<Path, std::uint32_t> path_index_;
  std::vector<std::uint32_t> field_names_;
  std::vector<std::uint64_t> field_words_;
  std::unordered_map<FieldRow, std::uint32_t, RowHash> field_index_;
  std::vector<std::uint32_t> field_sets_;
  std::unordered_map<std::vector<std::uint32_t>, std::uint32_t, RowHash> field_set_index_;
  std::vector<std::uint32_t> spec_paths_;
  std::vector<std::uint32_t> spec_sets_;
  std::vector<std::uint32_t> spec_kinds_;
};

}  // namespace tenon::formats::crate
