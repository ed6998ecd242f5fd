// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace tenon {

/// "joint" for one, "joints" for others; `many` where the plural is not `one` with an s.
inline std::string noun_for(std::size_t count, const std::string& one,
                            const std::string& many = "") {
  return count == 1 ? one : many.empty() ? one + 's' : many;
}

/// "1 joint", "2 joints".
inline std::string counted(std::size_t count, const std::string& one,
                           const std::string& many = "") {
  return std::to_string(count) + ' ' + noun_for(count, one, many);
}

}  // namespace tenon
