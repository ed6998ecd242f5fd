// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/mesh/mesh_scene.h"

namespace tenon::mesh {

/// Reads .stl (binary or text) and .obj with every number rounded once to float, and .dae, .gltf
/// and .glb by assimp, where that is installed. What is left out goes to `diagnostics`. Errors,
/// with the file and in text with the line: NotFound, Io, Parse, Corrupt, Limit (kMeshCorners),
/// Unsupported for other endings, Missing without assimp. Collada's unit of length is applied, its
/// up axis is not, as other readers of robots have it.
Result<MeshScene> read_mesh(const std::string& path, Diagnostics& diagnostics);

/// Whether the part that reads .dae, .gltf and .glb is there, and its version ("5.2").
bool has_assimp();
std::string assimp_version();

/// The formats' readers. `path` is for messages and for files beside it.
Result<MeshScene> read_stl(std::string_view bytes, const std::string& path);
Result<MeshScene> read_obj(std::string_view text, const std::string& path,
                           Diagnostics& diagnostics);
Result<MeshScene> read_with_assimp(const std::string& path, Diagnostics& diagnostics);

}  // namespace tenon::mesh
