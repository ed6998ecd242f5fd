// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mesh/check_scene.h"

#include <algorithm>
#include <cmath>

#include "tenon/base/limits/limits.h"

namespace tenon::mesh {
namespace {

/// What is wrong with a mesh; empty: nothing.
std::string fault_of(const PolygonMesh& mesh, std::size_t appearances) {
  std::uint64_t corners = 0;
  for (const std::int32_t count : mesh.face_counts) {
    if (count < 3) {
      return "a face has fewer than 3 corners";
    }
    corners += static_cast<std::uint64_t>(count);
  }
  if (corners != mesh.face_points.size()) {
    return "its faces have other corners than it lists";
  }
  const auto points = static_cast<std::int64_t>(mesh.points.size());
  if (std::any_of(mesh.face_points.begin(), mesh.face_points.end(),
                  [&](std::int32_t at) { return at < 0 || at >= points; })) {
    return "a face names a point that is not there";
  }
  if (!std::all_of(mesh.points.begin(), mesh.points.end(),
                   [](const Vec3f& point) { return is_finite(point); })) {
    return "a point has a coordinate that is not a finite number";
  }
  if (!mesh.normals.empty() && mesh.normals.size() != corners) {
    return "it has not one normal for each corner";
  }
  if (!mesh.texture_coordinates.empty() && mesh.texture_coordinates.size() != corners) {
    return "it has not one texture coordinate for each corner";
  }
  const bool lacks_look = mesh.appearance && *mesh.appearance >= appearances;
  return lacks_look ? "it names a material that is not there" : "";
}

}  // namespace

Result<void> check_scene(const MeshScene& scene, const std::string& path) {
  std::size_t corners = 0;
  for (const PolygonMesh& mesh : scene.meshes) {
    if (const std::string fault = fault_of(mesh, scene.appearances.size()); !fault.empty()) {
      return Error(ErrorCode::Corrupt, "the mesh \"" + mesh.name + "\" cannot be used: " + fault)
          .in_file(path)
          .with_rule("mesh.corrupt")
          .with_fix("export the mesh again");
    }
    corners += mesh.face_points.size();
  }
  if (corners > limits::kMeshCorners) {
    return Error(ErrorCode::Limit, "more corners of faces than a mesh may have")
        .in_file(path)
        .with_rule("mesh.assimp");
  }
  return {};
}

}  // namespace tenon::mesh
