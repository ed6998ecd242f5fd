// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials with the images that a surface network supports: files that are mapped flat by texture
// coordinates of meshes. Others (cubes wrapped around a shape, patterns that MuJoCo paints, images
// on shapes without such coordinates) are shown in their mean colour, and listed. Which materials
// have mean colours is known when geoms have asked for theirs: they follow those of the model,
// whose numbers stay MuJoCo's.
#include "tenon/mjcf/shapes/material_table.h"

#include <algorithm>

#include "tenon/base/text/counted.h"
#include "tenon/mjcf/shapes/textures.h"

namespace tenon::mjcf {

using robot::ImageUse;
using robot::Index;

namespace {

Vec4d color_at(const float* rgba) {
  Vec4d color;
  for (std::size_t k = 0; k < 4; ++k) {
    color[k] = static_cast<double>(rgba[k]);
  }
  return color;
}

/// What an image of this role says; none for the colour and for what has no meaning of its own.
std::optional<ImageUse> use_of(int role) {
  switch (role) {
    case mjTEXROLE_OCCLUSION:
      return ImageUse::Occlusion;
    case mjTEXROLE_ROUGHNESS:
      return ImageUse::Roughness;
    case mjTEXROLE_METALLIC:
      return ImageUse::Metallic;
    case mjTEXROLE_NORMAL:
      return ImageUse::Normal;
    case mjTEXROLE_OPACITY:
      return ImageUse::Opacity;
    case mjTEXROLE_EMISSIVE:
      return ImageUse::Emission;
    case mjTEXROLE_ORM:
      return ImageUse::OcclusionRoughnessMetallic;
    default:
      return std::nullopt;
  }
}

void tint(robot::Material& material, const Vec3d& factor) {
  for (std::size_t k = 0; k < 3; ++k) {
    (*material.color)[k] *= factor[k];
  }
}

void map_images(const mjModel& model, int number, const mjsTexture* texture,
                robot::Material& material) {
  const ImageMapping mapping = image_mapping(model, number, texture);
  material.texture_scale = mapping.scale;
  material.texture_offset = mapping.offset;
}

/// One warning about materials at these lines, if there are any.
void report_lines(MjcfSource& source, const std::string& what, const std::string& fate,
                  const std::vector<std::uint32_t>& lines) {
  if (!lines.empty()) {
    source.left_out(
        what + " of " + counted(lines.size(), "material") + " " + fate + lines_text(lines),
        lines.front());
  }
}

}  // namespace

MaterialTable::MaterialTable(MjcfSource& source)
    : source_(source), color_texture_(static_cast<std::size_t>(source.model().nmat), -1) {
  for (int i = 0; i < source.model().nmat; ++i) {
    materials_.push_back(read_material(i));
  }
}

robot::Material MaterialTable::read_material(int number) {
  const mjModel& model = source_.model();
  const auto at = static_cast<std::size_t>(number);
  robot::Material material;
  material.name = source_.name(mjOBJ_MATERIAL, number, "material");
  material.place.line = source_.line_of(mjOBJ_MATERIAL, number);
  material.color = color_at(model.mat_rgba + 4 * at);
  if (model.mat_roughness[at] >= 0) {
    material.roughness = model.mat_roughness[at];
  }
  if (model.mat_metallic[at] >= 0) {
    material.metallic = model.mat_metallic[at];
  }
  material.emission = std::max(0.0f, model.mat_emission[at]);
  read_images(number, material);
  return material;
}

void MaterialTable::read_images(int number, robot::Material& material) {
  const mjModel& model = source_.model();
  const int* textures = model.mat_texid + mjNTEXROLE * static_cast<std::size_t>(number);
  for (int role = 0; role < mjNTEXROLE; ++role) {
    if (textures[role] >= 0) {
      add_image(number, role, textures[role], material);
    }
  }
  if (material.texture.empty() && !material.images.empty()) {
    map_images(model, number, nullptr, material);
  }
}

void MaterialTable::add_image(int number, int role, int texture, robot::Material& material) {
  const mjModel& model = source_.model();
  const bool color = role == mjTEXROLE_RGB || role == mjTEXROLE_RGBA;
  const std::optional<ImageUse> use = use_of(role);
  const TextureFile file =
      color || use ? texture_file(source_, texture) : TextureFile{"", "has no role that is known"};
  if (file.path.empty()) {
    source_.left_out("the texture \"" + source_.name(mjOBJ_TEXTURE, texture, "texture") +
                         "\" of material \"" + material.name + "\" " + file.why_not +
                         (color ? "; its mean colour is used" : "; it is skipped"),
                     material.place.line);
    if (color) {
      tint(material, mean_color(model, texture));
    }
    return;
  }
  if (!color) {
    material.images.push_back({*use, file.path});
    return;
  }
  const mjsTexture* written = written_texture(source_, texture);
  map_images(model, number, written, material);
  material.texture = file.path;
  material.texture_opacity = role == mjTEXROLE_RGBA && model.tex_nchannel[texture] == 4;
  material.texture_linear = written->colorspace == mjCOLORSPACE_LINEAR;
  const Vec4d white{{1, 1, 1, 1}};
  material.tinted = !(*material.color == white);
  color_texture_[static_cast<std::size_t>(number)] = texture;
}

Index MaterialTable::of_geom(int geom, bool has_coordinates) {
  const int number = source_.model().geom_matid[geom];
  if (number < 0) {
    return own_color(geom);
  }
  const auto material = static_cast<Index>(number);
  const robot::Material& look = materials_[material];
  const bool has_images = !look.texture.empty() || !look.images.empty();
  return has_images && !has_coordinates ? without_images(geom, material) : material;
}

Index MaterialTable::without_images(int geom, Index material) {
  const auto [at, is_new] = plain_.try_emplace(material);
  Plain& plain = at->second;
  plain.geoms.push_back(geom);
  if (is_new) {
    plain.material = static_cast<Index>(materials_.size());
    robot::Material look = materials_[material];
    look.name += "_plain";
    if (const int texture = color_texture_[material]; texture >= 0) {
      tint(look, mean_color(source_.model(), texture));
    }
    look.texture.clear();
    look.images.clear();
    materials_.push_back(std::move(look));
  }
  return plain.material;
}

/// A material of the colour that the geom has by itself.
Index MaterialTable::own_color(int geom) {
  const Vec4d color = color_at(source_.model().geom_rgba + 4 * static_cast<std::size_t>(geom));
  const auto [at, is_new] = color_of_.emplace(color.v, static_cast<Index>(materials_.size()));
  if (is_new) {
    robot::Material& material = materials_.emplace_back();
    material.name = "color";
    material.color = color;
  }
  return at->second;
}

std::vector<robot::Material> MaterialTable::take() {
  report_plain();
  report_settings();
  return std::move(materials_);
}

/// Images on shapes without texture coordinates.
void MaterialTable::report_plain() {
  for (const auto& [material, plain] : plain_) {
    std::vector<std::uint32_t> lines;
    for (const int geom : plain.geoms) {
      lines.push_back(source_.line_of(mjOBJ_GEOM, geom));
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    source_.left_out("the images of material \"" + materials_[material].name +
                         "\" are skipped on " + std::to_string(plain.geoms.size()) +
                         " geoms without texture coordinates, which have its mean colour" +
                         lines_text(lines),
                     lines.front());
  }
}

/// Settings that UsdPreviewSurface does not support: gloss as OpenGL defines it, mirrors, images
/// that are repeated by metres.
void MaterialTable::report_settings() {
  const mjModel& model = source_.model();
  std::vector<std::uint32_t> glossy;
  std::vector<std::uint32_t> uniform;
  for (int i = 0; i < model.nmat; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const robot::Material& material = materials_[at];
    if (model.mat_specular[at] != 0.5f || model.mat_shininess[at] != 0.5f ||
        model.mat_reflectance[at] != 0) {
      glossy.push_back(material.place.line);
    }
    if (model.mat_texuniform[at] != 0 && !material.texture.empty()) {
      uniform.push_back(material.place.line);
    }
  }
  report_lines(source_, "specular, shininess and reflectance", "are skipped", glossy);
  report_lines(source_, "texuniform", "is skipped, their images are repeated over each shape",
               uniform);
}

}  // namespace tenon::mjcf
