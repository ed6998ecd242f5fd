// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Each material, texture, sampler and image is written once, when it is first asked for. What glTF
// cannot say goes into the extras of a material: other programs draw it without.
#include <algorithm>
#include <cmath>

#include "tenon/glb/glb_parts.h"

namespace tenon::glb {
namespace {

constexpr int kRepeat = 10497;
constexpr int kClamp = 33071;
constexpr int kMirror = 33648;

/// Samplers know no black: the page adds it.
int sampler_wrap(view::ViewWrap wrap) {
  return wrap == view::ViewWrap::Repeat   ? kRepeat
         : wrap == view::ViewWrap::Mirror ? kMirror
                                          : kClamp;
}

/// Along s and t, whether an image is nothing beyond its edges; null where it is not.
GltfJson ends_of(const view::ViewTexture& texture) {
  const bool s = texture.wrap_s == view::ViewWrap::Black;
  const bool t = texture.wrap_t == view::ViewWrap::Black;
  return s || t ? GltfJson::array({s, t}) : GltfJson(nullptr);
}

/// glTF has no opacity but the alpha of the colour's image.
bool is_alpha_of_color(const view::ViewMaterial& look) {
  const auto& opacity = look.opacity_texture;
  return opacity && look.color_texture == opacity->texture && opacity->channel == 3 &&
         opacity->add == 0 && opacity->factor >= 0 && opacity->factor <= 1;
}

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
  const double opacity = is_alpha_of_color(look) ? look.opacity_texture->factor
                         : look.opacity_texture  ? 1
                                                 : look.opacity;
  surface["baseColorFactor"] = {look.color[0], look.color[1], look.color[2], opacity};
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
  } else if (look.opacity < 1 || look.opacity_texture) {
    material["alphaMode"] = "BLEND";
  }
  if (two_sided) {
    material["doubleSided"] = true;
  }
  add_extras(look, material);
  return material;
}

/// What glTF has no words for: page/src/scene/surfaces.ts reads it.
void GlbMaterials::add_extras(const view::ViewMaterial& look, GltfJson& material) {
  if (look.opacity_texture && !is_alpha_of_color(look)) {
    GltfJson opacity = texture(look.opacity_texture->texture);
    opacity["channel"] = std::string(1, "rgba"[look.opacity_texture->channel]);
    opacity["factor"] = look.opacity_texture->factor;
    opacity["add"] = look.opacity_texture->add;
    opacity["ends"] = ends_of(look.opacity_texture->texture);
    material["extras"]["tenon"]["opacity"] = std::move(opacity);
  }
  if (look.color_texture && !ends_of(*look.color_texture).is_null()) {
    material["extras"]["tenon"]["ends"] = ends_of(*look.color_texture);
  }
}

int GlbMaterials::sampler(const view::ViewTexture& texture) {
  const std::pair wraps(sampler_wrap(texture.wrap_s), sampler_wrap(texture.wrap_t));
  const auto [at, is_new] =
      sampler_numbers_.emplace(wraps, static_cast<int>(sampler_numbers_.size()));
  if (is_new) {
    samplers_.push_back({{"wrapS", wraps.first}, {"wrapT", wraps.second}});
  }
  return at->second;
}

/// USD counts from the lower left, glTF from the upper left: turns go the same way in both, since
/// KHR_texture_transform counts them in the other direction.
GltfJson GlbMaterials::texture(const view::ViewTexture& texture) {
  const std::pair key(image(texture.image), sampler(texture));
  const auto [at, is_new] = texture_numbers_.emplace(key, static_cast<int>(textures_.size()));
  if (is_new) {
    textures_.push_back({{"sampler", key.second}, {"source", key.first}});
  }
  GltfJson result = {{"index", at->second}};
  if (texture.scale != Vec2d{{1, 1}} || texture.offset != Vec2d{} || texture.turn != 0) {
    const Vec2d top{{-std::sin(texture.turn) * texture.scale[1],
                     std::cos(texture.turn) * texture.scale[1]}};  // where (0, 1) goes
    GltfJson& moved = result["extensions"]["KHR_texture_transform"];
    moved["offset"] = {texture.offset[0] + top[0], 1 - top[1] - texture.offset[1]};
    if (texture.turn != 0) {
      moved["rotation"] = texture.turn;
    }
    moved["scale"] = {texture.scale[0], texture.scale[1]};
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
    gltf["samplers"] = std::move(samplers_);
    gltf["textures"] = std::move(textures_);
    gltf["images"] = std::move(images_);
  }
  return moved_;
}

}  // namespace tenon::glb
