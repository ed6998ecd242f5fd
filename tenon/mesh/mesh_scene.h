// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tenon/math/vector.h"

/// What mesh files hold: polygons and how they look. Numbers are those of the file, in its axes and
/// its unit of length, unless the format says metres.
namespace tenon::mesh {

/// What an image says of an appearance, beside its colour.
enum class ImageUse : std::uint8_t {
  Normal,             ///< tangent space
  Occlusion,          ///< in red
  RoughnessMetallic,  ///< in green and blue
  Emission,           ///< a colour
};

struct AppearanceImage {
  ImageUse use = ImageUse::Normal;
  std::string file;  ///< as Appearance::texture
};

struct Appearance {
  std::string name;
  std::optional<Vec4f> color;  ///< red, green, blue, opacity, 0 to 1
  bool linear = false;         ///< the colour is linear (glTF), not as displayed
  /// Of the colour: a file, joined to the mesh's folder, or one of MeshScene::images; empty: none.
  std::string texture;
  bool tinted = false;                  ///< the texture is multiplied with the colour
  bool texture_opacity = false;         ///< the opacity is that of the texture
  std::vector<AppearanceImage> images;  ///< each use once
  std::optional<float> roughness;       ///< 0 to 1, a factor where there is an image
  std::optional<float> metallic;        ///< 0 to 1, a factor where there is an image
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
  /// Bytes of images that lie inside the mesh file, as files of theirs, by "<mesh file>[<name>]".
  std::map<std::string, std::string> images;
};

}  // namespace tenon::mesh
