// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/path.h"
#include "tenon/base/result.h"
#include "tenon/layer/expressions/expression_tree.h"
#include "tenon/layer/expressions/path_pattern.h"
#include "tenon/layer/value.h"

namespace tenon::layer {

/// `%/World:lights`: what the collection "lights" of the prim /World matches. `%:lights` is one of
/// the prim that holds the expression; `%_` is the opinion of the next weaker layer.
struct ExpressionReference {
  Path path;  ///< empty: the prim that holds the expression
  std::string name;
  bool is_weaker() const { return path.empty() && name == "_"; }
  bool operator==(const ExpressionReference&) const = default;
};

/// A path expression, read: patterns and references under set operators. It stays in the form that
/// SdfPathExpression gives it: what is everything or nothing is simplified away.
class PathExpressionTree {
 public:
  enum Op : std::uint8_t {
    Atom = kAtom,
    Complement = kUnary,
    ImpliedUnion,
    Union,
    Intersection,
    Difference,
  };

  /// Matches nothing; its text is "".
  PathExpressionTree() = default;
  /// An Error that tells the character where the text is wrong. "" is nothing.
  static Result<PathExpressionTree> parse(std::string_view text);
  static PathExpressionTree of(ExpressionReference reference);
  static PathExpressionTree of(PathPattern pattern);

  std::string text() const;
  bool is_nothing() const { return root_ == kNoNode; }
  bool has_weaker_reference() const;

  /// Operands before operators; some may lie outside of the tree under `root`.
  const std::vector<ExpressionNode>& nodes() const { return nodes_; }
  /// What an atom is: one of these is not null.
  const PathPattern* pattern(const ExpressionNode& node) const {
    return node.right == kNoNode ? &patterns_[static_cast<std::size_t>(node.left)] : nullptr;
  }
  const ExpressionReference* reference(const ExpressionNode& node) const {
    return node.right == kNoNode ? nullptr : &references_[static_cast<std::size_t>(node.left)];
  }
  std::int32_t root() const { return root_; }

  /// Relative paths taken from `anchor`, a prim, or one inside a variant for the prim it makes.
  void make_absolute(Path anchor);

  using MapPath = std::function<Path(Path)>;  ///< an empty path: has no image
  /// Every path mapped; what has no image matches nothing. Patterns that start with "//" and
  /// references without a path stay.
  PathExpressionTree mapped(const MapPath& map) const;

  using Resolve = std::function<PathExpressionTree(const ExpressionReference&)>;
  /// References replaced. nullopt when that gives more than limits::kExpressionNodes nodes.
  std::optional<PathExpressionTree> resolved(const Resolve& resolve) const;
  /// `%_` replaced by `weaker`; an empty expression lets all of `weaker` through.
  std::optional<PathExpressionTree> composed_over(const PathExpressionTree& weaker) const;

 private:
  friend class PathExpressionReader;
  using Rebuild = std::function<std::int32_t(PathExpressionTree&, const ExpressionNode&)>;

  bool is_everything(std::int32_t node) const;
  std::int32_t add_pattern(PathPattern pattern);
  std::int32_t add_reference(ExpressionReference reference);
  std::int32_t add_everything();
  std::int32_t add_operation(std::uint8_t op, std::int32_t left, std::int32_t right);
  std::int32_t add_complement(std::int32_t node);
  std::int32_t add_tree(const PathExpressionTree& tree);
  std::optional<PathExpressionTree> rebuilt(const Rebuild& atom) const;

  // `left` of an atom is its number among the patterns or references; `right` tells which.
  static constexpr std::int32_t kIsReference = 0;
  std::vector<ExpressionNode> nodes_;
  std::vector<PathPattern> patterns_;
  std::vector<ExpressionReference> references_;
  std::int32_t root_ = kNoNode;
};

/// The path expressions that `value` is or lists, in canonical form; one that is malformed becomes
/// nothing (""), and the result is false. With an `anchor` relative paths are taken from there.
bool make_canonical(Value& value, Path anchor = {});

/// The same with every path mapped, relative ones from `anchor`. An expression that is malformed,
/// or whose paths all stay, keeps its text. False where nothing changed.
bool map_paths(Value& value, Path anchor, const PathExpressionTree::MapPath& map);

}  // namespace tenon::layer
