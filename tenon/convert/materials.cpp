// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials are written when the first shape shows them: a UsdPreviewSurface each. Colours of robot
// formats are as displayed (sRGB, IEC 61966-2-1), those of UsdPreviewSurface linear.
#include <cmath>

#include "tenon/base/text_number.h"
#include "tenon/convert/conversion.h"

namespace tenon::convert {

using layer::Value;
using layer::Variability;
using robot::Index;

namespace {

double linear_of_srgb(double value) {
  if (value <= 0.04045) {
    return value / 12.92;
  }
  return value >= 1 ? value : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

Index Conversion::add_material(const mesh::Appearance& appearance) {
  std::string key = appearance.name + "\n" + appearance.texture + (appearance.linear ? "\nl" : "");
  robot::Material material;
  material.name = appearance.name.empty() ? "material" : appearance.name;
  material.texture = appearance.texture;
  if (appearance.color) {
    material.color = to_double(*appearance.color);
    for (std::size_t i = 0; i < 4; ++i) {
      key += "\n" + shortest((*appearance.color)[i]);
    }
  }
  const auto [at, is_new] =
      mesh_materials_.emplace(std::move(key), static_cast<Index>(materials_.size()));
  if (is_new) {
    materials_.push_back(std::move(material));
    material_paths_.emplace_back();
    linear_color_.push_back(appearance.linear);
  }
  return at->second;
}

void Conversion::bind(Path prim, const char* relationship, Path material) {
  builder_.apply(prim, "MaterialBindingAPI");
  builder_.set_relationship(prim, relationship, {material});
}

Path Conversion::materials_scope() {
  if (materials_scope_.empty()) {
    materials_scope_ = builder_.define(robot_, "Materials", "Scope");
  }
  return materials_scope_;
}

void Conversion::write_texture(Path material, Path surface, const std::string& file) {
  const Path reader = builder_.define(material, "TextureCoordinates", "Shader");
  builder_.set_attribute(reader, "info:id", "token", Value(Token("UsdPrimvarReader_float2")),
                         Variability::Uniform);
  builder_.set_attribute(reader, "inputs:varname", "string", Value(std::string("st")));
  builder_.declare(reader, "outputs:result", "float2");
  const Path texture = builder_.define(material, "ColorTexture", "Shader");
  builder_.set_attribute(texture, "info:id", "token", Value(Token("UsdUVTexture")),
                         Variability::Uniform);
  builder_.set_attribute(texture, "inputs:file", "asset", Value(layer::AssetPath{file, "", ""}));
  builder_.set_attribute(texture, "inputs:sourceColorSpace", "token", Value(Token("sRGB")));
  builder_.set_connection(texture, "inputs:st", "float2", reader.property("outputs:result"));
  builder_.set_attribute(texture, "inputs:wrapS", "token", Value(Token("repeat")));
  builder_.set_attribute(texture, "inputs:wrapT", "token", Value(Token("repeat")));
  builder_.declare(texture, "outputs:rgb", "float3");
  builder_.set_connection(surface, "inputs:diffuseColor", "color3f",
                          texture.property("outputs:rgb"));
}

void Conversion::write_preview(Path material, const robot::Material& look, bool linear) {
  const Path surface = builder_.define(material, "PreviewSurface", "Shader");
  builder_.set_attribute(surface, "info:id", "token", Value(Token("UsdPreviewSurface")),
                         Variability::Uniform);
  if (look.color) {
    Vec3f color;
    for (std::size_t i = 0; i < 3; ++i) {
      const double value = (*look.color)[i];
      color[i] = static_cast<float>(linear ? value : linear_of_srgb(value));
    }
    builder_.set_attribute(surface, "inputs:diffuseColor", "color3f", Value(color));
    builder_.set_attribute(surface, "inputs:opacity", "float",
                           Value(static_cast<float>((*look.color)[3])));
  }
  builder_.set_attribute(surface, "inputs:roughness", "float", Value(0.5f));
  builder_.declare(surface, "outputs:surface", "token");
  if (!look.texture.empty()) {
    write_texture(material, surface, look.texture);
  }
  builder_.set_connection(material, "outputs:surface", "token",
                          surface.property("outputs:surface"));
}

Path Conversion::material_path(Index material) {
  Path& path = material_paths_[material];
  if (path.empty()) {
    const robot::Material& look = materials_[material];
    const std::string wanted = look.name.empty() ? "material" : look.name;
    const Token name = material_names_.make(wanted);
    path = builder_.define(materials_scope(), name, "Material");
    name_prim(path, name, wanted);
    write_preview(path, look, linear_color_[material]);
  }
  return path;
}

Path Conversion::surface_path(const robot::Surface& surface) {
  for (const auto& [known, path] : surfaces_) {
    if (known == surface) {
      return path;
    }
  }
  const Path path =
      builder_.define(materials_scope(), material_names_.make("PhysicsMaterial"), "Material");
  const auto set = [&](const char* api, const char* name, const std::optional<double>& value) {
    if (value) {
      builder_.apply(path, api);
      builder_.set_number(path, api, name, *value);
    }
  };
  builder_.apply(path, "PhysicsMaterialAPI");
  set("PhysicsMaterialAPI", "physics:staticFriction", surface.static_friction);
  set("PhysicsMaterialAPI", "physics:dynamicFriction", surface.dynamic_friction);
  set("PhysicsMaterialAPI", "physics:restitution", surface.restitution);
  set("NewtonMaterialAPI", "newton:torsionalFriction", surface.torsional_friction);
  set("NewtonMaterialAPI", "newton:rollingFriction", surface.rolling_friction);
  surfaces_.emplace_back(surface, path);
  return path;
}

}  // namespace tenon::convert
