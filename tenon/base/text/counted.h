// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace tenon {

/// "1 joint", "2 joints"; `many` where the plural is not `one` with an s.
inline std::string counted(std::size_t count, const std::string& one,
                           const std::string& many = "") {
  return std::to_string(count) + ' ' + (count == 1 ? one : many.empty() ? one + 's' : many);
}

}  // namespace tenon
