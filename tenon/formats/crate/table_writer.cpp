// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Every row is kept once, in the order of first use, so equal input gives equal bytes. A path's row
// comes after those above it. The section of paths has an order of its own: sorted, what is below a
// path follows it, which gives the depth-first tree of path_tree.cpp, and each row sets the jump of
// its parent or elder sibling. Names of properties are negative token numbers there, so number 0 is
// the empty token.
#include "tenon/formats/crate/table_writer.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <string>

#include "tenon/base/paths/path_order.h"
#include "tenon/bytes/integer_coding.h"
#include "tenon/bytes/lz4_block.h"

namespace tenon::formats::crate {
namespace {

template <class T>
void write_packed(bytes::ByteWriter& out, const std::vector<T>& integers) {
  const std::string packed = bytes::encode_integers<T>(integers);
  out.write(std::uint64_t{packed.size()});
  out.write_text(packed);
}

/// A property directly below a prim; others are written with their dot.
bool is_prim_property(Path path) { return path.kind() == PathKind::Property; }

/// The last element of a path as text.
Token element_of(Path path) {
  switch (path.kind()) {
    case PathKind::Prim:
    case PathKind::Property:
      return path.name();
    case PathKind::VariantSelection:
      return Token("{" + path.name().str() + "=" + path.variant().str() + "}");
    case PathKind::Target:
      return Token("[" + path.target().str() + "]");
    case PathKind::RelationalAttribute:
    case PathKind::MapperArg:
      return Token("." + path.name().str());
    case PathKind::Mapper:
      return Token(".mapper[" + path.target().str() + "]");
    case PathKind::Expression:
      return Token(".expression");
    case PathKind::Empty:
    case PathKind::AbsoluteRoot:
    case PathKind::RelativeRoot:
      break;
  }
  return {};
}

}  // namespace

TableWriter::TableWriter() {
  token(Token());  // index 0: a property's name must have a negative form
}

void TableWriter::reserve(std::size_t specs) {
  path_rows_.reserve(specs + 1, path_of());
  for (std::vector<std::uint32_t>* rows :
       {&path_tokens_, &spec_paths_, &spec_sets_, &spec_kinds_}) {
    rows->reserve(specs + 1);
  }
  paths_.reserve(specs + 1);
}

std::uint32_t TableWriter::token(Token token) {
  const auto next = static_cast<std::uint32_t>(tokens_.size());
  const std::uint32_t known =
      token_index_.find_or_add(RowHash().with(std::hash<Token>{}(token)), next,
                               [&](std::uint32_t row) { return tokens_[row] == token; });
  if (known != RowIndex::kNone) {
    return known;
  }
  tokens_.push_back(token);
  if (!has_zero_byte_ && token.str().find('\0') != std::string::npos) {
    has_zero_byte_ = true;
    text_with_zero_byte_ = token;
  }
  return next;
}

std::uint32_t TableWriter::string(std::string_view text) {
  const std::uint32_t index = token(Token(text));
  string_of_token_.resize(std::max(string_of_token_.size(), std::size_t{index} + 1));
  std::uint32_t& number = string_of_token_[index];
  if (number == 0) {
    strings_.push_back(index);
    number = static_cast<std::uint32_t>(strings_.size());
  }
  return number - 1;
}

std::uint32_t TableWriter::path(Path path) {
  if (path.empty()) {
    return empty_path();
  }
  if (path.parent() != last_parent_) {
    add_above(path);
    last_parent_ = path.parent();
  }
  return row_of(path);
}

void TableWriter::add_above(Path path) {
  std::vector<Path> missing;
  for (Path at = path.parent(); !at.empty() && path_rows_.find(at, path_of()) == 0;
       at = at.parent()) {
    missing.push_back(at);
  }
  std::for_each(missing.rbegin(), missing.rend(), [this](Path at) { row_of(at); });
}

/// The row of a path, made where there is none yet; those above have theirs.
std::uint32_t TableWriter::row_of(Path path) {
  const auto next = static_cast<std::uint32_t>(paths_.size() + 1);
  const std::uint32_t number = path_rows_.find_or_put(path, next, path_of());
  if (number == next) {
    paths_.push_back(path);
    path_tokens_.push_back(token(element_of(path)));
  }
  return number - 1;
}

std::uint32_t TableWriter::empty_path() {
  if (empty_path_ == RowIndex::kNone) {
    empty_path_ = static_cast<std::uint32_t>(paths_.size());
    paths_.push_back({});
    path_tokens_.push_back(0);
  }
  return empty_path_;
}

std::uint32_t TableWriter::field(Token name, ValueWord value) {
  const std::uint32_t index = token(name);
  const auto next = static_cast<std::uint32_t>(field_names_.size());
  const std::uint32_t known = field_index_.find_or_add(
      RowHash().with(index).with(value.bits), next, [&](std::uint32_t row) {
        return field_names_[row] == index && field_words_[row] == value.bits;
      });
  if (known != RowIndex::kNone) {
    return known;
  }
  field_names_.push_back(index);
  field_words_.push_back(value.bits);
  return next;
}

std::uint32_t TableWriter::field_set(const std::vector<std::uint32_t>& fields) {
  RowHash hash;
  for (const std::uint32_t field : fields) {
    hash = hash.with(field);
  }
  const auto next = static_cast<std::uint32_t>(field_sets_.size());
  const std::uint32_t known = field_set_index_.find_or_add(hash, next, [&](std::uint32_t start) {
    const auto set = field_sets_.begin() + start;
    return std::equal(fields.begin(), fields.end(), set) && set[fields.size()] == kEndOfSet;
  });
  if (known != RowIndex::kNone) {
    return known;
  }
  field_sets_.insert(field_sets_.end(), fields.begin(), fields.end());
  field_sets_.push_back(kEndOfSet);
  return next;
}

void TableWriter::spec(Path spec_path, std::uint32_t kind, std::uint32_t field_set) {
  spec_paths_.push_back(path(spec_path));
  spec_kinds_.push_back(kind);
  spec_sets_.push_back(field_set);
}

bool TableWriter::fits() const {
  constexpr std::size_t kMax = std::numeric_limits<std::int32_t>::max();
  return tokens_.size() < kMax && paths_.size() < kMax && field_names_.size() < kMax &&
         field_sets_.size() < kMax && spec_paths_.size() < kMax;
}

void TableWriter::write_tokens(bytes::ByteWriter& out) const {
  std::string text;
  for (const Token token : tokens_) {
    text += token.str();
    text += '\0';
  }
  const std::string packed = bytes::lz4_compress(std::as_bytes(std::span(text)));
  out.write(std::uint64_t{tokens_.size()});
  out.write(std::uint64_t{text.size()});
  out.write(std::uint64_t{packed.size()});
  out.write_text(packed);
}

void TableWriter::write_fields(bytes::ByteWriter& out) const {
  out.write(std::uint64_t{field_names_.size()});
  write_packed(out, field_names_);
  const std::string packed = bytes::lz4_compress(std::as_bytes(std::span(field_words_)));
  out.write(std::uint64_t{packed.size()});
  out.write_text(packed);
}

/// The three columns of path_tree.cpp.
struct TableWriter::PathTree {
  std::vector<std::uint32_t> paths;
  std::vector<std::int32_t> tokens;
  std::vector<std::int32_t> jumps;

  PathTree(const TableWriter& table, std::span<const std::uint32_t> ordered) {
    paths.reserve(ordered.size());
    tokens.reserve(ordered.size());
    jumps.reserve(ordered.size());
    std::vector<std::size_t> open;  // rows from the root to the row before
    for (const std::uint32_t index : ordered) {
      if (!table.paths_[index].empty()) {
        add(table, index, open);
      }
    }
  }

 private:
  /// Appends a row, and tells its parent or its elder sibling of it. A row without either is -2.
  void add(const TableWriter& table, std::uint32_t index, std::vector<std::size_t>& open) {
    const Path path = table.paths_[index];
    const std::size_t row = paths.size();
    std::size_t sibling = row;
    while (!open.empty() && table.paths_[paths[open.back()]] != path.parent()) {
      sibling = open.back();
      open.pop_back();
    }
    if (sibling != row) {
      const bool has_child = jumps[sibling] == -1;
      jumps[sibling] = has_child ? static_cast<std::int32_t>(row - sibling) : 0;
    } else if (!open.empty()) {
      jumps[open.back()] = -1;
    }
    const auto token = static_cast<std::int32_t>(table.path_tokens_[index]);
    paths.push_back(index);
    tokens.push_back(is_prim_property(path) ? -token : token);
    jumps.push_back(-2);
    open.push_back(row);
  }
};

/// Each of the paths of specs has a row, so where there are as many, these are all.
std::vector<std::uint32_t> TableWriter::ordered_paths(std::span<const Path> spec_paths) const {
  if (spec_paths.size() != paths_.size()) {
    return path_order(paths_);
  }
  std::vector<std::uint32_t> rows;
  rows.reserve(paths_.size());
  for (const Path path : spec_paths) {
    rows.push_back(path_rows_.find(path, path_of()) - 1);
  }
  return rows;
}

void TableWriter::write_paths(bytes::ByteWriter& out, std::span<const Path> spec_paths) const {
  const PathTree tree(*this, ordered_paths(spec_paths));
  out.write(std::uint64_t{paths_.size()});
  out.write(std::uint64_t{tree.paths.size()});
  write_packed(out, tree.paths);
  write_packed(out, tree.tokens);
  write_packed(out, tree.jumps);
}

void TableWriter::write_specs(bytes::ByteWriter& out) const {
  out.write(std::uint64_t{spec_paths_.size()});
  write_packed(out, spec_paths_);
  write_packed(out, spec_sets_);
  write_packed(out, spec_kinds_);
}

std::size_t TableWriter::write(bytes::ByteWriter& out, std::span<const Path> spec_paths) {
  std::vector<Section> sections;
  const auto section = [&](const char* name, const std::function<void()>& content) {
    Section row = {};
    std::strncpy(row.name, name, sizeof(row.name) - 1);
    row.start = static_cast<std::int64_t>(out.offset());
    content();
    row.size = static_cast<std::int64_t>(out.offset()) - row.start;
    sections.push_back(row);
  };
  section("TOKENS", [&] { write_tokens(out); });
  section("STRINGS", [&] {
    out.write(std::uint64_t{strings_.size()});
    out.write_array(std::span<const std::uint32_t>(strings_));
  });
  section("FIELDS", [&] { write_fields(out); });
  section("FIELDSETS", [&] {
    out.write(std::uint64_t{field_sets_.size()});
    write_packed(out, field_sets_);
  });
  section("PATHS", [&] { write_paths(out, spec_paths); });
  section("SPECS", [&] { write_specs(out); });
  const std::size_t contents = out.offset();
  out.write(std::uint64_t{sections.size()});
  out.write_array(std::span<const Section>(sections));
  return contents;
}

}  // namespace tenon::formats::crate
