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

}  // namespace tenon::glb
