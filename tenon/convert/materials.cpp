// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials are written when the first shape shows them (surface_network.cpp says how).
#include "tenon/base/text_number.h"
#include "tenon/convert/conversion.h"

namespace tenon::convert {

using layer::Value;
using robot::Index;

Index Conversion::add_material(const mesh::Appearance& appearance) {
  std::string key = appearance.name + "\n" + appearance.texture + (appearance.linear ? "\nl" : "");
  robot::Material material;
  material.name = appearance.name.empty() ? "material" : appearance.name;
  material.texture = appearance.texture;
  material.tinted = appearance.tinted;
  material.texture_opacity = appearance.texture_opacity;
  material.roughness = appearance.roughness;
  material.metallic = appearance.metallic;
  for (const mesh::AppearanceImage& image : appearance.images) {
    constexpr robot::ImageUse kUses[] = {robot::ImageUse::Normal, robot::ImageUse::Occlusion,
                                         robot::ImageUse::RoughnessMetallic,
                                         robot::ImageUse::Emission};
    material.images.push_back({kUses[static_cast<std::size_t>(image.use)], image.file});
    key += "\n" + std::to_string(static_cast<int>(image.use)) + image.file;
  }
  for (const std::optional<float>& factor : {appearance.roughness, appearance.metallic}) {
    key += "\n" + (factor ? shortest(*factor) : "");
  }
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
