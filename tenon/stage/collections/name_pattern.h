// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace tenon::stage {

/// `name` as a whole matches `pattern`, which may hold '*', '?' and character sets such as `[a-z_]`
/// ('!' in a set is a literal, as in OpenUSD). Linear in the name times the pattern.
bool name_matches(std::string_view pattern, std::string_view name);

}  // namespace tenon::stage
