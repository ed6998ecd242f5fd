// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/mesh/mesh_scene.h"

namespace tenon::mesh {

/// Whether the library that reads .dae, .gltf and .glb is there, and its version ("5.2").
bool has_assimp();
std::string assimp_version();

/// Reads .dae, .gltf and .glb in this process, where a bad file may end it or take all memory: for
/// tenon-worker and for tests of good files. Others call read_mesh. Errors: Corrupt, Parse, Limit,
/// Missing without assimp.
Result<MeshScene> read_with_assimp(const std::string& path, Diagnostics& diagnostics);

}  // namespace tenon::mesh
