// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes lie in one list, operands before the operators that use them. A tree is rebuilt in one pass
// along that list, without recursion: the image of each node is made from the images of its
// operands. add_operation folds away what is everything or nothing and double complements, so trees
// that were parsed, mapped or resolved have the form that SdfPathExpression gives them. kNoNode
// means nothing. References may multiply a tree, so a rebuild stops at a bound. In text, a blank
// between two operands is a union that binds tighter than '+'.
#include "tenon/layer/expressions/path_expression.h"

#include <utility>

#include "tenon/base/limits/limits.h"

namespace tenon::layer {
namespace {

constexpr std::string_view kSetOperators[] = {"~", " ", " + ", " & ", " - "};

}  // namespace

PathExpressionTree PathExpressionTree::of(ExpressionReference reference) {
  PathExpressionTree tree;
  tree.root_ = tree.add_reference(std::move(reference));
  return tree;
}

PathExpressionTree PathExpressionTree::of(PathPattern pattern) {
  PathExpressionTree tree;
  tree.root_ = tree.add_pattern(std::move(pattern));
  return tree;
}

std::int32_t PathExpressionTree::add_pattern(PathPattern pattern) {
  patterns_.push_back(std::move(pattern));
  nodes_.push_back({kAtom, static_cast<std::int32_t>(patterns_.size() - 1), kNoNode});
  return static_cast<std::int32_t>(nodes_.size() - 1);
}

std::int32_t PathExpressionTree::add_reference(ExpressionReference reference) {
  references_.push_back(std::move(reference));
  nodes_.push_back({kAtom, static_cast<std::int32_t>(references_.size() - 1), kIsReference});
  return static_cast<std::int32_t>(nodes_.size() - 1);
}

std::int32_t PathExpressionTree::add_everything() {
  PathPattern pattern;
  pattern.set_prefix(Path::absolute_root());
  pattern.append_stretch();
  return add_pattern(std::move(pattern));
}

bool PathExpressionTree::is_everything(std::int32_t node) const {
  if (node == kNoNode || nodes_[static_cast<std::size_t>(node)].op != kAtom) {
    return false;
  }
  const PathPattern* found = pattern(nodes_[static_cast<std::size_t>(node)]);
  return found != nullptr && found->is_everything();
}

std::int32_t PathExpressionTree::add_complement(std::int32_t node) {
  if (node == kNoNode) {
    return add_everything();
  }
  if (is_everything(node)) {
    return kNoNode;
  }
  const ExpressionNode found = nodes_[static_cast<std::size_t>(node)];
  if (found.op == Complement) {
    return found.left;
  }
  nodes_.push_back({Complement, node, kNoNode});
  return static_cast<std::int32_t>(nodes_.size() - 1);
}

std::int32_t PathExpressionTree::add_operation(std::uint8_t op, std::int32_t left,
                                               std::int32_t right) {
  if (op == Complement) {
    return add_complement(left);
  }
  const auto decides = [this](std::int32_t node) { return node == kNoNode || is_everything(node); };
  if (op == Difference && (decides(left) || decides(right))) {
    op = Intersection;
    right = add_complement(right);
  }
  if (left == kNoNode || right == kNoNode) {
    return op == Intersection ? kNoNode : left == kNoNode ? right : left;
  }
  for (const auto& [one, other] : {std::pair(left, right), std::pair(right, left)}) {
    if (is_everything(one)) {
      return op == Intersection ? other : one;
    }
  }
  nodes_.push_back({op, left, right});
  return static_cast<std::int32_t>(nodes_.size() - 1);
}

std::int32_t PathExpressionTree::add_tree(const PathExpressionTree& tree) {
  const auto base = static_cast<std::int32_t>(nodes_.size());
  const auto first_pattern = static_cast<std::int32_t>(patterns_.size());
  const auto first_reference = static_cast<std::int32_t>(references_.size());
  patterns_.insert(patterns_.end(), tree.patterns_.begin(), tree.patterns_.end());
  references_.insert(references_.end(), tree.references_.begin(), tree.references_.end());
  for (ExpressionNode node : tree.nodes_) {
    if (node.op == kAtom) {
      node.left += node.right == kNoNode ? first_pattern : first_reference;
    } else {
      node.left += base;
      node.right += node.right == kNoNode ? 0 : base;
    }
    nodes_.push_back(node);
  }
  return tree.root_ == kNoNode ? kNoNode : tree.root_ + base;
}

std::optional<PathExpressionTree> PathExpressionTree::rebuilt(const Rebuild& atom) const {
  PathExpressionTree result;
  std::vector<std::int32_t> images;
  images.reserve(nodes_.size());
  const auto image = [&images](std::int32_t node) {
    return node == kNoNode ? kNoNode : images[static_cast<std::size_t>(node)];
  };
  for (const ExpressionNode& node : nodes_) {
    images.push_back(node.op == kAtom
                         ? atom(result, node)
                         : result.add_operation(node.op, image(node.left), image(node.right)));
    if (result.nodes_.size() > limits::kExpressionNodes) {
      return std::nullopt;
    }
  }
  result.root_ = image(root_);
  return result;
}

void PathExpressionTree::make_absolute(Path anchor) {
  anchor = anchor.strip_variants();  // expressions are about composed prims and cannot name others
  for (ExpressionReference& found : references_) {
    if (!found.path.empty()) {
      found.path = found.path.absolute(anchor);
    }
  }
  for (PathPattern& found : patterns_) {
    found.set_prefix(found.prefix.absolute(anchor));
  }
}

PathExpressionTree PathExpressionTree::mapped(const MapPath& map) const {
  return rebuilt([&](PathExpressionTree& out, const ExpressionNode& node) {
           if (const ExpressionReference* found = reference(node)) {
             const Path path = found->path.empty() ? Path() : map(found->path);
             return path.empty() && !found->path.empty() ? kNoNode
                                                         : out.add_reference({path, found->name});
           }
           PathPattern copy = *pattern(node);
           if (!copy.has_leading_stretch()) {
             const Path path = map(copy.prefix);
             if (path.empty()) {
               return kNoNode;
             }
             copy.set_prefix(path);
           }
           return out.add_pattern(std::move(copy));
         })
      .value_or(PathExpressionTree());
}

std::optional<PathExpressionTree> PathExpressionTree::resolved(const Resolve& resolve) const {
  return rebuilt([&](PathExpressionTree& out, const ExpressionNode& node) {
    const ExpressionReference* found = reference(node);
    return found == nullptr ? out.add_pattern(*pattern(node)) : out.add_tree(resolve(*found));
  });
}

std::optional<PathExpressionTree> PathExpressionTree::composed_over(
    const PathExpressionTree& weaker) const {
  if (is_nothing()) {
    return weaker;
  }
  return resolved([&weaker](const ExpressionReference& found) {
    return found.is_weaker() ? weaker : of(found);
  });
}

bool PathExpressionTree::has_weaker_reference() const {
  for (const ExpressionReference& found : references_) {
    if (found.is_weaker()) {
      return true;
    }
  }
  return false;
}

std::string PathExpressionTree::text() const {
  const auto append_reference = [](std::string& out, const ExpressionReference& found) {
    out += '%';
    out += found.path.str();
    out += found.is_weaker() ? "_" : ':' + found.name;
  };
  // Atoms are identified by their node, which the callback does not get: renumber them.
  std::vector<ExpressionNode> nodes = nodes_;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].op == kAtom) {
      nodes[i].left = static_cast<std::int32_t>(i);
    }
  }
  return expression_text(nodes, root_, kSetOperators, [&](std::string& out, std::int32_t number) {
    const ExpressionNode& node = nodes_[static_cast<std::size_t>(number)];
    if (const ExpressionReference* found = reference(node)) {
      append_reference(out, *found);
    } else {
      out += pattern(node)->text();
    }
  });
}

namespace {

bool make_canonical(PathExpression& expression, Path anchor) {
  Result<PathExpressionTree> tree = PathExpressionTree::parse(expression.text);
  if (!tree) {
    expression.text.clear();
    return false;
  }
  if (!anchor.empty()) {
    tree->make_absolute(anchor);
  }
  expression.text = tree->text();
  return true;
}

bool map_paths(PathExpression& expression, Path anchor, const PathExpressionTree::MapPath& map) {
  Result<PathExpressionTree> tree = PathExpressionTree::parse(expression.text);
  if (!tree) {
    return false;
  }
  tree->make_absolute(anchor);
  std::string now = tree->mapped(map).text();
  const bool changed = now != tree->text();
  if (changed) {
    expression.text = std::move(now);
  }
  return changed;
}

/// Whether `edit` was true of all expressions, and of any.
struct Outcome {
  bool all = true;
  bool any = false;
};

template <class Edit>
Outcome edit_each(Value& value, const Edit& edit) {
  Outcome outcome;
  const auto note = [&](bool one) {
    outcome.all = outcome.all && one;
    outcome.any = outcome.any || one;
  };
  if (const auto* one = value.get<PathExpression>()) {
    PathExpression copy = *one;
    note(edit(copy));
    value = std::move(copy);
  } else if (const auto* several = value.get<Array<PathExpression>>()) {
    Array<PathExpression> copy = *several;
    for (PathExpression& expression : copy) {
      note(edit(expression));
    }
    value = std::move(copy);
  }
  return outcome;
}

}  // namespace

bool make_canonical(Value& value, Path anchor) {
  return edit_each(value, [&](PathExpression& one) { return make_canonical(one, anchor); }).all;
}

bool map_paths(Value& value, Path anchor, const PathExpressionTree::MapPath& map) {
  return edit_each(value, [&](PathExpression& one) { return map_paths(one, anchor, map); }).any;
}

// Reading

class PathExpressionReader {
 public:
  explicit PathExpressionReader(std::string_view text)
      : scanner_(text), builder_([this](std::uint8_t op, std::int32_t left, std::int32_t right) {
          return tree_.add_operation(op, left, right);
        }) {}

  Result<PathExpressionTree> read() {
    scanner_.blanks();
    if (!factor() || !read_rest()) {
      scanner_.fail("expected a path expression");
      return Error(ErrorCode::Parse, "ill-formed path expression at " + scanner_.error())
          .with_rule("value.path-expression");
    }
    tree_.root_ = builder_.finish();
    return std::move(tree_);
  }

 private:
  bool read_rest() {
    for (;;) {
      const bool spaced = scanner_.blanks();
      if (const std::uint8_t op = explicit_operator()) {
        builder_.operation(op);
        scanner_.blanks();
        if (!factor()) {
          return scanner_.fail("expected a path expression after the operator");
        }
      } else if (builder_.is_open()) {
        if (scanner_.accept(')')) {
          builder_.close();
        } else if (!spaced || !union_with_factor()) {
          return scanner_.fail("expected ')' to close the group");
        }
      } else if (scanner_.at_end()) {
        return true;
      } else if (!spaced || !union_with_factor()) {
        return scanner_.fail("expected the end of the path expression");
      }
    }
  }

  bool union_with_factor() {
    builder_.operation(PathExpressionTree::ImpliedUnion);
    return factor();
  }

  std::uint8_t explicit_operator() {
    return scanner_.accept('+')   ? PathExpressionTree::Union
           : scanner_.accept('&') ? PathExpressionTree::Intersection
           : scanner_.accept('-') ? PathExpressionTree::Difference
                                  : PathExpressionTree::Atom;
  }

  /// Opens groups and takes '~' until a pattern or reference is read.
  bool factor() {
    for (;;) {
      if (scanner_.accept('~')) {
        builder_.operation(PathExpressionTree::Complement);
        scanner_.blanks();
      }
      if (scanner_.accept('(')) {
        builder_.open();
        scanner_.blanks();
        continue;
      }
      return scanner_.peek() == '%' ? reference() : pattern();
    }
  }

  bool pattern() {
    PathPattern pattern;
    if (!read_pattern(scanner_, pattern)) {
      return false;
    }
    builder_.operand(tree_.add_pattern(std::move(pattern)));
    return true;
  }

  bool reference() {
    const char after = scanner_.peek(2);
    if (scanner_.starts_with("%_") && !ExpressionScanner::is_word_character(after) &&
        after != ':') {
      scanner_.accept("%_");
      builder_.operand(tree_.add_reference({Path(), "_"}));
      return true;
    }
    scanner_.accept('%');
    const std::size_t start = scanner_.offset();
    if (scanner_.accept("..")) {
      while (scanner_.accept("/..")) {
      }
    }
    while (scanner_.accept('/')) {
      if (!identifier()) {
        return scanner_.fail("expected a name in the reference");
      }
    }
    const std::string_view path = scanner_.since(start);
    if (!scanner_.accept(':')) {
      return scanner_.fail("expected ':' and the name of a collection");
    }
    const std::size_t name = scanner_.offset();
    if (!identifier()) {
      return scanner_.fail("expected the name of a collection");
    }
    builder_.operand(tree_.add_reference(
        {path.empty() ? Path() : Path::from(path), std::string(scanner_.since(name))}));
    return true;
  }

  bool identifier() {
    const std::size_t length = scanner_.ascii_identifier().size();
    scanner_.seek(scanner_.offset() + length);
    return length > 0;
  }

  ExpressionScanner scanner_;
  PathExpressionTree tree_;
  ExpressionBuilder builder_;
};

Result<PathExpressionTree> PathExpressionTree::parse(std::string_view text) {
  return text.empty() ? PathExpressionTree() : PathExpressionReader(text).read();
}

}  // namespace tenon::layer
