// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits on measuring what collides.
namespace tenon::limits {

inline constexpr std::size_t kSurfaceParts = 100'000;  ///< triangles halved for one distance

}  // namespace tenon::limits
