// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// The paths of a file lie as a tree, depth first, in three packed lists: which path a node is, the
// token of its last element (negative: a property's name), and its jump: -2 a leaf, -1 a child
// follows, 0 the next sibling follows, n a child follows and the next sibling stands n nodes on.
#include <optional>
#include <string>

#include "tenon/base/limits.h"
#include "tenon/formats/crate/tables.h"

namespace tenon::formats::crate {
namespace {

/// What a token may stand for as an element of a path; found once for each token.
enum class TokenUse : std::uint8_t { Unknown, PrimName, PropertyName, Other };

class PathTree {
 public:
  PathTree(const std::vector<Token>& tokens, std::size_t path_count)
      : tokens_(tokens), uses_(tokens.size(), TokenUse::Unknown), paths_(path_count) {}

  Result<void> read_columns(bytes::ByteReader& in, const CrateFile& file) {
    TENON_TRY(const std::uint64_t count, read_row_count(in, file));
    TENON_TRY(path_column_, read_packed<std::uint32_t>(in, count));
    TENON_TRY(token_column_, read_packed<std::int32_t>(in, count));
    TENON_TRY(jump_column_, read_packed<std::int32_t>(in, count));
    seen_.assign(path_column_.size(), false);
    return {};
  }

  Result<void> build(Tables& tables) {
    std::vector<Pending> pending;
    if (!path_column_.empty()) {
      pending.push_back({0, Path()});
    }
    order_.reserve(path_column_.size());
    while (!pending.empty()) {
      const Pending start = pending.back();
      pending.pop_back();
      TENON_CHECK(walk(start, pending));
    }
    tables.paths = std::move(paths_);
    tables.path_order = std::move(order_);
    return {};
  }

 private:
  struct Pending {
    std::size_t node = 0;
    Path parent;
  };

  /// Follows children and siblings from `start`; siblings further on are left in `pending`.
  Result<void> walk(Pending at, std::vector<Pending>& pending) {
    while (true) {
      TENON_TRY(const Path path, read_node(at.node, at.parent));
      const std::int32_t jump = jump_column_[at.node];
      if (jump > 0) {
        pending.push_back({at.node + static_cast<std::size_t>(jump), at.parent});
      }
      if (jump == -2) {
        return {};
      }
      if (jump != 0) {
        at.parent = path;
      } else if (at.parent.empty()) {
        return corrupt("the root path has a sibling");
      }
      ++at.node;
    }
  }

  Result<Path> read_node(std::size_t node, Path parent) {
    if (node >= seen_.size() || seen_[node] || jump_column_[node] < -2) {
      return corrupt("the tree of paths is damaged");
    }
    seen_[node] = true;
    const std::uint32_t index = path_column_[node];
    if (index >= paths_.size() || !paths_[index].empty()) {
      return corrupt("the tree of paths names a path twice or one that is not there");
    }
    if (parent.empty()) {
      order_.push_back(index);
      return paths_[index] = Path::absolute_root();
    }
    TENON_TRY(const Path path, append(parent, token_column_[node]));
    order_.push_back(index);
    return paths_[index] = path;
  }

  Result<Path> append(Path parent, std::int32_t column) {
    const std::uint64_t index = column < 0 ? static_cast<std::uint64_t>(-std::int64_t{column})
                                           : static_cast<std::uint64_t>(column);
    if (index >= tokens_.size()) {
      return corrupt("an element of a path is not there");
    }
    if (parent.depth() >= limits::kPathElements) {
      return Error(ErrorCode::Limit, "a path has too many elements").with_rule("crate.too-much");
    }
    const Token token = tokens_[index];
    const TokenUse use = use_of(index);
    if (column < 0) {
      const bool named = use == TokenUse::PrimName || use == TokenUse::PropertyName;
      if (named && parent.is_prim_or_variant()) {
        return parent.property(token);
      }
    } else if (use == TokenUse::PrimName) {
      if (parent.is_prim_or_root() || parent.is_variant_selection()) {
        return parent.child(token);
      }
    } else if (std::optional<Path> path = other_element(parent, token)) {
      return *path;
    }
    return corrupt("\"" + token.str() + "\" cannot follow " + parent.str() + " in a path");
  }

  TokenUse use_of(std::uint64_t index) {
    TokenUse& use = uses_[index];
    if (use == TokenUse::Unknown) {
      const std::string& text = tokens_[index].str();
      use = is_identifier(text)              ? TokenUse::PrimName
            : is_namespaced_identifier(text) ? TokenUse::PropertyName
                                             : TokenUse::Other;
    }
    return use;
  }

  /// Variant selections, targets and what stands below them, in the form they have in text.
  static std::optional<Path> other_element(Path parent, Token token) {
    const std::string& text = token.str();
    if (text.empty() || text.size() > limits::kPathTextLength) {
      return std::nullopt;
    }
    if (text.front() == '{' && text.back() == '}' && parent.is_prim_or_variant()) {
      return variant(parent, text);
    }
    if (text.front() == '[' && text.back() == ']' && parent.is_property()) {
      const Result<Path> target = Path::parse(std::string_view(text).substr(1, text.size() - 2));
      return target ? std::optional(parent.target_element(*target)) : std::nullopt;
    }
    const Result<Path> path = Path::parse(parent.str() + text);
    return path && path->parent() == parent ? std::optional(*path) : std::nullopt;
  }

  static std::optional<Path> variant(Path parent, const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
      return std::nullopt;
    }
    const std::string_view set = std::string_view(text).substr(1, equals - 1);
    const std::string_view name =
        std::string_view(text).substr(equals + 1, text.size() - equals - 2);
    if (!is_variant_name(set) || !(name.empty() || is_variant_name(name))) {
      return std::nullopt;
    }
    return parent.variant_selection(Token(set), Token(name));
  }

  const std::vector<Token>& tokens_;
  std::vector<TokenUse> uses_;
  std::vector<Path> paths_;
  std::vector<std::uint32_t> order_;  // indices of paths_
  std::vector<std::uint32_t> path_column_;
  std::vector<std::int32_t> token_column_;
  std::vector<std::int32_t> jump_column_;
  std::vector<bool> seen_;
};

}  // namespace

Result<void> read_paths(Tables& tables) {
  bytes::ByteReader in = tables.path_section;
  if (in.size() == 0) {
    return {};
  }
  const CrateFile& file = *tables.file;
  TENON_TRY(const std::uint64_t count, read_row_count(in, file));
  PathTree tree(file.tokens, static_cast<std::size_t>(count));
  TENON_CHECK(tree.read_columns(in, file));
  return tree.build(tables);
}

}  // namespace tenon::formats::crate
