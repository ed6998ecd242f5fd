// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Colours are those of <diffuse>, as displayed; a <pbr> says more. Scripts of Gazebo's first
// renderer are taken where they are one of its plain colours.
#include <algorithm>

#include "tenon/base/text/text_number.h"
#include "tenon/sdf/shape_reader.h"
#include "tenon/urdf/gazebo_colors.h"

namespace tenon::sdf {

using robot::Index;

std::string ShapeReader::image(SdfFile& file, pugi::xml_node element) {
  const std::string uri = SdfFile::text_of(element);
  if (uri.empty()) {
    return {};
  }
  bool is_guess = false;
  const Result<std::string> path = files_.find(uri, file, is_guess);
  if (!path) {
    const Diagnostic& why = path.error().diagnostic();
    const bool missing = why.rule.empty();
    file.warn(element, missing ? "sdf.texture-missing" : why.rule.c_str(),
              "the texture " + (missing ? "\"" + uri + "\" cannot be found" : why.message) +
                  "; it is skipped",
              missing ? ModelFiles::advice(uri) : why.fix, Severity::Error);
    return {};
  }
  if (is_guess) {
    file.warn(element, "sdf.mesh-nearby",
              "the texture \"" + uri + "\" is not at its place; \"" + *path +
                  "\", whose name ends like it, is used",
              ModelFiles::advice(uri), Severity::Info);
  }
  return *path;
}

Result<void> ShapeReader::read_metal(SdfFile& file, pugi::xml_node metal,
                                     robot::Material& material) {
  using robot::ImageUse;
  file.list_skipped(
      metal,
      {"albedo_map", "roughness", "metalness", "roughness_map", "metalness_map", "normal_map",
       "ambient_occlusion_map", "emissive_map"},
      {"environment_map", "light_map", "specular_map", "glossiness_map", "glossiness"});
  material.texture = image(file, metal.child("albedo_map"));
  struct Row {
    const char* name;
    ImageUse use;
  };
  for (const Row& row : {Row{"roughness_map", ImageUse::Roughness},
                         {"metalness_map", ImageUse::Metallic},
                         {"normal_map", ImageUse::Normal},
                         {"ambient_occlusion_map", ImageUse::Occlusion},
                         {"emissive_map", ImageUse::Emission}}) {
    if (std::string path = image(file, metal.child(row.name)); !path.empty()) {
      material.images.push_back({row.use, std::move(path)});
    }
  }
  if (metal.child("roughness")) {
    TENON_TRY(material.roughness, file.number(metal, "roughness", 0.5));
  }
  if (metal.child("metalness")) {
    TENON_TRY(material.metallic, file.number(metal, "metalness", 0.5));
  }
  return {};
}

Result<std::optional<Index>> ShapeReader::read_material(SdfFile& file, pugi::xml_node visual) {
  const pugi::xml_node element = visual.child("material");
  robot::Material material;
  material.place = file.place_of(element);
  file.list_skipped(element, {"diffuse", "pbr", "script"},
                    {"ambient", "specular", "emissive", "shininess", "render_order", "lighting",
                     "double_sided", "shader"});
  if (element.child("diffuse")) {
    TENON_TRY(const std::vector<double> rgba, file.color_in(element.child("diffuse")));
    Vec4d color{{rgba[0], rgba[1], rgba[2], rgba.size() > 3 ? rgba[3] : 1}};
    for (std::size_t i = 0; i < 4; ++i) {
      color[i] = color[i] > 0 ? std::min(color[i], 1.0) : 0;  // no number is 0
    }
    material.color = color;
  } else if (const std::string name = SdfFile::text_of(element.child("script").child("name"));
             !name.empty()) {
    material.color = urdf::gazebo_color(name);
    if (!material.color && !element.child("pbr")) {
      file.warn(element.child("script"), "sdf.left-out",
                "names the material \"" + name + "\" of Gazebo's first renderer; it is skipped",
                "give the colour: <diffuse>0.5 0.5 0.5 1</diffuse>");
    }
  }
  if (const pugi::xml_node pbr = element.child("pbr")) {
    const pugi::xml_node metal = pbr.child("metal");
    TENON_CHECK(read_metal(file, metal ? metal : pbr.child("specular"), material));
  }
  TENON_TRY(const double transparency, file.number(visual, "transparency", 0));
  if (transparency > 0) {
    material.color = material.color.value_or(Vec4d{{1, 1, 1, 1}});
    (*material.color)[3] *= 1 - std::min(transparency, 1.0);
  }
  if (!material.color && material.texture.empty() && material.images.empty() &&
      !material.roughness && !material.metallic) {
    return std::optional<Index>();
  }
  return std::optional(material_number(std::move(material)));
}

Index ShapeReader::material_number(robot::Material material) {
  std::string key = material.texture;
  for (std::size_t i = 0; material.color && i < 4; ++i) {
    key += '\n' + shortest((*material.color)[i]);
  }
  for (const robot::MaterialImage& image : material.images) {
    key += '\n' + std::to_string(static_cast<int>(image.use)) + image.file;
  }
  key += '\n' + shortest(material.roughness.value_or(-1)) + '\n' +
         shortest(material.metallic.value_or(-1));
  const auto number = static_cast<Index>(model_.materials.size());
  const auto [at, is_new] = material_numbers_.emplace(std::move(key), number);
  if (is_new) {
    material.name = "material_" + std::to_string(number + 1);
    model_.materials.push_back(std::move(material));
  }
  return at->second;
}

}  // namespace tenon::sdf
