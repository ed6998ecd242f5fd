// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tenon/base/result.h"

namespace tenon::cli {

/// "set=variant|variant,set=...": which variants to fall back to, best first.
Result<std::map<std::string, std::vector<std::string>>> parse_variant_fallbacks(
    const std::string& text);

}  // namespace tenon::cli
