// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/mesh_tools.h"

namespace tenon::approximate {

/// lib_coacd.so can be loaded and has what is needed: from the file that the environment variable
/// TENON_COACD_LIBRARY names, else from lib/tenon/coacd of the prefix that this code lies in.
bool coacd_is_there();

/// Convex pieces of a closed mesh (Wei et al., Approximate Convex Decomposition for 3D Meshes with
/// Collision-Aware Concavity and Tree Search, 2022), in the same order every time; empty when the
/// library fails or is not there.
std::vector<scene::TriangleMesh> coacd_pieces(const scene::TriangleMesh& mesh,
                                              const scene::Decomposition& how);

}  // namespace tenon::approximate
