// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

/// Limits on measuring what collides.
namespace tenon::limits {

inline constexpr std::size_t kSurfaceParts = 100'000;    ///< triangles halved for one distance
inline constexpr std::size_t kSurfaceWork = 50'000'000;  ///< boxes, triangles, planes for it
/// Squares of the triangles at each point of a mesh, added up, that meshoptimizer is given.
inline constexpr std::size_t kMeshOptimizerWork = 400'000'000;

}  // namespace tenon::limits
