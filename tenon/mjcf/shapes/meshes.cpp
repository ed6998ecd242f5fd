// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include "tenon/mjcf/shapes/meshes.h"

namespace tenon::mjcf {
namespace {

/// MuJoCo counts v from the upper edge of an image.
std::vector<Vec2f> texture_coordinates(const mjModel& model, int mesh, std::size_t triangles) {
  std::vector<Vec2f> coordinates;
  const int start = model.mesh_texcoordadr[mesh];
  if (start < 0) {
    return coordinates;
  }
  const float* places = model.mesh_texcoord + 2 * static_cast<std::size_t>(start);
  const int* corners =
      model.mesh_facetexcoord + 3 * static_cast<std::size_t>(model.mesh_faceadr[mesh]);
  for (std::size_t i = 0; i < 3 * triangles; ++i) {
    const float* place = places + 2 * static_cast<std::size_t>(corners[i]);
    coordinates.push_back({{place[0], 1 - place[1]}});
  }
  return coordinates;
}

}  // namespace

std::vector<robot::MeshFile> read_meshes(const MjcfSource& source) {
  const mjModel& model = source.model();
  std::vector<robot::MeshFile> files;
  for (int mesh = 0; mesh < model.nmesh; ++mesh) {
    robot::MeshFile& file = files.emplace_back();
    file.written = source.name(mjOBJ_MESH, mesh, "mesh");
    const float* vertices =
        model.mesh_vert + 3 * static_cast<std::size_t>(model.mesh_vertadr[mesh]);
    for (int i = 0; i < model.mesh_vertnum[mesh]; ++i) {
      const float* v = vertices + 3 * static_cast<std::size_t>(i);
      file.points.push_back({{v[0], v[1], v[2]}});
    }
    const int* faces = model.mesh_face + 3 * static_cast<std::size_t>(model.mesh_faceadr[mesh]);
    for (int i = 0; i < model.mesh_facenum[mesh]; ++i) {
      const int* f = faces + 3 * static_cast<std::size_t>(i);
      file.triangles.push_back({{f[0], f[1], f[2]}});
    }
    file.texture_coordinates = texture_coordinates(model, mesh, file.triangles.size());
  }
  return files;
}

}  // namespace tenon::mjcf
