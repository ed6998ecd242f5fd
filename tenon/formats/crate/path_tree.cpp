// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// The paths of a file lie as a tree, depth first, in three packed lists: which path a node is, the
// token of its last element (negative: a property's name), and its jump: -2 a leaf, -1 a child
// follows, 0 the next sibling follows, n a child follows and the next sibling stands n nodes on.
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>

#include "tenon/base/limits/crate_limits.h"
#include "tenon/base/limits/limits.h"
#include "tenon/formats/crate/tables.h"

namespace tenon::formats::crate {
namespace {

/// The role of a token as an element of a path; found once for each token.
enum class TokenUse : std::uint8_t { Unknown, PrimName, PropertyName, Other };

/// One row of the three lists.
struct Node {
  std::uint32_t path = 0;
  std::int32_t token = 0;
  std::int32_t jump = 0;
};

/// The rows in the order of the file.
class NodeStream {
 public:
  static Result<NodeStream> open(bytes::ByteReader in, std::uint64_t count) {
    NodeStream stream;
    stream.left_ = static_cast<std::size_t>(count);
    TENON_TRY(stream.paths_, open_packed<std::uint32_t>(in, count));
    TENON_TRY(stream.tokens_, open_packed<std::int32_t>(in, count));
    TENON_TRY(stream.jumps_, open_packed<std::int32_t>(in, count));
    return stream;
  }
  Node next() {
    if (left_in_block_ == 0) {
      read_block();
    }
    --left_in_block_;
    const Node node{path_block_[at_], token_block_[at_], jump_block_[at_]};
    ++at_;
    return node;
  }

 private:
  static constexpr std::size_t kBlock = 256;

  void read_block() {
    left_in_block_ = std::min(left_, kBlock);
    left_ -= left_in_block_;
    at_ = 0;
    paths_.read(std::span(path_block_).first(left_in_block_));
    tokens_.read(std::span(token_block_).first(left_in_block_));
    jumps_.read(std::span(jump_block_).first(left_in_block_));
  }

  bytes::IntegerStream<std::uint32_t> paths_;
  bytes::IntegerStream<std::int32_t> tokens_;
  bytes::IntegerStream<std::int32_t> jumps_;
  std::array<std::uint32_t, kBlock> path_block_{};
  std::array<std::int32_t, kBlock> token_block_{};
  std::array<std::int32_t, kBlock> jump_block_{};
  std::size_t left_ = 0;
  std::size_t left_in_block_ = 0;
  std::size_t at_ = 0;
};

Error damaged() { return corrupt("the tree of paths is damaged"); }

class PathTree {
 public:
  explicit PathTree(const std::vector<Token>& tokens)
      : tokens_(tokens), uses_(tokens.size(), TokenUse::Unknown) {}

  /// Reads rows that are all where their parent or elder sibling says, as all writers place them:
  /// rows are checked one by one and the first wrong one ends it. False: they are in another order.
  Result<bool> build_in_order(NodeStream nodes, std::size_t node_count, std::size_t path_count) {
    TENON_CHECK(start(node_count, path_count));
    std::vector<Pending> pending;  // the siblings that are still to come
    Path parent;
    for (std::size_t at = 0; at < node_count; ++at) {
      const Node node = nodes.next();
      TENON_TRY(const Path path, add(node, parent));
      if (node.jump > 0) {
        pending.push_back({at + static_cast<std::size_t>(node.jump), parent});
      }
      if (node.jump == kLeaf) {
        if (pending.empty()) {
          return at + 1 == node_count ? Result<bool>(true) : damaged();
        }
        if (pending.back().node != at + 1) {
          return false;
        }
        parent = pending.back().parent;
        pending.pop_back();
      } else if (node.jump != 0) {
        parent = path;
      }
    }
    return node_count == 0 ? Result<bool>(true) : damaged();
  }

  /// The same for rows in any order.
  Result<void> build(NodeStream stream, std::size_t node_count, std::size_t path_count) {
    TENON_CHECK(start(node_count, path_count));
    std::vector<Node> nodes(node_count);
    for (Node& node : nodes) {
      node = stream.next();
    }
    std::vector<bool> seen(node_count, false);
    std::vector<Pending> pending;
    if (!nodes.empty()) {
      pending.push_back({0, Path()});
    }
    while (!pending.empty()) {
      Pending at = pending.back();
      pending.pop_back();
      for (bool ends = false; !ends; ++at.node) {
        if (at.node >= nodes.size() || seen[at.node]) {
          return damaged();
        }
        seen[at.node] = true;
        const Node& node = nodes[at.node];
        TENON_TRY(const Path path, add(node, at.parent));
        if (node.jump > 0) {
          pending.push_back({at.node + static_cast<std::size_t>(node.jump), at.parent});
        }
        at.parent = node.jump != 0 ? path : at.parent;
        ends = node.jump == kLeaf;
      }
    }
    return {};
  }

  void give(Tables& tables) {
    tables.paths = std::move(paths_);
    tables.path_order = std::move(order_);
  }

 private:
  static constexpr std::int32_t kLeaf = -2;
  static constexpr std::size_t kBits = 64;

  struct Pending {
    std::size_t node = 0;
    Path parent;
  };

  Result<void> start(std::size_t node_count, std::size_t path_count) {
    TENON_TRY(paths_, ZeroedArray<Path>::make(path_count));
    order_.clear();
    order_.reserve(node_count);
    met_.clear();
    return {};
  }

  Result<Path> add(const Node& node, Path parent) {
    if (node.jump < kLeaf) {
      return damaged();
    }
    if (node.path >= paths_.size() || !paths_[node.path].empty()) {
      return corrupt("the tree of paths names a path twice or one that is not there");
    }
    if (parent.empty()) {
      if (node.jump == 0) {
        return corrupt("the root path has a sibling");
      }
      order_.push_back(node.path);
      return paths_[node.path] = Path::absolute_root();
    }
    TENON_TRY(const Path path, append(parent, node.token));
    if (!is_new(path)) {
      return corrupt("the tree of paths has " + path.str() + " twice");
    }
    order_.push_back(node.path);
    return paths_[node.path] = path;
  }

  /// Properties are told apart where they become specs.
  bool is_new(Path path) {
    if (path.is_property()) {
      return true;
    }
    const std::size_t number = path.number();
    if (number / kBits >= met_.size()) {
      met_.resize(2 * (number / kBits) + 1);
    }
    std::uint64_t& bits = met_[number / kBits];
    const std::uint64_t bit = std::uint64_t{1} << (number % kBits);
    const bool is_new = (bits & bit) == 0;
    bits |= bit;
    return is_new;
  }

  Result<Path> append(Path parent, std::int32_t column) {
    const auto index =
        static_cast<std::size_t>(column < 0 ? -std::int64_t{column} : std::int64_t{column});
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

  TokenUse use_of(std::size_t index) {
    TokenUse& use = uses_[index];
    if (use == TokenUse::Unknown) {
      const std::string& text = tokens_[index].str();
      use = is_identifier(text)              ? TokenUse::PrimName
            : is_namespaced_identifier(text) ? TokenUse::PropertyName
                                             : TokenUse::Other;
    }
    return use;
  }

  /// Variant selections, targets and their descendants, in the form they have in text.
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
  ZeroedArray<Path> paths_;
  std::vector<std::uint32_t> order_;  // indices of paths_
  std::vector<std::uint64_t> met_;    // a bit for each path, by its number
};

}  // namespace

Result<void> read_paths(Tables& tables) {
  bytes::ByteReader in = tables.path_section;
  if (in.size() == 0) {
    return {};
  }
  const CrateFile& file = *tables.file;
  TENON_TRY(const std::uint64_t path_count, read_row_count(in, file, limits::kCrateRows));
  TENON_TRY(const std::uint64_t node_count, read_row_count(in, file, limits::kCrateRows));
  const auto paths = static_cast<std::size_t>(path_count);
  const auto nodes = static_cast<std::size_t>(node_count);
  PathTree tree(file.tokens);
  TENON_TRY(NodeStream stream, NodeStream::open(in, node_count));
  TENON_TRY(const bool in_order, tree.build_in_order(std::move(stream), nodes, paths));
  if (!in_order) {
    if (node_count > max_rows(file, limits::kCrateTokens)) {
      return damaged();
    }
    TENON_TRY(NodeStream again, NodeStream::open(in, node_count));
    TENON_CHECK(tree.build(std::move(again), nodes, paths));
  }
  tree.give(tables);
  return {};
}

}  // namespace tenon::formats::crate
