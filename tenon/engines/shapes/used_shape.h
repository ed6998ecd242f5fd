// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/scene/physics_scene.h"

namespace tenon::engines {

/// What an engine collides with in the place of a collider, in its runs.
struct UsedShape {
  enum class Kind : std::uint8_t {
    None,       ///< it takes part in nothing
    Shape,      ///< Collider::shape as it is
    Hulls,      ///< convex pieces
    Triangles,  ///< touched from their front sides
  };

  Kind kind = Kind::None;
  /// Of Hulls the surface of each, of Triangles one; in the collider's frame, outward [m].
  std::vector<scene::TriangleMesh> surfaces;
  std::vector<std::string> notes;  ///< what is not as in the asset
};

}  // namespace tenon::engines
