// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// A pattern begins with the longest path that can be taken literally. Only what follows the first
// wildcard, stretch or predicate is kept as components, so matching can start at a known prim. A
// stretch is a component without name and predicate, and two in a row are one. The reader tries one
// form after the other: false without a failure means that none starts here, a failure that one
// started and is wrong.
#include "tenon/layer/expressions/path_pattern.h"

#include <utility>

#include "tenon/base/limits/limits.h"

namespace tenon::layer {

void PathPattern::append(std::string_view name, PredicateExpression predicate, bool is_literal) {
  Component component{std::string(name), kNoNode, is_literal};
  if (!predicate.nodes.empty()) {
    component.predicate = static_cast<std::int32_t>(predicates.size());
    predicates.push_back(std::move(predicate));
  }
  components.push_back(std::move(component));
}

void PathPattern::append_child(std::string_view name, PredicateExpression predicate) {
  if (prefix.empty()) {
    prefix = Path::relative_root();
  }
  const bool is_literal = is_identifier(name);
  const bool is_plain = (is_literal || name == "..") && predicate.nodes.empty();
  if (is_plain && components.empty() && prefix.depth() < limits::kPathElements) {
    prefix = prefix.child(Token(name));
  } else {
    append(name, std::move(predicate), is_literal);
  }
}

void PathPattern::append_property(std::string_view name, PredicateExpression predicate) {
  const bool is_literal = is_namespaced_identifier(name);
  if (is_literal && predicate.nodes.empty() && components.empty()) {
    prefix = prefix.property(Token(name));
  } else {
    append(name, std::move(predicate), is_literal);
  }
  is_property = true;
}

void PathPattern::append_stretch() {
  if (prefix.empty()) {
    prefix = Path::relative_root();
  }
  if (!has_trailing_stretch()) {
    append({}, {}, false);
  }
}

void PathPattern::set_prefix(Path path) {
  const bool is_prim = path.is_prim() || path.kind() == PathKind::AbsoluteRoot ||
                       path.kind() == PathKind::RelativeRoot;
  const bool is_prim_property = path.is_property() && path.parent().is_prim_or_root();
  if (is_prim || (components.empty() && is_prim_property)) {
    prefix = path;
    is_property = components.empty() ? is_prim_property : is_property;
  }
}

std::string PathPattern::text() const {
  std::string out;
  const bool is_relative = prefix == Path::relative_root();
  if (!is_relative) {
    out = prefix.str();
  } else if (components.empty() || components.front().is_stretch()) {
    out = ".";
  }
  for (const Component& component : components) {
    if (component.is_stretch()) {
      out += &component == &components.front() && prefix.is_absolute_root() ? "/" : "//";
      continue;
    }
    if (is_property && &component == &components.back()) {
      out += '.';
    } else if (!out.empty() && out.back() != '/') {
      out += '/';
    }
    out += component.name;
    if (component.predicate != kNoNode) {
      out += '{' + predicates[static_cast<std::size_t>(component.predicate)].text() + '}';
    }
  }
  return out;
}

namespace {

class PatternReader {
 public:
  PatternReader(ExpressionScanner& scanner, PathPattern& result)
      : scanner_(scanner), result_(result) {}

  bool read() {
    if (scanner_.peek() == '/') {
      result_.set_prefix(Path::absolute_root());
      if (!stretch()) {
        scanner_.accept('/');
      }
      return elements() || !scanner_.failed();
    }
    if (scanner_.starts_with("..")) {
      return steps_up();
    }
    if (elements() || scanner_.failed()) {
      return !scanner_.failed();
    }
    if (!scanner_.accept('.')) {
      return false;
    }
    result_.set_prefix(Path::relative_root());
    return !stretch() || elements() || !scanner_.failed();
  }

 private:
  static bool is_word(char c) { return ExpressionScanner::is_word_character(c); }

  bool stretch() {
    if (!scanner_.accept("//")) {
      return false;
    }
    result_.append_stretch();
    return true;
  }

  bool steps_up() {
    scanner_.accept("..");
    result_.append_child("..", {});
    while (scanner_.accept("/..")) {
      result_.append_child("..", {});
    }
    if (stretch()) {
      return elements() || !scanner_.failed();
    }
    if (scanner_.accept('/')) {
      return elements() || scanner_.fail("expected a path pattern element after '/'");
    }
    return true;
  }

  /// At least one element; false without a failure when none starts here.
  bool elements() {
    if (!element(false)) {
      return false;
    }
    for (;;) {
      const std::size_t before = scanner_.offset();
      if (scanner_.accept("//")) {
        if (!at_element(false)) {
          scanner_.seek(before);
          break;
        }
        result_.append_stretch();
      } else if (!scanner_.accept('/')) {
        break;
      }
      if (!element(false)) {
        return scanner_.fail("expected a path pattern element");
      }
    }
    if (scanner_.accept('.')) {
      return element(true) || scanner_.fail("expected a property pattern element after '.'");
    }
    stretch();
    return true;
  }

  bool at_name(bool property) const {
    const char c = scanner_.peek();
    return is_word(c) || c == '?' || c == '*' || c == '[' || (property && c == ':');
  }
  bool at_element(bool property) const { return at_name(property) || scanner_.peek() == '{'; }

  /// A name, a predicate, or both.
  bool element(bool property) {
    if (!at_element(property)) {
      return false;
    }
    const std::size_t start = scanner_.offset();
    while (at_name(property)) {
      if (!scanner_.accept('[')) {
        scanner_.seek(scanner_.offset() + 1);
      } else if (!character_set()) {
        return false;
      }
    }
    const std::string_view name = scanner_.since(start);
    PredicateExpression predicate;
    if (scanner_.accept('{')) {
      scanner_.blanks();
      if (!read_predicate(scanner_, predicate)) {
        return false;
      }
      scanner_.blanks();
      if (!scanner_.accept('}')) {
        return scanner_.fail("expected '}' to close the predicate");
      }
    }
    if (property) {
      result_.append_property(name, std::move(predicate));
    } else {
      result_.append_child(name, std::move(predicate));
    }
    return true;
  }

  /// What follows '['.
  bool character_set() {
    const std::size_t start = scanner_.offset();
    const auto in_set = [](char c) {
      return is_word(c) || c == '!' || c == '-' || c == '?' || c == '*';
    };
    while (in_set(scanner_.peek())) {
      scanner_.seek(scanner_.offset() + 1);
    }
    return (scanner_.offset() > start && scanner_.accept(']')) ||
           scanner_.fail("expected ']' to close the character set");
  }

  ExpressionScanner& scanner_;
  PathPattern& result_;
};

}  // namespace

bool read_pattern(ExpressionScanner& scanner, PathPattern& pattern) {
  return PatternReader(scanner, pattern).read();
}

}  // namespace tenon::layer
