// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "tenon/view/view_scene.h"

namespace tenon::glb {

/// Thins out the meshes so that about `budget` triangles are drawn, all by the same share; those of
/// colliders, too. A mesh that cannot be thinned out (meshoptimizer is not there) stays. Returns
/// how many are drawn then.
std::size_t simplify_view(view::ViewScene& view, std::size_t budget);

/// Thins out hulls that colliders are to about `budget` triangles each. Of 128 about the 64 corners
/// remain that PhysX gives a hull. What is told of their volumes stays.
void simplify_hulls(view::ViewScene& view, std::size_t budget);

}  // namespace tenon::glb
