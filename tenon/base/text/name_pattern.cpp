// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/text/name_pattern.h"

#include <array>
#include <utility>

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
