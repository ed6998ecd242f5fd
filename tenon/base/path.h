// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/result.h"
#include "tenon/base/token.h"

namespace tenon {

/// What the last element of a path is.
enum class PathKind : std::uint8_t {
  Empty,                ///< no path
  AbsoluteRoot,         ///< `/`, the pseudo-root
  RelativeRoot,         ///< `.`, the prim that a relative path starts from; also `..` steps
  Prim,                 ///< `/A/B`; the name ".." for a step up in a relative path
  VariantSelection,     ///< `/A{set=variant}`; an empty variant names the set itself
  Property,             ///< `/A.b`
  Target,               ///< `/A.rel[/B]`, also connections
  RelationalAttribute,  ///< `/A.rel[/B].c`
  Mapper,               ///< `/A.b.mapper[/B.c]`
  MapperArg,            ///< `/A.b.mapper[/B.c].d`
  Expression,           ///< `/A.b.expression`
};

class Path;

/// One interned element; never freed. Internal to Path. Two of them share a line of the cache.
struct PathNode {
  /// No element has a variant and a target.
  union Detail {
    Detail() : target(nullptr) {}
    explicit Detail(const PathNode* the_target) : target(the_target) {}
    explicit Detail(Token the_variant) : variant(the_variant) {}
    const PathNode* target;  ///< of Target and Mapper elements
    Token variant;           ///< of VariantSelection elements
  };

  const PathNode* parent = nullptr;
  Token name;  ///< prim, property or variant set name
  Detail detail;
  std::uint32_t number = 0;  ///< counts up as nodes are made, from 1 on
  PathKind kind : 8 = PathKind::Empty;
  bool absolute : 1 = false;
  bool has_variant : 1 = false;  ///< this or any element above is a variant selection
  std::uint32_t depth : 22 = 0;  ///< elements below the root

  Token variant() const { return kind == PathKind::VariantSelection ? detail.variant : Token(); }
  const PathNode* target() const {
    return kind == PathKind::Target || kind == PathKind::Mapper ? detail.target : nullptr;
  }
};
static_assert(sizeof(PathNode) == 3 * sizeof(void*) + 8);

/// Where something is in a scene or a layer. Interned: copying, equality and hashing cost one
/// pointer. Core Spec 1.0.1 section 6 gives the grammar.
class Path {
 public:
  Path() = default;
  static Path absolute_root();
  static Path relative_root();

  /// Reads the text form of any kind of path. "" is an error.
  static Result<Path> parse(std::string_view text);
  /// The same for text that is known to be right; an empty path otherwise.
  static Path from(std::string_view text);

  PathKind kind() const { return node_ == nullptr ? PathKind::Empty : node_->kind; }
  bool empty() const { return node_ == nullptr; }
  bool is_absolute() const { return node_ != nullptr && node_->absolute; }
  bool is_absolute_root() const { return kind() == PathKind::AbsoluteRoot; }
  bool is_prim() const { return kind() == PathKind::Prim; }
  bool is_prim_or_root() const { return is_prim() || is_absolute_root(); }
  bool is_variant_selection() const { return kind() == PathKind::VariantSelection; }
  bool is_prim_or_variant() const { return is_prim() || is_variant_selection(); }
  bool is_property() const {
    return kind() == PathKind::Property || kind() == PathKind::RelationalAttribute;
  }
  bool is_target() const { return kind() == PathKind::Target; }
  bool has_variants() const { return node_ != nullptr && node_->has_variant; }
  std::uint32_t depth() const { return node_ == nullptr ? 0 : node_->depth; }

  /// Name of the last element: prim, property or variant set; empty for a root.
  Token name() const { return node_ == nullptr ? Token() : node_->name; }
  /// Variant name of a VariantSelection element.
  Token variant() const { return node_ == nullptr ? Token() : node_->variant(); }
  /// Target inside the brackets of a Target or Mapper element.
  Path target() const { return Path(node_ == nullptr ? nullptr : node_->target()); }

  /// One element less; an empty path for a root.
  Path parent() const { return Path(node_ == nullptr ? nullptr : node_->parent); }
  /// The nearest prim, variant selection or root at or above this path.
  Path prim_or_variant() const;
  /// The nearest prim (or root) at or above, variant selections skipped.
  Path prim() const;

  Path child(Token name) const;     ///< a child prim
  Path property(Token name) const;  ///< a property; relational after a target
  Path variant_selection(Token set, Token variant) const;
  Path target_element(Path target) const;  ///< `this[target]`
  Path mapper(Path target) const;
  Path mapper_arg(Token name) const;
  Path expression() const;
  /// Appends the elements of a relative path.
  Path append(Path relative) const;

  /// True when this path is `prefix` or below it.
  bool has_prefix(Path prefix) const;
  /// This path with `from` at its head replaced by `to`; unchanged when `from` is no prefix.
  /// With `fix_targets` the same is done inside brackets.
  Path replace_prefix(Path from, Path to, bool fix_targets = true) const;
  /// All variant selections dropped: `/A{v=x}B` becomes `/A/B`.
  Path strip_variants() const;
  /// An absolute path; a relative one is taken from `anchor` (a prim), ".." resolved.
  /// Empty when it climbs above the root.
  Path absolute(Path anchor) const;
  /// The shortest relative path that names the same thing from `anchor`.
  Path relative(Path anchor) const;

  /// Absolute paths of this path and all above it, root first.
  std::vector<Path> prefixes() const;

  std::string str() const;
  const void* id() const { return node_; }
  /// A hash: paths that were made one after another have neighbouring numbers, so that tables by
  /// path are walked through in their order. 0 for the empty path.
  std::uint32_t number() const { return node_ == nullptr ? 0 : node_->number; }

  bool operator==(const Path& other) const { return node_ == other.node_; }
  /// Total order, the same in every run: element by element, a path before what is below it.
  std::strong_ordering operator<=>(const Path& other) const;

 private:
  explicit Path(const PathNode* node) : node_(node) {}
  static Path make(const PathNode* parent, PathKind kind, Token name, PathNode::Detail detail = {});

  const PathNode* node_ = nullptr;
};

/// `name` or `ns:name` made of identifiers; the rule of prim and property names.
bool is_identifier(std::string_view text);
bool is_namespaced_identifier(std::string_view text);
/// Names of variants also allow digits in front, '-', '|' and a leading '.'.
bool is_variant_name(std::string_view text);

}  // namespace tenon

template <>
struct std::hash<tenon::Path> {
  std::size_t operator()(const tenon::Path& path) const noexcept { return path.number(); }
};
