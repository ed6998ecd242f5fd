// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "tenon/base/result.h"

namespace tenon {

/// "NAME=VALUE" split at the first '='. Errors: Invalid, without a '=' or without a name.
Result<std::pair<std::string, std::string>> split_assignment(const std::string& text);

}  // namespace tenon
