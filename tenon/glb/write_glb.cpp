// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Nodes: 0 is the root, then a node for each body in order, then the world's own, then all shapes.
#include "tenon/glb/write_glb.h"

#include <cmath>
#include <limits>

#include "tenon/approximate/mesh_codec.h"
#include "tenon/glb/glb_parts.h"

namespace tenon::glb {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;  // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;

/// The turn that brings `up` to Y.
Quatd turn_to_y_up(const Vec3d& up) {
  constexpr double kHalf = 0.7071067811865476;
  if (up[2] > 0.5) {
    return {-kHalf, 0, 0, kHalf};
  }
  return up[0] > 0.5 ? Quatd{0, 0, kHalf, kHalf} : kIdentityRotation;
}

void set_pose(const Pose& pose, GltfJson& node) {
  if (pose.position != Vec3d{}) {
    node["translation"] = numbers_of(pose.position);
  }
  if (!(pose.orientation == kIdentityRotation)) {
    node["rotation"] = numbers_of(pose.orientation);
  }
}

class GlbWriter {
 public:
  GlbWriter(const view::ViewScene& view, const GlbOptions& options)
      : view_(view),
        options_(options),
        buffer_(options.compressed),
        meshes_(view, options.point_bits, buffer_),
        materials_(view, buffer_) {}

  Result<std::string> run() {
    add_nodes();
    GltfJson motion = options_.motion == nullptr ? GltfJson(nullptr)
                                                 : motion_of_bodies(*options_.motion, 1, buffer_);
    GltfJson gltf;
    gltf["asset"] = {{"version", "2.0"}, {"generator", "tenon"}};
    gltf["scene"] = 0;
    gltf["scenes"] = GltfJson::array();
    gltf["scenes"].push_back({{"nodes", {0}}, {"extras", {{"tenon", scene_extras(view_)}}}});
    gltf["nodes"] = std::move(nodes_);
    if (GltfJson meshes = meshes_.take(); !meshes.empty()) {
      gltf["meshes"] = std::move(meshes);
    }
    const bool moved_images = materials_.finish(gltf);
    if (!motion.is_null()) {
      gltf["animations"] = GltfJson::array();
      gltf["animations"].push_back(std::move(motion));
    }
    buffer_.finish(gltf);
    name_extensions(gltf, moved_images);
    return assemble(gltf);
  }

 private:
  void add_nodes() {
    const std::size_t bodies = view_.bodies.size();
    GltfJson root = {{"name", "scene"}};
    set_pose({{}, turn_to_y_up(view_.up)}, root);
    for (std::size_t i = 0; i <= bodies; ++i) {
      root["children"].push_back(i + 1);
    }
    nodes_.push_back(std::move(root));
    for (std::size_t i = 0; i < bodies; ++i) {
      add_body(i);
    }
    nodes_.push_back({{"name", "world"}, {"extras", {{"kind", "world"}}}});
    for (const view::ViewShape& shape : view_.shapes) {
      add_shape(shape, {{"kind", "visual"}});
    }
    for (std::size_t i = 0; options_.colliders && i < view_.colliders.size(); ++i) {
      const std::vector<Index>& shapes = view_.colliders[i].shapes;
      for (std::size_t piece = 0; piece < shapes.size(); ++piece) {
        add_shape(view_.collider_shapes[shapes[piece]],
                  {{"kind", "collider"}, {"index", i}, {"piece", piece}});
      }
    }
  }

  void add_body(std::size_t index) {
    const view::ViewBody& body = view_.bodies[index];
    GltfJson node = {{"name", body.path.str()}};
    const bool moves = options_.motion != nullptr && options_.motion->frame_count() > 0;
    set_pose(moves ? options_.motion->pose(0, index) : body.pose, node);
    node["extras"] = {{"kind", "body"}, {"path", body.path.str()}, {"index", index}};
    nodes_.push_back(std::move(node));
  }

  void add_shape(const view::ViewShape& shape, GltfJson extras) {
    if (view_.meshes[shape.mesh].corners.empty()) {
      return;
    }
    const int material = materials_.of(shape.material, shape.two_sided);
    GltfJson node = {{"name", shape.path.str()}, {"mesh", meshes_.of(shape, material)}};
    const Grid& grid = meshes_.grid_of(shape.mesh);
    Pose pose = shape.pose;
    Vec3d scale;
    Vec3d offset;
    for (std::size_t k = 0; k < 3; ++k) {
      scale[k] = shape.scale[k] * grid.step;
      offset[k] = shape.scale[k] * grid.offset[k];
    }
    pose.position += rotate(pose.orientation, offset);
    set_pose(pose, node);
    if (scale != Vec3d{{1, 1, 1}}) {
      node["scale"] = numbers_of(scale);
    }
    extras["path"] = shape.path.str();
    node["extras"] = std::move(extras);
    const std::size_t parent = shape.body ? 1 + *shape.body : 1 + view_.bodies.size();
    nodes_[parent]["children"].push_back(nodes_.size());
    nodes_.push_back(std::move(node));
  }

  void name_extensions(GltfJson& gltf, bool moved_images) const {
    GltfJson required = GltfJson::array();
    if (buffer_.compressed() && gltf.contains("bufferViews")) {
      required.push_back("EXT_meshopt_compression");
    }
    if (buffer_.compressed() && gltf.contains("meshes")) {
      required.push_back("KHR_mesh_quantization");
    }
    GltfJson used = required;
    if (moved_images) {
      used.push_back("KHR_texture_transform");
    }
    if (!used.empty()) {
      gltf["extensionsUsed"] = std::move(used);
    }
    if (!required.empty()) {
      gltf["extensionsRequired"] = std::move(required);
    }
  }

  Result<std::string> assemble(const GltfJson& gltf) const {
    if (buffer_.failed()) {
      return Error(ErrorCode::Missing, "meshoptimizer is not there, which compresses meshes")
          .with_rule("glb.no-meshoptimizer")
          .with_fix("install libmeshoptimizer2");
    }
    std::string json = gltf.dump(-1, ' ', false, GltfJson::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::string& binary = buffer_.bytes();
    const std::uint64_t size = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
    if (size > std::numeric_limits<std::uint32_t>::max()) {
      return Error(ErrorCode::Limit, "the scene is larger than the 4 GiB that a GLB can have")
          .with_rule("glb.too-large")
          .with_fix("ask for fewer triangles");
    }
    std::string file;
    file.reserve(size);
    append_bytes(file, kMagic);
    append_bytes(file, std::uint32_t{2});
    append_bytes(file, static_cast<std::uint32_t>(size));
    append_bytes(file, static_cast<std::uint32_t>(json.size()));
    append_bytes(file, kJsonChunk);
    file += json;
    if (!binary.empty()) {
      append_bytes(file, static_cast<std::uint32_t>(binary.size()));
      append_bytes(file, kBinaryChunk);
      file += binary;
    }
    return file;
  }

  const view::ViewScene& view_;
  const GlbOptions& options_;
  GlbBuffer buffer_;
  GlbMeshes meshes_;
  GlbMaterials materials_;
  GltfJson nodes_ = GltfJson::array();
};

}  // namespace

Result<std::string> write_glb(const view::ViewScene& view, const GlbOptions& options) {
  if (options.motion != nullptr && options.motion->body_count != view.bodies.size()) {
    return Error(ErrorCode::Invalid,
                 "the motion is of " + std::to_string(options.motion->body_count) +
                     " bodies, the view has " + std::to_string(view.bodies.size()));
  }
  return GlbWriter(view, options).run();
}

}  // namespace tenon::glb
