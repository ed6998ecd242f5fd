// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace tenon::robot {

/// What a mesh collides as.
enum class Approximation : std::uint8_t {
  Hull,           ///< its convex hull
  Decomposition,  ///< convex pieces
  Sphere,         ///< a sphere around it
  None,           ///< the mesh itself, triangle by triangle
};

}  // namespace tenon::robot
