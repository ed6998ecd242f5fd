// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tenon/scene/physics_scene.h"

namespace tenon::approximate {

/// As few triangles as stay within one hundredth of the mesh's size of it, by edge collapse with
/// quadric errors (Garland and Heckbert 1997) in meshoptimizer. Points are a subset of the mesh's.
scene::TriangleMesh simplified(const scene::TriangleMesh& mesh);

}  // namespace tenon::approximate
