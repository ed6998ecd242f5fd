// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/result.h"
#include "tenon/mesh/mesh_scene.h"

namespace tenon::mesh {

/// Whether a scene is what mesh_scene.h says: every index in range, every list as long as it must
/// be, finite points. Errors (Corrupt, Limit kMeshCorners) name the file and what is wrong.
Result<void> check_scene(const MeshScene& scene, const std::string& path);

}  // namespace tenon::mesh
