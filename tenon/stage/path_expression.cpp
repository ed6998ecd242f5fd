// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Path expressions (Core Spec 1.0.1): patterns combined by operators. '~' binds tightest, then '&',
// then '-', then '+', '|' and blanks. A pattern is a path whose names may hold '*', '?' and
// bracketed character sets; "//" stands for any number of levels.
#include <string_view>
#include <vector>

#include "tenon/stage/collection.h"

namespace tenon::stage {
namespace {

// '[' set ']' at the head of `pattern`: whether `c` is in it, and its length (0: no set).
struct SetMatch {
  bool matches = false;
  std::size_t length = 0;
};
SetMatch match_set(std::string_view pattern, char c) {
  const std::size_t end = pattern.find(']', 1);
  if (end == std::string_view::npos) {
    return {};
  }
  SetMatch result{false, end + 1};
  for (std::size_t i = 1; i < end; ++i) {
    if (i + 2 < end && pattern[i + 1] == '-') {
      result.matches = result.matches || (pattern[i] <= c && c <= pattern[i + 2]);
      i += 2;
    } else {
      result.matches = result.matches || pattern[i] == c;
    }
  }
  return result;
}

// Greedy with one point to come back to, so linear times the number of stars at worst.
bool name_matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0;
  std::size_t n = 0;
  std::size_t star = std::string_view::npos;
  std::size_t resume = 0;
  while (n < name.size()) {
    const SetMatch set = p < pattern.size() && pattern[p] == '['
                             ? match_set(pattern.substr(p), name[n])
                             : SetMatch();
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && set.length > 0 && set.matches) {
      p += set.length;
      ++n;
    } else if (p < pattern.size() && set.length == 0 &&
               (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') {
    ++p;
  }
  return p == pattern.size();
}

constexpr std::string_view kAnyLevels = "//";

struct Pattern {
  std::vector<std::string_view> names;  // kAnyLevels stands for "//"
  std::string_view property;            // empty: prims only
};

Pattern split_pattern(std::string_view text) {
  Pattern result;
  const std::size_t dot = text.find('.');
  if (dot != std::string_view::npos && !text.starts_with("./") && text != ".") {
    result.property = text.substr(dot + 1);
    text = text.substr(0, dot);
  }
  while (!text.empty()) {
    if (text.starts_with(kAnyLevels)) {
      result.names.push_back(kAnyLevels);
      text.remove_prefix(2);
      continue;
    }
    if (text.front() == '/') {
      text.remove_prefix(1);
      continue;
    }
    const std::size_t end = text.find('/');
    result.names.push_back(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view() : text.substr(end);
  }
  return result;
}

// reachable[j]: the names so far match the first j parts of the pattern.
bool names_match(const std::vector<std::string_view>& pattern,
                 const std::vector<std::string_view>& names) {
  std::vector<bool> reachable(pattern.size() + 1, false);
  reachable[0] = true;
  const auto skip_levels = [&] {
    for (std::size_t j = 0; j < pattern.size(); ++j) {
      if (reachable[j] && pattern[j] == kAnyLevels) {
        reachable[j + 1] = true;
      }
    }
  };
  skip_levels();
  for (const std::string_view name : names) {
    std::vector<bool> next(pattern.size() + 1, false);
    for (std::size_t j = 0; j < pattern.size(); ++j) {
      if (!reachable[j]) {
        continue;
      }
      if (pattern[j] == kAnyLevels) {
        next[j] = true;
      } else if (name_matches(pattern[j], name)) {
        next[j + 1] = true;
      }
    }
    reachable = std::move(next);
    skip_levels();
  }
  return reachable[pattern.size()];
}

bool pattern_matches(std::string_view text, Path anchor, Path path) {
  std::string absolute(text);
  if (!text.starts_with('/')) {
    absolute = (anchor.is_absolute_root() ? "" : anchor.str()) + "/" +
               std::string(text.starts_with("./") ? text.substr(2) : text);
  }
  const Pattern pattern = split_pattern(absolute);
  if (path.is_property() != !pattern.property.empty() ||
      (path.is_property() && !name_matches(pattern.property, path.name().view()))) {
    return false;
  }
  std::vector<std::string_view> names;
  for (const Path at : path.prim().prefixes()) {
    if (!at.is_absolute_root()) {
      names.push_back(at.name().view());
    }
  }
  // "/A//" is A and everything below it.
  return names_match(pattern.names, names);
}

// Value and operator stacks instead of recursion: parentheses nest as deep as the text is long.
class Evaluator {
 public:
  Evaluator(std::string_view text, Path anchor, Path path)
      : text_(text), anchor_(anchor), path_(path) {}

  bool run() {
    bool after_operand = false;
    while (skip_blanks()) {
      const char c = text_.front();
      const bool binary = c == '+' || c == '|' || c == '&' || c == '-' || c == ')';
      if (after_operand && !binary) {
        push('+');  // a blank joins
      }
      if (c == '(' || (c == '~' && !after_operand)) {
        text_.remove_prefix(1);
        operators_.push_back(c);
        after_operand = false;
      } else if (c == ')') {
        text_.remove_prefix(1);
        close();
        after_operand = true;
      } else if (binary) {
        text_.remove_prefix(1);
        push(c == '|' ? '+' : c);
        after_operand = false;
      } else {
        values_.push_back(take_pattern());
        after_operand = true;
      }
    }
    while (!operators_.empty()) {
      apply();
    }
    return !values_.empty() && values_.back();
  }

 private:
  static int rank(char op) {
    return op == '~' ? 4 : op == '&' ? 3 : op == '-' ? 2 : op == '+' ? 1 : 0;
  }

  bool skip_blanks() {
    const std::size_t first = text_.find_first_not_of(" \t\r\n");
    text_ = first == std::string_view::npos ? std::string_view() : text_.substr(first);
    return !text_.empty();
  }

  bool take_pattern() {
    const std::size_t end = text_.find_first_of(" \t\r\n+|&()-");
    const std::string_view pattern = text_.substr(0, end == 0 ? 1 : end);
    text_.remove_prefix(pattern.size());
    const bool reference = pattern.find('%') != std::string_view::npos;
    const bool predicate = pattern.find('{') != std::string_view::npos;
    return !reference && !predicate && pattern_matches(pattern, anchor_, path_);
  }

  void push(char op) {
    while (!operators_.empty() && rank(operators_.back()) >= rank(op)) {
      apply();
    }
    operators_.push_back(op);
  }

  void close() {
    while (!operators_.empty() && operators_.back() != '(') {
      apply();
    }
    if (!operators_.empty()) {
      operators_.pop_back();
    }
  }

  bool pop() {
    const bool value = !values_.empty() && values_.back();
    if (!values_.empty()) {
      values_.pop_back();
    }
    return value;
  }

  void apply() {
    const char op = operators_.back();
    operators_.pop_back();
    const bool right = op == '(' ? false : pop();
    if (op == '~') {
      values_.push_back(!right);
    } else if (op != '(') {
      const bool left = pop();
      values_.push_back(op == '&' ? left && right : op == '-' ? left && !right : left || right);
    }
  }

  std::string_view text_;
  Path anchor_;
  Path path_;
  std::vector<bool> values_;
  std::vector<char> operators_;
};

}  // namespace

bool expression_matches(const std::string& expression, Path anchor, Path path) {
  return Evaluator(expression, anchor, path).run();
}

}  // namespace tenon::stage
