// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "tenon/bake/pose_recording.h"
#include "tenon/glb/glb_buffer.h"
#include "tenon/view/view_scene.h"

/// Internal to this folder.
namespace tenon::glb {

using view::Index;

/// How the whole numbers of a mesh's points become metres: offset + step * number.
struct Grid {
  Vec3d offset;
  double step = 1;
};

/// Geometry in the buffer, each mesh once, and glTF meshes of geometry with a material.
class GlbMeshes {
 public:
  GlbMeshes(const view::ViewScene& view, int point_bits, GlbBuffer& buffer)
      : view_(view), steps_((1 << point_bits) - 1), buffer_(buffer) {}

  /// The number of the glTF mesh of a shape.
  int of(const view::ViewShape& shape, int material);
  /// Where points of a mesh are, for the node that shows it; of whole numbers only when compressed.
  const Grid& grid_of(Index mesh) { return geometry_of(mesh).grid; }
  GltfJson take() { return std::move(meshes_); }

 private:
  struct Geometry {
    GltfJson primitive;  // attributes and indices
    Grid grid;
  };

  const Geometry& geometry_of(Index mesh);
  Geometry write(const view::ViewMesh& mesh);
  int write_points(const std::vector<Vec3f>& points, Grid& grid);
  int write_normals(const std::vector<Vec3f>& normals);
  int write_places(const std::vector<Vec2f>& places);
  int write_colors(const std::vector<Vec3f>& colors);

  const view::ViewScene& view_;
  int steps_;  // of the grid of compressed points
  GlbBuffer& buffer_;
  std::map<Index, Geometry> geometry_;
  std::map<std::pair<Index, int>, int> known_;
  GltfJson meshes_ = GltfJson::array();
};

/// Materials, textures and images of a glTF.
class GlbMaterials {
 public:
  GlbMaterials(const view::ViewScene& view, GlbBuffer& buffer) : view_(view), buffer_(buffer) {}

  /// The number of a material with one side or two. Without one it is the default of ViewMaterial,
  /// written out, because the default material of glTF is a metal.
  int of(std::optional<Index> material, bool two_sided);
  /// Fills "materials", "textures", "images", "samplers"; true where images are moved or scaled.
  bool finish(GltfJson& gltf);

 private:
  GltfJson write(const view::ViewMaterial& look, bool two_sided);
  void add_extras(const view::ViewMaterial& look, GltfJson& material);
  GltfJson texture(const view::ViewTexture& texture);
  int sampler(const view::ViewTexture& texture);
  int image(Index number);

  const view::ViewScene& view_;
  GlbBuffer& buffer_;
  std::map<std::tuple<std::optional<Index>, bool>, int> known_;
  std::map<std::pair<int, int>, int> texture_numbers_;  // of images with their samplers
  std::map<std::pair<int, int>, int> sampler_numbers_;  // of the wraps of both directions
  std::map<Index, int> image_numbers_;
  GltfJson materials_ = GltfJson::array();
  GltfJson textures_ = GltfJson::array();
  GltfJson samplers_ = GltfJson::array();
  GltfJson images_ = GltfJson::array();
  bool moved_ = false;
};

/// One animation "motion" of the nodes `first_node` and on, one for each body; null where nothing
/// moves.
GltfJson motion_of_bodies(const bake::PoseRecording& motion, int first_node, GlbBuffer& buffer);

/// {"version", "up", "bodies", "joints", ...}: see page/src/scene/info.ts.
GltfJson scene_extras(const view::ViewScene& view);

GltfJson numbers_of(const Vec3d& v);
/// x, y, z, w.
GltfJson numbers_of(const Quatd& q);

}  // namespace tenon::glb
