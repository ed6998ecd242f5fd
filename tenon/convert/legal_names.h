// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/text/unique_names.h"
#include "tenon/base/token.h"

namespace tenon::convert {

/// Names of the children of one prim: identifiers, each given once.
class NameScope {
 public:
  /// `wanted` where it is an identifier and free; else what it becomes by writing '_' for each
  /// character that no identifier has and, where that is taken, a number behind it. The same calls
  /// give the same names.
  Token make(std::string_view wanted);

 private:
  UniqueNames names_;
};

/// `text` as an identifier: unchanged where it is one.
std::string legal_name(std::string_view text);

}  // namespace tenon::convert
