// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/containers/numbered_store.h"
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

struct PathNode;

/// Where something is in a scene or a layer. Two numbers of four bytes: of an element, which is
/// interned, and of the name of a property below it. So copying, equality and hashing cost next to
/// nothing, and naming a property needs no table. Core Spec 1.0.1 section 6 gives the grammar.
class Path {
 public:
  Path() = default;
  static Path absolute_root();
  static Path relative_root();

  /// Reads the text form of any kind of path. "" is an error.
  static Result<Path> parse(std::string_view text);
  /// The same for text that is known to be right; an empty path otherwise.
  static Path from(std::string_view text);

  PathKind kind() const;
  bool empty() const { return element_ == 0; }
  bool is_absolute() const;
  bool is_absolute_root() const { return kind() == PathKind::AbsoluteRoot; }
  bool is_prim() const { return kind() == PathKind::Prim; }
  bool is_prim_or_root() const { return is_prim() || is_absolute_root(); }
  bool is_variant_selection() const { return kind() == PathKind::VariantSelection; }
  bool is_prim_or_variant() const { return is_prim() || is_variant_selection(); }
  bool is_property() const {
    const PathKind last = kind();
    return last == PathKind::Property || last == PathKind::RelationalAttribute;
  }
  /// A property of a prim, variant or target, as are all that text can express. That it is one, and
  /// its owner, is known without a look at any table.
  bool is_direct_property() const { return property_ != 0; }
  bool is_direct_property_of(Path owner) const {
    return element_ == owner.element_ && property_ != 0 && owner.property_ == 0;
  }
  bool is_target() const { return kind() == PathKind::Target; }
  bool has_variants() const;
  std::uint32_t depth() const;

  /// Name of the last element: prim, property or variant set; empty for a root.
  Token name() const;
  /// Variant name of a VariantSelection element.
  Token variant() const;
  /// Target inside the brackets of a Target or Mapper element.
  Path target() const;

  /// One element less; an empty path for a root.
  Path parent() const;
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
  /// Equal for equal paths alone, in this process.
  std::uint64_t id() const { return std::uint64_t{property_} << 32u | element_; }
  /// A hash: paths of prims that were made one after another have neighbouring numbers, so that
  /// tables by path are walked through in their order. 0 for the empty path.
  std::uint32_t number() const { return element_ + property_ * 0x9E3779B1u; }

  bool operator==(const Path& other) const { return id() == other.id(); }
  /// Total order, the same in every run: element by element, a path before what is below it.
  std::strong_ordering operator<=>(const Path& other) const;

 private:
  friend struct PathNode;

  Path(std::uint32_t element, std::uint32_t property) : element_(element), property_(property) {}
  const PathNode& node() const;
  Path above(std::uint32_t depth) const;
  /// An element with a node of its own, below this path.
  Path make(PathKind kind, std::uint32_t name, Path detail) const;
  /// Below this path, the last element of `path`, with this detail of its node.
  Path make_like(Path path, Path detail) const;
  static Path intern(const PathNode& node);

  static NumberedStore<PathNode> nodes_;

  std::uint32_t element_ = 0;   // number of its node; 0 for the empty path
  std::uint32_t property_ = 0;  // number of the property's name; 0 where the last is no property
};

/// One interned element, never freed. Internal to Path. A property is one only where it stands
/// below another, as in no path that the grammar has.
struct PathNode {
  Path parent;
  Path detail;             ///< the target of Target and Mapper elements; of others see `make`
  std::uint32_t name = 0;  ///< number of a token, see `Path::name`; 0 for none
  PathKind kind : 8 = PathKind::Empty;
  std::uint32_t absolute : 1 = 0;
  std::uint32_t has_variant : 1 = 0;  ///< this or any element above is a variant selection
  std::uint32_t depth : 22 = 0;       ///< elements below the root

 private:
  static const PathNode* const of_empty;
};
static_assert(sizeof(PathNode) == 24);

inline const PathNode& Path::node() const { return nodes_[element_]; }
inline PathKind Path::kind() const {
  const PathKind above = node().kind;
  return property_ == 0              ? above
         : above == PathKind::Target ? PathKind::RelationalAttribute
                                     : PathKind::Property;
}
inline bool Path::is_absolute() const { return node().absolute != 0; }
inline bool Path::has_variants() const { return node().has_variant != 0; }
inline std::uint32_t Path::depth() const { return node().depth + (property_ == 0 ? 0u : 1u); }
inline Token Path::name() const {
  const std::uint32_t name = property_ == 0 ? node().name : property_;
  return name == 0 ? Token() : Token::numbered(name);
}
inline Path Path::parent() const { return property_ == 0 ? node().parent : Path(element_, 0); }

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
