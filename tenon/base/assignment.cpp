// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/base/assignment.h"

#include <cstddef>

namespace tenon {

Result<std::pair<std::string, std::string>> split_assignment(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0) {
    return Error(ErrorCode::Invalid, "\"" + text + "\" is not of the form NAME=VALUE");
  }
  return std::pair(text.substr(0, at), text.substr(at + 1));
}

}  // namespace tenon
