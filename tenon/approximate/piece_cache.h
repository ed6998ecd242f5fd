// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tenon/scene/physics_scene.h"
#include "tenon/scene/shapes/mesh_tools.h"

namespace tenon::approximate {

/// Pieces of meshes kept in a folder, one file each, found by the content of the mesh: the file
/// holds the mesh that it is of, which must be the same to the last bit. Files that are damaged
/// are as good as none; what cannot be written is not kept.
class PieceCache {
 public:
  explicit PieceCache(std::string folder) : folder_(std::move(folder)) {}

  std::optional<std::vector<scene::TriangleMesh>> find(const std::string& key) const;
  void keep(const std::string& key, const std::vector<scene::TriangleMesh>& pieces) const;

 private:
  std::string folder_;  // empty: nothing is kept
};

/// The bytes that tell meshes apart: the options of the decomposition, then points and triangles.
std::string piece_key(const scene::TriangleMesh& mesh, const scene::Decomposition& how);

}  // namespace tenon::approximate
