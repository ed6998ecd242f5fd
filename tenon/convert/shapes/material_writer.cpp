// SPDX-FileCopyrightText: tenon authors
// SPDX-License-Identifier: Apache-2.0
//
// Materials are written when the first shape shows them (surface_network.cpp says how):
// descriptions list many that nothing has. Parts of mesh files that look alike have one material,
// found by the text of all that they say.
#include "tenon/convert/shapes/material_writer.h"

#include <filesystem>

#include "tenon/base/text/text_number.h"
#include "tenon/base/text/unicode.h"
#include "tenon/bytes/file_kind.h"
#include "tenon/convert/shapes/mdl_material.h"
#include "tenon/convert/shapes/surface_network.h"

namespace tenon::convert {

using robot::Index;

namespace {

robot::Material material_of(const mesh::Appearance& appearance) {
  constexpr robot::ImageUse kUses[] = {robot::ImageUse::Normal, robot::ImageUse::Occlusion,
                                       robot::ImageUse::RoughnessMetallic,
                                       robot::ImageUse::Emission};
  robot::Material material;
  material.name = appearance.name.empty() ? "material" : appearance.name;
  material.texture = appearance.texture;
  material.tinted = appearance.tinted;
  material.texture_opacity = appearance.texture_opacity;
  material.roughness = appearance.roughness;
  material.metallic = appearance.metallic;
  for (const mesh::AppearanceImage& image : appearance.images) {
    material.images.push_back({kUses[static_cast<std::size_t>(image.use)], image.file});
  }
  if (appearance.color) {
    material.color = to_double(*appearance.color);
  }
  return material;
}

/// The same for those that look alike.
std::string key_of(const mesh::Appearance& appearance) {
  std::string key = appearance.name + "\n" + appearance.texture + (appearance.linear ? "\nl" : "");
  for (const mesh::AppearanceImage& image : appearance.images) {
    key += "\n" + std::to_string(static_cast<int>(image.use)) + image.file;
  }
  for (const std::optional<float>& factor : {appearance.roughness, appearance.metallic}) {
    key += "\n" + (factor ? shortest(*factor) : "");
  }
  for (std::size_t i = 0; appearance.color && i < 4; ++i) {
    key += "\n" + shortest((*appearance.color)[i]);
  }
  return key;
}

/// Why an image cannot go into the asset or be named by it: only those can whose name an asset path
/// may hold and that are images, from where they may lie. One that is not there at all is kept as a
/// name.
std::optional<Error> refusal_of(const std::string& image, const InnerImages& inner,
                                const bytes::ReadPolicy& reading) {
  if (!unicode::is_printable(std::filesystem::path(image).filename().string())) {
    return bytes::not_nameable(image);
  }
  if (const auto at = inner.find(image); at != inner.end()) {
    return bytes::kind_of(at->second) == bytes::FileKind::Image
               ? std::nullopt
               : std::optional(bytes::not_media(image));
  }
  if (reading.files()->kind(image) == bytes::NameKind::Nothing) {
    return std::nullopt;
  }
  const auto bytes = reading.open(image);
  if (!bytes) {
    return bytes::not_read(image, bytes.error());
  }
  const bytes::FileKind wanted =
      names_mdl(image) ? bytes::FileKind::Shader : bytes::FileKind::Image;
  return bytes::kind_of((*bytes)->text()) == wanted ? std::nullopt
                                                    : std::optional(bytes::not_media(image));
}

void write_surface(LayerBuilder& builder, Path path, const robot::Surface& surface) {
  const auto set = [&](const char* api, const char* name, const std::optional<double>& value) {
    if (value) {
      builder.apply(path, api);
      builder.set_number(path, api, name, *value);
    }
  };
  builder.apply(path, "PhysicsMaterialAPI");
  set("PhysicsMaterialAPI", "physics:staticFriction", surface.static_friction);
  set("PhysicsMaterialAPI", "physics:dynamicFriction", surface.dynamic_friction);
  set("PhysicsMaterialAPI", "physics:restitution", surface.restitution);
  set("NewtonMaterialAPI", "newton:contactDamping", surface.contact_damping);
  set("NewtonMaterialAPI", "newton:contactStiffness", surface.contact_stiffness);
  set("PhysxMaterialAPI", "physxMaterial:compliantContactDamping", surface.contact_damping);
  set("PhysxMaterialAPI", "physxMaterial:compliantContactStiffness", surface.contact_stiffness);
  set("NewtonMaterialAPI", "newton:torsionalFriction", surface.torsional_friction);
  set("NewtonMaterialAPI", "newton:rollingFriction", surface.rolling_friction);
}

void bind(LayerBuilder& builder, Path prim, const char* relationship, Path material) {
  builder.apply(prim, "MaterialBindingAPI");
  builder.set_relationship(prim, relationship, {material});
}

}  // namespace

MaterialWriter::MaterialWriter(RobotLayer& layer, const robot::RobotModel& model,
                               const ConvertOptions& options)
    : layer_(layer), options_(options) {
  for (const robot::Material& look : model.materials) {
    entries_.push_back({look});
  }
}

std::vector<Index> MaterialWriter::add(const std::vector<mesh::Appearance>& appearances,
                                       InnerImages images) {
  images_.merge(images);
  std::vector<Index> materials;
  for (const mesh::Appearance& appearance : appearances) {
    materials.push_back(add_appearance(appearance));
  }
  return materials;
}

Index MaterialWriter::add_appearance(const mesh::Appearance& appearance) {
  const auto [at, is_new] = known_.emplace(key_of(appearance), static_cast<Index>(entries_.size()));
  if (is_new) {
    entries_.push_back({material_of(appearance), appearance.linear});
  }
  return at->second;
}

void MaterialWriter::bind_look(Path shape, Index material) {
  bind(layer_.builder(), shape, "material:binding", look_path(entries_[material]));
}

void MaterialWriter::bind_surface(Path collider, const robot::Surface& surface) {
  bind(layer_.builder(), collider, "material:binding:physics", surface_path(surface));
}

Path MaterialWriter::scope() {
  if (scope_.empty()) {
    scope_ = layer_.builder().define(layer_.robot(), "Materials", "Scope");
  }
  return scope_;
}

Path MaterialWriter::look_path(Entry& entry) {
  if (entry.path.empty()) {
    const robot::Material look = with_usable_images(entry.look);
    entry.path =
        layer_.define(scope(), names_, look.name.empty() ? "material" : look.name, "Material");
    if (names_mdl(look.texture)) {
      write_mdl(layer_.builder(), entry.path, look);
    } else {
      write_preview(layer_.builder(), entry.path, look, entry.linear);
    }
  }
  return entry.path;
}

bool MaterialWriter::is_usable(const std::string& image, const robot::Material& look) {
  const auto [at, is_new] = usable_.emplace(image, true);
  if (!is_new) {
    return at->second;
  }
  if (const std::optional<Error> refusal = refusal_of(image, images_, options_.reading)) {
    const Diagnostic& why = refusal->diagnostic();
    layer_.report(look.place, Severity::Error, why.rule.c_str(),
                  "the texture of the material \"" + look.name + "\" is skipped: " + why.message,
                  why.fix);
    at->second = false;
  }
  return at->second;
}

robot::Material MaterialWriter::with_usable_images(robot::Material look) {
  if (!look.texture.empty() && !is_usable(look.texture, look)) {
    look.texture.clear();
  }
  std::erase_if(look.images,
                [&](const robot::MaterialImage& image) { return !is_usable(image.file, look); });
  return look;
}

Path MaterialWriter::surface_path(const robot::Surface& surface) {
  for (const auto& [known, path] : surfaces_) {
    if (known == surface) {
      return path;
    }
  }
  const Path path = layer_.builder().define(scope(), names_.make("PhysicsMaterial"), "Material");
  write_surface(layer_.builder(), path, surface);
  surfaces_.emplace_back(surface, path);
  return path;
}

}  // namespace tenon::convert
