// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/view/view_scene.h"

namespace tenon::glb {

/// Simplifies the meshes so that about `budget` triangles are drawn, all by the same share; those
/// of colliders, too. A mesh that cannot be simplified (without meshoptimizer) stays. Returns how
/// many are drawn then.
std::size_t simplify_view(view::ViewScene& view, std::size_t budget);

/// Simplifies convex hulls of colliders to about `budget` triangles each. Of 128 about the 64
/// corners remain that PhysX gives a hull. Their reported volumes stay.
void simplify_hulls(view::ViewScene& view, std::size_t budget);

}  // namespace tenon::glb
