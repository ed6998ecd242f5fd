// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials are written when the first shape shows them (surface_network.cpp says how).
#include <filesystem>

#include "tenon/base/text_number.h"
#include "tenon/bytes/file_kind.h"
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
    const robot::Material look = with_images_checked(materials_[material]);
    const std::string wanted = look.name.empty() ? "material" : look.name;
    const Token name = material_names_.make(wanted);
    path = builder_.define(materials_scope(), name, "Material");
    name_prim(path, name, wanted);
    write_preview(path, look, linear_color_[material]);
  }
  return path;
}

/// Images go into the asset with it, or are named by it: only those that are images, from where
/// they may lie. One that is not there at all is kept as a name.
bool Conversion::is_usable(const std::string& image, const robot::Material& look) {
  const auto [at, is_new] = usable_.emplace(image, true);
  if (!is_new) {
    return at->second;
  }
  std::optional<Error> refusal;
  if (const auto inner = images_.find(image); inner != images_.end()) {
    if (bytes::kind_of(inner->second) != bytes::FileKind::Image) {
      refusal = bytes::not_media(image);
    }
  } else if (std::error_code error; std::filesystem::exists(image, error)) {
    const auto bytes = options_.reading.open(image);
    if (!bytes) {
      refusal = bytes::not_read(image, bytes.error());
    } else if (bytes::kind_of((*bytes)->text()) != bytes::FileKind::Image) {
      refusal = bytes::not_media(image);
    }
  }
  if (refusal) {
    const Diagnostic& why = refusal->diagnostic();
    report(look.place, Severity::Error, why.rule.c_str(),
           "the texture of the material \"" + look.name + "\" is left out: " + why.message,
           why.fix);
    at->second = false;
  }
  return at->second;
}

robot::Material Conversion::with_images_checked(robot::Material look) {
  if (!look.texture.empty() && !is_usable(look.texture, look)) {
    look.texture.clear();
  }
  std::erase_if(look.images,
                [&](const robot::MaterialImage& image) { return !is_usable(image.file, look); });
  return look;
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
