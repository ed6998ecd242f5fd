// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials with the images that a surface network can say: files that are laid out flat by texture
// coordinates of meshes. Others (cubes wrapped around a shape, patterns that MuJoCo paints, images
// on shapes without such coordinates) are shown in their mean colour, and listed.
#include <algorithm>
#include <array>
#include <filesystem>

#include "tenon/mjcf/mjcf_reader.h"

namespace tenon::mjcf {

using robot::GeometryKind;
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

/// Of all pixels, 0 to 1 as displayed.
Vec3d mean_color(const mjModel& model, int texture) {
  const auto at = static_cast<std::size_t>(texture);
  const auto channels = static_cast<std::size_t>(std::max(1, model.tex_nchannel[at]));
  const auto count = static_cast<std::size_t>(model.tex_width[at]) *
                     static_cast<std::size_t>(model.tex_height[at]);
  const mjtByte* pixels = model.tex_data + model.tex_adr[at];
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      sums[k] += pixels[channels * i + std::min(k, channels - 1)];
    }
  }
  Vec3d mean{{1, 1, 1}};
  for (std::size_t k = 0; k < 3 && count > 0; ++k) {
    mean[k] = sums[k] / (255.0 * static_cast<double>(count));
  }
  return mean;
}

/// The element of a kind that has this number in the compiled model.
mjsElement* element_of(mjSpec& spec, mjtObj kind, int id) {
  for (mjsElement* at = mjs_firstElement(&spec, kind); at != nullptr;
       at = mjs_nextElement(&spec, at)) {
    if (mjs_getId(at) == id) {
      return at;
    }
  }
  return nullptr;
}

double fraction(double value) { return value - std::floor(value); }

}  // namespace

/// The file of a flat image; empty and why not for other textures.
std::string MjcfReader::image_of(int texture, std::string& why) const {
  if (model_.tex_type[texture] != mjTEXTURE_2D) {
    why = "is wrapped around shapes as a cube";
    return {};
  }
  mjsElement* element = element_of(spec_, mjOBJ_TEXTURE, texture);
  const mjsTexture* source = element == nullptr ? nullptr : mjs_asTexture(element);
  if (source == nullptr || source->builtin != mjBUILTIN_NONE || *mjs_getString(source->file) == 0) {
    why = "is painted by MuJoCo";
    return {};
  }
  const mjSpec* owner = mjs_getOriginSpec(element);
  std::filesystem::path file(mjs_getString(source->file));
  if (owner != nullptr && owner->strippath != 0) {
    file = file.filename();
  }
  const mjsCompiler* compiler = mjs_getCompiler(element);
  if (compiler != nullptr) {
    file = std::filesystem::path(mjs_getString(compiler->texturedir)) / file;
  }
  const std::filesystem::path beside = std::filesystem::path(file_).parent_path() /
                                       (owner == nullptr ? "" : mjs_getString(owner->modelfiledir));
  std::error_code error;
  for (const auto& folder : {std::filesystem::path(file_).parent_path(), beside}) {
    const auto found = std::filesystem::absolute(folder / file, error).lexically_normal();
    if (std::filesystem::is_regular_file(found, error)) {
      return found.generic_string();
    }
  }
  why = "has a file that is not on the disk";
  return {};
}

/// Repetitions along both edges; MuJoCo counts rows from the top.
void MjcfReader::read_mapping(const mjsTexture* texture, int number,
                              robot::Material& material) const {
  const float* repeat = model_.mat_texrepeat + 2 * static_cast<std::size_t>(number);
  double scale[2];
  for (std::size_t k = 0; k < 2; ++k) {
    scale[k] = repeat[k] > 0 ? static_cast<double>(repeat[k]) : 1;
  }
  const bool flip_u = texture != nullptr && texture->hflip != 0;
  const bool flip_v = texture != nullptr && texture->vflip != 0;
  material.texture_scale = {{flip_u ? -scale[0] : scale[0], flip_v ? -scale[1] : scale[1]}};
  material.texture_offset = {{0, fraction(flip_v ? scale[1] : 1 - scale[1])}};
}

void MjcfReader::read_images(int number, robot::Material& material) {
  const int* textures = model_.mat_texid + mjNTEXROLE * static_cast<std::size_t>(number);
  for (int role = 0; role < mjNTEXROLE; ++role) {
    const int texture = textures[role];
    if (texture < 0) {
      continue;
    }
    const bool color = role == mjTEXROLE_RGB || role == mjTEXROLE_RGBA;
    const std::optional<ImageUse> use = use_of(role);
    std::string why = "has no role that is known";
    const std::string file = color || use ? image_of(texture, why) : "";
    if (file.empty()) {
      report("mjcf.left-out",
             "the texture \"" + unique_name(mjOBJ_TEXTURE, texture, "texture") +
                 "\" of material \"" + material.name + "\" " + why +
                 (color ? "; its mean colour stands for it" : "; it is left out"),
             Severity::Warning, material.place.line);
    }
    if (color && file.empty()) {
      const Vec3d mean = mean_color(model_, texture);
      for (std::size_t k = 0; k < 3; ++k) {
        (*material.color)[k] *= mean[k];
      }
    } else if (color) {
      const mjsTexture* source = mjs_asTexture(element_of(spec_, mjOBJ_TEXTURE, texture));
      read_mapping(source, number, material);
      material.texture = file;
      material.texture_opacity = role == mjTEXROLE_RGBA && model_.tex_nchannel[texture] == 4;
      material.texture_linear = source->colorspace == mjCOLORSPACE_LINEAR;
      const Vec4d white{{1, 1, 1, 1}};
      material.tinted = !(*material.color == white);
      texture_of_material_[static_cast<Index>(number)] = texture;
    } else if (!file.empty()) {
      material.images.push_back({*use, file});
    }
  }
  if (material.texture.empty() && !material.images.empty()) {
    read_mapping(nullptr, number, material);
  }
}

void MjcfReader::read_materials() {
  for (int i = 0; i < model_.nmat; ++i) {
    const auto at = static_cast<std::size_t>(i);
    robot::Material material;
    material.name = unique_name(mjOBJ_MATERIAL, i, "material");
    material.place.line = line_of(mjOBJ_MATERIAL, i);
    material.color = color_at(model_.mat_rgba + 4 * at);
    if (model_.mat_roughness[at] >= 0) {
      material.roughness = model_.mat_roughness[at];
    }
    if (model_.mat_metallic[at] >= 0) {
      material.metallic = model_.mat_metallic[at];
    }
    material.emission = std::max(0.0f, model_.mat_emission[at]);
    read_images(i, material);
    robot_.materials.push_back(std::move(material));
  }
}

/// The same material for shapes that have no place for its images.
Index MjcfReader::without_images(Index material) {
  const auto [at, is_new] = plain_.emplace(material, static_cast<Index>(robot_.materials.size()));
  if (is_new) {
    robot::Material plain = robot_.materials[material];
    plain.name += "_plain";
    const auto texture = texture_of_material_.find(material);
    if (texture != texture_of_material_.end()) {
      const Vec3d mean = mean_color(model_, texture->second);
      for (std::size_t k = 0; k < 3; ++k) {
        (*plain.color)[k] *= mean[k];
      }
    }
    plain.texture.clear();
    plain.images.clear();
    robot_.materials.push_back(std::move(plain));
  }
  return at->second;
}

/// A material of the colour that the geom has by itself.
Index MjcfReader::own_color(int geom) {
  const Vec4d color = color_at(model_.geom_rgba + 4 * static_cast<std::size_t>(geom));
  const auto [at, is_new] = color_of_.emplace(color.v, static_cast<Index>(robot_.materials.size()));
  if (is_new) {
    robot::Material& material = robot_.materials.emplace_back();
    material.name = "color";
    material.color = color;
  }
  return at->second;
}

std::optional<Index> MjcfReader::material_of(int geom, const robot::Geometry& geometry) {
  const int number = model_.geom_matid[geom];
  if (number < 0) {
    return own_color(geom);
  }
  const auto material = static_cast<Index>(number);
  const robot::Material& look = robot_.materials[material];
  const bool has_images = !look.texture.empty() || !look.images.empty();
  const bool has_places = geometry.kind == GeometryKind::Mesh &&
                          !robot_.meshes[geometry.mesh].texture_coordinates.empty();
  if (!has_images || has_places) {
    return material;
  }
  bare_[material].push_back(geom);
  return without_images(material);
}

/// What surfaces of UsdPreviewSurface have no word for: gloss as OpenGL counts it, mirrors, images
/// on shapes without texture coordinates.
void MjcfReader::report_materials() {
  for (const auto& [material, geoms] : bare_) {
    std::vector<std::uint32_t> lines;
    for (const int geom : geoms) {
      lines.push_back(line_of(mjOBJ_GEOM, geom));
    }
    std::sort(lines.begin(), lines.end());
    lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
    report("mjcf.left-out",
           "the images of material \"" + robot_.materials[material].name + "\" are left out on " +
               std::to_string(geoms.size()) +
               " geoms without texture coordinates, which have its mean colour" + lines_text(lines),
           Severity::Warning, lines.front());
  }
  std::vector<std::uint32_t> glossy;
  std::vector<std::uint32_t> uniform;
  for (int i = 0; i < model_.nmat; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const robot::Material& material = robot_.materials[at];
    if (model_.mat_specular[at] != 0.5f || model_.mat_shininess[at] != 0.5f ||
        model_.mat_reflectance[at] != 0) {
      glossy.push_back(material.place.line);
    }
    if (model_.mat_texuniform[at] != 0 && !material.texture.empty()) {
      uniform.push_back(material.place.line);
    }
  }
  if (!glossy.empty()) {
    report("mjcf.left-out",
           "specular, shininess and reflectance of " + std::to_string(glossy.size()) +
               " materials are left out" + lines_text(glossy),
           Severity::Warning, glossy.front());
  }
  if (!uniform.empty()) {
    report("mjcf.left-out",
           "texuniform of " + std::to_string(uniform.size()) +
               " materials is left out, their images are repeated over each shape" +
               lines_text(uniform),
           Severity::Warning, uniform.front());
  }
}

}  // namespace tenon::mjcf
