// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
// Reads expressions. Blanks may stand only where arguments and list items are told apart.
#include "tenon/compose/variable_expression_tree.h"

#include <cctype>
#include <optional>

#include "tenon/base/limits.h"
#include "tenon/base/text_number.h"

namespace tenon::compose::expression {
namespace {

struct Function {
  std::string_view name;
  std::size_t least;
  std::size_t most;
};

constexpr std::size_t kAny = 1u << 20;
constexpr Function kFunctions[] = {
    {"if", 2, 3},       {"eq", 2, 2},  {"neq", 2, 2},    {"lt", 2, 2},         {"leq", 2, 2},
    {"gt", 2, 2},       {"geq", 2, 2}, {"and", 2, kAny}, {"or", 2, kAny},      {"not", 1, 1},
    {"contains", 2, 2}, {"at", 2, 2},  {"len", 1, 1},    {"defined", 1, kAny},
};

bool is_name_character(char c, bool first) {
  return c == '_' || std::isalpha(static_cast<unsigned char>(c)) != 0 ||
         (!first && std::isdigit(static_cast<unsigned char>(c)) != 0);
}

/// The value of `digits` in `base` from `at` on, at most `most` of them.
char character_code(const std::string& raw, std::size_t& at, int base, int most) {
  int code = 0;
  for (; most > 0 && at < raw.size(); --most, ++at) {
    const char c = static_cast<char>(std::tolower(static_cast<unsigned char>(raw[at])));
    const int digit = c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : 16;
    if (digit >= base) {
      break;
    }
    code = code * base + digit;
  }
  return static_cast<char>(code);
}

/// Backslashes and what follows them, as in text layers.
std::string unescaped(const std::string& raw) {
  constexpr std::string_view kLetters = "abfnrtv";
  constexpr std::string_view kControls = "\a\b\f\n\r\t\v";
  std::string result;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != '\\' || i + 1 == raw.size()) {
      result += raw[i];
      continue;
    }
    const char c = raw[++i];
    const std::size_t letter = kLetters.find(c);
    if (c == 'x' || (c >= '0' && c <= '7')) {
      i += c == 'x' ? 1 : 0;
      result += c == 'x' ? character_code(raw, i, 16, 2) : character_code(raw, i, 8, 3);
      --i;
    } else {
      result += letter == std::string_view::npos ? c : kControls[letter];
    }
  }
  return result;
}

/// Reads the text between the backquotes; the root of the tree is its last node.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Tree parse() {
    value(0, true);
    if (at_ != text_.size()) {
      fail("unexpected text at '" + std::string(text_.substr(at_)) + "'");
    }
    return std::move(tree_);
  }
  const std::string& error() const { return error_; }

 private:
  std::size_t fail(std::string message) {
    if (error_.empty()) {
      error_ = std::move(message);
    }
    at_ = text_.size();
    return add({});
  }
  std::size_t add(TreeNode node) {
    tree_.push_back(std::move(node));
    return tree_.size() - 1;
  }
  std::size_t add_constant(ExpressionValue value) {
    TreeNode node;
    node.constant = std::move(value);
    return add(std::move(node));
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks() {
    while (peek() == ' ') {
      ++at_;
    }
  }
  bool take(char c) {
    const bool found = at_ < text_.size() && text_[at_] == c;
    at_ += found ? 1 : 0;
    return found;
  }
  std::string word() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_name_character(text_[at_], at_ == start)) {
      ++at_;
    }
    return std::string(text_.substr(start, at_ - start));
  }

  std::size_t value(std::size_t depth, bool list_allowed) {
    if (depth > limits::kExpressionDepth) {
      return fail("too deeply nested");
    }
    const char c = peek();
    if (c == '"' || c == '\'') {
      return quoted_text();
    }
    if (c == '$') {
      return variable();
    }
    if (c == '[' && list_allowed) {
      return list(depth);
    }
    if (c == '-' || std::isdigit(static_cast<unsigned char>(c)) != 0) {
      return number();
    }
    const std::string name = word();
    if (name.empty()) {
      return fail("unexpected " + (c == '\0' ? "end" : "'" + std::string(1, c) + "'"));
    }
    if (const std::optional<ExpressionValue> constant = constant_of(name)) {
      return add_constant(*constant);
    }
    skip_blanks();
    return take('(') ? call(name, depth) : fail("unknown word '" + name + "'");
  }

  static std::optional<ExpressionValue> constant_of(const std::string& name) {
    if (name == "True" || name == "true" || name == "False" || name == "false") {
      return of_bool(name[0] == 'T' || name[0] == 't');
    }
    return name == "None" || name == "none" ? std::optional(none()) : std::nullopt;
  }

  std::size_t number() {
    const std::size_t start = at_;
    ++at_;
    while (std::isdigit(static_cast<unsigned char>(peek())) != 0) {
      ++at_;
    }
    const auto parsed = parse_int64(text_.substr(start, at_ - start));
    return parsed ? add_constant(of_int(*parsed)) : fail("no integer of 64 bits");
  }

  std::size_t variable() {
    ++at_;
    TreeNode node;
    node.type = TreeNode::Type::Variable;
    if (!take('{') || (node.name = word()).empty() || !take('}')) {
      return fail("expected '${', a variable name and '}'");
    }
    return add(std::move(node));
  }

  std::size_t quoted_text() {
    const char quote = text_[at_++];
    TreeNode node;
    node.type = TreeNode::Type::Text;
    std::string plain;
    const auto end_plain = [&] {
      if (!plain.empty()) {
        node.operands.push_back(add_constant(of_text(unescaped(plain))));
        plain.clear();
      }
    };
    while (at_ < text_.size() && text_[at_] != quote) {
      if (text_.substr(at_, 2) == "${") {
        end_plain();
        node.operands.push_back(variable());
        continue;
      }
      const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
      const bool escaped =
          text_[at_] == '\\' && (next == '`' || next == '$' || next == '\\' || next == quote);
      plain += text_.substr(at_, escaped ? 2 : 1);
      at_ += escaped ? 2 : 1;
    }
    end_plain();
    return take(quote) ? add(std::move(node)) : fail("missing closing quote");
  }

  /// What stands between brackets, told apart by commas.
  std::vector<std::size_t> items(std::size_t depth, bool lists_allowed) {
    std::vector<std::size_t> found;
    do {
      skip_blanks();
      found.push_back(value(depth + 1, lists_allowed));
      const std::size_t end = at_;
      skip_blanks();
      if (peek() != ',') {
        at_ = end;
      }
    } while (error_.empty() && take(','));
    return found;
  }

  std::size_t list(std::size_t depth) {
    ++at_;
    TreeNode node;
    node.type = TreeNode::Type::List;
    const bool blank_first = peek() == ' ';
    if (blank_first) {
      skip_blanks();
    }
    if (!take(']')) {
      if (blank_first) {
        return fail("unexpected blank in a list");
      }
      node.operands = items(depth, false);
      if (!take(']')) {
        return fail("missing closing ']'");
      }
    }
    return add(std::move(node));
  }

  std::size_t call(const std::string& name, std::size_t depth) {
    TreeNode node;
    node.type = TreeNode::Type::Call;
    node.name = name;
    skip_blanks();
    if (!take(')')) {
      node.operands = items(depth, true);
      skip_blanks();
      if (!take(')')) {
        return fail("missing closing ')'");
      }
    }
    skip_blanks();
    const std::size_t count = node.operands.size();
    for (const Function& function : kFunctions) {
      if (function.name == name && count >= function.least && count <= function.most) {
        return add(std::move(node));
      }
    }
    return fail("no function '" + name + "' with " + std::to_string(count) + " arguments");
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string error_;
  Tree tree_;
};

}  // namespace

Tree parse(std::string_view text, std::string& error) {
  Parser parser(text);
  Tree tree = parser.parse();
  error = parser.error();
  return error.empty() ? std::move(tree) : Tree();
}

}  // namespace tenon::compose::expression
