// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/bytes/read_policy.h"
#include "tenon/guard/workers.h"
#include "tenon/mesh/mesh_scene.h"

namespace tenon::mesh {

/// The process that reads the formats not read in this one, and which folders it may read.
struct MeshReading {
  guard::Workers& workers;
  const bytes::ReadPolicy& policy;
};

/// Reads .stl and .ply (binary or text) and .obj with every number rounded once to float, and .dae,
/// .gltf and .glb by assimp in tenon-worker, where both are installed. What is skipped goes to
/// `diagnostics`. Errors, with the file and in text with the line: NotFound, Io, Parse, Corrupt,
/// Limit (kMeshCorners, those of the worker), Unsupported for other endings, Missing without
/// assimp or worker. Collada's unit of length is applied, its up axis is not, as other readers of
/// robots have it.
/// The file and those that it names are read from the folders of the policy alone; for others an
/// error under bytes::kOutsideRule is returned, or where the mesh can do without them put to
/// `diagnostics`.
Result<MeshScene> read_mesh(const std::string& path, const MeshReading& reading,
                            Diagnostics& diagnostics);

/// The readers of this process. `path` is for messages and for files beside it.
Result<MeshScene> read_stl(std::string_view bytes, const std::string& path);
Result<MeshScene> read_ply(std::string_view bytes, const std::string& path);
Result<MeshScene> read_obj(std::string_view text, const std::string& path,
                           const bytes::ReadPolicy& policy, Diagnostics& diagnostics);

}  // namespace tenon::mesh
