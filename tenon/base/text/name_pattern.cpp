// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Expressions are those of POSIX. regcomp writes repetitions out, "(a{1000}){1000}" as a million
// characters, so their length is bounded before it begins.
#include "tenon/base/text/name_pattern.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>
#include <vector>

#include <regex.h>

#include "tenon/base/text/quoted_text.h"

namespace tenon {
namespace {

constexpr std::size_t kLongest = 1000;

bool has_back_reference(const std::string& text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == '\\') {
      if (text[i + 1] >= '1' && text[i + 1] <= '9') {
        return true;
      }
      ++i;
    }
  }
  return false;
}

/// The larger of the numbers of "{2,5}", whose "}" is at `end`.
std::size_t repetitions(std::string_view text, std::size_t begin, std::size_t end) {
  std::size_t most = 1;
  for (std::size_t at = begin; at < end; ++at) {
    std::size_t number = 0;
    const auto read = std::from_chars(text.data() + at, text.data() + end, number);
    if (read.ec == std::errc::invalid_argument) {
      continue;
    }
    most = std::max(most, read.ec == std::errc() ? number : kLongest + 1);
    at = static_cast<std::size_t>(read.ptr - text.data());
  }
  return std::min(most, kLongest + 1);
}

/// Behind the "]" that ends the list of characters whose "[" is at `at`.
std::size_t behind_list(std::string_view text, std::size_t at) {
  at += at + 1 < text.size() && text[at + 1] == '^' ? 2 : 1;
  const std::size_t end = text.find(']', at + 1);  // a "]" in front is one of the characters
  return end == std::string_view::npos ? text.size() : end + 1;
}

/// How many characters the expression has when its repetitions are written out, as regcomp does;
/// at most kLongest + 1.
std::size_t written_out(std::string_view text) {
  std::vector<std::size_t> lengths{0};  // of the open groups, the outermost first
  std::size_t last = 0;                 // of what a repetition would repeat
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    const std::size_t end = c == '{' ? text.find('}', at) : std::string_view::npos;
    if (end != std::string_view::npos) {
      const std::size_t more = last * (repetitions(text, at + 1, end) - 1);
      lengths.back() = std::min(lengths.back() + more, kLongest + 1);
      last = std::min(last + more, kLongest + 1);
      at = end + 1;
    } else if (c == '(') {
      lengths.push_back(0);
      ++at;
    } else if (c == ')' && lengths.size() > 1) {
      last = lengths.back() + 1;
      lengths.pop_back();
      lengths.back() = std::min(lengths.back() + last, kLongest + 1);
      ++at;
    } else {
      last = c == '*' || c == '+' || c == '?' ? last : 1;
      ++lengths.back();
      at = c == '\\' ? at + 2 : c == '[' ? behind_list(text, at) : at + 1;
    }
  }
  return *std::max_element(lengths.begin(), lengths.end());
}

Error bad_pattern(const std::string& text, const std::string& why) {
  return Error(ErrorCode::Invalid, quoted_text(text.substr(0, 100)) + " is no name pattern: " + why)
      .with_rule("name.bad-pattern")
      .with_fix("write a path, a name, or a regular expression such as 'finger_.*'");
}

}  // namespace

class NamePattern::Expression {
 public:
  Expression() = default;
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;
  ~Expression() {
    if (compiled_) {
      regfree(&regex_);
    }
  }

  /// What is wrong with it; empty: nothing. Compiled as it was written: inside of "^(" and ")$", a
  /// parenthesis too many would end theirs.
  std::string compile(const std::string& text) {
    const int status = regcomp(&regex_, text.c_str(), REG_EXTENDED);
    compiled_ = status == 0;
    if (compiled_) {
      return {};
    }
    std::array<char, 200> why{};
    regerror(status, &regex_, why.data(), why.size());
    return why.data();
  }
  /// The whole name. Of matches that begin first POSIX takes the longest, so where one is the
  /// whole, that is found.
  bool matches(const std::string& name) const {
    regmatch_t found{};
    return regexec(&regex_, name.c_str(), 1, &found, 0) == 0 && found.rm_so == 0 &&
           static_cast<std::size_t>(found.rm_eo) == name.size();
  }

 private:
  regex_t regex_{};
  bool compiled_ = false;
};

NamePattern::NamePattern(std::string text, std::unique_ptr<Expression> expression)
    : text_(std::move(text)), expression_(std::move(expression)) {}
NamePattern::NamePattern(NamePattern&&) noexcept = default;
NamePattern& NamePattern::operator=(NamePattern&&) noexcept = default;
NamePattern::~NamePattern() = default;

Result<NamePattern> NamePattern::parse(const std::string& text) {
  if (text.empty() || text.size() > kLongest || text.find('\0') != std::string::npos) {
    return bad_pattern(text, text.empty() ? "it is empty" : "it is too long, or no text");
  }
  if (has_back_reference(text)) {
    return bad_pattern(text, "back references are not supported");
  }
  if (written_out(text) > kLongest) {
    return bad_pattern(text, "with its repetitions written out it has more than " +
                                 std::to_string(kLongest) + " characters");
  }
  auto expression = std::make_unique<Expression>();
  if (const std::string why = expression->compile(text); !why.empty()) {
    return bad_pattern(text, why);
  }
  return NamePattern(text, std::move(expression));
}

bool NamePattern::matches(const Path& prim) const {
  const std::string path = prim.str();
  const std::string name(prim.name().str());
  return path == text_ || name == text_ || expression_->matches(path) || expression_->matches(name);
}

bool NamePattern::matches_text(const std::string& name) const {
  return name == text_ || expression_->matches(name);
}

}  // namespace tenon
