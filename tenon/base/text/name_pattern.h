// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "tenon/base/path.h"
#include "tenon/base/result.h"

namespace tenon {

/// Which prims a text means: its path, its name, or a regular expression (POSIX extended) that
/// matches the whole of either.
class NamePattern {
 public:
  /// Errors: Invalid (rule name.bad-pattern) for what is no expression, for more than 1,000 bytes,
  /// and for back references, whose search has no bound.
  static Result<NamePattern> parse(const std::string& text);
  NamePattern(NamePattern&&) noexcept;
  NamePattern& operator=(NamePattern&&) noexcept;
  ~NamePattern();

  const std::string& text() const { return text_; }
  bool matches(const Path& prim) const;
  /// The same for a name of any letters, in the place of a prim.
  bool matches_text(const std::string& name) const;

 private:
  class Expression;
  NamePattern(std::string text, std::unique_ptr<Expression> expression);

  std::string text_;
  std::unique_ptr<Expression> expression_;
};

}  // namespace tenon
