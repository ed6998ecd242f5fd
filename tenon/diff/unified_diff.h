// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace tenon::diff {

/// The lines that differ, as patch(1) reads them: "--- a/NAME", "+++ b/NAME", hunks with three
/// lines around. Empty for equal texts.
std::string unified_diff(const std::string& name, const std::string& before,
                         const std::string& after);

}  // namespace tenon::diff
