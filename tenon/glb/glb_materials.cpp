// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "tenon/glb/glb_parts.h"

namespace tenon::glb {
namespace {

constexpr int kRepeat = 10497;
constexpr int kClamp = 33071;

}  // namespace

int GlbMaterials::of(std::optional<Index> material, bool two_sided) {
  const auto [at, is_new] =
      known_.emplace(std::tuple(material, two_sided), static_cast<int>(materials_.size()));
  if (is_new) {
    materials_.push_back(
        write(material ? view_.materials[*material] : view::ViewMaterial{}, two_sided));
  }
  return at->second;
}

GltfJson GlbMaterials::write(const view::ViewMaterial& look, bool two_sided) {
  GltfJson material;
  if (!look.path.empty()) {
    material["name"] = look.path.str();
  }
  GltfJson& surface = material["pbrMetallicRoughness"];
  surface["baseColorFactor"] = {look.color[0], look.color[1], look.color[2], look.opacity};
  surface["metallicFactor"] = look.metallic;
  surface["roughnessFactor"] = look.roughness;
  if (look.color_texture) {
    surface["baseColorTexture"] = texture(*look.color_texture);
  }
  if (look.surface_texture) {
    surface["metallicRoughnessTexture"] = texture(*look.surface_texture);
  }
  if (look.normal_texture) {
    material["normalTexture"] = texture(*look.normal_texture);
  }
  if (look.occlusion_texture) {
    material["occlusionTexture"] = texture(*look.occlusion_texture);
  }
  if (look.emission_texture) {
    material["emissiveTexture"] = texture(*look.emission_texture);
  }
  const double brightest = std::max({look.emission[0], look.emission[1], look.emission[2]});
  if (brightest > 0) {
    material["emissiveFactor"] = numbers_of(look.emission * (1 / std::max(1.0, brightest)));
  }
  if (look.cutout > 0) {
    material["alphaMode"] = "MASK";
    material["alphaCutoff"] = look.cutout;
  } else if (look.opacity < 1) {
    material["alphaMode"] = "BLEND";
  }
  if (two_sided) {
    material["doubleSided"] = true;
  }
  return material;
}

/// USD reads at scale * (u, v) + offset from the lower left, glTF from the upper left.
GltfJson GlbMaterials::texture(const view::ViewTexture& texture) {
  const int source = image(texture.image);
  const auto [at, is_new] = texture_numbers_.emplace(std::pair(source, texture.clamped),
                                                     static_cast<int>(textures_.size()));
  if (is_new) {
    textures_.push_back({{"sampler", texture.clamped ? 1 : 0}, {"source", source}});
  }
  GltfJson result = {{"index", at->second}};
  if (texture.scale != Vec2d{{1, 1}} || texture.offset != Vec2d{}) {
    const double below = 1 - texture.scale[1] - texture.offset[1];
    result["extensions"]["KHR_texture_transform"] = {
        {"offset", {texture.offset[0], below}}, {"scale", {texture.scale[0], texture.scale[1]}}};
    moved_ = true;
  }
  return result;
}

int GlbMaterials::image(Index number) {
  const auto [at, is_new] = image_numbers_.emplace(number, static_cast<int>(images_.size()));
  if (is_new) {
    const view::ViewImage& source = view_.images[number];
    images_.push_back(
        {{"bufferView", buffer_.add_view(source.bytes)}, {"mimeType", source.mime_type}});
  }
  return at->second;
}

bool GlbMaterials::finish(GltfJson& gltf) {
  if (!materials_.empty()) {
    gltf["materials"] = std::move(materials_);
  }
  if (!textures_.empty()) {
    gltf["samplers"] = {{{"wrapS", kRepeat}, {"wrapT", kRepeat}},
                        {{"wrapS", kClamp}, {"wrapT", kClamp}}};
    gltf["textures"] = std::move(textures_);
    gltf["images"] = std::move(images_);
  }
  return moved_;
}

}  // namespace tenon::glb
