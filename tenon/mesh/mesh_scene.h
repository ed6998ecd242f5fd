// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tenon/math/vector.h"

/// What mesh files hold: polygons and how they look. Numbers are those of the file, in its axes and
/// its unit of length, unless the format says metres.
namespace tenon::mesh {

struct Appearance {
  std::string name;
  std::optional<Vec4f> color;  ///< red, green, blue, opacity, 0 to 1
  bool linear = false;         ///< the colour is linear (glTF), not as displayed
  std::string texture;         ///< of the colour: a file, joined to the mesh's folder; empty: none
};

struct PolygonMesh {
  std::string name;
  std::vector<Vec3f> points;                // (point_count)
  std::vector<std::int32_t> face_counts;    // (face_count), corners of each face, 3 or more
  std::vector<std::int32_t> face_points;    // (corner_count), indices into points
  std::vector<Vec3f> normals;               // (corner_count) or empty
  std::vector<Vec2f> texture_coordinates;   // (corner_count) or empty
  std::optional<std::uint32_t> appearance;  ///< into MeshScene::appearances
};

struct MeshScene {
  std::vector<PolygonMesh> meshes;
  std::vector<Appearance> appearances;
};

}  // namespace tenon::mesh
