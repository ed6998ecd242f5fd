// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tenon/asset/edit_asset.h"
#include "tenon/base/diagnostics.h"
#include "tenon/base/result.h"
#include "tenon/stage/stage.h"

/// Internal to the wiring.
namespace tenon {

/// A mesh file that is to become the geometry of one prim.
struct MeshFileRequest {
  std::string file;              ///< .stl, .obj, .ply, .dae, .gltf, .glb
  std::optional<double> meters;  ///< in a unit of length of the file; without it 1
  std::string up_axis;           ///< of the file: "Y" or "Z"; empty: Y of glTF, else the stage's
};

/// All parts of the file as one mesh, in the units and with the up axis of the stage. Formats that
/// other libraries read are read in tenon-worker. Errors: those of mesh::read_mesh, and Invalid
/// (edit.bad-argument, edit.empty-mesh) with the file. What is skipped, and a size that hints at
/// another unit, goes to `diagnostics`.
Result<std::shared_ptr<const MeshGeometry>> read_mesh_file(const MeshFileRequest& request,
                                                           const stage::Stage& stage,
                                                           const OpenOptions& options,
                                                           Diagnostics& diagnostics);

}  // namespace tenon
