// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "tenon/scene/physics_scene.h"

namespace tenon::approximate {

/// As few triangles as stay within one hundredth of the mesh's size of it, by edge collapse with
/// quadric errors (Garland and Heckbert 1997) in meshoptimizer. Points are a subset of the mesh's.
/// Nothing where meshoptimizer is not there, or limits::kMeshOptimizerWork is exceeded.
std::optional<scene::TriangleMesh> simplified(const scene::TriangleMesh& mesh);

/// For example "0.18"; empty where it is not there.
std::string meshoptimizer_version();

}  // namespace tenon::approximate
